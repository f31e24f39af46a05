"""Take the pictures of docs/studio.md from a studio that is served meanwhile.

Run from anywhere: `python examples/studio/pictures.py [-o FOLDER]`. It takes playwright, a
Chromium, and the extra `studio`.
"""

from __future__ import annotations

import argparse
import io
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page, sync_playwright

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "docs" / "images" / "studio"
SIZE = (1280, 720)


def main() -> None:
    """Take them all."""
    parser = argparse.ArgumentParser(description="Take the pictures of the studio.")
    parser.add_argument("-o", "--output", type=Path, default=FOLDER, metavar="FOLDER")
    folder = parser.parse_args().output
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    if chromium is None:
        sys.exit("there is no chromium")
    folder.mkdir(parents=True, exist_ok=True)
    with served() as address, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        width, height = SIZE
        page = browser.new_page(viewport={"width": width, "height": height})
        # a run is not played by itself, so that every picture is the same each time
        page.emulate_media(reduced_motion="reduce")
        page.goto(address)
        page.wait_for_selector("[data-layer=space] .c-obstacle", state="attached")
        take(page, folder)
        browser.close()


@contextmanager
def served() -> Iterator[str]:
    """The address of a studio with the peg and the hole."""
    command = [str(Path(sys.executable).parent / "preimage"), "studio", "--example", "peg-in-hole"]
    options = ["--no-browser", "--port", "0"]
    with subprocess.Popen([*command, *options], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        try:
            yield process.stdout.readline().split()[4]
        finally:
            process.terminate()


def take(page: Page, folder: Path) -> None:
    """Go through the tabs."""
    page.keyboard.press("Control+Enter")
    page.wait_for_selector("#verdict")
    keep(page, folder / "plan.png")
    page.click("#tab-layers")
    page.wait_for_selector("[data-layer=backprojection] .area", state="attached")
    page.check("#layer-fans")
    keep(page, folder / "layers.png")
    page.click("#tab-run")
    page.wait_for_selector("[data-layer=trace] .way", state="attached")
    page.eval_on_selector(
        "#run-time",
        "one => { one.value = 0.8 * one.max; one.dispatchEvent(new Event('input')); }",
    )
    keep(page, folder / "run.png")
    page.click("#tab-play")
    page.click("#game-begin")
    page.keyboard.press("ArrowRight")
    page.wait_for_selector("#game-score:not(:empty)", timeout=60_000)
    keep(page, folder / "play.png")
    page.click("#tab-budget")
    page.click("#budget")
    page.wait_for_selector(".bar", timeout=120_000)
    keep(page, folder / "budget.png")


def keep(page: Page, path: Path) -> None:
    """A picture of the page, as small as it gets with all its colours."""
    page.wait_for_timeout(300)
    Image.open(io.BytesIO(page.screenshot())).convert("RGB").save(path, optimize=True)
    print(f"{path} ({path.stat().st_size:,} bytes)")


if __name__ == "__main__":
    main()
