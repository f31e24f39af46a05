// What to look at: one panel of several, chosen by tabs.

import { html } from "./svg.js";

/** The panels, in their order, and what they are called. */
export const TABS = {
  task: "Task", plan: "Plan", layers: "Layers", run: "Run", play: "Play", why: "Why", budget: "Budget",
};

export function mount({ store }) {
  const list = document.getElementById("tabs");
  const names = Object.keys(TABS);
  for (const name of names) {
    list.append(html("button", {
      type: "button", role: "tab", id: `tab-${name}`, "aria-controls": `panel-${name}`,
      onclick: () => store.set("tab", name),
    }, TABS[name]));
    const panel = document.getElementById(`panel-${name}`);
    panel.setAttribute("role", "tabpanel");
    panel.setAttribute("aria-labelledby", `tab-${name}`);
  }
  list.addEventListener("keydown", (event) => {
    const turn = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!turn) return;
    const next = (names.indexOf(store.get("tab")) + turn + names.length) % names.length;
    store.set("tab", names[next]);
    document.getElementById(`tab-${names[next]}`).focus();
  });
  store.on("tab", (chosen) => {
    for (const name of names) {
      const tab = document.getElementById(`tab-${name}`);
      tab.setAttribute("aria-selected", name === chosen);
      tab.tabIndex = name === chosen ? 0 : -1;
      document.getElementById(`panel-${name}`).hidden = name !== chosen;
    }
  });
  store.on("announce", (words) => (document.getElementById("status").textContent = words));
  store.set("tab", "task");
}
