"use strict";
/* The page from top to bottom; a part without data says what would give it, or is left out. */

const main = document.getElementById("main");

/* What was compared: the axes, whose values switch cases on and off, and what all cases share. */
function choiceChips(axis, a) {
  if (axis.values.length > 40) return `${axis.values.length} values, ${axis.values[0]} to ${axis.values[axis.values.length - 1]}`;
  return axis.values.map((value, rank) => {
    const chip = button(value === "-" ? "does not apply" : value, () => {
      filter.toggle(a, rank);
      chip.setAttribute("aria-pressed", String(!filter.off.has(filter.key(a, rank))));
    }, {class: "chip", "aria-pressed": "true"});
    return chip;
  });
}

function comparedSection() {
  const axes = data.axes.flatMap((axis, a) => [
    el("dt", {}, axis.path, axis.unit ? el("span", {class: "unit"}, ` [${pretty(axis.unit)}]`) : ""), el("dd", {}, choiceChips(axis, a))]);
  const fixed = data.fixed.map(item => el("div", {}, el("dt", {}, item.path),
    el("dd", {}, item.values.length > 4 ? `${item.values.length} values` : item.values.filter(v => v !== "-").join(", "), item.unit && item.values.length === 1 ? el("span", {class: "unit"}, " " + pretty(item.unit)) : "")));
  return section("compared", "What was compared",
    axes.length ? el("p", {class: "note"}, "Axes that multiply to the cases. A value switched off is left out of tables and figures below.") : null,
    axes.length ? el("dl", {class: "choices"}, axes) : null,
    el("details", {}, el("summary", {}, `What ${axes.length ? "all cases share, or follows from the axes" : "was run"}`), el("dl", {class: "fixed"}, fixed)));
}

/* Numbers that say at once how it went. */
function facts() {
  const {cases} = data, ok = cases.rows.filter(row => row[1] === "ok");
  const fact = (name, value, small) => el("div", {}, el("dt", {}, name), el("dd", {}, value, small ? el("small", {}, small) : null));
  const endings = [...new Set(cases.rows.map(row => row[1]))].filter(status => status !== "ok");
  const list = [fact("cases", cases.total.toLocaleString("en"), endings.length
    ? endings.map(status => `${cases.rows.filter(row => row[1] === status).length} ${status}`).join(", ") : "all ended ok")];
  const error = cases.columns.findIndex(column => column.error);
  const extreme = (i, least) => ok.filter(row => isNumber(row[4][i])).reduce((best, row) => !best || (least ? row[4][i] < best[4][i] : row[4][i] > best[4][i]) ? row : best, null);
  const best = error < 0 ? null : extreme(error, true), worst = error < 0 ? null : extreme(error, false);
  if (best) list.push(fact(`least ${titled(cases.columns[error])}`, number(best[4][error], true), caseLabel(best)));
  if (worst && worst !== best) list.push(fact(`greatest ${titled(cases.columns[error])}`, number(worst[4][error], true), caseLabel(worst)));
  const crossings = resultIndex("result.crossings"), most = crossings < 0 ? null : extreme(crossings, false);
  if (most && most[4][crossings] > 0) list.push(fact("most crossings of grid cells", number(most[4][crossings]), caseLabel(most)));
  return el("dl", {class: "facts"}, list);
}

