// The page: it reads the state, draws both sides, and changes the state by the user's actions.

import init, { Pane, listing, shaders as shaderPaths, tables as tablesOf } from "./tinta.js";
import { lasts, say, sentence } from "./failures.js";
import { address, lesson, program } from "./files.js";
import { hand } from "./hand.js";
import { lectures } from "./lecture.js";
import * as lines from "./lines.js";
import { BESIDE, ofFiles, ofLesson, read as readModel } from "./model.js";
import { element } from "./panel.js";
import { saving } from "./save.js";
import { shaderEditor } from "./shaders.js";
import { sides } from "./sides.js";
import { linkOf, ofLink, options, styleOf } from "./state.js";
import { asking } from "./why.js";

const at = (id) => document.getElementById(id);
const NAMES = ["left", "right"];
/** Milliseconds without a change before the search for exact lines starts. */
const IDLE = 400;
/** Milliseconds after a movement until the picture is fine again. */
const REST = 200;
/** Milliseconds of a picture beyond which it has half the width and height while it moves. */
const SLOW = 30;
/** The most pixels of a picture: beyond, it is drawn smaller and shown larger. */
const MOST_PIXELS = 4e6;

const compiled = await program();
await init({ module_or_path: compiled });
lines.use(compiled);

const tables = JSON.parse(tablesOf());
const paths = JSON.parse(shaderPaths());
/** A shader's text as published; undefined for a path that no shader has. */
const published = (path) => (paths.includes(path) ? JSON.parse(listing(path)).map(([original]) => original).join("") : undefined);

let state = ofLink(location.hash || (lesson?.link ?? ""), tables, published);
let pane;
let shown;
let asked = false;
let moving = false;
let rest;
let idle;
let addressed;
let listed;
/** What each canvas shows, of which kind, the milliseconds of its last fine picture, whether it was the first of its kind, and its cost. */
const drawn = { left: {}, right: {} };

/** Everything that both pictures are drawn with but their styles, and a scale of their size. */
function sceneOptions(scale = 1) {
  const stage = at("stage");
  const dense = Math.min(devicePixelRatio, Math.sqrt(MOST_PIXELS / (stage.clientWidth * stage.clientHeight || 1)));
  const [width, height] = [stage.clientWidth, stage.clientHeight].map((side) => Math.max(1, Math.floor(side * dense * scale)));
  return { size: `${width}x${height}`, ...options(state.scene, tables.scene), ...options(state.read, tables.read) };
}

const sideOptions = (side, scale) => ({ style: side.style, ...sceneOptions(scale), ...options(side.settings, styleOf(tables, side).settings) });

/** The sides that the divider does not cover. */
const visible = () => NAMES.filter((name) => (name === "left" ? state.divider > 0 : state.divider < 100));

/** Draws what has changed before the next frame is shown. */
function draw() {
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => {
    asked = false;
    lines.cancel();
    clearTimeout(idle);
    place();
    if (!pane || !shown) return exactOnly();
    const problems = visible().map(drawSide);
    lasts("drawing", problems.find((problem) => problem));
    if (!moving && problems.every((problem) => !problem)) idle = setTimeout(measure, IDLE);
  });
}

/** Draws a side unless its canvas shows it already; returns what keeps it from being drawn. */
function drawSide(name) {
  const side = state.sides[name];
  const canvas = at(name);
  const overlay = at(`${name}-lines`);
  const isCoarse = moving && drawn[name].ms > SLOW;
  const wanted = JSON.stringify(sideOptions(side, isCoarse ? 0.5 : 1));
  const key = [wanted, side.show, pane.orbit(), shown.asked.key, JSON.stringify(state.shaders)].join(" ");
  if (drawn[name].key === key) {
    costLine(name).textContent ||= drawn[name].cost;
    return undefined;
  }
  const clear = () => canvas.getContext("2d").clearRect(0, 0, canvas.width, canvas.height);
  drawn[name].key = undefined;
  overlay.hidden = true;
  if (styleOf(tables, side).draws_lines) {
    clear();
    cost(name, "lines: found when the view rests");
    return undefined;
  }
  // The first picture of a kind also compiles shaders and uploads the model.
  const kind = JSON.stringify([side, shown.asked.key, state.shaders]);
  const isFirst = drawn[name].kind !== kind;
  const start = performance.now();
  try {
    const width = pane.draw(wanted, side.show, isCoarse && !Object.keys(state.shaders).length);
    const picture = new ImageData(new Uint8ClampedArray(pane.pixels()), width);
    if (canvas.width !== picture.width || canvas.height !== picture.height) {
      [canvas.width, canvas.height] = [picture.width, picture.height];
    }
    canvas.getContext("2d").putImageData(picture, 0, 0);
    const ms = performance.now() - start;
    Object.assign(drawn[name], { key, kind }, isCoarse ? {} : { ms, isFirst });
    if (isFirst) cost(name, `${side.style}: timed when the view rests`);
    else cost(name, `${side.style}: ${ms.toFixed(1)} ms a picture${isCoarse ? ", coarse while it moves" : ""}`);
    return undefined;
  } catch (problem) {
    // The old picture shows neither this style nor, soon, this view.
    clear();
    cost(name, `${side.style}: not drawn`);
    return problem;
  }
}

