"""Figures 11 to 15: plans by the three methods."""

from __future__ import annotations

from examples.figures.redrawn import Redrawn, by_method, letter, ways
from preimage import Method, Strategy
from preimage.rendering.style import Layer
from preimage.rendering.views import Part, View, Views

NUMBER = {Method.STICKING: 1, Method.KERNEL: 2, Method.COMBINED: 3}
"""As the paper counts the methods."""

WORDS = {
    Layer.RUN: "way without errors",
    Layer.TARGET: "what a motion aims at",
    Layer.SUBGOAL: "preimage on the way",
}

POSED = (
    "The paper shows the scene without coordinates. The named task `example-1` has obstacles, goal "
    "and start of our own that have what the text states, and keep it if any of the bounds on "
    "errors changes by 5 %. So have `example-2` to `example-5` in the next four figures."
)


def _view(part: str, strategy: Strategy, regions: int = 0) -> View:
    """A plan in one panel: what each motion aims at, and the way of a robot without errors.

    Parameters
    ----------
    regions : so many preimages, the last ones of the plan, are drawn instead of what is aimed at.
    """
    motions = [strategy.region(number) for number in strategy.steps]
    one = len(motions) == 1
    parts = [
        Part(Layer.SUBGOAL, region.region, letter("P", place))
        for place, region in enumerate(reversed(motions[len(motions) - regions :]), 1)
    ]
    for place, region in enumerate(motions if not regions else (), 1):
        assert region.motion is not None
        name = letter("T", "" if one else place)
        parts.append(Part(Layer.TARGET, region.motion.target, name))
    method = strategy.task.options.method
    words = f"Method {NUMBER[method]}: {len(motions)} motion{'' if one else 's'}"
    return View(
        task=strategy.task, space=strategy.space, heading=f"{part}  {words}".strip(), start=True,
        parts=tuple(parts), lines=ways(strategy),
    )  # fmt: skip


def _plans(name: str, methods: tuple[Method, ...]) -> dict[Method, Strategy]:
    return {method: by_method(name, method) for method in methods}


def _lengths(plans: dict[Method, Strategy]) -> dict[str, float]:
    return {method.value: float(len(plan.steps)) for method, plan in plans.items()}


def figure_11() -> Redrawn:
    """Five motions by sticking, one by readings."""
    plans = _plans("example-1", (Method.STICKING, Method.KERNEL))
    views = tuple(_view(part, plan) for part, plan in zip("ab", plans.values(), strict=True))
    return Redrawn(
        11,
        "Example 1",
        Views(views, words=WORDS, command=True),
        "The goal is an area. Method 1 has to end every motion where it sticks, and goes from "
        "edge to edge in five motions, the last of which sticks in the lower edge of the goal "
        "(a). Method 2 aims at the kernel of the goal's area, straight ahead, in one (b). "
        "`Tᵢ` is what of the next preimage sticks for sure; not all of it need be reached.",
        POSED,
        numbers=_lengths(plans),
    )


def figure_12() -> Redrawn:
    """Two motions by sticking, three by readings."""
    plans = _plans("example-2", (Method.STICKING, Method.KERNEL))
    views = (
        _view("a", plans[Method.STICKING]),
        _view("b", plans[Method.KERNEL], regions=2),
    )
    return Redrawn(
        12,
        "Example 2",
        Views(views, words=WORDS, command=True),
        "Here sticking is simpler: two motions by method 1, onto the face of the upper obstacle, "
        "and along it down into the goal (a). By method 2 the goal's right end is not recognised: "
        "the corner may read like the wall beside it. `P₁` is smaller for that, and has only the "
        "lower half of the face, of which readings tell `2ρ` less again. From the start no motion "
        "to the left is sure to hit that much, and a third one is needed (b). As in the paper, "
        "the two preimages on the way are shown, and the third, which holds the start, is not.",
        numbers=_lengths(plans),
    )


def figure_13() -> Redrawn:
    """From one sticking edge into the next."""
    plans = _plans("example-3", (Method.STICKING,))
    return Redrawn(
        13,
        "Example 3",
        Views((_view("", plans[Method.STICKING]),), words=WORDS, command=True),
        "What method 1 is good at: the robot bounces from one sticking edge into another, in "
        "three motions.",
        "By method 2 ours takes four motions, of which the paper says nothing.",
        numbers=_lengths(plans),
    )


def figure_14() -> Redrawn:
    """A goal in free space beside one obstacle."""
    plans = _plans("example-4", (Method.STICKING, Method.KERNEL))
    return Redrawn(
        14,
        "Example 4",
        Views((_view("", plans[Method.KERNEL]),), words=WORDS, command=True),
        "One C-obstacle, and a goal that lies mostly in free space. By method 1 there is no "
        "strategy in the planner's four directions, however many motions it has: almost nothing of "
        "the goal holds a robot. Method 2 has one of two motions, past the obstacle.",
        numbers={"sticking": float(len(plans[Method.STICKING].steps)),
                 "kernel": float(len(plans[Method.KERNEL].steps))},
    )  # fmt: skip


def figure_15() -> Redrawn:
    """Five, three and two motions."""
    plans = _plans("example-5", (Method.STICKING, Method.KERNEL, Method.COMBINED))
    views = tuple(_view(part, plan) for part, plan in zip("abc", plans.values(), strict=True))
    return Redrawn(
        15,
        "Example 5",
        Views(views, words=WORDS, command=True),
        "Five motions by method 1 (a), three by method 2 (b), two by method 3 (c). There `v₁` is "
        "ended by a reading somewhere in an area. `v₂` aims at all of the goal's edge, of which "
        "readings tell no more than 4 of 6, and takes sticking for the ends. One preimage for "
        "both conditions replaces two, one for each.",
        numbers=_lengths(plans),
    )
