// Files that are opened and saved, the gallery, links that carry the task, pictures.

import { Refusal, ask } from "./ask.js";
import { refusalOf } from "./drawing.js";
import { areaPath, dot, html, segmentsPath, svg } from "./svg.js";
import { mountTour } from "./tour.js";

const MOST_LINK = 200_000;
const MOST_FILE = 2 ** 21;

export function mount({ store, view, planner }) {
  const byId = (id) => document.getElementById(id);
  byId("open").onclick = () => byId("file").click();
  byId("file").onchange = (event) => event.target.files[0] && open(store, event.target.files[0]).finally(
    () => { event.target.value = ""; },
  );
  byId("gallery-open").onclick = () => showGallery(store);
  byId("link").onclick = () => makeLink(store);
  byId("help").onclick = () => byId("keys").showModal();
  byId("save").onchange = (event) => {
    const { value } = event.target;
    event.target.value = "";
    if (value) save(store, view, value);
  };
  document.addEventListener("dragover", (event) => event.preventDefault());
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    const [file] = event.dataTransfer.files;
    if (file) open(store, file);
  });
  store.on("history", ({ undo }) => { if (undo !== null) store.set("saved", false); });
  window.addEventListener(
    "beforeunload", (event) => { if (store.get("saved") === false) event.preventDefault(); },
  );
  window.addEventListener("hashchange", () => begin(store));
  mountTour({ store, view, planner });
  begin(store);
}

/** What the page begins with: its link's task, the command's, or peg in hole. */
async function begin(store) {
  try {
    const linked = await fromLink(location.hash).catch((error) => {
      throw error instanceof Refusal ? error : new Refusal(
        "is not whole: was all of it copied?", "the link",
      );
    });
    if (linked) return openTask(store, (await ask("space", { task: linked })).task, "from the link");
    const given = store.get("task") ? null : await (await fetch("given")).json();
    if (given?.plan) return await openPlan(store, given.plan);
    if (given?.task) return openTask(store, given.task, given.task.name);
  } catch (error) {
    tell(store, error);
  }
  if (store.get("task")) return;
  try {
    store.open((await ask("example", { name: "peg-in-hole" })).task);
    store.set("saved", true);
  } catch (error) {
    tell(store, error);
  }
}

function tell(store, error) {
  const { where, words } = refusalOf(error);
  store.set("announce", [where, words].filter(Boolean).join(": "));
}

function openTask(store, task, from) {
  store.open(task, { undoable: true });
  store.set("saved", true);
  store.set("announce", `Opened ${from}.`);
}

async function openPlan(store, data) {
  const plan = await ask("plan_file", { plan: data });
  openTask(store, plan.plan.task, "the plan");
  store.set("plan", plan);
  store.set("tab", "plan");
}

async function open(store, file) {
  try {
    if (file.size > MOST_FILE) throw new Refusal(`is larger than ${MOST_FILE} bytes`, file.name);
    const text = await file.text();
    const kind = { json: "json", toml: "toml" }[file.name.split(".").pop().toLowerCase()] ?? "yaml";
    const plan = kind === "json" ? planIn(text) : null;
    if (plan) await openPlan(store, plan);
    else openTask(store, (await ask("read", { text, format: kind })).task, file.name);
  } catch (error) {
    tell(store, error);
  }
}

function planIn(text) {
  try {
    const data = JSON.parse(text);
    return data?.regions && data?.task ? data : null;
  } catch {
    return null; // the studio says what is wrong with it
  }
}

async function save(store, view, kind) {
  try {
    if (kind === "seen") return download("drawing.svg", "image/svg+xml", standalone(view));
    const plan = store.get("plan")?.plan;
    if (["plan", "gif", "html"].includes(kind) && !plan) throw new Refusal("there is no plan yet");
    if (kind === "plan") return download(
      `${plan.task.name}.json`, "application/json", JSON.stringify(plan, null, 1),
    );
    store.set("announce", "Working …");
    if (["yaml", "json", "toml"].includes(kind)) {
      const { name, text } = await ask("write", { task: store.get("task"), format: kind });
      download(name, "text/plain", text);
      store.set("saved", true);
    } else {
      const question = ["gif", "html"].includes(kind) ? "film" : "draw";
      const { name, media, base64 } = await ask(
        question, { ...(plan ? { plan } : { task: store.get("task") }), format: kind },
      );
      download(name, media, Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0)));
    }
    store.set("announce", "Saved.");
  } catch (error) {
    tell(store, error);
  }
}

