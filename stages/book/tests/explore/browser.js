// Uses every explorable figure in headless Chromium as readers do: mouse, touch, keyboard, narrow
// screens, dark and light, print, without script. Reads the numbers that it then shows.
// Usage: node browser.js [FIGURE...]; with EXPLORE_PICTURES=FOLDER it saves pictures to look at.
"use strict";
const assert = require("node:assert/strict");
const { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } = require("node:fs");
const { tmpdir } = require("node:os");
const { join } = require("node:path");
const { pathToFileURL } = require("node:url");
const { Browser } = require("./chromium.js");

const source = join(__dirname, "../../src");

// The figures of the chapters, by name, as HTML of a page: picture and caption as they are there.
function figures() {
  const found = new Map();
  for (const part of readdirSync(source).filter((name) => /^part\d$/.test(name))) {
    for (const file of readdirSync(join(source, part))) {
      const text = readFileSync(join(source, part, file), "utf8");
      for (const [, name, body] of text.matchAll(/<figure class="explore" data-explore="(\w+)">(.*?)<\/figure>/gs)) {
        const html = body.replace(/!\[(.*?)\]\((.*?)\)/, (_, alt, image) => {
          return `<p><img alt="${alt}" src="${pathToFileURL(join(source, part, image))}"></p>`;
        });
        found.set(name, html);
      }
    }
  }
  return found;
}

function page(name, body) {
  return `<!doctype html><html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width,initial-scale=1"><title>${name}</title>
<style>body{margin:0;font:17px/1.55 system-ui}main{max-width:46rem;margin:0 auto;padding:1rem}img{max-width:100%}
@media(prefers-color-scheme:dark){body{background:#16181d;color:#e6e6e6}}</style></head><body><main>
<p>Before.</p><figure class="explore" data-explore="${name}">${body}</figure><p>After.</p></main>
<script src="${pathToFileURL(join(source, "explore/explore.js"))}" defer></script></body></html>`;
}

const SHOWN = (selector) => `(() => {
  const element = document.querySelector(${JSON.stringify(selector)});
  return Boolean(element) && element.getClientRects().length > 0;
})()`;

// What a reader sees: the numbers of the table, the sentence, the state.
class Figure {
  constructor(tab) {
    this.tab = tab;
  }

  says() {
    return this.tab.value("document.querySelector('.explore-says').textContent");
  }

  // The cells of the row that begins with `name`.
  row(name) {
    return this.tab.value(`[...document.querySelectorAll('.explore-live tbody tr')]
      .map((row) => [...row.cells].map((cell) => cell.textContent))
      .find((cells) => cells[0] === ${JSON.stringify(name)}).slice(1)`);
  }

  state(key) {
    return this.tab.value(`document.querySelector('figure').explore.state[${JSON.stringify(key)}]`);
  }

  // The middle of a point on the screen, and the pixels of one unit.
  point(key) {
    return this.tab.value(`(() => {
      const handle = document.querySelector('[data-point="${key}"]');
      handle.closest('svg').scrollIntoView({ block: 'center' });
      const { x, y, width, height } = handle.querySelector('.ring').getBoundingClientRect();
      const stage = document.querySelector('figure').explore.stages.find((s) => s.svg.contains(handle));
      return { x: x + width / 2, y: y + height / 2, scale: stage.scale };
    })()`);
  }

  async drag(key, dx, dy) {
    const { x, y, scale } = await this.point(key);
    const to = [x + dx * scale[0], y - dy * scale[1]];
    await this.tab.mouse("mousePressed", x, y);
    await this.tab.mouse("mouseMoved", (x + to[0]) / 2, (y + to[1]) / 2);
    await this.tab.mouse("mouseMoved", ...to);
    await this.tab.mouse("mouseReleased", ...to);
  }

  async swipe(key, dx, dy) {
    const { x, y, scale } = await this.point(key);
    const to = [x + dx * scale[0], y - dy * scale[1]];
    await this.tab.touch("touchStart", [[x, y]]);
    await this.tab.touch("touchMove", [[(x + to[0]) / 2, (y + to[1]) / 2]]);
    await this.tab.touch("touchMove", [to]);
    await this.tab.touch("touchEnd", []);
  }

  // Goes with the Tab key to the element that the selector finds.
  async tabTo(selector) {
    const found = `document.activeElement?.matches(${JSON.stringify(selector)})`;
    for (let i = 0; i < 60 && !(await this.tab.value(found)); i++) await this.tab.key("Tab");
    assert.ok(await this.tab.value(found), `the Tab key does not reach ${selector}`);
  }

