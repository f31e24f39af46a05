"""Processes that answer questions: the page's own never computes, so it never hangs.

A worker reads questions from its standard input and writes what it has to say on its standard
output, a line of JSON each. It ends with who started it.
"""

from __future__ import annotations

import json
import os
import queue
import sys
import threading
from typing import Any, TextIO

from preimage.errors import InputError, PreimageError, one_line

LINE = 2**26
"""Bytes of a question at most; the server has refused what is larger."""


def main() -> None:
    """Answer until nobody asks any more."""
    memory = int(sys.argv[1]) if len(sys.argv) > 1 else 0
    if memory:
        _stay_within(memory)
    out = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # what a library prints is not an answer
    asked: queue.Queue[str] = queue.Queue()
    threading.Thread(target=_listen, args=(asked,), daemon=True).start()
    while True:
        answer(asked.get(), out)


def _listen(asked: queue.Queue[str]) -> None:
    """Hand questions on; end with who asks them, whatever is being computed."""
    for line in sys.stdin:
        asked.put(line)
    os._exit(0)


def _stay_within(memory: int) -> None:
    try:
        import resource
    except ImportError:  # not on this system
        return
    resource.setrlimit(resource.RLIMIT_AS, (memory, memory))


def answer(line: str, out: TextIO) -> None:
    """Answer one question: progress, then an answer, a refusal, or what failed."""

    def say(kind: str, words: object) -> None:
        out.write(json.dumps({kind: words}, allow_nan=False, separators=(",", ":")) + "\n")
        out.flush()

    try:
        say("answer", _answered(json.loads(line), lambda words: say("progress", words)))
    except InputError as error:
        say("refused", {"where": error.key, "words": one_line(error.rule)})
    except PreimageError as error:
        say("refused", {"where": "", "words": one_line(str(error))})
    except MemoryError:
        say("failed", "it needs more memory than the studio gives")
    except RecursionError:
        say("failed", "it is nested too deeply")
    except Exception as error:  # a defect of this program; the studio goes on
        import traceback

        traceback.print_exc(file=sys.stderr)
        say("failed", one_line(f"a defect of this program: {type(error).__name__}: {error}"))


def _answered(asked: dict[str, Any], tell: Any) -> dict[str, Any]:
    from preimage.studio.questions import QUESTIONS

    return QUESTIONS[asked["question"]].answer(asked["body"], tell)


if __name__ == "__main__":
    main()
