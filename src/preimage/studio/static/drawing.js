// The task as it is drawn: workspace, configuration space, goal, start, robot, the plan's regions.

import { Latest, Refusal } from "./ask.js";
import { labelPlaces, spread } from "./labels.js";
import { areaPath, dot, linePath, regionElements, segmentsPath, svg, unit } from "./svg.js";

const GRID_PIXELS = 56;

/** Colours of the motions, the last one first; drawing.css says which. */
export const MOTION_COLOURS = [1, 2, 3, 4, 5, 6].map((number) => `var(--motion-${number})`);

export function mount({ store, view }) {
  keepSpace(store);
  store.on("space", (space) => space && drawSpace(view, space));
  store.on("space", (space) => space && fitOnce(store, view, space));
  for (const key of ["plan", "space", "tab"]) store.on(key, () => drawPlan(store, view));
  store.on("labels", () => drawLabels(store, view));
  store.on("highlight", (regions) => {
    const shown = [regions ?? []].flat();
    view.draw("target", ...shown.flatMap((region) => regionElements(region, "highlight", 5)));
  });
  store.on("refusal", showRefusal);
  view.addEventListener("changed", () => { drawGrid(view); drawLabels(store, view); });
  wireOverlay(store, view);
}

/** Ask for the space as the task changes; while one answer is under way, only the last is kept. */
function keepSpace(store) {
  const latest = new Latest();
  let busy = false;
  let again = false;
  const refresh = async () => {
    again = busy;
    if (busy) return;
    busy = true;
    try {
      store.set("space", await latest.ask("space", { task: store.get("task") }));
      store.set("refusal", null);
    } catch (error) {
      if (error.name !== "AbortError") store.set("refusal", refusalOf(error));
    }
    busy = false;
    if (again) refresh();
  };
  store.on("task", () => {
    for (const key of ["plan", "stage", "run", "highlight"]) store.set(key, null);
    refresh();
  });
}

/** What an error says, and of which value. */
export function refusalOf(error) {
  return error instanceof Refusal
    ? { where: error.where, words: error.message }
    : { where: "", words: "the studio does not answer: is it still running?" };
}

function showRefusal(refusal) {
  const shown = document.getElementById("refusal");
  shown.hidden = !refusal;
  shown.textContent = refusal ? [refusal.where, refusal.words].filter(Boolean).join(": ") : "";
}

function fitOnce(store, view, space) {
  const key = space.window.join();
  if (store.get("fitted") === key || store.get("dragging")) return;
  store.set("fitted", key);
  view.fit(space.window);
}

export function drawSpace(view, space) {
  const [x0, y0, x1, y1] = space.window;
  const box = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
  view.draw("ground", svg("path", { class: "ground-free", d: `${linePath(box)}Z` }));
  view.draw("workspace", svg("path", { class: "solid area", d: areaPath(space.solid) }));
  view.draw(
    "space",
    svg("path", { class: "c-obstacle area", d: areaPath(space.obstacles), "data-role": "c-obstacle" }),
  );
  const sides = {
    left: [x0, y0, x0, y1], right: [x1, y0, x1, y1], bottom: [x0, y0, x1, y0], top: [x0, y1, x1, y1],
  };
  drawGrid(view);
  view.layer("space").append(
    svg("path", { class: "side", d: segmentsPath(space.open) }),
    ...space.task.walls.map(
      (side) => svg("path", { class: "side wall", d: segmentsPath([sides[side]]) }),
    ),
  );
  const { start } = space;
  const outline = start.outline && svg("path", { class: "start area", d: `${linePath(start.outline)}Z` });
  view.draw("start", ...(outline ? [outline] : regionElements(start, "start", 5)));
  view.draw("goal", ...regionElements(space.goal, "goal", 5));
  const { position } = space.task.uncertainty;
  if (typeof position === "number") {
    const [cx, cy] = anchor(space);
    view.layer("start").append(svg("circle", { class: "error-disc", cx, cy, r: position }));
  }
  view.draw("robot", ...robotAt(space, anchor(space)));
}

/** A place of the start that stands for it. */
export function anchor({ start, goal }) {
  const ring = start.outline ?? start.area[0]?.[0];
  if (ring) return ring.reduce(
    ([x, y], point) => [x + point[0] / ring.length, y + point[1] / ring.length], [0, 0],
  );
  if (start.vertices.length) return start.vertices[0];
  const edge = start.edges[0] ?? goal.edges[0];
  return edge ? [(edge[0] + edge[2]) / 2, (edge[1] + edge[3]) / 2] : [0, 0];
}

/** The robot with its reference point at a place. */
export function robotAt(space, [x, y]) {
  const body = space.robot?.map(([dx, dy]) => [x + dx, y + dy]);
  return [
    body ? svg("path", { class: "robot outline", d: `${linePath(body)}Z` }) : null,
    dot(x, y, "robot", 4),
  ].filter(Boolean);
}

