// Reads values off the curves: at the pointer, the finger or the arrow keys, with a crosshair and the numbers beside it.
"use strict";

(() => {
  const MOST_ROWS = 8;

  for (const source of document.querySelectorAll('script[id$="-readout"]')) {
    const figure = source.closest("figure");
    const svg = figure && figure.querySelector("svg");
    if (svg) enhance(svg, JSON.parse(source.textContent));
  }

  function enhance(svg, plots) {
    const stops = plots.filter((plot) => plot.curves).flatMap((plot) => stopsOf(plot));
    if (!stops.length) return;
    const view = svg.viewBox.baseVal;
    const frame = fluxbore.element("div", { class: "reading" });
    const tip = fluxbore.element("div", { class: "tip", hidden: "", "aria-hidden": "true" });
    svg.before(frame);
    frame.append(svg, tip);
    const marks = fluxbore.drawn(svg, "g", { "aria-hidden": "true" });
    svg.append(marks);
    let now = -1;

    const label = svg.getAttribute("aria-label");
    const control = { role: "slider", tabindex: "0", "aria-label": `${label} Arrow keys read values.`,
      "aria-valuemin": "0", "aria-valuemax": String(stops.length - 1), "aria-valuenow": "0", "aria-valuetext": "no value read" };
    fluxbore.fill(svg, control, []);

    function show(place) {
      if (place === now) return;
      now = place;
      marks.replaceChildren();
      tip.hidden = place < 0;
      if (place < 0) return;
      const stop = stops[place];
      const [left, top, right, bottom] = stop.plot.box;
      const rows = rowsAt(stop).filter((row) => row.y >= top - 1 && row.y <= bottom + 1);
      const line = (x1, y1, x2, y2) => marks.append(fluxbore.drawn(svg, "line", { class: "across", x1, y1, x2, y2 }));
      line(stop.x, top, stop.x, bottom);
      if (stop.curve) line(left, stop.y, right, stop.y);
      for (const row of rows) marks.append(fluxbore.drawn(svg, "circle", { class: "at", cx: stop.x, cy: row.y, r: 4.5, style: `fill:${row.colour}` }));
      const texts = [quantity(stop.plot.x, stop.value), ...rows.slice(0, MOST_ROWS).map((row) => row.text)];
      tip.replaceChildren(...texts.map((text, i) => {
        const dot = fluxbore.element("i", i ? { style: `background:${rows[i - 1].colour}` } : {});
        return i ? fluxbore.element("div", {}, dot, text) : fluxbore.element("div", {}, text);
      }));
      // Where the curves are not: the numbers must not hide what they are read off.
      const high = rows.length > 0 && rows.every((row) => row.y < (top + bottom) / 2);
      fluxbore.beside(tip, stop.x / view.width, (high ? bottom : top) / view.height, high);
      svg.setAttribute("aria-valuenow", String(place));
      svg.setAttribute("aria-valuetext", texts.join("; "));
    }

    function point(event) {
      const area = svg.getBoundingClientRect();
      const x = ((event.clientX - area.left) * view.width) / area.width;
      const y = ((event.clientY - area.top) * view.height) / area.height;
      const slack = 12;
      const over = (plot) => x > plot.box[0] - slack && x < plot.box[2] + slack && y > plot.box[1] - slack && y < plot.box[3] + slack;
      let best = -1, least = Infinity;
      stops.forEach((stop, i) => {
        if (!over(stop.plot)) return;
        const distance = stop.curve ? Math.hypot(stop.x - x, stop.y - y) : Math.abs(stop.x - x);
        if (distance < least) [best, least] = [i, distance];
      });
      show(best);
    }

    svg.addEventListener("pointermove", point);
    svg.addEventListener("pointerdown", point);
    svg.addEventListener("pointerleave", (event) => { if (event.pointerType === "mouse") show(-1); });
    svg.addEventListener("blur", () => show(-1));
    svg.addEventListener("keydown", (event) => {
      const last = stops.length - 1, far = Math.max(Math.round(stops.length / 10), 1);
      const moves = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: far, PageDown: -far, Home: -Infinity, End: Infinity };
      if (event.key === "Escape") return show(-1);
      if (!(event.key in moves)) return;
      event.preventDefault();
      show(now < 0 && event.key !== "End" ? 0 : Math.min(Math.max(now + moves[event.key], 0), last));
    });
  }

  // Where reading stops: at every abscissa of curves that are functions of it, else at every point of every curve.
  function stopsOf(plot) {
    const inside = (value) => (value - plot.x.ends[0]) * (value - plot.x.ends[1]) <= 1e-9 * (plot.x.ends[1] - plot.x.ends[0]) ** 2;
    if (plot.curves.every((curve) => rises(curve.x))) {
      const values = new Set(plot.curves.flatMap((curve) => curve.x).filter((value) => value !== null && inside(value)));
      const rising = [...values].sort((a, b) => a - b);
      return rising.map((value) => ({ plot, value, x: across(plot, value) }));
    }
    return plot.curves.flatMap((curve) => curve.x.flatMap((value, i) => {
      if (value === null || curve.y[i] === null) return [];
      return [{ plot, curve, i, value, x: across(plot, value), y: up(plot, curve.y[i]) }];
    }));
  }

  function rowsAt(stop) {
    const curves = stop.curve ? [stop.curve] : stop.plot.curves;
    return curves.flatMap((curve) => {
      const value = stop.curve ? curve.y[stop.i] : valueAt(curve, stop.value, stop.plot.x.log);
      if (value === null) return [];
      const name = curve.name || stop.plot.y.label;
      const unit = stop.plot.y.unit ? ` ${stop.plot.y.unit}` : "";
      return [{ y: up(stop.plot, value), colour: curve.colour, text: `${name}: ${fluxbore.number(value)}${unit}` }];
    });
  }

  // The curve's value at an abscissa, on the straight piece or the step as drawn; null where nothing is drawn.
  function valueAt(curve, x, logarithmic) {
    const after = curve.x.findIndex((value) => value !== null && value >= x);
    if (after < 0) return null;
    if (curve.x[after] === x) return curve.y[after];
    if (after === 0 || curve.join === "none") return null;
    const before = curve.y[after - 1];
    if (curve.join === "steps") return before;
    if (before === null || curve.y[after] === null || curve.x[after - 1] === null) return null;
    const at = logarithmic ? Math.log : (value) => value;
    const share = (at(x) - at(curve.x[after - 1])) / (at(curve.x[after]) - at(curve.x[after - 1]));
    return before + share * (curve.y[after] - before);
  }

  function rises(values) {
    const known = values.filter((value) => value !== null);
    return known.every((value, i) => i === 0 || value >= known[i - 1]);
  }

  function share(axis, value) {
    const at = axis.log ? Math.log : (number) => number;
    return (at(value) - at(axis.ends[0])) / (at(axis.ends[1]) - at(axis.ends[0]));
  }

  function across(plot, value) {
    return plot.box[0] + share(plot.x, value) * (plot.box[2] - plot.box[0]);
  }

  function up(plot, value) {
    return plot.box[3] - share(plot.y, value) * (plot.box[3] - plot.box[1]);
  }

  function quantity(axis, value) {
    return `${axis.label} ${fluxbore.number(value)}${axis.unit ? ` ${axis.unit}` : ""}`;
  }
})();
