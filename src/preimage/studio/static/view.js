// The drawing: an SVG whose groups are layers, zoomed and panned; y is up, as in task files.

import { svg } from "./svg.js";

const CLOSEST = 1e-4;
const FURTHEST = 10;

/** The layers, from the bottom to the top. */
export const LAYERS = [
  "ground", "grid", "space", "workspace", "preimages", "backprojection", "target", "features",
  "rays", "start", "goal", "trace", "robot", "reading", "handles", "labels",
];

/**
 * A viewport on the plane.
 *
 * Layers hold shapes in the task's units; strokes keep their width. `labels` is in pixels: who puts
 * something there listens to `changed`.
 */
export class View extends EventTarget {
  #box = [-10, -10, 20, 20];
  #home = [-10, -10, 20, 20];
  #layers = new Map();

  constructor(element) {
    super();
    this.element = element;
    this.plane = svg("g", { class: "plane" });
    this.pixels = svg("g", { class: "pixels" });
    element.replaceChildren(this.plane, this.pixels);
    for (const name of LAYERS) {
      const group = svg("g", { class: `layer ${name}`, "data-layer": name });
      this.#layers.set(name, group);
      (name === "labels" ? this.pixels : this.plane).append(group);
    }
    new ResizeObserver(() => this.#place()).observe(element);
    element.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
  }

  layer(name) {
    return this.#layers.get(name);
  }

  /** Replace what a layer shows. */
  draw(name, ...elements) {
    this.layer(name).replaceChildren(...elements);
  }

  /** Units a pixel. */
  get scale() {
    const { width, height } = this.#size();
    return Math.max(this.#box[2] / width, this.#box[3] / height);
  }

  /** Show a window `[xmin, ymin, xmax, ymax]` whole; where the view goes home to. */
  fit([xmin, ymin, xmax, ymax]) {
    const margin = 0.06 * Math.max(xmax - xmin, ymax - ymin);
    this.#home = [xmin - margin, ymin - margin, xmax - xmin + 2 * margin, ymax - ymin + 2 * margin];
    this.home();
  }

  home() {
    this.#box = [...this.#home];
    this.#place();
  }

  /** Zoom by a factor about a point of the plane; the middle by default. */
  zoom(factor, about = this.middle()) {
    const width = this.#box[2] * factor;
    if (width < CLOSEST * this.#home[2] || width > FURTHEST * this.#home[2]) return;
    this.#box = [
      about[0] + (this.#box[0] - about[0]) * factor,
      about[1] + (this.#box[1] - about[1]) * factor,
      width,
      this.#box[3] * factor,
    ];
    this.#place();
  }

  /** Move what is seen, by units of the plane. */
  pan(dx, dy) {
    this.#box[0] += dx;
    this.#box[1] += dy;
    this.#place();
  }

  middle() {
    return [this.#box[0] + this.#box[2] / 2, this.#box[1] + this.#box[3] / 2];
  }

  /** The point of the plane below a pointer event. */
  at(event) {
    const { left, top } = this.element.getBoundingClientRect();
    return this.fromPixel([event.clientX - left, event.clientY - top]);
  }

  fromPixel([px, py]) {
    const { width, height } = this.#size();
    const [cx, cy] = this.middle();
    return [cx + (px - width / 2) * this.scale, cy - (py - height / 2) * this.scale];
  }

  toPixel([x, y]) {
    const { width, height } = this.#size();
    const [cx, cy] = this.middle();
    return [width / 2 + (x - cx) / this.scale, height / 2 - (y - cy) / this.scale];
  }

  #size() {
    const { width, height } = this.element.getBoundingClientRect();
    return { width: Math.max(width, 1), height: Math.max(height, 1) };
  }

  #place() {
    const [x, y] = this.toPixel([0, 0]);
    const k = 1 / this.scale;
    this.plane.setAttribute("transform", `matrix(${k} 0 0 ${-k} ${x} ${y})`);
    this.dispatchEvent(new Event("changed"));
  }

  #wheel(event) {
    event.preventDefault();
    this.zoom(Math.exp(0.0015 * Math.max(-200, Math.min(200, event.deltaY))), this.at(event));
  }
}
