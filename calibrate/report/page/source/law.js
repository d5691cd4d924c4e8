// The contact law: force between two grains against their overlap.
import { element, figure, section } from "./dom.js";
import { number } from "./numbers.js";
import { colour, legend, plot, Plot } from "./plots.js";

const dashWords = { linear: "dots", exponential: "dashes", capillary: "dash and dot", polynomial: "long dashes" };
const dashes = { linear: "2 3", exponential: "8 3", capillary: "8 3 2 3", polynomial: "12 4" };
const looks = {
  fitted: { stroke: colour.simulation, strokeWidth: 3 },
  equivalent: { stroke: colour.equivalent, strokeWidth: 1.2, strokeOpacity: 0.8 },
  other: { stroke: colour.apparatus, strokeWidth: 1.4 },
};

/// Overlaps in millimetres where bridges reach so far, else in micrometres.
function scaled(law) {
  const far = Math.max(...law.flatMap(({ points }) => points.map(([x]) => Math.abs(x))));
  const [unit, share] = far > 500 ? ["mm", 1e-3] : ["\u00b5m", 1];
  return { unit, law: law.map((one) => ({ ...one, points: one.points.map(([x, y]) => [share * x, y]) })) };
}

function drawn(inMicrometres, width) {
  const { unit, law } = scaled(inMicrometres);
  // In a narrow picture there is no room for them; the legend has them, too.
  const others = width < 480 ? [] : law.filter(({ role }) => role === "other");
  // Each name stands at its own place along the gap, so that names do not cover each other.
  const ends = others.map(({ name, points }, k) => ({
    name,
    point: points[Math.round((points.length / 2) * ((k + 1) / (others.length + 1)))],
  }));
  return plot(width, {
    x: { label: `overlap of two grains [${unit}]; negative: a gap` },
    y: { label: "force [mN]; negative: attraction" },
    marks: [
      Plot.ruleX([0], { stroke: colour.quiet }),
      Plot.ruleY([0], { stroke: colour.quiet }),
      ...law.map(({ name, role, points }) =>
        Plot.line(points, { ...looks[role], strokeDasharray: role === "other" ? dashes[name] : null }),
      ),
      Plot.tip(
        law.flatMap(({ name, points }) => points.map(([x, y]) => ({ x, y, name }))),
        Plot.pointer({
          x: "x",
          y: "y",
          title: ({ name, x, y }) => `${name}\n${number(x)} ${unit}: ${number(y)} mN`,
          fill: "var(--card)",
        }),
      ),
      Plot.text(ends, {
        x: ({ point }) => point[0],
        y: ({ point }) => point[1],
        text: "name",
        dy: -8,
        fill: colour.apparatus,
        stroke: "var(--page)",
        strokeWidth: 4,
      }),
    ],
  });
}

export function lawPart({ law, radius_mm: radius }) {
  const has = (role) => law.some((one) => one.role === role);
  const entries = [["fitted", "line simulation thick"]];
  if (has("equivalent")) entries.push(["equivalent materials: the readings do not tell them apart", "line equivalent"]);
  if (has("other"))
    entries.push([
      `other attractions with the same peak and reach: ${law
        .filter(({ role }) => role === "other")
        .map(({ name }) => `${name} (${dashWords[name]})`)
        .join(", ")}`,
      "line apparatus",
    ]);
  return section(
    "law",
    "The contact law",
    `Two grains of ${number(radius, 3)} mm radius: ${law.some(({ points }) => points.some(([, force]) => force < 0)) ? "what pulls them together, and pushes them apart where they overlap" : "what pushes them apart where they overlap"}.`,
    figure({}, (width) => drawn(law, width), element("figcaption", {}, legend(entries))),
  );
}
