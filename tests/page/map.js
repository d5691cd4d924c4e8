// The picture of what readings leave open, from the page of a calibration: node map.js PAGE PICTURE.jpg
import { drawn, filmIsThere, openBrowser, openPage } from "./browser.js";

const [page, picture] = process.argv.slice(2);
const browser = await openBrowser();
const shown = await openPage(browser, page, { viewport: { width: 860, height: 900 }, colorScheme: "light" });
await filmIsThere(shown);
await drawn(shown);
await shown.locator("#open figure").screenshot({ path: picture, type: "jpeg", quality: 80 });
await browser.close();
