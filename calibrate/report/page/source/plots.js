// What all plots of the page have in common.
import * as Plot from "@observablehq/plot";
import { element } from "./dom.js";

export { Plot };

/**
 * Colours by meaning, from the style sheet, so that a change of theme needs no redrawing. Of the palette of Okabe and
 * Ito, which people with every kind of colour vision tell apart; shapes differ as well.
 */
export const colour = {
  laboratory: "var(--laboratory)",
  simulation: "var(--simulation)",
  apparatus: "var(--apparatus)",
  failure: "var(--failure)",
  equivalent: "var(--equivalent)",
  quiet: "var(--quiet)",
  band: "var(--band)",
};

export const lettering = { fontSize: "13px", background: "none" };

/**
 * @param {number} width
 * @param {Plot.PlotOptions} options
 */
export function plot(width, options) {
  return Plot.plot({
    width,
    height: Math.round(Math.min(420, Math.max(260, 0.55 * width))),
    marginLeft: 56,
    marginRight: 24,
    marginBottom: 42,
    marginTop: 24,
    style: lettering,
    ...options,
    x: { nice: true, ticks: Math.max(3, width / 110), labelAnchor: "center", labelArrow: "none", ...options.x },
    y: { nice: true, grid: true, labelArrow: "none", ...options.y },
  });
}

/**
 * Says what a mark of a plot is when it is pointed at.
 * @param {any[]} data
 * @param {{x: Plot.ChannelValue, y: Plot.ChannelValue, title: Plot.ChannelValue}} channels
 */
export function tip(data, channels) {
  return Plot.tip(data, Plot.pointer({ ...channels, fill: "var(--card)" }));
}

/** @param {[name: string, sign: string][]} entries of a legend; signs are classes */
export function legend(entries) {
  const items = entries.map(([name, sign]) => element("li", {}, element("span", { class: `sign ${sign}` }), name));
  return element("ul", { class: "legend" }, ...items);
}