function drawGrid(view) {
  const step = gridStep(view);
  const [left, bottom] = view.fromPixel([0, view.element.clientHeight]);
  const [right, top] = view.fromPixel([view.element.clientWidth, 0]);
  const lines = [];
  const first = (low) => Math.ceil(low / step) * step;
  for (let x = first(left); x < right && lines.length < 400; x += step) lines.push([x, bottom, x, top]);
  for (let y = first(bottom); y < top && lines.length < 800; y += step) lines.push([left, y, right, y]);
  view.draw("grid", svg("path", { class: "grid-line", d: segmentsPath(lines) }));
}

/** A round number of units that is some pixels wide. */
export function gridStep(view) {
  const least = GRID_PIXELS * view.scale;
  const power = 10 ** Math.floor(Math.log10(least));
  return power * [1, 2, 5, 10].find((factor) => factor * power >= least);
}

/** The round number of units that points snap to: a part of a square of the grid. */
export function fineStep(view) {
  const step = gridStep(view);
  const lead = Math.round(step / 10 ** Math.floor(Math.log10(step) + 1e-9));
  return step / (lead === 2 ? 4 : 5);
}

/** The regions of the plan by motion, each with its number and its direction. */
function drawPlan(store, view) {
  const [plan, tab] = [store.get("plan"), store.get("tab")];
  const seen = plan && ["plan", "run", "play", "task"].includes(tab);
  const moving = seen ? plan.regions.filter(({ direction }) => direction !== null) : [];
  const shapes = moving.flatMap((region) => {
    const colour = motionColour(region.rank);
    return regionElements(region.region, "preimage").map((element) => {
      if (element.classList.contains("area")) element.style.setProperty("fill", colour, "important");
      element.style.stroke = colour;
      element.dataset.region = region.id;
      return element;
    });
  });
  const places = labelPlaces(moving.map(({ region }) => region));
  const labels = moving.map((region, place) => ({
    at: places[place], words: nameOf(plan, region.id), direction: region.direction,
    colour: motionColour(region.rank),
  }));
  view.draw("preimages", ...shapes);
  store.set("labels", labels.filter(({ at }) => at));
}

/** The colour of a motion after which so many are left. */
export const motionColour = (rank) => MOTION_COLOURS[(Math.max(1, rank) - 1) % MOTION_COLOURS.length];

/** What a region of a plan is called: by its motion's number where they come one after another. */
export function nameOf(plan, id) {
  if (id === 0) return "the goal";
  const number = plan.linear ? plan.steps.indexOf(id) + 1 : 0;
  return number ? `P${number}` : `${id}`;
}

/** A region's name in a sentence. */
export function spokenName(plan, id) {
  const name = nameOf(plan, id);
  return /^\d/.test(name) ? `region ${name}` : name;
}

function drawLabels(store, view) {
  const labels = store.get("labels") ?? [];
  const places = spread(labels.map(({ at }) => view.toPixel(at)));
  const drawn = labels.flatMap(({ words, direction, colour }, place) => {
    const [x, y] = places[place];
    const [dx, dy] = unit(direction);
    const tip = [x + 26 * dx, y - 26 * dy];
    const head = [
      tip,
      [tip[0] - 9 * dx - 5 * dy, tip[1] + 9 * dy - 5 * dx],
      [tip[0] - 9 * dx + 5 * dy, tip[1] + 9 * dy + 5 * dx],
    ];
    const arrow = svg("path", { class: "arrow", d: `M${x} ${y}L${tip[0]} ${tip[1]}` });
    const end = svg("path", { class: "arrow-head", d: `${linePath(head)}Z` });
    arrow.style.stroke = colour;
    end.style.setProperty("fill", colour, "important");
    const text = svg("text", { class: "label", x: x - 12 * dx, y: y + 12 * dy + 5 });
    text.textContent = words;
    return [arrow, end, text];
  });
  view.draw("labels", ...drawn);
}

function wireOverlay(store, view) {
  const byId = (id) => document.getElementById(id);
  byId("zoom-in").onclick = () => view.zoom(0.8);
  byId("zoom-out").onclick = () => view.zoom(1.25);
  byId("zoom-home").onclick = () => view.home();
  const mirror = mirrorOf(view, byId("beside"));
  byId("space-shown").onchange = (event) => {
    const { value } = event.target;
    view.element.classList.toggle("alone", value === "alone");
    view.element.classList.toggle("no-space", ["beside", "hidden"].includes(value));
    byId("middle").classList.toggle("split", value === "beside");
    byId("beside").toggleAttribute("hidden", value !== "beside");
    mirror(value === "beside");
  };
}

/** What is drawn, once more without the workspace, as long as it is switched on. */
function mirrorOf(view, element) {
  let waiting = false;
  const copy = () => {
    waiting = false;
    const plane = view.plane.cloneNode(true);
    for (const name of ["workspace", "handles", "robot"]) {
      plane.querySelector(`[data-layer=${name}]`).replaceChildren();
    }
    element.replaceChildren(plane);
  };
  const observer = new MutationObserver(() => {
    if (!waiting) requestAnimationFrame(copy);
    waiting = true;
  });
  return (on) => {
    observer.disconnect();
    element.replaceChildren();
    if (!on) return;
    observer.observe(view.plane, { subtree: true, childList: true, attributes: true });
    copy();
  };
}
