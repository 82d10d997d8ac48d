// Slow work about a model: its exact lines, and the error of a picture's ink against them.

import { read } from "./model.js";

let known;

/** The answer to a request: a "view" as SVG, a "file" of it with its recipe, or the "error" of ink. Its model is kept for the next one. */
export function found({ kind, model, options, ink }) {
  if (known?.key !== model.key) {
    known?.read.free();
    known = undefined;
    known = { key: model.key, read: read(model, options) };
  }
  return kind === "error" ? known.read.error(options, ink) : known.read.svg(options, kind === "file");
}
