// Which grains of a picture can be seen: in a heap of ten thousand most lie behind others, and each that is drawn
// costs, seen or not.

/** @typedef {{matrixWorldInverse: {elements: number[]}, projectionMatrix: {elements: number[]}}} Camera */
/** @typedef {{x: number, y: number, z: number, w: number}} Plane */
/** @typedef {{count: number, positions: ArrayLike<number>, radii: ArrayLike<number>}} PlacedGrains */

const cellsPerRadius = 4;
const mostCells = 640;

/** A picture in cells, filled from the front to the back with the discs that grains cover. */
export class Cover {
  /** @param {number} most grains */
  constructor(most) {
    this.places = new Float32Array(3 * most); // in the camera's frame
    this.away = new Float32Array(most);
    this.order = new Uint32Array(most);
    this.seen = new Uint32Array(most);
    this.cells = new Uint8Array(0);
  }

  /**
   * Writes the numbers of the grains to be drawn to `seen`, the nearest first, and gives how many.
   * @param {Camera} camera
   * @param {PlacedGrains} grains
   * @param {Plane | null} slice in the camera's frame; what lies on its negative side is cut away
   */
  look(camera, grains, slice) {
    const { radii } = grains;
    const placed = this.place(camera, grains, slice);
    const [across, up] = [camera.projectionMatrix.elements[0], camera.projectionMatrix.elements[5]];
    const size = this.empty(placed, radii, up, across / up);
    let kept = 0;
    for (const i of placed) {
      const [x, y, z] = [this.places[3 * i], this.places[3 * i + 1], -this.places[3 * i + 2]];
      const radius = radii[i];
      // What is cut, or about the camera itself, is drawn and hides nothing.
      const whole = z > 2 * radius && !(slice && this.side(i, slice) < radius);
      if (!whole) this.seen[kept++] = i;
      else {
        const column = (0.5 + (0.5 * across * x) / z) * size.columns;
        const row = (0.5 + (0.5 * up * y) / z) * size.rows;
        const reach = (0.5 * up * radius * size.rows) / z;
        // Off the axis a sphere looks longer than it is: asked about generously, covered sparingly.
        if (this.covers(size, column, row, 1.08 * reach + 1, 0.94 * reach)) this.seen[kept++] = i;
      }
    }
    return kept;
  }

  /**
   * How far a grain lies on the positive side.
   * @param {number} i
   * @param {Plane} plane
   */
  side(i, { x, y, z, w }) {
    return x * this.places[3 * i] + y * this.places[3 * i + 1] + z * this.places[3 * i + 2] + w;
  }

  /**
   * The grains that are before the camera and not cut away, the nearest first.
   * @param {Camera} camera
   * @param {PlacedGrains} grains
   * @param {Plane | null} slice
   */
  place(camera, { count, positions, radii }, slice) {
    const m = camera.matrixWorldInverse.elements;
    let there = 0;
    for (let i = 0; i < count; ++i) {
      const [x, y, z] = [positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]];
      for (let row = 0; row < 3; ++row)
        this.places[3 * i + row] = m[row] * x + m[4 + row] * y + m[8 + row] * z + m[12 + row];
      this.away[i] = Math.hypot(this.places[3 * i], this.places[3 * i + 1], this.places[3 * i + 2]);
      if (this.places[3 * i + 2] > radii[i] || (slice && this.side(i, slice) < -radii[i])) continue;
      this.order[there++] = i;
    }
    // Spheres that do not overlap hide each other in the order of their middles.
    return this.order.subarray(0, there).sort((one, other) => this.away[one] - this.away[other]);
  }

  /**
   * No cell is covered; cells are as fine as the grains, seen in their middle distance, ask for.
   * @param {Uint32Array} placed
   * @param {ArrayLike<number>} radii
   * @param {number} up pixels upwards, a share of half the picture
   * @param {number} proportion of the picture's height to its width
   */
  empty(placed, radii, up, proportion) {
    const middle = placed[placed.length >> 1] ?? 0;
    const share = (0.5 * up * radii[middle]) / Math.max(this.away[middle], 1e-6);
    const rows = Math.min(Math.max(Math.round(cellsPerRadius / share), 16), mostCells);
    const columns = Math.min(Math.max(Math.round(rows / proportion), 16), 2 * mostCells);
    if (this.cells.length < rows * columns) this.cells = new Uint8Array(rows * columns);
    this.cells.fill(0);
    return { rows, columns };
  }

  /**
   * Covers a disc; whether something of one of radius `asked` about the same middle was free before.
   * @param {{rows: number, columns: number}} size
   * @param {number} column of the middle
   * @param {number} row
   * @param {number} asked in cells
   * @param {number} covered its radius, in cells
   */
  covers({ rows, columns }, column, row, asked, covered) {
    let free = false;
    const last = Math.min(Math.floor(row + asked), rows - 1);
    for (let r = Math.max(Math.floor(row - asked), 0); r <= last; ++r) {
      const off = r + 0.5 - row;
      const half = asked * asked - off * off;
      if (half < 0) continue;
      const wide = Math.sqrt(half);
      const from = Math.max(Math.floor(column - wide), 0);
      const to = Math.min(Math.floor(column + wide), columns - 1);
      if (!free) for (let c = from; c <= to && !free; ++c) free = this.cells[r * columns + c] === 0;
    }
    if (!free) return false;
    for (let r = Math.max(Math.ceil(row - covered), 0); r < Math.min(row + covered, rows) - 1; ++r) {
      const off = Math.max(Math.abs(r - row), Math.abs(r + 1 - row));
      const half = covered * covered - off * off;
      if (half <= 0) continue;
      const wide = Math.sqrt(half);
      const from = Math.max(Math.ceil(column - wide), 0);
      const to = Math.min(Math.floor(column + wide), columns);
      if (to > from) this.cells.fill(1, r * columns + from, r * columns + to);
    }
    return true;
  }
}
