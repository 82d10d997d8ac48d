// A pixel explained: Alt and a click, or the button and then a click, on the picture.

import { sentence } from "./failures.js";

const at = (id) => document.getElementById(id);

/** Connects the button; the result says whether a press on the picture asks, and asks. */
export function asking({ state, pane, visible, sideOptions }) {
  const button = at("ask");
  const text = at("why").querySelector("pre");
  const set = (is) => {
    button.setAttribute("aria-pressed", is);
    at("stage").classList.toggle("asks", is);
  };
  const asks = () => button.getAttribute("aria-pressed") === "true";
  button.addEventListener("click", () => set(!asks()));

  /** Explains the pixel under a pointer. */
  function ask(event) {
    set(false);
    const box = at("stage").getBoundingClientRect();
    const [right, down] = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
    const name = visible().length === 1 ? visible()[0] : right * 100 < state().divider ? "left" : "right";
    const options = sideOptions(state().sides[name]);
    const [width, height] = options.size.split("x").map(Number);
    Object.assign(at("asked").style, { left: `${right * 100}%`, top: `${down * 100}%` });
    at("asked").hidden = at("why").hidden = false;
    try {
      text.textContent = pane().why(JSON.stringify(options), Math.floor(right * width), Math.floor(down * height));
    } catch (problem) {
      text.textContent = sentence(problem);
    }
    text.scrollTop = 0;
  }

  /** The picture has changed: what was said is of another one. */
  function forget() {
    at("asked").hidden = at("why").hidden = true;
  }
  return { asks: (event) => pane() && (event.altKey || asks()), ask, forget };
}
