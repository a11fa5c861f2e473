// The page's live view. It takes the picture's place on the screen where there is WebGL; elsewhere, and in print, the
// picture stays.

import { parse, unpack } from "./glb.js";
import { Orbit } from "./orbit.js";
import { View } from "./scene.js";

const { element } = fluxbore;
const VIEWS = { Oblique: [0.4, 1.14], Side: [0, Math.PI / 2], End: [Math.PI / 2 - 0.001, Math.PI / 2] };

async function start(place) {
  const data = fluxbore.data("viewer-data");
  if (!place || !data) return;
  try {
    const model = parse(await unpack(data.model));
    run(place, model, data);
  } catch (reason) {
    // Without WebGL or DecompressionStream; no error of the page's.
    place.append(element("p", { class: "note" }, "No live view: this browser offers no WebGL. The picture stands for it."));
    console.info(`No live view: ${reason.message}`);
    place.dataset.live = "no";
  }
}

function run(place, model, data) {
  const canvas = element("canvas", {
    tabindex: "0",
    role: "img",
    "aria-label": `${data.title}, a view that turns. Arrow keys turn it, plus and minus zoom. The parts are listed below it.`,
  });
  const told = element("p", { class: "told", role: "status", "aria-live": "polite" }, "Drag to turn; click a part to see its row.");
  const controls = element("div", { class: "choices" });
  const list = element("table", {});
  const parts = element("details", {}, element("summary", {}, "Show, hide or find parts"), element("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": "Parts of the live view" }, list));
  const stage = element("div", { class: "stage" }, canvas, controls, told, parts);
  const view = new View(canvas, model); // raises where there is no WebGL; then nothing of the page has changed
  place.prepend(stage);
  place.dataset.live = "yes";

  const orbit = new Orbit(view.camera, canvas, {
    pick: (x, y) => choose(view.pick(x, y)),
    changed: () => view.draw(),
  });
  const items = [...new Map(model.pieces.map((piece) => [piece.item, piece])).keys()].sort((a, b) => a - b);
  const rows = new Map(items.map((item) => [item, row(item)]));
  list.append(element("tbody", {}, ...[...rows.values()].map((found) => found.line)));

  function row(item) {
    const own = model.pieces.filter((piece) => piece.item === item);
    const box = element("input", { type: "checkbox", "aria-label": `Show ${own[0].label}` });
    box.checked = true;
    box.addEventListener("change", () => view.show(item, box.checked));
    const name = element("button", { type: "button", "aria-pressed": "false" }, own[0].label);
    name.addEventListener("click", () => chooseItem(item));
    const line = element("tr", { "data-part": item }, element("td", {}, box), element("th", { scope: "row" }, name), element("td", { class: "n" }, `${own.length}×`), element("td", {}, own[0].material));
    return { line, name, own };
  }

  function mark(item) {
    for (const [number, { line, name }] of rows) {
      line.classList.toggle("picked", number === item);
      name.setAttribute("aria-pressed", String(number === item));
    }
    for (const line of document.querySelectorAll("#parts tr[data-part]")) {
      line.classList.toggle("picked", Number(line.dataset.part) === item);
      if (Number(line.dataset.part) === item) line.setAttribute("aria-current", "true");
      else line.removeAttribute("aria-current");
    }
  }

  function choose(piece) {
    view.highlight(piece ? [piece] : []);
    mark(piece?.item);
    if (!piece) {
      told.replaceChildren("No part is picked.");
      return;
    }
    tell(piece, piece.name);
    const { line } = rows.get(piece.item);
    const box = line.closest(".scroll");
    parts.open = true;
    box.scrollTop = line.offsetTop - box.clientHeight / 2;
  }

  function chooseItem(item) {
    const { own } = rows.get(item);
    view.highlight(own);
    mark(item);
    tell(own[0], own.length === 1 ? own[0].name : `${own[0].label}, ${own.length} pieces`);
  }

  function tell(piece, name) {
    const weight = piece.mass >= 1 ? `${fluxbore.number(piece.mass)} kg` : `${fluxbore.number(piece.mass * 1e3)} g`;
    const known = [piece.material, piece.mass ? `${weight} each` : ""].filter(Boolean).join(", ");
    const link = element("a", { href: `#part-${piece.item}` }, "its row in the parts list");
    told.replaceChildren(element("b", {}, `${piece.item} · ${name}`), known ? ` – ${known}; ` : " – ", link);
  }

  for (const line of document.querySelectorAll("#parts tr[data-part]")) {
    line.addEventListener("click", () => {
      if (rows.has(Number(line.dataset.part))) chooseItem(Number(line.dataset.part));
    });
  }

  // The section.
  const groups = [...new Set(model.pieces.map((piece) => piece.group))];
  const direction = select("Section", { along: "along the axis", across: "across the axis", none: "none" });
  const share = element("input", { type: "range", min: "0", max: "1", step: "0.01", "aria-label": "Place of the section" });
  share.value = "0.5";
  const only = select("Cut", { [data.outside]: `the ${data.outside}`, "": "all parts" });
  only.parentElement.hidden = !data.outside || groups.length < 2;
  const cut = () => {
    share.disabled = direction.value === "none";
    view.cut({ direction: direction.value, share: Number(share.value), only: only.parentElement.hidden ? "" : only.value });
  };
  for (const control of [direction, only]) control.addEventListener("change", cut);
  share.addEventListener("input", cut);
  const buttons = Object.entries(VIEWS).map(([name, [theta, phi]]) => {
    const button = element("button", { type: "button" }, name);
    button.addEventListener("click", () => orbit.look(theta, phi, view.corners()));
    return button;
  });
  const looks = element("span", { role: "group", "aria-label": "View from" }, ...buttons);
  controls.append(looks, direction.parentElement, share, only.parentElement);

  let untouched = true;
  for (const name of ["pointerdown", "keydown", "wheel"]) canvas.addEventListener(name, () => (untouched = false));
  new ResizeObserver(() => {
    view.resize();
    if (untouched) orbit.fit();
  }).observe(canvas);
  orbit.look(...VIEWS.Oblique, view.corners());
  view.resize();
  cut();
  place.classList.add("live");
}

function select(label, options) {
  const found = element("select", {}, ...Object.entries(options).map(([value, text]) => element("option", { value }, text)));
  element("label", {}, `${label} `, found);
  return found;
}

start(document.getElementById("viewer"));