  async keys(selector, key, times = 1, shift = false) {
    await this.tabTo(selector);
    for (let i = 0; i < times; i++) await this.tab.key(key, shift);
  }

  async choose(key, option) {
    const selector = `input[data-key="${key}"][value="${option}"]`;
    await this.tab.value(`document.querySelector(${JSON.stringify(selector)}).click()`);
  }

  press(words) {
    return this.tab.value(`[...document.querySelectorAll('.explore-live button')]
      .find((button) => button.textContent.includes(${JSON.stringify(words)})).click()`);
  }
}

// For each figure: what a reader does, and the numbers that must come of it.
const USES = {
  async triangle(figure) {
    assert.deepEqual(await figure.row("t"), ["2", "2"]);
    await figure.drag("p", 4, 0);
    assert.deepEqual(await figure.state("p"), [5, 2]);
    assert.deepEqual(await figure.row("b0"), ["-0.75", "-0.75"]);
    assert.match(await figure.says(), /a miss, b0 is negative/);
    await figure.choose("rule", "wedge");
    assert.match(await figure.says(), /This code answers: a hit, ✗ wrong/);
    await figure.press("Reset");
    assert.match(await figure.says(), /a hit at t = 2\./);
    await figure.choose("rule", "epsilon");
    await figure.keys('input[data-key="scale"]', "Home");
    assert.match(await figure.says(), /This code answers: a miss, ✗ wrong/);
    await figure.press("Reset");
    await figure.choose("side", "back");
    await figure.choose("rule", "culls");
    assert.match(await figure.says(), /a miss, ✗ wrong/);
    assert.deepEqual(await figure.row("D"), ["-32", "-32"]);
  },

  async sphere(figure) {
    await figure.keys('input[data-key="exponent"]', "End");
    assert.match((await figure.row("remedied"))[1], /all/);
    await figure.keys('input[data-key="exponent"]', "ArrowLeft", 8);
    assert.match(await figure.row("textbook").then((row) => row[1]), /^[5-9]$|none/);
    await figure.keys('input[data-key="beside"]', "End");
    assert.match(await figure.says(), /The ray misses/);
  },

  async slabs(figure) {
    assert.match(await figure.says(), /from t = 1 to 2/);
    assert.deepEqual(await figure.row("y"), ["3", "-1", "-1", "3"]);
    await figure.press("Along a face");
    assert.deepEqual(await figure.row("y"), ["-Infinity", "⚠ 0/0 = NaN", "-∞", "∞"]);
    assert.equal(await figure.tab.value("document.querySelectorAll('.is-loud').length"), 1);
    await figure.choose("rule", "nan");
    assert.match(await figure.says(), /This code: a miss, ✗ wrong/);
    await figure.press("Reset");
    await figure.drag("tip", 0, 0.5);
    await figure.choose("rule", "zero");
    assert.match(await figure.says(), /✓ the same here/);
    await figure.keys('input[data-key="minus"]', " ");
    assert.match(await figure.says(), /This code: a miss, ✗ wrong/);
  },

  async traversal(figure) {
    await figure.press("To the end");
    assert.deepEqual([await figure.row("box tests"), await figure.row("leaves tested")], [["7"], ["3: D, E, F"]]);
    assert.match(await figure.says(), /that of F, at 4\.5\. ✓/);
    await figure.choose("code", "far");
    await figure.press("To the end");
    assert.deepEqual(await figure.row("leaves tested"), ["4: G, F, E, D"]);
    await figure.choose("code", "stop");
    await figure.press("To the end");
    assert.match(await figure.says(), /✗ The closest hit is at 4\.5/);
    await figure.press("Reset");
    await figure.press("Step");
    assert.match(await figure.says(), /Step 2 of 10/);
  },

  async build(figure) {
    assert.match(await figure.says(), /tests 2\.279 primitives/);
    await figure.press("smallest K");
    assert.match(await figure.says(), /★/);
    await figure.drag("m", -30, 0);
    assert.match(await figure.says(), /✗ One side is empty/);
    await figure.press("Reset");
    await figure.keys('[data-point="c6"]', "ArrowLeft", 1, true);
    assert.deepEqual(await figure.state("c6"), [16, 1]);
  },

  async warp(figure) {
    assert.deepEqual(await figure.row("direction z"), ["0.8660254037844386"]);
    await figure.choose("code", "plain");
    assert.match(await figure.says(), /^✗ χ² is/);
    await figure.drag("u", 0.5, 0.25);
    assert.deepEqual(await figure.row("u"), ["0.75, 0.375"]);
    await figure.keys('input[data-key="power"]', "End");
    assert.deepEqual(await figure.row("expected in a cell"), ["128"]);
  },

  async pixel(figure) {
    assert.deepEqual(await figure.row("exact mean I"), ["0.25"]);
    await figure.drag("b", 0.25, 0);
    await figure.drag("a", 0.25, 0);
    assert.deepEqual(await figure.row("exact mean I"), ["0.5"]);
    await figure.choose("code", "same");
    assert.match(await figure.says(), /^✗ All 64 samples/);
    await figure.keys('input[data-key="power"]', "Home");
    assert.match(await figure.says(), /^One sample is in the centre/);
  },

  async camera(figure) {
    assert.deepEqual(await figure.row("d"), ["0.894427, 0, 0.447214"]);
    await figure.drag("uv", 0.25, 0.5);
    assert.deepEqual(await figure.row("q"), ["1, 0.57735, -1"]);
    await figure.choose("code", "degrees");
    assert.match(await figure.says(), /^✗ The ray of this code is/);
    await figure.choose("code", "right");
    await figure.keys('input[data-key="alpha"]', "End");
    assert.deepEqual(await figure.row("a = tan α/2"), ["57.289961630759144"]);
  },

  async lamp(figure) {
    assert.deepEqual(await figure.row("right value"), ["0.5879", "0.5879"]);
    assert.equal((await figure.row("black samples"))[1], "0");
    await figure.choose("shadow", "lamp");
    assert.deepEqual((await figure.row("estimate"))[1], "0.000");
    await figure.choose("shadow", "right");
    await figure.keys('input[data-key="isThere"]', " ");
    await figure.drag("plate", -1.5, 0);
    assert.deepEqual(await figure.row("right value"), ["0.000", "0.000"]);
    await figure.choose("shadow", "none");
    assert.match(await figure.says(), /✗ The plate casts no shadow/);
    await figure.keys('[data-point="lamp"]', "ArrowRight", 1, true);
    assert.deepEqual(await figure.state("lamp"), [1, 2]);
  },

  async stopping(figure) {
    assert.match(await figure.says(), /black for ever\. ✗ At the end, \d\d % of the light is missing/);
    await figure.choose("rule", "sure");
    assert.deepEqual(await figure.row("black for ever"), ["0"]);
    assert.match(await figure.says(), /^0 of 128 pixels have stopped\.$/);
    await figure.keys('input[data-key="batches"]', "End");
    assert.deepEqual(await figure.row("samples so far"), ["2048"]);
    const [mean] = await figure.row("mean of all pixels");
    assert.ok(Math.abs(Number(mean) - 1) < 0.1, `the mean without a bias is ${mean}`);
  },

  async glass(figure) {
    assert.deepEqual((await figure.row("F"))[1], "0.04389473600");
    await figure.drag("o", 0, -1.6);
    assert.match(await figure.says(), /^Total internal reflection/);
    assert.deepEqual(await figure.row("F"), ["⚠ NaN", "1.000000000"]);
    await figure.choose("code", "oneEta");
    assert.match(await figure.says(), /✗ This code sends the light elsewhere/);
    await figure.keys('input[data-key="ior"]', "Home");
    assert.match(await figure.says(), /✓ the same here/);
  },
};

