// Brushing: a range on any axis, or a rectangle in the scatter, picks the same designs in both pictures and in a table.
"use strict";

(() => {
  const MOST_ROWS = 60, STEPS = 50, LEAST = 4;
  const data = fluxbore.data("designs-data");
  const lines = document.querySelector("svg.parallel"), cloud = document.querySelector("svg.scatter");
  const side = document.getElementById("designs-selected");
  if (!data || !lines || !cloud || !side) return;

  const count = data.origin.length;
  const ranges = data.columns.map(() => null);
  const shapes = [lines, cloud].map((svg) => {
    const found = [];
    for (const shape of svg.querySelectorAll("[data-row]")) found[shape.dataset.row] = shape;
    svg.setAttribute("role", "group");
    return found;
  });
  const pair = { x: data.across, y: data.up };
  const plane = cloud.querySelector(".plane");
  const area = Object.fromEntries(["x", "y", "width", "height"].map((key) => [key, Number(plane.getAttribute(key))]));
  const choices = fluxbore.element("div", { class: "choices" });
  const told = fluxbore.element("p", { class: "count", role: "status", "aria-live": "polite" });
  const reset = button("Reset", () => { ranges.fill(null); update(); });
  const region = fluxbore.element("div", { class: "scroll", role: "region", "aria-label": "Selected designs", tabindex: "0" });
  const hint = "Drag along an axis, or a rectangle in the scatter; or move an axis’s two grips with the arrow keys.";
  choices.append(chooser("Across", "x"), chooser("Up", "y"), reset);
  side.append(choices, fluxbore.element("p", { class: "note aside" }, hint), told, region);

  const grips = [...lines.querySelectorAll(".axis")].map(brushable);
  const rectangle = fluxbore.drawn(cloud, "rect", { class: "span" });
  cloud.append(rectangle);
  drag(plane, cloud, (from, to) => {
    const across = span("x", from.x, to.x), up = span("y", from.y, to.y);
    const small = Math.abs(from.x - to.x) < LEAST && Math.abs(from.y - to.y) < LEAST;
    ranges[pair.x] = small ? null : across;
    ranges[pair.y] = small ? null : up;
    update();
  });
  update();

  // ---- axes -------------------------------------------------------------------------------------------------------

  function brushable(axis) {
    const column = Number(axis.dataset.column);
    const [, x, top, bottom] = /M([\d.]+) ([\d.]+)V([\d.]+)/.exec(axis.querySelector(".line").getAttribute("d")).map(Number);
    const strip = fluxbore.drawn(lines, "rect", { class: "strip", x: x - 16, y: top - 8, width: 32, height: bottom - top + 16 });
    const band = fluxbore.drawn(lines, "rect", { class: "span", x: x - 7, width: 14 });
    const ends = [0, 1].map((end) => fluxbore.drawn(lines, "rect", { class: "grip", x: x - 9, width: 18, height: 6, rx: 2,
      role: "slider", tabindex: "0", "aria-orientation": "vertical",
      "aria-label": `${data.columns[column].label}, ${end ? "most" : "least"}` }));
    axis.append(strip, band, ...ends);
    const valueAt = (y) => at(column, (bottom - y) / (bottom - top));
    const placeOf = (value) => bottom - share(column, value) * (bottom - top);
    drag(strip, lines, (from, to) => {
      const values = [valueAt(from.y), valueAt(to.y)].sort((a, b) => a - b);
      ranges[column] = Math.abs(from.y - to.y) < LEAST ? null : values;
      update();
    });
    ends.forEach((grip, end) => {
      drag(grip, lines, (from, to) => move(column, end, valueAt(to.y)));
      grip.addEventListener("keydown", (event) => {
        const [low, high] = data.columns[column].ends, step = (high - low) / STEPS;
        const moves = { ArrowUp: step, ArrowRight: step, ArrowDown: -step, ArrowLeft: -step, PageUp: 10 * step, PageDown: -10 * step, Home: low - high, End: high - low };
        if (event.key === "Escape") ranges[column] = null;
        else if (event.key in moves) move(column, end, (ranges[column] || [low, high])[end] + moves[event.key]);
        else return;
        event.preventDefault();
        update();
      });
    });
    return { column, band, ends, placeOf };
  }

  function move(column, end, value) {
    const [low, high] = data.columns[column].ends;
    const range = [...(ranges[column] || [low, high])];
    range[end] = end ? Math.max(Math.min(value, high), range[0]) : Math.min(Math.max(value, low), range[1]);
    ranges[column] = range[0] <= low && range[1] >= high ? null : range;
    update();
  }

  // ---- selection --------------------------------------------------------------------------------------------------

  // A range that reaches an end of its axis takes in what lies beyond it, which is drawn there.
  function within(column, value) {
    const range = ranges[column];
    if (!range) return true;
    if (value === null) return false;
    const [low, high] = data.columns[column].ends;
    return (value >= range[0] || range[0] <= low) && (value <= range[1] || range[1] >= high);
  }

  function update() {
    const brushed = ranges.some(Boolean);
    const selected = [];
    for (let row = 0; row < count; row++) {
      const inside = data.columns.every((_, column) => within(column, data.values[column][row]));
      if (inside) selected.push(row);
      for (const found of shapes) if (found[row]) found[row].classList.toggle("off", !inside);
    }
    for (const { column, band, ends, placeOf } of grips) {
      const { ends: whole, unit } = data.columns[column];
      const range = ranges[column] || whole;
      const [bottom, top] = range.map(placeOf);
      fluxbore.fill(band, { y: top, height: ranges[column] ? bottom - top : 0 }, []);
      ends.forEach((grip, end) => fluxbore.fill(grip, { y: end ? top - 6 : bottom, "aria-valuemin": whole[0], "aria-valuemax": whole[1],
        "aria-valuenow": range[end], "aria-valuetext": ranges[column] ? `${text(column, range[end])} ${unit}` : "no limit" }, []));
    }
    const frame = ranges[pair.x] || ranges[pair.y] ? [box("x"), box("y")] : null;
    fluxbore.fill(rectangle, frame ? { x: frame[0][0], width: frame[0][1], y: frame[1][0], height: frame[1][1] } : { width: 0, height: 0 }, []);
    reset.disabled = !brushed;
    told.textContent = brushed ? `${selected.length} of ${count} designs selected.` : `All ${count} designs.`;
    list(brushed ? selected : Object.keys(data.marks).map(Number));
  }

  function list(rows) {
    const head = ["No.", ...data.columns.map((column) => (column.unit ? `${column.label} (${column.unit})` : column.label)), "Limits", "From"];
    const words = rows.length > MOST_ROWS ? `The first ${MOST_ROWS} of the selected designs` : "The selected designs";
    const table = fluxbore.element("table", {}, fluxbore.element("caption", {}, ranges.some(Boolean) ? words : "Designs with a name"));
    const line = fluxbore.element("tr", {}, ...head.map((title) => fluxbore.element("th", { scope: "col" }, title)));
    table.append(fluxbore.element("thead", {}, line));
    const body = fluxbore.element("tbody");
    for (const row of rows.slice(0, MOST_ROWS)) {
      const mark = data.marks[row];
      const first = fluxbore.element("th", { scope: "row" }, `${row + 1}${mark ? ` ${mark}` : ""}`);
      const cells = data.columns.map((_, column) => fluxbore.element("td", { class: "n" }, text(column, data.values[column][row])));
      const ends = [data.broken[row] ? "✗ breaks one" : "✓ met", data.origins[data.origin[row]]];
      const item = fluxbore.element("tr", {}, first, ...cells, ...ends.map((word) => fluxbore.element("td", {}, word)));
      const light = (on) => shapes.forEach((found) => found[row].classList.toggle("lit", on));
      item.addEventListener("pointerenter", () => light(true));
      item.addEventListener("pointerleave", () => light(false));
      body.append(item);
    }
    table.append(body);
    for (const found of shapes) for (const shape of found) if (shape) shape.classList.remove("lit");
    region.replaceChildren(...(rows.length ? [table] : []));
  }

  // ---- the scatter ------------------------------------------------------------------------------------------------

  function chooser(title, way) {
    const select = fluxbore.element("select");
    data.columns.forEach((column, i) => select.append(fluxbore.element("option", { value: i }, column.label)));
    select.value = pair[way];
    select.addEventListener("change", () => { pair[way] = Number(select.value); redraw(); update(); });
    return fluxbore.element("label", {}, `${title} `, select);
  }

  function redraw() {
    const { x: left, y: top, width, height } = area;
    shapes[1].forEach((shape, row) => {
      const x = data.values[pair.x][row], y = data.values[pair.y][row];
      const known = x !== null && y !== null;
      shape.toggleAttribute("display", false);
      if (!known) shape.setAttribute("display", "none");
      else shape.setAttribute("transform", `translate(${left + share(pair.x, x) * width} ${top + (1 - share(pair.y, y)) * height})`);
    });
    const ticks = cloud.querySelector(".ticks");
    const old = ticks.querySelectorAll("text");
    const titles = [old[old.length - 2], old[old.length - 1]];
    ticks.replaceChildren();
    const add = (name, attributes, ...words) => ticks.append(fluxbore.drawn(cloud, name, attributes, ...words));
    for (const value of round(pair.x)) {
      const x = left + share(pair.x, value) * width;
      add("path", { class: "grid", d: `M${x} ${top}v${height}` });
      add("text", { x, y: top + height + 18, "text-anchor": "middle" }, fluxbore.number(value));
    }
    for (const value of round(pair.y)) {
      const y = top + (1 - share(pair.y, value)) * height;
      add("path", { class: "grid", d: `M${left} ${y}h${width}` });
      add("text", { x: left - 8, y: y + 4, "text-anchor": "end" }, fluxbore.number(value));
    }
    [pair.x, pair.y].forEach((column, i) => {
      const { label, unit } = data.columns[column];
      titles[i].textContent = unit ? `${label} (${unit})` : label;
    });
    ticks.append(...titles);
    const [across, up] = [pair.x, pair.y].map((column) => data.columns[column].label);
    cloud.setAttribute("aria-label", `${up} over ${across} of ${count} designs.`);
    cloud.closest("figure").querySelector("figcaption").textContent = `${up} over ${across[0].toLowerCase()}${across.slice(1)}, every design a mark.`;
  }

  function round(column) {
    const [low, high] = data.columns[column].ends;
    const rough = (high - low) / 6, power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 2.5, 5, 10].map((factor) => factor * power).find((size) => size >= rough * (1 - 1e-9));
    const found = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i++) found.push(i * step);
    return found;
  }

  function span(way, one, other) {
    const [start, length] = way === "x" ? [area.x, area.width] : [area.y + area.height, -area.height];
    return [one, other].map((place) => at(pair[way], (place - start) / length)).sort((a, b) => a - b);
  }

  function box(way) {
    const [low, high] = (ranges[pair[way]] || data.columns[pair[way]].ends).map((value) => share(pair[way], value));
    return way === "x" ? [area.x + low * area.width, (high - low) * area.width] : [area.y + (1 - high) * area.height, (high - low) * area.height];
  }

  // ---- numbers, places, gestures ----------------------------------------------------------------------------------

  function share(column, value) {
    const [low, high] = data.columns[column].ends;
    return Math.min(Math.max((value - low) / (high - low), 0), 1);
  }

  function at(column, part) {
    const [low, high] = data.columns[column].ends;
    return low + Math.min(Math.max(part, 0), 1) * (high - low);
  }

  function text(column, value) {
    return value === null ? "–" : value.toFixed(data.columns[column].decimals).replace("-", "−");
  }

  function button(title, act) {
    const made = fluxbore.element("button", { type: "button" }, title);
    made.addEventListener("click", act);
    return made;
  }

  // Browsers do not heed touch-action inside a drawing: a finger on an axis is ours, one on the scatter if it goes across.
  function claim(target) {
    let start = null, ours = false;
    target.addEventListener("touchstart", (event) => {
      start = event.touches[0];
      ours = target !== plane;
    }, { passive: true });
    target.addEventListener("touchmove", (event) => {
      const now = event.touches[0];
      ours ||= Math.abs(now.clientX - start.clientX) > Math.abs(now.clientY - start.clientY);
      if (ours && event.cancelable) event.preventDefault();
    }, { passive: false });
  }

  function drag(target, svg, act) {
    claim(target);
    let from = null, latest = null, before = [];
    const place = (event) => {
      const view = svg.viewBox.baseVal, seen = svg.getBoundingClientRect();
      return { x: ((event.clientX - seen.left) * view.width) / seen.width, y: ((event.clientY - seen.top) * view.height) / seen.height };
    };
    target.addEventListener("pointerdown", (event) => {
      if (event.button) return;
      from = place(event);
      before = [...ranges];
      target.setPointerCapture(event.pointerId);
    });
    // Once a frame: with a thousand lines a frame takes longer than the next movement.
    target.addEventListener("pointermove", (event) => {
      if (!from) return;
      if (!latest) requestAnimationFrame(() => { if (from) act(from, latest); latest = null; });
      latest = place(event);
    });
    const end = (event) => {
      const begun = from;
      from = null;
      if (begun && event.type === "pointerup") return act(begun, place(event));
      if (!begun) return;
      // It was the browser's gesture after all.
      ranges.splice(0, ranges.length, ...before);
      update();
    };
    for (const name of ["pointerup", "pointercancel"]) target.addEventListener(name, end);
  }
})();
