"""Figure 20: the point onto the hill, by a conditional strategy."""

from __future__ import annotations

import math

from examples.figures.redrawn import Redrawn, label, letter
from preimage import named_task, plan
from preimage.rendering.style import Layer
from preimage.rendering.views import Part, View, Views


def figure_20() -> Redrawn:
    """The hill, the preimages of its top, and the preimage of all three."""
    strategy = plan(named_task("point-onto-hill"))
    task, space = strategy.task, strategy.space
    (number,) = strategy.start
    first = strategy.region(number)
    assert first.motion is not None
    onto = {  # P_1 is for v_1, which climbs the left flank
        round(math.degrees(region.motion.direction)): region
        for region in (strategy.region(goal) for goal in first.motion.goals)
        if region.motion is not None
    }
    left, right = onto[315], onto[225]
    edges = (label("$E_1$", (-5.2, -1.9)), label("$E_2$", (5.2, -1.9)))
    views = [View(task=task, space=space, heading="a  The hill", places=edges)]
    for heading, name, region in (
        ("b  From the left", letter("P", 1), left), ("c  From the right", letter("P", 2), right),
    ):  # fmt: skip
        assert region.motion is not None
        view = View(
            task=task, space=space, heading=heading,
            direction=region.motion.direction, goal_name="",
            parts=(
                Part(Layer.TARGET, region.motion.target),
                Part(Layer.PREIMAGE, region.region, name),
            ),
        )  # fmt: skip
        views.append(view)
    last = View(
        task=task, space=space, heading="d  From anywhere", direction=first.motion.direction,
        goal_name="",
        parts=(
            Part(Layer.TARGET, first.motion.target),
            Part(Layer.PREIMAGE, first.region, letter("P")),
        ),
    )  # fmt: skip
    views.append(last)
    return Redrawn(
        20,
        "Point-onto-Hill Problem",
        Views(tuple(views), command=True),
        "Perfect control, a perfect force sensor, no position sensor, no friction: from anywhere "
        "onto the top `G` of the hill (a). Motions along `v₁` (b) and `v₂` (c) reach it from the "
        "left and from the right flank. Straight down hits one of the three edges, nobody knows "
        "which in advance, but the force tells afterwards: the preimage `P` of `G`, `P₁` and `P₂` "
        "together is all of free space (d). Then `v₁`, `v₂`, or nothing, as the "
        "normal says.",
        "The paper's flanks are half-lines; ours go on to the window. In eight directions "
        "there is a linear strategy, too, with one motion more: down, then over the top onto the "
        "right flank, then back. So the example does not need a conditional strategy; "
        "[two others do](conditional.md).",
        {"area": first.region.area.measure, "free": space.free.measure,
         "regions": float(len(strategy.regions))},
    )  # fmt: skip
