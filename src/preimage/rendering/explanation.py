"""Pictures of explanations: what of the start remains, what stands in the way, what nature does."""

from __future__ import annotations

from matplotlib.figure import Figure

from preimage.analysis.explanation import Explanation, explained
from preimage.rendering.glyphs import draw_direction
from preimage.rendering.layers import draw_region
from preimage.rendering.options import PictureOptions
from preimage.rendering.panel import Panel
from preimage.rendering.reasons import draw_reasons, reason_words
from preimage.rendering.scene import Scene, draw_scene
from preimage.rendering.sheet import Plate, compose
from preimage.rendering.strategy import strategy_figure
from preimage.rendering.style import Layer
from preimage.rendering.trace import draw_legs

MOST_REGIONS = 12
"""Of the regions found so many are drawn, the last ones, which come nearest to the start."""


def explanation_figure(found: Explanation, options: PictureOptions) -> Figure:
    """The figure of an explanation; of a plan that needs none, that of the plan."""
    asked = found.asked
    if asked is None:
        return strategy_figure(found.plan, options)
    scene = Scene.of(asked.task, asked.space)

    def paint(panel: Panel) -> None:
        draw_scene(panel, scene)
        for place, region in enumerate(asked.regions[1:][-MOST_REGIONS:]):
            draw_region(panel, Layer.FOUND, region.region, number=place)
        draw_region(panel, Layer.LOST, found.remaining)
        draw_reasons(panel, asked.why)

    plates = [Plate("explanation", "What stands in the way", reason_words(asked), paint)]
    trace = found.counter.trace if found.counter is not None else None
    if found.counter is not None and trace is not None and trace.legs:
        leg = trace.legs[0]

        def nature(panel: Panel) -> None:
            draw_scene(panel, scene)
            motion = trace.strategy.region(leg.region).motion
            if motion is not None:
                draw_region(panel, Layer.TARGET, motion.target)
            draw_legs(panel, [(trace, leg)], asked.task.uncertainty)
            draw_direction(panel, leg.direction, asked.task.uncertainty.control)

        words = found.counter.words
        plates.append(Plate("counter", "What nature may do", words, nature, compass=True))
    title = explained(asked.task, found).replace("$", r"\$")
    labels = {Layer.LOST: "what remains of the start"}
    return compose(scene, plates, title, options, words=labels, command=True)
