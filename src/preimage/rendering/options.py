"""What a user may choose about a picture."""

from __future__ import annotations

from dataclasses import dataclass, field, fields

from preimage.errors import InputError, shown


@dataclass(frozen=True, slots=True, kw_only=True)
class PictureOptions:
    """Options of a picture.

    Each field's `metadata` has its unit and the reason for its default.

    Raises
    ------
    InputError : if an option is out of its range.
    """

    columns: int | None = field(
        default=None,
        metadata={"unit": "panels", "reason": "as many as fit on a page"},
    )
    panel_width: float | None = field(
        default=None,
        metadata={"unit": "inches", "reason": "panels of the same area, tall or wide"},
    )
    legend: bool = field(
        default=True,
        metadata={"unit": "", "reason": "a picture should speak for itself"},
    )
    titles: bool = field(
        default=True,
        metadata={"unit": "", "reason": "the same"},
    )
    ticks: bool = field(
        default=True,
        metadata={"unit": "", "reason": "lengths are read off the axes"},
    )
    names: bool = field(
        default=True,
        metadata={"unit": "", "reason": "the paper's letters beside the regions"},
    )
    edge_numbers: bool = field(
        default=False,
        metadata={"unit": "", "reason": "of use beside a table of features only"},
    )
    friction_cones: bool = field(
        default=False,
        metadata={"unit": "", "reason": "they crowd small pictures"},
    )
    graph: bool = field(
        default=False,
        metadata={"unit": "", "reason": "of use for conditional strategies only"},
    )
    max_panels: int = field(
        default=24,
        metadata={"unit": "panels", "reason": "four pages of six"},
    )
    dpi: int = field(
        default=200,
        metadata={"unit": "dots an inch", "reason": "fit for print; of pixel formats alone"},
    )

    def __post_init__(self) -> None:
        """Refuse options that are out of range."""
        flags = ("legend", "titles", "ticks", "names", "edge_numbers", "friction_cones", "graph")
        for name in flags:
            value = getattr(self, name)
            if not isinstance(value, bool):
                raise InputError(f"picture.{name}", f"must be true or false, not {shown(value)}")
        self._check("panel_width", 0.5, 50)
        for name, low, high in (("columns", 1, 100), ("max_panels", 1, 1000), ("dpi", 20, 2000)):
            self._check(name, low, high)
            value = getattr(self, name)
            if value is not None and not isinstance(value, int):
                raise InputError(f"picture.{name}", f"must be a whole number, not {shown(value)}")

    def _check(self, name: str, low: float, high: float) -> None:
        value = getattr(self, name)
        optional = {option.name for option in fields(self) if option.default is None}
        if value is None and name in optional:
            return
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise InputError(f"picture.{name}", f"must be a number, not {shown(value)}")
        if not low <= value <= high:
            rule = f"must be at least {low} and at most {high}, not {shown(value)}"
            raise InputError(f"picture.{name}", rule)
