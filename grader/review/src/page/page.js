"use strict";
// Shows the ray, both records and the box tests of a pixel. A pixel is selected by a click, by the
// arrow keys, or by the address (#task/case/x,y). Pixels count from the bottom left.

const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

/** One number as the snapshots write it. */
function number(x) {
  if (x === Infinity) return "inf";
  if (x === -Infinity) return "-inf";
  return Object.is(x, -0) ? "-0" : String(x);
}

/** A value: a number, a range, or a vector. */
function value(name, numbers) {
  const texts = Array.from(numbers, number);
  if (texts.length === 1) return texts[0];
  return name === "range" || name === "inside" ? `[${texts.join(", ")}]` : `(${texts.join(", ")})`;
}

/** Records stored as columns (see columns.rs). */
class Records {
  constructor(columns) {
    this.columns = columns.map((column) => {
      const values = new Float64Array(bytes(column.values).buffer);
      const has = column.has === null ? null : bytes(column.has);
      let count = 0;
      const place = has && Array.from(has, (present) => (present ? count++ : -1));
      return { ...column, values, place };
    });
  }

  /** The record in `row`: its fields in order, each a name and numbers. */
  at(row) {
    const fields = [];
    for (const { name, width, constant, values, place } of this.columns) {
      const at = place ? place[row] : row;
      if (at < 0) continue;
      const start = constant ? 0 : at * width;
      fields.push({ name, numbers: values.subarray(start, start + width) });
    }
    return fields;
  }

  field(row, name) {
    return this.at(row).find((field) => field.name === name)?.numbers;
  }
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

const minus = (a, b) => a.map((x, i) => x - b[i]);
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** Solves x a + y b + z c = d by Cramer's rule; null if there is no unique solution. */
function solve(a, b, c, d) {
  const det = dot(a, cross(b, c));
  if (!(Math.abs(det) > 1e-12)) return null;
  return [dot(d, cross(b, c)), dot(a, cross(d, c)), dot(a, cross(b, d))].map((x) => x / det);
}

/**
 * The projection from world space to [column, row] of a picture, as a function; null if the rays do not
 * start at one point. Before normalising, directions are A + x B + y C. The rays of the four corner
 * pixels determine A, B and C up to a common factor.
 */
function projection(width, height, ray) {
  const corner = (x, y) => ray(y * width + x);
  const rays = [corner(0, 0), corner(width - 1, 0), corner(0, height - 1), corner(width - 1, height - 1)];
  if (!rays.every(Boolean) || rays.some(({ o }) => o.join() !== rays[0].o.join())) return null;
  const [d00, d10, d01, d11] = rays.map(({ d }) => d);
  const lengths = solve(d10, d01, d11.map((x) => -x), d00);
  if (!lengths) return null;
  const [across, up] = [d10.map((x) => x * lengths[0]), d01.map((x) => x * lengths[1])];
  const b = minus(across, d00).map((x) => x / (width - 1));
  const c = minus(up, d00).map((x) => x / (height - 1));
  return (point) => {
    const solved = solve(d00, b, c, minus(point, rays[0].o));
    if (!solved || !(solved[0] > 0)) return null;
    return [solved[1] / solved[0], solved[2] / solved[0]];
  };
}

/** The edges of a box, as pairs of corners. */
function edges([min, max]) {
  const corner = (i) => [0, 1, 2].map((axis) => (i & (1 << axis) ? max : min)[axis]);
  const pairs = [];
  for (let i = 0; i < 8; i++) {
    for (const bit of [1, 2, 4]) if (!(i & bit)) pairs.push([corner(i), corner(i | bit)]);
  }
  return pairs;
}

class Picture {
  constructor(article) {
    this.article = article;
    this.data = JSON.parse(article.querySelector("script").textContent);
    this.causes = bytes(this.data.causes);
    this.question = new Records(this.data.question);
    const { calls, records, hits } = this.data.golden;
    this.golden = {
      rows: calls && new Map(calls.map((call, row) => [call, row])),
      records: new Records(records),
      hits: hits && bytes(hits),
    };
    this.actual = new Records(this.data.actual);
    this.exact = this.data.exact && {
      rows: new Map(this.data.exact.calls.map((call, row) => [call, row])),
      records: new Records(this.data.exact.records),
    };
    const ray = (call) => {
      const [o, d] = ["o", "d"].map((name) => this.question.field(call, name));
      return o && d && { o: Array.from(o), d: Array.from(d) };
    };
    this.project = this.data.boxes && projection(this.data.width, this.data.height, ray);
    this.inspector = article.querySelector(".inspector");
    this.screens = [...article.querySelectorAll(".screen")];
    for (const screen of this.screens) {
      screen.addEventListener("click", (event) => this.clicked(screen, event));
      screen.addEventListener("keydown", (event) => this.pressed(event));
    }
    for (const button of article.querySelectorAll("button[data-cause]")) {
      button.addEventListener("click", () => this.next(Number(button.dataset.cause)));
    }
  }

