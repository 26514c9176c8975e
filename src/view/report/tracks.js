"use strict";
/* Particles over cells in time, of two cases beside each other: the whole diagram with time upwards, and below it the bar at the time
 * that the slider shows. */

const STRIP = 26, LEFT = 58, RIGHT = 14, TOP = 10, AXIS = 44;

/* Paths as numbers again, null where there is none. */
function decodePath(steps) {
  let at = 0;
  return steps.map(step => {
    if (!isNumber(step)) return null;
    at += step;
    return at / data.tracks.per_metre;
  });
}

function decodeTracks(entry) {
  if (entry.home) return entry;
  entry.path = entry.path.map(decodePath);
  entry.edge = entry.edge.map(decodePath).map(edge => entry.cells ? entry.time.map(() => edge[0]) : edge);
  entry.home = entry.path.map(path => homeOf(entry, path));
  return entry;
}

/* Between two samples on a straight line. */
function placeAt(entry, path, time) {
  const {time: times} = entry, last = times.length - 1;
  if (time >= times[last]) return path[last];
  const i = Math.max(1, times.findIndex(sample => sample > time)), a = path[i - 1], b = path[i];
  return a === null || b === null ? null : a + (b - a) * (time - times[i - 1]) / (times[i] - times[i - 1]);
}

/* The edges of the cell that it begins in, as functions of time; null: it begins in none. */
function homeOf(entry, path) {
  const near = 1e-9;
  if (path[0] === null) return null;
  if (entry.cells) {
    const cell = Math.floor(path[0] * entry.cells + near);
    return [cell, cell + 1].map(edge => () => edge / entry.cells);
  }
  const right = entry.edge.findIndex(edge => edge[0] > path[0] + near);
  return right < 1 ? null : [right - 1, right].map(i => time => placeAt(entry, entry.edge[i], time));
}

/* Whether the k-th particle is in another cell than at the start, by more than the numbers are rounded. */
function strayed(entry, k, time) {
  const x = placeAt(entry, entry.path[k], time), home = entry.home[k], rounding = 2 / data.tracks.per_metre;
  return x !== null && home !== null && (x < home[0](time) - rounding || x > home[1](time) + rounding);
}

const strayedCount = (entry, time) => entry.path.filter((_, k) => strayed(entry, k, time)).length;

/* Cases that end well much earlier than others have a time axis of their own, all of it along the slider. */
const endOf = (entry, view) => {
  const own = entry.time[entry.time.length - 1];
  return own > 0 && own < 0.2 * view.end && data.cases.rows[entry.case][1] === "ok" ? own : view.end;
};
const timeOf = (entry, view) => view.time / view.end * endOf(entry, view);

function tracksSummary(entry, view) {
  const time = timeOf(entry, view), own = time === view.time ? "" : ` at t = ${number(time)} s`;
  const shown = entry.path.length, kinds = [entry.row ? "of the row with most particles" : null,
    shown < entry.particles ? `${shown} of ${entry.particles} are drawn` : null].filter(kind => kind);
  const about = kinds.length ? ` (${kinds.join(", ")})` : "";
  if (!entry.edge.length) return `${plural(shown, "particle")}, no cells${about}.`;
  const far = entry.cells && entry.crossings.length === entry.crossed ? `, ${plural(entry.crossings.filter(([t]) => t <= time).length, "crossing")} so far` : "";
  return `${entry.cells ? "Fixed" : "Moving"} cells: ${strayedCount(entry, time)} of ${plural(shown, "particle")} in another than at the start${far}${own}${about}.`;
}

/* view: {from, to, time, end}; shared by both panels */
function tracksPanel(entry, view) {
  decodeTracks(entry);
  const canvas = el("canvas", {class: "bodies", role: "img"}), caption = el("figcaption", {}), label = caseLabel(data.cases.rows[entry.case]) || "the case";
  const box = el("div", {class: "plot", tabindex: "0", role: "group", "aria-roledescription": "figure",
    "aria-label": `Particles and cells in time of ${label}. Up and down keys go through time, left and right along the bar, plus and minus zoom, 0 shows all.`}, canvas);
  const chart = {box};
  chart.redraw = () => {
    caption.textContent = tracksSummary(entry, view);
    canvas.setAttribute("aria-label", caption.textContent);
    if (chart.size) drawTracks(canvas, entry, view, chart.size);
  };
  chart.rebuild = width => { chart.size = width || Math.floor(box.clientWidth); chart.redraw(); };
  new ResizeObserver(() => {
    const width = Math.floor(box.clientWidth);
    if (width && width !== chart.size && document.documentElement.dataset.theme !== "print") chart.rebuild();
  }).observe(box);
  const scrub = event => {
    const place = canvas.getBoundingClientRect();
    view.go(view.end * (1 - (event.clientY - place.top - TOP) / (place.height - TOP - STRIP - AXIS)));
  };
  canvas.addEventListener("pointerdown", event => { if (event.pointerType === "mouse" && !event.button) { canvas.setPointerCapture(event.pointerId); scrub(event); } });
  canvas.addEventListener("pointermove", event => { if (canvas.hasPointerCapture(event.pointerId)) scrub(event); });
  box.addEventListener("keydown", event => {
    const action = view.keys[event.key];
    if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    action();
  });
  charts.push(chart);
  return {chart, element: el("figure", {}, box, caption)};
}

