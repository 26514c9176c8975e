"use strict";
/* The figures of a comparison: error against refinement, error against cost, histories, spectra. */

const SPACES = ["standard", "moving-mesh", "spline-particle", "spline-grid"];
const MOST_LINES = 24;

/* Colour by space where that varies, else by the axis with most values that there are colours for; marker and dash by the rest.
 * keys: [lines][axes] texts; names: of the axes. */
function styles(keys, names) {
  const distinct = axis => [...new Set(keys.map(key => key[axis]))];
  let lead = names.findIndex((name, axis) => name === "method.space" && distinct(axis).length > 1);
  if (lead < 0) {
    const counts = names.map((_, axis) => distinct(axis).length);
    lead = counts.reduce((best, count, axis) => count <= 7 && count > (best < 0 ? 1 : counts[best]) ? axis : best, -1);
  }
  const leads = lead < 0 ? [] : distinct(lead), rests = [];
  return keys.map(key => {
    const rest = key.filter((_, axis) => axis !== lead).join("\n"), known = SPACES.indexOf(key[lead]);
    if (!rests.includes(rest)) rests.push(rest);
    const hue = lead < 0 ? rests.indexOf(rest) : names[lead] === "method.space" && known >= 0 ? known : leads.indexOf(key[lead]);
    const style = rests.indexOf(rest);
    return {colour: "c" + hue % 7, marker: rests.length > 1 && lead >= 0 ? style : hue, dash: rests.length > 1 && lead >= 0 ? style : Math.floor(hue / 7)};
  });
}

const spread = values => {
  const kept = values.filter(value => isNumber(value));
  return kept.length > 1 && kept.every(value => value > 0) ? Math.max(...kept) / Math.min(...kept) : 1;
};

/* A holder whose figure is made anew when a choice changes. */
function chosen(make) {
  const holder = el("div", {});
  let current = null;
  const remake = () => {
    if (current) charts.splice(charts.indexOf(current.chart), 1);
    current = make();
    holder.replaceChildren(current ? current.element : el("p", {class: "note"}, "Nothing is left to draw: every case is switched off above, or has no such value."));
  };
  filter.watchers.push(remake);
  remake();
  return {holder, remake};
}

/* Lines of the comparison for one result. */
function refinementLines(column) {
  const {compare, cases} = data, orders = (compare.orders.find(o => o.result === column) || {order: []}).order;
  const looks = styles(compare.columns.map(c => c.labels), compare.axes), lines = [];
  compare.columns.forEach((c, k) => {
    const points = c.cases.map((at, r) => ({row: cases.rows[at], r}))
      .filter(p => p.row && p.row[1] === "ok" && filter.shows(p.row) && isNumber(p.row[4][column]) && isNumber(compare.rows[p.r][1]));
    if (!points.length) return;
    const last = orders[k] ? orders[k][points[points.length - 1].r] : null;
    lines.push({...looks[k], label: c.labels.filter(l => l).join(", ") || titled(cases.columns[column]), x: points.map(p => compare.rows[p.r][1]), y: points.map(p => p.row[4][column]),
      rows: points.map(p => p.row), orders: points.map(p => orders[k] ? orders[k][p.r] : null), order: last});
  });
  lines.forEach((line, i) => { line.hidden = i >= MOST_LINES; });
  return lines;
}

function refinementFigure(column, logX, logY) {
  const {compare, cases} = data, lines = refinementLines(column);
  if (!lines.length) return null;
  const places = [...new Set(compare.rows.map(row => row[1]))].sort((a, b) => a - b);
  const made = figure({
    label: `${titled(cases.columns[column])} against ${compare.path}`, lines,
    x: {name: compare.path, unit: compare.unit, log: logX && places.every(place => place > 0), places},
    y: {...cases.columns[column], log: logY && lines.every(line => line.y.every(y => y > 0))},
    detail: (line, i) => [isNumber(line.orders[i]) ? `order from the point before: ${line.orders[i].toFixed(2).replace("-", "\u2212")}` : null],
  }, lines.length > MOST_LINES ? `The first ${MOST_LINES} of ${lines.length} lines are drawn; the legend shows the others, the choices above narrow them down.` : null);
  return made;
}

