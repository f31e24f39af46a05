// Questions to the planner, which answers from a process of its own.

/** A question that was refused: bad input (with its place), a limit, or no answer. */
export class Refusal extends Error {
  constructor(words, where = "") {
    super(words);
    this.where = where;
  }
}

/**
 * Ask a question; `signal` takes it back, which ends the work.
 *
 * The answer comes as lines of JSON: any number of `{"progress": …}`, then one of `{"answer": …}`,
 * `{"refused": {"where", "words"}}` and `{"failed": "…"}`.
 */
export async function ask(question, body, { signal, progress } = {}) {
  const response = await fetch(`ask/${question}`, {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify(body),
    signal,
  });
  if (!response.ok) throw new Refusal((await response.text()) || response.statusText);
  let rest = "";
  for await (const chunk of texts(response.body)) {
    const lines = (rest + chunk).split("\n");
    rest = lines.pop();
    for (const line of lines.filter(Boolean)) {
      const said = JSON.parse(line);
      if ("answer" in said) return said.answer;
      if ("refused" in said) throw new Refusal(said.refused.words, said.refused.where);
      if ("failed" in said) throw new Refusal(said.failed);
      progress?.(said.progress);
    }
  }
  throw new Refusal("the connection ended without an answer");
}

async function* texts(stream) {
  const reader = stream.pipeThrough(new TextDecoderStream()).getReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return;
    yield value;
  }
}

/** One question at a time: a newer one takes the older one back. */
export class Latest {
  #controller = null;

  async ask(question, body, options = {}) {
    this.cancel();
    const controller = new AbortController();
    this.#controller = controller;
    try {
      return await ask(question, body, { ...options, signal: controller.signal });
    } finally {
      if (this.#controller === controller) this.#controller = null;
    }
  }

  get busy() {
    return this.#controller !== null;
  }

  cancel() {
    this.#controller?.abort();
    this.#controller = null;
  }
}
