// How large each error may be: a bar a bound, with its given value and its limit.

import { Latest } from "./ask.js";
import { MOTION_COLOURS, refusalOf } from "./drawing.js";
import { setBound } from "./explaining.js";
import { html, svg } from "./svg.js";

const [WIDE, HIGH] = [340, 34];

const NAMES = { control: "control error", position: "position error", force: "force's direction", friction: "friction" };

export function mount({ store }) {
  const latest = new Latest();
  const panel = document.getElementById("panel-budget");
  const boxes = Object.entries(NAMES).map(([name, words]) => html("label", { class: "check" },
    html("input", { type: "checkbox", id: `budget-${name}`, value: name, checked: ["control", "position"].includes(name) }), words));
  const now = html("p", { class: "faded", id: "budget-progress", role: "status" });
  const result = html("div", { id: "budget-result", "aria-live": "polite" });
  const cancel = html("button", { type: "button", id: "budget-cancel", hidden: true, onclick: () => latest.cancel() }, "Cancel");
  const ask = async () => {
    const bounds = boxes.map((label) => label.firstChild).filter(({ checked }) => checked).map(({ value }) => value);
    if (!bounds.length) { now.textContent = "Choose a bound."; return; }
    cancel.hidden = false;
    result.replaceChildren();
    try {
      const found = await latest.ask("budget", { task: store.get("task"), bounds }, { progress: ({ done, total }) => { now.textContent = `${done} of ${total} plans`; } });
      now.textContent = "";
      result.replaceChildren(...found.axes.flatMap((axis) => axisOf(store, axis)), html("details", {}, html("summary", {}, "In words"), html("div", { class: "words" }, found.words.join("\n"))));
    } catch (error) {
      const { where, words } = refusalOf(error);
      now.textContent = error.name === "AbortError" ? "taken back" : [where, words].filter(Boolean).join(": ");
    }
    cancel.hidden = true;
  };
  panel.append(
    html("p", { class: "faded" }, "For each bound, the others as given: up to where there is a plan, and in how many motions. That takes some dozens of plans."),
    html("div", { class: "row" }, ...boxes),
    html("div", { class: "row" }, html("button", { type: "button", id: "budget", class: "primary", onclick: ask }, "Ask"), cancel), now, result);
  store.on("task", () => { latest.cancel(); result.replaceChildren(); now.textContent = ""; });
}

function axisOf(store, axis) {
  const last = axis.solved.length ? axis.solved.at(-1)[1] : axis.high;
  const end = Math.min(axis.high, Math.max(axis.given ?? 0, last) * 1.25 || axis.high);
  const x = (value) => (WIDE * (Math.min(value, end) - axis.low)) / (end - axis.low || 1);
  const steps = axis.steps.filter(({ from }) => from <= end).map(({ from, to, motions }) => {
    const bar = svg("rect", { x: x(from), y: 8, width: Math.max(1, x(to) - x(from)), height: 16 });
    bar.style.fill = motions === null ? "var(--line)" : MOTION_COLOURS[(motions - 1 + MOTION_COLOURS.length) % MOTION_COLOURS.length];
    const title = svg("title");
    title.textContent = motions === null ? "no plan" : `${motions} motions`;
    bar.append(title);
    return bar;
  });
  const given = axis.given === null ? null : svg("path", { class: "given", d: `M${x(axis.given)} 2V32` });
  const choose = (event) => {
    const { left, width } = event.currentTarget.getBoundingClientRect();
    const value = axis.low + ((event.clientX - left) / width) * (end - axis.low);
    setBound(store, axis.key, Number(value.toPrecision(3)));
  };
  const unit = axis.unit ? "°" : "";
  const steady = axis.steps.map(({ from, to, motions }) => `${from}–${to}${unit}: ${motions ?? "no plan"}`).join("; ");
  return [
    html("h3", {}, axis.key),
    svg("svg", { class: "bar", viewBox: `0 0 ${WIDE} ${HIGH}`, preserveAspectRatio: "none", role: "img", "aria-label": `${axis.key}: ${steady}`, onclick: choose }, ...steps, given ?? ""),
    html("p", {}, `given ${axis.given === null ? "no sensor" : `${axis.given}${unit}`}, slack ${axis.slack}${axis.monotone ? "" : `; sampled every ${axis.spacing}`}`),
    ...axis.limits.map(({ inside, words }) => html("p", { class: "faded" }, `At ${inside}${unit}: ${words}.`)),
  ];
}
