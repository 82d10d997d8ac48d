// Tests of a page that is opened from a folder, by a double click: they run inside it, and report to the server that has them.

import { assert, byteDifference, drawn, finish, test, until } from "./harness.js";

const at = (id) => document.getElementById(id);
/** What becomes of workers here: serve.py breaks them in some pages. */
const workers = globalThis.workers ?? "good";

const choose = (field, value) => {
  at(field).value = value;
  at(field).dispatchEvent(new Event("change"));
};
const cost = (name) => at(`${name}-side`).querySelector(".cost").textContent;
/** Whether a browser has no WebGL here: lines then stand above all else. */
const isExactOnly = () => at("problem").textContent.includes("Only the exact lines are shown");
const hasLines = () => {
  const lines = at(isExactOnly() ? "exact" : "left-lines");
  return !lines.hidden && lines.querySelector("svg path");
};

const addressOf = URL.createObjectURL;

/** Presses the button for exact lines; the file that the reader gets. */
async function saved() {
  let file;
  URL.createObjectURL = (blob) => {
    if (blob.type !== "image/svg+xml") return addressOf(blob);
    file = blob;
    return "#";
  };
  HTMLAnchorElement.prototype.click = () => {};
  at("svg").click();
  await until(() => file || /search for lines ended/.test(at("status").textContent), "the file, or why there is none");
  return file?.text();
}

const named = (name, work) => test(`${globalThis.opening}: ${name}`, work);

await named("the page starts", () => {
  assert(location.protocol === "file:", location.href);
  return until(() => globalThis.tinta, "the page");
});

await named("the saved lines are the command line's SVG", async () => {
  const text = await saved();
  const size = text.match(/width="(\d+)" height="(\d+)"/).slice(1).join("x");
  const expected = new TextDecoder().decode(await drawn("builtin:gear", "--style", "lines", "--size", size, "drawn.svg"));
  assert(text === expected, byteDifference(text, expected));
});

await named("lines for a file are found though the view moves meanwhile", async () => {
  const file = saved();
  at("whole").click();
  assert((await file).includes("<path"), "the file");
});

await named("a side of lines shows them", async () => {
  choose("left-Style", "lines");
  await until(hasLines, "the lines");
  choose("left-Style", "phong");
  choose("left-Look", "technical");
  await until(hasLines, "the lines of the look technical");
});

await named("what needs WebGL is offered where it is", () => {
  const isShown = (id) => at(id).getClientRects().length > 0;
  for (const id of ["ask", "whole", "dividing", "listings", "left-side"]) assert(isShown(id) === !isExactOnly(), id);
  assert(isShown("svg"), "the exact lines can be saved anywhere");
  if (!isExactOnly()) return;
  at("stage").setPointerCapture = () => {};
  for (const event of ["pointerdown", "pointerup"]) at("stage").dispatchEvent(new PointerEvent(event, { altKey: true, pointerId: 1 }));
  assert(at("why").hidden, at("why").textContent);
});

await named("the other side's error against them is said", async () => {
  if (isExactOnly()) return "SKIPPED: this browser has no WebGL here";
  await until(() => cost("right").includes("line error 0."), "the error");
  // It is measured again with each change of the other side.
  assert(cost("right").match(/line error/g).length === 1, cost("right"));
  return cost("right");
});

await named("what became of the worker is said", async () => {
  const isAlone = /stands still/.test(at("problem").textContent) && !at("problem").hidden;
  assert(isAlone === ["none", "failing"].includes(workers), at("problem").textContent || "nothing is said");
  if (isAlone) return at("problem").textContent;
  globalThis.ends = true;
  assert((await saved()) === undefined, "a worker that ends finds nothing");
  const said = at("status").textContent;
  globalThis.ends = false;
  at("status").textContent = "";
  assert((await saved()).includes("<path"), "the next one does");
  return said;
});

await finish();
