// The controls of both sides, of the scene that they share, and of the reading of models.

import { look as lookOf, refusal } from "./tinta.js";
import { lasts, say, sentence } from "./failures.js";
import { looks as looksOf } from "./looks.js";
import { element, panel } from "./panel.js";
import { styleOf } from "./state.js";

const at = (id) => document.getElementById(id);

/** Controls for the app; `save` is what the button of a side calls. */
export function sides(app) {
  const { tables, changed } = app;
  const used = looksOf(tables);

  /** A field of names for a side. */
  const choose = (name, label, names, value, change) => {
    const option = ({ text, title = "" }) => element("option", { value: text, textContent: text, title });
    const field = element("select", { id: `${name}-${label}` }, ...names.map(option));
    field.value = value;
    field.addEventListener("change", () => change(field.value));
    return element("label", {}, `${label} `, field);
  };

  /** The buffers of a side's style, a button each. */
  function buffers(name, side, shows) {
    const group = element("div", { id: `${name}-Buffer`, className: "buttons", role: "group", ariaLabel: "Buffer" });
    for (const text of shows) {
      const button = element("button", { type: "button", textContent: text, ariaPressed: String(side.show === text) });
      button.addEventListener("click", () => {
        changed(() => (side.show = text));
        for (const other of group.children) other.ariaPressed = String(other === button);
      });
      group.append(button);
    }
    return group;
  }

  function one(name) {
    const side = app.state().sides[name];
    const table = styleOf(tables, side);
    const style = choose(name, "Style", tables.styles.map((style) => ({ text: style.name })), side.style, (text) => chooseStyle(name, text));
    const looks = [{ text: "" }, ...tables.looks.map((look) => ({ text: look.name, title: look.about }))];
    const look = choose(name, "Look", looks, used(app.state(), side), (text) => text && chooseLook(name, text));
    const change = (setting, text) => {
      const problem = text === null ? undefined : refusal(side.style, setting, text);
      if (!problem) changed(() => (text === null ? delete side.settings[setting] : (side.settings[setting] = text)));
      return problem;
    };
    const published = element("button", { type: "button", id: `${name}-published`, textContent: "All as published" });
    published.addEventListener("click", () => {
      side.settings = {};
      changed(() => one(name));
    });
    const save = element("button", { type: "button", id: `${name}-save`, textContent: table.draws_lines ? "Save lines (SVG)" : "Save picture (PNG)" });
    save.addEventListener("click", () => app.save(name));
    const settings = element("details", {}, element("summary", { textContent: "Settings" }), published, ...panel(table.settings, side.settings, change));
    // Restores open parts and the focus.
    const openings = (of) => [...of.querySelectorAll("details")].map((details) => [details.querySelector("summary").textContent, details]);
    const before = new Map(openings(at(`${name}-side`)));
    const focused = document.activeElement?.id;
    for (const [heading, details] of [["Settings", settings], ...openings(settings)]) details.open = before.get(heading)?.open ?? false;
    const title = element("h2", { textContent: name === "left" ? "Left" : "Right" });
    const row = element("div", { className: "choices" }, style, look, save);
    at(`${name}-side`).replaceChildren(title, row, buffers(name, side, table.shows), element("p", { className: "cost" }), settings);
    if (focused?.startsWith(`${name}-`)) at(focused)?.focus();
  }

  /** The controls of what both sides share. */
  function shared() {
    for (const [part, title, apply] of [
      ["scene", "Scene", () => {}],
      ["read", "Reading of models", app.reread],
    ]) {
      const change = (name, text) => {
        const values = app.state()[part];
        const before = values[name];
        if (text === null) delete values[name];
        else values[name] = text;
        if (part === "read" && !apply()) {
          if (before === undefined) delete values[name];
          else values[name] = before;
          return at("status").textContent;
        }
        changed(() => {});
        return undefined;
      };
      at(part).replaceChildren(element("summary", { textContent: title }), ...panel(tables[part], app.state()[part], change));
    }
  }

  /** A look sets the style and settings of this side; scene and reading of both sides, and the view. */
  function chooseLook(name, text) {
    try {
      const { style, settings, scene, read, view } = JSON.parse(lookOf(text));
      const state = app.state();
      Object.assign(state.sides[name], { style, show: "final", settings });
      const before = JSON.stringify(state.read);
      for (const [part, values] of [["scene", scene], ["read", read]]) {
        for (const [setting, value] of Object.entries(values)) {
          if (value === null) delete state[part][setting];
          else state[part][setting] = value;
        }
      }
      if (view) app.pane()?.look(view, true);
      if (JSON.stringify(state.read) !== before) app.reread();
      all();
      changed(() => {});
    } catch (problem) {
      say(sentence(problem));
    }
  }

  function chooseStyle(name, style) {
    Object.assign(app.state().sides[name], { style, show: "final" });
    lasts("drawing");
    one(name);
    changed(() => {});
  }

  function all() {
    one("left");
    one("right");
    shared();
  }

  /** Shows which looks are in use. */
  function looks() {
    for (const name of ["left", "right"]) at(`${name}-Look`).value = used(app.state(), app.state().sides[name]);
  }

  return { one, all, looks, chooseStyle };
}
