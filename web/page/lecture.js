// Lectures: documents of docs/ beside the picture, their buffers live, the shaders that they name one click away.

import { address, has, text as textOf } from "./files.js";
import { say, sentence } from "./failures.js";
import { blocks } from "./markdown.js";
import { element } from "./panel.js";

/** The document of each lecture, its title, the style that it is about. */
const LECTURES = {
  evangelista: { document: "how-evangelista-works.md", title: "Three passes", style: "three-pass" },
  dachsbacher: { document: "how-dachsbacher-works.md", title: "Edges as ink", style: "inking" },
  valente: { document: "how-valente-works.md", title: "Charcoal", style: "charcoal" },
};

/** Milliseconds without a change before the buffers in the text are drawn. */
const IDLE = 300;

const at = (id) => document.getElementById(id);

/** Connects the lectures with the app; `shader` opens a listing, `controls` writes the controls anew. */
export function lectures(app, { shader, controls }) {
  const field = at("lecture");
  const article = at("text-of-lecture");
  let buffers = [];
  let soon;
  field.append(element("option", { value: "", textContent: "none" }));
  for (const [name, { document, title }] of Object.entries(LECTURES)) {
    if (has(document)) field.append(element("option", { value: name, textContent: title }));
  }
  field.parentElement.hidden = field.options.length === 1;
  field.addEventListener("change", () => {
    const state = app.state();
    state.lecture = field.value;
    const { style } = LECTURES[field.value] ?? {};
    if (style && state.sides.left.style !== style) Object.assign(state.sides.left, { style, show: "final", settings: {} });
    if (style) state.divider = 100;
    controls();
    show();
    app.changed(() => {});
  });

  /** A picture of the document: live where its column names a buffer, else the document's. */
  function picture(alternative, source, heading) {
    const buffer = heading?.match(/^`--show (\w+)`/)?.[1];
    if (!buffer || !app.pane()) return element("img", { src: address(source.replace(/^(\.\.\/)+/, "")) ?? "data:,", alt: alternative, loading: "lazy" });
    const canvas = element("canvas", { className: "buffer", role: "img", ariaLabel: alternative });
    canvas.addEventListener("click", () => {
      app.state().sides.left.show = buffer;
      controls();
      app.changed(() => {});
    });
    buffers.push({ canvas, buffer });
    return canvas;
  }

  /** Shows the lecture of the state, or none. */
  async function show() {
    const name = app.state().lecture;
    const lecture = LECTURES[name];
    field.value = lecture && has(lecture.document) ? name : "";
    document.body.classList.toggle("has-lecture", Boolean(field.value));
    if (article.dataset.name === field.value) return;
    article.dataset.name = field.value;
    article.hidden = !field.value;
    at("controls").open = !field.value;
    buffers = [];
    article.replaceChildren();
    if (!field.value) return;
    try {
      const text = await textOf(lecture.document);
      if (article.dataset.name !== name) return;
      article.append(...blocks(text, picture));
      nameShaders(text);
      refresh();
    } catch (problem) {
      say(sentence(problem));
    }
  }

  /** Makes the names of shaders in the text open their listings, the first at once. */
  function nameShaders(text) {
    const named = new Set([...text.matchAll(/`glsl\/([\w/-]+\.(?:vert|frag))`/g)].map((match) => match[1]));
    for (const code of article.querySelectorAll("code")) {
      const path = code.textContent.replace(/^glsl\//, "");
      if (!named.has(path)) continue;
      const link = element("button", { type: "button", className: "code" });
      code.replaceWith(link);
      link.append(code);
      link.addEventListener("click", () => {
        shader(path);
        at("listings").scrollIntoView({ block: "nearest" });
      });
    }
    const [first] = named;
    if (first) shader(first);
  }

  /** Draws the buffers in the text, of the model that is shown now. */
  function refresh() {
    clearTimeout(soon);
    if (!buffers.length) return;
    soon = setTimeout(() => {
      const { style } = LECTURES[article.dataset.name] ?? {};
      for (const { canvas, buffer } of buffers) {
        try {
          const width = app.pane()?.draw(JSON.stringify({ ...app.sceneOptions(), style, size: "240x240" }), buffer, false);
          if (!width) return;
          const image = new ImageData(new Uint8ClampedArray(app.pane().pixels()), width);
          [canvas.width, canvas.height] = [image.width, image.height];
          canvas.getContext("2d").putImageData(image, 0, 0);
        } catch (problem) {
          say(sentence(problem));
        }
      }
    }, IDLE);
  }

  return { show, refresh };
}
