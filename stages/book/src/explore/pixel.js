// Part 1, Task 1: where the samples of a pixel are, and how their mean settles.
(function () {
  "use strict";

  // Which side of the edge from a to b a point is on: white to the left of it.
  const isWhite = (a, b, s) => (b[0] - a[0]) * (s[1] - a[1]) - (b[1] - a[1]) * (s[0] - a[0]) > 0;

  // The white share of the pixel in exact fractions: the unit square, cut by the edge.
  function share(a, b) {
    const { Fraction } = Explore.parts.exact;
    const of = Fraction.of;
    const [ax, ay, dx, dy] = [of(a[0]), of(a[1]), of(b[0]).sub(of(a[0])), of(b[1]).sub(of(a[1]))];
    const side = ([x, y]) => dx.mul(y.sub(ay)).sub(dy.mul(x.sub(ax)));
    const corners = [[0, 0], [1, 0], [1, 1], [0, 1]].map((p) => p.map(of));
    const kept = [];
    corners.forEach((p, i) => {
      const q = corners[(i + 1) % 4];
      const [u, v] = [side(p), side(q)];
      if (u.sign() >= 0) kept.push(p);
      if (u.sign() * v.sign() < 0) {
        const s = u.div(u.sub(v));
        kept.push(p.map((x, k) => x.add(s.mul(q[k].sub(x)))));
      }
    });
    let doubled = of(0);
    kept.forEach(([x, y], i) => {
      const [nextX, nextY] = kept[(i + 1) % kept.length];
      doubled = doubled.add(x.mul(nextY).sub(nextX.mul(y)));
    });
    return { polygon: kept.map((p) => p.map((x) => x.number())), white: doubled.div(of(2)) };
  }

  // The positions of n samples.
  function positions(n, code, seed) {
    if (n === 1) return [[0.5, 0.5]];
    const strata = code === "strata" ? n : 0;
    const sampler = new Explore.parts.sampler.PixelSampler(3, 1, seed, strata);
    const first = sampler.getSample();
    const others = Array.from({ length: n - 1 }, () => (code === "same" ? first : sampler.getSample()));
    return [first, ...others];
  }

  const CODES = [
    ["independent", "independent samples"],
    ["strata", "one in each cell of a grid"],
    ["same", "one place for all samples"],
  ];

  function start(ui) {
    const row = ui.row();
    const square = ui.stage({
      to: row,
      share: (width) => (width < 500 ? 1 : 0.42),
      label: "The pixel with its samples: white to the left of the edge",
      x: [-0.12, 1.12],
      y: [-0.12, 1.12],
      ratio: 0.85,
      margin: 2,
    });
    const within = [[0, 1], [0, 1]];
    square.handle({ key: "a", name: "", label: "lower end of the edge", value: [0.125, 0], snap: 0.0625, within, colour: "red" });
    square.handle({ key: "b", name: "", label: "upper end of the edge", value: [0.375, 1], snap: 0.0625, within, colour: "red" });
    const graph = ui.stage({
      to: row,
      share: (width) => (width < 500 ? 1 : 0.58),
      label: "The mean of the first samples against their number, with a band of one standard error around the exact mean",
      x: [0, 10],
      y: [0, 1],
      ratio: 0.62,
      stretch: true,
      margin: [20, 20, 38, 34],
    });
    const say = ui.sentence();
    ui.choice({ key: "code", label: "The positions", value: "independent", options: CODES });
    ui.slider({ key: "power", label: "Samples N", min: 0, max: 10, step: 1, value: 6, format: (k) => String(2 ** k) });
    ui.slider({ key: "seed", label: "Seed", min: 1, max: 50, step: 1, value: 7 });
    const show = ui.table({ caption: "The estimate" });

    ui.render = (state) => {
      const n = 2 ** state.power;
      const places = positions(n, state.code, state.seed);
      const lit = places.map((s) => isWhite(state.a, state.b, s));
      const { polygon, white } = share(state.a, state.b);
      const exact = white.number();
      const whiteSamples = lit.filter(Boolean).length;
      const mean = whiteSamples / n;
      const deviation = Math.sqrt(exact * (1 - exact));
      const standard = deviation / Math.sqrt(n);
      show([
        ["white samples", `${whiteSamples} of ${n}`],
        ["estimate E", Explore.text(mean)],
        ["exact mean I", String(white)],
        ["σ / √N", standard.toFixed(4)],
      ]);
      const off = Math.abs(mean - exact);
      const errors = standard > 0 ? `, ${(off / standard).toFixed(1)} times σ / √N` : "";
      if (n === 1) say(`One sample is in the centre: the estimate is ${mean}, and the exact mean is ${white}.`);
      else if (state.code === "same") say(`✗ All ${n} samples are at one place: the estimate is ${mean}, as with one sample.`);
      else say(`The estimate is off by ${off.toFixed(4)}${errors}${state.code === "strata" ? ": samples in a grid do not clump" : ""}.`);
      drawSquare(square, state, polygon, places, lit);
      drawGraph(graph, lit, exact, deviation);
    };
  }

  function drawSquare(stage, { code }, polygon, places, lit) {
    stage.rect([0, 0], [1, 1], "black");
    if (polygon.length > 2) stage.polygon(polygon, "white");
    if (code === "strata" && places.length > 1) {
      const rows = 2 ** Math.ceil(Math.log2(places.length) / 2);
      const columns = places.length / rows;
      for (let i = 1; i < columns; i++) stage.line([[i / columns, 0], [i / columns, 1]], "grid");
      for (let i = 1; i < rows; i++) stage.line([[0, i / rows], [1, i / rows]], "grid");
    }
    stage.rect([0, 0], [1, 1], "edge ink");
    const { a, b } = stage.ui.state;
    stage.line([a, b], "red");
    const r = places.length > 256 ? 2 : 3.2;
    // Samples that see white are rings, others full.
    places.forEach((s, i) => stage.circle(s, r, lit[i] ? "ring" : "white"));
  }

  function drawGraph(stage, lit, exact, deviation) {
    const band = [];
    for (let k = 0; k <= 10; k += 0.25) band.push([k, deviation / Math.sqrt(2 ** k)]);
    const clip = (y) => Math.min(1, Math.max(0, y));
    stage.polygon([...band.map(([k, e]) => [k, clip(exact + e)]), ...band.reverse().map(([k, e]) => [k, clip(exact - e)])], "tint green");
    for (const y of [0, 0.5, 1]) {
      stage.line([[0, y], [10, y]], "soft thin");
      stage.words([0, y], String(y), "ink small", { dx: -6, dy: 4, anchor: "end" });
    }
    for (const k of [0, 2, 4, 6, 8, 10]) stage.words([k, 0], String(2 ** k), "ink small", { dy: 16 });
    stage.words([5, 0], "number of samples", "ink small", { dy: 32 });
    stage.line([[0, exact], [10, exact]], "green dash");
    stage.words([10, exact], "I", "green strong", { dx: 8, dy: 5 });
    let sum = 0;
    const means = lit.map((white, i) => {
      sum += white ? 1 : 0;
      return [Math.log2(i + 1), sum / (i + 1)];
    });
    stage.line(means, "blue");
    stage.circle(means.at(-1), 4, "solid blue");
    stage.words([10, 1], "E of the first samples, and I ± σ / √N", "ink small", { dy: -6, anchor: "end" });
  }

  Explore.figure("pixel", { needs: ["exact", "sampler"], kernels: {}, share, start });
})();
