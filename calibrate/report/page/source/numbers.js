// Numbers as people read them.

const minus = "\u2212";
const none = "\u2013";

/**
 * So many significant digits, plain where that is short.
 * @param {number | null | undefined} value
 */
export function number(value, digits = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return none;
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

/**
 * To the decimal to which its deviation has two digits; further digits are noise.
 * @param {number} value
 * @param {number | undefined} deviation
 */
export function atNoise(value, deviation, digits = 4) {
  if (!deviation || !(deviation > 0) || !Number.isFinite(value)) return number(value, digits);
  const decimals = 1 - Math.floor(Math.log10(deviation));
  return decimals < 0 || decimals > 6 ? number(value, digits) : value.toFixed(decimals).replace(/-/g, minus);
}

/**
 * @param {number} value
 * @param {number | undefined} deviation
 */
export function plusMinus(value, deviation, digits = 4) {
  if (!deviation || !(deviation > 0)) return number(value, digits);
  return `${atNoise(value, deviation, digits)} \u00b1 ${atNoise(deviation, deviation, 2)}`;
}

/**
 * A difference, with its sign.
 * @param {number} value
 * @param {number | undefined} deviation
 */
export function plusMinusSigned(value, deviation) {
  return `${value > 0 ? "+" : ""}${plusMinus(value, deviation, 3)}`;
}

/**
 * What stands behind a simulated value without an error, so that nobody takes it for exact.
 * @param {{standard_error?: number}} reading
 */
export function errorWords({ standard_error: error }) {
  return error === undefined ? " (one packing, error unknown)" : "";
}

/** @param {number} seconds */
export function duration(seconds) {
  if (seconds < 90) return `${number(seconds, 2)} s`;
  if (seconds < 5400) return `${Math.round(seconds / 60)} min`;
  return `${number(seconds / 3600, 2)} h`;
}
