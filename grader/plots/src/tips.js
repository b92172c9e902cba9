// Shows the text of the point that the pointer is near, that was tapped, or that has the focus:
// Tab enters a plot, left and right go to the next point, up and down to the nearest one above and
// below, Escape hides the text. Without scripts, browsers show the titles.
(() => {
  const box = document.createElement("div");
  box.className = "tooltip";
  box.hidden = true;
  document.body.append(box);
  let shown = null;
  const hide = () => {
    shown?.classList.remove("shown");
    shown = null;
    box.hidden = true;
  };
  const show = (point) => {
    if (point === shown) return;
    hide();
    if (!point) return;
    shown = point;
    point.classList.add("shown");
    box.textContent = point.getAttribute("aria-label");
    box.hidden = false;
    const at = point.getBoundingClientRect();
    const [w, h] = [box.offsetWidth, box.offsetHeight];
    const middle = (at.left + at.right - w) / 2;
    box.style.left = `${Math.max(4, Math.min(middle, document.documentElement.clientWidth - w - 4))}px`;
    box.style.top = `${at.top - h - 6 > 4 ? at.top - h - 6 : at.bottom + 6}px`;
  };
  const middle = (point) => {
    const at = point.getBoundingClientRect();
    return [(at.left + at.right) / 2, (at.top + at.bottom) / 2];
  };
  const least = (points, of) =>
    points.reduce((best, point) => (of(point) < of(best) ? point : best), points[0]);

  for (const plot of document.querySelectorAll("svg.plot")) {
    const points = [...plot.querySelectorAll(".tip")];
    if (!points.length) continue;
    plot.setAttribute("role", "group");
    const focus = (point) => {
      if (!point) return;
      points.forEach((other) => other.setAttribute("tabindex", other === point ? "0" : "-1"));
      point.focus();
      // A window that is not in front gets no event.
      show(point);
    };
    points.forEach((point, i) => {
      point.setAttribute("role", "img");
      point.setAttribute("tabindex", i ? "-1" : "0");
      const title = point.querySelector("title");
      point.setAttribute("aria-label", title.textContent);
      title.remove();
      point.addEventListener("focus", () => show(point));
      point.addEventListener("blur", hide);
      point.addEventListener("keydown", (event) => {
        const [x, y] = middle(point);
        const beyond = (sign) => {
          const those = points.filter((other) => sign * (middle(other)[1] - y) > 1);
          return least(those, (other) => Math.hypot(3 * (middle(other)[0] - x), middle(other)[1] - y));
        };
        const next = {
          ArrowLeft: () => points[i - 1],
          ArrowRight: () => points[i + 1],
          ArrowUp: () => beyond(-1),
          ArrowDown: () => beyond(1),
          Home: () => points[0],
          End: () => points[points.length - 1],
        }[event.key];
        if (event.key === "Escape") hide();
        if (!next) return;
        event.preventDefault();
        focus(next());
      });
    });
    // The point within reach of the pointer: a finger reaches farther than a mouse.
    const near = (event) => {
      const away = (point) => {
        const at = point.getBoundingClientRect();
        const beside = (x, from, to) => Math.max(from - x, 0, x - to);
        return Math.hypot(
          beside(event.clientX, at.left, at.right),
          beside(event.clientY, at.top, at.bottom),
        );
      };
      const nearest = least(points, away);
      return away(nearest) <= (event.pointerType === "mouse" ? 6 : 22) ? nearest : null;
    };
    plot.addEventListener("pointermove", (event) => show(near(event)));
    plot.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && hide());
    plot.addEventListener("click", (event) => {
      const point = near(event);
      point ? focus(point) : hide();
    });
  }
  addEventListener("scroll", () => shown !== document.activeElement && hide(), { capture: true, passive: true });
})();
