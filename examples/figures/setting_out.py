"""Figures 1 to 4: the setting, configuration space, a preimage, preimages chained."""

from __future__ import annotations

import math
from dataclasses import replace

from examples.figures.redrawn import DOWN, Redrawn, label, letter, seen
from preimage import Method, Setting, configuration_space, named_task, plan, preimage
from preimage.configuration.goals import goal_region
from preimage.rendering.style import Layer
from preimage.rendering.views import Line, Part, Place, View, Views
from preimage.strategy.strategy import StrategyRegion
from preimage.task.robot import Robot


def figure_1() -> Redrawn:
    """The setting: from somewhere in the disc to anywhere on the goal's edge."""
    task = named_task("landmark-edge")
    view = View(task=task, start=True)
    return Redrawn(
        1,
        "Simple Setting",
        Views((view,), command=True),
        "A point has to move from the initial region `I`, a disc in which it is known to be, to "
        "any place on the edge `G` of the one obstacle. Its direction may be wrong by 8°, its "
        "position as measured by 0.4, the force as measured by 10°. The way straight at `G` is "
        "not safe: from some places in `I` a motion may pass above it. Nor is there "
        "any other single motion among the planner's four directions.",
        "The paper gives no coordinates; this is the named task `landmark-edge`, which has what "
        "the text says of the figure. With directions in between a single motion would do: from "
        "218° to 238°, onto the floor and along it into the corner, the combined method has one.",
    )


def figure_2() -> Redrawn:
    """The workspace, and the configuration space that belongs to it."""
    task = named_task("peg-in-hole")
    as_point = replace(task, robot=Robot())
    workspace, space = configuration_space(as_point), configuration_space(task)
    outline = task.robot.shape
    middle = (
        sum(x for x, _ in outline) / len(outline) - 4.0,
        sum(y for _, y in outline) / len(outline) + 2.5,
    )
    left = View(
        task=task, space=workspace, heading="Workspace", start=True, goal=False, goal_name="",
        places=(label(letter("A"), middle), label(letter("B"), (6.0, -3.0))),
    )  # fmt: skip
    right = View(
        task=as_point, space=space, heading="Configuration space",
        places=(Place((-4.0, 2.5), r"$q$"), label(r"$\mathcal{CB}$", (6.0, -3.0))),
    )  # fmt: skip
    hole, peg = 3.0, 1.0
    return Redrawn(
        2,
        "Peg-Into-Hole Task",
        Views((left, right)),
        "On the left the rectangle `A` above the obstacle `B` with its depression. On the right "
        "the same in configuration space: `A` has become the point `q`, its reference point at "
        "the middle of its lower side, and `B` the C-obstacle `CB`. The depression of `CB` is as "
        f"wide as that of `B` less the width of `A`: {hole:g} − {peg:g} = {hole - peg:g}. The goal "
        "`G` is its bottom.",
        "The paper's sentence that defines `CB` says “no intersection”; its formula, which is "
        "used here, is right.",
        {"width": hole - peg},
    )


def figure_3() -> Redrawn:
    """The preimage of the hole's bottom, by readings alone and with sticking."""
    task = seen("peg-in-hole-point", (-5.0, -4.5, 5.0, 10.0))
    setting = Setting.of(task)
    goal = goal_region(task, setting.space)
    made = {method: preimage(setting, goal, DOWN, method) for method in (
        Method.KERNEL, Method.COMBINED,
    )}  # fmt: skip
    views = tuple(
        View(
            task=task, space=setting.space, heading=f"{part}  Method {method.value}",
            parts=(
                Part(Layer.TARGET, found.target.kernel),
                Part(Layer.STICKING, found.target.sticking),
                Part(Layer.PREIMAGE, found.region, letter("P"), found.target.kernel.area),
            ),
            lines=tuple(Line(ray) for ray in found.backprojection.rays),
            direction=DOWN,
        )
        for part, (method, found) in zip("ab", made.items(), strict=True)
    )  # fmt: skip
    smooth = Setting.of(replace(task, friction=0.0))
    without = preimage(smooth, goal_region(task, smooth.space), DOWN, Method.COMBINED)
    areas = [found.region.area.measure for found in (*made.values(), without)]
    words = {Layer.TARGET: "kernel", Layer.STICKING: "sticks for sure"}
    return Redrawn(
        3,
        "Example of Preimage",
        Views(views, words=words, command=True),
        "The preimage of the bottom of the hole for a motion straight down: the hole, and above it "
        "what cannot miss it, a wedge that narrows by the control cone on both sides. Walls and "
        f"bottom belong to it, its area is {areas[1]:.4g} (b). The motion slides down the walls, "
        "and stops when the force says that the bottom, and not the ground beside the hole, "
        "pushes back, or when it is stuck there.",
        "The paper's condition looks at readings alone, and overlooks the corners at the bottom. "
        "Nature may hold the robot in one of them, and what is read there may be the wall's push. "
        "So the kernel is the bottom without its corners, and of its preimage only the triangle is "
        f"left from which nature cannot steer into a corner ({areas[0]:.4g}, a). What the paper "
        "draws is the preimage of the combined method: in the corners the motion is held for "
        "sure, and known to have stuck. That takes friction, here of 20°. Without it, as in the "
        "paper, a corner holds for as long as nature pushes into it, but not for sure, and the "
        f"combined method has the triangle of panel a, too ({areas[2]:.4g}).",
        {"kernel": areas[0], "combined": areas[1], "frictionless": areas[2]},
    )


def figure_4() -> Redrawn:
    """Two preimages, the second one ending on a landmark."""
    strategy = plan(named_task("landmark-edge"))
    second, first = (strategy.region(number) for number in strategy.steps)

    def view(number: int, this: StrategyRegion, start: bool) -> View:
        motion = this.motion
        assert motion is not None
        parts = [Part(Layer.TARGET, motion.target, "$E$" if start else "")]
        if start:
            parts.insert(0, Part(Layer.SUBGOAL, first.region, letter("P", 1)))
        parts.append(Part(Layer.PREIMAGE, this.region, letter("P", number), motion.target.area))
        return View(
            task=strategy.task, space=strategy.space, start=start, parts=tuple(parts),
            heading=f"{'b' if start else 'a'}  Preimage of {letter(*('P1' if start else 'G'))}",
            direction=motion.direction,
        )  # fmt: skip

    turn = [math.degrees(one.motion.direction) for one in (first, second) if one.motion]
    words = {
        Layer.SUBGOAL: letter("P", 1),
        Layer.PREIMAGE: "preimage",
    }
    return Redrawn(
        4,
        "Illustration of Preimage Backchaining",
        Views((view(1, first, False), view(2, second, True)), words=words, command=True),
        f"Backwards from the goal: for the direction `v₁` ({turn[0]:g}°) the preimage `P₁` of `G` "
        "does not hold the start (a). It becomes the goal in its turn, and its preimage `P₂` for "
        f"`v₂` ({turn[1]:g}°) does hold it (b). What the motion along `v₂` aims at is the edge "
        "`E`, a part of `P₁`: `P₁` is thin there, and it is the force that tells `E`. "
        "So the planner has found a landmark. Carried out, `v₂` comes first.",
        numbers={"motions": float(len(strategy.steps))},
    )
