// The plan carried out under adversaries that one chooses; where the robot is, and what it knows.

import { Latest, ask } from "./ask.js";
import { anchor, refusalOf, robotAt } from "./drawing.js";
import { Transport, instantOf } from "./player.js";
import { clearRun, drawInstant, drawWay, legendOf, roundly } from "./showing.js";
import { html } from "./svg.js";

const NEAR_PIXELS = 16;

export function mount({ store, view }) {
  new Running(store, view).mount();
}

class Running {
  constructor(store, view) {
    Object.assign(
      this, { store, view, latest: new Latest(), many: new Latest(), run: null, start: null },
    );
    this.transport = new Transport((time) => this.show(time));
  }

  mount() {
    const { store } = this;
    const panel = document.getElementById("panel-run");
    this.control = html(
      "select",
      { id: "run-control", "aria-describedby": "run-control-words", onchange: () => this.describe() },
    );
    this.sensing = html(
      "select",
      { id: "run-sensing", "aria-describedby": "run-sensing-words", onchange: () => this.describe() },
    );
    this.words = ["run-control-words", "run-sensing-words"].map(
      (id) => html("p", { class: "faded", id }),
    );
    const axis = (name) => html("input", {
      type: "number", id: `run-${name}`, step: "any", "aria-label": `start, ${name}`, placeholder: "as planned",
      onchange: () => this.typed(),
    });
    this.from = [axis("x"), axis("y")];
    this.number = html(
      "input", { type: "number", id: "run-number", value: 0, min: 0, max: 2000, step: 1 },
    );
    this.truth = html("select", { id: "run-view", onchange: () => this.show(this.transport.time) },
      html("option", { value: "both" }, "both"), html(
        "option", { value: "knows" }, "what it knows",
      ), html("option", { value: "is" }, "where it is"));
    this.says = html("p", { id: "run-says", "aria-live": "off" });
    this.outcome = html("p", { id: "run-outcome", role: "status" });
    this.counts = html("div", { id: "runs-result", "aria-live": "polite" });
    this.cancel = html(
      "button",
      { type: "button", id: "runs-cancel", hidden: true, onclick: () => this.many.cancel() },
      "Cancel",
    );
    panel.append(
      html(
        "p", { class: "faded" },
        "Nature chooses every error within its bounds. Drag the robot in the drawing to " +
          "another start, or type one.",
      ),
      html("label", { class: "field" }, "its motion", this.control), this.words[0],
      html("label", { class: "field" }, "its senses", this.sensing), this.words[1],
      html("div", { class: "field" }, "from x, y", html("span", { class: "pair" }, ...this.from)),
      html("label", { class: "field" }, "run number", this.number),
      html("label", { class: "field" }, "show", this.truth),
      html("div", { class: "row" },
        html(
          "button", { type: "button", id: "run", class: "primary", onclick: () => this.once() },
          "Run",
        ),
        html(
          "button", { type: "button", id: "runs", onclick: () => this.often() },
          "Run 100 times under each",
        ), this.cancel),
      this.transport.element, this.says, this.outcome, this.counts,
      legendOf("truth", "actual", "command", "measured", "force", "aim", "way"));
    store.on("tab", (tab) => tab === "run" ? this.entered() : this.left());
    store.on("plan", () => { this.forget(); if (store.get("tab") === "run") this.entered(); });
    this.dragStart();
  }

  async entered() {
    try {
      this.known ??= ask("adversaries", {}).then((found) => this.choices(found));
      await this.known;
    } catch (error) {
      this.known = null;
      this.failed(error);
      return;
    }
    if (this.store.get("tab") !== "run") return;
    if (this.run) this.begin(this.store.get("plan"));
    else if (this.store.get("plan")?.status === "solved") this.once();
    else this.outcome.textContent = "There is no plan to run: plan first (Ctrl+Enter).";
  }

  /** Fill the lists of adversaries, once. */
  choices({ control, sensing }) {
    const lists = [[this.control, control, "hunting"], [this.sensing, sensing, "towards"]];
    for (const [select, list, usual] of lists) {
      select.append(...list.map(({ name, words }) => (
        html("option", { value: name, selected: name === usual, title: words }, name))));
      this.explained = {
        ...this.explained, [select.id]: new Map(list.map(({ name, words }) => [name, words])),
      };
    }
    this.describe();
  }

  /** What the adversaries that are chosen do. */
  describe() {
    [this.control, this.sensing].forEach((select, place) => {
      this.words[place].textContent = this.explained[select.id].get(select.value) ?? "";
    });
  }

  /** Another start in numbers; none, if one is missing. */
  typed() {
    const place = this.from.map(({ valueAsNumber }) => valueAsNumber);
    this.start = place.every(Number.isFinite) ? place : null;
    this.once();
  }

  left() {
    this.transport.pause();
    if (this.run) this.redraw();
  }

  redraw() {
    const space = this.store.get("space");
    clearRun(this.view);
    this.store.set("highlight", null);
    if (space) this.view.draw("robot", ...robotAt(space, anchor(space)));
  }

  forget() {
    this.latest.cancel();
    this.many.cancel();
    this.run = this.start = this.at = null;
    this.transport.clear();
    this.says.textContent = this.outcome.textContent = "";
    this.counts.replaceChildren();
    for (const input of this.from) input.value = "";
    this.redraw();
  }

