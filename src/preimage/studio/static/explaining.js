// Why there is no plan, or no shorter one; what nature does; and how much slack a plan has.

import { Latest } from "./ask.js";
import { anchor, refusalOf, robotAt } from "./drawing.js";
import { Transport } from "./player.js";
import { html, linePath, svg } from "./svg.js";

export function mount({ store, view }) {
  new Why(store, view).mount();
}

class Why {
  constructor(store, view) {
    Object.assign(this, { store, view, latest: new Latest(), way: null });
    this.transport = new Transport((time) => this.show(time), { id: "counter" });
  }

  mount() {
    const { store } = this;
    const panel = document.getElementById("panel-why");
    this.result = html("div", { id: "why-result", "aria-live": "polite" });
    this.cancel = html(
      "button",
      { type: "button", id: "why-cancel", hidden: true, onclick: () => this.latest.cancel() },
      "Cancel",
    );
    this.now = html("p", { class: "faded", role: "status" });
    panel.append(
      html("p", { class: "faded" }, "What stands in the way of a plan, or of a shorter one."),
      html("div", { class: "row" },
        html(
          "button",
          { type: "button", id: "why", class: "primary", onclick: () => this.explain(false) },
          "Why?",
        ),
        html(
          "button", { type: "button", id: "why-changes", onclick: () => this.explain(true) },
          "What would help?",
        ),
        html(
          "button", { type: "button", id: "margins", onclick: () => this.margins() },
          "How much slack?",
        ), this.cancel),
      this.now, this.transport.element, this.result);
    store.on("task", () => this.clear());
    store.on("tab", (tab) => (tab === "why" ? this.enter() : this.leave()));
  }

  async asked(question, body, show) {
    this.clear();
    const round = this.round = Symbol("question");
    this.cancel.hidden = false;
    this.now.textContent = "working …";
    try {
      const found = await this.latest.ask(
        question, body,
        { progress: ({ done, total }) => { this.now.textContent = `${done} of ${total} plans`; } },
      );
      this.result.replaceChildren(...show(found).filter(Boolean));
      this.now.textContent = "";
    } catch (error) {
      if (this.round !== round) return;
      const { where, words } = refusalOf(error);
      const refused = [where, words].filter(Boolean).join(": ");
      this.now.textContent = error.name === "AbortError" ? "taken back" : refused;
    }
    if (this.round === round) this.cancel.hidden = true;
  }

  explain(budgeted) {
    return this.asked("explain", { task: this.store.get("task"), budgeted }, (found) => {
      if (!this.store.get("plan")) this.store.set("plan", found.plan);
      this.store.set("highlight", [found.remaining]);
      this.way = found.counter?.places.length > 1 ? found.counter.places : null;
      if (this.way) this.transport.load(lengthOf(this.way));
      return [
        html("p", { id: "why-head" }, html("strong", {}, found.words[0])),
        ...found.reasons.map((reason) => this.reason(reason)),
        found.counter && html("p", { id: "why-nature" }, `Nature: ${found.counter.words}.`),
        found.changes.length ? html("h3", {}, "What would help, the least change first") : null,
        found.changes.length ? html(
          "table", { id: "why-changes-table" }, ...found.changes.map((one) => this.change(one)),
        ) : null,
        html(
          "details", {}, html("summary", {}, "In words"),
          html("div", { class: "words" }, found.words.join("\n")),
        ),
      ];
    });
  }

  reason(reason) {
    const point = () => {
      const edges = reason.features.filter((shape) => shape.length === 2).map(([a, b]) => [...a, ...b]);
      const vertices = [
        ...reason.features.filter((shape) => shape.length === 1).map(([a]) => a),
        ...(reason.place ? [reason.place] : []), ...(reason.origin ? [reason.origin] : [])
      ];
      this.store.set("highlight", [{ area: [], edges, vertices }]);
      if (reason.direction !== null) this.store.set("direction", reason.direction);
    };
    return html(
      "button",
      { type: "button", class: "reason", "data-kind": reason.kind, onclick: point, onfocus: point },
      reason.words,
    );
  }

  change({ key, bound, words, needed, motions }) {
    const apply = needed === null ? "" : html(
      "button",
      { type: "button", "data-bound": bound, onclick: () => setBound(this.store, key, needed) },
      "Set",
    );
    return html(
      "tr", {}, html("td", {}, key),
      html("td", {}, motions === null ? words : `${words}: ${motions} motions`),
      html("td", {}, apply),
    );
  }

  async margins() {
    const plan = this.store.get("plan");
    if (plan?.status !== "solved") { this.now.textContent = "There is no plan: plan first."; return; }
    await this.asked("margins", { plan: plan.plan }, (found) => [
      html(
        "p", {},
        html(
          "strong", {},
          `In units of the bounds it widens, the least is ${found.least?.toPrecision(3) ?? "unbounded"}.`,
        ),
      ),
      html("table", { id: "margins-table" }, ...found.entries.map(({ name, words, value, known, unbounded }) => html("tr", {
        tabindex: 0, onclick: () => this.pointTo(name), onfocus: () => this.pointTo(name),
      }, html("td", {}, words), html(
        "td", {}, !known ? "not known" : unbounded ? "any" : value.toPrecision(3),
      )))),
    ]);
  }

  /** Where a margin is to be seen. */
  pointTo(name) {
    const plan = this.store.get("plan");
    const first = plan.regions.find(({ id }) => id === plan.start[0]);
    const shown = {
      start: [first?.region], reading: plan.regions.map(({ target }) => target),
      force: plan.regions.map(({ target }) => target),
      direction: plan.regions.map(({ region }) => region),
    }[name];
    this.store.set("highlight", (shown ?? []).filter(Boolean));
  }

  /** The way on which nature keeps the robot from the goal. */
  show(time) {
    if (!this.way || this.store.get("tab") !== "why") return;
    const space = this.store.get("space");
    const at = along(this.way, time);
    this.view.draw("trace", svg("path", { class: "way", d: linePath(this.way) }));
    this.view.draw("robot", ...robotAt(space, at));
  }

  clear() {
    this.latest.cancel();
    this.round = null;
    this.cancel.hidden = true;
    this.leave();
    this.way = null;
    this.result.replaceChildren();
    this.now.textContent = "";
  }

  enter() {
    if (this.way) this.transport.load(lengthOf(this.way));
  }

  leave() {
    this.transport.clear();
    if (this.result.childElementCount) this.store.set("highlight", null);
    if (!this.way) return;
    this.view.draw("trace");
    const space = this.store.get("space");
    if (space) this.view.draw("robot", ...robotAt(space, anchor(space)));
  }
}

/** Set a bound by its place in the task file. */
export function setBound(store, key, value) {
  store.edit(`set ${key}`, (task) => {
    const path = key.split(".");
    const home = path.slice(0, -1).reduce((inner, word) => inner[word], task);
    home[path.at(-1)] = value;
  });
}

const lengthOf = (way) => way.reduce(
  (sum, [x, y], place) => sum + (place ? Math.hypot(x - way[place - 1][0], y - way[place - 1][1]) : 0),
  0,
);

function along(way, distance) {
  let left = distance;
  for (let place = 1; place < way.length; place += 1) {
    const [from, to] = [way[place - 1], way[place]];
    const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
    if (left <= length && length > 0) return from.map(
      (value, axis) => value + ((to[axis] - value) * left) / length,
    );
    left -= length;
  }
  return way.at(-1);
}
