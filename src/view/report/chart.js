"use strict";
/* One figure: lines and points that are zoomed, pointed at, and switched on and off. uPlot draws; ranges, ticks, markers and the
 * label beside the pointer are made here. */

const charts = [];
const colour = name => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
const DASHES = [[], [7, 4], [2, 3], [9, 3, 2, 3], [12, 5], [4, 2, 1, 2]];
const MARKERS = ["circle", "square", "triangle", "diamond", "down", "cross", "plus"];

function markerPath(path, kind, x, y, r) {
  const corners = {
    square: [[-1, -1], [1, -1], [1, 1], [-1, 1]], triangle: [[0, -1.25], [1.15, 0.85], [-1.15, 0.85]],
    diamond: [[0, -1.35], [1.15, 0], [0, 1.35], [-1.15, 0]], down: [[0, 1.25], [1.15, -0.85], [-1.15, -0.85]],
  }[kind];
  if (corners) {
    corners.forEach(([dx, dy], i) => i ? path.lineTo(x + dx * r * 0.9, y + dy * r * 0.9) : path.moveTo(x + dx * r * 0.9, y + dy * r * 0.9));
    path.closePath();
  } else if (kind === "cross" || kind === "plus") {
    const d = kind === "cross" ? [[-1, -1, 1, 1], [-1, 1, 1, -1]] : [[-1.2, 0, 1.2, 0], [0, -1.2, 0, 1.2]];
    d.forEach(([a, b, c, e]) => { path.moveTo(x + a * r, y + b * r); path.lineTo(x + c * r, y + e * r); });
  } else {
    path.moveTo(x + r, y);
    path.arc(x, y, r, 0, 2 * Math.PI);
  }
}

/* Places and labels of ticks of an axis. */
function ticks(least, most, log, room) {
  const wanted = Math.max(2, Math.floor(room / 60)), decades = Math.log10(most / least);
  if (log && decades > 1.3) {
    const step = Math.max(1, Math.ceil(decades / wanted)), places = [];
    const mantissas = decades < 3 && wanted > 2 * decades ? [1, 2, 5] : [1];
    for (let k = Math.ceil(Math.log10(least) - 1); k <= Math.log10(most); k++)
      if (k % step === 0) mantissas.forEach(m => places.push(m * 10 ** k));
    return places.filter(place => place >= least && place <= most);
  }
  const rough = (most - least) / wanted, unit = 10 ** Math.floor(Math.log10(rough));
  const step = unit * [1, 2, 5, 10].find(m => m * unit >= rough), places = [];
  for (let i = Math.ceil(least / step); i <= most / step + 1e-9; i++) places.push(i * step);
  return places;
}

const minus = text => String(text).replace(/-/g, "\u2212");

function power(value) {
  const raised = Math.floor(Math.log10(Math.abs(value)) + 1e-9), lead = parseFloat((value / 10 ** raised).toPrecision(4));
  return (lead === 1 ? "" : minus(lead) + "·") + "10" + String(raised).replace(/./g, c => c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]);
}

/* All of an axis alike: in full, or by powers of ten. */
function tickLabels(places) {
  const sizes = places.map(Math.abs).filter(size => size), most = Math.max(...sizes, 0), least = Math.min(...sizes);
  const full = most < 1e5 && (least >= 1e-2 || most >= 0.01 && most / least < 50);
  return places.map(place => place === 0 ? "0" : full ? minus(parseFloat(place.toPrecision(6))) : power(place));
}

/* Rows of x with a value a line, for uPlot; a line with two points at one x has two rows. */
function alignedData(lines, xLog, yLog) {
  const points = lines.flatMap((line, l) => line.x.map((x, i) => ({x, y: line.y[i], l})))
    .filter(p => isNumber(p.x) && isNumber(p.y) && (!xLog || p.x > 0) && (!yLog || p.y > 0));
  points.sort((a, b) => a.x - b.x);
  const xs = [], rows = lines.map(() => []);
  for (const p of points) {
    if (!xs.length || xs[xs.length - 1] !== p.x || rows[p.l][xs.length - 1] !== undefined) xs.push(p.x);
    rows[p.l][xs.length - 1] = p.y;
  }
  return [xs, ...rows.map(row => Array.from(xs, (_, i) => row[i] === undefined ? null : row[i]))];
}

function span(values, log) {
  let least = Infinity, most = -Infinity;
  for (const value of values) if (isNumber(value) && (!log || value > 0)) { least = Math.min(least, value); most = Math.max(most, value); }
  if (least > most) return log ? [1, 10] : [0, 1];
  if (log) {
    const pad = Math.max((most / least) ** 0.05, 1.08);
    return [least / pad, most * pad];
  }
  const pad = 0.05 * (most - least) || 0.05 * Math.abs(most) || 1;
  return [least - pad, most + pad];
}

