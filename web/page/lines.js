// Exact lines, in a worker: they take longer than a picture. Ending the worker cancels an outdated search.

import { address } from "./files.js";

let module;
let worker;
let number = 0;
const waiting = new Map();

/** Says which program workers run. */
export const use = (compiled) => (module = compiled);

function started() {
  if (worker) return worker;
  worker = new Worker(address("worker.js"), { type: "module" });
  worker.addEventListener("message", ({ data }) => {
    const asked = waiting.get(data.number);
    waiting.delete(data.number);
    if (data.problem) asked?.reject(new Error(data.problem));
    else asked?.resolve(data.answer);
  });
  worker.postMessage({ module });
  return worker;
}

/** Sends the worker a request about a model; the promise stays pending if it is cancelled. */
export function ask(kind, model, options, ink) {
  number += 1;
  const asked = new Promise((resolve, reject) => waiting.set(number, { resolve, reject }));
  started().postMessage({ number, kind, model, options, ink });
  return asked;
}

/** Cancels the current work. */
export function cancel() {
  if (!waiting.size) return;
  waiting.clear();
  worker.terminate();
  worker = undefined;
}
