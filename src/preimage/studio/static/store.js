// What the page knows: the task, which is edited and can be undone, and what is looked at.

const KEPT = 200;

/**
 * The task document (files.md) with its history, and named values that are not part of it.
 *
 * Keys: `task`, `space`, `plan`, `busy`, `refusal`, `selected`, `tool`, `direction`, `goal`, `tab`, ….
 * Listeners are told after a change, once for each key.
 */
export class Store {
  #values = new Map();
  #listeners = new Map();
  #past = [];
  #future = [];
  #gesture = null;

  get(key) {
    return this.#values.get(key);
  }

  /** Set a value that is not undone. */
  set(key, value) {
    if (Object.is(this.#values.get(key), value)) return;
    this.#values.set(key, value);
    for (const listener of this.#listeners.get(key) ?? []) listener(value);
  }

  /** Call a listener now, if there is a value, and after each change; returns how to stop that. */
  on(key, listener) {
    if (!this.#listeners.has(key)) this.#listeners.set(key, new Set());
    this.#listeners.get(key).add(listener);
    if (this.#values.has(key)) listener(this.#values.get(key));
    return () => this.#listeners.get(key).delete(listener);
  }

  /** Begin with a task: what was before is forgotten unless `undoable`. */
  open(task, { undoable = false } = {}) {
    if (undoable && this.get("task")) this.#remember(this.get("task"), "open");
    else this.#past = [];
    this.#future = [];
    this.#gesture = null;
    this.set("plan", null);
    this.set("selected", null);
    this.set("task", structuredClone(task));
    this.#tellHistory();
  }

  /**
   * Change the task: `change` gets a copy, and may alter it. Changes with the same `gesture`, which
   * a drag makes up, are undone together.
   */
  edit(words, change, gesture = null) {
    const before = this.get("task");
    const after = structuredClone(before);
    change(after);
    if (JSON.stringify(before) === JSON.stringify(after)) return;
    if (gesture === null || gesture !== this.#gesture) this.#remember(before, words);
    this.#gesture = gesture;
    this.#future = [];
    this.set("task", after);
    this.#tellHistory();
  }

  undo() {
    this.#step(this.#past, this.#future);
  }

  redo() {
    this.#step(this.#future, this.#past);
  }

  #step(from, to) {
    const entry = from.pop();
    if (!entry) return;
    to.push({ task: this.get("task"), words: entry.words });
    this.#gesture = null;
    this.set("selected", null);
    this.set("task", entry.task);
    this.#tellHistory();
  }

  #remember(task, words) {
    this.#past.push({ task, words });
    if (this.#past.length > KEPT) this.#past.shift();
  }

  #tellHistory() {
    this.set("history", { undo: this.#past.at(-1)?.words ?? null, redo: this.#future.at(-1)?.words ?? null });
  }
}
