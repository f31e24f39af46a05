// The task's shapes as lists of points that can be dragged; where each is in the document.

/** A value deep inside a document. */
export const at = (task, path) => path.reduce((value, key) => value?.[key], task);

/** Put a value deep into a document. */
export function put(task, path, value) {
  at(task, path.slice(0, -1))[path.at(-1)] = value;
}

/**
 * All shapes of a task, in the order in which they lie on each other.
 *
 * @returns {{id, label, kind, closed, paths, points, offset}[]} `points` are in the plane; what is
 * in the document is less `offset`, which only the robot has.
 */
export function shapesOf(task, robotAt = [0, 0]) {
  const found = [];
  const add = (id, label, kind, paths, closed, offset = [0, 0]) => found.push({
    id, label, kind, closed, paths, offset,
    points: paths.map((path) => at(task, path).map((value, axis) => value + offset[axis])),
  });
  const ring = (path) => at(task, path).map((_, place) => [...path, place]);
  (task.obstacles ?? []).forEach((obstacle, place) => {
    const [name, root] = [`obstacle ${place + 1}`, ["obstacles", place]];
    if (obstacle.chain) return add(
      root.join("."), `${name}, a chain`, "chain", ring([...root, "chain"]), false,
    );
    add(root.join("."), name, "polygon", ring([...root, "polygon"]), true);
    (obstacle.holes ?? []).forEach((_, hole) =>
      add(
        [...root, "holes", hole].join("."), `hole ${hole + 1} of ${name}`, "hole",
        ring([...root, "holes", hole]), true,
      ));
  });
  (task.goal.edges ?? []).forEach((_, place) =>
    add(`goal.edges.${place}`, `goal edge ${place + 1}`, "goal", ring(["goal", "edges", place]), false));
  (task.goal.polygons ?? []).forEach((_, place) =>
    add(
      `goal.polygons.${place}`, `goal area ${place + 1}`, "goal", ring(["goal", "polygons", place]),
      true,
    ));
  (task.goal.points ?? []).forEach((_, place) =>
    add(`goal.points.${place}`, `goal point ${place + 1}`, "goal", [["goal", "points", place]], false));
  addStart(task, add, ring);
  if (Array.isArray(task.robot?.polygon)) {
    const [x, y] = task.robot.reference ?? [0, 0];
    const offset = [robotAt[0] - x, robotAt[1] - y];
    add("robot.polygon", "robot", "robot", ring(["robot", "polygon"]), true, offset);
  }
  return found;
}

function addStart(task, add, ring) {
  const { initial } = task;
  if (initial.point) add("initial.point", "start", "start", [["initial", "point"]], false);
  else if (initial.disc) add(
    "initial.disc", "start, a disc", "start", [["initial", "disc", "center"]], false,
  );
  else if (initial.polygon) add(
    "initial.polygon", "start area", "start", ring(["initial", "polygon"]), true,
  );
  else if (initial.edges) {
    initial.edges.forEach((_, place) =>
      add(
        `initial.edges.${place}`, `start edge ${place + 1}`, "start",
        ring(["initial", "edges", place]), false,
      ));
  }
}

/** What moves with a shape as a whole: its points, and an obstacle's holes. */
export function wholeOf(task, shape) {
  const [root, place, ...rest] = shape.id.split(".");
  const holes = root === "obstacles" && !rest.length ? (task.obstacles[place].holes ?? []) : [];
  const within = holes.flatMap((ring, hole) =>
    ring.map((_, point) => ["obstacles", Number(place), "holes", hole, point]));
  return [...shape.paths, ...within];
}

/** Move points of a shape by so much. */
export function moveBy(task, paths, [dx, dy]) {
  for (const path of paths) {
    const [x, y] = at(task, path);
    put(task, path, [tidy(x + dx), tidy(y + dy)]);
  }
}

/** Without the digits that floating point adds. */
export const tidy = (value) => Number(value.toFixed(9));

/** Remove a whole shape; what must be there stays. */
export function removeShape(task, shape) {
  const path = shape.id.split(".").map((key) => (/^\d+$/.test(key) ? Number(key) : key));
  if (shape.kind === "start" && !(task.initial.edges?.length > 1)) return false;
  if (shape.kind === "robot") task.robot = "point";
  else at(task, path.slice(0, -1)).splice(path.at(-1), 1);
  return true;
}

/** Remove one vertex, or the shape if too few are left. */
export function removeVertex(task, shape, place) {
  const least = shape.closed ? 3 : 2;
  if (shape.paths.length <= least) return removeShape(task, shape);
  const path = shape.paths[place];
  at(task, path.slice(0, -1)).splice(path.at(-1), 1);
  return true;
}

/** Insert a vertex after another, half way to the next. */
export function insertVertex(task, shape, place, point = null) {
  if (
    shape.paths.length < 2 || shape.id.startsWith("goal.edges") || shape.id.startsWith("initial.edges")
  ) return false;
  const next = shape.points[(place + 1) % shape.points.length];
  const here = shape.points[place];
  const middle = point ?? [(here[0] + next[0]) / 2, (here[1] + next[1]) / 2];
  const path = shape.paths[place];
  at(task, path.slice(0, -1)).splice(
    path.at(-1) + 1, 0, middle.map((value, axis) => tidy(value - shape.offset[axis])),
  );
  return true;
}

/** An empty task with a floor, to begin with. */
export const BLANK = {
  version: 1,
  name: "untitled",
  window: [-10, -6, 10, 10],
  walls: [],
  robot: "point",
  obstacles: [{ polygon: [[-10, -6], [10, -6], [10, 0], [-10, 0]], holes: [] }],
  uncertainty: { control: 8, position: 0.2, force: { angle: 12, threshold: 0.05 } },
  friction: 20,
  sliding: "projection",
  initial: { point: [0, 6] },
  goal: { edges: [[[-3, 0], [3, 0]]], polygons: [], points: [] },
  planner: {
    directions: 8, method: "combined", strategy: "linear", termination: "instantaneous",
    max_steps: 8,
  },
};
