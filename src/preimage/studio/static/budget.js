// How large each error may be: a bar a bound, with its given value and its limit.

import { Latest } from "./ask.js";
import { motionColour, refusalOf } from "./drawing.js";
import { setBound } from "./explaining.js";
import { html, svg } from "./svg.js";

const [WIDE, HIGH] = [340, 34];

const NAMES = {
  control: "control error", position: "position error", force: "force's direction",
  friction: "friction",
};

export function mount({ store }) {
  const latest = new Latest();
  const panel = document.getElementById("panel-budget");
  const boxes = Object.entries(NAMES).map(([name, words]) => html("label", { class: "check" },
    html(
      "input",
      {
        type: "checkbox", id: `budget-${name}`, value: name,
        checked: ["control", "position"].includes(name),
      },
    ), words));
  const now = html("p", { class: "faded", id: "budget-progress", role: "status" });
  const result = html("div", { id: "budget-result", "aria-live": "polite" });
  const cancel = html(
    "button", { type: "button", id: "budget-cancel", hidden: true, onclick: () => latest.cancel() },
    "Cancel",
  );
  let round = null;
  const ask = async () => {
    const bounds = boxes.map(
      (label) => label.firstChild,
    ).filter(({ checked }) => checked).map(({ value }) => value);
    if (!bounds.length) { now.textContent = "Choose a bound."; return; }
    const mine = round = Symbol("question");
    cancel.hidden = false;
    now.textContent = "working …";
    result.replaceChildren();
    try {
      const found = await latest.ask(
        "budget", { task: store.get("task"), bounds },
        { progress: ({ done, total }) => { now.textContent = `${done} of ${total} plans`; } },
      );
      now.textContent = "";
      result.replaceChildren(
        ...found.axes.flatMap((axis) => axisOf(store, axis)),
        html(
          "details", {}, html("summary", {}, "In words"),
          html("div", { class: "words" }, found.words.join("\n")),
        ),
      );
    } catch (error) {
      if (round !== mine) return;
      const { where, words } = refusalOf(error);
      const refused = [where, words].filter(Boolean).join(": ");
      now.textContent = error.name === "AbortError" ? "taken back" : refused;
    }
    if (round === mine) cancel.hidden = true;
  };
  panel.append(
    html(
      "p", { class: "faded" },
      "For each bound, the others as given: up to where there is a plan, and in how many " +
        "motions. That takes some dozens of plans.",
    ),
    html("div", { class: "row" }, ...boxes),
    html(
      "div", { class: "row" },
      html("button", { type: "button", id: "budget", class: "primary", onclick: ask }, "Ask"),
      cancel,
    ), now, result);
  store.on("task", () => { latest.cancel(); round = null; cancel.hidden = true; result.replaceChildren(); now.textContent = ""; });
}

function axisOf(store, axis) {
  const last = axis.solved.length ? axis.solved.at(-1)[1] : axis.high;
  const end = Math.min(axis.high, Math.max(axis.given ?? 0, last) * 1.25 || axis.high);
  const unit = axis.unit ? "°" : "";
  const shown = (value) => `${Number(value.toPrecision(4))}${unit}`;
  const steps = axis.steps.filter(({ from }) => from <= end);
  const limits = axis.limits.map(
    ({ inside, words }) => html("p", { class: "faded" }, `At ${inside}${unit}: ${words}.`),
  );
  const given = axis.given === null ? "no sensor" : `${axis.given}${unit}`;
  const sampled = axis.monotone ? "" : `; sampled every ${axis.spacing}`;
  return [
    html("h3", {}, NAMES[axis.key.split(".").at(-1)] ?? axis.words ?? axis.key),
    barOf(store, axis, steps, end, shown),
    html("div", { class: "ends" },
      html("span", {}, shown(axis.low)), html(
        "span", {}, "click: set this bound",
      ), html("span", {}, shown(end))),
    html("p", {}, `given ${given}, slack ${axis.slack}${sampled}`),
    html("table", { class: "steps" }, ...steps.map((step) => stepRow(store, axis, step, end, shown))),
    ...limits,
  ];
}

/** The bar: how many motions a plan takes, over the bound; the line is what is given. */
function barOf(store, axis, steps, end, shown) {
  const x = (value) => (WIDE * (Math.min(value, end) - axis.low)) / (end - axis.low || 1);
  const bars = steps.map(({ from, to, motions }) => {
    const bar = svg("rect", { x: x(from), y: 8, width: Math.max(1, x(to) - x(from)), height: 16 });
    bar.style.fill = colourOf(motions);
    const title = svg("title");
    title.textContent = `${shown(from)} to ${shown(to)}: ${wordsOf(motions)}`;
    bar.append(title);
    return bar;
  });
  const given = axis.given === null ? "" : svg("path", { class: "given", d: `M${x(axis.given)} 2V32` });
  const choose = (event) => {
    const { left, width } = event.currentTarget.getBoundingClientRect();
    const value = axis.low + ((event.clientX - left) / width) * (end - axis.low);
    setBound(store, axis.key, Number(value.toPrecision(3)));
  };
  const words = steps.map(
    ({ from, to, motions }) => `${shown(from)} to ${shown(to)}: ${wordsOf(motions)}`,
  );
  return svg("svg", {
    class: "bar", viewBox: `0 0 ${WIDE} ${HIGH}`, preserveAspectRatio: "none", role: "img",
    "aria-label": `${axis.key}: ${words.join("; ")}`, onclick: choose,
  }, ...bars, given);
}

function stepRow(store, axis, { from, to, motions }, end, shown) {
  const swatch = html("span", { class: "swatch" });
  swatch.style.cssText = `background: ${colourOf(motions)}; display: inline-block`;
  const open = to >= end && end < axis.high;
  const range = open ? `from ${shown(from)}` : `${shown(from)} to ${shown(to)}`;
  // well inside of the step, since at its end the plan is about to change
  const inside = Number((from + 0.95 * (to - from)).toPrecision(3));
  const set = motions === null || inside < from || inside > to ? "" : html("button", {
    type: "button", "aria-label": `Set ${axis.key} to ${inside}`,
    onclick: () => setBound(store, axis.key, inside),
  }, `Set ${shown(inside)}`);
  return html(
    "tr", {}, html("td", {}, swatch), html("td", {}, range), html("td", {}, wordsOf(motions)),
    html("td", {}, set),
  );
}

const colourOf = (motions) => (motions === null ? "var(--line)" : motionColour(motions));

function wordsOf(motions) {
  if (motions === null) return "no plan";
  return motions === 1 ? "1 motion" : `${motions} motions`;
}
