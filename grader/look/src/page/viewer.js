// Compares two pictures: wipe, side by side, blink, golden, actual, the differences. Zooms and pans.

const BLINK_MS = 500;
const LARGEST_ZOOM = 64;

class Viewer {
  constructor(root) {
    this.root = root;
    this.scale = 1;
    this.shift = [0, 0];
    this.first = root.querySelector(".screen");
    // The second screen of "side by side". It is not in the file, where it would double the pictures.
    this.second = this.first.cloneNode(true);
    this.second.classList.add("second");
    this.second.removeAttribute("tabindex");
    this.first.after(this.second);
    this.screens = [this.first, this.second];
    this.picked = () => {};
    this.stepped = () => {};
    for (const button of root.querySelectorAll("[data-mode]")) {
      button.addEventListener("click", () => this.show(button.dataset.mode));
    }
    for (const button of root.querySelectorAll("[data-zoom]")) {
      button.addEventListener("click", () => this.zoom(Number(button.dataset.zoom)));
    }
    const slider = root.querySelector(".slider input");
    const slide = () => root.style.setProperty("--at", `${slider.value}%`);
    slider.addEventListener("input", slide);
    slide();
    for (const screen of this.screens) this.listen(screen);
    this.show(root.dataset.show);
  }

  listen(screen) {
    let from = null;
    let moved = false;
    screen.addEventListener("pointerdown", (event) => {
      from = [event.clientX, event.clientY];
      moved = false;
    });
    screen.addEventListener("pointermove", (event) => {
      if (!from || this.scale === 1) return;
      const by = [event.clientX - from[0], event.clientY - from[1]];
      if (!moved && Math.hypot(...by) < 4) return;
      if (!moved) screen.setPointerCapture(event.pointerId);
      moved = true;
      from = [event.clientX, event.clientY];
      this.shift = this.shift.map((x, axis) => x + by[axis]);
      this.place();
    });
    for (const end of ["pointerup", "pointercancel"]) screen.addEventListener(end, () => (from = null));
    screen.addEventListener("click", (event) => {
      if (moved) return;
      const { left, top, width, height } = screen.querySelector(".layer").getBoundingClientRect();
      this.picked((event.clientX - left) / width, (event.clientY - top) / height);
    });
    screen.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      const { left, top } = screen.getBoundingClientRect();
      this.zoom(event.deltaY < 0 ? 1.25 : 0.8, [event.clientX - left, event.clientY - top]);
    }, { passive: false });
    screen.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      const factor = { "+": 2, "=": 2, "-": 0.5, 0: 0 }[event.key];
      if (step) this.stepped(...step);
      else if (factor !== undefined) this.zoom(factor);
      else return;
      event.preventDefault();
    });
  }

  /** Zooms by a factor around a point of the screen, its middle if there is none; 0 fits the picture. */
  zoom(factor, point) {
    const { width, height } = this.first.getBoundingClientRect();
    const around = point ?? [width / 2, height / 2];
    const scale = factor ? Math.min(Math.max(this.scale * factor, 1), LARGEST_ZOOM) : 1;
    this.shift = this.shift.map((x, axis) => around[axis] - ((around[axis] - x) * scale) / this.scale);
    this.scale = scale;
    this.place();
  }

  /** Moves the pictures, so that they always cover the screen. */
  place() {
    const { width, height } = this.first.getBoundingClientRect();
    const least = [width, height].map((size) => size * (1 - this.scale));
    this.shift = this.shift.map((x, axis) => Math.min(Math.max(x, least[axis]), 0));
    for (const screen of this.screens) {
      const layer = screen.querySelector(".layer");
      layer.style.transform = `translate(${this.shift[0]}px, ${this.shift[1]}px) scale(${this.scale})`;
      layer.style.setProperty("--scale", this.scale);
      screen.classList.toggle("zoomed", this.scale > 1);
    }
    this.root.querySelector("output").textContent = `${Number(this.scale.toPrecision(2))}×`;
  }

  /** Shows the pictures in this way. */
  show(mode) {
    this.root.dataset.show = mode;
    for (const button of this.root.querySelectorAll("[data-mode]")) {
      button.setAttribute("aria-pressed", String(button.dataset.mode === mode));
    }
    clearInterval(this.blinking);
    const name = (who) => this.first.querySelector(`img[data-who=${who}]`)?.alt ?? "";
    const tags = { wipe: `${name("golden")} | ${name("actual")}`, side: name("golden") };
    const tag = (who) => (this.first.dataset.tag = tags[who] ?? name(who));
    this.root.classList.remove("blink-b");
    tag(mode === "blink" ? "golden" : mode);
    this.second.dataset.tag = name("actual");
    if (mode === "blink") {
      this.blinking = setInterval(() => tag(this.root.classList.toggle("blink-b") ? "actual" : "golden"), BLINK_MS);
    }
    // Screens have another size side by side.
    this.zoom(0);
  }
}