  async once() {
    const plan = this.store.get("plan");
    if (plan?.status !== "solved") return;
    const body = {
      plan: plan.plan, control: this.control.value || "hunting",
      sensing: this.sensing.value || "towards", number: this.number.valueAsNumber || 0,
    };
    try {
      this.run = await this.latest.ask("run", this.start ? { ...body, start: this.start } : body);
      if (this.store.get("tab") === "run") this.begin(plan);
    } catch (error) {
      if (error.name === "AbortError") return;
      this.run = null;
      this.transport.clear();
      this.redraw();
      this.says.textContent = "";
      this.failed(error);
    }
  }

  begin(plan) {
    const { legs, words, good, time } = this.run;
    this.outcome.className = good ? "good" : "bad";
    this.outcome.textContent = legs.length ? "" : `It ended ${words}, without a motion.`;
    drawWay(this.view, legs, plan);
    if (legs.length) this.transport.load(time);
    else this.transport.clear();
  }

  failed(error) {
    if (error.name === "AbortError") return;
    const { where, words } = refusalOf(error);
    this.outcome.textContent = [where, words].filter(Boolean).join(": ");
    this.outcome.className = "bad";
  }

  show(time) {
    const { run, store, view } = this;
    const space = store.get("space");
    if (!run?.legs.length || !space || store.get("tab") !== "run") return;
    const now = instantOf(run.legs, time);
    this.at = now.place;
    const mode = this.truth.value;
    const shown = mode === "is" ? { ...now, measured: null, force: null } : {
      ...now, actual: mode === "knows" ? null : now.actual,
    };
    drawInstant(view, space, shown, { truth: mode !== "knows", errors: space.task.uncertainty });
    const plan = store.get("plan");
    const region = plan.regions.find(({ id }) => id === now.leg.region);
    if (
      store.get("highlight")?.[0] !== region?.target
    ) store.set("highlight", region ? [region.target] : null);
    const felt = now.force === null ? "no force" : `a force from ${roundly(now.force)}`;
    const seen = now.measured?.map((value) => value.toPrecision(4)).join(", ");
    const read = seen ? `(${seen})` : "no position";
    const told = Number(now.direction.toFixed(2));
    this.says.textContent =
      `Motion ${now.number + 1} of ${run.legs.length}: told ${told}°. It reads ${read} and ${felt}.`;
    const over = time >= run.time;
    this.outcome.className = run.good ? "good" : "bad";
    this.outcome.textContent = over ? `It ended ${run.words}.` : "";
  }

  async often() {
    const plan = this.store.get("plan");
    if (plan?.status !== "solved") return;
    const asked = this.asked = Symbol("runs");
    this.cancel.hidden = false;
    try {
      const found = await this.many.ask("runs", { plan: plan.plan, runs: 100 }, {
        progress: ({ done, total }) => { this.counts.textContent = `${done} of ${total} runs`; },
      });
      const rows = found.pairs.filter(({ failures }) => failures).slice(0, 12);
      this.counts.replaceChildren(
        html(
          "p", { id: "runs-verdict", class: found.failures ? "bad" : "good" },
          `${found.runs} runs under ${found.pairs.length} pairs of adversaries: ${found.failures ? `${found.failures} failed` : "all ended in the goal, and knew it"}.`,
        ),
        rows.length ? html(
          "table", {},
          ...rows.map(
            (row) => html(
              "tr", {}, html("td", {}, row.control), html("td", {}, row.sensing),
              html("td", {}, `${row.failures} of ${row.runs}`),
            ),
          ),
        ) : "");
    } catch (error) {
      if (this.asked !== asked) return;
      this.counts.replaceChildren();
      this.failed(error);
    }
    if (this.asked === asked) this.cancel.hidden = true;
  }

  /** While this tab is shown, the robot itself can be dragged to another start. */
  dragStart() {
    const { element } = this.view;
    element.addEventListener("pointerdown", (event) => {
      if (this.store.get("tab") !== "run" || event.button !== 0 || !this.store.get("space")) return;
      const shape = event.target.dataset?.shape ?? "";
      const isStart = shape.startsWith("initial") || shape.startsWith("robot");
      if (!isStart && !this.isAtRobot(event)) return;
      event.stopImmediatePropagation();
      element.setPointerCapture(event.pointerId);
      this.transport.pause();
      const space = this.store.get("space");
      const move = (moved) => {
        this.start = this.view.at(moved);
        this.view.draw("robot", ...robotAt(space, this.start));
        this.from.forEach((input, axis) => { input.value = Number(this.start[axis].toPrecision(4)); });
      };
      const up = () => {
        element.removeEventListener("pointermove", move);
        for (const kind of ["pointerup", "pointercancel"]) element.removeEventListener(kind, up);
        this.once();
      };
      element.addEventListener("pointermove", move);
      for (const kind of ["pointerup", "pointercancel"]) element.addEventListener(kind, up);
    }, { capture: true });
  }

  /** Whether a pointer is at the robot that is drawn. */
  isAtRobot(event) {
    const place = this.at ?? this.start ?? anchor(this.store.get("space"));
    const [x, y] = this.view.at(event);
    return Math.hypot(x - place[0], y - place[1]) < NEAR_PIXELS * this.view.scale;
  }
}
