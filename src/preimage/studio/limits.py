"""What a client of the studio may use up."""

from __future__ import annotations

from dataclasses import dataclass, field

MEBIBYTE = 2**20


@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """Bounds on one studio; whoever is over one is refused, and the rest go on."""

    body: int = field(
        default=2 * MEBIBYTE, metadata={"unit": "bytes", "reason": "a plan of 10⁴ edges fits"}
    )
    answer: int = field(
        default=48 * MEBIBYTE, metadata={"unit": "bytes", "reason": "a film fits, in base64"}
    )
    depth: int = field(
        default=32, metadata={"unit": "levels of JSON", "reason": "a plan file has 12"}
    )
    connections: int = field(
        default=128,
        metadata={"unit": "sockets", "reason": "a page needs 6; idle ones make room for new ones"},
    )
    at_once: int = field(
        default=2, metadata={"unit": "long questions", "reason": "each has a process of its own"}
    )
    waiting: int = field(
        default=16,
        metadata={"unit": "questions, quick or long", "reason": "a page asks a few at a time"},
    )
    memory: int = field(
        default=6 * 1024 * MEBIBYTE,
        metadata={"unit": "bytes of a worker", "reason": "10⁵ edges take 0.2 GiB, libraries map 2"},
    )
    patience: float = field(
        default=10.0,
        metadata={"unit": "s", "reason": "for a request's head, and for its body, to be sent"},
    )
    taking: float = field(
        default=60.0, metadata={"unit": "s", "reason": "for an answer to be taken away"}
    )
