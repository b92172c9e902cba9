// Part 3, Tasks 2 and 3: one lamp, sampled by uniform directions and by points of the lamp.
(function () {
  "use strict";

  const TAU = 2 * Math.PI;
  const VALUE = 0.8 * (1 / Math.PI);
  const RADIANCE = 10;

  // What one sample brings to a floor at the origin from a square lamp {x, height, edge}. First a
  // uniform direction.
  function byDirection({ x, height, edge }, [z, turn]) {
    const { sin, cos } = Explore.parts.libm;
    const r = Math.sqrt(Math.max(1 - z * z, 0));
    const stretch = height / z;
    const there = [stretch * (r * cos(TAU * turn)), stretch * (r * sin(TAU * turn))];
    const meets = Math.abs(there[0] - x) <= 0.5 * edge && Math.abs(there[1]) <= 0.5 * edge;
    return { there, value: meets ? VALUE * RADIANCE * z * TAU : 0 };
  }

  // Then a uniform point of the lamp: the density of its direction is r² / (A cos θl).
  function byPoint({ x, height, edge }, u) {
    const there = [x + edge * (u[0] - 0.5), edge * (u[1] - 0.5)];
    const square = there[0] * there[0] + there[1] * there[1] + height * height;
    const cosine = height / Math.sqrt(square);
    const density = square / (edge * edge * cosine);
    return { there, value: (VALUE * RADIANCE * cosine) / density };
  }

  const PLATE = { half: 0.5, height: 1 };

  // Whether the plate is between the floor and a point at the lamp's height.
  const hidden = ({ height, plate, isThere }, [x]) => {
    if (!isThere) return false;
    return Math.abs((x * PLATE.height) / height - plate) <= PLATE.half;
  };

  // What the two estimates approach: the midpoint rule over the lamp.
  function integral(scene) {
    const [columns, rows] = [1200, 24];
    let sum = 0;
    for (let i = 0; i < columns; i++) {
      for (let j = 0; j < rows; j++) {
        const point = byPoint(scene, [(i + 0.5) / columns, (j + 0.5) / rows]);
        if (!hidden(scene, point.there)) sum += point.value;
      }
    }
    return sum / (columns * rows);
  }

  const SHADOWS = [
    ["right", "ends just before the lamp"],
    ["lamp", "reaches the lamp itself"],
    ["ceiling", "goes on behind the lamp"],
    ["none", "no shadow ray"],
  ];
  const BINS = ["0", "< ½", "½", "1", "2", "4", "8", "16", "≥ 32"];
  const bin = (ratio) => (ratio === 0 ? 0 : Math.min(8, Math.max(1, 3 + Math.floor(Math.log2(ratio)))));

  function start(ui) {
    const view = ui.stage({
      label: "A floor, a lamp above it that shines down, the ceiling, and the first samples, from the side",
      x: [-3, 3],
      y: [-0.35, 3.3],
      ratio: (width) => (width < 500 ? 0.62 : 0.4),
      margin: 4,
    });
    view.handle({ key: "lamp", name: "lamp", label: "centre of the lamp", value: [0, 2], snap: 0.125, within: [[-2.5, 2.5], [1.25, 2.875]], colour: "orange", dx: 12, dy: -12 });
    view.handle({ key: "plate", name: "plate", label: "centre of the plate between floor and lamp", value: [1.5, PLATE.height], snap: 0.125, within: [[-2.5, 2.5], [1, 1]], free: [true, false], colour: "ink", dx: 10, dy: 22 });
    const row = ui.row();
    const half = (width) => (width < 500 ? 1 : 0.5);
    const means = ui.stage({
      to: row,
      share: half,
      label: "The means of both estimates against the number of samples",
      x: [0, 12],
      y: [0, 3],
      ratio: 0.62,
      stretch: true,
      margin: [22, 20, 38, 30],
    });
    const histogram = ui.stage({
      to: row,
      share: half,
      label: "How often the samples of both estimates have which size, in multiples of the right value",
      x: [-0.6, 8.6],
      y: [0, 1],
      ratio: 0.62,
      stretch: true,
      margin: [22, 10, 38, 48],
    });
    const say = ui.sentence();
    ui.slider({ key: "edge", label: "Edge of the lamp", min: 0.125, max: 2, step: 0.125, value: 1 });
    ui.slider({ key: "power", label: "Samples", min: 0, max: 12, step: 1, value: 8, format: (k) => String(2 ** k) });
    ui.slider({ key: "seed", label: "Seed", min: 1, max: 50, step: 1, value: 1 });
    ui.toggle({ key: "isThere", label: "the plate is there", value: false });
    ui.choice({ key: "shadow", label: "The shadow ray", value: "right", options: SHADOWS });
    const show = ui.table({ caption: "Both estimates", head: ["", "directions", "points of the lamp"] });

    ui.render = (state) => {
      const scene = { x: state.lamp[0], height: state.lamp[1], edge: state.edge, plate: state.plate[0], isThere: state.isThere };
      const right = integral(scene);
      const n = 2 ** state.power;
      const draw = (estimate, seen) => {
        const sampler = new Explore.parts.sampler.PixelSampler(0, 0, state.seed);
        return Array.from({ length: n }, () => {
          const sample = estimate(scene, sampler.getSample());
          return { ...sample, value: seen(sample.there) ? sample.value : 0 };
        });
      };
      const lit = (there) => !hidden(scene, there);
      const byCode = { right: lit, lamp: () => false, ceiling: () => false, none: () => true }[state.shadow];
      const both = [draw(byDirection, lit), draw(byPoint, byCode)];
      const mean = (samples) => samples.reduce((sum, { value }) => sum + value, 0) / samples.length;
      const deviation = (samples) => {
        const m = mean(samples);
        return samples.length < 2 ? NaN : Math.sqrt(samples.reduce((sum, { value }) => sum + (value - m) ** 2, 0) / (samples.length - 1));
      };
      const [directions, points] = both.map(mean);
      const short = (x) => (Number.isNaN(x) ? "" : x.toPrecision(4));
      show([
        ["estimate", short(directions), short(points)],
        ["right value", short(right), short(right)],
        ["black samples", ...both.map((samples) => String(samples.filter(({ value }) => value === 0).length))],
        ["σ of one sample", ...both.map((samples) => short(deviation(samples)))],
        ["σ / √N", ...both.map((samples) => short(deviation(samples) / Math.sqrt(n)))],
      ]);
      const off = (value) => (right === 0 ? (value === 0 ? "right" : "wrong") : `${(100 * Math.abs(value / right - 1)).toFixed(1)} % off`);
      const wrong = {
        right: "",
        lamp: " ✗ The lamp blocks its own light.",
        ceiling: " ✗ The ceiling behind the lamp blocks its light.",
        none: state.isThere ? " ✗ The plate casts no shadow." : "",
      }[state.shadow];
      say(`With ${n} sample${n > 1 ? "s" : ""}, uniform directions are ${off(directions)}, points of the lamp ${off(points)}.${wrong}`);
      drawView(view, scene, state, both);
      drawMeans(means, both, right, both.map(deviation));
      drawHistogram(histogram, both, right);
    };
  }

  function drawView(stage, scene, { shadow }, both) {
    const { x, height, edge } = scene;
    stage.rect([-4, 3.05], [4, 3.6], "hatch-soft");
    stage.line([[-4, 3.05], [4, 3.05]], "ink");
    stage.words([-2.95, 3.05], "ceiling", "ink small", { dy: 16, anchor: "start" });
    stage.rect([-4, -1], [4, 0], "hatch-soft");
    stage.line([[-4, 0], [4, 0]], "ink");
    if (scene.isThere) stage.line([[scene.plate - PLATE.half, PLATE.height], [scene.plate + PLATE.half, PLATE.height]], "ink thick");
    else stage.line([[scene.plate - PLATE.half, PLATE.height], [scene.plate + PLATE.half, PLATE.height]], "soft dot");
    for (const { there, value } of both[0].slice(0, 40)) {
      const length = Math.hypot(there[0], height) || 1;
      const end = value > 0 ? [there[0], height] : [(1.2 * there[0]) / length, (1.2 * height) / length];
      stage.line([[0, 0], end], value > 0 ? "red" : "soft thin dash");
    }
    for (const { there, value } of both[1].slice(0, 12)) {
      const reach = { right: 0.96, lamp: 1, ceiling: 3.05 / height, none: 0 }[shadow];
      stage.line([[0, 0], [there[0] * reach, height * reach]], `green ${value > 0 ? "" : "dash"} thin`);
      stage.circle([there[0], height], 2.5, "solid green");
    }
    stage.line([[x - edge / 2, height], [x + edge / 2, height]], "orange thick");
    stage.circle([0, 0], 5, "solid ink");
  }

  function drawMeans(stage, both, right, deviations) {
    const top = 3;
    const scale = right === 0 ? 1 : right;
    for (const y of [0, 1, 2, 3]) {
      stage.line([[0, y], [12, y]], "soft thin");
      stage.words([0, y], String(y), "ink small", { dx: -6, dy: 4, anchor: "end" });
    }
    for (const k of [0, 4, 8, 12]) stage.words([k, 0], String(2 ** k), "ink small", { dy: 16 });
    stage.words([6, 0], "number of samples", "ink small", { dy: 32 });
    stage.words([12, 3], "mean / right value, and 1 ± σ / √N", "ink small", { dy: -8, anchor: "end" });
    // One standard error on each side of the right value.
    deviations.forEach((deviation, i) => {
      if (Number.isNaN(deviation)) return;
      const edge = (sign) => (k) => [k, Math.min(top, Math.max(0, 1 + (sign * deviation) / scale / Math.sqrt(2 ** k)))];
      const steps = Array.from({ length: 49 }, (_, k) => k / 4);
      stage.polygon([...steps.map(edge(1)), ...steps.reverse().map(edge(-1))], ["tint red", "dots-green"][i]);
    });
    both.forEach((samples, i) => {
      let sum = 0;
      const points = samples.map(({ value }, k) => {
        sum += value;
        return [Math.log2(k + 1), Math.min(top + 0.2, sum / (k + 1) / scale)];
      });
      stage.line(points, ["red", "green thick dash"][i]);
    });
    stage.words([8.5, 2.6], "directions", "red small strong", { anchor: "start" });
    stage.words([8.5, 2.2], "- - points", "green small strong", { anchor: "start" });
  }

  function drawHistogram(stage, both, right) {
    for (const y of [0, 0.5, 1]) {
      stage.line([[-0.6, y], [8.6, y]], "soft thin");
      stage.words([-0.6, y], `${100 * y} %`, "ink small", { dx: -4, dy: 4, anchor: "end" });
    }
    BINS.forEach((words, i) => stage.words([i, 0], words, "ink small", { dy: 16 }));
    stage.words([4, 0], "from this multiple of the right value on", "ink small", { dy: 32 });
    stage.words([8.6, 1], "share of the samples", "ink small", { dy: -8, anchor: "end" });
    both.forEach((samples, i) => {
      const counts = new Array(BINS.length).fill(0);
      for (const { value } of samples) counts[bin(right === 0 ? value : value / right)] += 1;
      counts.forEach((count, k) => {
        if (count === 0) return;
        const [from, to] = i === 0 ? [k - 0.36, k] : [k, k + 0.36];
        const height = Math.max(count / samples.length, 0.01);
        stage.rect([from, 0], [to, height], i === 0 ? "hatch-red" : "dots-green");
        stage.rect([from, 0], [to, height], `edge ${i === 0 ? "red" : "green"}`);
      });
    });
  }

  Explore.figure("lamp", { needs: ["libm", "sampler"], kernels: { byDirection, byPoint }, keepsPicture: true, start });
})();
