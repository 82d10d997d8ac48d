// The worker that answers requests for slow work. web/classic_worker.py joins it to one script with what it imports: from a folder,
// Chromium starts no worker that is a module.

import { found } from "./search.js";
import init from "./tinta.js";

let ready;

onmessage = async ({ data }) => {
  if (data.module) {
    ready = init({ module_or_path: data.module });
    return;
  }
  try {
    await ready;
    postMessage({ number: data.number, answer: found(data) });
  } catch (problem) {
    postMessage({ number: data.number, problem: problem.message ?? String(problem) });
  }
};

// A program that did not arrive: the page hears of an error.
onmessageerror = () => {
  throw new Error("the program did not reach the worker");
};
