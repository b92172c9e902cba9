// Part 2, Task 2: the intervals of the three slabs, and what 0/0 and -0 do to them.
(function () {
  "use strict";

  const AXES = ["x", "y", "z"];

  // The distances to the low and the high plane of each axis, as floats.
  function quotients({ o, d, l, h }) {
    return AXES.map((_, i) => [(l[i] - o[i]) / d[i], (h[i] - o[i]) / d[i]]);
  }

  // The interval of one slab in exact fractions: [entry, exit] with null for an infinite end, or
  // "outside" if the ray is parallel to the slab and beside it.
  function slab(o, d, l, h) {
    const of = Explore.parts.exact.Fraction.of;
    if (d === 0) return l <= o && o <= h ? [null, null] : "outside";
    const ends = [l, h].map((plane) => of(plane).sub(of(o)).div(of(d)));
    return d > 0 ? ends : ends.reverse();
  }

  // The intersection of the three slabs and of t >= 0: [entry, exit], or null for a miss.
  function exact({ o, d, l, h }) {
    const slabs = AXES.map((_, i) => slab(o[i], d[i], l[i], h[i]));
    if (slabs.includes("outside")) return { slabs, inside: null };
    let first = Explore.parts.exact.Fraction.of(0);
    let last = null;
    for (const [entry, exit] of slabs) {
      if (entry && entry.cmp(first) > 0) first = entry;
      if (exit && (last === null || exit.cmp(last) < 0)) last = exit;
    }
    return { slabs, inside: last === null || first.cmp(last) <= 0 ? [first, last] : null };
  }

  // Code with a mistake: [entry, exit] from the six quotients. All but one leave NaN out.
  const numbers = (quotients) => quotients.filter((t) => !Number.isNaN(t));
  const entries = (pairs) => pairs.map(([t]) => t);
  const exits = (pairs) => pairs.map(([, t]) => t);
  const sorted = (pairs) => pairs.map(([a, b]) => (a > b ? [b, a] : [a, b]));
  const within = (pairs) => [Math.max(0, ...numbers(entries(pairs))), Math.min(...numbers(exits(pairs)))];
  const MISTAKES = {
    unswapped: within,
    zero: (pairs, d) => within(pairs.map(([l, h], i) => (d[i] < 0 ? [h, l] : [l, h]))),
    nan: (pairs) => [Math.max(0, ...entries(sorted(pairs))), Math.min(...exits(sorted(pairs)))],
    outer: (pairs) => [
      Math.max(0, Math.min(...numbers(entries(sorted(pairs))))),
      Math.max(...numbers(exits(sorted(pairs)))),
    ],
    flat: (pairs) => within(sorted(pairs.slice(0, 2))),
  };
  const RULES = [
    ["right", "right"],
    ["unswapped", "does not swap the planes if d is negative"],
    ["zero", "swaps them if d < 0, and -0 is not"],
    ["nan", "lets a NaN win"],
    ["outer", "earliest entry, latest exit"],
    ["flat", "forgets the z axis"],
  ];

  function start(ui) {
    const scene = ui.stage({
      label: "A box and a ray, seen along the z axis",
      x: [-5, 5],
      y: [-2.25, 2.25],
      ratio: (width) => (width < 500 ? 0.6 : 0.42),
      margin: 6,
    });
    scene.handle({ key: "low", name: "l", label: "low corner of the box", value: [-1, -1], colour: "blue", snap: 0.25, dx: -20, dy: 20 });
    scene.handle({ key: "high", name: "h", label: "high corner of the box", value: [1, 1], colour: "blue", snap: 0.25, dx: 14, dy: -10 });
    scene.handle({ key: "o", name: "o", label: "origin of the ray", value: [-3, 0.5], snap: 0.25, dx: -18, dy: -12 });
    scene.handle({ key: "tip", name: "d", label: "tip of the direction d", value: [-1, 0], colour: "orange", snap: 0.25, dx: 10, dy: 22 });
    const line = ui.stage({
      label: "The interval of t in which the ray is in each slab, in its range, and in all of them",
      x: [-6, 10],
      y: [-0.5, 4.5],
      ratio: (width) => (width < 500 ? 0.5 : 0.3),
      stretch: true,
      margin: [4, 8, 24, 54],
    });
    const say = ui.sentence();
    ui.choice({ key: "rule", label: "The code", value: "right", options: RULES });
    ui.slider({ key: "oz", label: "oz", min: -2, max: 2, step: 0.25, value: 0 });
    ui.slider({ key: "dz", label: "dz", min: -2, max: 2, step: 0.25, value: 0.25 });
    ui.toggle({ key: "minus", label: "zeros of d are -0", value: false });
    ui.buttons([
      ["Along a face: 0/0", () => Object.assign(ui.state, { o: [-3, 1], tip: [-1, 1], oz: 0, dz: 0.25 })],
      ["A flat box", () => Object.assign(ui.state, { low: [0, -1], high: [0, 1] })],
    ]);
    const show = ui.table({
      caption: "The distances to the six planes, in f64",
      head: ["axis", "(l - o) / d", "(h - o) / d", "entry e", "exit f"],
    });

    ui.render = (state) => {
      const zero = state.minus ? -0 : 0;
      const pair = (i, choose) => choose(state.low[i], state.high[i]);
      const given = {
        o: [...state.o, state.oz],
        d: [state.tip[0] - state.o[0], state.tip[1] - state.o[1], state.dz].map((x) => (x === 0 ? zero : x)),
        l: [pair(0, Math.min), pair(1, Math.min), -1],
        h: [pair(0, Math.max), pair(1, Math.max), 1],
      };
      const pairs = quotients(given);
      const truth = exact(given);
      const isPoint = given.d.every((x) => x === 0);
      show(pairs.map((pair, i) => tableRow(AXES[i], pair, truth.slabs[i])));
      drawScene(scene, state, given, truth);
      drawLine(line, truth);

      const hasNan = pairs.flat().some(Number.isNaN);
      const note = hasNan ? " 0/0 is NaN: the ray runs in a face, which belongs to the box." : "";
      const right = truth.inside
        ? `in the box from t = ${truth.inside[0]} to ${truth.inside[1] || "infinity"}`
        : "a miss";
      if (isPoint) {
        say(`The direction is 0, so the ray is a point: ${truth.inside ? "inside of the box" : "outside"}.`);
      } else if (state.rule === "right") {
        say(`The exact answer: ${right}.${note}`);
      } else {
        const [near, far] = MISTAKES[state.rule](pairs, given.d);
        const answer = near <= far ? `from ${Explore.text(near)} to ${Explore.text(far)}` : "a miss";
        const same = near <= far
          ? truth.inside && truth.inside[0].number() === near && (truth.inside[1]?.number() ?? Infinity) === far
          : !truth.inside;
        say(`The exact answer: ${right}. This code: ${answer}, ${same ? "✓ the same here" : "✗ wrong"}.${note}`);
      }
    };
  }

  function tableRow(axis, pair, slab) {
    const cell = (t) => (Number.isNaN(t) ? { text: "⚠ 0/0 = NaN", mark: "loud" } : Explore.text(t));
    if (slab === "outside") return [axis, ...pair.map(cell), { text: "outside", mark: "wrong" }, "of this slab"];
    return [axis, ...pair.map(cell), String(slab[0] ?? "-∞"), String(slab[1] ?? "∞")];
  }

  function drawScene(stage, state, { o, d, l, h }, truth) {
    for (const x of [l[0], h[0]]) stage.line([[x, -9], [x, 9]], "green dash thin");
    for (const y of [l[1], h[1]]) stage.line([[-9, y], [9, y]], "purple dash thin");
    stage.rect([l[0], l[1]], [h[0], h[1]], "tint blue");
    stage.rect([l[0], l[1]], [h[0], h[1]], "edge blue");
    stage.words([l[0], -2.25], "slab x", "green small", { dx: -4, dy: -6, anchor: "end" });
    stage.words([-5, h[1]], "slab y", "purple small", { dx: 4, dy: -5, anchor: "start" });
    const at = (t) => [o[0] + t * d[0], o[1] + t * d[1]];
    if (d[0] !== 0 || d[1] !== 0) {
      stage.line([at(0), at(40)], "soft dash");
      stage.arrow(at(0), at(1), "orange");
    }
    if (truth.inside) {
      const [first, last] = [truth.inside[0].number(), truth.inside[1]?.number() ?? 40];
      stage.line([at(first), at(last)], "red thick");
      stage.circle(at(first), 5, "solid red");
      stage.circle(at(last), 5, "hollow red");
    }
  }

  const ROWS = [["slab x", 4, "green", "hatch"], ["slab y", 3, "purple", "back"], ["slab z", 2, "orange", "dots"], ["range", 1, "ink", "hatch"]];

  function drawLine(stage, { slabs, inside }) {
    const [left, right] = stage.x;
    const clamp = (t, end) => (t === null ? end : Math.min(Math.max(t.number(), left), right));
    for (let t = -4; t <= 8; t += 2) {
      stage.line([[t, -0.5], [t, 4.5]], "soft thin dot");
      stage.words([t, -0.5], String(t), "ink small", { dy: 15 });
    }
    const bar = (row, [from, to], style) => stage.rect([from, row - 0.3], [Math.max(to, from), row + 0.3], style);
    for (const [i, [name, row, colour, pattern]] of ROWS.entries()) {
      stage.words([left, row], name, `${colour} small strong`, { dx: -6, dy: 5, anchor: "end" });
      const interval = i < 3 ? slabs[i] : [Explore.parts.exact.Fraction.of(0), null];
      if (interval === "outside") {
        stage.words([0, row], "nowhere: the ray is beside this slab", `${colour} small`, { dy: 5, anchor: "start" });
        continue;
      }
      const ends = [clamp(interval[0], left), clamp(interval[1], right)];
      bar(row, ends, `${pattern}-${colour}`);
      bar(row, ends, `edge ${colour}`);
    }
    stage.words([left, 0], "all", "red small strong", { dx: -6, dy: 5, anchor: "end" });
    if (inside) {
      const ends = [clamp(inside[0], left), clamp(inside[1], right)];
      bar(0, ends, "shade red");
      bar(0, ends, "edge red");
      for (const t of ends) stage.line([[t, -0.4], [t, 4.4]], "red thin");
    } else {
      stage.words([0, 0], "nowhere: a miss", "red small strong", { dy: 5, anchor: "start" });
    }
  }

  Explore.figure("slabs", { needs: ["exact"], kernels: { quotients }, exact, start });
})();
