// The plan as a graph: its regions by rank, arrows to the regions in which their motions end.

import { html, linePath, svg } from "./svg.js";

const [WIDE, HIGH] = [360, 190];

/** The element that shows the graph of the present plan; a region that is chosen is highlighted. */
export function mountGraph(store) {
  const picture = svg("svg", { id: "graph", viewBox: `0 0 ${WIDE} ${HIGH}`, role: "group", "aria-label": "Regions of the plan" });
  const nothing = html("p", { class: "faded" }, "There is no plan yet.");
  const draw = () => {
    const plan = store.get("plan");
    nothing.hidden = Boolean(plan);
    picture.toggleAttribute("hidden", !plan);
    picture.replaceChildren(...(plan ? graphOf(store, plan) : []));
  };
  store.on("plan", draw);
  store.on("goal", draw);
  draw();
  return html("div", {}, nothing, picture);
}

function graphOf(store, plan) {
  const places = placesOf(plan.regions);
  const used = usedIn(plan);
  const links = plan.regions.flatMap(({ id, goals }) => goals.map((goal) => {
    const [from, to] = [places.get(id), places.get(goal)];
    if (!from || !to) return null;
    const between = used.has(id) && used.has(goal);
    return svg("path", { class: `link${between ? " used" : ""}`, d: linePath([from, to]) });
  })).filter(Boolean);
  const nodes = plan.regions.map((region) => nodeOf(store, region, places.get(region.id), used));
  return [...links, ...nodes];
}

function nodeOf(store, region, [x, y], used) {
  const name = region.id === 0 ? "the goal" : `region ${region.id}`;
  const words = region.direction === null ? name : `${name}, commanded ${Number(region.direction.toFixed(2))}°, ${region.rank} motions left`;
  const choose = () => {
    store.set("highlight", [region.region]);
    store.set("goal", region.id);
    store.set("announce", words);
  };
  const classes = ["node", used.has(region.id) && "used", store.get("goal") === region.id && "chosen"].filter(Boolean);
  const text = svg("text", { x, y: y + 4 });
  text.textContent = region.id === 0 ? "G" : region.id;
  return svg("g", {
    class: classes.join(" "), tabindex: 0, role: "button", "aria-label": words, "data-node": region.id, onclick: choose,
    onkeydown: (event) => { if (["Enter", " "].includes(event.key)) { event.preventDefault(); choose(); } },
  }, svg("circle", { cx: x, cy: y, r: 13 }), text);
}

/** Columns by rank, the goal at the right. */
function placesOf(regions) {
  const ranks = [...new Set(regions.map(({ rank }) => rank))].sort((a, b) => b - a);
  const places = new Map();
  ranks.forEach((rank, column) => {
    const here = regions.filter((region) => region.rank === rank);
    here.forEach(({ id }, row) => {
      const x = ranks.length > 1 ? 24 + (column * (WIDE - 48)) / (ranks.length - 1) : WIDE / 2;
      places.set(id, [x, ((row + 1) * HIGH) / (here.length + 1)]);
    });
  });
  return places;
}

/** The regions that a run may come through. */
function usedIn(plan) {
  const used = new Set(plan.start);
  const waiting = [...plan.start];
  while (waiting.length) {
    const region = plan.regions.find(({ id }) => id === waiting.at(-1));
    waiting.pop();
    for (const goal of region?.goals ?? []) if (!used.has(goal)) { used.add(goal); waiting.push(goal); }
  }
  return used;
}