async function use(browser, name, url) {
  // Mouse and keyboard.
  const wide = await browser.open(url);
  await wide.until("Boolean(document.querySelector('.explore-ready'))");
  assert.ok(USES[name], `browser.js does not use the figure ${name}: add what a reader does with it`);
  await USES[name](new Figure(wide));
  assert.deepEqual(wide.complaints, []);
  await wide.close();

  // Every point with arrow keys, and every control has a name and can be reached.
  const keyboard = new Figure(await browser.open(url));
  await keyboard.tab.until("Boolean(document.querySelector('.explore-ready'))");
  const points = await keyboard.tab.value("[...document.querySelectorAll('[data-point]')].map((e) => [e.dataset.point, e.getAttribute('aria-label')])");
  for (const [key, label] of points) {
    assert.ok(label, `${name}: the point ${key} has no name`);
    const before = await keyboard.state(key);
    const horizontal = await keyboard.keys(`[data-point="${key}"]`, "ArrowRight").then(() => keyboard.state(key));
    await keyboard.keys(`[data-point="${key}"]`, "ArrowUp");
    const after = await keyboard.state(key);
    assert.ok(horizontal[0] > before[0] || after[1] > before[1], `${name}: arrow keys do not move ${key}`);
    const told = await keyboard.tab.value(`document.querySelector('[data-point="${key}"]').getAttribute('aria-valuetext')`);
    assert.ok(told.includes(String(after[0])), `${name}: a screen reader hears ${told} of ${key}, which is at ${after}`);
  }
  const nameless = await keyboard.tab.value(`[...document.querySelectorAll('.explore-live :is(input, button)')]
    .filter((e) => !(e.labels?.[0]?.textContent.trim() || e.textContent.trim())).length`);
  assert.equal(nameless, 0, `${name}: controls without a name`);
  const unnamed = await keyboard.tab.value("[...document.querySelectorAll('.explore-stage')].filter((e) => !e.querySelector('title').textContent).length");
  assert.equal(unnamed, 0, `${name}: drawings without a title`);
  await keyboard.tab.close();

  for (const width of [1280, 390]) {
    for (const dark of [false, true]) {
      const tab = await browser.open(url, { width, dark });
      await tab.until("Boolean(document.querySelector('.explore-ready'))");
      assert.ok((await tab.value("document.documentElement.scrollWidth - innerWidth")) <= 0, `${name}: wider than ${width}`);
      const stays = await tab.value(`Boolean(Explore.figures[${JSON.stringify(name)}].keepsPicture)`);
      assert.equal(await tab.value(SHOWN("figure img")), stays, `${name}: the picture is shown: ${!stays}`);
      // Colours against the paper, at least 4.5 to 1, as WCAG asks of text.
      const weak = await tab.value(`(() => {
        const style = getComputedStyle(document.querySelector('figure'));
        const light = (hex) => {
          const full = hex.length === 4 ? hex.replace(/[0-9a-f]/g, '$&$&') : hex;
          const [r, g, b] = full.match(/[0-9a-f]{2}/g).map((c) => parseInt(c, 16) / 255)
            .map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
          return 0.2126 * r + 0.7152 * g + 0.0722 * b;
        };
        const of = (name) => light(style.getPropertyValue('--ex-' + name).trim());
        return ['ink', 'soft', 'blue', 'orange', 'green', 'red', 'purple'].filter((name) => {
          const [a, b] = [of(name), of('paper')].sort((a, b) => b - a);
          return (a + 0.05) / (b + 0.05) < 4.5;
        });
      })()`);
      assert.deepEqual(weak, [], `${name}: weak colours, dark ${dark}`);
      if (width === 390 && points.length > 0) {
        const touched = new Figure(tab);
        const [key] = points.at(-1);
        const before = await touched.state(key);
        const { scale } = await touched.point(key);
        await touched.swipe(key, -40 / scale[0], 0);
        const after = await touched.state(key);
        assert.ok(after[0] < before[0], `${name}: a finger does not move ${key}`);
      }
      if (process.env.EXPLORE_PICTURES) {
        const file = join(process.env.EXPLORE_PICTURES, `${name}-${width}-${dark ? "dark" : "light"}.png`);
        writeFileSync(file, await tab.picture("figure"));
      }
      assert.deepEqual(tab.complaints, []);
      await tab.close();
    }
  }

  // On paper and without script there is the picture, and nothing to press.
  for (const setting of [{ media: "print" }, { script: false }]) {
    const tab = await browser.open(url, setting);
    if (setting.media) await tab.until("Boolean(document.querySelector('.explore-ready'))");
    const { root } = await tab.send("DOM.getDocument");
    const { nodeId } = await tab.send("DOM.querySelector", { nodeId: root.nodeId, selector: "figure img" });
    const { model } = await tab.send("DOM.getBoxModel", { nodeId });
    assert.ok(model.width > 100, `${name}: no picture with ${JSON.stringify(setting)}`);
    if (setting.media) assert.equal(await tab.value(SHOWN(".explore-live")), false, `${name}: controls on paper`);
    await tab.close();
  }
}

async function main() {
  const all = figures();
  assert.ok(all.size > 0, "the chapters show no explorable figure");
  const wanted = process.argv.length > 2 ? process.argv.slice(2) : [...all.keys()];
  const folder = mkdtempSync(join(tmpdir(), "explore-pages-"));
  const browser = await Browser.start();
  let failures = 0;
  for (const name of wanted) {
    const file = join(folder, `${name}.html`);
    writeFileSync(file, page(name, all.get(name)));
    try {
      await use(browser, name, String(pathToFileURL(file)));
      console.log(`${name}: used`);
    } catch (error) {
      failures += 1;
      console.error(`${name}: ${error.stack}`);
    }
  }
  await browser.stop();
  rmSync(folder, { recursive: true });
  console.log(`${wanted.length - failures} passed, ${failures} failed`);
  return failures;
}

main().then(
  (failures) => process.exit(failures > 0 ? 1 : 0),
  (error) => {
    console.error(error);
    process.exit(1);
  },
);
