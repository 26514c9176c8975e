"use strict";
/* Published tables and figures beside ours. */

const GOOD = ["matches", "matches corrected", "holds", "shown"], BAD = ["misses its gate", "unexplained", "invalid"];
const paperName = paper => paper.replace(/^./, c => c.toUpperCase()).replace(/([a-z])([0-9])/, "$1 $2");
const itemName = item => item.replace(/^table/, "Table ").replace(/^fig/, "Fig. ");

function verdict(text) {
  return el("span", {class: BAD.includes(text) ? "bad" : GOOD.includes(text) ? "good" : null}, text);
}

const digitsOf = text => (text || "").replace(/[eE].*/, "").replace(/^[^0-9]*0*\.?0*/, "").replace(/[^0-9]/g, "").length;

/* Ours by as many digits as the print or the gate's value has, and one more. */
function ours(row) {
  if (typeof row.ours === "string") return row.ours;
  if (!isNumber(row.ours)) return "–";
  const digits = Math.max(digitsOf(row.printed), digitsOf((/ of (.*)/.exec(row.gate) || [])[1]));
  const size = Math.abs(row.ours), places = Math.min(8, Math.max(3, digits + 1));
  if (size === 0) return "0";
  return (size >= 0.01 && size < 1e5 ? parseFloat(row.ours.toPrecision(places)).toString() : exponent(row.ours, places - 1)).replace(/^-/, "\u2212");
}

function paperTable(item) {
  const text = (name, field) => ({name, key: row => row[field], cell: row => (row[field] || "").replace(/e-(?=[0-9])/g, "e\u2212")});
  const columns = [
    {...text("row", "row"), head: true, kind: "soft"}, {...text("quantity", "quantity"), kind: "soft"},
    {name: "ours", numeric: true, key: row => row.ours, cell: ours},
  ];
  const prints = item.rows.some(row => row.printed), reasons = [...new Set(item.rows.map(row => row.reason).filter(reason => reason))];
  if (prints) columns.push({...text("printed", "printed"), numeric: true, key: row => parseFloat(row.printed), cell: row => (row.printed || "").replace(/-/g, "\u2212")});
  if (item.rows.some(row => row.corrected)) columns.push({...text("corrected", "corrected"), numeric: true, key: row => parseFloat(row.corrected)});
  if (prints) columns.push({name: "ours / printed", numeric: true, key: row => row.ratio, cell: row => isNumber(row.ratio) ? row.ratio.toPrecision(4) : ""});
  if (item.rows.some(row => row.gate)) columns.push(text("gate", "gate"));
  const note = row => row.reason ? el("sup", {}, el("span", {class: "hidden"}, " note "), String(reasons.indexOf(row.reason) + 1)) : null;
  columns.push({name: "verdict", key: row => row.verdict, cell: row => [verdict(row.verdict), note(row)]});
  const label = `${paperName(item.paper)}, ${itemName(item.item)}`;
  return [sortable({label, columns, rows: item.rows, first: 60}),
    reasons.length ? el("ol", {class: "reasons", "aria-label": "Notes"}, reasons.map(reason => el("li", {}, reason))) : null];
}

/* What an item shows, without the name of its paper. */
const itemTitle = item => data.studies[item.study].title.replace(item.paper + " ", "").replace(/^(Table|Fig\.) [0-9IVXab]+, /, "");

function paperFigure(item, drawing, title) {
  if (!drawing.lines || !drawing.lines.length) return null;
  const filled = drawing.lines.filter(line => line.x.length);
  const width = Math.max(0, ...filled.map(line => line.labels.length)), names = Array.from({length: width}, (_, i) => "axis " + i);
  const looks = styles(filled.map(line => names.map((_, i) => line.labels[i] || "")), names);
  const dense = filled.some(line => line.x.length > 60), overTime = drawing.x.name === "time";
  const lines = filled.map((line, i) => ({...looks[i], x: line.x, y: line.y, dense, label: line.labels.filter(l => l).join(", ") || "ours", hidden: i >= MOST_LINES}));
  const printed = drawing.printed || [];
  if (printed.length) lines.push({label: "printed", x: printed.map(p => p[0]), y: printed.map(p => p[1]), colour: "ink", open: true, points: true, marker: 0, dash: 0});
  if (!lines.length) return null;
  const values = which => lines.flatMap(line => line[which]);
  const places = dense ? null : [...new Set(values("x"))].sort((a, b) => a - b);
  return figure({label: `${title}: ${titled(drawing.y)} against ${titled(drawing.x)}`, lines, height: 360,
    x: {...drawing.x, log: !overTime && spread(values("x")) > 3, places}, y: {...drawing.y, log: !overTime && spread(values("y")) > 10}}).element;
}

function verdictCounts(rows) {
  const counts = new Map();
  rows.forEach(row => counts.set(row.verdict, (counts.get(row.verdict) || 0) + 1));
  return [...counts].sort((a, b) => b[1] - a[1]);
}

function paperSummary(items) {
  const columns = [
    {name: "item", head: true, key: item => item.item, cell: item => el("a", {href: `#${item.paper}-${item.item}`}, itemName(item.item))},
    {name: "what it shows", kind: "wrap", key: itemTitle, cell: itemTitle},
    {name: "rows", numeric: true, key: item => item.rows.length, cell: item => String(item.rows.length)},
    {name: "verdicts", kind: "wrap", key: item => item.missed, cell: item => verdictCounts(item.rows).map(([text, count], i) => el("span", {}, i ? ", " : "", `${count} `, verdict(text)))},
  ];
  return sortable({label: "Items", columns, rows: items});
}

function paperSections() {
  const papers = [...new Set(data.paper.map(item => item.paper))];
  return papers.flatMap(paper => {
    const items = data.paper.filter(item => item.paper === paper), rows = items.flatMap(item => item.rows);
    const missed = items.reduce((sum, item) => sum + item.missed, 0);
    const summary = section(paper, `${paperName(paper)}: the print beside ours`,
      el("p", {}, `${plural(items.length, "item")}, ${plural(rows.length, "row")}: `, verdictCounts(rows).map(([text, count], i) => [i ? ", " : "", `${count} `, verdict(text)]),
        missed ? el("span", {class: "bad"}, `. ${plural(missed, "gate")} missed.`) : ". Every gate is met."),
      el("p", {class: "note"}, "Ours is computed by the run file of each item. A row matches where ours agrees with the print within its gate, or 10 % and the rounding of the print; it differs where a reason says why."),
      items.length > 1 ? paperSummary(items) : null);
    return [summary, ...items.map(item => {
      const title = `${paperName(paper)}, ${itemName(item.item)}`;
      const made = el("section", {id: `${paper}-${item.item}`, "aria-label": title}, el("h3", {}, `${itemName(item.item)}. `, el("span", {class: "muted"}, itemTitle(item))), paperTable(item));
      made.append(...item.figures.map(drawing => paperFigure(item, drawing, title)).filter(drawn => drawn));
      return made;
    })];
  });
}