/* The part of a path up to a time, or from it on. */
function tracePath(ctx, entry, path, time, past, px, py) {
  let drawing = false;
  const go = (x, t) => {
    if (x === null) { drawing = false; return; }
    if (drawing) ctx.lineTo(px(x), py(t)); else ctx.moveTo(px(x), py(t));
    drawing = true;
  };
  if (!past) go(placeAt(entry, path, time), time);
  entry.time.forEach((t, i) => { if (past ? t <= time : t > time) go(path[i], t); });
  if (past) go(placeAt(entry, path, time), time);
}

function drawTracks(canvas, entry, view, width) {
  const ratio = document.documentElement.dataset.theme === "print" ? 3 : devicePixelRatio || 1, height = Math.min(430, Math.max(320, width));
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  const ctx = canvas.getContext("2d"), right = width - RIGHT, bottom = height - AXIS - STRIP;
  const px = x => LEFT + (x - view.from) / (view.to - view.from) * (right - LEFT), end = endOf(entry, view), py = t => bottom - t / end * (bottom - TOP);
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx.clearRect(0, 0, width, height);
  drawTracksAxes(ctx, {...view, end}, {width, height, right, bottom, px, py});
  ctx.save();
  ctx.beginPath();
  ctx.rect(LEFT, TOP, right - LEFT, bottom + STRIP - TOP);
  ctx.clip();
  const time = Math.min(timeOf(entry, view), entry.time[entry.time.length - 1]);
  const stroke = (paths, name, past, line, alpha) => {
    ctx.beginPath();
    paths.forEach(path => tracePath(ctx, entry, path, time, past, px, py));
    ctx.strokeStyle = colour(name);
    ctx.lineWidth = line;
    ctx.globalAlpha = alpha;
    ctx.stroke();
    ctx.globalAlpha = 1;
  };
  for (const past of [false, true]) {
    stroke(entry.path, "c1", past, 0.9, past ? 0.7 : 0.2);
    stroke(entry.edge, "edge", past, 1.6, past ? 1 : 0.45);
  }
  drawCrossings(ctx, entry, time, px, py);
  drawNow(ctx, entry, time, {right, bottom, px, py});
  ctx.restore();
}

function drawTracksAxes(ctx, view, {width, height, right, bottom, px, py}) {
  ctx.font = "12px system-ui, sans-serif";
  ctx.lineWidth = 1;
  const xs = ticks(view.from, view.to, false, right - LEFT), ts = ticks(0, view.end, false, 1.4 * (bottom - TOP));
  const xLabels = tickLabels(xs), tLabels = tickLabels(ts);
  ctx.fillStyle = colour("muted");
  ctx.textAlign = "center";
  xs.forEach((x, i) => { ctx.fillText(xLabels[i], Math.min(px(x), width - ctx.measureText(xLabels[i]).width / 2 - 1), height - AXIS + 17); });
  ctx.fillText("x [m]", (LEFT + right) / 2, height - 8);
  ctx.textAlign = "right";
  ts.forEach((t, i) => ctx.fillText(tLabels[i], LEFT - 7, py(t) + 4));
  ctx.save();
  ctx.translate(11, (TOP + bottom) / 2);
  ctx.rotate(-Math.PI / 2);
  ctx.textAlign = "center";
  ctx.fillText("time [s]", 0, 0);
  ctx.restore();
  ctx.strokeStyle = colour("rule");
  ctx.beginPath();
  xs.forEach(x => { ctx.moveTo(px(x), height - AXIS); ctx.lineTo(px(x), height - AXIS + 5); });
  ts.forEach(t => { ctx.moveTo(LEFT - 5, py(t)); ctx.lineTo(LEFT, py(t)); });
  ctx.stroke();
}

function drawCrossings(ctx, entry, time, px, py) {
  const r = entry.crossings.length > 400 ? 1.6 : 2.4;
  ctx.fillStyle = colour("c0");
  for (const past of [false, true]) {
    ctx.globalAlpha = past ? 1 : 0.25;
    ctx.beginPath();
    entry.crossings.filter(([t]) => past === t <= time).forEach(([t, x]) => { ctx.moveTo(px(x) + r, py(t)); ctx.arc(px(x), py(t), r, 0, 2 * Math.PI); });
    ctx.fill();
  }
  ctx.globalAlpha = 1;
}

