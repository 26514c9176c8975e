"use strict";
/* Elements, numbers and names. What comes from the data enters the page as text alone. */

const data = JSON.parse(document.getElementById("data").textContent);

/* Children are elements, texts, or nothing. */
function el(tag, attributes, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value !== null && value !== undefined && value !== false) element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.flat(Infinity).filter(child => child !== null && child !== undefined && child !== false));
  return element;
}

const leaf = path => path.slice(path.lastIndexOf(".") + 1);
const short = name => name.startsWith("result.") ? name.slice(7) : name;
const pretty = unit => (unit || "").replace(/\^([23])/g, (_, power) => "⁰¹²³"[power]);
const titled = axis => short(axis.name) + (axis.unit ? ` [${pretty(axis.unit)}]` : "");
const plural = (count, word) => `${count.toLocaleString("en")} ${word}${count === 1 ? "" : "s"}`;
const isNumber = value => typeof value === "number" && isFinite(value);

function exponent(value, digits) {
  return value.toExponential(digits).replace("e+0", "").replace("e+", "e").replace("-", "\u2212").replace("e-", "e\u2212");
}

/* Errors by three digits in powers of ten, counts in full, the rest by four digits. */
function number(value, error) {
  if (!isNumber(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (error || size < 1e-3 || size >= 1e7) return exponent(value, 2).replace("-", "\u2212");
  if (Number.isInteger(value)) return value.toString().replace("-", "\u2212");
  return parseFloat(value.toPrecision(4)).toString().replace("-", "\u2212");
}

function select(label, options, change) {
  const box = el("select", {onchange: () => change(Number(box.value))}, options.map((text, i) => el("option", {value: i}, text)));
  return [el("label", {}, label, box), box];
}

function button(text, click, more) {
  return el("button", {type: "button", onclick: click, ...more}, text);
}

/* A section of the page, listed among its contents. */
const contents = [];
function section(id, title, ...children) {
  contents.push(el("a", {href: "#" + id}, title));
  return el("section", {id, "aria-labelledby": id + "-title"}, el("h2", {id: id + "-title"}, title), ...children);
}

/* Which values of the axes are shown, chosen where the axes are listed. */
const filter = {
  off: new Set(),
  watchers: [],
  key: (axis, rank) => axis + ":" + rank,
  toggle(axis, rank) {
    const key = filter.key(axis, rank);
    if (!filter.off.delete(key)) filter.off.add(key);
    filter.watchers.forEach(watcher => watcher());
  },
  shows: row => !filter.off.size || row[3].every((rank, axis) => !filter.off.has(filter.key(axis, rank))),
};

/* "standard, degree 2, cells 16", of a row of the cases: its method first. */
function caseLabel(row) {
  const parts = data.axes.map((axis, i) => {
    const value = axis.values[row[3][i]];
    if (value === undefined || value === "-") return null;
    return {method: axis.path.startsWith("method."), text: isNaN(Number(value)) ? value : `${leaf(axis.path)} ${value}`};
  }).filter(part => part);
  return [...parts.filter(part => part.method), ...parts.filter(part => !part.method)].map(part => part.text).join(", ");
}
const resultIndex = name => data.cases.columns.findIndex(column => column.name === name);
const result = (row, name) => { const i = resultIndex(name); return i < 0 ? null : row[4][i]; };