  clicked(screen, event) {
    const { left, top, width, height } = screen.getBoundingClientRect();
    const x = Math.floor(((event.clientX - left) / width) * this.data.width);
    const y = this.data.height - 1 - Math.floor(((event.clientY - top) / height) * this.data.height);
    this.choose(x, y);
  }

  pressed(event) {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!step) return;
    event.preventDefault();
    const { width, height } = this.data;
    const [x, y] = this.pixel ?? [width >> 1, height >> 1];
    this.choose(Math.min(Math.max(x + step[0], 0), width - 1), Math.min(Math.max(y + step[1], 0), height - 1));
  }

  /** Selects the next pixel with this cause. */
  next(cause) {
    const [x, y] = this.pixel ?? [-1, 0];
    const here = y * this.data.width + x;
    const later = this.causes.indexOf(cause, here + 1);
    const call = later >= 0 ? later : this.causes.indexOf(cause);
    if (call >= 0) this.choose(call % this.data.width, Math.floor(call / this.data.width));
  }

  /** Selects and shows the pixel in column x and row y. */
  choose(x, y) {
    const { width, height } = this.data;
    if (!(x >= 0 && x < width && y >= 0 && y < height)) return;
    this.pixel = [x, y];
    history.replaceState(null, "", `#${this.article.id}/${x},${y}`);
    this.mark(x, y);
    this.show(x, y);
  }

  mark(x, y) {
    const { height } = this.data;
    for (const screen of this.screens) {
      const spot = { class: "spot", x, y: height - 1 - y, width: 1, height: 1 };
      screen.querySelector("svg").replaceChildren(...this.wires(this.visits(x, y)), drawn("rect", spot), drawn("rect", spot));
    }
  }

  /** The box tests of a pixel. */
  visits(x, y) {
    const { boxes, width } = this.data;
    if (!boxes) return [];
    return boxes.tests[y * width + x].map((code) => ({ number: code >> 1, hit: code % 2 === 1, ...boxes.boxes[code >> 1] }));
  }

  wires(visits) {
    if (!this.project) return [];
    return visits.map((visit) => {
      const lines = edges(visit.corners).map((ends) => ends.map((end) => this.project(end)));
      const path = lines.filter((ends) => ends.every(Boolean));
      const at = ([x, y]) => `${x + 0.5} ${this.data.height - (y + 0.5)}`;
      return drawn("path", {
        class: `box ${visit.hit ? "" : "missed"} ${visit.leaf === null ? "" : "leaf"}`,
        "data-box": visit.number,
        d: path.map(([from, to]) => `M${at(from)}L${at(to)}`).join(""),
      });
    });
  }

  show(x, y) {
    const call = y * this.data.width + x;
    const cause = this.causes[call];
    const heading = element("h4", {}, `Pixel ${x}, ${y}: `, cause ? this.data.labels[cause] : "no difference");
    const record = element("div", {}, heading, ...this.oracle(call), this.arguments(call), this.records(x, y, call));
    this.inspector.replaceChildren(record, element("div", {}, ...this.boxes(x, y)));
  }

  /** The golden's record of a call; undefined if the golden has no row for it. */
  goldenAt(call) {
    const { rows, records } = this.golden;
    if (!rows) return records.at(call);
    return rows.has(call) ? records.at(rows.get(call)) : undefined;
  }

  /** The arguments of the call: the ray and what it is tested against. */
  arguments(call) {
    const rows = this.question.at(call).map(({ name, numbers }) =>
      element("tr", {}, element("th", {}, name), element("td", {}, value(name, numbers))));
    return element("table", { class: "record asked" }, element("caption", { class: "note" }, `Arguments of call ${call}`), element("tbody", {}, ...rows));
  }

