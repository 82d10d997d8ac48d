// Pointers, wheel and keys on the stage: drags turn, two fingers zoom and move, keys are those of the window.

import { element } from "./panel.js";
import { key_action as actionOf } from "./tinta.js";

/** Zoom factor of a notch of the wheel. */
const NOTCH = 1.118;

/** Connects a stage with the app that it changes; returns which side is meant by keys: the one last touched. */
export function hand(stage, { state, pane, changed, moved, settle, tables, visible }, { chooseStyle, side, keys, save, why }) {
  const pointers = new Map();
  let touched = "left";
  let divides = false;

  const share = (pixels) => pixels / stage.clientHeight;
  const place = (event) => [event.clientX, event.clientY];
  const dividerAt = (event) => {
    const box = stage.getBoundingClientRect();
    return ((event.clientX - box.left) / box.width) * 100;
  };

  stage.addEventListener("pointerdown", (event) => {
    if (why.asks(event)) return why.ask(event);
    stage.setPointerCapture?.(event.pointerId);
    const reach = (event.pointerType === "touch" ? 22 : 8) / stage.clientWidth;
    divides = pointers.size === 0 && Math.abs(dividerAt(event) - state().divider) < reach * 100;
    touched = dividerAt(event) < state().divider ? "left" : "right";
    pointers.set(event.pointerId, place(event));
  });
  stage.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const now = place(event);
    const [right, down] = [now[0] - before[0], now[1] - before[1]];
    const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
    pointers.set(event.pointerId, now);
    moved(() => {
      if (divides) state().divider = Math.min(100, Math.max(0, dividerAt(event)));
      else if (other) {
        const apart = (point) => Math.hypot(point[0] - other[0], point[1] - other[1]);
        pane()?.zoom(apart(now) / Math.max(apart(before), 1));
        pane()?.moveBy(share(right) / 2, share(down) / 2);
      } else if (event.buttons & 6 || event.shiftKey) pane()?.moveBy(share(right), share(down));
      else pane()?.turn(share(right), share(down));
    });
  });
  for (const end of ["pointerup", "pointercancel"]) stage.addEventListener(end, (event) => pointers.delete(event.pointerId) && settle());
  stage.addEventListener("contextmenu", (event) => event.preventDefault());
  stage.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      moved(() => pane()?.zoom(NOTCH ** -Math.sign(event.deltaY)));
    },
    { passive: false },
  );

  /** What each action of the table of keys does here. */
  const actions = {
    turn: ([right, down]) => pane()?.turn(right, down),
    move: ([right, down]) => pane()?.moveBy(right, down),
    zoom: (factor) => pane()?.zoom(factor),
    divide: (by) => (state().divider = Math.min(100, Math.max(0, state().divider + by * 100))),
    view: (name) => pane()?.look(name),
    style: (number) => chooseStyle(active(), tables.styles[number].name),
    "other-side": () => (touched = active() === "left" ? "right" : "left"),
    buffer: nextBuffer,
    reset: () => pane()?.reset(),
    projection: () => pane()?.project(),
    "save-picture": () => save.picture(active()),
    "save-lines": () => save.lines(),
    "key-sheet": () => keys.showModal(),
  };

  function nextBuffer() {
    const of = state().sides[active()];
    const { shows } = tables.styles.find((style) => style.name === of.style);
    of.show = shows[(shows.indexOf(of.show) + 1) % shows.length];
    side(active());
  }

  keys.querySelector("dl").append(
    ...tables.keys.flatMap(({ keys, what }) => [
      element("dt", {}, element("kbd", { textContent: keys })),
      element("dd", { textContent: what }),
    ]),
  );
  addEventListener("keydown", (event) => {
    const isHeld = event.ctrlKey || event.metaKey;
    const isField = event.target instanceof Element && event.target.closest("input, select, textarea, button, summary, pre, dialog");
    // Elsewhere than on the picture Ctrl L is the address's, and Ctrl S the page's.
    if (event.altKey || isField || (isHeld && event.target !== stage)) return;
    const found = JSON.parse(actionOf(event.key, event.shiftKey, isHeld));
    const [name, value] = found instanceof Object ? Object.entries(found)[0] : [found];
    // What only the window has is left to the browser.
    if (!Object.hasOwn(actions, name)) return;
    event.preventDefault();
    if (name.startsWith("save-")) actions[name]();
    else changed(() => actions[name](value));
  });
  /** A side that is covered is not meant. */
  function active() {
    return visible().includes(touched) ? touched : visible()[0];
  }
  return active;
}
