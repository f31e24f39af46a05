// The sweep that finds a backprojection, played: a line moves against the motion, and what it has
// passed is decided.

import { dot, html, linePath, segmentsPath, svg, unit } from "./svg.js";

export class Sweep {
  #playing = null;

  constructor(view) {
    this.view = view;
    this.slider = html(
      "input",
      {
        type: "range", id: "sweep-step", min: 0, max: 1, step: 1, "aria-label": "Step of the sweep",
        oninput: () => this.go(this.slider.valueAsNumber),
      },
    );
    this.says = html("p", { id: "sweep-says", role: "status" });
    this.button = html(
      "button",
      { type: "button", id: "sweep-play", onclick: () => (this.#playing ? this.pause() : this.play()) },
      "Play",
    );
    const step = (by, words, id) => html(
      "button", { type: "button", id, onclick: () => { this.pause(); this.go(this.place + by); } },
      words,
    );
    const whole = html(
      "button",
      { type: "button", id: "sweep-end", onclick: () => { this.pause(); this.finish(); } }, "All",
    );
    this.element = html(
      "div", {},
      html(
        "div", { class: "row transport" }, step(-1, "‹", "sweep-back"), this.button,
        step(1, "›", "sweep-next"), this.slider, whole,
      ),
      this.says,
    );
  }

  /** Show the whole of a stage, its steps waiting to be played; or the step at which it stands. */
  load(stage, space) {
    if (stage === this.stage && this.place >= 0) return this.go(this.place);
    this.pause();
    Object.assign(this, { stage, space, place: -1 });
    this.heights = [...new Set(stage.sweep.map(({ height }) => height))];
    this.slider.max = Math.max(0, this.heights.length - 1);
    this.finish();
  }

  clear() {
    this.pause();
    this.stage = null;
  }

  finish() {
    this.place = -1;
    this.slider.value = this.slider.max;
    const many = this.heights?.length;
    this.says.textContent = many ? `${many} heights at which something is decided.` : "";
    this.view.layer("backprojection").querySelector(".sweep")?.remove();
    this.view.layer("rays").removeAttribute("clip-path");
    for (const element of this.view.layer("backprojection").children) element.removeAttribute("clip-path");
  }

  /** Show what is decided once the line is at this height. */
  go(place) {
    if (!this.stage || !this.heights.length) return;
    this.place = Math.max(0, Math.min(place, this.heights.length - 1));
    this.slider.value = this.place;
    const height = this.heights[this.place];
    const events = this.stage.sweep.filter((event) => event.height === height);
    const words = [...new Set(events.map((event) => event.words))].join("; ");
    this.says.textContent = `Step ${this.place + 1} of ${this.heights.length}: ${words}.`;
    this.draw(height, events);
  }

  draw(height, events) {
    const { view, space, stage } = this;
    const [dx, dy] = unit(stage.direction);
    const [x0, y0, x1, y1] = space.window;
    const reach = 2 * Math.hypot(x1 - x0, y1 - y0);
    const foot = [-height * dx, -height * dy];
    const along = [-dy * reach, dx * reach];
    const ends = [[foot[0] - along[0], foot[1] - along[1]], [foot[0] + along[0], foot[1] + along[1]]];
    const ahead = ends.map(([x, y]) => [x + dx * reach, y + dy * reach]).reverse();
    const clip = svg(
      "clipPath", { id: "swept" }, svg("path", { d: `${linePath([...ends, ...ahead])}Z` }),
    );
    const group = svg("g", { class: "sweep" }, clip);
    view.layer("backprojection").querySelector(".sweep")?.remove();
    view.layer("backprojection").append(group);
    view.layer("rays").setAttribute("clip-path", "url(#swept)");
    // what is aimed at is known before the sweep begins
    for (const element of view.layer("backprojection").children) {
      if (!element.matches(".sweep, .kernel, .sticking")) element.setAttribute("clip-path", "url(#swept)");
    }
    group.append(
      svg("path", { class: "sweep-line", d: segmentsPath([[...ends[0], ...ends[1]]]) }),
      ...events.map(({ at }) => dot(...at, "sweep-mark", 4)));
    for (const element of group.querySelectorAll("path")) element.removeAttribute("clip-path");
  }

  play() {
    if (!this.stage) return;
    this.button.textContent = "Pause";
    if (this.place >= this.heights.length - 1) this.place = -1;
    const step = () => {
      this.go(this.place + 1);
      if (this.place >= this.heights.length - 1) return this.pause();
      this.#playing = setTimeout(step, Math.max(60, Math.min(700, 6000 / this.heights.length)));
    };
    step();
  }

  pause() {
    clearTimeout(this.#playing);
    this.#playing = null;
    this.button.textContent = "Play";
  }
}

