// Where the name of a region goes: well inside it, outside of the others, and not on another name.

const GRID = 17;
const MANY = 4000;
const APART = [46, 30];

/**
 * A point for each region of `regions`, in their order; null for one that is empty.
 *
 * @param {object[]} regions `{area, edges, vertices}`, in the task's units.
 * @returns {(number[]|null)[]}
 */
export function labelPlaces(regions) {
  return regions.map((region, place) => {
    const others = regions.filter((_, other) => other !== place);
    return insideOf(region, others);
  });
}

/** Shift names that would lie on each other: pixels in, pixels out. */
export function spread(points) {
  const taken = [];
  return points.map(([x, y]) => {
    const meets = ([u, v]) => Math.abs(u - x) < APART[0] && Math.abs(v - y) < APART[1];
    for (let tries = 0; tries < 12 && taken.some(meets); tries += 1) y += APART[1];
    taken.push([x, y]);
    return [x, y];
  });
}

function insideOf(region, others) {
  const polygon = [...region.area].sort((a, b) => Math.abs(sizeOf(b[0])) - Math.abs(sizeOf(a[0])))[0];
  if (polygon) return roomiest(polygon, others.flatMap(({ area }) => area));
  const [edge] = region.edges;
  if (edge) return [(edge[0] + edge[2]) / 2, (edge[1] + edge[3]) / 2];
  return region.vertices[0] ?? null;
}

/** The point of a grid that has most room about it; what is in other polygons too counts for less. */
function roomiest(polygon, others) {
  const xs = polygon[0].map(([x]) => x);
  const ys = polygon[0].map(([, y]) => y);
  const [left, low] = [Math.min(...xs), Math.min(...ys)];
  const [wide, high] = [Math.max(...xs) - left, Math.max(...ys) - low];
  const near = others.filter((other) => other[0].length < MANY);
  let best = polygon[0][0];
  let most = -Infinity;
  for (let row = 1; row < GRID; row += 1) {
    for (let column = 1; column < GRID; column += 1) {
      const at = [left + (wide * column) / GRID, low + (high * row) / GRID];
      if (!contains(polygon, at)) continue;
      const shared = near.some((other) => contains(other, at));
      const room = clearance(polygon, at) * (shared ? 0.3 : 1);
      if (room > most) [best, most] = [at, room];
    }
  }
  return best;
}

function clearance(polygon, [x, y]) {
  let least = Infinity;
  for (const ring of polygon) {
    for (let place = 0; place < ring.length; place += 1) {
      const [[x0, y0], [x1, y1]] = [ring[place], ring[(place + 1) % ring.length]];
      const [dx, dy] = [x1 - x0, y1 - y0];
      const share = ((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy || 1);
      const on = Math.max(0, Math.min(1, share));
      least = Math.min(least, Math.hypot(x - x0 - on * dx, y - y0 - on * dy));
    }
  }
  return least;
}

function contains(polygon, [x, y]) {
  let inside = false;
  for (const ring of polygon) {
    for (let place = 0; place < ring.length; place += 1) {
      const [[x0, y0], [x1, y1]] = [ring[place], ring[(place + 1) % ring.length]];
      if (y0 > y !== y1 > y && x < x0 + ((y - y0) * (x1 - x0)) / (y1 - y0)) inside = !inside;
    }
  }
  return inside;
}

function sizeOf(ring) {
  return ring.reduce((sum, [x, y], place) => {
    const [u, v] = ring[(place + 1) % ring.length];
    return sum + (x * v - u * y) / 2;
  }, 0);
}
