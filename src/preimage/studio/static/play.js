// The person is nature: turns the robot and its senses, and tries to beat the plan.

import { ask } from "./ask.js";
import { anchor, refusalOf, robotAt } from "./drawing.js";
import { clearRun, drawInstant } from "./showing.js";
import { html, linePath, svg } from "./svg.js";

const MOVES_A_SECOND = 14;
const CROSSING = 10;

export function mount({ store, view }) {
  new Play(store, view).mount();
}

class Play {
  constructor(store, view) {
    Object.assign(this, { store, view, moves: [], hand: { push: 0, x: 0, y: 0, tilt: 0 }, way: [], state: null, running: false });
  }

  mount() {
    const { store } = this;
    const panel = document.getElementById("panel-play");
    this.begin = html("button", { type: "button", id: "game-begin", class: "primary", onclick: () => this.start() }, "Begin");
    this.pauses = html("button", { type: "button", id: "game-pause", hidden: true, onclick: () => this.pause() }, "Pause");
    this.push = this.slider("game-push", "turn its motion (left, right)", "push");
    this.tilt = this.slider("game-tilt", "turn the force it feels", "tilt");
    this.cheat = html("select", { id: "game-cheat" },
      ...[["1", "no: within the bounds of the plan"], ["1.5", "one and a half times"], ["2", "twice"], ["3", "three times"]].map(([value, words]) => html("option", { value }, words)));
    this.pad = this.disc();
    this.says = html("p", { id: "game-says" });
    this.verdict = html("p", { id: "game-verdict", role: "status" });
    panel.append(
      html("p", {}, "You are nature. Turn the robot's motion within its control error, and what it reads within the errors of its sensors, while it moves. Make it believe that it is in the goal when it is not, or drive it out."),
      html("div", { class: "row" }, this.begin, this.pauses),
      this.push.row,
      html("p", { class: "faded" }, "Where it believes to be: drag in the disc, whose rim is the position error."),
      this.pad, this.tilt.row,
      html("label", { class: "field" }, "you cheat", this.cheat),
      html("p", { class: "faded" }, "Keys while it runs: ← → turn the motion, A D W S the position, Q E the force, Space pauses."),
      this.says, this.verdict);
    store.on("plan", () => this.reset());
    store.on("tab", (tab) => tab !== "play" && this.stop());
    document.addEventListener("keydown", (event) => this.key(event));
  }

  slider(id, words, name) {
    const input = html("input", { type: "range", id, min: -1, max: 1, step: 0.02, value: 0, oninput: () => { this.hand[name] = input.valueAsNumber; } });
    return { input, row: html("label", { class: "field" }, words, input) };
  }

  disc() {
    this.knob = svg("circle", { class: "knob", cx: 0, cy: 0, r: 0.09 });
    const pad = svg("svg", {
      id: "game-pad", viewBox: "-1.1 -1.1 2.2 2.2", role: "slider", tabindex: 0, "aria-label": "Error of the position that it reads",
      "aria-valuetext": "none",
    }, svg("circle", { class: "rim", r: 1 }), svg("path", { class: "cross", d: "M-1 0H1M0-1V1" }), this.knob);
    const take = (event) => {
      if (!event.buttons && event.type !== "pointerdown") return;
      const { left, top, width, height } = pad.getBoundingClientRect();
      this.offset(((event.clientX - left) / width - 0.5) * 2.2, -((event.clientY - top) / height - 0.5) * 2.2);
    };
    pad.addEventListener("pointerdown", (event) => { pad.setPointerCapture(event.pointerId); take(event); });
    pad.addEventListener("pointermove", take);
    return pad;
  }

  offset(x, y) {
    const size = Math.max(1, Math.hypot(x, y));
    Object.assign(this.hand, { x: x / size, y: y / size });
    this.knob.setAttribute("cx", this.hand.x);
    this.knob.setAttribute("cy", -this.hand.y);
    this.pad.setAttribute("aria-valuetext", `${this.hand.x.toFixed(1)}, ${this.hand.y.toFixed(1)} of the error`);
  }

