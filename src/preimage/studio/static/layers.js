// One motion looked at closely: what features do, what is aimed at, from where it is reached.

import { ask } from "./ask.js";
import { refusalOf, spokenName } from "./drawing.js";
import { mountGraph } from "./graph.js";
import { Sweep } from "./sweep.js";
import { dot, html, linePath, regionElements, segmentsPath, svg, unit } from "./svg.js";

const FAN = 26;

const WORDS = {
  sticks: "sticks for sure", "may stick": "may stick, slide or leave", slides: "slides for sure",
  "slides off": "slides or leaves", leaves: "leaves, or is never met",
};

/** The layers, whether they are shown at first, and what they are called. */
const LAYERS = {
  fans: [false, "forces felt at edges"],
  backprojection: [true, "backprojection"],
  rays: [true, "its bounding rays"],
  kernel: [true, "kernel"],
  sticking: [true, "goal where it sticks"],
  preimage: [false, "preimage"],
};

export function mount({ store, view }) {
  new Layers(store, view).mount();
}

class Layers {
  constructor(store, view) {
    Object.assign(this, { store, view, asking: false, again: false });
    this.shown = Object.fromEntries(Object.entries(LAYERS).map(([name, [on]]) => [name, on]));
    this.sweep = new Sweep(view);
  }

  mount() {
    const { store } = this;
    const panel = document.getElementById("panel-layers");
    this.number = html(
      "input",
      {
        type: "number", id: "direction", step: 0.5, "aria-label": "Direction in degrees",
        onchange: () => store.set("direction", wrapped(this.number.valueAsNumber || 0)),
      },
    );
    this.goal = html(
      "select", { id: "stage-goal", onchange: () => store.set("goal", Number(this.goal.value)) },
    );
    this.says = html(
      "p", { id: "feature-says", role: "status", class: "faded" },
      "Point at an edge: here is said what it does.",
    );
    this.words = html("div", { id: "stage-words", "aria-live": "polite" });
    panel.append(
      html("div", { class: "row" }, html("span", {}, "commanded direction"), this.number, "°"),
      this.compass(),
      html("label", { class: "field" }, "towards", this.goal),
      this.legend(), this.says, this.words, html(
        "h3", {}, "The sweep, step by step",
      ), this.sweep.element, html("h3", {}, "The plan as a graph"), mountGraph(store));
    store.set("direction", 270);
    store.set("goal", 0);
    for (const key of ["direction", "goal", "space"]) store.on(key, () => this.refresh());
    store.on("plan", (plan) => { this.fillGoals(); this.lookAt(plan); this.refresh(); });
    store.on("tab", (tab) => tab === "layers" ? this.refresh() : this.clear());
    store.on("stage", () => this.draw());
    this.view.addEventListener("changed", () => store.get("tab") === "layers" && this.drawFans());
  }

  compass() {
    this.needle = svg("path", { class: "needle" });
    this.cone = svg("path", { class: "cone" });
    this.fans = svg("g");
    const dial = svg("svg", {
      id: "compass", viewBox: "-1.25 -1.25 2.5 2.5", role: "slider", tabindex: 0,
      "aria-label": "Commanded direction", "aria-valuemin": 0, "aria-valuemax": 360 },
      svg("circle", { class: "rim", r: 1 }), this.fans, this.cone, this.needle);
    const take = (event) => {
      if (!event.buttons) return;
      const { left, top, width, height } = dial.getBoundingClientRect();
      const [x, y] = [event.clientX - left - width / 2, top + height / 2 - event.clientY];
      const degrees = (Math.atan2(y, x) * 180) / Math.PI;
      this.store.set("direction", wrapped(Math.round(degrees / 2.5) * 2.5));
    };
    dial.addEventListener(
      "pointerdown", (event) => { dial.setPointerCapture(event.pointerId); take(event); },
    );
    dial.addEventListener("pointermove", take);
    dial.addEventListener("keydown", (event) => {
      const turn = { ArrowLeft: 1, ArrowUp: 1, ArrowRight: -1, ArrowDown: -1 }[event.key];
      if (!turn) return;
      event.preventDefault();
      event.stopPropagation();
      this.store.set(
        "direction", wrapped(this.store.get("direction") + turn * (event.shiftKey ? 15 : 1)),
      );
    });
    this.dial = dial;
    return dial;
  }

