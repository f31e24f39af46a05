// Where a point goes that is nearly somewhere: vertices, contact edges, the grid.

import { fineStep } from "./drawing.js";

const NEAR_PIXELS = 9;
const LEVEL_PIXELS = 5;

/**
 * The point to which another one snaps, and what it snapped to.
 *
 * @param {object} options `contact`: only contact space counts; `others`: points to snap to;
 *   `levels`: points to be level with.
 * @returns {{point: number[], to: "vertex"|"edge"|"level"|"grid"|null, edge?: object,
 *   guides?: number[][][]}} `guides` are from the points that it is level with.
 */
export function snapped(
  point, view, store, { contact = false, others = [], levels = others, off = false } = {},
) {
  const space = store.get("space");
  const near = NEAR_PIXELS * view.scale;
  if (off || !store.get("snap")) return contact ? onContact(point, space, near * 3) : { point, to: null };
  const corners = [...others, ...(space?.vertices ?? []).map(({ at }) => at)];
  const corner = nearestOf(corners, point, near);
  if (corner) return { point: [...corner], to: "vertex" };
  const step = fineStep(view);
  const rounded = (place) => place.map((value) => Number((Math.round(value / step) * step).toFixed(9)));
  const edge = onContact(point, space, contact ? near * 3 : near);
  if (!edge.to) return level(point, levels, LEVEL_PIXELS * view.scale, rounded(point));
  // a point of the grid on that edge, if there is one near
  const [x, y] = rounded(edge.point);
  const [u, v] = projected([x, y], edge.edge.from, edge.edge.to);
  return Math.hypot(u - x, v - y) < 1e-9 * step ? { ...edge, point: [x, y] } : edge;
}

/** Level with another point, or straight above or below it; `otherwise` in what is neither. */
function level([x, y], others, near, otherwise) {
  const nearest = (axis, value) => others.reduce((best, other) => {
    const away = Math.abs(other[axis] - value);
    return away <= (best ? Math.abs(best[axis] - value) : near) ? other : best;
  }, null);
  const [above, beside] = [nearest(0, x), nearest(1, y)];
  if (!above && !beside) return { point: otherwise, to: "grid" };
  const point = [above ? above[0] : otherwise[0], beside ? beside[1] : otherwise[1]];
  return { point, to: "level", guides: [above, beside].filter(Boolean).map((other) => [other, point]) };
}

function nearestOf(points, [x, y], near) {
  let best = null;
  let least = near;
  for (const [u, v] of points) {
    const away = Math.hypot(u - x, v - y);
    if (away <= least) [best, least] = [[u, v], away];
  }
  return best;
}

/** The contact edge nearest to a point of it, or null. */
export const edgeAt = (point, view, store) =>
  onContact(point, store.get("space"), NEAR_PIXELS * view.scale).edge ?? null;

function onContact(point, space, near) {
  let found = { point, to: null };
  let least = near;
  for (const edge of space?.features ?? []) {
    const on = projected(point, edge.from, edge.to);
    const away = Math.hypot(on[0] - point[0], on[1] - point[1]);
    if (away <= least) [found, least] = [{ point: on, to: "edge", edge }, away];
  }
  return found;
}

/** The point of a segment that is nearest. */
export function projected([x, y], [x0, y0], [x1, y1]) {
  const [dx, dy] = [x1 - x0, y1 - y0];
  const share = Math.max(0, Math.min(1, ((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy || 1)));
  return [x0 + share * dx, y0 + share * dy];
}