  records(x, y, call) {
    const row = this.exact ? this.exact.rows.get(call) : undefined;
    const golden = this.goldenAt(call);
    const records = { golden: golden ?? [], actual: this.actual.at(call) };
    if (row !== undefined) records.exact = this.exact.records.at(row);
    const { hits: byColour } = this.golden;
    const hits = byColour !== null || Object.values(records).some((fields) => fields.length === 0) || records.actual.some(({ name }) => name === "prim");
    const names = [];
    for (const fields of Object.values(records)) {
      fields.forEach(({ name }, i) => {
        const nth = fields.slice(0, i).filter((field) => field.name === name).length;
        if (!names.some((known) => known.name === name && known.nth === nth)) names.push({ name, nth });
      });
    }
    const body = element("tbody");
    const line = (name, texts) => {
      const cells = Object.keys(records).map((who, i) => {
        const differs = who === "actual" && (texts[0] ?? null) !== null && texts[0] !== texts[1];
        const text = texts[i] ?? "–";
        return element("td", { "data-field": `${who}.${name}` }, differs ? element("mark", {}, text) : text);
      });
      body.append(element("tr", {}, element("th", {}, name), ...cells));
    };
    if (hits) {
      const answers = Object.values(records).map((fields) => (fields.length ? "hit" : "miss"));
      // Where the golden has no row, its colour shows whether it is a hit or a miss.
      if (!golden) answers[0] = byColour && (byColour[call] ? "hit" : "miss");
      line("answer", answers);
    }
    for (const { name, nth } of names) {
      line(name, Object.values(records).map((fields) => {
        const field = fields.filter((field) => field.name === name)[nth];
        return field && value(name, field.numbers);
      }));
    }
    const swatches = ["golden", "actual"].map((who) => element("td", {}, this.swatch(who, x, y)));
    body.append(element("tr", {}, element("th", {}, "colour"), ...swatches));
    const { words } = this.data;
    const head = Object.keys(records).map((who) => element("th", { scope: "col" }, words[who]));
    const short = golden && golden.length < records.actual.length && golden.length > 0;
    let note = "Answers";
    if (short) note = words.short;
    if (!golden) note = records.exact ? words.instead : words.onlyColour;
    return element("table", { class: "record" }, element("caption", { class: "note" }, note), element("thead", {}, element("tr", {}, element("td"), ...head)), body);
  }

  /** A square in the pixel's colour, cut out of the picture. */
  swatch(who, x, y) {
    const { width, height } = this.data;
    const size = 40;
    const image = this.article.querySelector(`img[data-who=${who}]`);
    const made = element("span", { class: "swatch", role: "img", "aria-label": `colour of the ${this.data.words[who]} pixel` });
    made.style.backgroundImage = `url(${image.src})`;
    made.style.backgroundSize = `${width * size}px ${height * size}px`;
    made.style.backgroundPosition = `${-x * size}px ${-(height - 1 - y) * size}px`;
    return made;
  }

  oracle(call) {
    if (!this.causes[call]) return [];
    const { words } = this.data;
    const wrong = this.data.wrong[call];
    if (wrong) return [element("p", { class: "bad" }, `${words.refuted}: ${wrong.join(", ")}.`)];
    const open = this.data.notJudged[call];
    if (open) return [element("p", { class: "open" }, `${words.open}: ${open.join("; ")}.`)];
    return [element("p", { class: "good" }, words.confirmed)];
  }

  boxes(x, y) {
    if (!this.data.boxes) return [element("p", { class: "note" }, "Box tests: none in this task.")];
    const visits = this.visits(x, y);
    const hits = visits.filter((visit) => visit.hit).length;
    const items = visits.map((visit) => {
      const what = visit.leaf === null ? "" : `, leaf of ${visit.leaf}`;
      const [min, max] = visit.corners.map((corner) => value("corner", corner.map((c) => Number(c.toPrecision(4)))));
      const item = element("li", { class: visit.hit ? "" : "missed", tabindex: 0, "data-box": visit.number },
        `${visit.hit ? "●" : "○"} box ${visit.number}${what} ${min} … ${max}`);
      item.style.setProperty("--depth", visit.depth);
      const light = (on) => this.light(visit.number, on);
      for (const [event, on] of [["mouseenter", true], ["focus", true], ["mouseleave", false], ["blur", false]]) {
        item.addEventListener(event, () => light(on));
      }
      return item;
    });
    return [element("p", {}, `Box tests: ${visits.length}, the ray hits ${hits} (●).`), element("ol", { class: "visits" }, ...items)];
  }

  light(box, on) {
    for (const wire of this.article.querySelectorAll(`.box[data-box="${box}"]`)) wire.classList.toggle("chosen", on);
  }
}

/** The sliders between two pictures that are one on top of the other. */
for (const slider of document.querySelectorAll(".slider input")) {
  const screen = slider.closest("figure").querySelector(".screen");
  const slide = () => screen.style.setProperty("--at", `${slider.value}%`);
  slider.addEventListener("input", slide);
  slide();
}

const pictures = new Map();
for (const article of document.querySelectorAll(".picture")) pictures.set(article.id, new Picture(article));

/** Selects the pixel in the page's address. */
function follow() {
  const [, id, x, y] = decodeURIComponent(location.hash).match(/^#(.*)\/(\d+),(\d+)$/) ?? [];
  const picture = pictures.get(id);
  if (!picture) return;
  picture.article.scrollIntoView();
  picture.choose(Number(x), Number(y));
}
addEventListener("hashchange", follow);
follow();