  legend() {
    const boxes = Object.entries(LAYERS).map(([name, [on, words]]) => {
      const box = html(
        "input",
        {
          type: "checkbox", id: `layer-${name}`, checked: on,
          onchange: () => { this.shown[name] = box.checked; this.draw(); },
        },
      );
      return html("li", {}, html("label", {}, box, html("span", { class: `swatch ${name}` }), words));
    });
    const roles = Object.entries(WORDS).map(
      ([role, words]) => html(
        "li", {}, html("label", {}, html("span", { class: "swatch", "data-role": role }), words),
      ),
    );
    return html("div", {},
      html("ul", { class: "legend", "aria-label": "Layers" }, ...boxes),
      html("h3", {}, "Under this motion an edge"),
      html("ul", { class: "legend", id: "roles", "aria-label": "What edges do" }, ...roles));
  }

  fillGoals() {
    const plan = this.store.get("plan");
    const regions = plan?.regions ?? [{ id: 0 }];
    this.goal.replaceChildren(
      ...regions.map(({ id }) => html("option", { value: id }, plan ? spokenName(plan, id) : "the goal")),
    );
    if (!regions.some(({ id }) => id === this.store.get("goal"))) this.store.set("goal", 0);
    this.goal.value = this.store.get("goal");
  }

  /** The motion that ends in the goal, first. */
  lookAt(plan) {
    const last = plan?.regions.find(({ direction, goals }) => direction !== null && goals.includes(0));
    if (
      !last || plan.regions.some(
        ({ direction, goals }) => direction === this.store.get("direction") && goals.includes(0),
      )
    ) return;
    this.store.set("goal", 0);
    this.store.set("direction", last.direction);
  }

  /** One question at a time, so that a drag sees answers; what changes meanwhile is asked next. */
  async refresh() {
    const { store } = this;
    if (store.get("tab") !== "layers" || !store.get("space") || store.get("refusal")) return;
    this.turnTo(store.get("direction"), store.get("task").uncertainty.control);
    this.goal.value = store.get("goal");
    this.again = this.asking;
    if (this.asking) return;
    this.asking = true;
    await this.ask();
    this.asking = false;
    if (this.again) this.refresh();
  }

  async ask() {
    const { store } = this;
    const [task, plan, goal] = [store.get("task"), store.get("plan"), store.get("goal")];
    const body = plan ? { plan: plan.plan, goal } : { task };
    const still = () => store.get("task") === task && store.get("plan") === plan;
    try {
      const stage = await ask("stage", { ...body, direction: store.get("direction") });
      if (still()) store.set("stage", stage);
    } catch (error) {
      if (!still()) return;
      store.set("stage", null);
      const { where, words } = refusalOf(error);
      const said = [where, words].filter(Boolean).join(": ");
      this.words.replaceChildren(html("p", { class: "bad" }, said));
    }
  }

  turnTo(degrees, control) {
    if (document.activeElement !== this.number) this.number.value = Number(degrees.toFixed(3));
    this.dial.setAttribute("aria-valuenow", Math.round(degrees));
    this.dial.setAttribute("aria-valuetext", `${Number(degrees.toFixed(2))} degrees`);
    const [x, y] = unit(degrees);
    this.needle.setAttribute("d", `M0 0L${x} ${-y}`);
    const rim = Array.from({ length: 9 }, (_, place) => unit(degrees + control * (place / 4 - 1)));
    this.cone.setAttribute("d", `M0 0L${rim.map(([u, v]) => `${u} ${-v}`).join("L")}Z`);
  }

  draw() {
    const { store, view, shown } = this;
    const [stage, space] = [store.get("stage"), store.get("space")];
    if (!stage || !space || store.get("tab") !== "layers") return this.clear();
    const on = (name, elements) => (shown[name] ? elements : []);
    view.draw(
      "backprojection", ...on("preimage", regionElements(stage.preimage, "preimage")),
      ...on("backprojection", regionElements(stage.backprojection, "backprojection")),
      ...on("kernel", regionElements(stage.kernel, "kernel", 5)),
      ...on("sticking", regionElements(stage.sticking, "sticking", 5)),
    );
    view.draw("rays", ...on("rays", [svg("path", { class: "ray", d: segmentsPath(stage.rays) })]));
    this.drawFeatures(stage, space);
    this.drawFans();
    this.words.replaceChildren(...stage.words.map((words) => html("p", {}, words)));
    this.sweep.load(stage, space);
  }

