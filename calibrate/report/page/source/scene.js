// A film in three dimensions: camera, light, slice. Draws only when something has changed.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Apparatus } from "./apparatus.js";
import { Grains } from "./grains.js";

THREE.ColorManagement.enabled = false; // colours of the page stay as they are

/// Where the camera stands, over the size of what it looks at.
const views = { slanted: [0.9, -1.9, 0.75], front: [0, -2.2, 0.12], side: [2.2, 0, 0.12], top: [0, -0.01, 2.4] };

export class Scene {
  /// Throws if the browser does not draw in three dimensions.
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
    const { centre, across } = this.box(film);
    this.size = Math.max(1.15 * height, 0.55 * this.width(film, centre), 0.9 * across);
    this.apparatus = new Apparatus(0.8 * this.size, centre.clone().setZ(0.5 * height));
    this.scene.add(this.grains.points, this.apparatus.group);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enablePan = this.controls.enableZoom = false;
    // Who scrolls the page does not want to zoom, unless the picture was clicked; who swipes upwards neither.
    canvas.addEventListener("focus", () => (this.controls.enableZoom = true));
    canvas.addEventListener("blur", () => (this.controls.enableZoom = false));
    canvas.style.touchAction = "pan-y";
    this.controls.minDistance = 0.3 * this.size;
    this.controls.maxDistance = 6 * this.size;
    this.controls.target.copy(centre).setZ(0.42 * height);
    this.controls.addEventListener("change", () => this.ask());
    this.plane = null;
    this.colouredBy = "height";
    this.time = film.begin;
    this.pictures = 0;
    this.sharpness = 1;
    this.interval = 0;
    this.look("slanted");
    new ResizeObserver(() => this.resize()).observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.paint());
  }

  /// The middle of the grains as the test begins, seen from above, and their box from corner to corner.
  box(film) {
    const frames = film.reels.flatMap((reel) => reel.frames);
    const first = frames.find(({ phase }) => !phase.startsWith("fill.")) ?? frames.at(-1);
    const sides = [0, 1].map((axis) => {
      let low = Infinity,
        high = -Infinity;
      for (const steps of first.places[axis]) [low, high] = [Math.min(low, steps), Math.max(high, steps)];
      const middle = film.low[axis] + 0.5 * (low + high) * film.quantum,
        width = (high - low) * film.quantum;
      // What stands about the axis does so but for its grains.
      return { middle: Math.abs(middle) < 0.05 * width ? 0 : middle, width };
    });
    return {
      centre: new THREE.Vector3(...sides.map(({ middle }) => middle), 0),
      across: Math.hypot(...sides.map(({ width }) => width)),
    };
  }

  /// How wide the grains lie about it in the end.
  width(film, centre) {
    const last = film.reels.at(-1).frames.at(-1);
    let far = 0;
    for (const axis of [0, 1])
      for (const steps of last.places[axis])
        far = Math.max(far, Math.abs(film.low[axis] + steps * film.quantum - centre.getComponent(axis)));
    return 2 * far;
  }

  look(name) {
    const [x, y, z] = views[name];
    this.camera.position.set(x, y, z).multiplyScalar(this.size).add(this.controls.target);
    this.controls.update();
    this.ask();
  }

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

  slice(on) {
    this.plane = on ? new THREE.Plane(new THREE.Vector3(0, 1, 0), -this.controls.target.y) : null;
    this.apparatus.clip(this.plane);
    this.ask();
  }

  colourBy(what) {
    this.colouredBy = what;
    this.ask();
  }

  show(time) {
    this.time = time;
    this.ask();
  }

  /// Takes the colours of the page, which has to hold the canvas.
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

  /// Takes coarser pictures where one takes too long: `milliseconds` since the last one, 0 when the film stops.
  pace(milliseconds) {
    const tooLong = 80,
      coarsest = 0.5,
      before = this.sharpness;
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
    const { one } = this.grains.show(this.time, this.colouredBy);
    this.apparatus.show(one.walls);
    this.camera.updateMatrixWorld();
    this.drawn = this.grains.prepare(this.camera, this.renderer.domElement.height, this.plane);
    this.renderer.render(this.scene, this.camera);
    ++this.pictures;
  }
}
