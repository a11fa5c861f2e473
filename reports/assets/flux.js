// Reads the flux density off a map of the field: at the pointer, the finger, or a probe moved with the arrow keys.
"use strict";

(() => {
  if (typeof DecompressionStream === "undefined") return;
  for (const source of document.querySelectorAll('script[id$="-readout"]')) {
    const svg = source.closest("figure").querySelector("svg");
    const maps = JSON.parse(source.textContent).filter((plot) => plot.field);
    if (svg && maps.length) enhance(svg, maps);
  }

  function enhance(svg, maps) {
    const view = svg.viewBox.baseVal;
    const frame = fluxbore.element("div", { class: "reading" });
    const tip = fluxbore.element("div", { class: "tip", hidden: "", "aria-hidden": "true" });
    const told = fluxbore.element("span", { class: "quiet", role: "status", "aria-live": "polite" });
    svg.before(frame);
    frame.append(svg, tip, told);
    const marks = fluxbore.drawn(svg, "g", { "aria-hidden": "true" });
    svg.append(marks);
    fluxbore.fill(svg, { role: "application", tabindex: "0", "aria-roledescription": "map of the field",
      "aria-label": `${svg.getAttribute("aria-label")} Arrow keys move a probe.` }, []);
    const caption = svg.closest("figure").querySelector("figcaption");
    const hint = " Point at it, or move a probe with the arrow keys, to read the flux density.";
    caption.append(fluxbore.element("span", { class: "aside" }, hint));
    let probe = null;

    async function show(map, z, r, aloud = false) {
      probe = { map, z, r };
      const values = await (map.values ||= unpack(map.field));
      if (probe === null || probe.z !== z || probe.r !== r) return;
      const x = map.box[0] + share(map.x.ends, z) * (map.box[2] - map.box[0]);
      const y = map.box[3] - share(map.y.ends, r) * (map.box[3] - map.box[1]);
      const lines = texts(map, values, z, r);
      marks.replaceChildren(...[0, 1].map(() => fluxbore.drawn(svg, "path", { class: "cross", d: `M${x - 8} ${y}h16M${x} ${y - 8}v16` })));
      tip.replaceChildren(...lines.map((line) => fluxbore.element("div", {}, ...subscripts(line))));
      tip.hidden = false;
      const low = y > (map.box[1] + map.box[3]) / 2;
      fluxbore.beside(tip, x / view.width, (y + (low ? -8 : 12)) / view.height, low, 12);
      if (aloud) told.textContent = lines.join("; ");
    }

    function hide() {
      probe = null;
      tip.hidden = true;
      marks.replaceChildren();
    }

    function point(event) {
      const area = svg.getBoundingClientRect();
      const x = ((event.clientX - area.left) * view.width) / area.width;
      const y = ((event.clientY - area.top) * view.height) / area.height;
      const map = maps.find(({ box }) => x >= box[0] && x <= box[2] && y >= box[1] && y <= box[3]);
      if (!map) return hide();
      show(map, along(map.x.ends, (x - map.box[0]) / (map.box[2] - map.box[0])), along(map.y.ends, (map.box[3] - y) / (map.box[3] - map.box[1])));
    }

    svg.addEventListener("pointermove", point);
    svg.addEventListener("pointerdown", point);
    svg.addEventListener("pointerleave", (event) => { if (event.pointerType === "mouse") hide(); });
    svg.addEventListener("blur", hide);
    svg.addEventListener("keydown", (event) => {
      const steps = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
      if (event.key === "Escape") return hide();
      if (!(event.key in steps)) return;
      event.preventDefault();
      const map = probe ? probe.map : maps[0];
      const from = probe || { z: along(map.x.ends, 0.5), r: along(map.y.ends, 0.5) };
      const length = (map.field.z.step + map.field.r.step) * (event.shiftKey ? 5 : 1);
      const [z, r] = probe ? [from.z + steps[event.key][0] * length, from.r + steps[event.key][1] * length] : [from.z, from.r];
      // From one of two maps the probe walks into the other.
      const place = maps.indexOf(map), next = maps[place + Math.sign(share(map.x.ends, z) - 0.5)];
      const out = share(map.x.ends, z) < 0 || share(map.x.ends, z) > 1;
      if (out && next) return show(next, share(map.x.ends, z) < 0 ? next.x.ends[1] : next.x.ends[0], r, true);
      show(map, clamp(z, map.x.ends), clamp(r, map.y.ends), true);
    });
  }

  function texts(map, values, z, r) {
    const radius = Math.abs(r);
    const part = map.parts.find(([, outline]) => inside(outline, z, radius));
    const sample = nearest(map, values, z, radius, part);
    const place = `z = ${fluxbore.number(z)} mm, r = ${fluxbore.number(radius)} mm`;
    const name = part ? part[0] : "air, or a part without magnetism";
    if (sample === null) return [name, place];
    const [radial, axial, size] = sample.map((value) => value.toFixed(3).replace("-", "−"));
    return [name, `|B| = ${size} T`, `B_r = ${radial} T, B_z = ${axial} T`, place];
  }

  function subscripts(line) {
    return line.split(/_(\w)/).map((text, i) => (i % 2 ? fluxbore.element("sub", {}, text) : text));
  }

  // The nearest point of the grid in the same part, since B jumps at a part's face.
  function nearest(map, values, z, r, part) {
    const { z: across, r: up, unit } = map.field;
    const column = Math.round((z - across.start) / across.step), row = Math.round((r - up.start) / up.step);
    let best = null, least = Infinity;
    for (let j = Math.max(row - 1, 0); j <= Math.min(row + 1, up.count - 1); j++) {
      for (let i = Math.max(column - 1, 0); i <= Math.min(column + 1, across.count - 1); i++) {
        const at = [across.start + i * across.step, up.start + j * up.step];
        const other = part ? !inside(part[1], ...at) : map.parts.some(([, outline]) => inside(outline, ...at));
        const distance = Math.hypot(at[0] - z, at[1] - r) + (other ? 10 * across.step : 0);
        if (distance < least) [best, least] = [j * across.count + i, distance];
      }
    }
    const all = across.count * up.count;
    return best === null ? null : [0, 1, 2].map((channel) => values[channel * all + best] * unit);
  }

  function inside(outline, x, y) {
    let within = false;
    outline.forEach(([x1, y1], i) => {
      const [x2, y2] = outline[(i + 1) % outline.length];
      if (y1 > y !== y2 > y && x < x1 + ((y - y1) * (x2 - x1)) / (y2 - y1)) within = !within;
    });
    return within;
  }

  // Differences of 16 bits, low bytes before high bytes, deflated, in base 64.
  async function unpack(field) {
    const packed = Uint8Array.from(atob(field.samples), (letter) => letter.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    const count = bytes.length / 2, values = new Int16Array(count);
    for (let i = 0, sum = 0; i < count; i++) values[i] = sum += bytes[i] | (bytes[count + i] << 8);
    return values;
  }

  function share([start, end], value) {
    return (value - start) / (end - start);
  }

  function along([start, end], part) {
    return start + part * (end - start);
  }

  function clamp(value, [low, high]) {
    return Math.min(Math.max(value, low), high);
  }
})();
