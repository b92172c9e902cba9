// Explorable figures of the book: what all of them share.
//
// A page that has `<figure class="explore" data-explore="NAME">` needs one line,
// `<script src="explore/explore.js" defer></script>`. This file loads explore.css, NAME.js and the
// parts that NAME.js names, from its own folder; it works from a disk and asks no server. Without
// script, in print, or if a file is missing, the picture in the figure stays.
//
// NAME.js calls `Explore.figure(NAME, {needs, kernels, start})`. `start(ui)` makes the controls and
// sets `ui.render`, which draws everything from `ui.state`. With `keepsPicture` the picture stays
// above, because the chapter speaks of what only it shows. What a figure draws as right comes from
// exact fractions (exact.js). Numbers in `kernels` have the bits of the course's Rust code:
// stages/book/tests/explore compares them.
(function () {
  "use strict";

  const figures = {};
  const parts = {};
  const page = typeof document === "undefined" ? null : document;
  const script = page && page.currentScript;
  const folder = script && script.src ? script.src.replace(/[^/]*$/, "") : "";

  const Explore = (globalThis.Explore = {
    figures,
    parts,
    figure(name, figure) {
      figures[name] = figure;
    },
    part(name, part) {
      parts[name] = part;
    },
    text,
  });

  // A float as the shortest decimal that reads back as the same float; -0 keeps its sign.
  function text(x) {
    return Object.is(x, -0) ? "-0" : String(x);
  }

  // ---------------------------------------------------------------- loading

  const loading = {};

  function load(file) {
    loading[file] ??= new Promise((done, failed) => {
      const element = page.createElement("script");
      element.src = folder + file;
      element.onload = done;
      element.onerror = () => failed(new Error(`cannot load ${file}`));
      page.head.append(element);
    });
    return loading[file];
  }

  function loadStyle() {
    if (page.querySelector('link[href*="explore.css"], style[data-explore-style]')) return;
    const link = page.createElement("link");
    link.rel = "stylesheet";
    link.href = folder + "explore.css";
    page.head.append(link);
  }

  async function begin(element) {
    const name = element.dataset.explore;
    try {
      if (!figures[name]) await load(`${name}.js`);
      for (const part of figures[name].needs || []) if (!parts[part]) await load(`${part}.js`);
    } catch (error) {
      // The picture stays.
      console.warn(String(error.message || error));
      return;
    }
    const ui = new Ui(element, name);
    element.explore = ui;
    figures[name].start(ui);
    ui.finish();
  }

  // ---------------------------------------------------------------- elements

  const SVG = "http://www.w3.org/2000/svg";

  function html(tag, attributes = {}, ...children) {
    const element = page.createElement(tag);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    element.append(...children);
    return element;
  }

  function svg(tag, attributes = {}, ...children) {
    const element = page.createElementNS(SVG, tag);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    element.append(...children);
    return element;
  }

  let ids = 0;
  const newId = (kind) => `explore-${kind}-${++ids}`;

  // ---------------------------------------------------------------- one figure

  class Ui {
    constructor(element, name) {
      this.element = element;
      this.name = name;
      this.state = {};
      this.render = () => {};
      this.syncs = [];
      this.stages = [];
      this.live = html("div", { class: "explore-live", role: "group" });
      this.controls = html("div", { class: "explore-controls" });
      this.says = html("p", { class: "explore-says", "aria-live": "polite" });
    }

    // Puts the figure into the page, after `start` has made its parts.
    finish() {
      const caption = this.element.querySelector("figcaption");
      const title = newId("title");
      if (caption) {
        caption.id ||= title;
        this.live.setAttribute("aria-labelledby", caption.id);
      }
      const reset = html("button", { type: "button", class: "explore-reset" }, "Reset");
      reset.addEventListener("click", () => {
        Object.assign(this.state, structuredClone(this.initial));
        this.changed();
      });
      const hint = html(
        "p",
        { class: "explore-hint" },
        "Drag the points, or move to one with the Tab key and press the arrow keys (with Shift: larger steps).",
      );
      if (this.live.querySelector("[data-point]")) this.controls.append(hint);
      this.controls.append(reset);
      this.element.insertBefore(this.live, caption);
      this.element.classList.add("explore-ready");
      this.element.classList.toggle("explore-both", Boolean(figures[this.name].keepsPicture));
      this.initial = structuredClone(this.state);
      // Keys that move a point must not turn the page.
      this.live.addEventListener("keydown", (event) => event.stopPropagation());
      this.live.addEventListener("keyup", (event) => event.stopPropagation());
      new ResizeObserver(() => this.layout()).observe(this.live);
      this.layout();
    }

    layout() {
      const { paddingLeft, paddingRight } = getComputedStyle(this.live);
      const width = Math.floor(this.live.clientWidth - parseFloat(paddingLeft) - parseFloat(paddingRight));
      // In print and in a closed part of a page there is no width.
      if (width < 40 || width === this.width) return;
      this.width = width;
      for (const stage of this.stages) stage.layout(width);
      this.changed();
    }

    changed() {
      for (const sync of this.syncs) sync();
      if (!this.width) return;
      for (const stage of this.stages) stage.clear();
      this.render(this.state);
    }

    set(key, value) {
      this.state[key] = value;
      this.changed();
    }

    // Adds `element` below what is there.
    add(element) {
      this.live.append(element);
      return element;
    }

    // The line that says in words what the figure shows, and below it the controls.
    sentence() {
      this.live.append(this.says, this.controls);
      return (words) => {
        if (this.says.textContent !== words) this.says.textContent = words;
      };
    }

    slider({ key, label, min, max, step, value, format = text, to = this.controls }) {
      this.state[key] = value;
      const id = newId("slider");
      const input = html("input", { type: "range", id, min, max, step, "data-key": key });
      const output = html("output", { for: id });
      input.addEventListener("input", () => this.set(key, Number(input.value)));
      this.syncs.push(() => {
        input.value = this.state[key];
        output.textContent = format(this.state[key]);
        input.setAttribute("aria-valuetext", output.textContent);
      });
      const row = html("div", { class: "explore-slider" }, html("label", { for: id }, label), input, output);
      to.append(row);
      return row;
    }

    choice({ key, label, options, value, to = this.controls }) {
      this.state[key] = value;
      const name = newId("choice");
      const set = html("fieldset", { class: "explore-choice" }, html("legend", {}, label));
      for (const [option, words] of options) {
        const input = html("input", { type: "radio", name, value: option, "data-key": key });
        input.addEventListener("change", () => this.set(key, option));
        this.syncs.push(() => (input.checked = this.state[key] === option));
        set.append(html("label", {}, input, html("span", {}, words)));
      }
      to.append(set);
      return set;
    }

    toggle({ key, label, value, to = this.controls }) {
      this.state[key] = value;
      const input = html("input", { type: "checkbox", "data-key": key });
      input.addEventListener("change", () => this.set(key, input.checked));
      this.syncs.push(() => (input.checked = this.state[key]));
      const row = html("label", { class: "explore-toggle" }, input, html("span", {}, label));
      to.append(row);
      return row;
    }

    // A row of buttons: pairs of words and what a press does.
    buttons(pairs, to = this.controls) {
      const row = html("div", { class: "explore-buttons" });
      const made = pairs.map(([words, press]) => {
        const button = html("button", { type: "button" }, words);
        button.addEventListener("click", () => {
          press();
          this.changed();
        });
        row.append(button);
        return button;
      });
      to.append(row);
      return made;
    }

    // A table of numbers. A cell is a string or {text, mark}; the mark is a class. `parts` instead of
    // `text` are pieces {tag, text}.
    table({ caption, head }) {
      const body = html("tbody");
      const table = html("table", {}, html("caption", {}, caption));
      if (head) {
        const columns = html("tr", {}, ...head.map((words) => html("th", { scope: "col" }, words)));
        table.append(html("thead", {}, columns));
      }
      table.append(body);
      this.add(html("div", { class: "explore-table" }, table));
      return (rows) => body.replaceChildren(...rows.map((row) => tableRow(row)));
    }

    // A drawing; `to` is a row of several, each with a `share` of the width.
    stage({ to = this.live, ...options }) {
      const stage = new Stage(this, options);
      this.stages.push(stage);
      to.append(stage.svg);
      return stage;
    }

    row() {
      return this.add(html("div", { class: "explore-row" }));
    }
  }

  function tableRow(cells) {
    const row = html("tr");
    cells.forEach((cell, i) => {
      const { text: words, mark, parts: pieces } = typeof cell === "object" ? cell : { text: cell };
      const element = i === 0 ? html("th", { scope: "row" }) : html("td");
      if (mark) element.className = `is-${mark}`;
      if (pieces) element.append(...pieces.map((piece) => html(piece.tag || "span", {}, piece.text)));
      else element.textContent = words;
      row.append(element);
    });
    return row;
  }

  // ---------------------------------------------------------------- drawing

  const COLOURS = ["ink", "soft", "blue", "orange", "green", "red", "purple"];

  // A drawing in world coordinates, y up. One unit of it is one CSS pixel, so words stay readable
  // on a narrow screen; the width is that of the page.
  class Stage {
    constructor(ui, { label, x, y, ratio = 0.62, share = () => 1, stretch = false, margin = 14 }) {
      Object.assign(this, { ui, x, y, ratio, share, stretch });
      this.margin = typeof margin === "number" ? [margin, margin, margin, margin] : margin;
      this.id = newId("stage");
      this.title = svg("title", {}, label);
      this.svg = svg("svg", { class: "explore-stage", role: "group" }, this.title, svg("defs"));
      for (const colour of COLOURS) this.svg.querySelector("defs").append(...this.patterns(colour));
      this.back = svg("g", { "aria-hidden": "true" });
      this.front = svg("g");
      this.svg.append(this.back, this.front);
      this.handles = [];
    }

    // Hatching in two directions, and dots: what a colour says, these say, too.
    patterns(colour) {
      const pattern = (kind, size, shape) =>
        svg(
          "pattern",
          { id: `${this.id}-${kind}-${colour}`, width: size, height: size, patternUnits: "userSpaceOnUse" },
          svg(shape.tag, { ...shape.at, class: `p-${shape.tag === "path" ? "line" : "dot"} c-${colour}` }),
        );
      return [
        pattern("hatch", 8, { tag: "path", at: { d: "M-1 9L9 -1M-1 1L1 -1M7 9L9 7" } }),
        pattern("back", 8, { tag: "path", at: { d: "M-1 -1L9 9M-1 7L1 9M7 -1L9 1" } }),
        pattern("dots", 7, { tag: "circle", at: { cx: 3.5, cy: 3.5, r: 1.3 } }),
      ];
    }

    layout(width) {
      const ratio = typeof this.ratio === "function" ? this.ratio(width) : this.ratio;
      this.w = Math.floor(width * this.share(width));
      this.h = Math.round(this.w * ratio);
      this.svg.setAttribute("viewBox", `0 0 ${this.w} ${this.h}`);
      this.svg.setAttribute("width", this.w);
      this.svg.setAttribute("height", this.h);
      this.fit();
    }

    // The map from the ranges `x` and `y` to the page.
    fit() {
      const [top, right, bottom, left] = this.margin;
      const width = this.w - left - right;
      const height = this.h - top - bottom;
      let sx = width / (this.x[1] - this.x[0]);
      let sy = height / (this.y[1] - this.y[0]);
      if (!this.stretch) sx = sy = Math.min(sx, sy);
      if (this.aspect) {
        sx = Math.min(sx, sy * this.aspect);
        sy = sx / this.aspect;
      }
      this.scale = [sx, sy];
      this.origin = [
        left + 0.5 * (width - sx * (this.x[1] - this.x[0])) - sx * this.x[0],
        this.h - bottom - 0.5 * (height - sy * (this.y[1] - this.y[0])) + sy * this.y[0],
      ];
    }

    // Makes a unit of x so many times as long as one of y.
    setAspect(aspect) {
      this.aspect = aspect;
      this.fit();
      for (const handle of this.handles) handle.place();
    }

    at([x, y]) {
      return [this.origin[0] + this.scale[0] * x, this.origin[1] - this.scale[1] * y];
    }

    world([px, py]) {
      return [(px - this.origin[0]) / this.scale[0], (this.origin[1] - py) / this.scale[1]];
    }

    clear() {
      this.back.replaceChildren();
      for (const handle of this.handles) handle.place();
    }

    shape(tag, attributes, style) {
      this.back.append(svg(tag, { ...attributes, class: classes(style), ...this.filling(style) }));
    }

    // "hatch-red", "back-red" or "dots-red" in a style is a pattern.
    filling(style) {
      const pattern = /\b(hatch|back|dots)-(\w+)/.exec(style);
      return pattern ? { fill: `url(#${this.id}-${pattern[1]}-${pattern[2]})` } : {};
    }

    line(points, style) {
      this.shape("polyline", { points: this.list(points), fill: "none" }, `line ${style}`);
    }

    polygon(points, style) {
      this.shape("polygon", { points: this.list(points) }, style);
    }

    rect([x0, y0], [x1, y1], style) {
      this.polygon([[x0, y0], [x1, y0], [x1, y1], [x0, y1]], style);
    }

    list(points) {
      return points.map((p) => this.at(p).map((v) => v.toFixed(2)).join(",")).join(" ");
    }

    circle(centre, pixels, style) {
      const [cx, cy] = this.at(centre);
      this.shape("circle", { cx, cy, r: pixels }, style);
    }

    cross(centre, pixels, style) {
      const [x, y] = this.at(centre);
      const d = `M${x - pixels} ${y - pixels}l${2 * pixels} ${2 * pixels}m0 ${-2 * pixels}l${-2 * pixels} ${2 * pixels}`;
      this.shape("path", { d, fill: "none" }, `line ${style}`);
    }

    arrow(from, to, style) {
      this.line([from, to], style);
      const [a, b] = [this.at(from), this.at(to)];
      const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
      if (length < 4) return;
      const [ux, uy] = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
      const tip = (side) => `${b[0] - 10 * ux - side * 5 * uy},${b[1] - 10 * uy + side * 5 * ux}`;
      this.shape("polygon", { points: `${b[0]},${b[1]} ${tip(1)} ${tip(-1)}` }, `solid ${style}`);
    }

    // Words beside a point; `dx` and `dy` in pixels, y down.
    words(p, words, style = "ink", { dx = 0, dy = 0, anchor = "middle" } = {}) {
      const [x, y] = this.at(p);
      const element = svg("text", { x: x + dx, y: y + dy, "text-anchor": anchor, class: classes(`words ${style}`) });
      element.textContent = words;
      this.back.append(element);
    }

    // A point that can be moved: `state[key]` is [x, y] in world coordinates, a multiple of `snap`,
    // in the ranges `within` or those of the stage.
    handle({ key, label, name = "", value, snap = 0.125, colour = "ink", dx = 14, dy = -10, free = [true, true], within }) {
      const { ui } = this;
      ui.state[key] = value;
      const shown = svg("text", { class: classes(`words strong ${colour}`), "aria-hidden": "true" });
      shown.textContent = name;
      const group = svg(
        "g",
        { class: classes(`handle ${colour}`), tabindex: 0, role: "slider", "data-point": key, "aria-label": label },
        svg("circle", { class: "reach", r: 22 }),
        svg("circle", { class: "ring", r: 9 }),
        svg("circle", { class: "core", r: 3 }),
        shown,
      );
      group.setAttribute("aria-roledescription", "movable point");
      const place = () => {
        const [x, y] = ui.state[key];
        const [px, py] = this.at([x, y]);
        group.setAttribute("transform", `translate(${px.toFixed(2)} ${py.toFixed(2)})`);
        shown.setAttribute("x", dx);
        shown.setAttribute("y", dy);
        group.setAttribute("aria-valuenow", x);
        group.setAttribute("aria-valuetext", free[1] ? `x ${text(x)}, y ${text(y)}` : `x ${text(x)}`);
      };
      const move = (x, y) => {
        const [oldX, oldY] = ui.state[key];
        const snapped = (v, range) => {
          const inside = Math.min(Math.max(v, range[0]), range[1]);
          return Math.round(inside / snap) * snap + 0;
        };
        const [rangeX, rangeY] = within || [this.x, this.y];
        ui.set(key, [free[0] ? snapped(x, rangeX) : oldX, free[1] ? snapped(y, rangeY) : oldY]);
      };
      group.addEventListener("pointerdown", (event) => {
        group.setPointerCapture(event.pointerId);
        group.focus();
        event.preventDefault();
      });
      group.addEventListener("pointermove", (event) => {
        if (!group.hasPointerCapture(event.pointerId)) return;
        const box = this.svg.getBoundingClientRect();
        const [sx, sy] = [this.w / box.width, this.h / box.height];
        move(...this.world([sx * (event.clientX - box.left), sy * (event.clientY - box.top)]));
      });
      group.addEventListener("keydown", (event) => {
        const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
        if (!step) return;
        event.preventDefault();
        const size = event.shiftKey ? 8 * snap : snap;
        const [x, y] = ui.state[key];
        move(x + size * step[0], y + size * step[1]);
      });
      this.front.append(group);
      this.handles.push({ place });
    }
  }

  // "red dash" as class names.
  function classes(style) {
    return style
      .split(" ")
      .map((word) => (COLOURS.includes(word) ? `c-${word}` : `s-${word}`))
      .join(" ");
  }

  // ---------------------------------------------------------------- the page

  if (page) {
    const start = () => {
      const found = page.querySelectorAll("figure[data-explore]");
      if (found.length === 0) return;
      loadStyle();
      found.forEach(begin);
    };
    if (page.readyState === "loading") page.addEventListener("DOMContentLoaded", start);
    else start();
  }
})();
