// The page: it reads the state, draws both sides, and changes the state by the user's actions.

import init, { Pane, listing, look as lookOf, refusal, tables as tablesOf } from "./tinta.js";
import * as lines from "./lines.js";
import { ofFiles, read as readModel } from "./model.js";
import { show as showListing } from "./listing.js";
import { element, panel } from "./panel.js";
import { first, linkOf, ofLink, options, styleOf } from "./state.js";
import { hand } from "./hand.js";

const at = (id) => document.getElementById(id);
const NAMES = ["left", "right"];
/** Milliseconds without a change before the search for exact lines starts. */
const IDLE = 400;
/** The most pixels of a picture: beyond, it is drawn smaller and shown larger. */
const MOST_PIXELS = 4e6;

const compiled = await WebAssembly.compileStreaming(fetch("tinta_bg.wasm"));
await init({ module_or_path: compiled });
lines.use(compiled);

const tables = JSON.parse(tablesOf());
let state = ofLink(location.hash, tables);
let pane;
let shown;
let asked = false;
let idle;
let addressed;
let listedStyles;

const say = (text) => (at("status").textContent = text);
const fail = (problem) => {
  const isBug = problem instanceof WebAssembly.RuntimeError;
  say(isBug ? "This is a bug in tinta: report it with the model, and load the page again." : (problem.message ?? String(problem)));
};

/** Everything that both pictures are drawn with but their styles. */
function sceneOptions() {
  const stage = at("stage");
  const scale = Math.min(devicePixelRatio, Math.sqrt(MOST_PIXELS / (stage.clientWidth * stage.clientHeight || 1)));
  const [width, height] = [stage.clientWidth, stage.clientHeight].map((side) => Math.max(1, Math.floor(side * scale)));
  return { size: `${width}x${height}`, ...options(state.scene, tables.scene) };
}

const sideOptions = (side) => ({ style: side.style, ...sceneOptions(), ...options(side.settings, styleOf(tables, side).settings) });

/** Draws both sides before the next frame is shown. */
function draw() {
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => {
    asked = false;
    lines.cancel();
    clearTimeout(idle);
    if (!pane || !shown) return exactOnly();
    const problems = NAMES.map(drawSide).filter((problem) => problem);
    warn(problems[0]);
    place();
    if (!problems.length) idle = setTimeout(measure, IDLE);
  });
}

/** Draws a side; returns what keeps it from being drawn. */
function drawSide(name) {
  const side = state.sides[name];
  const start = performance.now();
  try {
    const width = pane.draw(JSON.stringify(sideOptions(side)), side.show);
    const pixels = new Uint8ClampedArray(pane.pixels());
    const canvas = at(name);
    const picture = new ImageData(pixels, width);
    if (canvas.width !== picture.width || canvas.height !== picture.height) {
      [canvas.width, canvas.height] = [picture.width, picture.height];
    }
    canvas.getContext("2d").putImageData(picture, 0, 0);
    cost(name, `${side.style}: ${(performance.now() - start).toFixed(1)} ms a picture`);
    return undefined;
  } catch (problem) {
    // The old picture shows neither this style nor, soon, this view.
    const canvas = at(name);
    canvas.getContext("2d").clearRect(0, 0, canvas.width, canvas.height);
    cost(name, `${side.style}: not drawn`);
    return problem;
  }
}

/** Says what keeps a side from being drawn, until nothing does. */
function warn(problem) {
  const status = at("status");
  if (problem) fail(problem);
  else if (status.classList.contains("warning")) say("");
  status.classList.toggle("warning", Boolean(problem));
}

const cost = (name, text) => (at(`${name}-side`).querySelector(".cost").textContent = text);

/** Places the divider, and the pictures left and right of it. */
function place() {
  const share = `${state.divider}%`;
  at("bar").style.left = share;
  at("left").style.clipPath = `inset(0 ${100 - state.divider}% 0 0)`;
  at("right").style.clipPath = `inset(0 0 0 ${share})`;
  at("divider").value = state.divider;
}

/** The options of the scene and its view, for any way of drawing. */
function seen() {
  const scene = sceneOptions();
  return JSON.stringify({ ...scene, ...(pane ? JSON.parse(pane.camera(JSON.stringify(scene))) : {}) });
}

/** Each side's error against the exact lines, once nothing has changed for a while. */
async function measure() {
  for (const name of NAMES) {
    const side = state.sides[name];
    try {
      const ink = pane.ink(JSON.stringify(sideOptions(side)));
      if (!ink) continue;
      const line = at(`${name}-side`).querySelector(".cost");
      const before = line.textContent;
      line.textContent = `${before}; looking for the exact lines …`;
      const f1 = await lines.ask("error", shown.asked, seen(), ink);
      line.textContent = `${before}; line error ${(1 - f1).toFixed(3)} (1 − F1 against the exact lines)`;
    } catch (problem) {
      fail(problem);
    }
  }
}

