// A film with many times the grains of that of a page, and what it costs a browser to draw it.
import { readFileSync, readdirSync } from "node:fs";

/** @typedef {import("playwright-core").Page} Page */

/**
 * Puts in place of the page's film one of `least` grains: grains become eight of half their radius each, until there
 * are enough. Gives how many there are.
 * @param {Page} page
 * @param {number} least
 */
export async function grow(page, least) {
  return page.evaluate((count) => {
    /** @typedef {import("../../calibrate/report/page/source/film.js").Film} Film */
    /** @typedef {import("../../calibrate/report/page/source/film.js").RecordingPart} RecordingPart */
    const place = /** @type {HTMLElement} */ (document.getElementsByClassName("player")[0]);
    const { player } = place;
    const Player = /** @type {new (film: Film, place: HTMLElement) => unknown} */ (player.constructor);
    /** @type {(part: RecordingPart, quantum: number) => RecordingPart} */
    const eightfold = (part, quantum) => {
      const parted = Math.min(part.count, Math.max(0, Math.ceil((count - part.count) / 7)));
      /** @type {<List extends Float32Array | Uint16Array | Uint8Array>(list: List, of?: Of) => List} */
      const parts = (list, of = (value) => value) => {
        const out = new /** @type {any} */ (list.constructor)(list.length + 7 * parted);
        for (let i = 0; i < parted; ++i) for (let k = 0; k < 8; ++k) out[8 * i + k] = of(list[i], i, k);
        out.set(list.subarray(parted), 8 * parted);
        return out;
      };
      /** @typedef {(value: number, i: number, k: number) => number} Of */
      /** @type {(axis: number) => Of} */
      const moved = (axis) => (at, i, k) =>
        Math.max(0, at + (((k >> axis) & 1 ? 0.5 : -0.5) * part.radii[i]) / quantum);
      return {
        count: part.count + 7 * parted,
        radii: parts(part.radii, (radius) => radius / 2),
        frames: part.frames.map((frame) => ({
          ...frame,
          places: frame.places.map((list, axis) => parts(list, moved(axis))),
          speeds: parts(frame.speeds),
          touching: parts(frame.touching),
          pulls: parts(frame.pulls),
        })),
      };
    };
    const film = Object.assign(Object.create(Object.getPrototypeOf(player.film)), player.film);
    const counts = () => film.parts.map((/** @type {RecordingPart} */ part) => part.count);
    while (Math.min(...counts()) < count)
      film.parts = film.parts.map((/** @type {RecordingPart} */ part) => eightfold(part, film.quantum));
    film.most = Math.max(...counts());
    place.replaceChildren();
    new Player(film, place);
    return Math.min(...counts());
  }, least);
}

/** Processor seconds of all processes that this one has started, and those have (Linux). */
export function processorSeconds() {
  /** @type {Map<number, {parent: number, ticks: number}>} */
  const known = new Map();
  for (const name of readdirSync("/proc").filter((one) => /^\d+$/.test(one)))
    try {
      const told = readFileSync(`/proc/${name}/stat`, "utf8");
      const rest = told.slice(told.lastIndexOf(")") + 2).split(" ");
      known.set(Number(name), { parent: Number(rest[1]), ticks: Number(rest[11]) + Number(rest[12]) });
    } catch {
      // it has ended
    }
  /** @type {(id: number) => boolean} */
  const isOurs = (id) => {
    const parent = known.get(id)?.parent;
    return parent !== undefined && (parent === process.pid || isOurs(parent));
  };
  let ticks = 0;
  for (const [id, one] of known) if (isOurs(id)) ticks += one.ticks;
  return ticks / 100;
}

/**
 * Draws `count` pictures of the test, one after the other, each to its end.
 * @param {Page} page
 * @param {number} count
 */
export async function drawTest(page, count) {
  await page.evaluate(async (pictures) => {
    const { scene, film, opening } = document.getElementsByClassName("player")[0].player;
    for (let k = 0; k < pictures; ++k) {
      scene.show(opening + ((film.end - opening) * k) / pictures);
      await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
      scene.renderer.getContext().finish();
    }
  }, count);
}

/**
 * The share of the picture's pixels that are another colour where all grains are drawn, also those behind others.
 * @param {Page} page
 * @param {{view: string, sliced: boolean, share: number}} what `share` of the test is over
 */
export async function shareHidden(page, what) {
  return page.evaluate(({ view, sliced, share }) => {
    const { scene, film, opening } = document.getElementsByClassName("player")[0].player;
    scene.look(view);
    scene.slice(sliced);
    scene.time = opening + share * (film.end - opening);
    const gl = scene.renderer.getContext();
    const { cover } = scene.grains;
    const picture = () => {
      scene.draw();
      const bytes = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
      gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
      return new Uint32Array(bytes.buffer);
    };
    const seen = picture();
    const { drawn } = scene;
    const look = cover.look;
    cover.look = (_, { count }) => {
      for (let i = 0; i < count; ++i) cover.seen[i] = i;
      return count;
    };
    const all = picture();
    cover.look = look;
    return { lost: seen.filter((colour, i) => colour !== all[i]).length / seen.length, drawn: drawn / scene.drawn };
  }, what);
}
