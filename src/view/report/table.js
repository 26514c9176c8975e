"use strict";
/* Tables that are sorted by their headings and scroll in a box of their own. */

/* columns: {name, unit, numeric, kind ("order", "wrap"), head, key(row), cell(row), best(row)}; head: names its row. Rows without a
 * key go last. */
function sortedRows(rows, column, falling) {
  const keyed = rows.map((row, i) => [column.key(row), i, row]);
  const missing = key => key === null || key === undefined || key === "";
  keyed.sort(([a, i], [b, j]) => {
    if (missing(a) || missing(b)) return missing(a) - missing(b) || i - j;
    const order = typeof a === "number" && typeof b === "number" ? a - b : String(a).localeCompare(String(b), "en", {numeric: true});
    return (falling ? -order : order) || i - j;
  });
  return keyed.map(([, , row]) => row);
}

function bodyCell(column, row) {
  const best = column.best && column.best(row);
  const kinds = [column.numeric && "num", column.kind, best && "best"].filter(kind => kind).join(" ");
  const attributes = {class: kinds || null, scope: column.head ? "row" : null};
  return el(column.head ? "th" : "td", attributes, column.cell(row), best ? el("span", {class: "hidden"}, " (best)") : null);
}

function heading(table, column, i) {
  const cell = el("th", {scope: "col", class: [column.numeric && "num", column.kind].filter(kind => kind).join(" ") || null});
  if (column.kind === "order") {
    cell.append(column.name);
    return cell;
  }
  const name = el("span", {class: "name"}, column.name.split(/(?<=\.)/).map((part, k) => [k ? el("wbr") : null, part]));
  const unit = table.units ? el("span", {class: "unit"}, pretty(column.unit) || "\u00a0") : null;
  const sort = button("", () => table.sortBy(i), {title: "Sort by " + (column.title || column.name)});
  sort.append(name, ...(unit ? [unit] : []));
  cell.append(sort);
  return cell;
}

const ON_PAPER = 10; /* columns; report.css leaves out the others */

/* spec: {label, columns, rows, first: rows shown before "show all"} */
function sortable(spec) {
  const table = {units: spec.columns.some(column => column.unit), by: -1, falling: false, all: false};
  const body = el("tbody"), heads = spec.columns.map((column, i) => heading(table, column, i));
  const more = button("", () => { table.all = true; fill(); });
  function fill() {
    const rows = table.by < 0 ? spec.rows : sortedRows(spec.rows, spec.columns[table.by], table.falling);
    const shown = table.all ? rows : rows.slice(0, spec.first || 100);
    body.replaceChildren(...shown.map(row => el("tr", {}, spec.columns.map(column => bodyCell(column, row)))));
    more.textContent = `Show all ${rows.length.toLocaleString("en")} rows`;
    more.hidden = shown.length === rows.length;
  }
  table.sortBy = i => {
    table.falling = table.by === i && !table.falling;
    table.by = i;
    heads.forEach((head, h) => h === i ? head.setAttribute("aria-sort", table.falling ? "descending" : "ascending") : head.removeAttribute("aria-sort"));
    fill();
  };
  fill();
  const box = el("div", {class: "scroll", tabindex: "0", role: "region", "aria-label": spec.label},
    el("table", {}, el("thead", {}, el("tr", {}, heads)), body));
  const cut = spec.columns.length > ON_PAPER ? el("p", {class: "note paper"}, `The first ${ON_PAPER} of ${spec.columns.length} columns; a screen shows all.`) : null;
  return el("div", {}, spec.caption ? el("p", {class: "note"}, spec.caption) : null, box, cut, more);
}

/* The status where a case did not end well, its time and cause on hover. */
function ended(row) {
  return el("span", {class: "ended", title: row[2] || null}, row[1]);
}

/* A result of a case, or why there is none. */
function resultCell(row, i) {
  if (!row) return "";
  const column = data.cases.columns[i];
  if (row[1] !== "ok" && column.error && !column.name.startsWith("result.budget.")) return ended(row);
  return number(row[4][i], column.error);
}
const resultKey = (row, i) => row && (row[1] === "ok" || !data.cases.columns[i].error) ? row[4][i] : null;

/* Names the rows whose value is the least. */
function leastOf(rows, key) {
  const keys = rows.map(key).filter(isNumber).map(Math.abs), least = Math.min(...keys);
  return row => keys.length > 1 && isNumber(key(row)) && Math.abs(key(row)) === least;
}
