"use strict";
(() => {
  const all = (selector, root = document) => Array.from(root.querySelectorAll(selector));

  // A header sorts its table: upwards, then downwards; what is missing stays last.
  const sort = (head) => {
    const row = head.parentElement;
    const column = Array.from(row.children).indexOf(head);
    const down = head.getAttribute("aria-sort") === "ascending";
    const sign = down ? -1 : 1;
    const body = head.closest("table").tBodies[0];
    const rows = Array.from(body.rows).map((tr) => {
      const cell = tr.cells[column];
      return { tr, number: "value" in cell.dataset ? Number(cell.dataset.value) : null, text: cell.textContent };
    });
    rows.sort((a, b) => {
      if (a.text === "" || b.text === "") return (a.text === "") - (b.text === "");
      if (a.number !== null && b.number !== null) return sign * (a.number - b.number);
      return sign * a.text.localeCompare(b.text, "en", { numeric: true });
    });
    for (const other of row.children) other.setAttribute("aria-sort", "none");
    head.setAttribute("aria-sort", down ? "descending" : "ascending");
    body.append(...rows.map((entry) => entry.tr));
  };
  for (const button of all("th button")) button.addEventListener("click", () => sort(button.parentElement));

  // Plots show one model or the mean of all; rows and pictures those of the models chosen.
  const choice = (id) => document.getElementById("choose-" + id);
  const chosen = (id) => (choice(id) ? choice(id).value : "");
  const show = () => {
    const model = chosen("model");
    const style = chosen("style");
    const machine = chosen("machine");
    const isMachine = (element) => machine === "" || element.dataset.machine === "" || element.dataset.machine === machine;
    const isModel = (element) => model === "" || element.dataset.model === "" || element.dataset.model === model;
    for (const plot of all(".plot[data-model]")) plot.hidden = plot.dataset.model !== model || !isMachine(plot);
    for (const picture of all(".pictures figure")) picture.hidden = !isModel(picture);
    const rows = all("#rows tbody tr");
    for (const row of rows) {
      row.hidden = !(isModel(row) && isMachine(row) && (style === "" || row.dataset.style === style));
    }
    const count = rows.filter((row) => !row.hidden).length;
    document.getElementById("count").textContent =
      count === rows.length ? `${count} rows` : `${count} of ${rows.length} rows`;
  };
  for (const select of all(".choices select")) select.addEventListener("change", show);
  const choices = document.querySelector(".choices");
  choices.hidden = choices.children.length === 0;
  choices.addEventListener("submit", (event) => event.preventDefault());
  show();

  const table = document.querySelector("#rows table");
  const columns = document.getElementById("all-columns");
  const fewOrAll = () => table.classList.toggle("few", !columns.querySelector("input").checked);
  columns.hidden = false;
  columns.addEventListener("change", fewOrAll);
  fewOrAll();

  for (const button of all(".picture")) {
    button.addEventListener("click", () => {
      const isLarge = button.parentElement.classList.toggle("large");
      button.setAttribute("aria-pressed", String(isLarge));
    });
  }
})();