/* spec: {label, x, y: {name, unit, log, places}, lines, height, tight, marks(): [{x, text, low}], detail(line, i), under(chart, plot)}
 * lines: {label, x, y, colour, marker, dash, points: no line, steps, dense, hidden, width, silent} */
function createChart(spec) {
  const chart = {spec, plot: null, active: null, lines: spec.lines, frame: null};
  chart.tip = el("div", {class: "tip", role: "status"});
  chart.ring = el("div", {class: "ring", hidden: true});
  chart.box = el("div", {class: "plot", tabindex: "0", role: "group", "aria-roledescription": "figure",
    "aria-label": `${spec.label}. Arrow keys go from point to point, plus and minus zoom, 0 shows all.`}, chart.tip);
  const all = () => ({x: spec.x.range || spanOf(chart, "x"), y: spec.y.range || spanOf(chart, "y")});
  chart.reset = () => chart.zoomTo(all());
  chart.zoomTo = ({x, y}) => {
    if (!chart.plot || !(x[1] > x[0]) || !(y[1] > y[0])) return;
    chart.plot.batch(() => {
      chart.plot.setScale("x", {min: x[0], max: x[1]});
      chart.plot.setScale("y", {min: y[0], max: y[1]});
    });
    chart.point(null);
  };
  chart.zoom = factor => {
    const about = (axis, s) => {
      const f = axis.log ? Math.log : v => v, g = axis.log ? Math.exp : v => v, a = f(s.min), b = f(s.max);
      const centre = chart.active && axis === spec.x ? f(chart.active.x) : chart.active && axis === spec.y ? f(chart.active.y) : (a + b) / 2;
      return [g(centre - (centre - a) * factor), g(centre + (b - centre) * factor)];
    };
    if (chart.plot) chart.zoomTo({x: about(spec.x, chart.plot.scales.x), y: about(spec.y, chart.plot.scales.y)});
  };
  chart.show = (line, on) => {
    line.hidden = !on;
    if (chart.plot) chart.plot.setSeries(chart.lines.indexOf(line) + 1, {show: on});
  };
  chart.rebuild = width => build(chart, width);
  chart.point = target => pointAt(chart, target);
  new ResizeObserver(() => {
    const width = Math.floor(chart.box.clientWidth);
    if (!width || document.documentElement.dataset.theme === "print") return;
    if (!chart.plot) build(chart);
    else if (chart.plot.width !== width) { chart.plot.setSize({width, height: chart.plot.height}); chart.point(null); }
  }).observe(chart.box);
  followPointer(chart);
  steerByKeys(chart);
  charts.push(chart);
  return chart;
}

function spanOf(chart, axis) {
  const shown = chart.lines.filter(line => !line.hidden), lines = shown.length ? shown : chart.lines;
  return span(lines.flatMap(line => line[axis]), chart.spec[axis].log);
}

const ruler = document.createElement("canvas").getContext("2d");
function widthOf(text) {
  ruler.font = "12px system-ui, sans-serif";
  return Math.ceil(ruler.measureText(text).width);
}

function axisOptions(chart, which) {
  const axis = chart.spec[which], across = which === "x";
  return {
    stroke: colour("muted"), font: "12px system-ui, sans-serif", labelFont: "12px system-ui, sans-serif",
    label: titled(axis), labelSize: across ? 22 : 20, labelGap: across ? 2 : 4, size: across ? 30 : (u, labels) => 16 + Math.max(34, ...(labels || []).map(widthOf)), gap: 5,
    grid: {stroke: colour("grid"), width: 1}, ticks: {stroke: colour("rule"), width: 1, size: 5},
    splits: (u, i, least, most) => {
      const room = across ? u.bbox.width / devicePixelRatio : 1.4 * u.bbox.height / devicePixelRatio;
      const places = (axis.places || []).filter(place => place >= least && place <= most), f = axis.log ? Math.log : v => v;
      const crowded = places.some((place, k) => k && (f(place) - f(places[k - 1])) / (f(most) - f(least)) * room < 45);
      return places.length > 1 && !crowded ? places : ticks(least, most, axis.log, room);
    },
    filter: (u, splits) => splits,
    values: (u, splits) => tickLabels(splits),
  };
}

