// What all plots of the page have in common.
import * as Plot from "@observablehq/plot";

export { Plot };

/// Colours by meaning, from the style sheet, so that a change of theme needs no redrawing. Of the palette of Okabe and
/// Ito, which people with every kind of colour vision tell apart; shapes differ as well.
export const colour = {
  laboratory: "var(--laboratory)",
  simulation: "var(--simulation)",
  apparatus: "var(--apparatus)",
  failure: "var(--failure)",
  equivalent: "var(--equivalent)",
  quiet: "var(--quiet)",
  band: "var(--band)",
};

export function plot(width, options) {
  return Plot.plot({
    width,
    height: Math.round(Math.min(420, Math.max(260, 0.55 * width))),
    marginLeft: 56,
    marginRight: 24,
    marginBottom: 42,
    marginTop: 24,
    style: { fontSize: "13px", background: "none" },
    ...options,
    x: { nice: true, ticks: Math.max(3, width / 110), labelAnchor: "center", labelArrow: "none", ...options.x },
    y: { nice: true, grid: true, labelArrow: "none", ...options.y },
  });
}

/// Entries of a legend: [name, class of its sign].
export function legend(entries) {
  const list = document.createElement("ul");
  list.className = "legend";
  for (const [name, sign] of entries) {
    const item = document.createElement("li");
    const mark = document.createElement("span");
    mark.className = `sign ${sign}`;
    item.append(mark, name);
    list.append(item);
  }
  return list;
}
