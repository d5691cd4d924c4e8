// What the calibration answers, on top of everything.
import { element } from "./dom.js";
import { duration, errorWords, fullName, number, plusMinus, unitOf, words } from "./numbers.js";

const signs = {
  meets: ["\u2713", "The material meets the laboratory"],
  reserved: ["!", "The material meets the laboratory, with reservations"],
  open: ["?", "Not certain"],
  fails: ["\u2717", "The material does not meet the laboratory"],
  none: ["\u2026", "No answer yet"],
  goes: ["\u2026", "The calibration is under way"],
};

/// "meets", "reserved", "open", "fails", "goes" or "none".
export function verdictKind({ verdict, under_way }) {
  if (!verdict) return under_way ? "goes" : "none";
  if (verdict.meets_laboratory) return verdict.reservations?.length > 0 ? "reserved" : "meets";
  return verdict.misfit <= 1 || !verdict.fresh ? "open" : "fails";
}

function facts({ verdict, search, parameters, interval_level: level }) {
  const list = [];
  if (verdict) {
    const told = number(verdict.misfit * search.misfit_asked, 3);
    list.push([
      `${told} ${search.misfit_unit}`,
      `largest difference from the laboratory; allowed: ${number(search.misfit_asked, 3)}`,
    ]);
    const packings = verdict.packings.length === 1 ? "random packing" : "random packings";
    list.push([
      String(verdict.packings.length),
      verdict.fresh ? `${packings} that the search had not seen` : `${packings}, which the search had seen`,
    ]);
    const open = parameters.filter((one) => one.not_identified).length,
      free = parameters.filter((one) => one.free).length;
    if (level > 0) list.push([`${free - open} of ${free}`, "fitted parameters bounded by the readings"]);
  } else if (search.misfit_asked) {
    const runs = search.history.filter((one) => one.misfit !== undefined && !one.ended_early);
    if (runs.length > 0)
      list.push([
        `${number(Math.min(...runs.map((one) => one.misfit)), 3)} ${search.misfit_unit}`,
        `misfit of the best single run so far; allowed, as a mean over fresh packings: ${number(search.misfit_asked, 3)}`,
      ]);
  }
  if (search.history.length > 0)
    list.push([`${search.history.length}`, `simulations kept, ${duration(search.wall_s)} of computing`]);
  return element(
    "dl",
    { class: "facts" },
    ...list.map(([value, what]) => element("div", {}, element("dt", {}, value), element("dd", {}, what))),
  );
}

/// The answer in words: what was fitted, how well each reading is met, what is open.
function answers({ verdict, parameters = [], tests = [], interval_level: level }) {
  if (!verdict) return null;
  const free = parameters.filter((one) => one.free),
    told = free.filter((one) => one.interval),
    open = free.filter((one) => !one.interval);
  const value = (one) => `${one.name} ${number(one.value)}`;
  const reading = (test, one) =>
    `${words(fullName(test.name, one.name))} ${plusMinus(one.simulated, one.standard_error)} ${unitOf(one.name)}${errorWords(one)}, measured ${plusMinus(one.measured, one.standard_deviation)}`;
  const readings = (wanted) =>
    tests.flatMap((test) =>
      test.readings.filter((one) => one.measured !== undefined && wanted(test, one)).map((one) => reading(test, one)),
    );
  const off = (one) => Math.abs(one.simulated - one.measured) > one.tolerance;
  const fitted = (test, one) => !test.hold_out && one.weight > 0;
  const list = [
    ["Reservations", verdict.reservations ?? []],
    [
      "Fitted",
      level > 0
        ? told.map(
            (one) =>
              `${value(one)} (${number(100 * level, 3)} %: ${number(one.interval[0], 3)} to ${number(one.interval[1], 3)})`,
          )
        : free.map(value),
    ],
    ["Met", readings((test, one) => fitted(test, one) && !off(one))],
    ["Missed", readings((test, one) => fitted(test, one) && off(one))],
    ["Predicted", readings((test, one) => !fitted(test, one))],
    [
      "Open",
      level > 0
        ? [
            open.map(value).join(", ") +
              (open.length > 1
                ? ": each one choice among many that the readings allow"
                : ": one choice among many that the readings allow"),
          ]
        : [],
    ],
  ].filter(([what, lines]) => lines.length > 0 && (what !== "Open" || open.length > 0));
  return element(
    "dl",
    { class: "answers" },
    ...list.flatMap(([what, lines]) => [
      element("dt", {}, what),
      element("dd", {}, ...lines.map((line) => element("div", {}, line))),
    ]),
  );
}

/// The verdict's own sentence, without what the heading says already.
function sentence(text, heading) {
  return text.startsWith(`${heading}: `) ? text.slice(heading.length + 2) : text;
}

/// Kind, sign, heading and sentence of the answer.
export function answerOf(content) {
  const kind = verdictKind(content),
    [sign, heading] = signs[kind];
  const waiting =
    kind === "goes" ? "This page looks again every ten seconds." : "Below is what the folder holds so far.";
  return [kind, sign, heading, content.verdict ? sentence(content.verdict.words, heading) : waiting];
}

export function verdictPart(content) {
  const [kind, sign, heading, said] = answerOf(content);
  return element(
    "header",
    { id: "verdict", class: kind },
    element("p", { class: "brand" }, "pastefit"),
    element("h1", {}, content.title ?? "A calibration without a card"),
    element(
      "div",
      { class: "answer" },
      element("span", { class: "badge", "aria-hidden": "true" }, sign),
      element("div", {}, element("strong", {}, heading), element("p", {}, said), answers(content)),
    ),
    facts(content),
  );
}

/// What is missing, if something is.
export function missingPart({ missing }) {
  if (missing.length === 0) return null;
  return element(
    "aside",
    { id: "missing", "aria-label": "What is missing" },
    element("h2", {}, "What this page lacks"),
    element("ul", {}, ...missing.map((sentence) => element("li", {}, sentence))),
  );
}
