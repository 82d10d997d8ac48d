// Which look a side is drawn in.

import { look as lookOf } from "./tinta.js";
import { styleOf } from "./state.js";

/** Finds the looks that the tables name. */
export function looks(tables) {
  const all = tables.looks.map(({ name }) => [name, JSON.parse(lookOf(name))]);

  /** Whether settings are, where the look or the side says something, those of the look; `table` has the defaults. */
  const isSame = (table, names, wanted, given) =>
    table.filter(({ name }) => names.includes(name)).every(({ name, default: usual }) => (wanted[name] ?? usual) === (given[name] ?? usual));

  /** The name of the look in use; empty for none. The view and what a look leaves open do not count. */
  return function used(state, side) {
    const { settings } = styleOf(tables, side);
    const found = all.find(
      ([, look]) =>
        look.style === side.style &&
        isSame(settings, settings.map(({ name }) => name), look.settings, side.settings) &&
        ["scene", "read"].every((part) => isSame(tables[part], Object.keys(look[part]), look[part], state[part])),
    );
    return found?.[0] ?? "";
  };
}