/** Without WebGL the exact lines are all there is. */
async function exactOnly() {
  if (!shown) return;
  try {
    at("exact").innerHTML = await lines.ask("svg", shown.asked, seen());
    at("exact").hidden = false;
  } catch (problem) {
    fail(problem);
  }
}

/** Shows a model: a built-in one by its name, or a file. */
async function open(asked) {
  try {
    const read = readModel(asked);
    const about = JSON.parse(read.about());
    pane?.show(read);
    shown?.read.free();
    shown = { asked: { key: `${asked.name} ${performance.now()}`, ...asked }, read };
    state.model = asked.bytes ? "" : asked.name;
    at("model").value = state.model;
    say([`${about.name}: ${about.triangles} triangles.`, ...about.remarks].join(" "));
    at("exact").hidden = true;
    draw();
  } catch (problem) {
    fail(problem);
  }
}

/** Opens the model among files that were chosen or dropped. */
async function openFiles(files) {
  const model = await ofFiles(files);
  if (model) await open(model);
  else fail(new Error("None of these files is a model: choose an OBJ, PLY, STL, glTF, MD2 or 3DS file with those that it names."));
}

/** The controls of a side. */
function sideControls(name) {
  const side = state.sides[name];
  const table = styleOf(tables, side);
  const choose = (label, names, value, change) => {
    const field = element("select", { id: `${name}-${label}` }, ...names.map((text) => element("option", { value: text, textContent: text })));
    field.value = value;
    field.addEventListener("change", () => change(field.value));
    return element("label", {}, `${label} `, field);
  };
  const style = choose("Style", tables.styles.map((style) => style.name), side.style, (text) => chooseStyle(name, text));
  const look = choose("Look", ["", ...tables.looks.map((look) => look.name)], "", (text) => text && chooseLook(name, text));
  const show = choose("Buffer", table.shows, side.show, (text) => changed(() => (side.show = text)));
  const change = (setting, text) => {
    const problem = text === null ? undefined : refusal(side.style, setting, text);
    if (!problem) changed(() => (text === null ? delete side.settings[setting] : (side.settings[setting] = text)));
    return problem;
  };
  const published = element("button", { type: "button", id: `${name}-published`, textContent: "All as published" });
  published.addEventListener("click", () => {
    side.settings = {};
    changed(() => sideControls(name));
  });
  const settings = element("details", {}, element("summary", { textContent: "Settings" }), published, ...panel(table.settings, side.settings, change));
  // Restores open parts and the focus.
  const openings = (of) => [...of.querySelectorAll("details")].map((details) => [details.querySelector("summary").textContent, details]);
  const before = new Map(openings(at(`${name}-side`)));
  const focused = document.activeElement?.id;
  for (const [heading, details] of [["Settings", settings], ...openings(settings)]) details.open = before.get(heading)?.open ?? false;
  const title = element("h2", { textContent: name === "left" ? "Left" : "Right" });
  at(`${name}-side`).replaceChildren(title, element("div", { className: "choices" }, style, look, show), element("p", { className: "cost" }), settings);
  if (focused?.startsWith(`${name}-`)) at(focused)?.focus();
}

/** The controls of what both sides share. */
function sceneControls() {
  const change = (name, text) => changed(() => (text === null ? delete state.scene[name] : (state.scene[name] = text)));
  const controls = panel(tables.scene.filter(({ name }) => name !== "size"), state.scene, change);
  at("scene").replaceChildren(element("summary", { textContent: "Scene" }), ...controls);
}

/** A look's style settings apply to this side, its scene settings to both. */
function chooseLook(name, text) {
  const { style, settings, scene } = JSON.parse(lookOf(text));
  Object.assign(state.sides[name], { style, show: "final", settings });
  for (const [setting, value] of Object.entries(scene)) {
    if (value === null) delete state.scene[setting];
    else state.scene[setting] = value;
  }
  sideControls(name);
  sceneControls();
  changed(() => {});
}

function chooseStyle(name, style) {
  Object.assign(state.sides[name], { style, show: "final" });
  sideControls(name);
  changed(() => {});
}

/** Changes the state, draws it, and puts it into the address once nothing has changed for a while. */
function changed(change) {
  change();
  if (pane) state.orbit = pane.orbit();
  draw();
  clearTimeout(addressed);
  addressed = setTimeout(() => history.replaceState(null, "", link()), IDLE);
  const styles = JSON.stringify([state.sides, state.model]);
  if (styles !== listedStyles) shaders();
  listedStyles = styles;
}

/** The address that shows the same. */
const link = () => `${location.pathname}${location.search}#${linkOf(state)}`;

/** The shaders of what both sides draw. */
function shaders() {
  if (!pane || !shown) return;
  const found = new Set();
  try {
    for (const name of NAMES) {
      const passes = JSON.parse(pane.passes(JSON.stringify(sideOptions(state.sides[name])), state.sides[name].show));
      passes.forEach((pass) => pass.shaders.forEach((path) => found.add(path)));
    }
  } catch {
    return;
  }
  const field = at("shader");
  const before = field.value;
  field.replaceChildren(...[...found].map((path) => element("option", { value: path, textContent: path })));
  if (found.has(before)) field.value = before;
  listed();
}

