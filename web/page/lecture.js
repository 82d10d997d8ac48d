// A lecture: a document of docs/ beside its figure, live, and the shaders it speaks of.

import init, { Model, Pane, listing, tables as tablesOf } from "./tinta.js";
import { blocks } from "./markdown.js";
import { element } from "./panel.js";

/** The document of each lecture, the style it is about, the model that shows it. */
const LECTURES = {
  evangelista: { document: "how-evangelista-works.md", style: "three-pass", model: "bust" },
  dachsbacher: { document: "how-dachsbacher-works.md", style: "inking", model: "bust" },
  valente: { document: "how-valente-works.md", style: "charcoal", model: "bust" },
};

const at = (id) => document.getElementById(id);
const { document: file, style, model: name } = LECTURES[location.search.slice(1)] ?? LECTURES.evangelista;
const fail = (problem) => (at("status").textContent = problem.message ?? String(problem));

const [text] = await Promise.all([fetch(file).then((answer) => answer.text()), init()]);
const shows = JSON.parse(tablesOf()).styles.find((other) => other.name === style).shows;
const model = Model.builtin(name);
let pane;
let show = "final";

/** A picture of the document: live where its column names a buffer, else the document's. */
function picture(alternative, address, heading) {
  const named = heading?.match(/^`--show (\w+)`/)?.[1];
  if (!named || !pane) return element("img", { src: address, alt: alternative, loading: "lazy" });
  const canvas = element("canvas", { className: "buffer", role: "img", ariaLabel: alternative });
  draw(canvas, named, "240x240");
  canvas.addEventListener("click", () => choose(named));
  return canvas;
}

/** Draws a buffer of the style onto a canvas. */
function draw(canvas, buffer, size) {
  try {
    const width = pane.draw(JSON.stringify({ style, size }), buffer);
    const image = new ImageData(new Uint8ClampedArray(pane.pixels()), width);
    [canvas.width, canvas.height] = [image.width, image.height];
    canvas.getContext("2d").putImageData(image, 0, 0);
  } catch (problem) {
    fail(problem);
  }
}

function figure() {
  if (!pane) return;
  const side = Math.max(64, Math.round(at("figure").clientWidth * Math.min(devicePixelRatio, 2)));
  draw(at("figure"), show, `${side}x${side}`);
}

function choose(buffer) {
  show = buffer;
  for (const button of at("buffers").children) button.ariaPressed = String(button.textContent === buffer);
  figure();
}

function shader(path) {
  at("shader").value = path;
  const pieces = JSON.parse(listing(path));
  at("listing").textContent = pieces.map(([original]) => original).join("");
}

try {
  pane = new Pane(document.createElement("canvas"));
  pane.show(model);
  at("status").textContent = "";
} catch (problem) {
  fail(problem);
}
at("text").append(...blocks(text, picture));
document.title = `tinta: ${at("text").querySelector("h1").textContent}`;

for (const buffer of shows) {
  const button = element("button", { type: "button", textContent: buffer });
  button.addEventListener("click", () => choose(buffer));
  at("buffers").append(button);
}

// The shaders that the document names, each a way to its listing.
const named = [...new Set([...text.matchAll(/`glsl\/([\w/-]+\.(?:vert|frag))`/g)].map((match) => match[1]))];
at("shader").append(...named.map((path) => element("option", { value: path, textContent: path })));
at("shader").addEventListener("change", () => shader(at("shader").value));
for (const code of at("text").querySelectorAll("code")) {
  const path = code.textContent.replace(/^glsl\//, "");
  if (!named.includes(path)) continue;
  const link = element("button", { type: "button", className: "code" });
  code.replaceWith(link);
  link.append(code);
  link.addEventListener("click", () => shader(path));
}
if (named.length) shader(named[0]);
choose("final");

const canvas = at("figure");
const turned = (right, down) => {
  pane?.turn(right, down);
  requestAnimationFrame(figure);
};
canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
canvas.addEventListener("pointermove", (event) => {
  if (event.buttons) turned(event.movementX / canvas.clientHeight, event.movementY / canvas.clientHeight);
});
canvas.addEventListener("keydown", (event) => {
  const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
  if (!step) return;
  event.preventDefault();
  turned(step[0] / 24, step[1] / 24);
});
