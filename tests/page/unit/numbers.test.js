import assert from "node:assert/strict";
import { test } from "node:test";
import {
  atNoise,
  duration,
  errorWords,
  number,
  plusMinus,
  plusMinusSigned,
} from "../../../calibrate/report/page/source/numbers.js";

test("a number has as many significant digits as asked for, without zeros behind", () => {
  assert.equal(number(143.5649), "143.6");
  assert.equal(number(2.5), "2.5");
  assert.equal(number(0.00123456, 3), "0.00123");
  assert.equal(number(98765.4), "98770");
  assert.equal(number(12, 1), "10");
  assert.equal(number(0), "0");
});

test("very large and very small numbers stand with an exponent", () => {
  assert.equal(number(2e6), "2e6");
  assert.equal(number(1.23456e-5), "1.235e\u22125");
  assert.equal(number(-2.5e7), "\u22122.5e7");
  assert.equal(number(1e-12, 1), "1e\u221212");
});

test("a number that is rounded to a million stands as a million does", () => {
  assert.equal(number(999_999.7), "1e6");
  assert.equal(number(-999_999.7), "\u22121e6");
  assert.equal(number(0.00099999999), "0.001");
});

test("a negative number has a minus sign, not a hyphen", () => {
  assert.equal(number(-1.57, 3), "\u22121.57");
  assert.equal(atNoise(-6.44, 2), "\u22126.4");
});

test("what is no finite number is a dash", () => {
  for (const value of [null, undefined, NaN, Infinity, -Infinity]) assert.equal(number(value), "\u2013");
});

test("a value ends at the decimal of its deviation's second digit", () => {
  assert.equal(atNoise(143.5649, 7.5), "143.6");
  assert.equal(atNoise(143.5649, 0.075), "143.565");
  assert.equal(atNoise(143.5649, 12), "144");
  assert.equal(atNoise(2, 0.25), "2.00");
});

test("a value with a deviation of hundreds is rounded to tens", () => {
  assert.equal(atNoise(987_654, 120), "987650");
  assert.equal(plusMinus(43_217, 1234), "43200 \u00b1 1200");
});

test("a deviation that is rounded up to another power of ten has two digits all the same", () => {
  assert.equal(plusMinus(1.2345, 0.0996), "1.23 \u00b1 0.10");
  assert.equal(plusMinus(150, 9.96), "150 \u00b1 10");
});

test("a value that its noise rounds to zero has no sign", () => {
  assert.equal(atNoise(-0.001, 0.5), "0.00");
  assert.equal(plusMinusSigned(-0.001, 0.5), "0.00 \u00b1 0.50");
  assert.equal(plusMinusSigned(0.001, 0.5), "0.00 \u00b1 0.50");
});

test("without a deviation, or with one of no use, a value has its significant digits", () => {
  for (const deviation of [undefined, 0, -1, NaN]) {
    assert.equal(plusMinus(143.5649, deviation), "143.6");
    assert.equal(atNoise(143.5649, deviation), "143.6");
  }
});

test("a value that is far smaller than six decimals show keeps its significant digits", () => {
  assert.equal(atNoise(1.2345e-7, 1e-9), "1.235e\u22127");
});

test("a difference has its sign", () => {
  assert.equal(plusMinusSigned(6.44, 1), "+6.4 \u00b1 1.0");
  assert.equal(plusMinusSigned(-6.44, undefined), "\u22126.44");
  assert.equal(plusMinusSigned(0, undefined), "0");
  assert.equal(plusMinusSigned(1e-7, undefined), "+1e\u22127");
});

test("a value of one packing says that its error is unknown", () => {
  assert.match(errorWords({}), /error unknown/);
  assert.equal(errorWords({ standard_error: 0.3 }), "");
});

test("a duration has two digits, in seconds, minutes or hours", () => {
  assert.equal(duration(0.42), "0.42 s");
  assert.equal(duration(75), "75 s");
  assert.equal(duration(89.7), "90 s");
  assert.equal(duration(92), "1.5 min");
  assert.equal(duration(3000), "50 min");
  assert.equal(duration(5400), "1.5 h");
  assert.equal(duration(360_000), "100 h");
});
