// Drawing and dragging: tools, handles, the list of objects, numbers, keys.

import { anchor, gridStep } from "./drawing.js";
import { mountObjects } from "./objects.js";
import {
  BLANK, insertVertex, moveBy, removeShape, removeVertex, shapesOf, tidy, wholeOf,
} from "./shapes.js";
import { edgeAt, projected, snapped } from "./snap.js";
import { linePath, svg } from "./svg.js";
import { TOOLS, boxOf, mountTools } from "./tools.js";

const STILL_PIXELS = 4;
const DOUBLE_MS = 400;

export function mount({ store, view }) {
  new Editor(store, view).mount();
}

class Editor {
  constructor(store, view) {
    Object.assign(this, { store, view, draft: [], drag: null, finished: -Infinity, pointers: new Map() });
  }

  mount() {
    const { store, view } = this;
    store.set("tool", "select");
    store.set("snap", true);
    mountTools(store, () => { this.draft = []; this.drawDraft(); });
    mountObjects(this);
    store.on("task", () => this.draw());
    store.on("space", () => this.draw());
    store.on("selected", () => this.draw());
    store.on("refusal", () => this.draw());
    view.addEventListener("changed", () => this.drawHandles());
    const { element } = view;
    element.addEventListener("pointerdown", (event) => this.down(event));
    element.addEventListener("pointermove", (event) => this.move(event));
    for (const kind of ["pointerup", "pointercancel"]) element.addEventListener(
      kind, (event) => this.up(event),
    );
    element.addEventListener("dblclick", (event) => this.doubled(event));
    document.addEventListener("keydown", (event) => this.key(event));
    store.on("history", (history) => this.showHistory(history));
    document.getElementById("undo").onclick = () => store.undo();
    document.getElementById("redo").onclick = () => store.redo();
    document.getElementById("new").onclick = () => store.open(BLANK, { undoable: true });
  }

  showHistory({ undo, redo }) {
    for (const [id, words] of [["undo", undo], ["redo", redo]]) {
      const button = document.getElementById(id);
      button.disabled = words === null;
      button.title = words === null ? id : `${id}: ${words}`;
    }
  }

  get shapes() {
    const [task, space] = [this.store.get("task"), this.store.get("space")];
    return task ? shapesOf(task, space ? anchor(space) : [0, 0]) : [];
  }

  get selected() {
    const chosen = this.store.get("selected");
    const shape = chosen && this.shapes.find(({ id }) => id === chosen.id);
    return shape ? { shape, vertex: chosen.vertex ?? null } : null;
  }

  select(id, vertex = null) {
    this.store.set("selected", id === null ? null : { id, vertex });
  }

  // --- what is drawn ---------------------------------------------------------------------------

  draw() {
    this.drawHandles();
    this.drawDraft();
  }

  drawHandles() {
    const chosen = this.selected;
    const where = this.store.get("refusal")?.where ?? "";
    const elements = [];
    for (const shape of this.shapes) {
      const classes = [
        "shape", shape.closed && "closed", chosen?.shape.id === shape.id && "selected",
        refused(where, shape) && "refused",
      ];
      const line = linePath(shape.points) + (shape.closed ? "Z" : "");
      const d = shape.points.length > 1 ? line : `M${shape.points[0]}l0 0`;
      elements.push(svg("path", { class: classes.filter(Boolean).join(" "), d, "data-shape": shape.id }));
    }
    for (const shape of this.shapes) if (
      chosen?.shape.id === shape.id || shape.points.length === 1
    ) elements.push(...this.handlesOf(shape, chosen));
    const focused = document.activeElement?.dataset?.handle;
    this.view.draw("handles", ...elements);
    if (focused) this.view.layer("handles").querySelector(
      `[data-handle="${focused}"]`,
    )?.focus({ preventScroll: true });
  }

  handlesOf(shape, chosen) {
    return shape.points.map(([x, y], place) => svg("path", {
      class: `handle${chosen?.shape.id === shape.id && chosen.vertex === place ? " chosen" : ""}`,
      d: `M${x} ${y}l0 0`, "stroke-width": 11, tabindex: 0, role: "button",
      "data-shape": shape.id, "data-vertex": place, "data-handle": `${shape.id}/${place}`,
      "aria-label": `${shape.points.length > 1 ? `vertex ${place + 1} of ` : ""}${shape.label}, x ${tidy(x)}, y ${tidy(y)}`,
      onfocus: () => (chosen?.shape.id !== shape.id || chosen.vertex !== place) && this.select(shape.id, place),
    }));
  }

