// The contact law: force between two grains against their overlap.
import { element, figure, section } from "./dom.js";
import { number } from "./numbers.js";
import { colour, legend, plot, Plot, tip } from "./plots.js";

/** @typedef {import("./content.js").LawCurve} LawCurve */

/** @type {Record<string, {dash: string, words: string}>} */
const dashes = {
  linear: { dash: "2 3", words: "dots" },
  exponential: { dash: "8 3", words: "dashes" },
  capillary: { dash: "8 3 2 3", words: "dash and dot" },
  polynomial: { dash: "12 4", words: "long dashes" },
};
const looks = {
  fitted: { stroke: colour.simulation, strokeWidth: 3 },
  equivalent: { stroke: colour.equivalent, strokeWidth: 1.2, strokeOpacity: 0.8 },
  other: { stroke: colour.apparatus, strokeWidth: 1.4 },
};

/**
 * Overlaps in millimetres where bridges reach so far, else in micrometres.
 * @param {LawCurve[]} curves
 * @returns {{unit: string, curves: LawCurve[]}}
 */
export function scaled(curves) {
  const far = Math.max(...curves.flatMap(({ points }) => points.map(([x]) => Math.abs(x))));
  if (far <= 500) return { unit: "\u00b5m", curves };
  return { unit: "mm", curves: curves.map((one) => ({ ...one, points: one.points.map(([x, y]) => [1e-3 * x, y]) })) };
}

/** @param {LawCurve} curve */
function lineOf({ name, role, points }) {
  return Plot.line(points, { ...looks[role], strokeDasharray: role === "other" ? dashes[name]?.dash : undefined });
}

/**
 * Their names along them. Each stands at its own place along the gap, so that names do not cover each other.
 * @param {LawCurve[]} others
 */
function namesOf(others) {
  const places = others.map(({ name, points }, k) => {
    const [x, y] = points[Math.round((points.length / 2) * ((k + 1) / (others.length + 1)))];
    return { name, x, y };
  });
  const halo = { stroke: "var(--page)", strokeWidth: 4 };
  return Plot.text(places, { x: "x", y: "y", text: "name", dy: -8, fill: colour.apparatus, ...halo });
}

/**
 * @param {LawCurve[]} law
 * @param {number} width
 */
function drawn(law, width) {
  const { unit, curves } = scaled(law);
  const points = curves.flatMap(({ name, points: some }) => some.map(([x, y]) => ({ x, y, name })));
  /** @param {typeof points[number]} point */
  const title = ({ name, x, y }) => `${name}\n${number(x)} ${unit}: ${number(y)} mN`;
  // In a narrow picture there is no room for them; the legend has them, too.
  const named = width < 480 ? [] : curves.filter(({ role }) => role === "other");
  return plot(width, {
    x: { label: `overlap of two grains [${unit}]; negative: a gap` },
    y: { label: "force [mN]; negative: attraction" },
    marks: [
      Plot.ruleX([0], { stroke: colour.quiet }),
      Plot.ruleY([0], { stroke: colour.quiet }),
      ...curves.map(lineOf),
      tip(points, { x: "x", y: "y", title }),
      namesOf(named),
    ],
  });
}

/** @param {LawCurve[]} law */
function legendOf(law) {
  /** @type {[string, string][]} */
  const entries = [["fitted", "line simulation thick"]];
  if (law.some(({ role }) => role === "equivalent"))
    entries.push(["equivalent materials: the readings do not tell them apart", "line equivalent"]);
  const others = law.filter(({ role }) => role === "other").map(({ name }) => `${name} (${dashes[name]?.words})`);
  if (others.length > 0)
    entries.push([`other attractions with the same peak and reach: ${others.join(", ")}`, "line apparatus"]);
  return legend(entries);
}

/** @param {import("./content.js").CardContent} content */
export function lawPart({ law, radius_mm: radius }) {
  const attracts = law.some(({ points }) => points.some(([, force]) => force < 0));
  const pushes = "pushes them apart where they overlap";
  return section(
    "law",
    "The contact law",
    `Two grains of ${number(radius, 3)} mm radius: ` +
      `${attracts ? `what pulls them together, and ${pushes}` : `what ${pushes}`}.`,
    figure({}, (width) => drawn(law, width), element("figcaption", {}, legendOf(law))),
  );
}
