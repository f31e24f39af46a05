"""SVG drawings: ids, classes and labels of layers and shapes say what is what."""

from __future__ import annotations

import re
import xml.etree.ElementTree as Tree
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from xml.parsers import expat

import numpy as np

from preimage.errors import InputError, one_line, shown
from preimage.exchange.drawing import (
    MAX_FIGURES,
    NAMES,
    Drawing,
    Figure,
    Line,
    Role,
    Shape,
    Spot,
    role_named,
    scaled,
)
from preimage.exchange.options import ImportOptions
from preimage.exchange.reading import bytes_of
from preimage.exchange.svg_path import PIXELS, composed, length_of, matrix_of, points_of
from preimage.exchange.svg_shapes import OUTLINES, closed_up, disc_of, size_of, tag_of
from preimage.exchange.units import METRES, factor
from preimage.geometry.curves import Bezier, Curve, Floats
from preimage.geometry.outlines import Fill

MAX_DEPTH = 100
"""Elements in elements."""

MAX_USES = 16
"""Clones of clones."""

LABEL = "{http://www.inkscape.org/namespaces/inkscape}label"
HREFS = ("href", "{http://www.w3.org/1999/xlink}href")

GROUPS = ("g", "a", "switch")
UNSEEN = ("text", "image", "foreignObject")
_RULES = re.compile(r"transform|clip-path|mask|display|visibility|fill-rule|@import")


@dataclass(frozen=True, slots=True, eq=False)
class _State:
    """What an element has from those around it.

    `styled` is what presentation attributes and styles say, where that is inherited.
    """

    matrix: Floats
    role: Role | None = None
    name: str = ""
    hidden: bool = False
    cut: str = ""
    uses: int = 0
    styled: Mapping[str, str] = field(default_factory=dict)


@dataclass(slots=True)
class _Found:
    """What has been read so far."""

    names: dict[str, Role]
    by_id: dict[str, Tree.Element]
    rules: bool
    figures: list[Figure] = field(default_factory=list)
    ignored: Counter[str] = field(default_factory=Counter)
    strokes: int = 0
    count: int = 0


def read_svg(path: Path, options: ImportOptions) -> Drawing:
    """The drawing of an SVG file, with y up: upside down in its view box.

    Of a layer or a shape the label, the id or a class may say what it is; what is in a layer is
    what the layer is, if it does not say itself. Strokes have no width here.

    Raises
    ------
    InputError : with the id of the element. Entities, references to other files, clips, masks and
        CSS that moves or hides are refused.
    """
    root = _root(bytes_of(path), str(path))
    frame, metres = _frame(root)
    styles = " ".join("".join(one.itertext()) for one in root.iter() if tag_of(one) == "style")
    if _RULES.search(styles):
        raise InputError("style", "rules of CSS that move, hide or clip are not understood")
    by_id = {one.get("id", ""): one for one in root.iter()}
    found = _Found({**NAMES, **options.layers}, by_id, bool(styles.strip()))
    state = _State(frame)
    for child in root:
        _read(child, state, found, 1)
    if not found.figures:
        known = ", ".join(sorted(found.names))
        raise InputError("", f"no label, id or class has a role: those that are known are {known}")
    unit, by = _unit(metres, options.units)
    moved = (f"{found.strokes} strokes count as their middle lines",) if found.strokes else ()
    figures = scaled(found.figures, by)
    return Drawing("SVG", figures, unit=unit, approximated=moved, ignored=found.ignored)


# --- the document -------------------------------------------------------------------------------


def _root(content: bytes, key: str) -> Tree.Element:
    """The root of a document without entities, not endlessly deep or long."""
    _check(content, key)
    try:
        root = Tree.fromstring(content)
    except Tree.ParseError as error:  # such as a prefix without a namespace
        raise InputError(key, f"is no XML: {one_line(str(error))}") from None
    if tag_of(root) != "svg":
        raise InputError(key, f"is no SVG: its root is {shown(tag_of(root))}")
    return root


