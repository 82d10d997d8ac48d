// Pointers, wheel and keys on the stage: drags turn, two fingers zoom and move, keys are those of the window.

import { element } from "./panel.js";

/** What an arrow turns or moves by, a share of the picture's height; what + and - zoom by; what [ and ] move the divider by. */
const STEP = 1 / 24;
const ZOOM = 1.25;
const DIVIDE = 5;

/** Connects a stage with what it changes. */
export function hand(stage, { state, pane, changed, tables, chooseStyle, shownOf, keys, save }) {
  const pointers = new Map();
  let active = "left";
  let divides = false;

  const share = (pixels) => pixels / stage.clientHeight;
  const place = (event) => [event.clientX, event.clientY];
  const dividerAt = (event) => {
    const box = stage.getBoundingClientRect();
    return ((event.clientX - box.left) / box.width) * 100;
  };

  stage.addEventListener("pointerdown", (event) => {
    stage.setPointerCapture?.(event.pointerId);
    const reach = (event.pointerType === "touch" ? 22 : 8) / stage.clientWidth;
    divides = pointers.size === 0 && Math.abs(dividerAt(event) - state().divider) < reach * 100;
    active = dividerAt(event) < state().divider ? "left" : "right";
    pointers.set(event.pointerId, place(event));
  });
  stage.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const now = place(event);
    const [right, down] = [now[0] - before[0], now[1] - before[1]];
    const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
    pointers.set(event.pointerId, now);
    changed(() => {
      if (divides) state().divider = Math.min(100, Math.max(0, dividerAt(event)));
      else if (other) {
        const apart = (point) => Math.hypot(point[0] - other[0], point[1] - other[1]);
        pane()?.zoom(apart(now) / Math.max(apart(before), 1));
        pane()?.moveBy(share(right) / 2, share(down) / 2);
      } else if (event.buttons & 6 || event.shiftKey) pane()?.moveBy(share(right), share(down));
      else pane()?.turn(share(right), share(down));
    });
  });
  for (const end of ["pointerup", "pointercancel"]) stage.addEventListener(end, (event) => pointers.delete(event.pointerId));
  stage.addEventListener("contextmenu", (event) => event.preventDefault());
  stage.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      changed(() => pane()?.zoom(ZOOM ** (-Math.sign(event.deltaY) / 2)));
    },
    { passive: false },
  );

  const arrow = (right, down) => (shift) => (shift ? pane()?.moveBy(right * STEP, down * STEP) : pane()?.turn(right * STEP, down * STEP));
  const look = (plain, shifted) => (shift) => pane()?.look(shift ? shifted : plain);
  const divide = (by) => () => (state().divider = Math.min(100, Math.max(0, state().divider + by)));
  const actions = new Map([
    ["arrowleft", ["turn; with Shift move", arrow(-1, 0)]],
    ["arrowright", ["turn; with Shift move", arrow(1, 0)]],
    ["arrowup", ["turn; with Shift move", arrow(0, -1)]],
    ["arrowdown", ["turn; with Shift move", arrow(0, 1)]],
    ["+", ["nearer", () => pane()?.zoom(ZOOM)]],
    ["=", ["nearer", () => pane()?.zoom(ZOOM)]],
    ["-", ["farther", () => pane()?.zoom(1 / ZOOM)]],
    ["[", ["divider to the left", divide(-DIVIDE)]],
    ["]", ["divider to the right", divide(DIVIDE)]],
    ["r", ["whole model, first view", () => pane()?.reset()]],
    ["f", ["from the front; with Shift from the back", look("front", "back")]],
    ["l", ["from the left; with Shift from the right", look("left", "right")]],
    ["t", ["from the top; with Shift from below", look("top", "bottom")]],
    ["i", ["from a corner", look("iso", "iso")]],
    ["p", ["perspective or parallel projection", () => pane()?.project()]],
    ["o", ["the other side is the one that 1 to 9 and B change", () => (active = active === "left" ? "right" : "left")]],
    ["b", ["next buffer", () => nextBuffer()]],
    ["h", ["this sheet", () => keys.showModal()]],
  ]);
  tables.styles.forEach(({ name }, number) => actions.set(String(number + 1), [name, () => chooseStyle(active, name)]));

  function nextBuffer() {
    const side = state().sides[active];
    const { shows } = tables.styles.find((style) => style.name === side.style);
    side.show = shows[(shows.indexOf(side.show) + 1) % shows.length];
    shownOf(active);
  }

  keys.querySelector("dl").append(
    ...[...actions].flatMap(([key, [about]]) => [
      element("dt", {}, element("kbd", { textContent: key })),
      element("dd", { textContent: about }),
    ]),
    ...[["Ctrl S", "save the picture (PNG)"], ["Ctrl L", "save the exact lines (SVG)"]].flatMap(([key, about]) => [
      element("dt", {}, element("kbd", { textContent: key })),
      element("dd", { textContent: about }),
    ]),
  );
  addEventListener("keydown", (event) => {
    const key = event.key.toLowerCase();
    if ((event.ctrlKey || event.metaKey) && ["s", "l"].includes(key)) {
      event.preventDefault();
      (key === "s" ? save.png : save.svg).click();
      return;
    }
    const isField = event.target instanceof Element && event.target.closest("input, select, textarea, button, summary, pre, dialog");
    const action = actions.get(key);
    if (!action || isField || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    changed(() => action[1](event.shiftKey));
  });
  return () => active;
}
