// Part 2, Task 1: where to split, and what the surface area heuristic expects of each place.
(function () {
  "use strict";

  const COUNT = 6;
  const KEYS = Array.from({ length: COUNT }, (_, i) => `c${i + 1}`);

  const of = (x) => Explore.parts.exact.Fraction.of(x);
  const least = (values) => values.reduce((a, b) => (a.cmp(b) <= 0 ? a : b));
  const most = (values) => values.reduce((a, b) => (a.cmp(b) >= 0 ? a : b));
  const middle = ([a, b]) => a.add(b).div(of(2));

  // The surface of boxes on the x axis together, each 1 high and 1 deep: 0 for none.
  function area(boxes) {
    if (boxes.length === 0) return of(0);
    const length = most(boxes.map((b) => b[1])).sub(least(boxes.map((b) => b[0])));
    return of(2).mul(length.add(length).add(of(1)));
  }

  // A split of boxes [low, high] at m, in exact fractions. Centroids below m go to the left.
  function split(boxes, m) {
    const left = boxes.filter((b) => middle(b).cmp(m) < 0);
    const right = boxes.filter((b) => middle(b).cmp(m) >= 0);
    const [all, a, b] = [boxes, left, right].map(area);
    const expected = a.mul(of(left.length)).add(b.mul(of(right.length))).div(all);
    return { left, right, all, a, b, expected };
  }

  // The places that the chapter compares.
  function places(boxes) {
    const centres = boxes.map(middle);
    const sorted = [...centres].sort((a, b) => a.cmp(b));
    const candidates = sorted.slice(1).map((c, i) => middle([sorted[i], c]));
    const both = (m) => split(boxes, m).left.length > 0;
    const costs = candidates.filter(both).map((m) => [m, split(boxes, m).expected]);
    const best = costs.reduce((a, b) => (a && a[1].cmp(b[1]) <= 0 ? a : b), null);
    return {
      centroids: middle([sorted[0], sorted[COUNT - 1]]),
      boxes: middle([least(boxes.map((b) => b[0])), most(boxes.map((b) => b[1]))]),
      median: middle([sorted[COUNT / 2 - 1], sorted[COUNT / 2]]),
      best: best && best[0],
    };
  }

  function start(ui) {
    const scene = ui.stage({
      label: "Six boxes on the x axis, one below the other so that none is hidden, and the split m",
      x: [-2, 23],
      y: [0.2, 8.6],
      ratio: (width) => (width < 500 ? 0.74 : 0.4),
      stretch: true,
      margin: [4, 10, 4, 10],
    });
    const values = [0, 1, 2, 3, 8, 20];
    KEYS.forEach((key, i) => {
      scene.handle({
        key,
        label: `centroid of box ${i + 1}`,
        value: [values[i], COUNT - i],
        snap: 0.5,
        colour: "ink",
        free: [true, false],
      });
    });
    scene.handle({ key: "m", name: "m", label: "the split m", value: [10, 7.7], snap: 0.25, colour: "red", free: [true, false], dx: 14, dy: 5 });
    const graph = ui.stage({
      label: "The expected number of tests K for each place of the split",
      x: [-2, 23],
      y: [0, 6.6],
      ratio: (width) => (width < 500 ? 0.5 : 0.27),
      stretch: true,
      margin: [20, 10, 22, 10],
    });
    const say = ui.sentence();
    ui.slider({ key: "length", label: "Length of box 6", min: 1, max: 40, step: 1, value: 1 });
    const place = (name) => () => {
      const found = places(boxesOf(ui.state))[name];
      if (found) ui.state.m = [found.number(), ui.state.m[1]];
    };
    ui.buttons([
      ["▲ middle of the centroids", place("centroids")],
      ["■ middle of the boxes", place("boxes")],
      ["◆ median", place("median")],
      ["★ smallest K", place("best")],
    ]);
    const show = ui.table({ caption: "The two sides of this split", head: ["", "n", "area", "area / A · n"] });

    ui.render = (state) => {
      const boxes = boxesOf(state);
      const m = of(state.m[0]);
      const at = split(boxes, m);
      const found = places(boxes);
      const share = (a, n) => a.mul(of(n)).div(at.all);
      show([
        ["left", String(at.left.length), String(at.a), number(share(at.a, at.left.length))],
        ["right", String(at.right.length), String(at.b), number(share(at.b, at.right.length))],
        ["both: K / T", String(COUNT), `A = ${at.all}`, number(at.expected)],
      ]);
      const isEmpty = at.left.length === 0 || at.right.length === 0;
      const best = found.best && split(boxes, found.best).expected;
      if (!best) {
        say("All centroids are equal: no split separates them, and the median has to.");
      } else if (isEmpty) {
        say(`✗ One side is empty, so the same ${COUNT} boxes come back for ever. Another rule must cut here, such as the median.`);
      } else {
        const isBest = at.expected.cmp(best) === 0;
        say(`A ray that hits the node tests ${number(at.expected)} primitives on average, instead of ${COUNT}.${isBest ? " ★ No split of this axis is better." : ` The best split has ${number(best)}.`}`);
      }
      drawScene(scene, state, boxes, at);
      drawGraph(graph, state, boxes, found, at);
    };
  }

  const number = (q) => (of(q.number()).cmp(q) === 0 ? String(q) : q.decimal(4));

  function boxesOf(state) {
    return KEYS.map((key, i) => {
      const half = of(i === COUNT - 1 ? state.length : 1).div(of(2));
      const centre = of(state[key][0]);
      return [centre.sub(half), centre.add(half)];
    });
  }

  function drawScene(stage, state, boxes, at) {
    const span = (side) => [least(side.map((b) => b[0])).number(), most(side.map((b) => b[1])).number()];
    for (const [side, pattern, colour] of [[at.left, "hatch", "green"], [at.right, "back", "purple"]]) {
      if (side.length === 0) continue;
      const [from, to] = span(side);
      stage.rect([from, 0.3], [to, 6.9], `${pattern}-${colour}`);
      stage.rect([from, 0.3], [to, 6.9], `edge ${colour}`);
    }
    boxes.forEach((box, i) => {
      const [from, to] = box.map((x) => x.number());
      const isLeft = at.left.includes(box);
      stage.rect([from, COUNT - i - 0.32], [to, COUNT - i + 0.32], "hollow ink");
      stage.rect([from, COUNT - i - 0.32], [to, COUNT - i + 0.32], `shade ${isLeft ? "green" : "purple"}`);
      stage.words([Math.max(from, -1.2), COUNT - i], String(i + 1), "ink small strong", { dx: -10, dy: 5, anchor: "end" });
    });
    const [m] = state.m;
    stage.line([[m, 0], [m, 9]], "red");
    stage.words([m, 8.2], "left", "green small strong", { dx: -14, dy: 12, anchor: "end" });
    stage.words([m, 8.2], "right", "purple small strong", { dx: 30, dy: 12, anchor: "start" });
  }

  const SIGNS = { centroids: "▲", boxes: "■", median: "◆", best: "★" };

  function drawGraph(stage, { m }, boxes, found, at) {
    const [left, right] = stage.x;
    for (const k of [0, 2, 4, 6]) {
      stage.line([[left, k], [right, k]], "soft thin");
      stage.words([left, k], String(k), "ink small", { dx: 2, dy: -3, anchor: "start" });
    }
    for (let x = 0; x <= 20; x += 5) stage.words([x, 0], String(x), "ink small", { dy: 16 });
    stage.words([right, 6.6], "K / T: primitive tests of a ray that hits the node", "ink small", { dy: -6, anchor: "end" });
    // K is constant between two centroids.
    const centres = [...new Set(boxes.map((b) => middle(b).number()))].sort((a, b) => a - b);
    const steps = [left, ...centres, right];
    const curve = [];
    for (let i = 1; i < steps.length; i++) {
      const k = split(boxes, of(steps[i])).expected.number();
      curve.push([steps[i - 1], k], [steps[i], k]);
    }
    stage.line(curve, "blue");
    stage.line([[m[0], 0], [m[0], 6.6]], "red");
    stage.circle([m[0], at.expected.number()], 5, "solid red");
    const taken = [];
    for (const [name, place] of Object.entries(found)) {
      if (!place) continue;
      const x = place.number();
      const lift = 14 * taken.filter((other) => Math.abs(other - x) * stage.scale[0] < 15).length;
      taken.push(x);
      stage.words([x, split(boxes, place).expected.number()], SIGNS[name], "ink", { dy: -7 - lift });
    }
  }

  Explore.figure("build", { needs: ["exact"], kernels: {}, split, places, start });
})();
