// The plan carried out under adversaries that one chooses; where the robot is, and what it knows.

import { Latest, ask } from "./ask.js";
import { anchor, refusalOf, robotAt } from "./drawing.js";
import { Transport, instantOf } from "./player.js";
import { clearRun, drawInstant, drawWay } from "./showing.js";
import { html } from "./svg.js";

export function mount({ store, view }) {
  new Running(store, view).mount();
}

class Running {
  constructor(store, view) {
    Object.assign(this, { store, view, latest: new Latest(), many: new Latest(), run: null, start: null });
    this.transport = new Transport((time) => this.show(time));
  }

  mount() {
    const { store } = this;
    const panel = document.getElementById("panel-run");
    this.control = html("select", { id: "run-control" });
    this.sensing = html("select", { id: "run-sensing" });
    this.number = html("input", { type: "number", id: "run-number", value: 0, min: 0, max: 2000, step: 1 });
    this.truth = html("select", { id: "run-view", onchange: () => this.show(this.transport.time) },
      html("option", { value: "both" }, "both"), html("option", { value: "knows" }, "what it knows"), html("option", { value: "is" }, "where it is"));
    this.says = html("p", { id: "run-says", "aria-live": "off" });
    this.outcome = html("p", { id: "run-outcome", role: "status" });
    this.counts = html("div", { id: "runs-result", "aria-live": "polite" });
    this.cancel = html("button", { type: "button", id: "runs-cancel", hidden: true, onclick: () => this.many.cancel() }, "Cancel");
    panel.append(
      html("p", { class: "faded" }, "Nature chooses every error within its bounds. Drag the robot in the drawing to another start."),
      html("label", { class: "field" }, "its motion", this.control),
      html("label", { class: "field" }, "its senses", this.sensing),
      html("label", { class: "field" }, "run number", this.number),
      html("label", { class: "field" }, "show", this.truth),
      html("div", { class: "row" },
        html("button", { type: "button", id: "run", class: "primary", onclick: () => this.once() }, "Run"),
        html("button", { type: "button", id: "runs", onclick: () => this.often() }, "Run 100 times under each"), this.cancel),
      this.transport.element, this.says, this.outcome, this.counts);
    store.on("tab", (tab) => tab === "run" ? this.entered() : this.left());
    store.on("plan", () => this.forget());
    this.dragStart();
  }

  async entered() {
    if (!this.control.options.length) {
      const { control, sensing } = await ask("adversaries", {});
      for (const [select, list, usual] of [[this.control, control, "hunting"], [this.sensing, sensing, "towards"]]) {
        select.append(...list.map(({ name, words }) => html("option", { value: name, selected: name === usual }, `${name}: ${words}`)));
      }
    }
    if (this.run) this.show(this.transport.time);
    else if (this.store.get("plan")?.status === "solved") this.once();
    else this.outcome.textContent = "There is no plan to run: plan first.";
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
    this.run = this.start = null;
    this.transport.clear();
    this.says.textContent = this.outcome.textContent = "";
    this.counts.replaceChildren();
    clearRun(this.view);
    this.redraw();
  }

  async once() {
    const plan = this.store.get("plan");
    if (plan?.status !== "solved") return;
    const body = { plan: plan.plan, control: this.control.value || "hunting", sensing: this.sensing.value || "towards", number: this.number.valueAsNumber || 0 };
    try {
      this.run = await this.latest.ask("run", this.start ? { ...body, start: this.start } : body);
      this.outcome.textContent = "";
      drawWay(this.view, this.run.legs, plan);
      this.transport.load(this.run.time);
    } catch (error) {
      this.failed(error);
    }
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
    const mode = this.truth.value;
    const shown = mode === "is" ? { ...now, measured: null, force: null } : { ...now, actual: mode === "knows" ? null : now.actual };
    drawInstant(view, space, shown, { truth: mode !== "knows", errors: space.task.uncertainty });
    const plan = store.get("plan");
    const region = plan.regions.find(({ id }) => id === now.leg.region);
    if (store.get("highlight")?.[0] !== region?.target) store.set("highlight", region ? [region.target] : null);
    const felt = now.force === null ? "no force" : `a force from ${Math.round(now.force)}°`;
    const read = now.measured ? `(${now.measured.map((value) => value.toPrecision(4)).join(", ")})` : "no position";
    this.says.textContent = `Motion ${now.number + 1} of ${run.legs.length}: told ${Number(now.direction.toFixed(2))}°. It reads ${read} and ${felt}.`;
    const over = time >= run.time;
    this.outcome.className = run.good ? "good" : "bad";
    this.outcome.textContent = over ? `It ended ${run.words}.` : "";
  }

  async often() {
    const plan = this.store.get("plan");
    if (plan?.status !== "solved") return;
    this.cancel.hidden = false;
    try {
      const found = await this.many.ask("runs", { plan: plan.plan, runs: 100 }, {
        progress: ({ done, total }) => { this.counts.textContent = `${done} of ${total} runs`; },
      });
      const rows = found.pairs.filter(({ failures }) => failures).slice(0, 12);
      this.counts.replaceChildren(
        html("p", { id: "runs-verdict", class: found.failures ? "bad" : "good" }, `${found.runs} runs under ${found.pairs.length} pairs of adversaries: ${found.failures ? `${found.failures} failed` : "all ended in the goal, and knew it"}.`),
        rows.length ? html("table", {}, ...rows.map((row) => html("tr", {}, html("td", {}, row.control), html("td", {}, row.sensing), html("td", {}, `${row.failures} of ${row.runs}`)))) : null);
    } catch (error) {
      this.counts.replaceChildren();
      this.failed(error);
    }
    this.cancel.hidden = true;
  }

  /** While this tab is shown, the robot itself can be dragged to another start. */
  dragStart() {
    const { element } = this.view;
    element.addEventListener("pointerdown", (event) => {
      if (this.store.get("tab") !== "run" || !event.target.closest?.("[data-layer=handles]")) return;
      const { shape } = event.target.dataset;
      if (!shape?.startsWith("initial") && !shape?.startsWith("robot")) return;
      event.stopImmediatePropagation();
      const space = this.store.get("space");
      const move = (moved) => {
        this.start = this.view.at(moved);
        this.view.draw("robot", ...robotAt(space, this.start));
      };
      const up = () => {
        element.removeEventListener("pointermove", move);
        this.once();
      };
      element.addEventListener("pointermove", move);
      element.addEventListener("pointerup", up, { once: true });
    }, { capture: true });
  }
}
