// Grains as impostors: each is one point, and the spheres are computed for every pixel, so that ten thousand of them
// cost two triangles each less than one of a mesh would.
import * as THREE from "three";
import { interpolateViridis } from "d3";
import { Cover } from "./cover.js";

// What is the same for all pixels of a grain is computed here: by software a pixel costs most.
const vertexShader = /* glsl */ `
in vec3 position;
in float radius;
in float value;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform float pixels;
uniform sampler2D ramp;
flat out vec3 centre;
flat out vec2 sizes; // radius, and half the side of the square that is drawn
flat out vec3 own;

void main() {
  vec4 place = modelViewMatrix * vec4(position, 1.0);
  centre = place.xyz;
  // A sphere off the axis looks longer than it is, one that is near more so.
  float away = length(centre);
  sizes = vec2(radius, radius * (1.02 + radius / away) * away / -centre.z);
  own = texture(ramp, vec2(value, 0.5)).rgb;
  gl_Position = projectionMatrix * place;
  gl_PointSize = sizes.y * projectionMatrix[1][1] * pixels / -place.z;
}`;

// The ray of the pixel meets the sphere; where the slice has cut the near part away it meets the cut instead.
const fragmentShader = /* glsl */ `
precision highp float;
flat in vec3 centre;
flat in vec2 sizes;
flat in vec3 own;
uniform mat4 projectionMatrix;
uniform bool sliced;
uniform vec4 slice; // in the camera's frame; what lies on its negative side is cut away
out vec4 colour;

const vec3 light = normalize(vec3(-0.4, 0.7, 0.8));

void main() {
  float size = sizes.x;
  vec2 off = sizes.y * vec2(2.0 * gl_PointCoord.x - 1.0, 1.0 - 2.0 * gl_PointCoord.y);
  vec3 ray = normalize(centre + vec3(off, 0.0));
  float along = dot(ray, centre);
  float inside = along * along - dot(centre, centre) + size * size;
  if (inside < 0.0) discard;
  float half_way = sqrt(inside), way = along - half_way;
  vec3 place = way * ray, normal = (place - centre) / size;
  float rim = 1.0;
  if (sliced && dot(slice.xyz, place) + slice.w < 0.0) {
    float to_cut = -slice.w / dot(slice.xyz, ray);
    if (to_cut < way || to_cut > along + half_way) discard;
    place = to_cut * ray;
    normal = -slice.xyz;
    // A thin rim tells one cut grain from the next.
    vec3 from_centre = place - centre;
    float cut_radius = sqrt(max(size * size - pow(dot(from_centre, slice.xyz), 2.0), 1e-12));
    rim = smoothstep(0.0, 0.14, 1.0 - length(from_centre - dot(from_centre, slice.xyz) * slice.xyz) / cut_radius);
    rim = 0.45 + 0.55 * rim;
  }
  gl_FragDepth = 0.5 - 0.5 * (projectionMatrix[2][2] + projectionMatrix[3][2] / place.z);
  float bright = 0.42 + 0.62 * max(dot(normal, light), 0.0);
  colour = vec4(rim * bright * own, 1.0);
}`;

/** The colours from 0 to 1, also for legends. */
export const rampColour = interpolateViridis;

function rampTexture() {
  const count = 256;
  const bytes = new Uint8Array(4 * count);
  for (let i = 0; i < count; ++i) {
    const { r, g, b } = new THREE.Color(rampColour(i / (count - 1)));
    bytes.set([255 * r, 255 * g, 255 * b, 255], 4 * i);
  }
  const texture = new THREE.DataTexture(bytes, count, 1);
  texture.magFilter = texture.minFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/** The grains of a film in a scene. */
export class Grains {
  /** @param {import("./film.js").Film} film */
  constructor(film) {
    this.film = film;
    this.extremes = film.extremes();
    const geometry = new THREE.BufferGeometry();
    /** @param {number} width */
    const dynamic = (width) =>
      new THREE.BufferAttribute(new Float32Array(width * film.most), width).setUsage(THREE.DynamicDrawUsage);
    geometry.setAttribute("position", dynamic(3));
    geometry.setAttribute("radius", dynamic(1));
    geometry.setAttribute("value", dynamic(1));
    this.cover = new Cover(film.most);
    this.index = new THREE.BufferAttribute(this.cover.seen, 1).setUsage(THREE.DynamicDrawUsage);
    geometry.setIndex(this.index);
    this.material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader,
      fragmentShader,
      uniforms: {
        pixels: { value: 1 },
        ramp: { value: rampTexture() },
        sliced: { value: false },
        slice: { value: new THREE.Vector4() },
      },
    });
    this.points = new THREE.Points(geometry, this.material);
    this.points.frustumCulled = false;
    this.count = 0;
  }

  /**
   * Moves the grains to a time, straight from one frame to the next.
   * @param {number} time
   * @param {string} by "height", "speed", "coordination" or "pull"
   */
  show(time, by) {
    const { part, one, other, share } = this.film.at(time);
    const { low, quantum } = this.film;
    const { position, radius, value } = this.points.geometry.attributes;
    const [places, radii, values] = [position.array, radius.array, value.array];
    for (let axis = 0; axis < 3; ++axis) {
      const from = one.places[axis];
      const to = other.places[axis];
      for (let i = 0; i < part.count; ++i)
        places[3 * i + axis] = low[axis] + quantum * (from[i] + share * (to[i] - from[i]));
    }
    radii.set(part.radii);
    const { height: top, touching: most } = this.extremes;
    for (let i = 0; i < part.count; ++i) {
      if (by === "speed") values[i] = (one.speeds[i] + share * (other.speeds[i] - one.speeds[i])) / 255;
      else if (by === "coordination") values[i] = one.touching[i] / most;
      else if (by === "pull") values[i] = (one.pulls[i] + share * (other.pulls[i] - one.pulls[i])) / 255;
      else values[i] = places[3 * i + 2] / top;
    }
    this.count = part.count;
    for (const attribute of [position, radius, value]) attribute.needsUpdate = true;
    return one;
  }

  /**
   * To be called before every picture, after show(). Gives how many grains are drawn.
   * @param {THREE.PerspectiveCamera} camera
   * @param {number} height of the picture in pixels
   * @param {THREE.Plane | null} plane in the world
   */
  prepare(camera, height, plane) {
    const { pixels, sliced, slice } = this.material.uniforms;
    pixels.value = height;
    sliced.value = plane !== null;
    if (plane) {
      const seen = plane.clone().applyMatrix4(camera.matrixWorldInverse);
      slice.value.set(seen.normal.x, seen.normal.y, seen.normal.z, seen.constant);
    }
    const { attributes } = this.points.geometry;
    const grains = { count: this.count, positions: attributes.position.array, radii: attributes.radius.array };
    const drawn = this.cover.look(camera, grains, plane ? slice.value : null);
    this.index.needsUpdate = true;
    this.points.geometry.setDrawRange(0, drawn);
    return drawn;
  }
}
