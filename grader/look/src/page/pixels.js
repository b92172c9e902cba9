// Shows the ray, all answers and the box tests of a pixel. A pixel is selected by a click, by the arrow
// keys, or by the address (#task/case/x,y). Pixels count from the bottom left.

/** The JSON in a script element: base64 of a zlib stream. */
async function unpack(script) {
  const bytes = Uint8Array.from(atob(script.textContent.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).json();
}

/** An element with attributes and children. */
function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, text] of Object.entries(attributes)) made.setAttribute(name, text);
  made.append(...children);
  return made;
}

function drawn(tag, attributes) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, text] of Object.entries(attributes)) made.setAttribute(name, text);
  return made;
}

/** How a walk tested a box: 0 is a miss, 1 a hit, 2 no test. */
const SIGNS = ["○", "●", "–"];

class Pixels {
  constructor(article, viewer, data) {
    Object.assign(this, { article, viewer, data });
    this.rows = new Map(data.calls.map((call, row) => [call, row]));
    this.project = data.walks && projection(data.width, data.height, data.corners);
    this.inspector = article.querySelector(".inspector");
    const { width, height } = data;
    viewer.picked = (x, y) => this.choose(Math.floor(x * width), height - 1 - Math.floor(y * height));
    viewer.stepped = (x, y) => {
      const [column, row] = this.pixel ?? [width >> 1, height >> 1];
      this.choose(Math.min(Math.max(column + x, 0), width - 1), Math.min(Math.max(row + y, 0), height - 1));
    };
    for (const button of article.querySelectorAll("button[data-cause]")) {
      button.addEventListener("click", () => this.next(Number(button.dataset.cause)));
    }
  }

  /** Selects the next pixel with records and this cause. */
  next(cause) {
    const [x, y] = this.pixel ?? [-1, 0];
    const here = y * this.data.width + x;
    const calls = this.data.calls.filter((call) => this.data.causes[call] === cause);
    const call = calls.find((call) => call > here) ?? calls[0];
    if (call !== undefined) this.choose(call % this.data.width, Math.floor(call / this.data.width));
  }

  /** Selects and shows the pixel in column x and row y. */
  choose(x, y) {
    const { width, height } = this.data;
    if (!(x >= 0 && x < width && y >= 0 && y < height)) return;
    this.pixel = [x, y];
    history.replaceState(null, "", `#${this.article.id}/${x},${y}`);
    const call = y * width + x;
    const row = this.rows.get(call);
    const walk = this.data.walks?.[row] ?? [];
    const swatches = element("p", { class: "colours" }, ...["golden", "actual"].map((who, i) => this.swatch(who, this.data.names[i], x, y)));
    if (row === undefined) {
      const cause = this.data.causes[call];
      const heading = element("h4", {}, `Pixel ${x}, ${y}: ${cause ? this.data.labels[cause] : "no known difference"}`);
      const why = cause ? [element("p", { class: "note" }, this.data.noRecords)] : [];
      this.inspector.replaceChildren(heading, swatches, ...why);
      return this.draw([], -1);
    }
    const record = element("div");
    record.innerHTML = this.data.html[row];
    record.querySelector("h4").after(swatches);
    const { panel, go } = this.walk(walk);
    this.inspector.replaceChildren(record, panel);
    if (walk.length) go(walk.length - 1);
    else this.draw(walk, -1);
  }

  /** A square in the pixel's colour, cut out of the picture, and whose it is. */
  swatch(who, name, x, y) {
    const { width, height } = this.data;
    const size = 40;
    const square = element("span", { class: "swatch", role: "img", "aria-label": `colour of the ${name} pixel` });
    square.style.backgroundImage = `url(${this.article.querySelector(`img[data-who=${who}]`).src})`;
    square.style.backgroundSize = `${width * size}px ${height * size}px`;
    square.style.backgroundPosition = `${-x * size}px ${-(height - 1 - y) * size}px`;
    return element("span", {}, square, ` ${name} `);
  }