const costLine = (name) => at(`${name}-side`).querySelector(".cost");
const cost = (name, text) => (costLine(name).textContent = drawn[name].cost = text);

/** Places the divider, and the pictures left and right of it. */
function place() {
  const share = `${state.divider}%`;
  at("bar").style.left = share;
  for (const id of ["left", "left-lines"]) at(id).style.clipPath = `inset(0 ${100 - state.divider}% 0 0)`;
  for (const id of ["right", "right-lines"]) at(id).style.clipPath = `inset(0 0 0 ${share})`;
  at("divider").value = state.divider;
}

/** The options of the scene and its view, for any way of drawing; with those of a side, if one is given. */
function seen(side) {
  const scene = side ? sideOptions(side) : sceneOptions();
  return JSON.stringify({ ...scene, ...(pane ? JSON.parse(pane.camera(JSON.stringify(scene))) : {}) });
}

/** Once nothing has changed for a while: times still missing, the lines of a side of lines, the error of the others against them. */
async function measure() {
  for (const name of visible().filter((name) => drawn[name].isFirst && drawn[name].key)) {
    drawn[name].key = undefined;
    lasts("drawing", drawSide(name));
  }
  for (const name of visible()) {
    const side = state.sides[name];
    try {
      if (styleOf(tables, side).draws_lines) {
        at(`${name}-lines`).innerHTML = await lines.ask("view", shown.asked, seen(side));
        at(`${name}-lines`).hidden = false;
        cost(name, "lines: exact");
        continue;
      }
      const ink = pane.ink(JSON.stringify(sideOptions(side)));
      if (!ink) continue;
      const add = (text) => (costLine(name).textContent = `${drawn[name].cost}; ${text}`);
      add("looking for the exact lines …");
      const f1 = await lines.ask("error", shown.asked, seen(), ink);
      add(`line error ${(1 - f1).toFixed(3)} (1 − F1 against the exact lines)`);
    } catch (problem) {
      say(sentence(problem));
    }
  }
}

/** Without WebGL the exact lines are all there is. */
async function exactOnly() {
  if (!shown) return;
  try {
    at("exact").innerHTML = await lines.ask("view", shown.asked, seen());
    at("exact").hidden = false;
  } catch (problem) {
    say(sentence(problem));
  }
}

/** Shows a model, a built-in one by its name or a file, as it is read now; returns whether it can. */
function open(asked) {
  try {
    const read = readModel(asked, JSON.stringify(options(state.read, tables.read)));
    const about = JSON.parse(read.about());
    pane?.show(read);
    shown?.read.free();
    shown = { asked: { ...asked, key: `${asked.name} ${performance.now()}` }, read };
    state.model = asked.bytes ? "" : asked.name;
    at("model").value = state.model;
    say([`${about.name}: ${about.triangles} ${about.triangles === 1 ? "triangle" : "triangles"}.`, ...about.remarks].join(" "));
    at("exact").hidden = true;
    draw();
    lecture.refresh();
    return true;
  } catch (problem) {
    say(sentence(problem));
    at("model").value = state.model;
    return false;
  }
}

/** Opens another model than before, which is seen whole. */
function openNew(asked) {
  if (open(asked)) changed(() => pane?.reset());
}

/** Opens the model among files that were chosen or dropped. */
async function openFiles(files) {
  const model = await ofFiles(files);
  // The same file may be chosen again.
  at("file").value = "";
  if (model) openNew(model);
  else say(`None of these files is a model: choose one of ${tables.formats.map(({ name }) => name).join(", ")}, with the files that it names.`);
}

/** The model of the state: a built-in one, the lesson's, or the one that is shown. */
const modelOf = () =>
  state.model ? { name: state.model } : lesson?.files ? ofLesson(lesson, (name) => globalThis.tintaFiles.bytes(name)) : (shown?.asked ?? { name: "bust" });

/** Changes the state, draws it, and puts it into the address once nothing has changed for a while. */
function changed(change) {
  change();
  why.forget();
  if (pane) state.orbit = pane.orbit();
  draw();
  clearTimeout(addressed);
  addressed = setTimeout(() => history.replaceState(null, "", link()), IDLE);
  const styles = JSON.stringify([state.sides, state.shaders, state.divider > 0, state.divider < 100]);
  if (styles !== listed) {
    shaders.list();
    lecture.refresh();
  }
  listed = styles;
  controls.looks();
}

