// The page: one store, one view, and the parts that use them.

import { Latest } from "./ask.js";
import { Store } from "./store.js";
import { View } from "./view.js";
import * as bounds from "./bounds.js";
import * as budget from "./budget.js";
import * as drawing from "./drawing.js";
import * as editor from "./editor.js";
import * as explaining from "./explaining.js";
import * as files from "./files.js";
import * as layers from "./layers.js";
import * as planning from "./planning.js";
import * as play from "./play.js";
import * as running from "./running.js";
import * as tabs from "./tabs.js";

const store = new Store();
const view = new View(document.getElementById("drawing"));
const planner = new Latest();

const parts = [
  tabs, drawing, editor, bounds, planning, layers, running, play, explaining, budget, files,
];
for (const part of parts) {
  part.mount({ store, view, planner });
}
