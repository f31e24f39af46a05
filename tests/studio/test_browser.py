"""The story of a newcomer in a real browser, and what an expert expects of the page."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

import preimage
from preimage.strategy.plan_file import write_plan
from tests.studio.browser import (
    browsing,
    click_at,
    drag,
    needs_browser,
    opened,
    pixels,
    saved,
    saved_json,
    served,
    shot,
)

expect.set_options(timeout=20_000)

pytestmark = [needs_browser, pytest.mark.browser]


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with browsing() as found:
        yield found


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with served("--example", "peg-in-hole") as found:
        yield found


@pytest.fixture
def page(browser: Browser, address: str) -> Iterator[Page]:
    with opened(browser, address) as found:
        yield found


def plan(page: Page) -> str:
    page.keyboard.press("Control+Enter")
    return page.locator("#verdict").text_content() or ""


def objects(page: Page) -> list[str]:
    return page.locator("#objects li").all_text_contents()


def test_a_newcomer_draws_plans_runs_saves_and_opens_again(page: Page, tmp_path: Path) -> None:
    page.click("#new")
    page.click("#tool-polygon")
    for corner in ((-8.0, 2.0), (-4.0, 2.0), (-6.0, 4.0)):
        click_at(page, *corner)
    page.keyboard.press("Enter")
    expect(page.locator("#objects li")).to_have_count(4)
    assert objects(page) == ["obstacle 1", "obstacle 2", "goal edge 1", "start"]
    page.click("#tool-start-disc")
    click_at(page, 2.0, 6.0)
    click_at(page, 3.0, 6.0)
    expect(page.locator("[id='object-initial.disc']")).to_have_text("start, a disc")
    assert "solved" in plan(page)
    shot(page, "drawn-and-planned")
    page.click("#tab-run")
    page.click("#runs")
    expect(page.locator("#runs-verdict")).to_contain_text("all ended in the goal")
    data = saved_json(page, "plan")
    strategy = preimage.read_plan(data)
    assert strategy.status is preimage.Status.SOLVED
    task = saved(page, "yaml")
    (tmp_path / "mine.yaml").write_bytes(task)
    drawn = preimage.load_task(tmp_path / "mine.yaml")
    assert len(drawn.workspace.obstacles) == 2
    page.click("#gallery-open")
    page.click("[data-example=rails]")
    expect(page.locator("#name")).to_have_value("rails")
    page.set_input_files("#file", tmp_path / "mine.yaml")
    expect(page.locator("#name")).to_have_value("untitled")
    assert len(objects(page)) == 4


def test_vertices_are_dragged_nudged_and_typed_and_all_is_undone(page: Page) -> None:
    page.click("#new")
    page.click("[id='object-goal.edges.0']")
    drag(page, (3.0, 0.0), (5.0, 0.4))
    handle = page.locator("[data-handle='goal.edges.0/1']")
    expect(handle).to_have_attribute("aria-label", "vertex 2 of goal edge 1, x 5, y 0")
    page.click("[id='object-initial.point']")
    page.locator("[data-handle='initial.point/0']").focus()
    page.keyboard.press("Shift+ArrowUp")
    raised = page.locator("#number-y").input_value()
    assert float(raised) > 6.0
    page.fill("#number-y", "7.25")
    page.keyboard.press("Tab")
    expect(page.locator("[data-handle='initial.point/0']")).to_have_attribute(
        "aria-label", "start, x 0, y 7.25"
    )
    for _ in range(3):
        page.click("#undo")
    expect(page.locator("#undo")).to_have_attribute("title", "undo: open")
    task = saved_json(page, "json")
    assert task["initial"] == {"point": [0, 6]}
    assert task["goal"]["edges"] == [[[-3, 0], [3, 0]]]
    page.click("#redo")
    assert saved_json(page, "json")["goal"]["edges"] == [[[-3, 0], [5, 0]]]


def test_the_error_of_the_position_is_seen_at_the_start(page: Page) -> None:
    disc = page.locator("[data-layer=start] .error-disc")
    expect(disc).to_have_attribute("r", "0.3")
    page.fill("#bound-position", "0.5")
    page.keyboard.press("Tab")
    expect(disc).to_have_attribute("r", "0.5")
    page.uncheck("#has-position")
    expect(disc).to_have_count(0)


def test_a_slider_is_one_step_and_what_is_wrong_is_said_at_its_place(page: Page) -> None:
    slider = page.locator("#slider-control")
    box = slider.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + 8, box["y"] + box["height"] / 2)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] * 0.6, box["y"] + box["height"] / 2, steps=6)
    page.mouse.up()
    assert float(page.input_value("#bound-control")) > 20
    page.click("#undo")
    assert page.input_value("#bound-control") == "5"
    page.click("[id='object-goal.edges.0']")
    page.fill("#number-y", "2")
    page.keyboard.press("Tab")
    expect(page.locator("#refusal")).to_contain_text("goal.edges[0]")
    expect(page.locator("[data-shape='goal.edges.0'].refused")).to_have_count(1)
    page.keyboard.press("Control+Enter")
    page.click("#tab-plan")
    expect(page.locator("#plan-result")).to_contain_text("goal.edges[0]")


def test_a_motion_is_looked_at_closely(page: Page) -> None:
    plan(page)
    page.click("#tab-layers")
    expect(page.locator("#stage-words")).to_contain_text("17.2511")
    assert page.locator("[data-layer=features] [data-role=sticks]").count() > 0
    rays = page.locator("[data-layer=rays] .ray").get_attribute("d") or ""
    assert rays.count("M") == 2
    page.locator("#compass").focus()
    page.keyboard.press("Shift+ArrowRight")
    expect(page.locator("#direction")).to_have_value("255")
    expect(page.locator("#stage-words")).to_contain_text("255°")
    page.click("#sweep-next")
    expect(page.locator("#sweep-says")).to_contain_text("Step 1 of")
    assert page.locator(".sweep-line").count() == 1
    page.locator("#graph [data-node='1']").click()
    expect(page.locator("#stage-goal")).to_have_value("1")
    shot(page, "layers")


def test_a_run_shows_what_the_robot_knows_and_where_it_is(page: Page) -> None:
    plan(page)
    page.click("#tab-run")
    expect(page.locator("#run-outcome")).to_contain_text("in the goal, and known to be")
    assert page.locator("[data-layer=robot] .robot").count() == 2
    assert page.locator("[data-layer=reading] .error-disc").count() == 1
    page.select_option("#run-view", "knows")
    assert page.locator("[data-layer=robot] .robot").count() == 0
    page.select_option("#run-view", "is")
    assert page.locator("[data-layer=reading] .error-disc").count() == 0
    drag(page, (-4.0, 2.5), (-6.0, 1.5))
    expect(page.locator("[data-layer=trace] .way").first).to_have_attribute(
        "d", re.compile(r"^M-(5\.9|6)")
    )
    expect(page.locator("#run-outcome")).to_contain_text("in the goal, and known to be")
    shot(page, "run")


def test_nature_loses_unless_she_cheats(page: Page) -> None:
    plan(page)
    page.click("#tab-play")
    page.click("#game-begin")
    for _ in range(3):
        page.keyboard.press("ArrowLeft")
        page.keyboard.press("d")
    expect(page.locator("#game-verdict")).to_contain_text("the plan has won", timeout=60_000)
    expect(page.locator("#game-truth")).to_have_text("In truth it is in the goal.")
    expect(page.locator("#game-score")).to_contain_text("Left alone it takes")
    shot(page, "play")
    page.select_option("#game-cheat", "3")
    page.evaluate(
        "() => { const push = document.getElementById('game-push'); push.value = 1;"
        " push.dispatchEvent(new Event('input')); }"
    )
    page.click("#game-begin")
    expect(page.locator("#game-verdict")).to_contain_text("After", timeout=60_000)
    expect(page.locator("#game-verdict")).not_to_contain_text("the plan has won")


def test_motions_are_named_in_the_picture_whatever_was_looked_at_before(page: Page) -> None:
    plan(page)
    names = page.locator("[data-layer=labels] .label")
    expect(names).to_have_text(["P2", "P1"])
    places = [box for box in (one.bounding_box() for one in names.all()) if box is not None]
    assert abs(places[0]["x"] - places[1]["x"]) > 20 or abs(places[0]["y"] - places[1]["y"]) > 14
    expect(page.locator(".motion").first).to_contain_text("then it is in P2")
    page.click("#tab-layers")
    expect(names).to_have_count(0)
    assert page.locator("#graph .link.used").count() == 2
    page.click("#tab-plan")
    expect(names).to_have_text(["P2", "P1"])


def test_a_conditional_plan_is_looked_at(page: Page) -> None:
    page.click("#gallery-open")
    page.click("[data-example=two-bays]")
    expect(page.locator("#name")).to_have_value("two-bays")
    plan(page)
    page.click("#tab-layers")
    assert page.locator("#graph .node").count() >= 3
    expect(page.locator("[data-layer=backprojection] .area")).to_have_count(1)
    page.click("#tab-run")
    expect(page.locator("#run-says")).not_to_contain_text("-1")


def test_a_start_is_typed_and_a_wrong_one_is_refused(page: Page) -> None:
    plan(page)
    page.click("#tab-run")
    expect(page.locator("#run-control-words")).to_contain_text("makes for where")
    page.fill("#run-x", "8")
    page.fill("#run-y", "8")
    page.keyboard.press("Tab")
    expect(page.locator("#run-outcome")).to_contain_text("is not where the plan begins")
    assert page.locator("[data-layer=trace] .way").count() == 0
    page.fill("#run-x", "-6")
    page.fill("#run-y", "1")
    page.keyboard.press("Tab")
    way = page.locator("[data-layer=trace] .way").first
    expect(way).to_have_attribute("d", re.compile(r"^M-6 1L"))


def test_a_game_that_is_left_leaves_nothing(page: Page) -> None:
    plan(page)
    page.click("#tab-play")
    page.click("#game-begin")
    expect(page.locator("[data-layer=reading] .believed").first).to_be_attached()
    page.click("#tab-why")
    expect(page.locator("[data-layer=reading] *")).to_have_count(0)
    page.wait_for_timeout(300)
    assert page.locator("[data-layer=reading] *").count() == 0
    assert page.locator("[data-layer=target] *").count() == 0


def test_without_a_position_sensor_there_is_none_to_fool(page: Page) -> None:
    page.click("#gallery-open")
    page.click("[data-example=blind-corner]")
    expect(page.locator("#name")).to_have_value("blind-corner")
    plan(page)
    page.click("#tab-play")
    expect(page.locator("#game-pad")).to_be_hidden()
    page.click("#game-begin")
    expect(page.locator("#game-says")).to_contain_text("no position")
    page.click("#tab-run")
    expect(page.locator("#run-says")).to_contain_text("It reads no position")


def test_tools_are_chosen_by_arrow_keys(page: Page) -> None:
    page.focus("#tool-select")
    page.keyboard.press("ArrowDown")
    expect(page.locator("#tool-polygon")).to_be_focused()
    expect(page.locator("#tool-polygon")).to_have_attribute("aria-checked", "true")
    assert page.locator("#tools [tabindex='0']").count() == 1
    page.keyboard.press("ArrowUp")
    expect(page.locator("#tool-select")).to_have_attribute("aria-checked", "true")


def test_why_points_into_the_picture_and_a_budget_sets_a_bound(page: Page) -> None:
    page.fill("#bound-control", "22")
    page.keyboard.press("Tab")
    assert "not solvable" in plan(page)
    page.click("#ask-why")
    page.click("#why")
    expect(page.locator(".reason").first).to_be_visible()
    page.locator(".reason").first.click()
    assert page.locator("[data-layer=target] .highlight").count() > 0
    shot(page, "why")
    page.click("#tab-budget")
    page.uncheck("#budget-position")
    page.click("#budget")
    expect(page.locator(".bar")).to_have_count(1, timeout=120_000)
    expect(page.locator("#budget-result")).to_contain_text("19.95")
    shot(page, "budget")
    page.locator("#budget-result .steps button").first.click()
    assert 0 < float(page.input_value("#bound-control")) < 22


def test_planning_is_taken_back_and_the_page_goes_on(page: Page) -> None:
    page.click("#gallery-open")
    page.click("[data-example=example-4]")
    expect(page.locator("#name")).to_have_value("example-4")
    page.fill("#bound-control", "28")
    page.fill("#directions", "64")
    page.keyboard.press("Tab")
    page.click("#tab-plan")
    page.click("#plan")
    expect(page.locator("#plan-progress")).to_contain_text("regions")
    page.click("#cancel")
    expect(page.locator("#status")).to_have_text("Planning was taken back.")
    page.click("#undo")
    page.click("#undo")
    assert "solved" in plan(page)


def test_a_link_carries_the_task(page: Page, browser: Browser) -> None:
    page.fill("#name", "sent by link")
    page.keyboard.press("Tab")
    page.click("#link")
    page.wait_for_url(re.compile(r"#task=[\w-]+$"))
    with opened(browser, page.url) as other:
        expect(other.locator("#name")).to_have_value("sent by link")
        assert objects(other) == objects(page)


def test_pictures_and_films_are_saved(page: Page) -> None:
    plan(page)
    assert saved(page, "seen").startswith(b"<svg")
    assert b"<svg" in saved(page, "svg")[:400]
    assert saved(page, "png").startswith(b"\x89PNG")
    assert saved(page, "gif").startswith(b"GIF8")


def test_a_plan_file_is_opened(browser: Browser, tmp_path: Path) -> None:
    path = tmp_path / "plan.json"
    write_plan(preimage.plan(preimage.named_task("cradle")), path)
    with served(str(path)) as address, opened(browser, address) as page:
        expect(page.locator("#verdict")).to_contain_text("cradle: solved")


def test_the_tour_goes_to_its_end(page: Page) -> None:
    page.click("#tour")
    for step in range(1, 8):
        expect(page.locator(".tour")).to_contain_text(f"{step} of 7")
        if step == 3:
            expect(page.locator("#stage-words")).to_contain_text("17.2511")
            shot(page, "tour")
        page.click("#tour-next")
    expect(page.locator(".tour")).to_have_count(0)


@pytest.mark.parametrize(("width", "height"), [(1280, 720), (820, 1180)])
def test_it_fits_and_every_control_has_a_name(
    browser: Browser, address: str, width: int, height: int
) -> None:
    with opened(browser, address, viewport={"width": width, "height": height}) as page:
        shot(page, f"begin-{width}")
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        if width == 1280:
            assert page.evaluate("document.documentElement.scrollHeight") <= height
        nameless = page.evaluate(
            """() => [...document.querySelectorAll(
                'button, input, select, [role=button], [role=slider]')]
              .filter((one) => one.type !== 'file')
              .filter((one) => !(one.getAttribute('aria-label') || one.textContent.trim()
                || one.labels?.length || one.title)).map((one) => one.outerHTML)"""
        )
        assert nameless == []


def test_dark_and_beside(browser: Browser, address: str) -> None:
    with opened(browser, address, color_scheme="dark") as page:
        page.select_option("#space-shown", "beside")
        page.wait_for_selector("#beside .c-obstacle")
        plan(page)
        page.wait_for_selector("#beside .preimage")
        shot(page, "dark-beside")


def test_fingers_zoom(browser: Browser, address: str) -> None:
    with opened(browser, address, has_touch=True) as page:
        before = pixels(page, 1.0, 0.0)[0] - pixels(page, 0.0, 0.0)[0]
        page.locator("#zoom-in").tap()
        after = pixels(page, 1.0, 0.0)[0] - pixels(page, 0.0, 0.0)[0]
        assert after == pytest.approx(before / 0.8, rel=1e-6)