function download(name, type, content) {
  const address = URL.createObjectURL(new Blob([content], { type }));
  const link = html("a", { href: address, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** The drawing as a file of its own: what styles say is written into it. */
function standalone(view) {
  const copy = view.element.cloneNode(true);
  const from = [view.element, ...view.element.querySelectorAll("*")];
  [copy, ...copy.querySelectorAll("*")].forEach((element, place) => {
    const style = getComputedStyle(from[place]);
    for (const name of ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-opacity", "stroke-dasharray", "stroke-linecap", "fill-rule", "font", "text-anchor", "vector-effect", "paint-order", "display"]) {
      element.style.setProperty(name, style.getPropertyValue(name));
    }
    for (const name of ["tabindex", "role", "aria-label"]) element.removeAttribute(name);
  });
  copy.querySelector("[data-layer=handles]")?.remove();
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.setAttribute("viewBox", `0 0 ${view.element.clientWidth} ${view.element.clientHeight}`);
  return new XMLSerializer().serializeToString(copy);
}

// --- the gallery ---------------------------------------------------------------------------------

async function showGallery(store) {
  const dialog = document.getElementById("gallery");
  const list = document.getElementById("gallery-list");
  dialog.showModal();
  if (
    list.children.length && ![...list.querySelectorAll("svg")].some((picture) => !picture.children.length)
  ) return;
  try {
    const { examples } = await ask("examples", {});
    list.replaceChildren(...examples.map(({ name, words }) => html("li", {}, html("button", {
      type: "button", "data-example": name,
      onclick: async () => {
        dialog.close();
        try {
          openTask(store, (await ask("example", { name })).task, name);
        } catch (error) {
          tell(store, error);
        }
      },
    }, svg("svg", { "aria-hidden": true }), html("strong", {}, name), html("small", {}, words)))));
    // some at a time: a studio answers few questions at once
    const waiting = [...list.querySelectorAll("button")];
    const next = async () => { while (waiting.length) await drawSmall(dialog, waiting.shift()); };
    await Promise.all([next(), next(), next()]);
  } catch (error) {
    tell(store, error);
  }
}

async function drawSmall(dialog, button) {
  if (!dialog.open) return;
  if (button.querySelector("svg").children.length) return;
  const { task } = await ask("example", { name: button.dataset.example });
  const space = await ask("space", { task });
  const [x0, y0, x1, y1] = space.window;
  const picture = button.querySelector("svg");
  const sides = {
    left: [x0, y0, x0, y1], right: [x1, y0, x1, y1], bottom: [x0, y0, x1, y0], top: [x0, y1, x1, y1],
  };
  picture.setAttribute("viewBox", `${x0} ${-y1} ${x1 - x0} ${y1 - y0}`);
  const turned = svg("g", { class: "plane", transform: "scale(1 -1)" },
    svg("path", { class: "solid area", d: areaPath(space.solid) }),
    svg("path", { class: "c-obstacle area", d: areaPath(space.obstacles) }),
    svg("path", { class: "goal area", d: areaPath(space.goal.area) }),
    ...space.task.walls.map(
      (side) => svg("path", { class: "side wall", d: segmentsPath([sides[side]]) }),
    ),
    svg("path", { class: "goal edges", d: segmentsPath(space.goal.edges) }),
    ...space.goal.vertices.map(([x, y]) => dot(x, y, "goal vertex", 4)),
    ...space.start.vertices.slice(0, 1).map(([x, y]) => dot(x, y, "start vertex", 3)));
  picture.replaceChildren(turned);
}

// --- links ---------------------------------------------------------------------------------------

async function makeLink(store) {
  try {
    const { task } = await ask("space", { task: store.get("task") });
    const packed = new Blob([JSON.stringify(task)]).stream().pipeThrough(
      new CompressionStream("deflate-raw"),
    );
    const bytes = new Uint8Array(await new Response(packed).arrayBuffer());
    const text = btoa(
      String.fromCharCode(...bytes.slice(0, 60_000)),
    ).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
    if (bytes.length > 60_000) throw new Refusal("the task is too large for a link: save it as a file");
    const address = `${location.origin}${location.pathname}#task=${text}`;
    history.replaceState(null, "", address);
    await navigator.clipboard?.writeText(address).catch(() => null);
    store.set("announce", "The address of this page now carries the task; it is in the clipboard too.");
  } catch (error) {
    tell(store, error);
  }
}

/** The task that a link carries, or null; read in pieces, since little may become much. */
async function fromLink(hash) {
  const packed = /^#task=([\w-]+)$/.exec(hash)?.[1];
  if (!packed) return null;
  const bytes = Uint8Array.from(
    atob(packed.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt(0),
  );
  const reader = new Blob([bytes]).stream().pipeThrough(
    new DecompressionStream("deflate-raw"),
  ).getReader();
  const parts = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > MOST_LINK) throw new Refusal("holds more than a task should", "the link");
    parts.push(value);
  }
  return JSON.parse(await new Blob(parts).text());
}
