// Asking for a plan, and what comes back, in words.

import { motionColour, refusalOf, spokenName } from "./drawing.js";
import { html } from "./svg.js";

export function mount({ store, planner }) {
  const panel = document.getElementById("panel-plan");
  const button = html(
    "button", { type: "button", id: "plan", class: "primary", onclick: () => plan(store, planner) },
    "Plan",
  );
  const cancel = html(
    "button", { type: "button", id: "cancel", hidden: true, onclick: () => planner.cancel() },
    "Cancel",
  );
  const auto = html("input", { type: "checkbox", id: "auto" });
  const progress = html("p", { class: "faded", id: "plan-progress", role: "status" });
  const result = html("div", { id: "plan-result", "aria-live": "polite" });
  panel.append(
    html(
      "div", { class: "row" }, button, cancel,
      html("label", { class: "check" }, auto, "plan as I change it"),
    ),
    progress, result,
  );
  let waiting = null;
  store.on("task", (task) => {
    if (planner.busy) planner.cancel();
    clearTimeout(waiting);
    if (task && auto.checked) waiting = setTimeout(() => plan(store, planner), 150);
  });
  auto.onchange = () => auto.checked && plan(store, planner);
  store.on("planning", (now) => {
    cancel.hidden = !now;
    button.disabled = Boolean(now);
    progress.textContent = now ?? "";
  });
  store.on(
    "plan",
    (view) => result.replaceChildren(
      ...(view ? resultOf(store, view) : [html("p", { class: "faded" }, "No plan yet.")]),
    ),
  );
  store.on(
    "plan-refusal",
    (refusal) => refusal && result.replaceChildren(
      html("p", { class: "bad" }, [refusal.where, refusal.words].filter(Boolean).join(": ")),
    ),
  );
  document.addEventListener("keydown", (event) => {
    if ((event.ctrlKey || event.metaKey) && event.key === "Enter") {
      event.preventDefault();
      plan(store, planner);
    }
  });
}

/** Ask for a plan of the present task; what is under way is taken back. */
export async function plan(store, planner) {
  const task = store.get("task");
  store.set("planning", "planning …");
  store.set("plan-refusal", null);
  try {
    const view = await planner.ask("plan", { task }, {
      progress: ({ regions, seconds }) => store.set(
        "planning", `${regions} regions, ${seconds.toFixed(1)} s`,
      ),
    });
    if (store.get("task") !== task) return;
    store.set("plan", view);
    if (!["plan", "run", "play", "layers"].includes(store.get("tab"))) store.set("tab", "plan");
    store.set("announce", view.words[0]);
  } catch (error) {
    if (error.name === "AbortError") store.set("announce", "Planning was taken back.");
    else store.set("plan-refusal", refusalOf(error));
  } finally {
    if (!planner.busy) store.set("planning", null);
  }
}

function resultOf(store, view) {
  const solved = view.status === "solved";
  const parts = [html("p", { id: "verdict", class: solved ? "good" : "bad" }, view.words[0])];
  if (!solved) {
    parts.push(html("ul", { class: "plain" }, ...view.why.slice(0, 8).map((why) => html("li", {}, why))));
    parts.push(
      html(
        "button", { type: "button", id: "ask-why", onclick: () => store.set("tab", "why") },
        "Why, and what would help?",
      ),
    );
  }
  for (const region of motionsOf(view)) parts.push(motionButton(store, view, region));
  const rest = html(
    "details", {}, html("summary", {}, "In words"),
    html("div", { class: "words" }, view.words.join("\n")),
  );
  return [...parts, rest];
}

/** The regions with a motion, in the order in which they are carried out. */
export function motionsOf(view) {
  const moving = view.regions.filter(({ direction }) => direction !== null);
  if (view.linear && view.steps.length) return view.steps.map(
    (id) => moving.find((region) => region.id === id),
  ).filter(Boolean);
  return moving.sort((a, b) => b.rank - a.rank || a.id - b.id);
}

function motionButton(store, view, region) {
  const here = spokenName(view, region.id);
  const step = view.linear ? view.steps.indexOf(region.id) + 1 : 0;
  const number = step ? `Motion ${step} of ${view.steps.length}, from ${here}` : `From ${here}`;
  const title = html("strong", {}, `${number}: ${Number(region.direction.toFixed(3))}°`);
  title.style.color = motionColour(region.rank);
  const goals = region.goals.map((id) => spokenName(view, id)).join(" or ");
  const until = region.conditions.join(", or ").replaceAll(
    /region (\d+)/g, (_, id) => spokenName(view, Number(id)),
  );
  return html("button", {
    type: "button", class: "motion", "data-region": region.id,
    onclick: () => {
      store.set("highlight", [region.target]);
      store.set("direction", region.direction);
      store.set("goal", region.goals[0] ?? 0);
    },
  }, title, html("br"), `until ${until}; then it is in ${goals}`);
}