/* The line of the time, and the bar at it: cells, and particles that strayed from theirs. */
function drawNow(ctx, entry, time, {right, bottom, px, py}) {
  ctx.strokeStyle = colour("ink");
  ctx.lineWidth = 1.2;
  ctx.beginPath();
  ctx.moveTo(LEFT, py(time));
  ctx.lineTo(right, py(time));
  ctx.stroke();
  ctx.fillStyle = colour("paper");
  ctx.fillRect(LEFT, bottom, right - LEFT, STRIP);
  const edges = entry.edge.map(edge => placeAt(entry, edge, time));
  ctx.fillStyle = colour("rule");
  edges.forEach((edge, i) => { if (i % 2 && i < edges.length && edges[i - 1] !== null && edge !== null) ctx.fillRect(px(edges[i - 1]), bottom + 1, px(edge) - px(edges[i - 1]), STRIP - 1); });
  ctx.strokeStyle = colour("edge");
  ctx.strokeRect(LEFT, bottom + 0.5, right - LEFT, STRIP - 1);
  const r = Math.min(4, Math.max(1.8, 0.35 * (px(1) - px(0)) / entry.path.length));
  entry.path.forEach((path, k) => {
    const x = placeAt(entry, path, time);
    if (x === null) return;
    ctx.fillStyle = colour(strayed(entry, k, time) ? "c0" : "c1");
    for (const y of [bottom + STRIP / 2, py(time)]) {
      ctx.beginPath();
      ctx.arc(px(x), y, r, 0, 2 * Math.PI);
      ctx.fill();
    }
  });
}

/* The time at which most particles of the first case have left their cell, else the last. */
function firstTime(entry) {
  decodeTracks(entry);
  const counts = entry.time.map(time => strayedCount(entry, time)), most = Math.max(...counts);
  return most ? entry.time[counts.indexOf(most)] : entry.time[entry.time.length - 1];
}

function createView(cases) {
  const redraw = () => charts.filter(chart => chart.redraw && chart.box.isConnected).forEach(chart => chart.redraw());
  const view = {from: 0, to: 1, end: Math.max(...cases.map(entry => entry.time[entry.time.length - 1])) || 1, time: 0, watch: () => {}};
  view.show = (from, to) => {
    const width = Math.min(1, Math.max(0.02, to - from)), start = Math.min(1 - width, Math.max(0, (from + to - width) / 2));
    view.from = start;
    view.to = start + width;
    redraw();
  };
  view.go = time => {
    view.time = Math.min(view.end, Math.max(0, time));
    view.watch();
    redraw();
  };
  view.zoom = factor => {
    const centre = (view.from + view.to) / 2, half = (view.to - view.from) / 2 * factor;
    view.show(centre - half, centre + half);
  };
  const pan = share => view.show(view.from + share * (view.to - view.from), view.to + share * (view.to - view.from));
  const all = () => view.show(0, 1);
  view.keys = {
    ArrowUp: () => view.go(view.time + view.end / 100), ArrowDown: () => view.go(view.time - view.end / 100), ArrowLeft: () => pan(-0.2), ArrowRight: () => pan(0.2),
    "+": () => view.zoom(0.6), "=": () => view.zoom(0.6), "-": () => view.zoom(1 / 0.6), "0": all,
  };
  return {view, all};
}

/* Play, slider, clock. */
function timeControls(view) {
  const slider = el("input", {type: "range", min: 0, max: 1000, step: 1, "aria-label": "Time", id: "scrub", oninput: () => view.go(view.end * slider.value / 1000)});
  const clock = el("output", {class: "clock", for: "scrub"}), play = button("Play", () => playing ? stop() : start());
  let playing = null;
  const stop = () => { if (playing) cancelAnimationFrame(playing.frame); playing = null; play.textContent = "Play"; };
  const start = () => {
    const from = view.time >= view.end ? 0 : view.time, began = performance.now();
    playing = {};
    play.textContent = "Pause";
    const tick = now => {
      const time = from + view.end * Math.max(0, now - began) / 8000;
      view.go(time);
      if (time < view.end) playing.frame = requestAnimationFrame(tick); else stop();
    };
    playing.frame = requestAnimationFrame(tick);
  };
  view.watch = () => {
    slider.value = Math.round(1000 * view.time / view.end);
    clock.textContent = `t = ${number(view.time)} s`;
    slider.setAttribute("aria-valuetext", clock.textContent);
  };
  return [play, slider, clock];
}

function tracksSection() {
  const {tracks} = data;
  if (!tracks.cases.length) return null;
  const {view, all} = createView(tracks.cases);
  const controls = el("div", {class: "controls keep"}, timeControls(view), button("+", () => view.zoom(0.6), {"aria-label": "Zoom in"}),
    button("\u2212", () => view.zoom(1 / 0.6), {"aria-label": "Zoom out"}), button("Show all", all));
  const panels = pairOf(tracks.cases, entry => tracksPanel(entry, view));
  view.go(firstTime(tracks.cases[0]));
  return section("tracks", "Particles crossing cells", el("p", {class: "note"},
    "Paths of particles (blue) over the edges of cells (grey), time upwards; crossings of a fixed grid's edges are marked. Move the slider, or the pointer over a diagram, " +
    "through time: the strip below shows the bar then, with particles that left the cell they began in orange."), controls, panels,
    tracks.total > tracks.cases.length ? el("p", {class: "note"}, `${tracks.cases.length} of ${plural(tracks.total, "case")} with snapshots; gridcross plot DIR xt draws the others.`) : null);
}