  /** Marks the pixel, and draws the box of a step with those that contain it. */
  draw(walk, at) {
    const { height, boxes } = this.data;
    const [x, y] = this.pixel;
    const shown = [];
    for (let i = at, above = Infinity; i >= 0; i--) {
      const box = boxes[walk[i][0]];
      if (box.depth >= above || (i < at && !contains(box.corners, boxes[walk[at][0]].corners))) continue;
      above = box.depth;
      shown.unshift({ ...box, chosen: i === at, hit: walk[i][2] === 1 });
    }
    const lines = (box) => edges(box.corners).map((ends) => ends.map(this.project)).filter((ends) => ends.every(Boolean));
    const point = ([x, y]) => `${x + 0.5} ${height - (y + 0.5)}`;
    for (const screen of this.viewer.screens) {
      const spot = { class: "spot", x, y: height - 1 - y, width: 1, height: 1 };
      const wires = !this.project ? [] : shown.map((box) => drawn("path", {
        class: `box ${box.chosen ? "chosen" : ""} ${box.hit ? "" : "missed"}`,
        d: lines(box).map(([from, to]) => `M${point(from)}L${point(to)}`).join(""),
      }));
      screen.querySelector("svg").replaceChildren(...wires, drawn("rect", spot), drawn("rect", spot));
    }
  }

  /** The box tests, with a slider that steps through them: the element, and how to go to a step. */
  walk(walk) {
    if (!walk.length) return { panel: element("p", { class: "note" }, "Box tests: none in this task.") };
    const [golden, actual] = this.data.names;
    const count = (side) => walk.filter((step) => step[side] < 2).length;
    const items = walk.map((step) => {
      const { depth, leaf } = this.data.boxes[step[0]];
      const text = `${SIGNS[step[1]]} ${SIGNS[step[2]]}  box ${step[0]}${leaf === null ? "" : `, leaf of ${leaf}`}`;
      const item = element("li", { class: step[1] === step[2] ? "" : "differs" }, text);
      item.style.setProperty("--depth", depth);
      return item;
    });
    const list = element("ol", { class: "visits" }, ...items);
    const slider = element("input", { type: "range", min: 0, max: walk.length - 1, value: walk.length - 1, "aria-label": "step of the traversal" });
    const label = element("output");
    const go = (at) => {
      slider.value = at;
      label.textContent = `step ${at + 1} of ${walk.length}`;
      items.forEach((item, i) => item.classList.toggle("now", i === at));
      list.scrollTop = items[at].offsetTop - list.clientHeight / 2;
      this.draw(walk, at);
    };
    slider.addEventListener("input", () => go(Number(slider.value)));
    items.forEach((item, i) => item.addEventListener("click", () => go(i)));
    const step = (by, text) => {
      const button = element("button", { type: "button" }, text);
      button.addEventListener("click", () => go(Math.min(Math.max(Number(slider.value) + by, 0), walk.length - 1)));
      return button;
    };
    const head = element("p", {}, `Box tests: ${golden} needs ${count(1)}, ${actual} makes ${count(2)}.`);
    const note = element("p", { class: "note" },
      `Left the tests that the ${golden} hit needs (the nearer child first, no box beyond the hit), right the ${actual} ones; ● is a hit, ○ a miss, – no test.`);
    const controls = element("p", { class: "steps" }, step(-1, "‹"), slider, step(1, "›"), label);
    return { panel: element("div", { class: "walk" }, head, note, controls, list), go };
  }
}

const viewers = new Map();
const pixels = new Map();
const ready = Promise.all([...document.querySelectorAll(".viewer")].map(async (root) => {
  const viewer = new Viewer(root);
  const article = root.closest(".picture");
  viewers.set(article, viewer);
  const script = article.querySelector("script.pixels");
  if (script) pixels.set(article.id, new Pixels(article, viewer, await unpack(script)));
}));

/** Selects the pixel in the page's address. */
async function follow() {
  const [, id, x, y] = decodeURIComponent(location.hash).match(/^#(.*)\/(\d+),(\d+)$/) ?? [];
  await ready;
  const picture = pixels.get(id);
  if (!picture) return;
  picture.article.scrollIntoView();
  picture.choose(Number(x), Number(y));
}
addEventListener("hashchange", follow);
follow();
