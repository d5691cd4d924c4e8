// The end of a film as a still picture, for browsers that do not draw in three dimensions.
import { element } from "./dom.js";
import { rampColour } from "./grains.js";

/** @typedef {import("./film.js").Film} Film */

const [width, height, margin] = [960, 540, 24]; // pixels
const away = [0.4, -0.85, 0.35]; // to the eye, which sees in parallel

/** @type {(one: number[], other: number[]) => number} */
const dot = (one, other) => one.reduce((sum, value, axis) => sum + value * other[axis], 0);

/**
 * The grains of a film's last frame in the order in which they hide each other, from the back to the front: places
 * across and upwards, radius [m], and height as a share of the highest.
 * @param {Pick<Film, "parts" | "low" | "quantum">} film
 */
export function grainsInOrder({ parts, low, quantum }) {
  const { frames, radii } = parts[parts.length - 1];
  const { places } = frames[frames.length - 1];
  const level = Math.hypot(away[0], away[1]);
  const across = [-away[1] / level, away[0] / level, 0];
  const up = [(-away[2] * away[0]) / level, (-away[2] * away[1]) / level, level];
  const grains = Array.from(radii, (radius, i) => {
    const place = places.map((steps, axis) => low[axis] + quantum * steps[i]);
    return { radius, x: dot(place, across), y: dot(place, up), near: dot(place, away), z: place[2] };
  });
  const top = Math.max(...grains.map(({ z }) => z), Number.MIN_VALUE);
  return grains
    .sort((one, other) => one.near - other.near)
    .map(({ x, y, radius, z }) => ({ x, y, radius, share: Math.min(Math.max(z / top, 0), 1) }));
}

/** @param {Film} film */
export function stillPicture(film) {
  const canvas = element("canvas", {
    class: "still",
    width,
    height,
    role: "img",
    "aria-label": "The grains at the end of the confirmed run, in a still picture, coloured by height",
  });
  const pen = canvas.getContext("2d");
  if (!pen) return null;
  const grains = grainsInOrder(film);
  const box = { left: Infinity, right: -Infinity, low: Infinity, high: -Infinity };
  for (const { x, y, radius } of grains) {
    box.left = Math.min(box.left, x - radius);
    box.right = Math.max(box.right, x + radius);
    box.low = Math.min(box.low, y - radius);
    box.high = Math.max(box.high, y + radius);
  }
  const scale = Math.min((width - 2 * margin) / (box.right - box.left), (height - 2 * margin) / (box.high - box.low));
  pen.strokeStyle = "#0008"; // tells a grain from those behind it
  for (const { x, y, radius, share } of grains) {
    pen.beginPath();
    const column = width / 2 + scale * (x - (box.left + box.right) / 2);
    pen.arc(column, height / 2 - scale * (y - (box.low + box.high) / 2), scale * radius, 0, 2 * Math.PI);
    pen.fillStyle = rampColour(share);
    pen.fill();
    pen.stroke();
  }
  return canvas;
}
