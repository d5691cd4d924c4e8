// The picture of the README, from the page of a calibration: node picture.js PAGE PICTURE.jpg
//
// On the left the grains, cut open, while the mould is lifted, and in the end; on the right the drawing of the heap.
import { drawn, filmIsThere, openBrowser, openPage } from "./browser.js";

const [page, picture] = process.argv.slice(2);
const browser = await openBrowser();
const shown = await openPage(browser, page, { viewport: { width: 1200, height: 560 }, colorScheme: "light" });
await filmIsThere(shown);
await shown.evaluate(() => {
  const { player } = document.getElementsByClassName("player")[0];
  const frame = document.createElement("div");
  frame.style.cssText =
    "position:fixed;inset:0;z-index:9;background:var(--card);display:grid;" +
    "grid-template-columns:290px 290px 1fr;gap:12px;padding:12px;align-items:start";
  /** @param {number} time */
  const still = (time) => {
    player.show(time);
    player.scene.resize();
    player.scene.draw();
    const image = new Image();
    image.src = player.canvas.toDataURL();
    image.style.cssText = "width:100%;border-radius:8px";
    return image;
  };
  Object.assign(player.canvas.style, { width: "290px", height: "530px" });
  const { camera, controls } = player.scene;
  camera.position.sub(controls.target).multiplyScalar(0.62).add(controls.target);
  player.scene.slice(true);
  const [lift] = player.film.phases().filter(({ name }) => name === "step1.lift");
  const [drawing] = document.getElementsByClassName("test-drawing");
  frame.append(still(lift.begin + 0.45 * (lift.end - lift.begin)), still(player.film.end), drawing);
  frame.querySelector("figcaption")?.remove(); // the README has its own
  document.body.append(frame);
});
await shown.waitForTimeout(500);
await drawn(shown);
await shown.screenshot({ path: picture, type: "jpeg", quality: 82 });
await browser.close();