/** As `changed`, by a hand that is not done: what draws slowly is coarse meanwhile. */
function moved(change) {
  moving = true;
  clearTimeout(rest);
  rest = setTimeout(settle, REST);
  changed(change);
}

function settle() {
  clearTimeout(rest);
  if (!moving) return;
  moving = false;
  draw();
}

/** The address that shows the same. */
const link = () => `${location.pathname}${location.search}#${linkOf(state, published)}`;

/** Shows the state of a link. */
function follow(words) {
  const unknown = [];
  state = ofLink(words, tables, published, unknown);
  if (state.orbit) pane?.setOrbit(state.orbit);
  shaders.draw();
  controls.all();
  lecture.show();
  open(modelOf());
  changed(() => {});
  if (state.lecture && !at("lecture").value) unknown.push(`lecture=${state.lecture}`);
  // The link of a page in one file is the program's own.
  if (unknown.length && location.hash) say(`${at("status").textContent} The link has ${unknown.join(", ")}, unknown to this page.`);
}

/** What the other parts of the page may use and change. */
const app = {
  tables,
  published,
  state: () => state,
  pane: () => pane,
  shown: () => shown,
  visible,
  changed,
  moved,
  settle,
  draw,
  seen,
  sideOptions,
  sceneOptions,
  link,
  reread: () => open(modelOf()),
};
const shaders = shaderEditor(app);
const controls = sides(app);
const lecture = lectures(app, { shader: shaders.show, controls: controls.all });
const save = saving(app);
const why = asking(app);

/** Draws with WebGL from now on, or without it; what needs it is hidden then. */
function use(made) {
  pane = made;
  document.body.classList.toggle("lines-only", !made);
}

/** Opens WebGL, or explains why it failed. */
function begin() {
  const canvas = document.createElement("canvas");
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    lasts("webgl", "This browser's WebGL was lost; the exact lines are shown until it is back. If it does not come back, load the page again.");
    // Now, while nothing comes of it: whenever else it is collected, it deletes objects that the context it has again does not know.
    pane?.free();
    use(undefined);
    draw();
  });
  canvas.addEventListener("webglcontextrestored", () => {
    try {
      use(new Pane(canvas));
      pane.show(shown.read);
      shaders.draw();
      if (state.orbit) pane.setOrbit(state.orbit);
      at("exact").hidden = true;
      for (const name of NAMES) drawn[name] = {};
      lasts("webgl");
      say("WebGL is back.");
      draw();
    } catch (problem) {
      lasts("webgl", problem);
    }
  });
  try {
    use(new Pane(canvas));
    if (state.orbit) pane.setOrbit(state.orbit);
  } catch (problem) {
    use(undefined);
    lasts("webgl", `${problem.message} Only the exact lines are shown.`);
  }
  return canvas;
}

for (const { name, what } of tables.models) at("model").append(element("option", { value: name, textContent: `${name}: ${what}` }));
at("model").append(element("option", { value: "", textContent: lesson?.files ? lesson.files[0] : "your own", disabled: !lesson?.files }));
at("model").addEventListener("change", () => {
  state.model = at("model").value;
  openNew(modelOf());
});
at("file").accept = [...tables.formats.flatMap(({ endings }) => endings), ...BESIDE].map((ending) => `.${ending}`).join(",");
at("file").addEventListener("change", () => openFiles([...at("file").files]));
at("divider").addEventListener("input", () => changed(() => (state.divider = Number(at("divider").value))));
at("whole").addEventListener("click", () => changed(() => pane?.reset()));
at("licences").href = address("licences.txt");
at("key-sheet").addEventListener("click", () => at("keys").showModal());
const active = hand(at("stage"), app, { chooseStyle: controls.chooseStyle, side: controls.one, keys: at("keys"), why, save: { picture: (name) => save.picture(name), lines: () => at("svg").click() } });
for (const event of ["dragover", "drop"]) {
  addEventListener(event, (dropped) => {
    dropped.preventDefault();
    if (event === "drop" && dropped.dataTransfer?.files.length) openFiles([...dropped.dataTransfer.files]);
  });
}
addEventListener("hashchange", () => {
  if (location.hash.slice(1) !== linkOf(state, published)) follow(location.hash);
});
new ResizeObserver(draw).observe(at("stage"));

const canvas = begin();
follow(location.hash || (lesson?.link ?? ""));
// For whoever tests the page.
globalThis.tinta = { canvas, state: () => state, pane: () => pane, openFiles, active, link: () => link().replace(/^[^#]*/, ""), isMoving: () => moving };