  drawFeatures(stage, space) {
    const edges = new Map(space.features.map((feature) => [feature.id, feature]));
    const corners = new Map(space.vertices.map((vertex) => [vertex.id, vertex]));
    const told = (element, feature, name) => {
      element.dataset.role = feature.role;
      const tell = () => { this.says.textContent = sentence(name, feature, stage, space.task); };
      element.addEventListener("pointerenter", tell);
      return element;
    };
    this.view.draw("features",
      ...stage.features.filter(({ id }) => edges.has(id)).map((feature) => {
        const { from, to } = edges.get(feature.id);
        return told(
          svg("path", { class: "feature", d: linePath([from, to]) }), feature,
          `The edge ${pair(from)} to ${pair(to)}`,
        );
      }),
      ...stage.vertices.filter(({ id }) => corners.has(id)).map((feature) => {
        const { at, concave } = corners.get(feature.id);
        return told(
          dot(...at, "feature", 4), feature,
          `The ${concave ? "concave" : "convex"} vertex ${pair(at)}`,
        );
      }));
  }

  /** At the middle of each edge, the directions in which it may be felt to push. */
  drawFans() {
    const { store, view } = this;
    const [stage, space] = [store.get("stage"), store.get("space")];
    if (!stage || !space) return;
    const felt = stage.features.filter(({ reads }) => reads.from !== null);
    this.fans.replaceChildren(...felt.map(({ reads, role }) => {
      const fan = svg("path", { class: "fan", d: fanPath([0, 0], reads, 0.92, -1), "data-role": role });
      fan.style.fill = fan.style.stroke = `var(--colour)`;
      return fan;
    }));
    for (const fan of view.layer("rays").querySelectorAll(".fan")) fan.remove();
    if (!this.shown.fans) return;
    const edges = new Map(space.features.map((feature) => [feature.id, feature]));
    const fans = stage.features.filter(
      ({ id, reads }) => edges.has(id) && reads.from !== null,
    ).map(({ id, reads, role }) => {
      const { from, to } = edges.get(id);
      const middle = [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2];
      const fan = svg(
        "path", { class: "fan", d: fanPath(middle, reads, FAN * view.scale, 1), "data-role": role },
      );
      fan.style.setProperty("fill", "var(--colour)", "important");
      fan.style.stroke = "var(--colour)";
      return fan;
    });
    view.layer("rays").append(...fans);
  }

  clear() {
    for (const name of ["backprojection", "rays", "features"]) this.view.draw(name);
    this.sweep.clear();
  }
}

const wrapped = (degrees) => ((degrees % 360) + 360) % 360;
const pair = ([x, y]) => `(${Number(x.toPrecision(5))}, ${Number(y.toPrecision(5))})`;

function fanPath([x, y], { from, to }, radius, up) {
  const width = wrapped(to - from);
  const rim = Array.from({ length: 13 }, (_, place) => unit(from + (width * place) / 12));
  return `M${x} ${y}L${rim.map(([u, v]) => `${x + radius * u} ${y + up * radius * v}`).join("L")}Z`;
}

/** What a feature does to the motion, and why. */
function sentence(name, { role, off, reads }, stage, task) {
  const [control, friction] = [task.uncertainty.control, task.friction];
  const bounds = `friction ${friction}°, control ±${control}°`;
  const turned = off === null ? "" : `its normal is ${Math.abs(off).toFixed(1)}° from the way back`;
  const why = turned && `: ${turned}; ${bounds}`;
  const felt = reads.from === null ? [] : [
    `a force between ${Math.round(wrapped(reads.from))}° and ${Math.round(wrapped(reads.to))}°`,
  ];
  if (reads.zero) felt.push("none");
  return `${name} ${WORDS[role]}${why}. Felt there: ${felt.join(", or ") || "nothing"}.`;
}

