// The film of a run: places, speeds and neighbours of its grains, and what pulls on them (calibrate/report/film_code.h says how they are coded).

const slowest = -4; // decimal logarithm of the slowest speed that is told apart [m/s]
const perDecade = 51;

async function inflated(text) {
  const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  try {
    return new Uint8Array(await new Response(stream).arrayBuffer());
  } catch {
    // What the browser says of it, "Failed to fetch", sends people to look at their network.
    throw new Error("its bytes are damaged; pastefit report makes the page anew");
  }
}

/// Takes columns of numbers off the bytes, one after the other.
class Columns {
  constructor(bytes) {
    this.bytes = bytes;
    this.place = 0;
  }
  take(count) {
    if (this.place + count > this.bytes.length) throw new Error("the film ends too early");
    const part = this.bytes.subarray(this.place, this.place + count);
    this.place += count;
    return part;
  }
  /// `count` numbers of 16 bits, each added to that of `before`.
  words(count, before) {
    const low = this.take(count),
      high = this.take(count);
    const out = new Uint16Array(count);
    for (let i = 0; i < count; ++i) out[i] = low[i] + 256 * high[i] + (before ? before[i] : 0);
    return out;
  }
  octets(count, before) {
    const out = new Uint8Array(this.take(count));
    if (before) for (let i = 0; i < count; ++i) out[i] += before[i];
    return out;
  }
}

function reelOf(columns, index, quantum) {
  const count = index.grains;
  const radii = Float32Array.from(columns.words(count), (steps) => steps * quantum);
  const frames = [];
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

/// A film ready to be shown. Time runs through all reels.
export class Film {
  /// `index`: from the content; `text`: the bytes, deflated, in base64.
  static async read(index, text) {
    const columns = new Columns(await inflated(text));
    const reels = index.reels.map((reel) => reelOf(columns, reel, index.quantum_m));
    return new Film(index, reels);
  }

  constructor(index, reels) {
    this.quantum = index.quantum_m;
    this.low = index.low_m;
    this.mostPull = index.most_pull_n;
    this.reels = reels;
    this.begin = reels[0].frames[0].time;
    this.end = reels.at(-1).frames.at(-1).time;
    this.most = Math.max(...reels.map((reel) => reel.count));
  }

  /// Phases in their order: [{name, begin, end}].
  phases() {
    const found = [];
    for (const { frames } of this.reels)
      for (const frame of frames) {
        if (found.at(-1)?.name !== frame.phase) found.push({ name: frame.phase, begin: frame.time, end: frame.time });
        found.at(-1).end = frame.time;
      }
    return found;
  }

  /// The two frames of one reel around a time, and how far it is from the first to the second.
  at(time) {
    const reel = this.reels.findLast(({ frames }) => frames[0].time <= time) ?? this.reels[0];
    const frames = reel.frames;
    let next = frames.findIndex((frame) => frame.time > time);
    if (next < 0) next = frames.length;
    const one = frames[Math.max(next - 1, 0)],
      other = frames[Math.min(next, frames.length - 1)];
    const gap = other.time - one.time;
    return { reel, one, other, share: gap > 0 ? Math.min(Math.max((time - one.time) / gap, 0), 1) : 0 };
  }

  /// The largest of heights [m], neighbours and pulls [N] in the film, for scales of colour.
  extremes() {
    let height = 0,
      touching = 1;
    for (const { frames } of this.reels) {
      for (const frame of frames.filter((one) => !one.phase.startsWith("fill.pour"))) {
        for (const steps of frame.places[2]) height = Math.max(height, steps);
        for (const count of frame.touching) touching = Math.max(touching, count);
      }
    }
    return { height: this.low[2] + height * this.quantum, touching, pull: this.mostPull };
  }
}

/// Speed of a code [m/s].
export function speedOf(code) {
  return 10 ** (slowest + code / perDecade);
}
