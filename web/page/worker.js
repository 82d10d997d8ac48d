// Slow work outside the page: the exact lines of a model, and the error of a picture's ink.

import { read } from "./model.js";
import init from "./tinta.js";

let known;
let ready;

onmessage = async ({ data }) => {
  if (data.module) {
    ready = init({ module_or_path: data.module });
    return;
  }
  const { number, kind, model, options, ink } = data;
  try {
    await ready;
    if (known?.key !== model.key) {
      known?.read.free();
      known = { key: model.key, read: read(model, options) };
    }
    const answer = kind === "svg" ? known.read.svg(options, Boolean(ink)) : known.read.error(options, ink);
    postMessage({ number, answer });
  } catch (problem) {
    postMessage({ number, problem: problem.message ?? String(problem) });
  }
};