def _check(content: bytes, key: str) -> None:
    """Refuse what is no XML, or dangerous, before a tree is made of it."""
    depth = count = 0

    def start(_name: str, _attributes: object) -> None:
        nonlocal depth, count
        depth, count = depth + 1, count + 1
        if depth > MAX_DEPTH:
            raise InputError(key, f"must be nested {MAX_DEPTH} deep or less")
        if count > MAX_FIGURES:
            raise InputError(key, f"must have {MAX_FIGURES} elements or fewer")

    def end(_name: str) -> None:
        nonlocal depth
        depth -= 1

    def doctype(_name: str, _system: object, _public: object, internal: int) -> None:
        if internal:
            raise InputError(key, "must not declare entities: save it as plain SVG")

    def entity(*_arguments: object) -> None:
        raise InputError(key, "must not declare entities: save it as plain SVG")

    parser = expat.ParserCreate()
    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.StartDoctypeDeclHandler, parser.EntityDeclHandler = doctype, entity
    parser.SetParamEntityParsing(expat.XML_PARAM_ENTITY_PARSING_NEVER)
    try:
        parser.Parse(content, True)
    except expat.ExpatError as error:
        place = f"line {error.lineno}, column {error.offset + 1}"
        words = expat.errors.messages.get(error.code, str(error.code))
        raise InputError(key, f"is no XML at {place}: {words}") from None
    except (ValueError, LookupError) as error:  # an encoding that nobody knows
        raise InputError(key, f"is no XML: {one_line(str(error))}") from None


def _frame(root: Tree.Element) -> tuple[Floats, float | None]:
    """The matrix that turns y up, and the metres of a user unit if the file says so."""
    box = root.get("viewBox")
    height = size_of(root, "height") if "%" not in root.get("height", "%") else None
    if box is None:
        return np.array([[1.0, 0.0, 0.0], [0.0, -1.0, height or 0.0]]), None
    sides = points_of(box).ravel()
    if len(sides) != 4 or not (sides[2] > 0.0 and sides[3] > 0.0):
        raise InputError("viewBox", f"must be x, y, width and height, not {shown(box)}")
    frame = np.array([[1.0, 0.0, 0.0], [0.0, -1.0, 2.0 * sides[1] + sides[3]]])
    width = root.get("width", "")
    if re.search(r"(?:mm|cm|in|pt|pc)\s*$", width) is None or height is None:
        return frame, None
    by_width, by_height = length_of(width, "width") / sides[2], height / sides[3]
    if abs(by_width - by_height) > 1e-3 * by_width:
        return frame, None
    return frame, by_width / PIXELS["in"] * METRES["in"].metres


def _unit(metres: float | None, wanted: str | None) -> tuple[str, float]:
    """What 1 is, and by what to multiply."""
    if metres is None:
        return "", factor("", wanted)
    if wanted is not None:
        return METRES[wanted].name, float(f"{factor('m', wanted) * metres:.12g}")
    size = float(f"{metres * 1000.0:.6g}")
    return "millimetres" if size == 1.0 else f"units of {size:g} mm", 1.0


# --- elements -----------------------------------------------------------------------------------


def _read(element: Tree.Element, state: _State, found: _Found, depth: int) -> None:
    tag = tag_of(element)
    found.count += 1
    if found.count > MAX_FIGURES or depth > MAX_DEPTH:
        rule = f"must have {MAX_FIGURES} elements or fewer, and {MAX_DEPTH} levels, clones counted"
        raise InputError("", rule)
    if tag not in (*GROUPS, *OUTLINES, *UNSEEN, "use", "svg"):
        return
    state = _inside(element, state, found)
    if state.hidden:
        if state.role is not None:
            found.ignored[f"{tag} that cannot be seen"] += 1
    elif tag in GROUPS:
        for child in element:
            _read(child, state, found, depth + 1)
    elif tag == "use":
        _clone(element, state, found, depth)
    elif tag == "svg":
        raise InputError(_place(element, state), "is an SVG inside another one")
    elif state.role is None:
        found.ignored[f"{tag} without a role"] += 1
    elif tag in UNSEEN:
        found.ignored[f"{tag} in {one_line(state.name[:40])}"] += 1
    else:
        _draw(element, tag, state, found)


def _draw(element: Tree.Element, tag: str, state: _State, found: _Found) -> None:
    """Add the figures of a shape."""
    place = _place(element, state)
    if state.cut:
        raise InputError(place, f"has a {state.cut}: cut it first")
    try:
        found.figures += _figures(element, tag, state, found, place)
    except InputError as error:
        raise error if error.key == place else error.under(place) from None


