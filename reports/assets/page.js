// What every section may use. Without scripts the page is complete: nothing here is needed to read it.
"use strict";

const fluxbore = {
  // Data of the page by its element's identifier, or null where the report has none.
  data(identifier) {
    const element = document.getElementById(identifier);
    return element ? JSON.parse(element.textContent) : null;
  },

  // A number with so many significant digits and a true minus sign.
  number(value, digits = 4) {
    if (!Number.isFinite(value)) return "–";
    const rounded = Number(value.toPrecision(digits));
    const size = Math.abs(rounded);
    const text = size !== 0 && (size < 1e-3 || size >= 1e6) ? rounded.toExponential(digits - 1) : String(rounded);
    return text.replace("-", "−");
  },

  // A box of words beside a place of a figure (shares of its width and height), on the side where there is more room.
  beside(tip, across, down, low, gap = 10) {
    const before = across > 0.5;
    tip.style.left = `${100 * across}%`;
    tip.style.top = `${100 * down}%`;
    tip.style.maxWidth = `calc(${100 * (before ? across : 1 - across)}% - ${gap}px)`;
    tip.style.transform = `translate(${before ? `calc(-100% - ${gap}px)` : `${gap}px`}, ${low ? "calc(-100% - 4px)" : "0"})`;
  },

  // An element with attributes and children; in a drawing, of the drawing's own namespace.
  element(name, attributes = {}, ...children) {
    return fluxbore.fill(document.createElement(name), attributes, children);
  },

  drawn(parent, name, attributes = {}, ...children) {
    return fluxbore.fill(document.createElementNS(parent.namespaceURI, name), attributes, children);
  },

  fill(element, attributes, children) {
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    element.append(...children);
    return element;
  },
};