/* Methods down, refinement across, orders between. */
function sideTable(column) {
  const {compare, cases} = data, described = cases.columns[column];
  const orders = (compare.orders.find(o => o.result === column) || {order: null}).order;
  const rows = compare.columns.map((c, k) => ({c, k, cases: c.cases.map(at => cases.rows[at] && filter.shows(cases.rows[at]) ? cases.rows[at] : null)}))
    .filter(row => row.cases.some(one => one));
  const columns = compare.axes.map((path, a) => ({name: leaf(path), title: path, head: true, key: row => row.c.labels[a],
    cell: row => row.c.labels[a].startsWith(leaf(path) + " ") ? row.c.labels[a].slice(leaf(path).length + 1) : row.c.labels[a]}))
    .filter(axis => rows.some(row => axis.key(row)));
  compare.rows.forEach(([text], r) => {
    if (!rows.some(row => row.cases[r])) return;
    if (orders && r && rows.some(row => isNumber(orders[row.k][r])))
      columns.push({name: "order", numeric: true, kind: "order", key: row => orders[row.k][r], cell: row => isNumber(orders[row.k][r]) ? orders[row.k][r].toFixed(2).replace("-", "\u2212") : ""});
    const key = row => resultKey(row.cases[r], column);
    const best = described.error || /seconds|ns_per/.test(described.name) ? leastOf(rows, key) : null;
    columns.push({name: isNaN(Number(text)) ? text : `${leaf(compare.path)} ${text}`, numeric: true, key, cell: row => resultCell(row.cases[r], column), best});
  });
  return sortable({label: titled(described), columns, rows, first: 60,
    caption: [titled(described), orders ? ", with the observed order between neighbours" : "", "; least values marked."]});
}

function compareSection() {
  const {compare, cases} = data;
  if (!compare) return null;
  const holder = el("div", {});
  let column = 0;
  const fill = () => holder.replaceChildren(sideTable(column));
  const [picker] = select("Result", cases.columns.map(titled), i => { column = i; fill(); });
  filter.watchers.push(fill);
  fill();
  return section("table", "Side by side", el("div", {class: "controls"}, picker), holder,
    compare.total > compare.columns.length ? el("p", {class: "note"}, `The first ${compare.columns.length} of ${compare.total} methods; table.csv holds all.`) : null);
}

function failedTable() {
  const rows = data.cases.rows.filter(row => row[1] !== "ok");
  if (!rows.length) return null;
  const at = (name, row) => result(row, name);
  const columns = [
    {name: "case", head: true, kind: "soft", key: row => caseLabel(row), cell: row => caseLabel(row) || row[0]},
    {name: "status", key: row => row[1], cell: row => el("span", {class: "ended"}, row[1])},
    {name: "time", unit: "s", numeric: true, key: row => at("result.time", row), cell: row => number(at("result.time", row))},
    {name: "particle", numeric: true, key: row => at("result.particle", row), cell: row => number(at("result.particle", row))},
    {name: "cause", kind: "wrap", key: row => row[2], cell: row => row[2] || ""},
  ];
  return section("failed", "What failed, and why", sortable({label: "Cases that did not end well", columns, rows, first: 30}));
}

/* Whether a result has a line: two cases that differ in what refines alone. */
function refines(column) {
  const {compare, cases} = data;
  const counts = (at, r) => isNumber(compare.rows[r][1]) && cases.rows[at] && cases.rows[at][1] === "ok" && isNumber(cases.rows[at][4][column]);
  return compare.columns.some(c => c.cases.filter(counts).length > 1);
}

function refinementSection() {
  const {compare, cases} = data;
  const values = compare ? cases.columns.map((column, i) => i).filter(i => !/^result\.(particle|steps|time)$/.test(cases.columns[i].name) && refines(i)) : [];
  if (!values.length) return null;
  const choice = {value: values[0], x: true, y: true};
  const drawn = chosen(() => refinementFigure(choice.value, choice.x, choice.y));
  const toggle = (text, which) => {
    const made = button(text, () => { choice[which] = !choice[which]; made.setAttribute("aria-pressed", String(choice[which])); drawn.remake(); }, {class: "chip", "aria-pressed": "true"});
    return made;
  };
  const [picker] = select("Result", values.map(i => titled(cases.columns[i])), i => { choice.value = values[i]; drawn.remake(); });
  const convergence = ["mesh.cells", "time.dt", "time.cfl"].includes(compare.path);
  return section("convergence", convergence ? "Convergence" : "Along " + compare.path,
    el("p", {class: "note"}, "Drag to zoom, double-click or press 0 to see all; point at a mark for its values. Orders in the legend are those of the last two marks of a line."),
    el("div", {class: "controls"}, picker, toggle("log " + leaf(compare.path), "x"), toggle("log result", "y")), drawn.holder);
}

