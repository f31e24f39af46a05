"""Redraw figures of the paper, and write docs/figures.md.

Run from anywhere: `python examples/figures [NUMBER…] [-o FOLDER]`. The page is written if all
figures are drawn into the folder of the documentation.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "figures.md"
FOLDER = ROOT / "docs" / "images" / "figures"


def main() -> None:
    """Draw what is asked for."""
    sys.path.insert(0, str(ROOT))
    from examples.figures.book import FIGURES, page, picture_of

    parser = argparse.ArgumentParser(description="Redraw figures of the paper.")
    parser.add_argument("numbers", nargs="*", type=int, choices=[[], *FIGURES], default=[],
                        metavar="NUMBER", help="of figures, 1 to 20; all by default")  # fmt: skip
    parser.add_argument("-o", "--output", type=Path, default=FOLDER, metavar="FOLDER")
    chosen = parser.parse_args()
    chosen.output.mkdir(parents=True, exist_ok=True)
    drawn = []
    for number in sorted(set(chosen.numbers)) or FIGURES:
        figure = FIGURES[number]()
        path = picture_of(figure, chosen.output)
        drawn.append((figure, f"images/figures/{path.name}"))
        print(f"{path} ({path.stat().st_size:,} bytes)")
    if len(drawn) == len(FIGURES) and chosen.output.resolve() == FOLDER:
        PAGE.write_text(page(drawn), encoding="utf-8")
        print(PAGE)


if __name__ == "__main__":
    main()
