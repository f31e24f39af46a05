// The list of objects, which is the way without a pointer, and the numbers of what is selected.

import { at, moveBy, put, tidy, wholeOf } from "./shapes.js";
import { html } from "./svg.js";

/** Show the list and the numbers, and keep them up to date. */
export function mountObjects(editor) {
  const { store } = editor;
  const list = document.getElementById("objects");
  const numbers = document.getElementById("numbers");
  const refresh = () => {
    const chosen = editor.selected;
    const focused = document.activeElement?.id;
    list.replaceChildren(...editor.shapes.map((shape) => html("li", {}, html("button", {
      type: "button", id: `object-${shape.id}`, "aria-pressed": `${chosen?.shape.id === shape.id}`,
      onclick: () => editor.select(shape.id),
    }, shape.label))));
    numbers.replaceChildren(...(chosen ? numbersOf(editor, chosen) : windowOf(store)));
    if (focused) document.getElementById(focused)?.focus({ preventScroll: true });
  };
  for (const key of ["task", "space", "selected"]) store.on(key, refresh);
}

function entry(id, words, value, change, attributes = {}) {
  const input = html("input", {
    id, type: "number", step: "any", value, ...attributes,
    onchange: () => Number.isFinite(input.valueAsNumber) && change(input.valueAsNumber),
  });
  return html("label", {}, words, input);
}

function numbersOf(editor, { shape, vertex }) {
  const { store } = editor;
  const place = vertex ?? 0;
  const [x, y] = shape.points[place];
  const move = (by) => store.edit(
    `move ${shape.label}`,
    (task) => moveBy(task, vertex === null ? wholeOf(task, shape) : [shape.paths[vertex]], by),
  );
  const shown = [
    html(
      "span", { class: "faded" },
      vertex === null ? `${shape.label}, by its first point` : `vertex ${vertex + 1} of ${shape.points.length}`,
    ),
    entry("number-x", "x", tidy(x), (value) => move([value - x, 0])),
    entry("number-y", "y", tidy(y), (value) => move([0, value - y])),
  ];
  const task = store.get("task");
  if (shape.id === "initial.disc") {
    shown.push(
      entry(
        "number-radius", "radius", task.initial.disc.radius,
        (value) => store.edit("radius", (t) => put(t, ["initial", "disc", "radius"], value)),
        { min: 0 },
      ),
    );
  }
  if (shape.kind === "chain") {
    const path = [...shape.paths[0].slice(0, 2), "solid"];
    const side = html("select", { id: "solid", onchange: () => store.edit("solid side", (t) => put(t, path, side.value)) },
      ...["left", "right"].map(
        (name) => html("option", { value: name, selected: at(task, path) === name }, name),
      ));
    shown.push(html("label", {}, "solid", side));
  }
  shown.push(html("div", { class: "row" },
    html(
      "button", { type: "button", id: "vertex-insert", onclick: () => editor.insert() },
      "Insert vertex",
    ),
    html("button", { type: "button", id: "remove", onclick: () => editor.remove() }, "Remove")));
  return shown;
}

function windowOf(store) {
  const task = store.get("task");
  if (!task?.window) return [];
  const names = ["left", "bottom", "right", "top"];
  const rows = names.map((side, place) => {
    const wall = html("input", {
      type: "checkbox", id: `wall-${side}`, checked: task.walls.includes(side), "aria-label": `${side} is a wall`,
      onchange: () => store.edit(
        "walls",
        (t) => { t.walls = wall.checked ? [...t.walls, side] : t.walls.filter((one) => one !== side); },
      ),
    });
    const row = entry(
      `window-${side}`, side, task.window[place],
      (value) => store.edit("window", (t) => { t.window[place] = value; }),
    );
    return html("div", { class: "window-side" }, row, html("span", { class: "check" }, wall, "wall"));
  });
  const everywhere = html(
    "button",
    {
      type: "button", id: "start-everywhere",
      onclick: () => store.edit("start everywhere", (t) => { t.initial = "everywhere"; }),
    },
    "Start everywhere",
  );
  return [html("span", { class: "faded" }, "Window"), ...rows, everywhere];
}
