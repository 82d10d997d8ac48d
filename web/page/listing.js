// A published shader beside its version for this browser, with the changes marked.

import { element } from "./panel.js";

/** Fills two elements from a listing's pieces: pairs of the original and its replacement. */
export function show(pieces, original, transcribed) {
  const column = (place) => pieces.map((pair) => (pair[0] === pair[1] ? pair[place] : element("mark", { textContent: pair[place] })));
  original.replaceChildren(...column(0));
  transcribed.replaceChildren(...column(1));
}
