"""The widget: one module that draws what the studio draws, in a real browser as well."""

from __future__ import annotations

import json
import re
from dataclasses import replace

import pytest

import preimage
from preimage.studio.bundle import bundled, styles
from preimage.studio.widget import state
from tests.studio.browser import browsing, needs_browser, shot

PAIR = ("hunting", "towards")


def test_state_is_plain() -> None:
    task = preimage.named_task("cradle")
    shown = state(task, PAIR)
    assert shown["plan"] is None
    planned = state(preimage.plan(task), PAIR)
    json.dumps(planned, allow_nan=False)
    assert planned["run"]["good"]
    assert planned["words"].startswith("cradle: solved")
    blocked = preimage.named_task("peg-in-hole")
    one = replace(blocked, options=replace(blocked.options, max_steps=1))
    unsolved = state(preimage.plan(one), PAIR)
    assert unsolved["run"] is None


def test_a_bundle_imports_nothing() -> None:
    text = bundled("widget")
    assert not re.search(r"^\s*(import|export (?!default))", text, re.MULTILINE)
    assert text.count("const svg_js =") == 1
    assert ".plane" in styles()


def test_a_widget_holds_the_bundle_and_the_state() -> None:
    made = preimage.widget(preimage.plan(preimage.named_task("flat-floor")), control="random")
    assert "render" in made._esm
    assert made.run["good"]
    assert made.plan["status"] == "solved"
    with pytest.raises(KeyError):
        preimage.widget(preimage.plan(preimage.named_task("flat-floor")), control="nobody")


RENDER = """async ([text, state]) => {
  const module = await import(URL.createObjectURL(new Blob([text], { type: 'text/javascript' })));
  const el = document.createElement('div');
  document.body.append(el);
  module.default.render({ model: { get: (name) => state[name] }, el });
}"""


@needs_browser
@pytest.mark.browser
@pytest.mark.parametrize("name", ["rails", "l-room"])
def test_it_draws_and_plays_in_a_browser(name: str) -> None:
    shown = state(preimage.plan(preimage.named_task(name)), PAIR)
    with browsing() as browser:
        page = browser.new_page(viewport={"width": 700, "height": 520})
        said: list[str] = []
        page.on("console", lambda message: said.append(message.text))
        page.on("pageerror", lambda error: said.append(str(error)))
        page.set_content(f"<style>{styles()}.drawing{{width:100%;height:420px}}</style>")
        page.evaluate(RENDER, [bundled("widget"), shown])
        page.wait_for_function(
            "() => document.querySelector('[role=status]').textContent.startsWith('It ended in')",
            timeout=30_000,
        )
        assert page.locator("[data-layer=space] .c-obstacle").count() == 1
        assert page.locator("[data-layer=trace] .way").count() == len(shown["run"]["legs"])
        assert page.locator("[data-layer=preimages] .area").count() >= 1
        shot(page, f"widget-{name}")
        assert said == []
