"""A page of a served studio, in a real browser."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, sync_playwright

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")

SHOTS = Path(__file__).parents[2] / "build" / "screenshots"
"""Pictures of the page as the tests saw it, to be looked at."""

needs_browser = pytest.mark.skipif(
    CHROMIUM is None and not os.environ.get("CI"), reason="there is no chromium"
)

TO_PIXELS = """([x, y]) => {
  const plane = document.querySelector('#drawing .plane').getCTM();
  const { left, top } = document.getElementById('drawing').getBoundingClientRect();
  return [plane.a * x + plane.e + left, plane.d * y + plane.f + top];
}"""


@contextmanager
def served(*arguments: str) -> Iterator[str]:
    """The address of a studio that runs meanwhile."""
    script = Path(sys.executable).parent / "preimage"
    command = [str(script), "studio", "--no-browser", "--port", "0"]
    with subprocess.Popen([*command, *arguments], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        try:
            yield process.stdout.readline().split()[4]
        finally:
            process.terminate()


@contextmanager
def browsing() -> Iterator[Browser]:
    assert CHROMIUM is not None, "CI has a chromium"
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        try:
            yield browser
        finally:
            browser.close()


@contextmanager
def opened(browser: Browser, address: str, **options: Any) -> Iterator[Page]:
    """A page of its own, which says nothing on its console but what it should."""
    options.setdefault("viewport", {"width": 1280, "height": 720})
    context = browser.new_context(accept_downloads=True, **options)
    page = context.new_page()
    said: list[str] = []
    page.on("console", lambda message: said.append(message.text))
    page.on("pageerror", lambda error: said.append(str(error)))
    page.set_default_timeout(30_000)
    page.goto(address)
    page.wait_for_selector("#objects li")
    page.wait_for_selector("[data-layer=space] .c-obstacle", state="attached")
    try:
        yield page
        assert said == []
    finally:
        context.close()


def shot(page: Page, name: str) -> None:
    SHOTS.mkdir(parents=True, exist_ok=True)
    page.screenshot(path=SHOTS / f"{name}.png")


def pixels(page: Page, x: float, y: float) -> tuple[float, float]:
    """Where a place of the plane is on the page."""
    found = page.evaluate(TO_PIXELS, [x, y])
    return found[0], found[1]


def click_at(page: Page, x: float, y: float) -> None:
    page.mouse.click(*pixels(page, x, y))


def drag(page: Page, begin: tuple[float, float], end: tuple[float, float]) -> None:
    page.mouse.move(*pixels(page, *begin))
    page.mouse.down()
    page.mouse.move(*pixels(page, *end), steps=5)
    page.mouse.up()


def saved(page: Page, kind: str) -> bytes:
    """The file that the page saves."""
    with page.expect_download() as download:
        page.select_option("#save", kind)
    return Path(download.value.path()).read_bytes()


def saved_json(page: Page, kind: str) -> Any:
    return json.loads(saved(page, kind))
