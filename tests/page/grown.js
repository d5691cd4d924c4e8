// A film with many times the grains of that of a page, and what it costs a browser to draw it.
import { readFileSync, readdirSync } from "node:fs";

/// Puts in place of the page's film one of `least` grains: grains become eight of half their radius each, until there are
/// enough. Gives how many there are.
export async function grow(page, least) {
  return page.evaluate((count) => {
    const place = document.querySelector(".player"),
      { film, constructor: Player } = place.player;
    const same = (value) => value;
    let grown = film;
    while (Math.min(...grown.reels.map((reel) => reel.count)) < count) {
      const old = grown;
      grown = Object.assign(Object.create(Object.getPrototypeOf(old)), old);
      grown.reels = old.reels.map((reel) => {
        const parted = Math.min(reel.count, Math.max(0, Math.ceil((count - reel.count) / 7)));
        const eightfold = (list, of) => {
          const out = new list.constructor(list.length + 7 * parted);
          for (let i = 0; i < parted; ++i) for (let k = 0; k < 8; ++k) out[8 * i + k] = of(list[i], i, k);
          out.set(list.subarray(parted), 8 * parted);
          return out;
        };
        return {
          count: reel.count + 7 * parted,
          radii: eightfold(reel.radii, (radius) => radius / 2),
          frames: reel.frames.map((frame) => ({
            ...frame,
            places: frame.places.map((list, axis) =>
              eightfold(list, (at, i, k) =>
                Math.max(0, at + (((k >> axis) & 1 ? 0.5 : -0.5) * reel.radii[i]) / old.quantum),
              ),
            ),
            speeds: eightfold(frame.speeds, same),
            touching: eightfold(frame.touching, same),
            pulls: eightfold(frame.pulls, same),
          })),
        };
      });
      grown.most = Math.max(...grown.reels.map((reel) => reel.count));
    }
    place.replaceChildren();
    new Player(grown, place);
    return Math.min(...grown.reels.map((reel) => reel.count));
  }, least);
}

/// Processor seconds of all processes that this one has started, and those have (Linux).
export function processorSeconds() {
  const known = new Map();
  for (const name of readdirSync("/proc").filter((one) => /^\d+$/.test(one)))
    try {
      const told = readFileSync(`/proc/${name}/stat`, "utf8"),
        rest = told.slice(told.lastIndexOf(")") + 2).split(" ");
      known.set(Number(name), { parent: Number(rest[1]), ticks: Number(rest[11]) + Number(rest[12]) });
    } catch {
      // it has ended
    }
  const isOurs = (id) =>
    id !== 0 && known.has(id) && (known.get(id).parent === process.pid || isOurs(known.get(id).parent));
  let ticks = 0;
  for (const [id, one] of known) if (isOurs(id)) ticks += one.ticks;
  return ticks / 100;
}

/// Draws `count` pictures of the test, one after the other, each to its end.
export async function drawTest(page, count) {
  await page.evaluate(async (pictures) => {
    const { scene, film } = document.querySelector(".player").player;
    const from = film.phases().find(({ name }) => !name.startsWith("fill.")).begin;
    for (let k = 0; k < pictures; ++k) {
      scene.show(from + ((film.end - from) * k) / pictures);
      await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
      scene.renderer.getContext().finish();
    }
  }, count);
}

/// The share of the picture's pixels that are another colour where all grains are drawn, also those behind others.
export async function shareHidden(page, view, sliced, share) {
  return page.evaluate(
    ([name, cut, along]) => {
      const { scene, film } = document.querySelector(".player").player;
      const from = film.phases().find(({ name: phase }) => !phase.startsWith("fill.")).begin;
      scene.look(name);
      scene.slice(cut);
      scene.time = from + along * (film.end - from);
      const gl = scene.renderer.getContext(),
        { cover } = scene.grains;
      const picture = () => {
        scene.draw();
        const bytes = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
        gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
        return new Uint32Array(bytes.buffer);
      };
      const seen = picture(),
        drawn = scene.drawn;
      cover.look = (camera, { count }) => {
        for (let i = 0; i < count; ++i) cover.seen[i] = i;
        return count;
      };
      const all = picture();
      delete cover.look;
      return { lost: seen.filter((colour, i) => colour !== all[i]).length / seen.length, drawn: drawn / scene.drawn };
    },
    [view, sliced, share],
  );
}
