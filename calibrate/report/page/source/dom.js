// Elements of the page. Texts become text nodes, never markup.

/// element("p", {class: "note"}, "text", child, ...): null children are left out; "on..." are listeners.
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else made.setAttribute(name, value === true ? "" : value);
  }
  made.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return made;
}

const svgNames = "http://www.w3.org/2000/svg";

export function svgElement(tag, attributes = {}, ...children) {
  const made = document.createElementNS(svgNames, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

/// A part of the page with a heading and, below it, a sentence that says what is to be seen.
export function section(id, heading, lead, ...children) {
  return element(
    "section",
    { id, "aria-labelledby": `${id}-heading` },
    element("h2", { id: `${id}-heading` }, heading),
    lead ? element("p", { class: "lead" }, lead) : null,
    ...children,
  );
}

/// A labelled choice; options are [value, text]; `changed` is called with the value.
export function choice(label, options, value, changed) {
  const select = element(
    "select",
    { onchange: (event) => changed(event.target.value) },
    ...options.map(([key, text]) => element("option", { value: key, selected: key === value }, text)),
  );
  return element("label", { class: "choice" }, element("span", {}, label), select);
}

export function toggle(label, checked, changed) {
  const box = element("input", { type: "checkbox", checked, onchange: (event) => changed(event.target.checked) });
  return element("label", { class: "toggle" }, box, element("span", {}, label));
}

const narrowest = 120; // pixels; paper is laid out at less for a moment, which leaves no room between the margins

/// Draws into a figure at its width, and again when that changes or paper asks for another.
export function figure(attributes, draw, ...after) {
  const place = element("div", { class: "drawing" });
  const made = element("figure", attributes, place, ...after);
  let width = 0;
  const redraw = () => {
    if (width > 0) place.replaceChildren(draw(width));
  };
  new ResizeObserver(([entry]) => {
    const now = Math.round(entry.contentRect.width);
    if (now === width || now < narrowest) return;
    width = now;
    redraw();
  }).observe(place);
  made.redraw = redraw;
  return made;
}
