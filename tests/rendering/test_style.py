"""Layers are told apart, by the colour-blind and in grey print too."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from numpy.typing import NDArray

from preimage.rendering.style import C_OBSTACLE_GREY, OBSTACLE_GREY, REGIONS, Layer

OKABE_ITO = {
    "#000000", "#e69f00", "#56b4e9", "#009e73", "#f0e442", "#0072b2", "#d55e00", "#cc79a7",
}  # fmt: skip

# Machado, Oliveira and Fernandes (2009), severity 1.0, of linear RGB.
DEFICIENCIES = {
    "none": np.eye(3),
    "protan": np.array(
        [
            [0.152286, 1.052583, -0.204868],
            [0.114503, 0.786281, 0.099216],
            [-0.003882, -0.048116, 1.051998],
        ]
    ),
    "deutan": np.array(
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.011820, 0.042940, 0.968881],
        ]
    ),
}


def linear(color: str) -> NDArray[np.float64]:
    channels = np.array([int(color[place : place + 2], 16) / 255 for place in (1, 3, 5)])
    return np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)


def luminance(color: str) -> float:
    return float(linear(color) @ (0.2126, 0.7152, 0.0722))


def contrast(first: str, second: str) -> float:
    high, low = sorted((luminance(first), luminance(second)), reverse=True)
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("layer", REGIONS)
def test_regions_have_colours_of_the_palette_that_stand_out_on_paper(layer: Layer) -> None:
    color = REGIONS[layer].color
    assert color in OKABE_ITO
    assert contrast(color, "#ffffff") >= (2.0 if layer is Layer.STICKING else 2.9)


@pytest.mark.parametrize("deficiency", DEFICIENCIES)
def test_colours_differ_for_every_eye(deficiency: str) -> None:
    see = DEFICIENCIES[deficiency]
    seen = {style.color: np.clip(see @ linear(style.color), 0, 1) for style in REGIONS.values()}
    for first, second in combinations(seen, 2):
        assert np.linalg.norm(np.sqrt(seen[first]) - np.sqrt(seen[second])) > 0.12


def test_regions_differ_in_grey_by_hatch_dashes_and_shape() -> None:
    looks = [(style.hatch, style.stripes, style.dashes) for style in REGIONS.values()]
    contact = [
        (style.contact, style.contact_dashes)
        for layer, style in REGIONS.items()
        if layer is not Layer.FOUND
    ]
    shapes = [style.marker for layer, style in REGIONS.items() if layer is not Layer.FOUND]
    of_one_panel = [look for look in looks if look[0]]
    assert len(set(of_one_panel)) == len(of_one_panel)
    assert len(set(contact)) == len(contact)
    assert len(set(shapes)) == len(shapes)


def test_obstacles_are_dark_and_those_of_the_workspace_lighter() -> None:
    assert luminance(C_OBSTACLE_GREY) < 0.15 < luminance(OBSTACLE_GREY) < 0.5
