// The plan as a graph: its regions by rank, arrows to the regions in which their motions end.

import { nameOf, spokenName } from "./drawing.js";
import { html, linePath, svg } from "./svg.js";

const [WIDE, HIGH, RADIUS] = [360, 190, 13];

/** The element that shows the graph of the present plan; a region that is chosen is highlighted. */
export function mountGraph(store) {
  const picture = svg(
    "svg",
    { id: "graph", viewBox: `0 0 ${WIDE} ${HIGH}`, role: "group", "aria-label": "Regions of the plan" },
  );
  const nothing = html("p", { class: "faded" }, "There is no plan yet.");
  const key = html(
    "p", { class: "faded" },
    "An arrow: the motion of a region ends in the other. Blue: a run may come there.",
  );
  const draw = () => {
    const plan = store.get("plan");
    nothing.hidden = Boolean(plan);
    picture.toggleAttribute("hidden", !plan);
    key.hidden = !plan;
    picture.replaceChildren(...(plan ? graphOf(store, plan) : []));
  };
  store.on("plan", draw);
  store.on("goal", draw);
  draw();
  return html("div", {}, nothing, picture, key);
}

function graphOf(store, plan) {
  const places = placesOf(plan.regions);
  const used = usedIn(plan);
  const links = plan.regions.flatMap(({ id, goals }) => goals.map((goal) => {
    const [from, to] = [places.get(id), places.get(goal)];
    if (!from || !to) return null;
    const between = used.has(id) && used.has(goal);
    return svg("path", { class: `link${between ? " used" : ""}`, d: arrowPath(from, to, places) });
  })).filter(Boolean);
  const nodes = plan.regions.map((region) => nodeOf(store, plan, region, places.get(region.id), used));
  return [...links, ...nodes];
}

/** An arrow from node to node; it bends if it would go through others of its row. */
function arrowPath(from, to, places) {
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]) || 1;
  const [dx, dy] = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
  const between = [...places.values()].some(([x, y]) => {
    const along = (x - from[0]) * dx + (y - from[1]) * dy;
    const beside = Math.abs((x - from[0]) * dy - (y - from[1]) * dx);
    return along > RADIUS && along < length - RADIUS && beside < RADIUS;
  });
  const bend = between ? Math.min(60, length / 3) : 0;
  const middle = [(from[0] + to[0]) / 2 - bend * dy, (from[1] + to[1]) / 2 - bend * dx];
  const back = Math.atan2(middle[1] - to[1], middle[0] - to[0]);
  const at = (angle, reach, [x, y]) => [x + reach * Math.cos(angle), y + reach * Math.sin(angle)];
  const tip = at(back, RADIUS + 2, to);
  const begin = at(Math.atan2(middle[1] - from[1], middle[0] - from[0]), RADIUS, from);
  const [left, right] = [at(back + 0.45, 9, tip), at(back - 0.45, 9, tip)];
  return `M${begin}Q${middle} ${tip}${linePath([left, tip, right])}`;
}

function nodeOf(store, plan, region, [x, y], used) {
  const name = spokenName(plan, region.id);
  const left = region.rank === 1 ? "1 motion left" : `${region.rank} motions left`;
  const told = Number(region.direction?.toFixed(2));
  const words = region.direction === null ? name : `${name}, commanded ${told}°, ${left}`;
  const choose = () => {
    store.set("highlight", [region.region]);
    store.set("goal", region.id);
    store.set("announce", words);
  };
  const classes = [
    "node", used.has(region.id) && "used", store.get("goal") === region.id && "chosen",
  ].filter(Boolean);
  const text = svg("text", { x, y: y + 4 });
  text.textContent = region.id === 0 ? "G" : nameOf(plan, region.id);
  return svg("g", {
    class: classes.join(" "), tabindex: 0, role: "button", "aria-label": words,
    "data-node": region.id, onclick: choose,
    onkeydown: (event) => {
      if (["Enter", " "].includes(event.key)) { event.preventDefault(); choose(); }
    },
  }, svg("circle", { cx: x, cy: y, r: RADIUS }), text);
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
