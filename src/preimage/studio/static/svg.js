// Elements and paths.

const SVG = "http://www.w3.org/2000/svg";

/** An SVG element with attributes and children; attributes that are null or false are left out. */
export function svg(name, attributes = {}, ...children) {
  return dressed(document.createElementNS(SVG, name), attributes, children);
}

/** An HTML element; `onclick` and the like are listeners, `dataset` is an object. */
export function html(name, attributes = {}, ...children) {
  return dressed(document.createElement(name), attributes, children);
}

function dressed(element, attributes, children) {
  for (const [key, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (key === "dataset") Object.assign(element.dataset, value);
    else element.setAttribute(key, value === true ? "" : value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

/** The path of an area: polygons, each a list of rings of points. Fill it by the even-odd rule. */
export function areaPath(area) {
  return area.map((polygon) => polygon.map((ring) => `${linePath(ring)}Z`).join("")).join("");
}

/** The path through points. */
export function linePath(points) {
  return points.map(([x, y], place) => `${place ? "L" : "M"}${x} ${y}`).join("");
}

/** The path of segments `[x0, y0, x1, y1]`. */
export function segmentsPath(segments) {
  return segments.map(([x0, y0, x1, y1]) => `M${x0} ${y0}L${x1} ${y1}`).join("");
}

/** The elements that draw a region: its area, its stretches of edges, its vertices. */
export function regionElements(region, kind, radius = 4) {
  const drawn = [];
  if (region.area.length) drawn.push(svg("path", { class: `${kind} area`, d: areaPath(region.area) }));
  if (region.edges.length) drawn.push(svg("path", { class: `${kind} edges`, d: segmentsPath(region.edges) }));
  for (const [x, y] of region.vertices) drawn.push(dot(x, y, `${kind} vertex`, radius));
  return drawn;
}

/** A dot of a radius in pixels, whatever the zoom: a line without length, with round ends. */
export function dot(x, y, kind, radius = 4) {
  return svg("path", { class: `${kind} dot`, d: `M${x} ${y}l0 0`, "stroke-width": 2 * radius });
}

/** An angle in degrees, and the arrow that shows it. */
export const unit = (degrees) => [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
