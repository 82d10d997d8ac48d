// What keeps the page from drawing: sentences that stay until their cause is gone, apart from the news of the status line.

const lasting = new Map();
const at = (id) => document.getElementById(id);

/** Says something that holds for now. */
export const say = (text) => (at("status").textContent = text);

/** An error as a sentence. */
export function sentence(problem) {
  const isBug = problem instanceof WebAssembly.RuntimeError;
  return isBug ? "This is a bug in tinta: report it with the model, and load the page again." : (problem.message ?? String(problem));
}

/** Keeps a sentence about this matter in view; without one the matter is settled. */
export function lasts(matter, problem) {
  if (problem) lasting.set(matter, sentence(problem));
  else lasting.delete(matter);
  at("problem").textContent = [...new Set(lasting.values())].join(" ");
  at("problem").hidden = lasting.size === 0;
}
