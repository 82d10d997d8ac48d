// Exact lines, in a worker: they take longer than a picture. Ending the worker cancels an outdated search. Where no worker starts, the
// page's own thread finds them.

import { lasts } from "./failures.js";
import { address } from "./files.js";
import { found } from "./search.js";

let module;
let worker;
let number = 0;
/** Whether a worker has ever answered here. */
let hasAnswered = false;
/** Whether no worker starts here. */
let isAlone = false;
const waiting = new Map();

/** Says which program workers run. */
export const use = (compiled) => (module = compiled);

function started() {
  if (worker) return worker;
  worker = new Worker(address("worker.js"));
  worker.addEventListener("message", ({ data }) => {
    hasAnswered = true;
    const asked = waiting.get(data.number);
    waiting.delete(data.number);
    if (data.problem) asked?.reject(new Error(data.problem));
    else asked?.resolve(data.answer);
  });
  worker.addEventListener("error", (event) => {
    event.preventDefault();
    failed(event.message);
  });
  worker.postMessage({ module });
  return worker;
}

/** The worker is no more: what waits for it is rejected, or found here if none has ever answered. */
function failed(reason) {
  const lost = end();
  if (hasAnswered) {
    const problem = new Error(`The search for lines ended (${reason || "the browser gives no reason"}); change the view to start it again.`);
    lost.forEach(({ reject }) => reject(problem));
    return;
  }
  isAlone = true;
  lasts("worker", new Error("This browser starts no worker for this page: while it looks for lines, the page stands still."));
  lost.forEach(findHere);
}

/** Finds an answer on the page's own thread, once the page has shown that it looks. */
function findHere(asked) {
  waiting.set(asked.request.number, asked);
  setTimeout(() => {
    if (!waiting.delete(asked.request.number)) return;
    try {
      asked.resolve(found(asked.request));
    } catch (problem) {
      asked.reject(problem);
    }
  }, 20);
}

/** Answers a request about a model; the promise stays pending if it is cancelled. */
export function ask(kind, model, options, ink) {
  number += 1;
  const request = { number, kind, model, options, ink };
  return new Promise((resolve, reject) => send({ request, resolve, reject }));
}

function send(asked) {
  if (isAlone) return findHere(asked);
  waiting.set(asked.request.number, asked);
  try {
    started().postMessage(asked.request);
  } catch (problem) {
    failed(problem.message);
  }
  return undefined;
}

/** Cancels the current work for what is seen; what is searched for a file begins again. */
export function cancel() {
  if (![...waiting.values()].some(({ request }) => request.kind !== "file")) return;
  end().filter(({ request }) => request.kind === "file").forEach(send);
}

/** Ends the worker; what waited for it. */
function end() {
  const lost = [...waiting.values()];
  waiting.clear();
  worker?.terminate();
  worker = undefined;
  return lost;
}
