// The apparatus of a run: its walls as surfaces that can be looked through.
import * as THREE from "three";

/** @typedef {import("./content.js").Wall} Wall */
/** @typedef {{reach: number, centre: THREE.Vector3}} About where what has no end is shown, and how much of it */
/** @typedef {{side: THREE.BufferGeometry, rims: THREE.BufferGeometry[]}} Surface */

const around = 72; // corners of what is round

/**
 * @param {import("./content.js").Shell} wall
 * @returns {Surface}
 */
function shellOf({ base_m: base, radii_m: [lower, upper], height_m: height }) {
  const side = new THREE.CylinderGeometry(upper, lower, height, around, 1, true);
  side.rotateX(Math.PI / 2).translate(base[0], base[1], base[2] + height / 2);
  const rims = [
    [lower, 0],
    [upper, height],
  ].map(([radius, z]) => {
    const corners = Array.from({ length: around + 1 }, (_, k) => {
      const angle = (2 * Math.PI * k) / around;
      return new THREE.Vector3(base[0] + radius * Math.cos(angle), base[1] + radius * Math.sin(angle), base[2] + z);
    });
    return new THREE.BufferGeometry().setFromPoints(corners);
  });
  return { side, rims };
}

/**
 * @param {THREE.Vector3} centre
 * @param {THREE.Vector3} along
 * @param {THREE.Vector3} across
 * @param {[number, number]} halves
 * @returns {Surface}
 */
function rectangleOf(centre, along, across, [half, halfAcross]) {
  /** @type {(a: number, b: number) => THREE.Vector3} */
  const corner = (a, b) =>
    centre
      .clone()
      .addScaledVector(along, a * half)
      .addScaledVector(across, b * halfAcross);
  const corners = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
  const side = new THREE.BufferGeometry().setFromPoints([0, 1, 2, 0, 2, 3].map((k) => corners[k]));
  side.computeVertexNormals();
  return { side, rims: [new THREE.BufferGeometry().setFromPoints([...corners, corners[0]])] };
}

/** @param {import("./content.js").Plate} wall */
function plateOf(wall) {
  return rectangleOf(
    new THREE.Vector3(...wall.centre_m),
    new THREE.Vector3(...wall.along),
    new THREE.Vector3(...wall.across),
    wall.half_m,
  );
}

/**
 * Of an infinite plane a square about where the grains are.
 * @param {import("./content.js").Plane} wall
 * @param {About} about
 */
function planeOf(wall, { reach, centre }) {
  const normal = new THREE.Vector3(...wall.normal);
  const along = Math.abs(normal.x) < 0.9 ? new THREE.Vector3(1, 0, 0) : new THREE.Vector3(0, 1, 0);
  along.addScaledVector(normal, -along.dot(normal)).normalize();
  const place = centre.clone().addScaledVector(normal, new THREE.Vector3(...wall.point_m).sub(centre).dot(normal));
  return rectangleOf(place, along, new THREE.Vector3().crossVectors(normal, along), [reach, reach]);
}

/**
 * Of an endless row of bars those about where the grains are, as the line along their feet and crests would cut them.
 * @param {import("./content.js").Ribs} wall
 * @param {About} about
 * @returns {Surface}
 */
function ribsOf({ base_m: [x, , z], thickness_m: thickness, height_m: height, pitch_m: pitch }, { reach, centre }) {
  const corners = [];
  const rims = [];
  const from = centre.x - reach;
  const to = centre.x + reach;
  for (let middle = x + Math.ceil((from - x) / pitch) * pitch; middle <= to; middle += pitch) {
    const [left, right] = [middle - thickness / 2, middle + thickness / 2];
    const outline = [
      [left, z],
      [left, z + height],
      [right, z + height],
      [right, z],
    ];
    const near = outline.map(([a, b]) => new THREE.Vector3(a, centre.y - reach, b));
    const far = outline.map(([a, b]) => new THREE.Vector3(a, centre.y + reach, b));
    for (const k of [0, 1, 2]) corners.push(near[k], near[k + 1], far[k + 1], near[k], far[k + 1], far[k]);
    rims.push(...[near, far].map((line) => new THREE.BufferGeometry().setFromPoints(line)));
  }
  return { side: new THREE.BufferGeometry().setFromPoints(corners), rims };
}

/**
 * @param {Wall} wall
 * @param {About} about
 */
function surfaceOf(wall, about) {
  if (wall.shape === "shell") return shellOf(wall);
  if (wall.shape === "plate") return plateOf(wall);
  if (wall.shape === "plane") return planeOf(wall, about);
  return ribsOf(wall, about);
}

export class Apparatus {
  /**
   * @param {number} reach how far around `centre` what has no end is shown
   * @param {THREE.Vector3} centre
   */
  constructor(reach, centre) {
    this.group = new THREE.Group();
    this.about = { reach, centre };
    /** @type {(THREE.Mesh | THREE.Line)[]} */
    this.parts = [];
    /** @param {number} opacity */
    const glass = (opacity) =>
      new THREE.MeshBasicMaterial({ transparent: true, opacity, side: THREE.DoubleSide, depthWrite: false });
    this.materials = { shell: glass(0.16), plate: glass(0.5), plane: glass(0.35), ribs: glass(0.35) };
    this.edges = new THREE.LineBasicMaterial();
    /** @type {Wall[] | null} */
    this.shown = null;
  }

  /**
   * @param {string} surface its colour
   * @param {string} edge
   */
  paint(surface, edge) {
    for (const material of Object.values(this.materials)) material.color.set(surface);
    this.edges.color.set(edge);
  }

  /** @param {THREE.Plane | null} plane */
  clip(plane) {
    this.materials.shell.clippingPlanes = plane ? [plane] : null;
  }

  /**
   * Shows the walls of a frame; those of the next one are too near to be told apart.
   * @param {Wall[]} walls
   */
  show(walls) {
    if (walls === this.shown) return;
    this.shown = walls;
    for (const { geometry } of this.parts) geometry.dispose();
    this.group.clear();
    this.parts = [];
    for (const wall of walls) {
      if (wall.shape === "plane" && wall.point_m[2] < -1e-6) continue; // the ground below a table
      const { side, rims } = surfaceOf(wall, this.about);
      const surface = new THREE.Mesh(side, this.materials[wall.shape]);
      surface.renderOrder = wall.shape === "shell" ? 2 : 1;
      this.parts.push(surface, ...rims.map((rim) => new THREE.Line(rim, this.edges)));
    }
    this.group.add(...this.parts);
  }
}
