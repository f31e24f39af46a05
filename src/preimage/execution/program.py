"""A plan made ready to be carried out: every condition compiled, every bound worked out."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from preimage.configuration import region as regions
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import Start, StartKind, covered, start_region
from preimage.errors import PlanFileError
from preimage.execution.cells import ReadingCells, reading_cells
from preimage.geometry.angles import unit, wrap
from preimage.geometry.area import Area
from preimage.mechanics.behaviour import Behaviour
from preimage.mechanics.damper import guaranteed_progress
from preimage.reachability.sources import Sources, sources
from preimage.recognition.outside import Domain, Outside, outside
from preimage.recognition.readings import Readings, readings
from preimage.recognition.termination import (
    ElapsedCondition,
    ReadingCondition,
    StickingCondition,
)
from preimage.strategy.strategy import Motion, Status, Strategy, StrategyRegion


@dataclass(frozen=True, slots=True, eq=False)
class Recognition:
    """When a motion has ended in one of its goals.

    Parameters
    ----------
    goal : id of the region.
    cells : what must miss the reading, `Delta - T`; None where nothing needs to be read.
    """

    goal: int
    cells: ReadingCells | None


@dataclass(frozen=True, slots=True, eq=False)
class CompiledMotion:
    """A motion with its conditions compiled (theory 5, 6).

    Parameters
    ----------
    region : the preimage, with its motion.
    direction : v, radians.
    readings : the reading sets of all features for v.
    by_reading : what the reading conditions tell, goals by rank; empty if there is none.
    by_rest : the same once the sticking or the elapsed condition holds: the robot is then on a
        feature of the target that sticks for sure.
    within : preimage and target together, which hold the robot until the motion ends.
    possible : of the same; a reading that they miss contradicts the model.
    domains : of the domains of the reading conditions, which hold the robot too.
    resting : of what sticks for sure in the target; a reading that it misses when the motion is
        over contradicts the model. None without a condition that says so.
    sticking, elapsed : these conditions, if the motion has them.
    longest : the time by which every admissible motion has ended, in units of length; infinite
        where nothing bounds it.
    """

    region: StrategyRegion
    direction: float
    readings: Readings
    by_reading: tuple[Recognition, ...]
    by_rest: tuple[Recognition, ...]
    within: Outside
    possible: ReadingCells
    domains: tuple[ReadingCells, ...]
    resting: ReadingCells | None
    sticking: StickingCondition | None
    elapsed: ElapsedCondition | None
    longest: float


@dataclass(frozen=True, slots=True, eq=False)
class Beginning:
    """Where a plan may begin, and with which region, told by the position alone (theory 7).

    Parameters
    ----------
    point : the start, if it is one; else None.
    initial : of the start region, without forces; None for a point.
    choices : the regions that may be chosen, by rank, each with what the position must miss.
    """

    point: tuple[float, float] | None
    initial: ReadingCells | None
    choices: tuple[Recognition, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Program:
    """A plan made ready.

    Parameters
    ----------
    motions : by region id, the goal left out.
    """

    strategy: Strategy
    beginning: Beginning
    motions: dict[int, CompiledMotion]


def compiled(strategy: Strategy) -> Program:
    """A plan made ready to be carried out: all that takes time is done here.

    Raises
    ------
    PlanFileError : the plan is not solved, or names regions that it does not have.
    """
    status = strategy.status
    if status is not Status.SOLVED:
        raise PlanFileError("status", f"is {status.value}: only a solved plan can be carried out")
    known = {region.id: region for region in strategy.regions}
    for region in strategy.regions:
        for goal in region.motion.goals if region.motion else ():
            if goal not in known:
                raise PlanFileError("regions", f"region {region.id} names the goal {goal}")
    if not strategy.start or any(number not in known for number in strategy.start):
        raise PlanFileError("start", "must name regions of the plan")
    motions = {
        region.id: _motion(strategy, known, region, region.motion)
        for region in strategy.regions
        if region.motion is not None
    }
    return Program(strategy, _beginning(strategy, known), motions)


def force_blind(space: ConfigurationSpace) -> Readings:
    """Reading sets for the position alone: every feature reads 0."""
    size = 2 * len(space.contact) + 1
    return Readings(
        direction=0.0,
        zero=np.ones(size, dtype=np.bool_),
        center=np.zeros(size),
        half=np.full(size, -np.inf),
        tolerance=space.tolerance.angle,
    )


def surely_holds(target: Region, found: Sources) -> Region:
    """The part of a target that sticks for sure (theory 6, paper 5.2)."""
    edges, vertices = found.where(Behaviour.STICKS_SURELY)
    contact = target.contact
    on = edges[contact.edge]
    held = contact.vertices[vertices[contact.vertices]]
    return Region(
        Area.empty(), ContactSet(contact.edge[on], contact.low[on], contact.high[on], held)
    )


def _motion(
    strategy: Strategy, known: dict[int, StrategyRegion], region: StrategyRegion, motion: Motion
) -> CompiledMotion:
    task, space = strategy.task, strategy.space
    control = task.uncertainty.control
    found = sources(space.contact, motion.direction, control, task.friction, space.tolerance)
    sets = readings(
        space.contact, motion.direction, task.uncertainty, task.friction, space.tolerance
    )
    goals = sorted((known[goal] for goal in motion.goals), key=lambda goal: (goal.rank, goal.id))
    radius = task.uncertainty.position

    def told(domain: Domain) -> tuple[Recognition, ...]:
        return tuple(
            Recognition(
                goal.id,
                reading_cells(space, sets, outside(space, goal.region, domain), radius),
            )
            for goal in goals
        )

    by_reading: tuple[Recognition, ...] = ()
    domains: tuple[ReadingCells, ...] = ()
    sticking: StickingCondition | None = None
    elapsed: ElapsedCondition | None = None
    for condition in motion.termination:
        match condition:
            case ReadingCondition(domain=domain):
                by_reading += told(domain)
                if domain is not None:
                    inside = Outside(domain.area, domain.contact)
                    domains += (reading_cells(space, sets, inside, radius),)
            case StickingCondition():
                sticking = condition
            case ElapsedCondition():
                elapsed = condition
    by_rest: tuple[Recognition, ...] = ()
    resting: ReadingCells | None = None
    if sticking is not None or elapsed is not None:
        held = surely_holds(motion.target, found)
        resting = reading_cells(space, sets, Outside(held.area, held.contact), radius)
        by_rest = (Recognition(goals[0].id, None),) if len(goals) == 1 else told(held)
    held_in = regions.union(region.region, motion.target, space.tolerance)
    within = Outside(held_in.area, held_in.contact)
    return CompiledMotion(
        region=region,
        direction=motion.direction,
        readings=sets,
        by_reading=by_reading,
        by_rest=by_rest,
        within=within,
        possible=reading_cells(space, sets, within, radius),
        domains=domains,
        resting=resting,
        sticking=sticking,
        elapsed=elapsed,
        longest=_longest(strategy, within, found, sticking, elapsed),
    )


def _longest(
    strategy: Strategy,
    within: Outside,
    found: Sources,
    sticking: StickingCondition | None,
    elapsed: ElapsedCondition | None,
) -> float:
    """The way along v over the least progress on it, and the period of standing still (theory 6).

    Outside its target a motion makes progress on every edge of the preimage; where it may stick it
    has arrived.
    """
    if elapsed is not None:
        return elapsed.period
    task, contact = strategy.task, strategy.space.contact
    may_stick, _ = found.where(Behaviour.MAY_STICK)
    may_slide, _ = found.where(Behaviour.MAY_SLIDE)
    edges = np.unique(within.contact.edge)
    edges = edges[may_slide[edges] & ~may_stick[edges]]
    beta = wrap(found.direction + np.pi - contact.normal[edges])
    progress = guaranteed_progress(beta, task.uncertainty.control, task.friction, task.sliding)
    if progress <= 0.0:
        return math.inf
    inside = within.contact
    points = np.concatenate(
        (
            *within.area.rings,
            contact.at(inside.edge, inside.low),
            contact.at(inside.edge, inside.high),
            contact.points[inside.vertices],
        )
    )
    if not len(points):
        return math.inf
    along = points @ np.array(unit(found.direction))
    arrived = math.nextafter(float(along.max() - along.min()) / progress, math.inf)
    return arrived + (sticking.period if sticking is not None else 0.0)


def _beginning(strategy: Strategy, known: dict[int, StrategyRegion]) -> Beginning:
    """Which regions may be chosen at the start, and by what (theory 7)."""
    space = strategy.space
    start = start_region(strategy.task, space)
    chosen = sorted((known[number] for number in strategy.start), key=lambda r: (r.rank, r.id))
    blind = force_blind(space)
    initial: ReadingCells | None = None
    if start.kind is StartKind.REGION:
        held = Outside(start.region.area, start.region.contact)
        initial = reading_cells(space, blind, held, strategy.task.uncertainty.position)
    if len(chosen) == 1:
        choices: tuple[Recognition, ...] = (Recognition(chosen[0].id, None),)
    elif initial is None:
        sure = [region for region in chosen if covered(start, region.region, space)]
        choices = tuple(Recognition(region.id, None) for region in sure)
    else:
        choices = tuple(_choice(strategy, blind, start, region) for region in chosen)
    return Beginning(start.point, initial, choices)


def _choice(
    strategy: Strategy, blind: Readings, start: Start, region: StrategyRegion
) -> Recognition:
    rest = outside(strategy.space, region.region, start.region)
    radius = strategy.task.uncertainty.position
    return Recognition(region.id, reading_cells(strategy.space, blind, rest, radius))
