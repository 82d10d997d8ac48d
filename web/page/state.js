// The state of the page: a plain value, and the link that holds it.

/** The state that a page begins with. */
export const first = () => ({
  model: "bust",
  lecture: "",
  divider: 50,
  sides: { left: { style: "three-pass", show: "final", settings: {} }, right: { style: "inking", show: "final", settings: {} } },
  scene: {},
  read: {},
  shaders: {},
  orbit: null,
});

/** A state as what follows the # of a link; a model of the reader's own is not in it. */
export function linkOf(state, published) {
  const words = new URLSearchParams();
  if (state.model) words.set("model", state.model);
  if (state.lecture) words.set("lecture", state.lecture);
  words.set("divider", state.divider);
  for (const [name, side] of Object.entries(state.sides)) {
    words.set(name, side.style);
    if (side.show !== "final") words.set(`${name}.show`, side.show);
    for (const [setting, value] of Object.entries(side.settings)) words.set(`${name}:${setting}`, value);
  }
  for (const part of ["scene", "read"]) {
    for (const [setting, value] of Object.entries(state[part])) words.set(`${part}:${setting}`, value);
  }
  for (const [path, text] of Object.entries(state.shaders)) words.set(`shader:${path}`, change(published(path), text));
  if (state.orbit) words.set("orbit", state.orbit);
  return words.toString();
}

/** The state in a link; missing parts have their initial values, and `unknown` receives the parts that mean nothing here. */
export function ofLink(link, tables, published, unknown = []) {
  const state = first();
  const words = new URLSearchParams(link.replace(/^#/, ""));
  if (words.size && !words.has("model")) state.model = "";
  const has = (table, setting) => table.some(({ name }) => name === setting);
  for (const [key, value] of words) {
    const [place, setting] = key.split(":");
    const side = state.sides[place.split(".")[0]];
    if (key === "model" && has(tables.models, value)) state.model = value;
    else if (key === "divider") state.divider = Math.min(100, Math.max(0, Number(value) || 0));
    else if (key === "orbit") state.orbit = value;
    else if (key === "lecture") state.lecture = value;
    else if (place === "shader" && published(setting)) state.shaders[setting] = changed(published(setting), value);
    else if (["scene", "read"].includes(place) && has(tables[place], setting)) state[place][setting] = value;
    else if (side && tables.styles.some(({ settings }) => has(settings, setting))) side.settings[setting] = value;
    else if (side && key === place && place.endsWith(".show")) side.show = value;
    else if (side && key === place && has(tables.styles, value)) side.style = value;
    else unknown.push(`${key}=${value}`);
  }
  for (const [name, side] of Object.entries(state.sides)) {
    if (styleOf(tables, side).shows.includes(side.show)) continue;
    unknown.push(`${name}.show=${side.show}`);
    side.show = "final";
  }
  return state;
}

/** The difference of two texts: where it begins, how many letters are cut there, what stands there instead. */
function change(before, after) {
  const shorter = Math.min(before.length, after.length);
  let start = 0;
  while (start < shorter && before[start] === after[start]) start += 1;
  let end = 0;
  while (end < shorter - start && before[before.length - 1 - end] === after[after.length - 1 - end]) end += 1;
  return `${start},${before.length - end - start},${after.slice(start, after.length - end)}`;
}

/** A text with a difference that `change` found. */
function changed(before, words) {
  const [, start, cut, text] = words.match(/^(\d+),(\d+),([^]*)$/) ?? [null, 0, 0, ""];
  return before.slice(0, Number(start)) + text + before.slice(Number(start) + Number(cut));
}

/** The table of a side's style. */
export const styleOf = (tables, side) => tables.styles.find((style) => style.name === side.style);

/** Options as the library reads them: flags are true or false, all else is text; those of other styles are left out. */
export function options(settings, table) {
  const found = {};
  for (const { name, kind } of table) {
    if (name in settings) found[name] = kind.is === "flag" ? settings[name] === "on" : settings[name];
  }
  return found;
}
