// A film in three dimensions: camera, light, slice. Draws only when something has changed.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Apparatus } from "./apparatus.js";
import { Grains } from "./grains.js";

THREE.ColorManagement.enabled = false; // colours of the page stay as they are

/**
 * Where the camera stands, over the size of what it looks at.
 * @type {Record<string, [number, number, number]>}
 */
const views = { slanted: [0.9, -1.9, 0.75], front: [0, -2.2, 0.12], side: [2.2, 0, 0.12], top: [0, -0.01, 2.4] };

export class Scene {
  /**
   * Throws if the browser does not draw in three dimensions.
   * @param {HTMLCanvasElement} canvas
   * @param {import("./film.js").Film} film
   */
  constructor(canvas, film) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: false, preserveDrawingBuffer: true });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.localClippingEnabled = true;
    this.camera = new THREE.PerspectiveCamera(32, 1, 0.01, 20);
    this.camera.up.set(0, 0, 1);
    this.scene = new THREE.Scene();
    this.grains = new Grains(film);
    const { height } = this.grains.extremes;
    const { centre, across } = film.box();
    const [x, y] = centre;
    this.size = Math.max(1.15 * height, 1.1 * film.reach(centre), 0.9 * across);
    this.apparatus = new Apparatus(0.8 * this.size, new THREE.Vector3(x, y, 0.5 * height));
    this.scene.add(this.grains.points, this.apparatus.group);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enablePan = this.controls.enableZoom = false;
    // Who scrolls the page does not want to zoom, unless the picture was clicked; who swipes upwards neither.
    canvas.addEventListener("focus", () => (this.controls.enableZoom = true));
    canvas.addEventListener("blur", () => (this.controls.enableZoom = false));
    canvas.style.touchAction = "pan-y";
    this.controls.minDistance = 0.3 * this.size;
    this.controls.maxDistance = 6 * this.size;
    this.controls.target.set(x, y, 0.42 * height);
    this.controls.addEventListener("change", () => this.ask());
    /** @type {THREE.Plane | null} */
    this.plane = null;
    this.colouredBy = "height";
    this.time = film.begin;
    this.pictures = 0; // drawn so far
    this.drawn = 0; // grains in the last one
    this.asked = 0; // for a picture that is still to come
    this.sharpness = 1;
    this.interval = 0;
    this.look("slanted");
    new ResizeObserver(() => this.resize()).observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.paint());
  }

  /** @param {string} name of a view */
  look(name) {
    const [x, y, z] = views[name];
    this.camera.position.set(x, y, z).multiplyScalar(this.size).add(this.controls.target);
    this.controls.update();
    this.ask();
  }

  /**
   * @param {number} around angle [rad]
   * @param {number} up
   */
  turn(around, up) {
    const from = this.camera.position.clone().sub(this.controls.target);
    const round = new THREE.Spherical().setFromVector3(new THREE.Vector3(from.x, from.z, -from.y));
    round.theta += around;
    round.phi = Math.min(Math.max(round.phi - up, 0.05), Math.PI - 0.05);
    const to = new THREE.Vector3().setFromSpherical(round);
    this.camera.position.copy(this.controls.target).add(new THREE.Vector3(to.x, -to.z, to.y));
    this.controls.update();
    this.ask();
  }

  /** @param {boolean} on */
  slice(on) {
    this.plane = on ? new THREE.Plane(new THREE.Vector3(0, 1, 0), -this.controls.target.y) : null;
    this.apparatus.clip(this.plane);
    this.ask();
  }

  /** @param {string} what */
  colourBy(what) {
    this.colouredBy = what;
    this.ask();
  }

  /** @param {number} time */
  show(time) {
    this.time = time;
    this.ask();
  }

  /** Takes the colours of the page, which has to hold the canvas. */
  paint() {
    const style = getComputedStyle(this.canvas);
    this.renderer.setClearColor(style.getPropertyValue("--stage").trim());
    this.apparatus.paint(style.getPropertyValue("--glass").trim(), style.getPropertyValue("--edge").trim());
    this.ask();
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0) return;
    this.renderer.setPixelRatio(this.sharpness * Math.min(devicePixelRatio, 2));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    // A narrow picture shows as much of the width as a square one.
    this.camera.fov = 32 * Math.max(1, 1.25 / this.camera.aspect);
    this.camera.updateProjectionMatrix();
    this.paint();
  }

  /**
   * Takes coarser pictures where one takes too long.
   * @param {number} milliseconds since the last one, 0 when the film stops
   */
  pace(milliseconds) {
    const tooLong = 80;
    const coarsest = 0.5;
    const before = this.sharpness;
    this.interval = milliseconds > 0 ? 0.7 * this.interval + 0.3 * milliseconds : 0;
    if (milliseconds === 0) this.sharpness = 1;
    else if (this.interval > tooLong) this.sharpness = Math.max(coarsest, 0.8 * this.sharpness);
    if (this.sharpness === before) return;
    this.interval = 0;
    this.resize();
  }

  ask() {
    if (this.asked) return;
    this.asked = requestAnimationFrame(() => {
      this.asked = 0;
      this.draw();
    });
  }

  draw() {
    const frame = this.grains.show(this.time, this.colouredBy);
    this.apparatus.show(frame.walls);
    this.camera.updateMatrixWorld();
    this.drawn = this.grains.prepare(this.camera, this.renderer.domElement.height, this.plane);
    this.renderer.render(this.scene, this.camera);
    ++this.pictures;
  }
}
