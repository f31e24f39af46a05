"""Random kernels, and what their definition says of them, slowly."""

import math
from dataclasses import dataclass
from random import Random

import numpy as np
import shapely
from hypothesis import strategies as st
from shapely.geometry.base import BaseGeometry

from preimage.configuration import contact_set
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry.angles import wrap
from preimage.geometry.area import Area
from preimage.recognition.kernel import kernel
from preimage.recognition.readings import Readings, readings
from preimage.task.uncertainty import Uncertainty
from tests.strategies import Scene, random_scene, random_target

seeds = st.integers(0, 2**32 - 1)


@dataclass
class Case:
    """A kernel, and all that it comes from."""

    space: ConfigurationSpace
    target: Region
    direction: float
    friction: float
    senses: Uncertainty
    domain: Region | None = None

    @property
    def readings(self) -> Readings:
        return readings(
            self.space.contact, self.direction, self.senses, self.friction, self.space.tolerance
        )

    @property
    def kernel(self) -> Region:
        return kernel(self.space, self.readings, self.target, self.senses, self.domain)


def random_case(seed: int) -> Case:
    """Any scene, any sensors, and in a third of the cases a domain."""
    rng = Random(seed)
    scene: Scene = random_scene(rng)
    low, high = sorted(rng.choice((0.0, 0.05, 0.3, 1.0, rng.random())) for _ in range(2))
    senses = Uncertainty(
        scene.control,
        rng.choice((0.1, 0.25, 0.5, 1.0, rng.uniform(0.05, 1.5))),
        rng.choice((0.0, math.radians(5), math.radians(20), rng.uniform(0, 1))),
        (low, high) if rng.random() < 0.9 else (math.inf, math.inf),
    )
    domain = None
    if rng.random() < 0.35:
        domain = random_target(rng, scene.space, scene.direction, rng.random() < 0.5)
    return Case(scene.space, scene.target, scene.direction, scene.friction, senses, domain)


def outside_by_feature(case: Case) -> list[tuple[int, BaseGeometry]]:
    """`Delta Y - T` for every feature Y, without tolerance where T ends."""
    space, near = case.space, case.space.tolerance.length
    domain = case.domain or space.valid
    free = shapely.difference(domain.area.geometry, case.target.area.geometry)
    parts = [(2 * len(space.contact), shapely.buffer(free, -1e-7))]
    rest = contact_set.difference(domain.contact, case.target.contact, near)
    rest = contact_set.without_outermost(rest, space.contact)
    ends = [space.contact.at(rest.edge, end) for end in (rest.low, rest.high)]
    for edge, low, high in zip(rest.edge.tolist(), *ends, strict=True):
        parts.append((edge, shapely.LineString([low, high])))
    for vertex in rest.vertices.tolist():
        parts.append((len(space.contact) + vertex, shapely.Point(space.contact.points[vertex])))
    return [(feature, shape) for feature, shape in parts if not shape.is_empty]


def places_in(area: Area, count: int, rng: np.random.Generator) -> np.ndarray:
    """Points inside an area, and its corners."""
    if area.is_empty:
        return np.empty((0, 2))
    xmin, ymin, xmax, ymax = area.bounds
    inner = rng.uniform((xmin, ymin), (xmax, ymax), (count, 2))
    return np.concatenate((inner[area.contains_all(inner)], *area.rings))


def sampled_forces(case: Case, feature: int) -> np.ndarray:
    """(k, 2) forces that nature may make a feature push back with."""
    contact, control = case.space.contact, case.senses.control
    n = len(contact)
    offsets = np.linspace(-control, control, 15)[1:-1] if control else np.zeros(1)
    if feature == 2 * n:
        return np.zeros((1, 2))
    forces = []
    for push in (case.direction + math.pi + offsets).tolist():
        if feature < n:
            forces.append(_force(float(contact.normal[feature]), push, case.friction))
            continue
        edges = [int(contact.previous[feature - n]), feature - n]
        touched = [edge for edge in edges if not contact.open[edge]]
        pair = [_force(float(contact.normal[edge]), push, case.friction) for edge in touched]
        forces += [*pair, np.sum(pair, axis=0)]
        if len(pair) == 2 and contact.concave[feature - n]:
            first, second = (float(contact.normal[edge]) for edge in edges)
            half = ((second - first) % math.tau) / 2
            if abs(wrap(push - first - half)) <= half + case.friction:
                forces.append(np.array([math.cos(push), math.sin(push)]))
    return np.array(forces)


def _force(normal: float, push: float, friction: float) -> np.ndarray:
    a = wrap(push - normal)
    if abs(a) > math.pi / 2:
        return np.zeros(2)
    turned = push if abs(a) <= friction else normal + math.copysign(friction, a)
    size = 1.0 if abs(a) <= friction else math.cos(a) / math.cos(friction)
    return size * np.array([math.cos(turned), math.sin(turned)])
