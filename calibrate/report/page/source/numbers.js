// Numbers as people read them.

const minus = "\u2212";

/// So many significant digits, plain where that is short.
export function number(value, digits = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "\u2013";
  const size = Math.abs(value);
  const text =
    size !== 0 && (size >= 1e6 || size < 1e-3)
      ? value
          .toExponential(digits - 1)
          .replace(/\.?0+e/, "e")
          .replace("e+", "e")
      : String(Number(value.toPrecision(digits)));
  return text.replace(/-/g, minus);
}

/// To the decimal to which its deviation has two digits; further digits are noise.
export function atNoise(value, deviation, digits = 4) {
  if (!(deviation > 0) || !Number.isFinite(value)) return number(value, digits);
  const decimals = 1 - Math.floor(Math.log10(deviation));
  return decimals < 0 || decimals > 6 ? number(value, digits) : value.toFixed(decimals).replace(/-/g, minus);
}

export function plusMinus(value, deviation, digits = 4) {
  return deviation > 0
    ? `${atNoise(value, deviation, digits)} \u00b1 ${atNoise(deviation, deviation, 2)}`
    : number(value, digits);
}

/// A difference, with its sign.
export function plusMinusSigned(value, deviation) {
  return `${value > 0 ? "+" : ""}${plusMinus(value, deviation, 3)}`;
}

/// What stands behind a simulated value without an error, so that nobody takes it for exact.
export function errorWords({ standard_error: error }) {
  return error === undefined ? " (one packing, error unknown)" : "";
}

const unitsOfNames = [
  ["_mm", "mm"],
  ["_pa", "Pa"],
  ["_kg", "kg"],
  ["_g", "g"],
  ["_rad_s", "rad/s"],
  ["_s", "s"],
  ["_n", "N"],
];

/// The unit that stands at the end of a name: "step1.height_mm" -> "mm".
export function unitOf(name) {
  return unitsOfNames.find(([end]) => name.endsWith(end))?.[1] ?? "";
}

/// The name of a reading among those of all tests, as in a study: "plate/step1.height_mm".
export function fullName(test, reading) {
  return test ? `${test}/${reading}` : reading;
}

/// The name without its unit, for people: "plate/step1.height_mm" -> "plate: step 1, height".
export function words(name) {
  const unit = unitsOfNames.find(([end]) => name.endsWith(end))?.[0] ?? "";
  return name
    .slice(0, name.length - unit.length)
    .replace("/", ": ")
    .replace(/\bstep(\d)\./, "step $1, ")
    .replace(/\./g, ", ")
    .replace(/_/g, " ");
}

export function duration(seconds) {
  if (seconds < 90) return `${number(seconds, 2)} s`;
  if (seconds < 5400) return `${Math.round(seconds / 60)} min`;
  return `${number(seconds / 3600, 2)} h`;
}
