// The film with its controls.
import { choice, element, toggle } from "./dom.js";
import { Film, speedOf } from "./film.js";
import { rampColour } from "./grains.js";
import { number } from "./numbers.js";
import { Scene } from "./scene.js";

/// Words for the phases of a run: "step1.lift" -> "step 1: lift".
export function phaseWords(phase) {
  const [stage, ...rest] = phase.split(".");
  if (stage === "fill") return `filling: ${rest.join(" ")}`;
  return `${stage.replace(/^step(\d)$/, "step $1")}${rest.length ? `: ${rest.join(" ")}` : ""}`;
}

function scaleOf(by, extremes) {
  const ends = {
    height: ["0", `${number(1e3 * extremes.height, 3)} mm`],
    speed: [`${number(speedOf(0), 1)} m/s`, `${number(speedOf(255), 2)} m/s, logarithmic`],
    coordination: ["0", `${extremes.touching} grains touched`],
    pull: ["0", `${number(1e3 * extremes.pull, 3)} mN, the sum of what bridges and sticking contacts pull on a grain`],
  }[by];
  const stops = Array.from({ length: 11 }, (_, k) => rampColour(k / 10)).join(", ");
  return element(
    "p",
    { class: "scale" },
    element("span", {}, ends[0]),
    element("span", { class: "ramp", style: `background: linear-gradient(to right, ${stops})` }),
    element("span", {}, ends[1]),
  );
}

class Player {
  constructor(film, place) {
    this.film = film;
    this.place = place;
    this.speed = 1;
    this.playing = false;
    this.time = film.begin;
    this.canvas = element("canvas", {
      class: "stage",
      tabindex: 0,
      role: "img",
      "aria-label": "The grains of the confirmed run in three dimensions. Arrow keys turn, space plays.",
    });
    this.scene = new Scene(this.canvas, film);
    this.scale = element("div");
    place.append(this.canvas, this.controls(), this.scale);
    this.recolour("height");
    this.canvas.addEventListener("keydown", (event) => this.key(event));
    // It opens on the heap; played from there it begins where the test does, when the mould is full.
    this.opening = film.phases().find(({ name }) => !name.startsWith("fill."))?.begin ?? film.begin;
    this.show(film.end);
    place.player = this; // for tests
  }

  controls() {
    this.button = element("button", { type: "button", class: "play", onclick: () => this.toggle() }, "\u25b6 Play");
    this.slider = element("input", {
      type: "range",
      min: this.film.begin,
      max: this.film.end,
      step: "any",
      "aria-label": "Time in the film",
      oninput: () => this.show(Number(this.slider.value)),
    });
    this.clock = element("output", { class: "clock" });
    const phases = element(
      "div",
      { class: "phases" },
      ...this.film
        .phases()
        .map(({ name, begin }) =>
          element("button", { type: "button", onclick: () => this.show(begin), "data-phase": name }, phaseWords(name)),
        ),
    );
    this.phases = phases;
    return element(
      "div",
      { class: "controls" },
      element("div", { class: "row" }, this.button, this.slider, this.clock),
      phases,
      element(
        "div",
        { class: "row" },
        choice(
          "Speed",
          [
            ["0.25", "a quarter"],
            ["1", "as it is"],
            ["4", "four times"],
          ],
          "1",
          (value) => (this.speed = Number(value)),
        ),
        choice(
          "Colour",
          [
            ["height", "height"],
            ["speed", "speed"],
            ["coordination", "coordination"],
            ...(this.film.mostPull > 0 ? [["pull", "bridge force"]] : []),
          ],
          "height",
          (value) => this.recolour(value),
        ),
        choice(
          "View",
          [
            ["slanted", "slanted"],
            ["front", "front"],
            ["side", "side"],
            ["top", "top"],
          ],
          "slanted",
          (value) => this.scene.look(value),
        ),
        toggle("Slice at the symmetry plane", false, (on) => this.scene.slice(on)),
      ),
    );
  }

  recolour(by) {
    this.scene.colourBy(by);
    this.scale.replaceChildren(scaleOf(by, this.scene.grains.extremes));
  }

  key(event) {
    const step = 0.12;
    const does = {
      " ": () => this.toggle(),
      ArrowLeft: () => this.scene.turn(-step, 0),
      ArrowRight: () => this.scene.turn(step, 0),
      ArrowUp: () => this.scene.turn(0, step),
      ArrowDown: () => this.scene.turn(0, -step),
    }[event.key];
    if (!does) return;
    event.preventDefault();
    does();
  }

  show(time) {
    this.time = Math.min(Math.max(time, this.film.begin), this.film.end);
    this.slider.value = this.time;
    const { one } = this.film.at(this.time);
    this.clock.textContent = `${(this.time - this.film.begin).toFixed(2)} s, ${phaseWords(one.phase)}`;
    for (const button of this.phases.children) button.classList.toggle("now", button.dataset.phase === one.phase);
    this.scene.show(this.time);
  }

  toggle() {
    this.playing = !this.playing;
    this.button.textContent = this.playing ? "\u23f8 Pause" : "\u25b6 Play";
    if (!this.playing) return this.scene.pace(0);
    if (this.time >= this.film.end) this.show(this.opening);
    let before = performance.now();
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

/// The film of a test: `index` from the content, `text` its bytes. What the browser cannot show is said instead.
export function filmPlayer(index, text) {
  const place = element("div", { class: "player" });
  Film.read(index, text)
    .then((film) => new Player(film, place))
    .catch((error) => {
      place.replaceChildren(element("p", { class: "notice" }, `The film cannot be shown here: ${error.message}`));
      place.failed = true;
    });
  return place;
}
