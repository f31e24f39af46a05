// A run played: what is at which time, and the buttons.

import { html } from "./svg.js";

/** How long a run is shown, in seconds, at speed 1. */
const SHOWN = 8;

/** What is at a time of a run: `legs` as the studio tells them. */
export function instantOf(legs, time) {
  const number = Math.max(0, legs.findLastIndex((leg) => leg.times[0] <= time));
  const leg = legs[number];
  let place = leg.times.findLastIndex((moment) => moment <= time);
  place = Math.max(0, Math.min(place, leg.times.length - 1));
  const next = Math.min(place + 1, leg.times.length - 1);
  const span = leg.times[next] - leg.times[place];
  const share = span > 0 ? Math.min(1, (time - leg.times[place]) / span) : 0;
  const [from, to] = [leg.places[place], leg.places[next]];
  const between = (axis) => from[axis] + share * (to[axis] - from[axis]);
  const at = [between(0), between(1)];
  // in between, the error is that of the last look
  const measured = leg.measured[place];
  const seen = measured && [0, 1].map((axis) => measured[axis] - leg.places[place][axis] + at[axis]);
  return {
    number, leg, place: at, measured: seen, force: leg.forces[place], direction: leg.direction,
    actual: leg.actual[place], over: time >= leg.times.at(-1),
  };
}

/** Play, pause, a slider and a speed; tells the time that is to be shown. */
export class Transport {
  #frame = null;
  #last = 0;

  constructor(show, { id = "run" } = {}) {
    this.show = show;
    this.total = 0;
    this.time = 0;
    this.button = html(
      "button",
      { type: "button", id: `${id}-play`, onclick: () => (this.#frame ? this.pause() : this.play()) },
      "Play",
    );
    this.slider = html(
      "input",
      {
        type: "range", id: `${id}-time`, min: 0, max: 1, step: "any",
        "aria-label": "Time of the run",
        oninput: () => { this.pause(); this.go(this.slider.valueAsNumber); },
      },
    );
    this.speed = html(
      "select", { id: `${id}-speed`, "aria-label": "Speed" },
      ...[0.25, 0.5, 1, 2, 4].map(
        (value) => html("option", { value, selected: value === 1 }, `${value}×`),
      ),
    );
    this.element = html(
      "div", { class: "row transport", hidden: true }, this.button, this.slider, this.speed,
    );
  }

  /** Begin with a run that takes so long. */
  load(total) {
    this.pause();
    this.total = total;
    this.slider.max = total || 1;
    this.element.hidden = false;
    this.go(0);
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) this.play();
  }

  clear() {
    this.pause();
    this.element.hidden = true;
  }

  go(time) {
    this.time = Math.min(Math.max(time, 0), this.total);
    this.slider.value = this.time;
    this.show(this.time);
  }

  play() {
    if (this.time >= this.total) this.time = 0;
    this.button.textContent = "Pause";
    this.#last = performance.now();
    const step = (now) => {
      const spent = ((now - this.#last) / 1000) * (this.total / SHOWN) * Number(this.speed.value);
      this.#last = now;
      this.go(this.time + spent);
      if (this.time >= this.total) return this.pause();
      this.#frame = requestAnimationFrame(step);
    };
    this.#frame = requestAnimationFrame(step);
  }

  pause() {
    cancelAnimationFrame(this.#frame);
    this.#frame = null;
    this.button.textContent = "Play";
  }
}
