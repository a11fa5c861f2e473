// What `checks.py` asks of a page. Lengths are CSS pixels; what is listed is told by name.
window.pageChecks = (() => {
  const CONTROLS = "a[href], button, input, select, textarea, summary, [tabindex='0']";

  const name = (e) => {
    const words = (e.getAttribute("aria-label") || e.textContent || "").trim().replace(/\s+/g, " ").slice(0, 40);
    return `${e.tagName.toLowerCase()}${e.id ? `#${e.id}` : ""}${[...e.classList].map((c) => `.${c}`).join("")} “${words}”`;
  };
  const seen = (e) => e.checkVisibility({ visibilityProperty: true }) && e.getClientRects().length > 0;
  const width = () => document.documentElement.clientWidth;

  function scrolls(e) {
    for (let p = e.parentElement; p && p !== document.body; p = p.parentElement)
      if (getComputedStyle(p).overflowX !== "visible") return true;
    return false;
  }

  return {
    // What reaches beyond the window's edges and is not inside something that scrolls by itself.
    beyond(slack) {
      const whole = document.documentElement.scrollWidth;
      const out = whole > width() + slack ? [`the page: ${whole} of ${width()}`] : [];
      for (const e of document.body.querySelectorAll("*")) {
        const box = e.getBoundingClientRect();
        if (box.width < 2 || !seen(e) || e.closest(".quiet, .skip")) continue;
        if ((box.right > width() + slack || box.left < -slack) && !scrolls(e)) out.push(`${name(e)}: ${box.left} to ${box.right}`);
      }
      return out;
    },

    // What scrolls sideways, and so would be cut on paper.
    cut(slack) {
      const wide = (e) => e.scrollWidth > e.clientWidth + slack || e.getBoundingClientRect().right > width() + slack;
      return [...document.querySelectorAll(".scroll, figure, table, pre")].filter((e) => seen(e) && wide(e))
        .map((e) => `${name(e)}: ${e.scrollWidth} of ${e.clientWidth}`);
    },

    // Number the controls, and give up the focus; how many there are.
    number() {
      document.activeElement.blur();
      return [...document.querySelectorAll(CONTROLS)].map((e, i) => { e.checked_number = i; }).length;
    },

    // What has the focus: its number and name, whether that can be seen, whether it is in the window.
    focused() {
      const e = document.activeElement;
      if (!e || e === document.body) return null;
      const style = getComputedStyle(e), box = e.getBoundingClientRect();
      const ring = (style.outlineStyle !== "none" && parseFloat(style.outlineWidth) > 0) || style.boxShadow !== "none";
      const inside = box.right > 0 && box.bottom > 0 && box.left < innerWidth && box.top < innerHeight;
      return { number: e.checked_number ?? -1, name: name(e), ring, shown: box.width > 0 && box.height > 0 && inside };
    },

    // Visible controls that are not among these numbers. One of several radio buttons stands for its group.
    unreached(numbers) {
      const got = new Set(numbers);
      const all = [...document.querySelectorAll(CONTROLS)];
      const groups = new Set(all.filter((e) => e.type === "radio" && got.has(e.checked_number)).map((e) => e.name));
      return all.filter((e) => seen(e) && !e.disabled && e.tabIndex >= 0 && !e.closest("[inert]")
        && !got.has(e.checked_number) && !(e.type === "radio" && groups.has(e.name))).map(name);
    },

    // Animations that run, and what moves by itself when it changes or is scrolled to.
    moving() {
      const out = document.getAnimations().map((a) => `animation of ${name(a.effect.target)}`);
      for (const e of document.querySelectorAll("*")) {
        const style = getComputedStyle(e);
        if (style.transitionDuration.split(",").some((t) => parseFloat(t) > 0.01)) out.push(`transition of ${name(e)}`);
        if (style.scrollBehavior === "smooth") out.push(`smooth scrolling of ${name(e)}`);
      }
      return out;
    },

    // Every custom property of the page's root as it counts now.
    palette() {
      const own = [...document.documentElement.computedStyleMap()].filter(([key]) => key.startsWith("--"));
      return Object.fromEntries(own.map(([key, value]) => [key, String(value[0]).trim()]));
    },
  };
})();
