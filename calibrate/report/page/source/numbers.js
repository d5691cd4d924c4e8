// Numbers as people read them.

const minus = "\u2212";
const none = "\u2013";

/**
 * So many significant digits, plain where that is short.
 * @param {number | null | undefined} value
 */
export function number(value, digits = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return none;
  const rounded = Number(value.toPrecision(digits));
  const size = Math.abs(rounded);
  if (size === 0 || (size >= 1e-3 && size < 1e6)) return signed(String(rounded));
  return signed(
    rounded
      .toExponential(digits - 1)
      .replace(/\.?0+e/, "e")
      .replace("e+", "e"),
  );
}

/** @param {string} text of a number; without the sign of one that is rounded to zero */
function signed(text) {
  return Number(text) === 0 ? text.replace("-", "") : text.replace(/-/g, minus);
}

/**
 * To the decimal to which its deviation has two digits; further digits are noise.
 * @param {number} value
 * @param {number | undefined} deviation
 */
export function atNoise(value, deviation, digits = 4) {
  if (!deviation || !(deviation > 0) || !Number.isFinite(deviation) || !Number.isFinite(value))
    return number(value, digits);
  const decimals = 1 - Math.floor(Math.log10(Number(deviation.toPrecision(2))));
  if (decimals > 6) return number(value, digits);
  if (decimals >= 0) return signed(value.toFixed(decimals));
  const step = 10 ** -decimals;
  return number(Math.round(value / step) * step, 15);
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
  const isAbove = value > 0 && /[1-9]/.test(atNoise(value, deviation, 3));
  return `${isAbove ? "+" : ""}${plusMinus(value, deviation, 3)}`;
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
  if (seconds < 5400) return `${number(seconds / 60, 2)} min`;
  return `${number(seconds / 3600, 2)} h`;
}
