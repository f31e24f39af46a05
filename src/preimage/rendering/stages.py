"""The stages on their own: scenes, spaces, regions such as kernels, backprojections, preimages."""

from __future__ import annotations

from matplotlib.figure import Figure

from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.preimages.preimage import Preimage
from preimage.reachability.backprojection import Backprojection
from preimage.rendering.layers import draw_rays, draw_region
from preimage.rendering.names import draw_edge_numbers, draw_name
from preimage.rendering.options import PictureOptions
from preimage.rendering.panel import Panel
from preimage.rendering.scene import Scene, draw_scene
from preimage.rendering.sheet import Plate, compose
from preimage.rendering.strategy import (
    degrees,
    draw_command,
    draw_scene_names,
    stop_words,
    target_words,
)
from preimage.rendering.style import Layer
from preimage.task.task import Task


def task_figure(task: Task, space: ConfigurationSpace | None, options: PictureOptions) -> Figure:
    """The figure of a task: its scene."""
    return _scene_figure(Scene.of(task, space), task.name.replace("$", r"\$"), options)


def space_figure(scene: Scene, options: PictureOptions) -> Figure:
    """The figure of a configuration space."""
    return _scene_figure(scene, "", options)


def _scene_figure(scene: Scene, title: str, options: PictureOptions) -> Figure:
    def paint(panel: Panel) -> None:
        draw_scene(panel, scene)
        if options.edge_numbers:
            draw_edge_numbers(panel)
        if options.names:
            draw_scene_names(panel, scene)

    command = scene.task is not None
    return compose(scene, [Plate("scene", "", "", paint)], title, options, command=command)


def region_figure(
    region: Region, scene: Scene, direction: float | None, options: PictureOptions
) -> Figure:
    """The figure of a region, such as a kernel, in its scene."""
    heading = "Kernel" if direction is not None else "Region"
    towards = "" if direction is None else f" for {degrees(direction)}"

    def paint(panel: Panel) -> None:
        draw_scene(panel, scene, start=False)
        draw_region(panel, Layer.TARGET, region)
        _finish(panel, scene, direction, region, options)
        if options.names:
            draw_name(panel, r"$\mathcal{T}$", Layer.TARGET, region)

    words = {Layer.TARGET: r"kernel $\mathcal{T}$"} if direction is not None else None
    plate = Plate(
        "kernel", f"{heading}{towards}", target_words(region), paint, compass=direction is not None
    )
    return compose(
        scene, [plate], _name(scene), options, words=words, command=direction is not None
    )


def backprojection_figure(
    backprojection: Backprojection, scene: Scene, options: PictureOptions
) -> Figure:
    """The figure of a backprojection: the target, the starts, and the rays between them."""
    region, target = backprojection.region, backprojection.target
    heading = f"Backprojection for {degrees(backprojection.direction)}"
    words = f"of {target_words(target)}: {target_words(region)}"

    def paint(panel: Panel) -> None:
        draw_scene(panel, scene, start=False)
        draw_region(panel, Layer.TARGET, target)
        draw_region(panel, Layer.PREIMAGE, region, plain=target.area)
        draw_rays(panel, backprojection.rays)
        _finish(panel, scene, backprojection.direction, target, options)
        if options.names:
            draw_name(panel, r"$\mathcal{B}$", Layer.PREIMAGE, region)
            draw_name(panel, r"$\mathcal{T}$", Layer.TARGET, target)

    plate = Plate("backprojection", heading, words, paint, compass=True)
    return compose(
        scene, [plate], _name(scene), options,
        words={Layer.PREIMAGE: r"backprojection $\mathcal{B}$"}, command=True,
    )  # fmt: skip


def preimage_figure(preimage: Preimage, scene: Scene, options: PictureOptions) -> Figure:
    """The figure of a preimage: the goal, what is aimed at in it, the starts, and their rays."""
    target = preimage.target
    heading = f"Preimage for {degrees(preimage.direction)}, method {preimage.method.value}"
    stops = " or ".join(stop_words(condition, "the goal") for condition in preimage.termination)
    words = f"aims at {target_words(target.region)}" + (f"; stops when {stops}" if stops else "")
    if target.region.is_empty:
        words = "no part of the goal is recognised"
    scene = Scene(scene.space, scene.task, preimage.goal, scene.start)

    def paint(panel: Panel) -> None:
        draw_scene(panel, scene, start=False)
        draw_region(panel, Layer.TARGET, target.kernel)
        draw_region(panel, Layer.STICKING, target.sticking)
        draw_region(panel, Layer.PREIMAGE, preimage.region, plain=target.kernel.area)
        draw_rays(panel, preimage.backprojection.rays)
        _finish(panel, scene, preimage.direction, target.region, options)
        if options.names:
            draw_name(panel, r"$\mathcal{G}$", Layer.GOAL, preimage.goal)
            draw_name(panel, r"$\mathcal{P}$", Layer.PREIMAGE, preimage.region)

    plate = Plate("preimage", heading, words, paint, compass=True)
    return compose(
        scene, [plate], _name(scene), options,
        words={Layer.TARGET: "target: kernel", Layer.STICKING: "target: sticks for sure"},
        command=True,
    )  # fmt: skip


def _finish(
    panel: Panel,
    scene: Scene,
    direction: float | None,
    target: Region,
    options: PictureOptions,
) -> None:
    if direction is not None:
        draw_command(panel, scene, direction, target, options)
    elif options.edge_numbers:
        draw_edge_numbers(panel)


def _name(scene: Scene) -> str:
    return "" if scene.task is None else scene.task.name.replace("$", r"\$")
