// The film of a run: places, speeds and neighbours of its grains, and what pulls on them, as they are coded in
// calibrate/report/run_recording.h.

/** @typedef {import("./content.js").FilmIndex} FilmIndex */
/** @typedef {import("./content.js").PartIndex} PartIndex */
/** @typedef {import("./content.js").Wall} Wall */

/**
 * @typedef {object} Frame the grains at one time
 * @property {number} time
 * @property {string} phase
 * @property {Wall[]} walls
 * @property {Uint16Array[]} places along each axis, in quanta
 * @property {Uint8Array} speeds code
 * @property {Uint8Array} touching
 * @property {Uint8Array} pulls share of the largest one, times 255
 */

/** @typedef {{count: number, radii: Float32Array, frames: Frame[]}} RecordingPart frames of the same grains */

const slowest = -4; // decimal logarithm of the slowest speed that is told apart [m/s]
const perDecade = 51;

/** @param {string} text in base64 */
async function inflated(text) {
  try {
    const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  } catch {
    // What the browser says of it, "Failed to fetch", sends people to look at their network.
    throw new Error("its bytes are damaged; pastefit report makes the page anew");
  }
}

/** Takes columns of numbers off the bytes, one after the other. */
class Columns {
  /** @param {Uint8Array} bytes */
  constructor(bytes) {
    this.bytes = bytes;
    this.place = 0;
  }
  /** @param {number} count */
  take(count) {
    if (this.place + count > this.bytes.length) throw new Error("the film ends too early");
    const part = this.bytes.subarray(this.place, this.place + count);
    this.place += count;
    return part;
  }
  /**
   * Numbers of 16 bits, each added to that of `before`.
   * @param {number} count
   * @param {Uint16Array} [before]
   */
  words(count, before) {
    const low = this.take(count);
    const high = this.take(count);
    const out = new Uint16Array(count);
    for (let i = 0; i < count; ++i) out[i] = low[i] + 256 * high[i] + (before ? before[i] : 0);
    return out;
  }
  /**
   * The same of 8 bits.
   * @param {number} count
   * @param {Uint8Array} [before]
   */
  octets(count, before) {
    const out = new Uint8Array(this.take(count));
    if (before) for (let i = 0; i < count; ++i) out[i] += before[i];
    return out;
  }
}

/**
 * @param {Columns} columns
 * @param {PartIndex} index
 * @param {number} quantum
 * @returns {RecordingPart}
 */
function partOf(columns, index, quantum) {
  const count = index.grains;
  const radii = Float32Array.from(columns.words(count), (steps) => steps * quantum);
  /** @type {Frame[]} */
  const frames = [];
  /** @type {Wall[]} */
  let walls = [];
  for (const { time_s, phase, walls: moved } of index.frames) {
    const last = frames.at(-1);
    walls = moved ?? walls;
    frames.push({
      time: time_s,
      phase,
      walls,
      places: [0, 1, 2].map((axis) => columns.words(count, last?.places[axis])),
      speeds: columns.octets(count, last?.speeds),
      touching: columns.octets(count, last?.touching),
      pulls: columns.octets(count, last?.pulls),
    });
  }
  return { count, radii, frames };
}

/** A film ready to be shown. Time runs through all parts. */
export class Film {
  /**
   * @param {FilmIndex} index
   * @param {string} text the bytes, deflated, in base64
   */
  static async read(index, text) {
    const columns = new Columns(await inflated(text));
    const parts = index.reels.map((part) => partOf(columns, part, index.quantum_m));
    if (columns.place < columns.bytes.length) throw new Error("the film goes on behind its last frame");
    return new Film(index, parts);
  }

  /**
   * @param {Pick<FilmIndex, "quantum_m" | "low_m" | "most_pull_n">} index
   * @param {RecordingPart[]} parts
   */
  constructor(index, parts) {
    this.quantum = index.quantum_m;
    this.low = index.low_m;
    this.mostPull = index.most_pull_n;
    this.parts = parts;
    this.begin = parts[0].frames[0].time;
    this.end = this.frames().at(-1)?.time ?? this.begin;
    this.most = Math.max(...parts.map((part) => part.count));
  }

  /** Phases in their order. */
  phases() {
    /** @type {{name: string, begin: number, end: number}[]} */
    const found = [];
    for (const { phase, time } of this.frames()) {
      const last = found.at(-1);
      if (last?.name === phase) last.end = time;
      else found.push({ name: phase, begin: time, end: time });
    }
    return found;
  }

  frames() {
    return this.parts.flatMap((part) => part.frames);
  }

  /** The frame with which the test begins: the first one after the filling. */
  firstOfTest() {
    return this.frames().find(({ phase }) => !phase.startsWith("fill."));
  }

  /** The middle of the grains as the test begins, seen from above, and their box from corner to corner [m]. */
  box() {
    const { places } = this.firstOfTest() ?? this.frames()[this.frames().length - 1];
    const [x, y] = [0, 1].map((axis) => {
      let low = Infinity;
      let high = -Infinity;
      for (const steps of places[axis]) [low, high] = [Math.min(low, steps), Math.max(high, steps)];
      const middle = this.low[axis] + 0.5 * (low + high) * this.quantum;
      const width = (high - low) * this.quantum;
      // What stands about the axis does so but for its grains.
      return { middle: Math.abs(middle) < 0.05 * width ? 0 : middle, width };
    });
    return { centre: [x.middle, y.middle], across: Math.hypot(x.width, y.width) };
  }

  /**
   * How far from a place grains lie in the end, along x or y [m].
   * @param {number[]} centre
   */
  reach(centre) {
    const { places } = this.frames()[this.frames().length - 1];
    let far = 0;
    for (const axis of [0, 1])
      for (const steps of places[axis])
        far = Math.max(far, Math.abs(this.low[axis] + steps * this.quantum - centre[axis]));
    return far;
  }

  /**
   * The two frames of one part around a time, and how far it is from the first to the second.
   * @param {number} time
   */
  at(time) {
    const part = this.parts.findLast(({ frames }) => frames[0].time <= time) ?? this.parts[0];
    const frames = part.frames;
    let next = frames.findIndex((frame) => frame.time > time);
    if (next < 0) next = frames.length;
    const one = frames[Math.max(next - 1, 0)];
    const other = frames[Math.min(next, frames.length - 1)];
    const gap = other.time - one.time;
    return { part, one, other, share: gap > 0 ? Math.min(Math.max((time - one.time) / gap, 0), 1) : 0 };
  }

  /** The largest of heights [m], neighbours and pulls [N] in the film, for scales of colour. */
  extremes() {
    let height = 0;
    let touching = 1;
    // Grains that are still being filled in stand higher than any heap.
    const ofTest = this.frames().filter(({ phase }) => !phase.startsWith("fill."));
    for (const frame of ofTest.length > 0 ? ofTest : this.frames()) {
      for (const steps of frame.places[2]) height = Math.max(height, steps);
      for (const count of frame.touching) touching = Math.max(touching, count);
    }
    return { height: this.low[2] + height * this.quantum, touching, pull: this.mostPull };
  }
}

/**
 * Speed of a code [m/s].
 * @param {number} code
 */
export function speedOf(code) {
  return 10 ** (slowest + code / perDecade);
}