/* Cases that count for the front as points, and the front as steps. */
function costFigure() {
  const {front, cases} = data, x = resultIndex(front.cost), y = resultIndex(front.error);
  const rows = front.counts.map(at => cases.rows[at]).filter(filter.shows);
  if (!rows.length) return null;
  const by = data.axes.findIndex(axis => axis.path === "method.space") >= 0 ? data.axes.findIndex(axis => axis.path === "method.space") : 0;
  const groups = [...new Set(rows.map(row => row[3][by]))].sort((a, b) => a - b);
  const name = group => !data.axes.length ? "case" : isNaN(Number(data.axes[by].values[group])) ? data.axes[by].values[group] : `${leaf(data.axes[by].path)} ${data.axes[by].values[group]}`;
  const looks = styles(groups.map(group => [name(group)]), [data.axes.length ? data.axes[by].path : ""]);
  const lines = groups.map((group, g) => {
    const own = rows.filter(row => row[3][by] === group);
    return {...looks[g], marker: g, points: true, label: name(group), rows: own, x: own.map(row => row[4][x]), y: own.map(row => row[4][y])};
  });
  const members = front.members.map(member => cases.rows[member.case]).filter(filter.shows), steps = {x: [], y: []};
  members.forEach((row, i) => {
    if (i) { steps.x.push(row[4][x]); steps.y.push(members[i - 1][4][y]); }
    steps.x.push(row[4][x]);
    steps.y.push(row[4][y]);
  });
  if (members.length > 1) lines.push({...steps, label: "front: none cheaper errs less", colour: "ink", marker: null, dash: 0, width: 1.2, silent: true});
  return figure({
    label: `${titled(cases.columns[y])} against ${titled(cases.columns[x])}`, lines,
    x: {...cases.columns[x], log: spread(rows.map(row => row[4][x])) > 2}, y: {...cases.columns[y], log: spread(rows.map(row => row[4][y])) > 2},
    detail: (line, i) => [caseLabel(line.rows[i])],
  });
}

function curveLines(curves, x, y) {
  const kept = curves.filter(c => c[x] && c[y] && data.cases.rows[c.case] && filter.shows(data.cases.rows[c.case]) && c[y].some(isNumber));
  const keys = kept.map(c => data.axes.map((axis, i) => axis.values[data.cases.rows[c.case][3][i]] || ""));
  const looks = styles(keys, data.axes.map(axis => axis.path));
  return kept.map((c, i) => ({...looks[i], x: c[x], y: c[y], curve: c, dense: true, label: caseLabel(data.cases.rows[c.case]) || "the case", hidden: i >= 6}));
}

const UNITS = {"displacement.rms": "m", "velocity.rms": "m/s", "stress.rms": "Pa", crossings: "", displacement: "m", velocity: "m/s", stress: "Pa"};

function historyFigure(name, log) {
  const lines = curveLines(data.histories.curves, "time", name);
  if (!lines.length) return null;
  return figure({label: `${name} against time`, lines, x: {name: "time", unit: "s"}, y: {name, unit: UNITS[name], log: log && lines.some(line => line.y.some(y => y > 0))}});
}

/* Kinetic, strain, work and total energy of one case. */
function ledgerFigure(curve) {
  const part = (name, label, hue, marker, dash) => curve[name] && curve[name].some(isNumber) &&
    {label, x: curve.time, y: curve[name], colour: hue, marker, dash, dense: true};
  const kinetic = curve["energy.kinetic"] || [], elastic = curve["energy.elastic"] || [], work = curve["energy.work"] || [];
  const total = kinetic.map((k, i) => isNumber(k) ? k + (elastic[i] || 0) - (work[i] || 0) : null);
  const lines = [part("energy.kinetic", "kinetic", "c1", 0, 0), part("energy.elastic", "strain", "c2", 1, 1), part("energy.work", "work of body force", "c5", 2, 2),
    {label: "total: kinetic + strain \u2212 work", x: curve.time, y: total, colour: "ink", marker: 3, dash: 0, dense: true, width: 2.2}].filter(line => line && line.y.length);
  return figure({label: "Energies of " + caseLabel(data.cases.rows[curve.case]), lines, height: 320, x: {name: "time", unit: "s"}, y: {name: "energy", unit: "J"}});
}

function spectrumFigure(name) {
  const lines = curveLines(data.spectra.curves, "wavenumber", name);
  if (!lines.length) return null;
  const marks = () => [...new Set(lines.filter(line => !line.hidden).map(line => line.curve.nyquist))].filter(isNumber)
    .map((x, i) => ({x, text: "Nyquist " + tickLabels([x])[0], low: i % 2 === 1}));
  return figure({label: `${name} by wavenumber`, lines, marks, x: {name: "wavenumber", unit: "1/m", log: true}, y: {name: `error of ${name}`, unit: UNITS[name], log: true}});
}
