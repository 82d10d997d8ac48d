// As much of Markdown as the documents use: headings, paragraphs, lists, tables, code, pictures, links, folded answers.

import { element } from "./panel.js";

/** A document's blocks as elements; `picture(alternative, address, heading)` makes the element of a picture. */
export function blocks(text, picture) {
  const made = [];
  // Blocks of an answer that a reader unfolds.
  let folded = null;
  const add = (block) => (folded ? folded.append(block) : made.push(block));
  for (const block of text.split(/\n{2,}/)) {
    const lines = block.replace(/\n+$/, "").split("\n");
    if (!lines[0]) continue;
    const summary = lines[0].match(/^<details><summary>(.*)<\/summary>/);
    if (summary) {
      folded = element("details", {}, element("summary", { textContent: summary[1] }));
      made.push(folded);
      continue;
    }
    if (lines[0] === "</details>") {
      folded = null;
      continue;
    }
    const heading = lines[0].match(/^(#+) (.*)/);
    if (heading) add(element(`h${heading[1].length}`, {}, ...words(heading[2], picture)));
    else if (lines.every((line) => line.startsWith("    "))) add(element("pre", { textContent: lines.map((line) => line.slice(4)).join("\n") }));
    else if (lines[0].startsWith("|")) add(table(lines, picture));
    else if (lines[0].startsWith("- ")) add(list(lines, picture));
    else add(element("p", {}, ...words(lines.join(" "), picture)));
  }
  return made;
}

function list(lines, picture) {
  const items = lines.join("\n").split(/^- /m).slice(1);
  return element("ul", {}, ...items.map((item) => element("li", {}, ...words(item.replace(/\s+/g, " "), picture))));
}

function table(lines, picture) {
  const cells = (line) => line.split("|").slice(1, -1).map((cell) => cell.trim());
  const heads = cells(lines[0]);
  const row = (line) => element("tr", {}, ...cells(line).map((cell, place) => element("td", {}, ...words(cell, picture, heads[place]))));
  return element("table", {}, element("tr", {}, ...heads.map((head) => element("th", {}, ...words(head, picture)))), ...lines.slice(2).map(row));
}

/** A line's words: code, pictures and links among them. */
function words(text, picture, heading) {
  const found = [];
  const pattern = /\*\*([^*]+)\*\*|`([^`]+)`|!\[([^\]]*)\]\(([^)]+)\)|\[((?:[^[\]]|`[^`]*`)*)\]\(([^)]+)\)/g;
  let end = 0;
  for (const match of text.matchAll(pattern)) {
    found.push(text.slice(end, match.index));
    end = match.index + match[0].length;
    const [, strong, code, alternative, address, linked] = match;
    if (strong) found.push(element("strong", { textContent: strong }));
    else if (code) found.push(element("code", { textContent: code }));
    else if (address) found.push(picture(alternative, address, heading));
    // Other documents are not on the page.
    else found.push(...words(linked, picture));
  }
  found.push(text.slice(end));
  return found;
}