function frontTable() {
  const {front, cases} = data, x = resultIndex(front.cost), y = resultIndex(front.error);
  const rows = front.members.map(member => ({row: cases.rows[member.case], why: member.why.trim().split("\n").filter(line => line)}));
  const columns = [
    {name: "case", head: true, kind: "soft", key: r => caseLabel(r.row), cell: r => caseLabel(r.row) || r.row[0]},
    {name: short(front.error), unit: cases.columns[y].unit, numeric: true, key: r => r.row[4][y], cell: r => number(r.row[4][y], true)},
    {name: short(front.cost), unit: cases.columns[x].unit, numeric: true, key: r => r.row[4][x], cell: r => number(r.row[4][x])},
    {name: "why it is there; times its cost in brackets", kind: "wrap", key: r => r.why.join(), cell: r => r.why.map(line => el("div", {}, line))},
  ];
  return el("details", {}, el("summary", {}, `The ${plural(rows.length, "case")} of the front, and why`), sortable({label: "The error-cost front", columns, rows, first: 30}));
}

function costSection() {
  const {front} = data;
  const note = front.note.trim().split("\n").filter(line => line).map(line => el("p", {class: "note"}, line.replace(/^(gridcross|note): /, "").replace(/^[a-z](?=[a-z]* )/, c => c.toUpperCase()) + "."));
  if (front.members.length && front.counts.length < 2) return null;
  if (!front.members.length) return note.length ? section("cost", "Work and precision", note) : null;
  const once = data.studies.some(study => !study.repeats);
  return section("cost", "Work and precision",
    el("p", {class: "note"}, "Cost is processor time of the steps", once ? ", timed once with measures around them; gridcross run --repeats 5 times the steps alone." : ", the median of repeated runs without measures."),
    chosen(costFigure).holder, frontTable(), note);
}

function historySection() {
  const {histories} = data;
  const names = ["displacement.rms", "velocity.rms", "stress.rms", "crossings"].filter(name => histories.curves.some(curve => (curve[name] || []).some(isNumber)));
  if (!histories.curves.length) return section("energy", "Histories and energy ledger", el("p", {class: "note"}, "No case kept its history: set ", el("code", {}, "output: {histories: 10}"), " in the run file for errors and energies each ten steps."));
  const parts = [];
  if (names.length) {
    const choice = {name: names[0], log: true};
    const drawn = chosen(() => historyFigure(choice.name, choice.log && choice.name !== "crossings"));
    const log = button("log result", () => { choice.log = !choice.log; log.setAttribute("aria-pressed", String(choice.log)); drawn.remake(); }, {class: "chip", "aria-pressed": "true"});
    const [picker] = select("Result", names, i => { choice.name = names[i]; drawn.remake(); });
    parts.push(el("h3", {}, "Errors and crossings"), el("div", {class: "controls"}, picker, log), drawn.holder);
  }
  const curves = histories.curves.filter(curve => (curve["energy.kinetic"] || []).some(isNumber));
  if (curves.length) parts.push(el("h3", {}, "Energy ledger"), pairOf(curves, curve => ledgerFigure(curve)));
  if (histories.total > histories.curves.length) parts.push(el("p", {class: "note"}, `${histories.curves.length} of ${histories.total} histories; study.h5 holds all.`));
  return section("energy", "Histories and energy ledger", parts);
}

/* Two cases beside each other, each chosen from a list. */
function pairOf(curves, draw) {
  const labels = curves.map(curve => caseLabel(data.cases.rows[curve.case]) || "the case");
  const panel = first => {
    const holder = el("div", {});
    let current = null;
    const fill = i => {
      if (current) charts.splice(charts.indexOf(current.chart), 1);
      current = draw(curves[i]);
      holder.replaceChildren(current.element);
    };
    const [picker, box] = select("Case", labels, fill);
    box.value = String(first);
    fill(first);
    return el("div", {}, el("div", {class: "controls keep"}, picker), holder);
  };
  return el("div", {class: curves.length > 1 ? "pair" : null}, panel(0), curves.length > 1 ? panel(1) : null);
}

