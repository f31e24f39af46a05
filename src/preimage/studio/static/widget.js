// A task or a plan in a notebook: the same drawing, with its run played.

import { MOTION_COLOURS, anchor, drawSpace, robotAt } from "./drawing.js";
import { Transport, instantOf } from "./player.js";
import { drawInstant, drawWay } from "./showing.js";
import { html, regionElements, svg } from "./svg.js";
import { View } from "./view.js";

/** What anywidget calls: `model` holds `space`, and `plan` and `run` where there is a plan. */
export function render({ model, el }) {
  const picture = svg("svg", { class: "drawing", role: "img", "aria-label": model.get("words") });
  const says = html("p", { role: "status" }, model.get("words"));
  const [space, plan, run] = ["space", "plan", "run"].map((name) => model.get(name));
  el.classList.add("preimage");
  el.append(picture, says);
  const view = new View(picture);
  drawSpace(view, space);
  if (plan) view.draw(
    "preimages", ...plan.regions.filter(({ direction }) => direction !== null).flatMap(elementsOf),
  );
  requestAnimationFrame(() => view.fit(space.window));
  view.draw("robot", ...robotAt(space, anchor(space)));
  if (!run?.legs.length) return;
  drawWay(view, run.legs, plan);
  const transport = new Transport((time) => {
    const now = instantOf(run.legs, time);
    drawInstant(view, space, now, { errors: space.task.uncertainty });
    const felt = now.force === null ? "no force" : `a force from ${Math.round(now.force)}°`;
    says.textContent = time >= run.time ? `It ended ${run.words}.` : `Motion ${now.number + 1} of ${run.legs.length}: told ${Number(now.direction.toFixed(2))}°, it feels ${felt}.`;
  }, { id: "widget" });
  el.append(transport.element);
  transport.load(run.time);
  return () => transport.pause();
}

function elementsOf(region) {
  const colour = MOTION_COLOURS[(region.rank - 1) % MOTION_COLOURS.length];
  return regionElements(region.region, "preimage").map((element) => {
    if (element.classList.contains("area")) element.style.setProperty("fill", colour, "important");
    element.style.stroke = colour;
    return element;
  });
}

export default { render };
