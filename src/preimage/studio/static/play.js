// The person is nature: turns the robot and its senses, and tries to beat the plan.

import { ask } from "./ask.js";
import { anchor, refusalOf, robotAt } from "./drawing.js";
import { clearRun, drawInstant, legendOf, roundly } from "./showing.js";
import { html, linePath, svg } from "./svg.js";

const MOVES_A_SECOND = 14;
const CROSSING = 10;
const MOST_MOVES = 5000;
const UNDISTURBED_MOVES = 1500;

const WORDS = `You are nature. Turn the robot's motion within its control error, and what it reads within
the errors of its sensors, while it moves. Make it believe that it is in the goal when it is not, or drive
it out; or at least hold it up as long as you can.`;

const CHEATING = {
  1: "no: the plan's bounds", 1.5: "one and a half times", 2: "twice", 3: "three times",
};

export function mount({ store, view }) {
  new Play(store, view).mount();
}

class Play {
  constructor(store, view) {
    const hand = { push: 0, x: 0, y: 0, tilt: 0 };
    Object.assign(this, { store, view, hand, moves: [], way: [], state: null, running: false, best: 0 });
  }

  mount() {
    const { store } = this;
    const panel = document.getElementById("panel-play");
    const button = (attributes, words) => html("button", { type: "button", ...attributes }, words);
    this.begin = button({ id: "game-begin", class: "primary", onclick: () => this.start() }, "Begin");
    this.pauses = button({ id: "game-pause", hidden: true, onclick: () => this.pause() }, "Pause");
    this.push = this.slider("game-push", "turn its motion left … right", "push");
    this.tilt = this.slider("game-tilt", "turn the force it feels", "tilt");
    this.cheat = html("select", { id: "game-cheat" },
      ...Object.entries(CHEATING).sort().map(([value, words]) => html("option", { value }, words)));
    this.pad = this.disc();
    this.seen = html("div", {},
      html("p", { class: "faded" },
        "Shift the position that it reads: drag in the disc, whose rim is the error."),
      this.pad);
    this.blind = html("p", { id: "game-blind", class: "faded" }, "It has no position sensor.");
    this.says = html("p", { id: "game-says" });
    this.truth = html("p", { id: "game-truth" });
    this.verdict = html("p", { id: "game-verdict", role: "status" });
    this.score = html("p", { id: "game-score" });
    panel.append(
      html("p", {}, WORDS), html("div", { class: "row" }, this.begin, this.pauses),
      this.verdict, this.score, this.says, this.truth, this.push.row, this.seen, this.blind, this.tilt.row,
      html("label", { class: "field" }, "cheat: errors", this.cheat),
      html("p", { class: "faded" },
        "Keys while it runs: ← → turn the motion, A D W S the position, Q E the force, Space pauses."),
      legendOf("truth", "actual", "command", "measured", "believed", "force", "aim"));
    store.on("plan", () => this.reset());
    store.on("space", (space) => space && this.fitTo(space.task.uncertainty));
    store.on("tab", (tab) => tab !== "play" && this.stop());
    document.addEventListener("keydown", (event) => this.key(event));
  }

  /** To the left is to the left: nature's positive turns are. */
  slider(id, words, name) {
    const input = html("input", {
      type: "range", id, min: -1, max: 1, step: 0.02, value: 0,
      oninput: () => { this.hand[name] = -input.valueAsNumber; },
    });
    return { input, row: html("label", { class: "field" }, words, input) };
  }

  disc() {
    this.knob = svg("circle", { class: "knob", cx: 0, cy: 0, r: 0.09 });
    const pad = svg("svg", {
      id: "game-pad", viewBox: "-1.1 -1.1 2.2 2.2", role: "slider", tabindex: 0,
      "aria-label": "Error of the position that it reads", "aria-valuetext": "none", "aria-valuenow": 0,
    }, svg("circle", { class: "rim", r: 1 }), svg(
      "path", { class: "cross", d: "M-1 0H1M0-1V1" },
    ), this.knob);
    const take = (event) => {
      if (!event.buttons && event.type !== "pointerdown") return;
      const { left, top, width, height } = pad.getBoundingClientRect();
      const [across, down] = [(event.clientX - left) / width - 0.5, (event.clientY - top) / height - 0.5];
      this.offset(2.2 * across, -2.2 * down);
    };
    pad.addEventListener(
      "pointerdown", (event) => { pad.setPointerCapture(event.pointerId); take(event); },
    );
    pad.addEventListener("pointermove", take);
    return pad;
  }

  /** Only senses that there are can be fooled. */
  fitTo({ position, force }) {
    const sees = typeof position === "number";
    this.seen.hidden = !sees;
    this.blind.hidden = sees;
    this.tilt.row.hidden = typeof force !== "object" || force === null;
  }

  offset(x, y) {
    const size = Math.max(1, Math.hypot(x, y));
    Object.assign(this.hand, { x: x / size, y: y / size });
    this.knob.setAttribute("cx", this.hand.x);
    this.knob.setAttribute("cy", -this.hand.y);
    const words = `${this.hand.x.toFixed(1)}, ${this.hand.y.toFixed(1)} of the error`;
    this.pad.setAttribute("aria-valuetext", words);
    this.pad.setAttribute("aria-valuenow", Math.hypot(this.hand.x, this.hand.y).toFixed(2));
  }

