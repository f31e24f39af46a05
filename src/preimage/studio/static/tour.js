// Why a plan is safe, in seven steps, for who has never heard of preimages.

import { ask } from "./ask.js";
import { plan } from "./planning.js";
import { html } from "./svg.js";

/** Each step: words, and what is shown meanwhile. */
const STEPS = [
  [
    "A peg is to go into a hole. Told to move down, it moves down within 5°. Its position is " +
      "read 0.3 off at most. Driving at the hole and hoping is not good enough: we want to be " +
      "sure.",
    { tab: "task" },
  ],
  [
    "Think of the peg as one point, the dot at its foot. Dark is where that point cannot be: " +
      "the workspace grown by the peg. Green is where it must come to rest.",
    { tab: "task" },
  ],
  [
    "From where does every motion “down”, whatever the errors, end on the green? From the " +
      "blue funnel above the hole: its sides lean by the 5°. It is the backprojection of the " +
      "goal.",
    { tab: "layers", direction: 270, goal: 0 },
  ],
  [
    "To be there is not enough: the peg has to know. At the bottom it stops moving, and " +
      "nothing else nearby pushes back like it. A region that is surely reached and surely " +
      "recognised is called a preimage.",
    { tab: "layers", direction: 270, goal: 0 },
  ],
  [
    "The start is not in that funnel, P2. So P2 becomes the goal of a motion before: to the " +
      "right, from P1, until the peg is surely in P2. Goal by goal backwards, until the start " +
      "is covered: that is the plan.",
    { tab: "plan" },
  ],
  ["See it run, with nature choosing every error as badly as she may.", { tab: "run" }],
  [
    "Now be nature yourself: turn the peg and its senses as far as the bounds allow, and try " +
      "to make it believe that it is in the hole while it is not.",
    { tab: "play" },
  ],
];

export function mountTour({ store, planner }) {
  document.getElementById("tour").onclick = () => begin(store, planner);
}

async function begin(store, planner) {
  document.querySelector(".tour")?.remove();
  store.open((await ask("example", { name: "peg-in-hole" })).task, { undoable: true });
  await plan(store, planner);
  let place = 0;
  const words = html("p", { "aria-live": "polite" });
  const count = html("span", { class: "faded" });
  const box = html("div", { class: "tour", role: "dialog", "aria-label": "Why is a plan safe?" }, words,
    html("div", { class: "row" },
      html("button", { type: "button", id: "tour-end", onclick: () => box.remove() }, "Close"), count,
      html("span", {},
        html("button", { type: "button", id: "tour-back", onclick: () => show(place - 1) }, "Back"), " ",
        html(
          "button",
          { type: "button", id: "tour-next", class: "primary", onclick: () => show(place + 1) },
          "Next",
        ))));
  const show = (next) => {
    if (next >= STEPS.length) return box.remove();
    place = Math.max(0, next);
    const [text, shown] = STEPS[place];
    words.textContent = text;
    count.textContent = `${place + 1} of ${STEPS.length}`;
    for (const [key, value] of Object.entries(shown)) store.set(key, value);
  };
  box.addEventListener("keydown", (event) => event.key === "Escape" && box.remove());
  document.body.append(box);
  show(0);
  document.getElementById("tour-next").focus();
}