  drawDraft(to = null) {
    const mark = to?.to ? to.point : null;
    const guides = to?.guides ?? [];
    const line = this.hover ? [...this.draft, this.hover] : this.draft;
    const tool = this.store.get("tool");
    const points = tool === "rectangle" && line.length === 2 ? [...boxOf(line), boxOf(line)[0]] : line;
    const reach = 7 * this.view.scale;
    const cross = mark && `M${mark[0] - reach} ${mark[1]}h${2 * reach}M${mark[0]} ${mark[1] - reach}v${2 * reach}`;
    this.view.draw("reading",
      ...(points.length > 1 ? [svg("path", { class: "draft", d: linePath(points) })] : []),
      ...guides.map((guide) => svg("path", { class: "snap-mark guide", d: linePath(guide) })),
      ...(cross ? [svg("path", { class: "snap-mark", d: cross })] : []));
  }

  // --- pointers --------------------------------------------------------------------------------

  down(event) {
    if (event.button > 1 || this.store.get("game")) return;
    this.pointers.set(event.pointerId, event);
    if (this.pointers.size === 2) return this.pinch();
    const tool = this.store.get("tool");
    if (tool !== "select" && event.button === 0) return this.click(event);
    const { shape, vertex } = event.target.dataset ?? {};
    this.view.element.setPointerCapture(event.pointerId);
    const from = this.view.at(event);
    if (shape && event.button === 0) {
      const place = vertex === undefined ? null : Number(vertex);
      this.select(shape, place);
      this.drag = {
        kind: "shape", from, gesture: Symbol("drag"), points: this.selected.shape.points, place,
        pressed: [event.clientX, event.clientY],
      };
    } else {
      if (event.button === 0) this.select(null);
      this.drag = { kind: "pan", from: [event.clientX, event.clientY] };
    }
  }

  move(event) {
    const point = this.view.at(event);
    document.getElementById("place").textContent = point.map((value) => value.toPrecision(4)).join(", ");
    if (this.pointers.size === 2) return this.pinched(event);
    if (this.pointers.has(event.pointerId)) this.pointers.set(event.pointerId, event);
    if (this.drag?.kind === "pan") {
      const [x, y] = this.drag.from;
      this.view.pan(-(event.clientX - x) * this.view.scale, (event.clientY - y) * this.view.scale);
      this.drag.from = [event.clientX, event.clientY];
    } else if (this.drag?.kind === "shape") {
      if (!this.still(event)) this.dragged(point, event.altKey);
    }
    else if (TOOLS[this.store.get("tool")].points) {
      const to = this.snap(point, event.altKey);
      this.hover = to.point;
      this.drawDraft(to);
    }
  }

