"""Figures 7 to 10: kernels of goals."""

from __future__ import annotations

from examples.figures.redrawn import DOWN, Redrawn, label, part_of_area, part_of_contact, seen
from preimage import Setting, Task, kernel
from preimage.configuration.goals import goal_region
from preimage.configuration.region import Region
from preimage.geometry import area as areas
from preimage.geometry.inflate import outer_stadiums
from preimage.rendering.style import Layer
from preimage.rendering.views import Part, View, Views

RIGHT = 0.0

FINE = 1e-5
"""How far the arcs of a step may be off, as a part of their radius."""

BOX = (-8.0, -5.0, 8.0, 9.0)

KERNEL = {Layer.TARGET: "kernel", Layer.GOAL: "goal $T$"}

WORDS_10 = {**KERNEL, Layer.PREIMAGE: "$S$, then $S'$", Layer.FOUND: "$S$"}


def _kernel_of(task: Task, direction: float) -> tuple[Setting, Region, Region]:
    """The setting of a task, its goal, and the goal's kernel."""
    setting = Setting.of(task)
    goal = goal_region(task, setting.space)
    readings = setting.command(direction).readings
    return setting, goal, kernel(setting.space, readings, goal, task.uncertainty)


def figure_7() -> Redrawn:
    """A goal that lies on an obstacle, and its kernel in two parts."""
    task = seen("figure-7", BOX)
    setting, _, found = _kernel_of(task, DOWN)
    views = (
        View(task=task, space=setting.space, heading="a  A goal", goal_name="$T$"),
        View(
            task=task, space=setting.space, heading="b  Its kernel", goal_name="", direction=DOWN,
            parts=(
                Part(Layer.TARGET, part_of_area(found), "$T'_2$"),
                Part(Layer.TARGET, part_of_contact(found), "$T'_1$"),
            ),
        ),
    )  # fmt: skip
    size, length = found.area.measure, found.contact.total_length
    return Redrawn(
        7,
        "A Goal and its v-Kernel",
        Views(views, words=KERNEL, command=True),
        "The goal `T` is one rectangle that stands on a C-obstacle. For a motion straight down its "
        f"kernel has two parts: `T'₁`, {length:.4g} of the obstacle's upper edge, which the force "
        "tells from free space and the position from the rest of the edge; and `T'₂`, an area of "
        f"{size:.4g}, whose positions are told from all that is `2ρ` away. Towards the obstacle "
        "nothing is taken away: nobody can be inside it.",
        numbers={"area": size, "length": length},
    )


def figure_8() -> Redrawn:
    """The goal of figure 7, cut into an edge and a polygon."""
    task = seen("figure-7", BOX)
    setting, goal, _ = _kernel_of(task, DOWN)
    view = View(
        task=task, space=setting.space, goal=False,
        parts=(
            Part(Layer.GOAL, part_of_area(goal), "$T_2$"),
            Part(Layer.GOAL, part_of_contact(goal)),
        ),
        places=(label("$T_1$", (0.0, -0.7)),),
    )  # fmt: skip
    return Redrawn(
        8,
        "Goal Components",
        Views((view,), words={Layer.GOAL: "goal components"}),
        "The goal of Figure 7 was given as one polygon. The part of its border that lies in "
        "contact space becomes a goal edge `T₁`, the rest a goal polygon `T₂`. Every region is "
        "kept like that: an area of free space, and beside it intervals of edges, and vertices.",
        "Where `T₁` ends the paper inserts vertices into contact space. Here it is an interval of "
        "an edge.",
        numbers={
            "area": goal.area.measure,
            "length": goal.contact.total_length,
            "vertices": float(len(goal.contact.vertices)),
        },
    )


def figure_9() -> Redrawn:
    """What a wall beside the goal hides, by its thickness and what is behind it."""
    views, numbers = [], {}
    words = {
        "a": "a thick wall",
        "b": "a wall thinner than 2ρ",
        "c": "the same, goals on both sides",
    }
    for part, heading in words.items():
        task = seen(f"figure-9{part}", (-8.0, -7.0, 8.0, 7.0))
        setting, _, found = _kernel_of(task, RIGHT)
        numbers[part] = found.area.measure
        view = View(
            task=task, space=setting.space, heading=f"{part}  {heading.capitalize()}",
            goal_name="$T_j$", parts=(Part(Layer.TARGET, part_of_area(found), "$T'_j$"),),
        )  # fmt: skip
        views.append(view)
    return Redrawn(
        9,
        "Goal Polygon Adjacent to Contact Space",
        Views(tuple(views), words=KERNEL),
        "A goal beside a wall. Where the wall is thick, only the three sides in free space move "
        f"in by `2ρ = 1`, and an area of {numbers['a']:.4g} is left (a). A wall of 0.4 does not "
        "hide what is behind it: the side along it moves in by the remaining 0.6 "
        f"({numbers['b']:.4g}, b). If the goal goes on behind the wall, it need not move at all "
        f"({numbers['c']:.4g} on both sides together, c).",
        "The kernel subtracts from `T`, feature by feature, what lies outside `T` and is "
        "nearer than `2ρ`. The three cases come from that one formula. Only the areas are drawn; "
        "the edges' parts of the kernels depend on the direction.",
        numbers,
    )


def figure_10() -> Redrawn:
    """Goal and obstacle united, shrunk, and cut to the goal again."""
    task = seen("figure-10", BOX)
    setting, goal, found = _kernel_of(task, DOWN)
    reach = 2.0 * task.uncertainty.position
    together = areas.union(goal.area, setting.space.obstacles)
    core = areas.difference(together, outer_stadiums(*together.segments, reach, FINE))
    cut = areas.intersection(goal.area, core)

    def view(heading: str, *parts: Part) -> View:
        kernel_too = parts[0].layer is Layer.TARGET
        return View(
            task=task, space=setting.space, heading=heading, goal=kernel_too, goal_name="$T_j$",
            parts=parts,
        )  # fmt: skip

    nothing = Region.empty().contact
    views = (
        view("a  Goal and obstacle", Part(Layer.PREIMAGE, Region(together, nothing), "$S$")),
        view(
            "b  Less what is near the border",
            Part(Layer.FOUND, Region(together, nothing)),
            Part(Layer.PREIMAGE, Region(core, nothing), "$S'$"),
        ),
        view("c  In the goal", Part(Layer.TARGET, part_of_area(found), "$T'_2$")),
    )
    return Redrawn(
        10,
        "Kernel in Goal Polygon",
        Views(views, words=WORDS_10),
        "The paper's algorithm: `S` is the goal polygon with the C-obstacle that it borders on "
        "(a); `S'` is what of `S` is `2ρ` or more from its border (b); the kernel is what of that "
        f"lies in the goal (c). This goal overhangs its obstacle, so the kernel, an area of "
        f"{found.area.measure:.5g}, has an arc of radius `2ρ` around the obstacle's corner.",
        "Panels a and b follow the paper's steps; panel c is the planner's kernel, which comes "
        "from its definition instead, with its arc replaced by tangents on the safe side: it is "
        f"smaller than `T ∩ S'` by {cut.measure - found.area.measure:.2g}. The paper draws the "
        "goal of Figure 8, which has no arc.",
        {"kernel": found.area.measure, "cut": cut.measure},
    )