  key(event) {
    if (!this.running || event.target.matches?.("input[type=number], select")) return;
    const turn = (name, by, slider) => {
      this.hand[name] = Math.max(-1, Math.min(1, this.hand[name] + by));
      if (slider) slider.input.value = this.hand[name];
    };
    const actions = {
      ArrowLeft: () => turn("push", 0.25, this.push), ArrowRight: () => turn("push", -0.25, this.push),
      a: () => this.offset(this.hand.x - 0.25, this.hand.y), d: () => this.offset(this.hand.x + 0.25, this.hand.y),
      w: () => this.offset(this.hand.x, this.hand.y + 0.25), s: () => this.offset(this.hand.x, this.hand.y - 0.25),
      q: () => turn("tilt", 0.25, this.tilt), e: () => turn("tilt", -0.25, this.tilt), " ": () => this.pause(),
    };
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    event.stopPropagation();
    action();
  }

  reset() {
    this.stop();
    this.state = null;
    this.says.textContent = this.verdict.textContent = "";
    this.begin.textContent = "Begin";
  }

  async start() {
    const plan = this.store.get("plan");
    if (plan?.status !== "solved") {
      this.verdict.textContent = "There is no plan to beat: plan first.";
      return;
    }
    Object.assign(this, { moves: [], way: [], running: true, paused: false });
    this.verdict.textContent = "";
    this.begin.textContent = "Begin again";
    this.pauses.hidden = false;
    this.store.set("game", true);
    const space = this.store.get("space");
    const factor = Number(this.cheat.value);
    const [x0, , x1] = space.window;
    const step = (x1 - x0) / CROSSING / MOVES_A_SECOND;
    const round = this.round = Symbol("round");
    const body = { plan: plan.plan, start: anchor(space), cheat: { control: factor, position: factor, force: factor } };
    try {
      while (this.running && this.round === round) {
        const began = performance.now();
        if (!this.paused) await this.move(body, step, space);
        if (this.state?.over) break;
        await new Promise((resolve) => setTimeout(resolve, Math.max(10, 1000 / MOVES_A_SECOND - (performance.now() - began))));
      }
    } catch (error) {
      const { where, words } = refusalOf(error);
      this.verdict.textContent = [where, words].filter(Boolean).join(": ");
    }
    if (this.round === round) this.finish();
  }

  async move(body, step, space) {
    const { push, x, y, tilt } = this.hand;
    this.moves.push([step, push, x, y, tilt].map((value) => Number(value.toFixed(6))));
    const state = await ask("play", { ...body, moves: this.moves });
    this.state = state;
    this.way.push(...state.places);
    this.view.draw("trace", svg("path", { class: "way", d: linePath(this.way) }));
    drawInstant(this.view, space, state, { errors: space.task.uncertainty });
    const felt = state.force === null ? "no force" : `a force from ${Math.round(state.force)}°`;
    this.says.textContent = state.direction === null ? state.words : `It is told ${Number(state.direction.toFixed(2))}° and feels ${felt}.`;
  }

  finish() {
    this.running = false;
    this.pauses.hidden = true;
    this.store.set("game", false);
    if (!this.state?.over) return;
    const won = !this.state.truly_in_goal;
    this.verdict.className = won ? "bad" : "good";
    this.verdict.textContent = `After ${this.state.time.toPrecision(3)} of time ${this.state.verdict}.`;
  }

  pause() {
    this.paused = !this.paused;
    this.pauses.textContent = this.paused ? "Go on" : "Pause";
  }

  stop() {
    const played = this.running || this.way.length;
    this.running = false;
    this.round = null;
    this.pauses.hidden = true;
    this.store.set("game", false);
    if (!played) return;
    this.way = [];
    clearRun(this.view);
    const space = this.store.get("space");
    if (space) this.view.draw("robot", ...robotAt(space, anchor(space)));
  }
}
