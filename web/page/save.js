// Files and links for the reader.

import { say, sentence } from "./failures.js";
import * as lines from "./lines.js";
import { stem } from "./model.js";
import { element } from "./panel.js";
import { styleOf } from "./state.js";

const at = (id) => document.getElementById(id);

/** Hands a file to the reader. */
function hand(name, content, type) {
  const link = element("a", { href: URL.createObjectURL(new Blob([content], { type })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/** Saves what the app shows. */
export function saving(app) {
  const name = () => stem(app.shown().asked.name);

  /** The picture of a side. */
  async function picture(which) {
    const side = app.state().sides[which];
    const isOfLines = styleOf(app.tables, side).draws_lines;
    if (isOfLines || !app.pane()) return exact(isOfLines ? app.seen(side) : app.seen(), which);
    try {
      const all = JSON.stringify({ ...JSON.parse(app.seen(side)), ...(side.show === "final" ? {} : { show: side.show }) });
      app.pane().draw(all, side.show, false);
      const file = `${name()}-${side.style}${side.show === "final" ? "" : `-${side.show}`}.png`;
      hand(file, app.pane().png(all, app.shown().read), "image/png");
      const changed = Object.keys(app.state().shaders);
      const recipe = changed.length ? ` Its recipe draws the published ${changed.join(", ")}: copy the link to keep your change.` : "";
      say(`The ${which} picture is saved as ${file}.${recipe}`);
    } catch (problem) {
      say(sentence(problem));
    }
    return undefined;
  }

  /** The exact lines with these options. */
  async function exact(options, which) {
    try {
      const file = `${name()}-lines.svg`;
      hand(file, await lines.ask("file", app.shown().asked, options), "image/svg+xml");
      say(`The ${which ? `${which} side's ` : ""}lines are saved as ${file}.`);
    } catch (problem) {
      say(sentence(problem));
    }
  }

  at("svg").addEventListener("click", () => exact(app.seen()));
  at("link").addEventListener("click", async () => {
    const origin = location.origin === "null" ? "file://" : location.origin;
    const isCopied = await navigator.clipboard?.writeText(origin + app.link()).then(() => true, () => false);
    if (!isCopied) history.replaceState(null, "", app.link());
    const said = isCopied ? "The link is copied" : "The address of this page shows the same";
    const edits = Object.keys(app.state().shaders).length ? ", with your changes of shaders" : "";
    say(app.state().model ? `${said}${edits}.` : `${said}${edits}, but without your model.`);
  });
  app.save = picture;
  return { picture };
}
