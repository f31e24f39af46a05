"""What verification finds: verdicts, faults and margins, as records."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

from preimage.display import Shown
from preimage.execution.report import Report
from preimage.execution.trace import Trace
from preimage.strategy.strategy import Strategy
from preimage.verification.recognised import Confusion


class Verdict(Enum):
    """What is known of a promise."""

    PROVEN = "proven"
    REFUTED = "refuted"  # there is a counter-example
    UNPROVEN = "not proven"  # the promise does not follow, without a counter-example


class Fault(Enum):
    """What is wrong."""

    ESCAPE = "leaves through an open side"
    REST = "comes to rest outside the target"
    UNKNOWN = "comes to rest in the goal, unrecognised"
    DOMAIN = "gets out of the domain of a reading condition"
    PERIOD = "may be taken to stick while it moves"
    ELAPSED = "may still move when the time is up"
    THIN = "begins in a region too thin to be looked at"
    GOAL = "the plan's goal is not the task's"
    REACH = "the goal is given up where it may be reached"
    START = "the start is not covered"
    GRAPH = "the regions do not lead to the goal"
    STATUS = "the plan is not solved"
    RUNS = "fails in a run"


@dataclass(frozen=True, slots=True, eq=False)
class Finding:
    """One fault.

    Parameters
    ----------
    words : what happens, and where.
    trace : the counter-example; None if it is no matter of a motion, or none is known.
    """

    fault: Fault
    verdict: Verdict
    words: str
    trace: Trace | None = None


@dataclass(frozen=True, slots=True)
class Margins:
    """How near a motion is to failing, in units of length; infinite where nothing can fail.

    Parameters
    ----------
    entry : how far inside the region the motion begins, from the start of the plan or where the
        motion before it ends.
    reading : how much further than `2 rho` the nearest confusable configuration is from the target.
    progress : by how much more than needed the motion advances within a sticking period.
    """

    entry: float = math.inf
    reading: float = math.inf
    progress: float = math.inf


@dataclass(frozen=True, slots=True)
class Maximality:
    """A region against the maximal backprojection of its target, in areas and lengths.

    Parameters
    ----------
    missing_area, missing_length : what the backprojection has besides.
    excess_area, excess_length : what the region has besides.
    vertices : contact vertices that only one of them has.
    """

    missing_area: float
    missing_length: float
    excess_area: float
    excess_length: float
    vertices: tuple[int, ...]


@dataclass(frozen=True, slots=True, eq=False)
class MotionVerdict:
    """One motion.

    Parameters
    ----------
    region, direction : id of the region, and what is commanded in it, radians.
    findings : empty if it is proven.
    uncertain : parts of the claimed target that are not certainly recognised.
    """

    region: int
    direction: float
    findings: tuple[Finding, ...]
    margins: Margins
    uncertain: tuple[Confusion, ...] = ()
    maximality: Maximality | None = None

    @property
    def verdict(self) -> Verdict:
        """The worst of its findings."""
        return worst(self.findings)


@dataclass(frozen=True, slots=True, eq=False)
class Verification(Shown):
    """A plan against its promise: from the start, whatever nature does, it ends in the goal.

    Parameters
    ----------
    findings : faults of the plan as a whole.
    motions : one for each motion that the plan may come to, the first one first.
    report : the adversarial runs, if any were made.
    """

    strategy: Strategy
    findings: tuple[Finding, ...]
    motions: tuple[MotionVerdict, ...]
    report: Report | None = None
    seconds: float = 0.0

    @property
    def verdict(self) -> Verdict:
        """The worst of all findings."""
        return worst(self.every)

    @property
    def every(self) -> tuple[Finding, ...]:
        """All findings."""
        return (*self.findings, *(one for motion in self.motions for one in motion.findings))

    @property
    def counterexample(self) -> Trace | None:
        """The first trajectory that breaks the promise; one of a proof rather than one of a run."""
        every = sorted(self.every, key=lambda one: one.fault is Fault.RUNS)
        return next((one.trace for one in every if one.trace is not None), None)


def worst(findings: tuple[Finding, ...]) -> Verdict:
    """Refuted if anything is, else not proven if anything is not."""
    for verdict in (Verdict.REFUTED, Verdict.UNPROVEN):
        if any(one.verdict is verdict for one in findings):
            return verdict
    return Verdict.PROVEN