function spectrumSection() {
  const {spectra} = data, names = ["displacement", "velocity", "stress"];
  if (!spectra.curves.length) return null;
  const choice = {name: names[0]}, drawn = chosen(() => spectrumFigure(choice.name));
  const [picker] = select("Error of", names, i => { choice.name = names[i]; drawn.remake(); });
  return section("spectra", "Errors by wavenumber", el("p", {class: "note"}, "At the last time. Beyond the grid's Nyquist wavenumber lies what its functions cannot hold."),
    el("div", {class: "controls"}, picker), drawn.holder,
    spectra.total > spectra.curves.length ? el("p", {class: "note"}, `${spectra.curves.length} of ${spectra.total} spectra; study.h5 holds all.`) : null);
}

/* Which term of the error of a step is the largest. */
function budgetTable(of, title) {
  const {cases} = data, prefix = `result.budget.${of}.`, known = ["time", "interpolation", "lumping", "projection", "quadrature", "gradient", "rest"];
  const terms = known.map(term => ({term, i: resultIndex(prefix + term)})).filter(({i}) => i >= 0), stepError = resultIndex(prefix + "step");
  const rows = cases.rows.filter(row => filter.shows(row) && terms.some(({i}) => isNumber(row[4][i])));
  if (!rows.length || stepError < 0) return null;
  const largest = row => Math.max(...terms.map(({i}) => Math.abs(row[4][i]) || 0));
  const columns = [{name: "case", head: true, key: row => caseLabel(row), cell: row => caseLabel(row) || row[0]},
    {name: "error of a step", unit: cases.columns[stepError].unit, numeric: true, key: row => row[4][stepError], cell: row => number(row[4][stepError], true)},
    ...terms.map(({term, i}) => ({name: term, unit: cases.columns[i].unit, numeric: true, key: row => row[4][i], cell: row => number(row[4][i], true),
      best: row => largest(row) > 0 && Math.abs(row[4][i]) === largest(row)}))];
  return [el("h3", {}, title), sortable({label: title, columns, rows, first: 40})];
}

function budgetSection() {
  const tables = [budgetTable("velocity", "Change of velocity in a step"), budgetTable("displacement", "Change of displacement in a step")].filter(table => table);
  if (!tables.length) return null;
  return section("budget", "Error budget", el("p", {class: "note"}, "Each step is taken anew from the exact state and its error split into terms, as root mean squares over particles; the largest term is marked."), tables);
}

function everyCase() {
  const {cases} = data;
  const columns = [...data.axes.map((axis, a) => ({name: leaf(axis.path), title: axis.path, unit: axis.unit, head: !a,
    key: row => isNaN(Number(axis.values[row[3][a]])) ? axis.values[row[3][a]] : Number(axis.values[row[3][a]]), cell: row => axis.values[row[3][a]] || ""})),
    {name: "status", key: row => row[1], cell: row => row[1] === "ok" ? "ok" : ended(row)},
    ...cases.columns.map((column, i) => ({...column, i})).filter(column => !column.name.startsWith("result.budget."))
      .map(column => ({name: short(column.name), unit: column.unit, numeric: true, key: row => row[4][column.i], cell: row => number(row[4][column.i], column.error)})),
    {name: "case", key: row => row[0], cell: row => el("span", {class: "mono"}, row[0])}];
  const holder = el("div", {});
  const fill = () => holder.replaceChildren(sortable({label: "Every case", columns, rows: cases.rows.filter(filter.shows), first: 25}));
  filter.watchers.push(fill);
  fill();
  return section("cases", "Every case", holder,
    cases.total > cases.rows.length ? el("p", {class: "note"}, `${cases.rows.length.toLocaleString("en")} of ${plural(cases.total, "case")}; table.csv in the study holds all.`) : null);
}

