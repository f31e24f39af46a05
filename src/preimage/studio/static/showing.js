// A robot at one instant: where it is, and what it knows.

import { MOTION_COLOURS, robotAt } from "./drawing.js";
import { dot, html, linePath, regionElements, svg, unit } from "./svg.js";

const ARROW = 46;

/**
 * Draw one instant.
 *
 * @param {object} now `place`, `measured` or null, `force` in degrees or null, `direction` commanded
 *   or null, `actual` or null, `believed` a region or null.
 * @param {object} options `truth`: whether the true robot is drawn; `errors`: the task's bounds.
 */
export function drawInstant(view, space, now, { truth = true, errors }) {
  const elements = truth ? robotAt(space, now.place) : [];
  view.draw("robot", ...elements);
  const known = [];
  if (now.believed) known.push(...regionElements(now.believed, "believed", 5));
  if (now.measured) {
    const radius = typeof errors.position === "number" ? errors.position : 0;
    known.push(
      svg("circle", { class: "error-disc", cx: now.measured[0], cy: now.measured[1], r: radius }),
    );
    known.push(dot(...now.measured, "measured", 4));
  }
  const from = now.measured ?? (truth ? now.place : null);
  if (from && now.force !== null) known.push(...arrow(view, from, now.force, "force"));
  if (from && now.direction !== null) known.push(
    cone(view, from, now.direction, errors.control), ...arrow(view, from, now.direction, "command"),
  );
  if (
    truth && now.actual !== null && now.actual !== undefined
  ) known.push(...arrow(view, now.place, now.actual, "actual"));
  view.draw("reading", ...known);
}

const KEY = {
  truth: "where it truly is", actual: "how it truly moves", command: "how it is told to move",
  measured: "the position it reads, and how far off that may be",
  believed: "where it may be, for all it reads",
  force: "the force it feels", aim: "what the motion aims at", way: "the way, in the colour of its motion",
};

/** What the signs of an instant mean; `names` are keys of `KEY`. */
export function legendOf(...names) {
  const items = names.map((name) => html("li", {}, html("span", { class: `sign ${name}` }), KEY[name]));
  return html("ul", { class: "signs", "aria-label": "What is drawn" }, ...items);
}

/** A force or direction in words, from 0° to 360°. */
export const roundly = (degrees) => `${Math.round((degrees + 360) % 360) % 360}°`;

/** An arrow from a place, as long on every zoom. */
export function arrow(view, [x, y], degrees, kind, length = ARROW) {
  const reach = length * view.scale;
  const [dx, dy] = unit(degrees);
  const tip = [x + reach * dx, y + reach * dy];
  const [a, b] = [0.22 * reach, 0.12 * reach];
  const head = [
    tip, [tip[0] - a * dx - b * dy, tip[1] - a * dy + b * dx],
    [tip[0] - a * dx + b * dy, tip[1] - a * dy - b * dx],
  ];
  return [
    svg("path", { class: `${kind} shaft`, d: linePath([[x, y], tip]) }),
    svg("path", { class: `${kind} head`, d: `${linePath(head)}Z` }),
  ];
}

/** The control uncertainty cone of a command. */
export function cone(view, [x, y], degrees, control) {
  const reach = 1.5 * ARROW * view.scale;
  const rim = Array.from({ length: 13 }, (_, place) => unit(degrees + control * (place / 6 - 1)));
  return svg(
    "path",
    {
      class: "control-cone",
      d: `${linePath([[x, y], ...rim.map(([dx, dy]) => [x + reach * dx, y + reach * dy])])}Z`,
    },
  );
}

/** The way that was gone, motion by motion. */
export function drawWay(view, legs, plan) {
  view.draw("trace", ...legs.map((leg) => {
    const rank = plan?.regions.find(({ id }) => id === leg.region)?.rank ?? 1;
    const way = svg("path", { class: "way", d: linePath(leg.places) });
    way.style.stroke = MOTION_COLOURS[(rank - 1 + MOTION_COLOURS.length) % MOTION_COLOURS.length];
    return way;
  }));
}

/** Nothing of a run is drawn any more, and the robot stands at its start again. */
export function clearRun(view) {
  for (const name of ["trace", "reading", "robot"]) view.draw(name);
}
