// The tools: what is drawn with each, and the palette in which one is chosen.

import { tidy } from "./shapes.js";
import { html } from "./svg.js";

/** The tools: what each is called, how many points it takes, and what it makes of them. */
export const TOOLS = {
  select: { words: "Select, move", points: 0 },
  polygon: {
    words: "Obstacle", points: Infinity, least: 3,
    make: (task, points) => task.obstacles.push({ polygon: points, holes: [] }),
  },
  rectangle: {
    words: "Rectangle", points: 2,
    make: (task, points) => task.obstacles.push({ polygon: boxOf(points), holes: [] }),
  },
  chain: {
    words: "Chain", points: Infinity, least: 2,
    make: (task, points) => task.obstacles.push({ chain: points, solid: "right" }),
  },
  hole: { words: "Hole", points: Infinity, least: 3, make: addHole },
  robot: {
    words: "Robot", points: Infinity, least: 3,
    make: (task, points, { start }) => {
      task.robot = {
        polygon: points.map(([x, y]) => [tidy(x - start[0]), tidy(y - start[1])]), reference: [0, 0],
      };
    },
  },
  "goal-edge": {
    words: "Goal edge", points: 2, contact: true,
    make: (task, points) => task.goal.edges.push(points),
  },
  "goal-area": {
    words: "Goal area", points: Infinity, least: 3,
    make: (task, points) => task.goal.polygons.push(points),
  },
  "goal-point": {
    words: "Goal corner", points: 1, contact: true,
    make: (task, points) => task.goal.points.push(points[0]),
  },
  "start-point": {
    words: "Start point", points: 1,
    make: (task, points) => { task.initial = { point: points[0] }; },
  },
  "start-disc": {
    words: "Start disc", points: 2,
    make: (task, [center, rim]) => {
      task.initial = {
        disc: { center, radius: tidy(Math.hypot(rim[0] - center[0], rim[1] - center[1])) },
      };
    },
  },
  "start-edge": {
    words: "Start edge", points: 2, contact: true,
    make: (task, points) => { task.initial = { edges: [...(task.initial.edges ?? []), points] }; },
  },
  "start-area": {
    words: "Start area", points: Infinity, least: 3,
    make: (task, points) => { task.initial = { polygon: points }; },
  },
};

/** The corners of a box, from two that are opposite. */
export function boxOf([[x0, y0], [x1, y1]]) {
  const [left, right, low, high] = [
    Math.min(x0, x1), Math.max(x0, x1), Math.min(y0, y1), Math.max(y0, y1),
  ];
  return [[left, low], [right, low], [right, high], [left, high]];
}

function addHole(task, points, { selected }) {
  const place = selected?.startsWith("obstacles.") ? Number(selected.split(".")[1]) : 0;
  const obstacle = task.obstacles[place];
  if (obstacle?.polygon) (obstacle.holes ??= []).push(points);
}

/** The palette: a group of radio buttons, and whether points snap. `changed` is told before the words. */
export function mountTools(store, changed) {
  const box = document.getElementById("tools");
  for (const [name, tool] of Object.entries(TOOLS)) {
    box.append(
      html(
        "button",
        { type: "button", role: "radio", id: `tool-${name}`, onclick: () => store.set("tool", name) },
        tool.words,
      ),
    );
  }
  store.on("tool", (chosen) => {
    changed();
    for (const button of box.children) {
      button.setAttribute("aria-checked", button.id === `tool-${chosen}`);
      button.tabIndex = button.id === `tool-${chosen}` ? 0 : -1;
    }
    const { points } = TOOLS[chosen];
    if (points === Infinity) store.set("announce", "Click the corners; Enter or a double click ends.");
    else if (points) store.set("announce", `Click ${points === 1 ? "once" : "twice"}.`);
  });
  box.addEventListener("keydown", (event) => {
    const turn = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (!turn) return;
    event.preventDefault();
    const names = Object.keys(TOOLS);
    const next = names[(names.indexOf(store.get("tool")) + turn + names.length) % names.length];
    store.set("tool", next);
    document.getElementById(`tool-${next}`).focus();
  });
  const snap = html(
    "input",
    { type: "checkbox", id: "snap", checked: true, onchange: () => store.set("snap", snap.checked) },
  );
  document.getElementById("snapping").append(
    html("label", { class: "check" }, snap, "Snap (Alt: not)"),
  );
}
