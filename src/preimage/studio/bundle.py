"""Modules of the page made one, for who takes a single one: a notebook's widget."""

from __future__ import annotations

import re
from importlib import resources

_IMPORT = re.compile(r'^import\s+(?:\{([^}]*)\}|\*\s+as\s+(\w+))\s+from\s+"\./(\w+)\.js";\n', re.M)
_EXPORT = re.compile(r"^export (?=(?:async )?(?:function\*?|const|class) (\w+))", re.M)


def bundled(name: str) -> str:
    """A module with all that it imports, as one: the text of an ES module.

    Each becomes a function that gives its exports, in the order in which they are needed; only
    `export` before declarations, and imports by names, are understood.

    >>> bundled("svg").startswith("const svg_js = (() => {")
    True
    """
    found: dict[str, str] = {}
    _collect(name, found)
    return "\n".join([*found.values(), f"export default {{ render: {name}_js.render }};", ""])


def styles() -> str:
    """The styles of the drawing."""
    return _read("drawing.css")


def _read(name: str) -> str:
    return (resources.files("preimage.studio") / "static" / name).read_text("utf-8")


def _collect(name: str, found: dict[str, str]) -> None:
    if name in found:
        return
    text = _read(f"{name}.js")
    for _, _, other in _IMPORT.findall(text):
        _collect(other, found)

    def taken(match: re.Match[str]) -> str:
        names = f"{{{match[1]}}}" if match[2] is None else match[2]
        return f"const {names.replace(' as ', ': ')} = {match[3]}_js;\n"

    exports = ", ".join(_EXPORT.findall(text))
    body = _EXPORT.sub("", _IMPORT.sub(taken, text))
    body = re.sub(r"^export default .*\n", "", body, flags=re.M)
    found[name] = f"const {name}_js = (() => {{\n{body}\nreturn {{ {exports} }};\n}})();"
