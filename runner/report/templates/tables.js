// Sorts the table of packings by any column and filters it by phrases with commas between. Without this script the page
// is complete; with it a heading becomes a button.
(() => {
  "use strict";
  const table = document.getElementById("packings");
  if (!table) return;
  const body = table.tBodies[0];
  const rows = [...body.rows];

  const valueIn = (row, column) => {
    const text = row.cells[column].textContent.trim();
    if (column === 0) return text; // some identities read as numbers
    const number = Number(text);
    return text !== "" && !Number.isNaN(number) ? number : text;
  };

  // Numbers before text, and what has no value last, upwards and downwards.
  const kindOf = (value) => (typeof value === "number" ? 0 : value === "" || value === "-" ? 2 : 1);
  const compare = (a, b, sign) => {
    if (kindOf(a) !== kindOf(b)) return kindOf(a) - kindOf(b);
    return sign * (kindOf(a) === 0 ? a - b : a.localeCompare(b));
  };

  const sortBy = (heading, column) => {
    const descending = heading.getAttribute("aria-sort") === "ascending";
    for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
    heading.setAttribute("aria-sort", descending ? "descending" : "ascending");
    const sign = descending ? -1 : 1;
    rows.sort((a, b) => compare(valueIn(a, column), valueIn(b, column), sign));
    body.append(...rows);
  };

  [...table.tHead.rows[0].cells].forEach((heading, column) => {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...heading.childNodes);
    heading.append(button);
    button.addEventListener("click", () => sortBy(heading, column));
  });

  const controls = document.createElement("div");
  controls.className = "controls";
  const label = document.createElement("label");
  const input = document.createElement("input");
  const count = document.createElement("output");
  input.type = "search";
  input.id = "filter";
  input.title = "phrases with commas between: W = 4, settled";
  label.append("Show rows with", input);
  controls.append(label, count);
  table.parentElement.before(controls);

  // Blanks and case do not count, nor do blanks about "=".
  const plain = (text) => text.toLowerCase().replace(/\s+/g, " ").replace(/ ?= ?/g, "=").trim();
  const idOf = (row) => plain(row.cells[0].textContent);
  const textOf = new Map(rows.map((row) =>
    [row, [...row.cells].slice(1).map((cell) => plain(cell.textContent)).join("\n")]));

  // Finds a phrase whose numbers are whole: "W = 4" is not in "W = 4.5".
  const finder = (phrase) => {
    const before = /^\d/.test(phrase) ? "(^|[^\\d.])" : "";
    const after = /\d$/.test(phrase) ? "(?!\\.?\\d)" : "";
    return new RegExp(before + phrase.replace(/[.*+?^${}()|[\]\\]/g, "\\$&") + after);
  };

  input.addEventListener("input", () => {
    const phrases = input.value.split(",").map(plain).filter(Boolean);
    const finders = phrases.map(finder);
    let shown = 0;
    for (const row of rows) {
      row.hidden = !finders.every((one, k) => one.test(textOf.get(row)) || phrases[k] === idOf(row));
      if (!row.hidden) shown += 1;
    }
    count.textContent = phrases.length ? `${shown} of ${rows.length}` : "";
  });
})();
