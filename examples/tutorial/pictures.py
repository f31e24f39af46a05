"""Make the pictures of docs/tutorial.md and docs/concepts.md, by the commands that a user has.

Run from anywhere: `python examples/tutorial/pictures.py [FOLDER]`.
"""

from __future__ import annotations

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from preimage.cli.main import run

HERE = Path(__file__).parent
IMAGES = HERE.parents[1] / "docs" / "images"

BESIDE_THE_BAY = "polygon:1.5,0,5,0,5,1.85,4.5,1.85"

COMMANDS = (
    "plan TASK -o PLAN --figure tutorial/dock.png",
    "run PLAN --adversary all --runs 100 --animate tutorial/dock.gif",
    "budget TASK --bounds control,position --figure tutorial/budget.png",
    "draw TASK -o concepts/space.png --edge-numbers",
    "backproject TASK -d 22.5 --target sticking --figure concepts/backprojection.png",
    f"kernel TASK -d 292.5 --target {BESIDE_THE_BAY} --figure concepts/kernel.png",
    "preimage TASK -d 22.5 --figure concepts/preimage.png",
    "draw PLAN -o concepts/graph.png --as graph",
    "plan --example two-bays --strategy conditional --figure concepts/conditional.png",
)


def main(folder: Path) -> int:
    """Run the commands; the first status that is not 0, or 0."""
    for name in ("tutorial", "concepts"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory() as scratch:
        places = {"TASK": str(HERE / "dock.yaml"), "PLAN": f"{scratch}/dock.json"}
        for command in COMMANDS:
            words = [
                str(folder / word) if word.startswith(("tutorial/", "concepts/")) else word
                for word in (places.get(word, word) for word in command.split())
            ]
            status = run(words)
            if status:
                return status
    return 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]) if len(sys.argv) > 1 else IMAGES))
