"use strict";
/* Pointing at a figure, by mouse, touch or keys, and the legend that switches its lines. */

function pointAt(chart, target) {
  chart.active = target;
  chart.ring.hidden = !target;
  chart.tip.replaceChildren();
  if (!target || !chart.plot) return;
  const {line, i} = target, {spec, plot} = chart, over = plot.over;
  const left = over.offsetLeft + plot.valToPos(target.x, "x"), top = over.offsetTop + plot.valToPos(target.y, "y");
  const rows = [`${titled(spec.x)}: ${tipNumber(target.x)}`, `${titled(spec.y)}: ${tipNumber(target.y)}`];
  if (spec.detail) rows.push(...spec.detail(line, i));
  chart.tip.append(el("b", {}, line.label), ...rows.filter(row => row).map(row => el("div", {}, row)));
  chart.ring.style.transform = `translate(${left}px, ${top}px)`;
  const width = chart.tip.offsetWidth, height = chart.tip.offsetHeight, room = chart.box.clientWidth;
  const x = left + 14 + width > room ? Math.max(0, left - 14 - width) : left + 14;
  const y = Math.max(0, top - height - 10);
  chart.tip.style.transform = `translate(${Math.min(x, Math.max(0, room - width))}px, ${y}px)`;
}

const tipNumber = value => Number.isInteger(value) ? number(value) : number(value, Math.abs(value) < 1e-2);

function visiblePoints(chart, line) {
  const {x, y} = chart.plot.scales, log = chart.spec.y.log;
  return line.x.map((px, i) => ({line, i, x: px, y: line.y[i]}))
    .filter(p => isNumber(p.x) && isNumber(p.y) && (!log || p.y > 0) && p.x >= x.min && p.x <= x.max && p.y >= y.min && p.y <= y.max);
}

const pointedLines = chart => chart.lines.filter(line => !line.hidden && !line.silent && visiblePoints(chart, line).length);

function nearest(chart, left, top) {
  let best = null, least = 40 ** 2;
  for (const line of pointedLines(chart))
    for (const p of visiblePoints(chart, line)) {
      const d = (chart.plot.valToPos(p.x, "x") - left) ** 2 + (chart.plot.valToPos(p.y, "y") - top) ** 2;
      if (d < least) { least = d; best = p; }
    }
  return best;
}

function followPointer(chart) {
  let waiting = null;
  const move = event => {
    if (!chart.plot) return;
    const place = chart.plot.over.getBoundingClientRect(), left = event.clientX - place.left, top = event.clientY - place.top;
    if (waiting) cancelAnimationFrame(waiting);
    waiting = requestAnimationFrame(() => { waiting = null; chart.point(nearest(chart, left, top)); });
  };
  chart.box.addEventListener("pointermove", move);
  chart.box.addEventListener("pointerdown", move);
  chart.box.addEventListener("pointerleave", () => {
    if (waiting) cancelAnimationFrame(waiting);
    waiting = null;
    chart.point(null);
  });
  chart.box.addEventListener("blur", () => chart.point(null));
}

/* Left and right along a line, up and down between lines. */
function step(chart, along, across) {
  const lines = pointedLines(chart);
  if (!lines.length) return;
  const at = chart.active ? lines.indexOf(chart.active.line) : -1;
  const line = lines[at < 0 ? 0 : (at + across + lines.length) % lines.length];
  const points = visiblePoints(chart, line);
  const here = at < 0 ? -1 : across ? points.reduce((best, p, i) => Math.abs(p.x - chart.active.x) < Math.abs(points[best].x - chart.active.x) ? i : best, 0)
    : points.findIndex(p => p.i === chart.active.i);
  const next = across || here < 0 ? Math.max(0, here) : Math.min(points.length - 1, Math.max(0, here + along));
  chart.point(points[next]);
}

function steerByKeys(chart) {
  const actions = {
    ArrowRight: () => step(chart, 1, 0), ArrowLeft: () => step(chart, -1, 0), ArrowUp: () => step(chart, 0, -1), ArrowDown: () => step(chart, 0, 1),
    "+": () => chart.zoom(0.6), "=": () => chart.zoom(0.6), "-": () => chart.zoom(1 / 0.6), "0": () => chart.reset(), Escape: () => chart.point(null),
  };
  chart.box.addEventListener("keydown", event => {
    if (!actions[event.key] || event.ctrlKey || event.metaKey || event.altKey || !chart.plot) return;
    event.preventDefault();
    actions[event.key]();
  });
}

function swatch(line) {
  const space = "http://www.w3.org/2000/svg", svg = document.createElementNS(space, "svg");
  const add = (tag, attributes) => {
    const node = document.createElementNS(space, tag);
    for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
    svg.append(node);
  };
  svg.setAttribute("viewBox", "0 0 34 14");
  svg.setAttribute("aria-hidden", "true");
  const paint = `var(--${line.colour})`;
  if (!line.points) add("line", {x1: 1, y1: 7, x2: 33, y2: 7, stroke: paint, "stroke-width": 2, "stroke-dasharray": DASHES[line.dash % DASHES.length || 0].join(" ") || "none"});
  if (line.marker !== null) {
    const d = [], path = {
      moveTo: (x, y) => d.push(`M${x} ${y}`), lineTo: (x, y) => d.push(`L${x} ${y}`), closePath: () => d.push("Z"),
      arc: (x, y, r) => d.push(`a${r} ${r} 0 1 1 ${-2 * r} 0a${r} ${r} 0 1 1 ${2 * r} 0`),
    };
    const kind = line.open ? "circle" : MARKERS[line.marker % MARKERS.length];
    markerPath(path, kind, 17, 7, 4);
    const hollow = line.open || kind === "cross" || kind === "plus";
    add("path", {d: d.join(""), fill: hollow ? "none" : paint, stroke: paint, "stroke-width": hollow ? 1.6 : 0});
  }
  return svg;
}

function legend(chart) {
  return el("ul", {class: "legend", "aria-label": "Lines shown"}, chart.lines.filter(line => !line.unlisted).map(line => {
    const toggle = button("", () => {
      chart.show(line, line.hidden);
      toggle.setAttribute("aria-pressed", String(!line.hidden));
      chart.point(null);
    }, {"aria-pressed": String(!line.hidden)});
    toggle.append(swatch(line), el("span", {}, line.label, line.order ? el("span", {class: "unit"}, " order " + line.order.toFixed(1).replace("-", "\u2212")) : ""));
    return el("li", {}, toggle);
  }));
}

/* The figure with its buttons, legend and caption. more: controls of its own. */
function figure(spec, caption, ...more) {
  const chart = createChart(spec);
  const controls = el("div", {class: "controls"}, more, el("span", {class: "gap"}),
    button("+", () => chart.zoom(0.6), {"aria-label": "Zoom in"}), button("\u2212", () => chart.zoom(1 / 0.6), {"aria-label": "Zoom out"}),
    button("Show all", () => chart.reset()));
  const element = el("figure", {}, controls, chart.box, spec.legend === false ? null : legend(chart), caption ? el("figcaption", {}, caption) : null);
  return {element, chart};
}