  key(event) {
    const typing = event.target.matches?.("input:not([type=range]):not([type=checkbox]), select");
    if (!this.running || typing || event.ctrlKey || event.metaKey || event.altKey) return;
    const turn = (name, by, slider) => {
      this.hand[name] = Math.max(-1, Math.min(1, this.hand[name] + by));
      slider.input.value = -this.hand[name];
    };
    const shift = (x, y) => this.offset(this.hand.x + x, this.hand.y + y);
    const actions = {
      ArrowLeft: () => turn("push", 0.25, this.push), ArrowRight: () => turn("push", -0.25, this.push),
      a: () => shift(-0.25, 0), d: () => shift(0.25, 0), w: () => shift(0, 0.25), s: () => shift(0, -0.25),
      q: () => turn("tilt", 0.25, this.tilt), e: () => turn("tilt", -0.25, this.tilt),
      " ": () => this.pause(),
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
    this.best = 0;
    for (const line of [this.says, this.truth, this.verdict, this.score]) line.textContent = "";
    this.begin.textContent = "Begin";
  }

  async start() {
    const plan = this.store.get("plan");
    if (plan?.status !== "solved") {
      this.verdict.textContent = "There is no plan to beat: plan first (Ctrl+Enter).";
      return;
    }
    Object.assign(this, { moves: [], way: [], state: null, running: true, paused: false });
    this.verdict.textContent = this.score.textContent = this.truth.textContent = "";
    this.begin.textContent = "Begin again";
    this.pauses.textContent = "Pause";
    this.pauses.hidden = false;
    this.store.set("game", true);
    const space = this.store.get("space");
    const factor = Number(this.cheat.value);
    const [x0, , x1] = space.window;
    const step = (x1 - x0) / CROSSING / MOVES_A_SECOND;
    const cheat = { control: factor, position: factor, force: factor };
    const round = this.round = Symbol("round");
    const body = { plan: plan.plan, start: anchor(space), cheat };
    try {
      this.usual = await undisturbed(body, step);
      while (this.round === round && !this.state?.over && this.moves.length < MOST_MOVES) {
        const began = performance.now();
        if (!this.paused) await this.move(body, step, space, round);
        const left = 1000 / MOVES_A_SECOND - (performance.now() - began);
        await new Promise((resolve) => setTimeout(resolve, Math.max(10, left)));
      }
    } catch (error) {
      const { where, words } = refusalOf(error);
      if (this.round === round) this.verdict.textContent = [where, words].filter(Boolean).join(": ");
    }
    if (this.round === round) this.finish();
  }

  async move(body, step, space, round) {
    const { push, x, y, tilt } = this.hand;
    this.moves.push([step, push, x, y, tilt].map((value) => Number(value.toFixed(6))));
    const state = await ask("play", { ...body, moves: this.moves });
    if (this.round !== round) return;
    this.state = state;
    this.way.push(...state.places);
    this.view.draw("trace", svg("path", { class: "way", d: linePath(this.way) }));
    drawInstant(this.view, space, state, { errors: space.task.uncertainty });
    const region = this.store.get("plan").regions.find(({ id }) => id === state.region);
    if (region?.target !== this.store.get("highlight")?.[0]) {
      this.store.set("highlight", region?.target ? [region.target] : null);
    }
    this.tell(state);
  }

  tell(state) {
    const felt = state.force === null ? "no force" : `a force from ${roundly(state.force)}`;
    const read = state.measured ? "a position" : "no position";
    this.says.textContent = state.direction === null
      ? `It says: ${state.words}.`
      : `It is told ${Number(state.direction.toFixed(2))}°, and reads ${read} and ${felt}.`;
    this.truth.textContent = `In truth it is ${state.truly_in_goal ? "in the goal" : "not in the goal"}.`;
  }

  finish() {
    this.running = false;
    this.pauses.hidden = true;
    this.store.set("game", false);
    if (!this.state) return;
    const { over, verdict, time } = this.state;
    if (!over) {
      this.verdict.textContent ||= "The game is over: it has taken too long.";
      return;
    }
    this.verdict.className = verdict.includes("nature has won") ? "bad" : "good";
    this.verdict.textContent = `After ${time.toPrecision(3)} of time ${verdict}.`;
    if (this.usual === null) return;
    const delay = Math.max(0, time - this.usual);
    this.best = Math.max(this.best, delay);
    this.score.textContent = `Left alone it takes ${this.usual.toPrecision(3)}. Your score, the delay: `
      + `${delay.toPrecision(2)}; your best: ${this.best.toPrecision(2)}.`;
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
    this.store.set("highlight", null);
    const space = this.store.get("space");
    if (space) this.view.draw("robot", ...robotAt(space, anchor(space)));
  }
}

/** How long the plan takes if nature does nothing; null if it does not end. */
async function undisturbed(body, step) {
  const moves = Array.from({ length: UNDISTURBED_MOVES }, () => [Number(step.toFixed(6)), 0, 0, 0, 0]);
  const { over, time } = await ask("play", { ...body, moves });
  return over ? time : null;
}