function listed() {
  if (!at("shader").value) return;
  const pieces = JSON.parse(listing(at("shader").value));
  showListing(pieces, at("original"), at("transcribed"));
  at("text").value = changedShaders[at("shader").value] ?? pieces.map(([original]) => original).join("");
}

/** Shaders that the reader has changed, by their paths. */
const changedShaders = {};

/** Draws with a shader's text, or with the one it was published with. */
function useShader(text) {
  const path = at("shader").value;
  if (text === null) delete changedShaders[path];
  else changedShaders[path] = text;
  try {
    pane?.replace_shaders(JSON.stringify(changedShaders));
  } catch (problem) {
    fail(problem);
  }
  listed();
  draw();
}

/** Hands a file to the reader. */
function save(name, content, type) {
  const link = element("a", { href: URL.createObjectURL(new Blob([content], { type })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/** Opens WebGL, or explains why it failed. */
function begin() {
  const canvas = document.createElement("canvas");
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    say("This browser's WebGL was lost; the exact lines are shown until it is back.");
    // Now, while nothing comes of it: whenever else it is collected, it deletes objects that the context it has again does not know.
    pane?.free();
    pane = undefined;
    draw();
  });
  canvas.addEventListener("webglcontextrestored", () => {
    try {
      pane = new Pane(canvas);
      pane.show(shown.read);
      pane.replace_shaders(JSON.stringify(changedShaders));
      if (state.orbit) pane.setOrbit(state.orbit);
      at("exact").hidden = true;
      say("WebGL is back.");
      draw();
    } catch (problem) {
      fail(problem);
    }
  });
  try {
    pane = new Pane(canvas);
    if (state.orbit) pane.setOrbit(state.orbit);
  } catch (problem) {
    at("status").classList.add("warning");
    fail(new Error(`${problem.message} Only the exact lines are shown.`));
  }
  return canvas;
}

for (const { name, what } of tables.models) at("model").append(element("option", { value: name, textContent: `${name}: ${what}` }));
at("model").append(element("option", { value: "", textContent: "your own", disabled: true }));
at("model").addEventListener("change", () => open({ name: at("model").value }).then(() => changed(() => {})));
at("file").addEventListener("change", () => openFiles(at("file").files));
at("divider").addEventListener("input", () => changed(() => (state.divider = Number(at("divider").value))));
at("shader").addEventListener("change", listed);
at("edit").addEventListener("click", () => (at("editor").hidden = !at("editor").hidden));
at("apply").addEventListener("click", () => useShader(at("text").value));
at("published").addEventListener("click", () => useShader(null));
at("whole").addEventListener("click", () => changed(() => pane?.reset()));
at("png").addEventListener("click", () => {
  const side = state.sides[active()];
  const all = JSON.stringify({ ...sideOptions(side), ...JSON.parse(seen()), ...(side.show === "final" ? {} : { show: side.show }) });
  try {
    pane.draw(all, side.show);
    save(`${state.model || "model"}-${side.style}.png`, pane.png(all, shown.read), "image/png");
  } catch (problem) {
    fail(problem);
  }
});
at("svg").addEventListener("click", async () => {
  try {
    save(`${state.model || "model"}-lines.svg`, await lines.ask("svg", shown.asked, seen(), true), "image/svg+xml");
  } catch (problem) {
    fail(problem);
  }
});
at("link").addEventListener("click", async () => {
  const isCopied = await navigator.clipboard?.writeText(location.origin + link()).then(() => true, () => false);
  if (!isCopied) history.replaceState(null, "", link());
  const said = isCopied ? "The link is copied" : "The address of this page shows the same";
  say(state.model ? `${said}.` : `${said}, but for a model of your own.`);
});
sceneControls();
const active = hand(at("stage"), { state: () => state, pane: () => pane, changed, tables, chooseStyle, shownOf: sideControls, keys: at("keys"), save: { png: at("png"), svg: at("svg") } });
for (const event of ["dragover", "drop"]) {
  addEventListener(event, (dropped) => {
    dropped.preventDefault();
    if (event === "drop" && dropped.dataTransfer?.files.length) openFiles(dropped.dataTransfer.files);
  });
}
addEventListener("hashchange", () => {
  if (location.hash.slice(1) === linkOf(state)) return;
  state = ofLink(location.hash, tables);
  if (state.orbit) pane?.setOrbit(state.orbit);
  NAMES.forEach(sideControls);
  open({ name: state.model });
});
new ResizeObserver(draw).observe(at("stage"));

NAMES.forEach(sideControls);
const canvas = begin();
await open({ name: state.model || first().model });
shaders();
// For whoever tests the page.
globalThis.tinta = { canvas, state: () => state, pane: () => pane, openFiles };
