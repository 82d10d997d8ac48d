// A shader as it was published beside the same for this browser, with what had to change marked.

import { element } from "./panel.js";

/** Fills two elements from a listing's pieces: pairs of the original and what it became. */
export function show(pieces, original, transcribed) {
  const column = (place) => pieces.map((pair) => (pair[0] === pair[1] ? pair[place] : element("mark", { textContent: pair[place] })));
  original.replaceChildren(...column(0));
  transcribed.replaceChildren(...column(1));
}