def _place(element: Tree.Element, state: _State) -> str:
    number = element.get("id")
    word = f"{tag_of(element)} {number}" if number else tag_of(element)
    return one_line(f"{state.name}, {word}"[:120] if state.name else word[:120])


def _inside(element: Tree.Element, state: _State, found: _Found) -> _State:
    """The state inside an element."""
    rules = [part.partition(":") for part in element.get("style", "").split(";")]
    own = {key.strip(): value.strip() for key, colon, value in rules if colon}
    said = {**{key: value.strip() for key, value in element.attrib.items()}, **own}
    place = element.get("id") or tag_of(element)
    if "transform" in own or "transform-origin" in said:
        raise InputError(one_line(place), "is moved by CSS: move it by the attribute transform")
    matrix = state.matrix
    if "transform" in said:
        try:
            matrix = composed(matrix, matrix_of(said["transform"]))
        except InputError as error:
            raise InputError(one_line(f"{place}.transform"), error.rule) from None
    role, name = _role(element, found.names)
    cut = [key for key in ("clip-path", "mask") if said.get(key, "none") != "none"]
    inherited = ("fill", "fill-rule", "stroke", "visibility")
    styled = {**state.styled, **{key: said[key] for key in inherited if key in said}}
    return replace(
        state,
        matrix=matrix,
        role=state.role if role is None else role,
        name=name or state.name,
        hidden=state.hidden or said.get("display") == "none",
        cut=cut[0] if cut else state.cut,
        styled=styled,
    )


def _role(element: Tree.Element, names: Mapping[str, Role]) -> tuple[Role | None, str]:
    """What an element says it is, and by which word."""
    words = [element.get(LABEL), element.get("id"), *element.get("class", "").split()]
    for word in words:
        if word and (role := role_named(word, names)) is not None:
            return role, word
    return None, ""


def _clone(element: Tree.Element, state: _State, found: _Found, depth: int) -> None:
    """What a `use` stands for."""
    place = one_line(element.get("id") or "use")
    link = next((element.get(key, "") for key in HREFS if element.get(key)), "")
    target = found.by_id.get(link.removeprefix("#")) if link.startswith("#") else None
    if target is None:
        raise InputError(place, f"must refer to an element of this file, not {shown(link)}")
    if state.uses >= MAX_USES:
        raise InputError(place, f"clones must be {MAX_USES} deep or less")
    if tag_of(target) == "symbol":
        raise InputError(place, "is the clone of a symbol: unlink it")
    shift = np.array([[1.0, 0.0, size_of(element, "x")], [0.0, 1.0, size_of(element, "y")]])
    moved = replace(state, matrix=composed(state.matrix, shift), uses=state.uses + 1)
    _read(target, moved, found, depth + 1)


# --- shapes --------------------------------------------------------------------------------------


def _figures(
    element: Tree.Element, tag: str, state: _State, found: _Found, place: str
) -> Iterator[Figure]:
    role = state.role
    assert role is not None
    if state.styled.get("visibility") in ("hidden", "collapse"):
        found.ignored[f"{tag} that cannot be seen"] += 1
        return
    if role in (Role.OBSTACLES, Role.ROBOT) and state.styled.get("stroke", "none") != "none":
        found.strokes += 1
    if tag == "circle" and (spot := disc_of(element, state.matrix)) is not None:
        yield Spot(role, place, *spot)
        return
    outlines: list[tuple[Curve, ...]] = []
    for curves, closed in OUTLINES[tag](element):
        moved = tuple(curve.moved(state.matrix) for curve in curves)
        if closed or _is_filled(moved, state, found, place):
            outlines.append(closed_up(moved))
        else:
            yield Line(role, place, moved)
    if outlines:
        even_odd = state.styled.get("fill-rule") == "evenodd"
        yield Shape(role, place, tuple(outlines), Fill.EVEN_ODD if even_odd else Fill.NONZERO)


def _is_filled(curves: tuple[Curve, ...], state: _State, found: _Found, place: str) -> bool:
    """Whether open curves bound an area: SVG closes what it fills."""
    if len(curves) == 1 and isinstance(curves[0], Bezier) and len(curves[0].points) == 2:
        return False
    if np.all(curves[0].start == curves[-1].end):
        return True
    fill = state.styled.get("fill")
    if fill is None and found.rules:
        raise InputError(place, "is open: close it, or say fill by an attribute, not in CSS")
    return fill != "none"
