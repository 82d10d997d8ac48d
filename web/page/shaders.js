// The shaders of what is drawn: listed as published beside this browser's version, and edited.

import { listing } from "./tinta.js";
import { lasts, sentence } from "./failures.js";
import { element } from "./panel.js";
import { styleOf } from "./state.js";

const at = (id) => document.getElementById(id);

/** Connects listing and editor with the app. */
export function shaderEditor(app) {
  /** The shaders of the visible sides. */
  function used() {
    const found = new Set();
    for (const name of app.visible()) {
      const side = app.state().sides[name];
      try {
        const passes = JSON.parse(app.pane().passes(JSON.stringify(app.sideOptions(side)), side.show));
        passes.forEach((pass) => pass.shaders.forEach((path) => found.add(path)));
      } catch {
        // A side that is not drawn has none.
      }
    }
    return found;
  }

  function list() {
    if (!app.pane() || !app.shown()) return;
    const field = at("shader");
    const before = field.value;
    const found = used();
    field.replaceChildren(...[...found].map((path) => element("option", { value: path, textContent: label(path) })));
    if (found.has(before)) field.value = before;
    write();
  }

  const label = (path) => (path in app.state().shaders ? `${path} (changed)` : path);

  /** Opens the listing of a shader, whether or not it is drawn with. */
  function show(path) {
    const field = at("shader");
    if (![...field.options].some((option) => option.value === path)) field.append(element("option", { value: path, textContent: label(path) }));
    field.value = path;
    at("listings").open = true;
    write();
  }

  /** Fills listing and editor. */
  function write() {
    const path = at("shader").value;
    if (!path) return;
    const pieces = JSON.parse(listing(path, app.state().shaders[path]));
    const column = (place) => pieces.map((pair) => (pair[0] === pair[1] ? pair[place] : element("mark", { textContent: pair[place] })));
    at("original").replaceChildren(...column(0));
    at("transcribed").replaceChildren(...column(1));
    at("text").value = pieces.map(([original]) => original).join("");
    at("shader-problem").textContent = "";
    number();
  }

  /** Numbers the lines of the editor, as mistakes name them. */
  function number() {
    const { value, scrollTop } = at("text");
    at("numbers").textContent = value.split("\n").map((_, line) => line + 1).join("\n");
    at("numbers").scrollTop = scrollTop;
  }

  /** Draws with the shaders of the state. */
  function draw() {
    try {
      app.pane()?.replace_shaders(JSON.stringify(app.state().shaders));
      lasts("shaders");
    } catch (problem) {
      lasts("shaders", problem);
    }
  }

  /** Draws with a shader's text, or with the published one; a text that is refused stays in the editor. */
  function use(text) {
    const path = at("shader").value;
    const all = { ...app.state().shaders, [path]: text };
    if (text === null || text === app.published(path)) delete all[path];
    const problem = refusal(all);
    if (problem) {
      draw();
      return refuse(path, problem);
    }
    app.changed(() => (app.state().shaders = all));
    list();
    return undefined;
  }

  /** Why the browser refuses these shaders: it compiles them when it draws. */
  function refusal(all) {
    try {
      app.pane()?.replace_shaders(JSON.stringify(all));
      for (const name of app.visible()) {
        const side = app.state().sides[name];
        if (!styleOf(app.tables, side).draws_lines) app.pane()?.draw(JSON.stringify(app.sideOptions(side)), side.show, false);
      }
    } catch (problem) {
      // A side may lack something else that its style needs.
      return sentence(problem).includes("rejects the shader") ? sentence(problem) : undefined;
    }
    return undefined;
  }

  /** Says what is wrong under the text, and selects the line. */
  function refuse(path, problem) {
    const place = problem.indexOf(`${path}:`);
    const line = place < 0 ? NaN : Number.parseInt(problem.slice(place + path.length + 1), 10);
    const rows = at("text").value.split("\n");
    const isLine = line >= 1 && line <= rows.length;
    at("shader-problem").textContent = isLine ? `Line ${line}, “${rows[line - 1].trim()}”: ${problem}` : problem;
    if (isLine) {
      const start = rows.slice(0, line - 1).join("\n").length + (line > 1 ? 1 : 0);
      const field = at("text");
      field.focus({ preventScroll: true });
      field.setSelectionRange(start, start + rows[line - 1].length);
      field.scrollTop = (field.scrollHeight * (line - 1)) / rows.length - field.clientHeight / 2;
    }
    at("shader-problem").scrollIntoView({ block: "nearest" });
  }

  at("shader").addEventListener("change", write);
  at("edit").addEventListener("click", () => {
    at("editor").hidden = !at("editor").hidden;
    at("edit").ariaExpanded = String(!at("editor").hidden);
  });
  at("apply").addEventListener("click", () => use(at("text").value));
  at("published").addEventListener("click", () => use(null));
  for (const event of ["input", "scroll"]) at("text").addEventListener(event, number);
  at("text").addEventListener("keydown", (event) => {
    if (event.key === "Enter" && (event.ctrlKey || event.metaKey || event.altKey)) use(at("text").value);
  });
  return { list, show, draw };
}