  /** Whether what was pressed has hardly moved yet: who only selects does not move anything. */
  still(event) {
    const { pressed } = this.drag;
    if (
      pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) < STILL_PIXELS
    ) return true;
    this.drag.pressed = null;
    return false;
  }

  dragged(point, off) {
    const { store } = this;
    const { from, gesture, points, place } = this.drag;
    const chosen = this.selected;
    if (!chosen) return;
    store.set("dragging", true);
    const contact = /^(goal\.edges|initial\.edges|goal\.points)/.test(chosen.shape.id);
    const others = this.shapes.filter(
      ({ id }) => id !== chosen.shape.id && !id.startsWith("robot"),
    ).flatMap((shape) => shape.points);
    const levels = place === null ? others : [...others, ...points.filter((_, other) => other !== place)];
    const held = points[place ?? 0];
    const wanted = [held[0] + point[0] - from[0], held[1] + point[1] - from[1]];
    const to = snapped(
      wanted, this.view, store, { contact: contact && place !== null, others, levels, off },
    );
    const paths = place === null ? wholeOf(store.get("task"), chosen.shape) : [chosen.shape.paths[place]];
    const present = chosen.shape.points[place ?? 0];
    const by = [to.point[0] - present[0], to.point[1] - present[1]];
    store.edit(`move ${chosen.shape.label}`, (task) => moveBy(task, paths, by), gesture);
    this.drawDraft(to);
  }

  up(event) {
    this.pointers.delete(event.pointerId);
    this.drag = null;
    this.store.set("dragging", false);
    if (this.store.get("tool") === "select") this.drawDraft();
  }

  pinch() {
    this.drag = null;
    const [a, b] = [...this.pointers.values()];
    this.spread = Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
  }

  pinched(event) {
    this.pointers.set(event.pointerId, event);
    const [a, b] = [...this.pointers.values()];
    const spread = Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
    const middle = { clientX: (a.clientX + b.clientX) / 2, clientY: (a.clientY + b.clientY) / 2 };
    if (spread > 0) this.view.zoom(this.spread / spread, this.view.at(middle));
    this.spread = spread;
  }

  snap(point, off) {
    const { contact = false } = TOOLS[this.store.get("tool")];
    return snapped(
      point, this.view, this.store,
      { contact, off, others: [...this.draft, ...this.shapes.flatMap(({ points }) => points)] },
    );
  }

  click(event) {
    const tool = TOOLS[this.store.get("tool")];
    const to = this.snap(this.view.at(event), event.altKey);
    const { point } = to;
    const last = this.draft.at(-1);
    if (last && last[0] === tidy(point[0]) && last[1] === tidy(point[1])) {
      const edge = tool.contact && tool.points === 2 ? edgeAt(point, this.view, this.store) : null;
      if (!edge) return;
      this.draft = [edge.from, edge.to].map((end) => end.map(tidy)); // twice on an edge: all of it
      return this.finish(event);
    }
    const first = this.draft[0];
    if (
      tool.points === Infinity && first && this.draft.length >= tool.least
      && first[0] === tidy(point[0]) && first[1] === tidy(point[1])
    ) return this.finish(event);
    this.draft.push(point.map(tidy));
    this.drawDraft(to);
    if (this.draft.length >= tool.points) this.finish(event);
  }

  finish(event = null) {
    const { store } = this;
    this.finished = event?.timeStamp ?? -Infinity;
    const name = store.get("tool");
    const { make, least = 1, words } = TOOLS[name];
    const points = this.draft;
    if (points.length < least) return store.set("announce", `That takes ${least} points or more.`);
    const space = store.get("space");
    const context = { selected: store.get("selected")?.id, start: space ? anchor(space) : [0, 0] };
    store.edit(words.toLowerCase(), (task) => make(task, points, context));
    this.hover = null;
    store.set("tool", "select");
  }

  doubled(event) {
    if (this.store.get("tool") !== "select") return this.draft.length && this.finish();
    const chosen = this.selected;
    if (!chosen || event.target.dataset?.vertex !== undefined) return;
    if (event.timeStamp - this.finished < DOUBLE_MS) return; // the double click that ended a drawing
    const point = this.view.at(event);
    const { shape } = chosen;
    let [best, least] = [0, Infinity];
    shape.points.forEach((from, place) => {
      if (!shape.closed && place === shape.points.length - 1) return;
      const on = projected(point, from, shape.points[(place + 1) % shape.points.length]);
      const away = Math.hypot(on[0] - point[0], on[1] - point[1]);
      if (away < least) [best, least] = [place, away];
    });
    if (least < 12 * this.view.scale) this.store.edit(
      "insert a vertex", (task) => void insertVertex(task, shape, best, point),
    );
  }

  // --- keys ------------------------------------------------------------------------------------

  key(event) {
    const typing = event.target.matches?.("input, select, textarea") || document.querySelector("dialog[open]");
    const control = event.ctrlKey || event.metaKey;
    if (control && event.key.toLowerCase() === "z" && !typing) return this.done(
      event, () => (event.shiftKey ? this.store.redo() : this.store.undo()),
    );
    if (
      control && event.key.toLowerCase() === "y" && !typing
    ) return this.done(event, () => this.store.redo());
    if (typing || control || this.store.get("game")) return;
    const step = (event.shiftKey ? 1 : 0.1) * gridStep(this.view);
    const ways = {
      ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step],
    };
    const inDrawing = this.view.element.contains(event.target) || event.target === document.body;
    if (ways[event.key] && inDrawing) return this.done(event, () => this.nudge(ways[event.key]));
    const actions = {
      Delete: () => this.remove(), Backspace: () => this.remove(), Insert: () => this.insert(),
      Enter: () => this.draft.length && this.finish(), Escape: () => {
        this.hover = null;
        this.store.set("tool", "select");
        this.select(null);
      },
      "+": () => this.view.zoom(0.8), "-": () => this.view.zoom(1.25), 0: () => this.view.home(),
      "?": () => document.getElementById("keys").showModal(),
    };
    if (
      actions[event.key] && (inDrawing || ["Escape", "?"].includes(event.key))
    ) this.done(event, actions[event.key]);
  }

  done(event, action) {
    event.preventDefault();
    action();
  }

  nudge(by) {
    const chosen = this.selected;
    if (!chosen) return this.view.pan(...by);
    const { shape, vertex } = chosen;
    const paths = vertex === null ? wholeOf(this.store.get("task"), shape) : [shape.paths[vertex]];
    this.store.edit(`move ${shape.label}`, (task) => moveBy(task, paths, by), `nudge ${shape.id}`);
  }

  remove() {
    const chosen = this.selected;
    if (!chosen) return;
    const { shape, vertex } = chosen;
    const remove = (task) => void (
      vertex === null ? removeShape(task, shape) : removeVertex(task, shape, vertex)
    );
    this.select(null);
    this.store.edit(`remove ${vertex === null ? "" : "a vertex of "}${shape.label}`, remove);
  }

  insert() {
    const chosen = this.selected;
    if (chosen) this.store.edit(
      "insert a vertex", (task) => void insertVertex(task, chosen.shape, chosen.vertex ?? 0),
    );
  }
}

/** Whether a refusal speaks of a shape: `obstacles[2].polygon` of the third obstacle. */
function refused(where, shape) {
  const key = where.replaceAll("[", ".").replaceAll("]", "");
  return key !== "" && (shape.id.startsWith(key) || key.startsWith(`${shape.id}.`) || key === shape.id);
}

