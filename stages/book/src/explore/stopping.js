// Part 5, Task 2: pixels that stop by looking at their own samples, and what that does to their mean.
(function () {
  "use strict";

  const [COLUMNS, ROWS] = [16, 8];
  const BATCH = 32;
  const LIMIT = 2048;

  // Mean and variance in one pass, as `kit::Tally` has them (Welford, 1962).
  class Tally {
    constructor() {
      [this.n, this.mean, this.squares] = [0, 0, 0];
    }
    push(x) {
      this.n += 1;
      const difference = x - this.mean;
      this.mean += difference / this.n;
      this.squares += difference * (x - this.mean);
    }
    standardError() {
      return this.n < 2 ? 0 : Math.sqrt(this.squares / (this.n - 1) / this.n);
    }
  }

  // The chapters' conditions: the plain criterion, and the two that come before it.
  const calm = (tally, tolerance) => 1.96 * tally.standardError() <= tolerance * tally.mean;
  const RULES = {
    plain: calm,
    black: (tally, tolerance) => tally.mean > 0 && calm(tally, tolerance),
    few: (tally, tolerance) => tally.n > 255 && calm(tally, tolerance),
    sure: (tally, tolerance) => tally.n > 255 && tally.mean > 0 && calm(tally, tolerance),
    never: () => false,
  };
  const OPTIONS = [
    ["plain", "the plain criterion"],
    ["black", "and never on black"],
    ["few", "and 256 samples at least"],
    ["sure", "and both"],
    ["never", "never stops"],
  ];

  // A pixel whose samples are 1/p with the probability p and 0 else, so that the right mean is 1.
  // Its mean after each batch; the last one is where it stops.
  function pixel([x, y], seed, p, tolerance, rule, limit = LIMIT) {
    const sampler = new Explore.parts.sampler.PixelSampler(x, y, seed);
    const tally = new Tally();
    const means = [];
    while (tally.n < limit) {
      for (let k = 0; k < BATCH; k++) {
        sampler.getSample();
        tally.push(sampler.next1d() < p ? 1 / p : 0);
      }
      means.push(tally.mean);
      if (RULES[rule](tally, tolerance)) break;
    }
    return { means, stopped: means.length * BATCH < limit };
  }

  function start(ui) {
    const tiles = ui.stage({
      label: "Tiles, one for each pixel: the brighter the larger its mean; those that have stopped are marked",
      x: [0, COLUMNS],
      y: [-0.1, ROWS],
      ratio: (width) => (width < 500 ? 0.54 : 0.46),
      margin: 4,
    });
    const graph = ui.stage({
      label: "The mean of all pixels against the number of batches",
      x: [0, LIMIT],
      y: [0, 2],
      ratio: (width) => (width < 500 ? 0.55 : 0.3),
      stretch: true,
      margin: [22, 20, 38, 30],
    });
    const say = ui.sentence();
    ui.slider({ key: "batches", label: "Samples so far", min: 1, max: LIMIT / BATCH, step: 1, value: 8, format: (k) => String(k * BATCH) });
    ui.choice({ key: "rule", label: "A pixel stops by", value: "plain", options: OPTIONS });
    ui.slider({ key: "rare", label: "A sample meets the lamp with p", min: 1, max: 10, step: 1, value: 7, format: (k) => `1/${2 ** k}` });
    ui.slider({ key: "tolerance", label: "Tolerance τ", min: 0.05, max: 0.5, step: 0.05, value: 0.25, format: (x) => `${Math.round(100 * x)} %` });
    ui.slider({ key: "seed", label: "Seed", min: 1, max: 50, step: 1, value: 1 });
    const show = ui.table({ caption: "All pixels" });

    // The pixels change with all controls but the first.
    let known = { key: "" };
    const pixelsOf = ({ rule, rare, tolerance, seed }) => {
      const key = [rule, rare, tolerance, seed].join();
      if (known.key === key) return known;
      const places = Array.from({ length: COLUMNS * ROWS }, (_, i) => [i % COLUMNS, Math.floor(i / COLUMNS)]);
      const pixels = places.map((place) => ({ place, ...pixel(place, seed, 2 ** -rare, tolerance, rule) }));
      const mean = (k) => pixels.reduce((sum, { means }) => sum + means[Math.min(k, means.length) - 1], 0) / pixels.length;
      const curve = Array.from({ length: LIMIT / BATCH }, (_, k) => [(k + 1) * BATCH, mean(k + 1)]);
      return (known = { key, pixels, curve });
    };

    ui.render = (state) => {
      const { pixels, curve } = pixelsOf(state);
      const now = state.batches;
      const frozen = pixels.filter(({ means, stopped }) => stopped && means.length <= now);
      const black = frozen.filter(({ means }) => means.at(-1) === 0).length;
      const mean = curve[now - 1][1];
      show([
        ["samples so far", String(now * BATCH)],
        ["stopped", `${frozen.length} of ${pixels.length}`],
        ["black for ever", String(black)],
        ["mean of all pixels", Explore.text(mean)],
        ["mean at the end", Explore.text(curve.at(-1)[1])],
        ["right mean", "1"],
      ]);
      const lost = Math.round(100 * (1 - curve.at(-1)[1]));
      const verdict = lost >= 10 ? ` ✗ At the end, ${lost} % of the light is missing.` : "";
      say(`${frozen.length} of ${pixels.length} pixels have stopped${black > 0 ? `, ${black} of them black for ever` : ""}.${verdict}`);
      drawTiles(tiles, pixels, now);
      drawGraph(graph, curve, now);
    };
  }

  function drawTiles(stage, pixels, now) {
    for (const { place: [x, y], means, stopped } of pixels) {
      const mean = means[Math.min(now, means.length) - 1];
      // As on a screen: 1 is grey, twice as much is white.
      const grey = Math.round(255 * Math.min(1, mean / 2) ** (1 / 2.2));
      const [px, py] = stage.at([x, y + 1]);
      const [width, height] = [stage.scale[0] - 1, stage.scale[1] - 1];
      stage.shape("rect", { x: px, y: py, width, height, style: `fill: rgb(${grey} ${grey} ${grey})` }, "plain");
      if (stopped && means.length <= now) {
        // A black pixel that has stopped is crossed out, any other one has a dot.
        if (mean === 0) stage.cross([x + 0.48, y + 0.52], 0.22 * stage.scale[0], "flaw");
        else stage.circle([x + 0.48, y + 0.52], 3.5, "frozen");
      }
    }
  }

  function drawGraph(stage, curve, now) {
    for (const y of [0, 1, 2]) {
      stage.line([[0, y], [LIMIT, y]], y === 1 ? "green dash" : "soft thin");
      stage.words([0, y], String(y), "ink small", { dx: -6, dy: 4, anchor: "end" });
    }
    for (const n of [0, 512, 1024, 1536, 2048]) stage.words([n, 0], String(n), "ink small", { dy: 16 });
    stage.words([LIMIT / 2, 0], "samples of a pixel that has not stopped", "ink small", { dy: 32 });
    stage.words([LIMIT, 2], "mean of all pixels; right is 1", "ink small", { dy: -8, anchor: "end" });
    stage.line(curve.map(([n, mean]) => [n, Math.min(2, mean)]), "blue");
    const [n, mean] = curve[now - 1];
    stage.line([[n, 0], [n, 2]], "ink dot");
    stage.circle([n, Math.min(2, mean)], 5, "solid red");
  }

  Explore.figure("stopping", { needs: ["sampler"], kernels: { pixel }, keepsPicture: true, start });
})();
