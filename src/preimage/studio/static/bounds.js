// Sliders for every bound, and what the planner may do.

import { html } from "./svg.js";

const force = ({ uncertainty }) => (typeof uncertainty.force === "object" ? uncertainty.force : null);

const threshold = (task, place) => {
  const value = force(task)?.threshold;
  return Array.isArray(value) ? value[place] : value;
};

/**
 * The bounds: key, words, largest value of the slider, how to read it and how to write it.
 * A value that is not a number means that there is no such sensor.
 */
const BOUNDS = [
  {
    key: "control", words: "control ± °", most: () => 60, step: 0.5,
    get: (task) => task.uncertainty.control, set: (task, value) => { task.uncertainty.control = value; },
  },
  {
    key: "position", words: "position ±", step: null, sensor: "position sensor",
    most: (task) => (task.window[2] - task.window[0]) / 10,
    get: (task) => task.uncertainty.position, set: (task, value) => { task.uncertainty.position = value; },
    off: (task) => { task.uncertainty.position = "inf"; }, on: (task) => {
      task.uncertainty.position = (task.window[2] - task.window[0]) / 100;
    },
  },
  {
    key: "force-angle", words: "force ± °", most: () => 90, step: 0.5, sensor: "force sensor",
    get: (task) => force(task)?.angle, set: (task, value) => { force(task).angle = value; },
    off: (task) => { task.uncertainty.force = "none"; }, on: (task) => {
      task.uncertainty.force = { angle: 10, threshold: 0.05 };
    },
  },
  {
    key: "force-threshold", words: "read as none to", most: () => 1, step: 0.01,
    get: (task) => threshold(task, 0),
    set: (task, value) => {
      const f = force(task);
      f.threshold = Array.isArray(f.threshold) ? [value, Math.max(value, f.threshold[1])] : value;
    },
  },
  {
    key: "friction", words: "friction °", most: () => 89, step: 0.5,
    get: (task) => task.friction, set: (task, value) => { task.friction = value; },
  },
];

const CHOICES = {
  sliding: { words: "sliding law", in: (task) => task, options: ["projection", "damper"] },
  method: { words: "method", in: (task) => task.planner, options: ["combined", "kernel", "sticking"] },
  strategy: { words: "strategy", in: (task) => task.planner, options: ["linear", "conditional"] },
  termination: {
    words: "conditions", in: (task) => task.planner,
    options: ["instantaneous", "initial-state", "final-state"],
  },
  search: {
    words: "search", in: (task) => task.planner, options: ["breadth-first", "best-first", "led"],
    usual: "breadth-first",
  },
  prefer: {
    words: "prefer", in: (task) => task.planner, options: ["shortest", "margin"], usual: "shortest",
  },
};

export function mount({ store }) {
  const panel = document.getElementById("panel-task");
  const update = [
    ...BOUNDS.map((bound) => boundRow(panel, store, bound)),
    ...Object.entries(CHOICES).map(([key, choice]) => choiceRow(panel, store, key, choice)),
    directionsRow(panel, store),
    numberRow(panel, store, "max_steps", "at most motions", { min: 1, max: 100, step: 1 }, 8),
    numberRow(panel, store, "time_limit", "time limit, s", { min: 0.1, step: 0.1 }, null),
  ];
  panel.prepend(html("h2", {}, "Errors are within"));
  store.on("task", (task) => task && update.forEach((one) => one(task)));
  const name = document.getElementById("name");
  name.onchange = () => store.edit("rename", (task) => { task.name = name.value.trim() || "untitled"; });
  store.on("task", (task) => task && (name.value = task.name));
}

function boundRow(panel, store, { key, words, most, step, get, set, sensor, off, on }) {
  const change = (value, gesture = null) =>
    Number.isFinite(value) && value >= 0 && store.edit(
      words, (task) => set(task, Number(value.toPrecision(6))), gesture,
    );
  let gesture = null;
  const slider = html("input", {
    type: "range", id: `slider-${key}`, min: 0, "aria-label": words,
    onpointerdown: () => { gesture = Symbol(key); }, oninput: () => change(
      slider.valueAsNumber, gesture ?? `slider ${key}`,
    ),
  });
  const number = html(
    "input",
    {
      type: "number", id: `bound-${key}`, min: 0, step: "any", "aria-label": `${words}, a number`,
      onchange: () => change(number.valueAsNumber),
    },
  );
  panel.append(html("div", { class: "bound" }, html("span", {}, words), slider, number));
  const has = sensor && html(
    "input",
    { type: "checkbox", id: `has-${key}`, onchange: () => store.edit(sensor, has.checked ? on : off) },
  );
  if (has) panel.append(html("label", { class: "check", style: null }, has, `there is a ${sensor}`));
  return (task) => {
    const value = get(task);
    const there = typeof value === "number";
    const top = Math.max(most(task), there ? value : 0);
    slider.max = top;
    slider.step = step ?? Number((top / 200).toPrecision(2));
    slider.disabled = number.disabled = !there;
    if (has) has.checked = there;
    if (there && document.activeElement !== number) number.value = value;
    if (there) slider.value = value;
    slider.setAttribute("aria-valuetext", there ? `${value}` : "no sensor");
  };
}

function choiceRow(panel, store, key, { words, in: home, options, usual }) {
  const select = html("select", {
    id: `choice-${key}`,
    onchange: () => store.edit(words, (task) => { home(task)[key] = select.value; }),
  }, ...options.map((option) => html("option", { value: option }, option)));
  panel.append(html("label", { class: "field" }, words, select));
  return (task) => { select.value = home(task)[key] ?? usual ?? options[0]; };
}

function directionsRow(panel, store) {
  const input = html("input", {
    id: "directions", "aria-describedby": "directions-help",
    onchange: () => store.edit(
      "directions",
      (task) => { task.planner.directions = directionsOf(input.value, task.planner.directions); },
    ),
  });
  panel.append(html("label", { class: "field" }, "directions", input));
  panel.append(
    html(
      "p", { id: "directions-help", class: "faded" },
      "a number all round, a list of degrees, or “continuous”",
    ),
  );
  return (task) => {
    const { directions } = task.planner;
    input.value = Array.isArray(directions) ? directions.join(", ") : `${directions}`;
  };
}

/** What somebody typed as directions; what it was if that is nothing. */
function directionsOf(text, before) {
  if (text.trim().startsWith("cont")) return "continuous";
  const numbers = text.split(/[\s,;]+/).filter(Boolean).map(Number);
  if (!numbers.length || numbers.some((value) => !Number.isFinite(value))) return before;
  return numbers.length === 1 && Number.isInteger(numbers[0]) && !text.includes(",") ? numbers[0] : numbers;
}

function numberRow(panel, store, key, words, attributes, usual) {
  const input = html("input", {
    type: "number", id: `number-${key}`, ...attributes,
    onchange: () => store.edit(words, (task) => {
      if (Number.isFinite(input.valueAsNumber)) task.planner[key] = input.valueAsNumber;
      else if (usual === null) delete task.planner[key];
    }),
  });
  panel.append(html("label", { class: "field" }, words, input));
  return (task) => {
    if (document.activeElement !== input) input.value = task.planner[key] ?? usual ?? "";
  };
}