function build(chart, width) {
  const {spec} = chart;
  const shared = {auto: false, time: false, range: (u, least, most) => least < most ? [least, most] : [1, 10]};
  const kept = chart.plot ? {x: [chart.plot.scales.x.min, chart.plot.scales.x.max], y: [chart.plot.scales.y.min, chart.plot.scales.y.max]} : null;
  if (chart.plot) chart.plot.destroy();
  const size = width || Math.floor(chart.box.clientWidth) || 640;
  const height = Math.min(spec.height || 400, Math.max(280, 0.8 * size));
  chart.plot = new uPlot({
    width: size, height, legend: {show: false}, padding: [10, 14, 0, 0],
    scales: {x: {...shared, distr: spec.x.log ? 3 : 1}, y: {...shared, distr: spec.y.log ? 3 : 1}},
    axes: [axisOptions(chart, "x"), axisOptions(chart, "y")],
    series: [{}, ...chart.lines.map(line => ({
      show: !line.hidden, label: line.label, stroke: colour(line.colour), width: line.points ? 0 : line.width || 1.75,
      dash: DASHES[line.dash % DASHES.length || 0], spanGaps: true, points: {show: false}, paths: line.points ? () => null : uPlot.paths.linear(),
    }))],
    cursor: {points: {show: false}, y: false, drag: {x: true, y: true, uni: 20}, bind: {dblclick: () => () => { chart.reset(); return null; }}},
    hooks: {drawAxes: [u => spec.under && spec.under(chart, u)], drawSeries: [(u, i) => drawMarkers(chart, u, i)], draw: [u => drawMarks(chart, u)]},
  }, alignedData(chart.lines, spec.x.log, spec.y.log), chart.box);
  chart.box.append(chart.ring);
  chart.plot.root.querySelector("canvas").setAttribute("aria-hidden", "true");
  chart.zoomTo(kept || {x: spec.x.range || spanOf(chart, "x"), y: spec.y.range || spanOf(chart, "y")});
}

function clipped(u, draw) {
  u.ctx.save();
  u.ctx.beginPath();
  u.ctx.rect(u.bbox.left - 6, u.bbox.top - 6, u.bbox.width + 12, u.bbox.height + 12);
  u.ctx.clip();
  draw(u.ctx, devicePixelRatio || 1);
  u.ctx.restore();
}

/* Lines of many samples have few markers. */
function drawMarkers(chart, u, i) {
  const line = chart.lines[i - 1];
  if (!line || line.hidden || line.marker === null) return;
  const values = u.data[i], filled = values.map((y, k) => y === null ? -1 : k).filter(k => k >= 0);
  const every = line.dense ? Math.max(1, Math.floor(filled.length / 8)) : 1;
  clipped(u, (ctx, ratio) => {
    const path = new Path2D(), kind = MARKERS[line.marker % MARKERS.length];
    filled.forEach((k, n) => {
      if (line.dense && n % every !== Math.floor(every / 2)) return;
      markerPath(path, line.open ? "circle" : kind, u.valToPos(u.data[0][k], "x", true), u.valToPos(values[k], "y", true), (line.open ? 5 : 4) * ratio);
    });
    ctx.strokeStyle = line.open || kind === "cross" || kind === "plus" ? colour(line.colour) : colour("paper");
    ctx.fillStyle = colour(line.colour);
    ctx.lineWidth = (line.open || kind === "cross" || kind === "plus" ? 1.6 : 0.8) * ratio;
    if (!line.open) ctx.fill(path);
    ctx.stroke(path);
  });
}

/* Vertical lines with a word beside them. */
function drawMarks(chart, u) {
  for (const mark of chart.spec.marks ? chart.spec.marks() : []) {
    if (mark.x < u.scales.x.min || mark.x > u.scales.x.max) continue;
    clipped(u, (ctx, ratio) => {
      const x = Math.round(u.valToPos(mark.x, "x", true));
      ctx.strokeStyle = ctx.fillStyle = colour("muted");
      ctx.lineWidth = ratio;
      ctx.setLineDash([3 * ratio, 3 * ratio]);
      ctx.beginPath();
      ctx.moveTo(x, u.bbox.top);
      ctx.lineTo(x, u.bbox.top + u.bbox.height);
      ctx.stroke();
      ctx.font = `${11 * ratio}px system-ui, sans-serif`;
      const right = x > u.bbox.left + 0.8 * u.bbox.width;
      ctx.textAlign = right ? "right" : "left";
      ctx.fillText(mark.text, x + (right ? -4 : 4) * ratio, u.bbox.top + (mark.low ? u.bbox.height - 5 * ratio : 12 * ratio));
    });
  }
}