function sourceSection() {
  const one = data.studies.length === 1;
  const blocks = data.studies.map(study => {
    const text = el("pre", {tabindex: "0", "aria-label": "Run file of " + study.name}, el("code", {}, study.run_file));
    return one ? text : el("details", {}, el("summary", {}, `${study.name}${study.title ? ": " + study.title : ""}`), text);
  });
  return section("run-file", one ? "The run file" : "The run files", el("p", {class: "note"}, "Saved as FILE.yaml, ", el("code", {}, "gridcross run FILE.yaml"), " computes it again."), blocks);
}

function provenanceSection() {
  const groups = new Map();
  data.studies.forEach(study => {
    const key = JSON.stringify(study.provenance);
    groups.set(key, [...groups.get(key) || [], study]);
  });
  const parts = [...groups.values()].map(studies => [
    groups.size > 1 ? el("h3", {}, studies.map(study => study.name).join(", ")) : null,
    el("dl", {class: "fixed"}, studies[0].provenance.map(([name, text]) => el("div", {}, el("dt", {}, name.replace("_", " ")), el("dd", {class: "mono"}, text || "–"))))]);
  return section("provenance", "Provenance", el("p", {class: "note"}, "What made these results. Equal runs give equal bytes, times aside."), parts);
}

function leadSection() {
  const title = data.studies.length === 1 || !data.cases ? null : el("p", {class: "muted"}, data.studies.map(study => study.name).join(" · "));
  return el("section", {class: "lead", "aria-label": "In short"}, title, data.cases ? facts() : null);
}

function setTheme(dark) {
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  showTheme(dark);
  charts.forEach(chart => chart.box.isConnected && chart.rebuild());
}

function showTheme(dark) {
  const toggle = document.getElementById("theme");
  toggle.setAttribute("aria-pressed", String(dark));
  toggle.textContent = dark ? "Light" : "Dark";
}

/* Figures are drawn anew on white, and every part is unfolded. */
function followPrinter() {
  let before = null;
  addEventListener("beforeprint", () => {
    before = {theme: document.documentElement.dataset.theme, open: [...document.querySelectorAll("details:not([open])")]};
    before.open.forEach(details => { details.open = true; });
    document.documentElement.dataset.theme = "print";
    charts.forEach(chart => chart.box.isConnected && chart.rebuild(chart.box.closest(".pair") ? 310 : 640));
  });
  addEventListener("afterprint", () => {
    if (!before) return;
    before.open.forEach(details => { details.open = false; });
    if (before.theme) document.documentElement.dataset.theme = before.theme;
    else delete document.documentElement.dataset.theme;
    charts.forEach(chart => chart.box.isConnected && chart.rebuild());
  });
}

function writePage() {
  const parts = [leadSection()];
  if (data.cases) parts.push(comparedSection());
  if (data.paper.length) parts.push(...paperSections());
  if (data.cases) parts.push(failedTable(), compareSection(), refinementSection(), costSection(), tracksSection(), historySection(), spectrumSection(), budgetSection(), everyCase());
  parts.push(sourceSection(), provenanceSection());
  parts[0].append(el("nav", {"aria-label": "Sections"}, contents));
  main.append(...parts.filter(part => part));
  const version = (data.studies[0].provenance.find(([name]) => name === "version") || ["", ""])[1];
  document.getElementById("foot").append(`Written by gridcross ${version}. This page is one file and loads nothing. Figures by uPlot (MIT licence, in the page's source).`);
  const darkens = matchMedia("(prefers-color-scheme: dark)");
  showTheme(darkens.matches);
  document.getElementById("theme").addEventListener("click", () => setTheme(document.getElementById("theme").getAttribute("aria-pressed") !== "true"));
  darkens.addEventListener("change", event => { delete document.documentElement.dataset.theme; showTheme(event.matches); charts.forEach(chart => chart.box.isConnected && chart.rebuild()); });
  followPrinter();
}

writePage();
