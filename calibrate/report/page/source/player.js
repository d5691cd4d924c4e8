// The film with its controls.
import { choice, element, toggle } from "./dom.js";
import { Film, speedOf } from "./film.js";
import { rampColour } from "./grains.js";
import { number } from "./numbers.js";
import { Scene } from "./scene.js";
import { stillPicture } from "./still.js";

/**
 * Words for the phases of a run: "step1.rest" -> "step 1: rest".
 * @param {string} phase
 */
export function phaseWords(phase) {
  const [stage, ...rest] = phase.split(".");
  if (stage === "fill") return `filling: ${rest.join(" ")}`;
  return `${stage.replace(/([a-z])(\d+)$/, "$1 $2")}${rest.length ? `: ${rest.join(" ")}` : ""}`;
}

/**
 * @param {string} by what colours the grains
 * @param {{height: number, touching: number, pull: number}} extremes
 */
function scaleOf(by, extremes) {
  /** @type {Record<string, [string, string]>} */
  const ends = {
    height: ["0", `${number(1e3 * extremes.height, 3)} mm`],
    speed: [`${number(speedOf(0), 1)} m/s`, `${number(speedOf(255), 2)} m/s, logarithmic`],
    coordination: ["0", `${extremes.touching} grains touched`],
    pull: ["0", `${number(1e3 * extremes.pull, 3)} mN, the sum of what bridges and sticking contacts pull on a grain`],
  };
  const stops = Array.from({ length: 11 }, (_, k) => rampColour(k / 10)).join(", ");
  return element(
    "p",
    { class: "scale" },
    element("span", {}, ends[by][0]),
    element("span", { class: "ramp", style: `background: linear-gradient(to right, ${stops})` }),
    element("span", {}, ends[by][1]),
  );
}

export class Player {
  /**
   * @param {Film} film
   * @param {HTMLElement} place
   */
  constructor(film, place) {
    this.film = film;
    this.speed = 1;
    this.playing = false;
    this.time = film.begin;
    this.canvas = element("canvas", {
      class: "stage",
      tabindex: 0,
      role: "img",
      "aria-label": "The grains of the confirmed run in three dimensions. Arrow keys turn, space plays.",
    });
    this.canvas.addEventListener("webglcontextlost", () =>
      place.replaceChildren(...inPlaceOf(film, "the browser has lost WebGL")),
    );
    this.scene = new Scene(this.canvas, film);
    this.button = element("button", { type: "button", class: "play", onclick: () => this.toggle() }, "\u25b6 Play");
    this.slider = this.sliderOf(film);
    this.clock = element("output", { class: "clock" });
    this.phases = film
      .phases()
      .map(({ name, begin }) =>
        element("button", { type: "button", onclick: () => this.show(begin), "data-phase": name }, phaseWords(name)),
      );
    this.scale = element("div");
    place.append(this.canvas, this.controls(), this.scale);
    this.recolour("height");
    this.canvas.addEventListener("keydown", (event) => this.key(event));
    // It opens on what came of the test; played from there it begins where the test does, when the filling is over.
    this.opening = film.firstOfTest()?.time ?? film.begin;
    this.show(film.end);
    Object.assign(place, { player: this }); // for tests
  }

  /** @param {Film} film */
  sliderOf({ begin, end }) {
    const attributes = { type: "range", min: begin, max: end, step: "any", "aria-label": "Time in the film" };
    const slider = element("input", attributes);
    slider.addEventListener("input", () => this.show(Number(slider.value)));
    return slider;
  }

  controls() {
    /** @type {[string, string][]} */
    const colours = [
      ["height", "height"],
      ["speed", "speed"],
      ["coordination", "coordination"],
    ];
    if (this.film.mostPull > 0) colours.push(["pull", "bridge force"]);
    /** @type {[string, string][]} */
    const views = ["slanted", "front", "side", "top"].map((view) => [view, view]);
    /** @type {[string, string][]} */
    const speeds = [
      ["0.25", "a quarter"],
      ["1", "as it is"],
      ["4", "four times"],
    ];
    return element(
      "div",
      { class: "controls" },
      element("div", { class: "row" }, this.button, this.slider, this.clock),
      element("div", { class: "phases" }, ...this.phases),
      element(
        "div",
        { class: "row" },
        choice("Speed", speeds, "1", (value) => (this.speed = Number(value))),
        choice("Colour", colours, "height", (value) => this.recolour(value)),
        choice("View", views, "slanted", (value) => this.scene.look(value)),
        toggle("Slice at the symmetry plane", (on) => this.scene.slice(on)),
      ),
    );
  }

  /** @param {string} by */
  recolour(by) {
    this.scene.colourBy(by);
    this.scale.replaceChildren(scaleOf(by, this.scene.grains.extremes));
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    const step = 0.12;
    const does = new Map([
      [" ", () => this.toggle()],
      ["ArrowLeft", () => this.scene.turn(-step, 0)],
      ["ArrowRight", () => this.scene.turn(step, 0)],
      ["ArrowUp", () => this.scene.turn(0, step)],
      ["ArrowDown", () => this.scene.turn(0, -step)],
    ]).get(event.key);
    if (!does) return;
    event.preventDefault();
    does();
  }

  /** @param {number} time */
  show(time) {
    this.time = Math.min(Math.max(time, this.film.begin), this.film.end);
    this.slider.value = String(this.time);
    const { one } = this.film.at(this.time);
    this.clock.textContent = `${(this.time - this.film.begin).toFixed(2)} s, ${phaseWords(one.phase)}`;
    for (const button of this.phases) button.classList.toggle("now", button.dataset.phase === one.phase);
    this.scene.show(this.time);
  }

  toggle() {
    this.playing = !this.playing;
    this.button.textContent = this.playing ? "\u23f8 Pause" : "\u25b6 Play";
    if (!this.playing) return this.scene.pace(0);
    if (this.time >= this.film.end) this.show(this.opening);
    let before = performance.now();
    /** @param {number} now */
    const tick = (now) => {
      if (!this.playing) return;
      this.show(this.time + (this.speed * (now - before)) / 1e3);
      this.scene.pace(now - before);
      before = now;
      if (this.time >= this.film.end) this.toggle();
      else requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }
}

/**
 * What stands in the place of the film.
 * @param {string} why
 */
const notShown = (why) => element("p", { class: "notice" }, `The film cannot be shown here: ${why}`);

/**
 * @param {Film} film
 * @param {string} why it cannot be shown
 */
const inPlaceOf = (film, why) => [notShown(why), stillPicture(film)].filter((one) => one !== null);

/**
 * The film of a test. What the browser cannot show is said instead.
 * @param {import("./content.js").FilmIndex} index
 * @param {string} text its bytes
 */
export function filmPlayer(index, text) {
  const place = element("div", { class: "player" });
  Film.read(index, text)
    .then((film) => {
      try {
        return new Player(film, place);
      } catch (error) {
        return place.replaceChildren(...inPlaceOf(film, error instanceof Error ? error.message : String(error)));
      }
    })
    .catch((error) => place.replaceChildren(notShown(error.message)));
  return place;
}
