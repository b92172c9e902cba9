// Part 1, Task 3: the weights of a point, and the points that code with a mistake accepts.
(function () {
  "use strict";

  const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - b[1] * a[2], a[2] * b[0] - b[2] * a[0], a[0] * b[1] - b[0] * a[1]];

  // The chapter's formulas in floats: determinant, weights and distance, without any decision.
  function cramer([o, d, p0, p1, p2]) {
    const s = minus(o, p0);
    const [e1, e2] = [minus(p1, p0), minus(p2, p0)];
    const [h, g] = [cross(d, e2), cross(s, e1)];
    const volume = dot(e1, h);
    const perVolume = 1 / volume;
    return { D: volume, b1: dot(s, h) * perVolume, b2: dot(d, g) * perVolume, t: dot(e2, g) * perVolume };
  }

  // The same in exact fractions. The right answer is decided by these alone.
  function exact(inputs) {
    const { vector } = Explore.parts.exact;
    const [o, d, p0, p1, p2] = inputs.map(vector.of);
    const [e1, e2, s] = [vector.sub(p1, p0), vector.sub(p2, p0), vector.sub(o, p0)];
    const D = vector.dot(e1, vector.cross(d, e2));
    if (D.sign() === 0) return { D, hits: false };
    const b1 = vector.dot(s, vector.cross(d, e2)).div(D);
    const b2 = vector.dot(d, vector.cross(s, e1)).div(D);
    const t = vector.dot(e2, vector.cross(s, e1)).div(D);
    const b0 = Explore.parts.exact.Fraction.of(1).sub(b1).sub(b2);
    return { D, b0, b1, b2, t, hits: [b0, b1, b2, t].every((x) => x.sign() >= 0) };
  }

  // What each mistake accepts, by the numbers that it computes.
  const MISTAKES = {
    culls: ({ D, b1, b2 }) => D > 0 && b1 >= 0 && b2 >= 0 && b1 + b2 <= 1,
    wedge: ({ D, b1, b2 }) => D !== 0 && b1 >= 0 && b2 >= 0,
    parallelogram: ({ D, b1, b2 }) => D !== 0 && b1 >= 0 && b2 >= 0 && b1 <= 1 && b2 <= 1,
    epsilon: ({ D, b1, b2 }) => Math.abs(D) >= 1e-8 && b1 >= 0 && b2 >= 0 && b1 + b2 <= 1,
  };
  const RULES = [
    ["right", "right: no weight is negative"],
    ["culls", "culls back faces"],
    ["wedge", "does not test b1 + b2 ≤ 1"],
    ["parallelogram", "tests b1 ≤ 1 and b2 ≤ 1 instead"],
    ["epsilon", "rejects |D| < 1e-8"],
  ];

  function start(ui) {
    const stage = ui.stage({
      label: "The plane of a triangle, seen from the side that its normal points to",
      x: [-3, 7.5],
      y: [-2, 5.5],
      ratio: (width) => (width < 500 ? 0.95 : 0.62),
    });
    stage.handle({ key: "p0", name: "p0", label: "vertex p0", value: [0, 0], colour: "blue", dx: -32, dy: 18 });
    stage.handle({ key: "p1", name: "p1", label: "vertex p1", value: [4, 0], colour: "blue", dx: 12, dy: 20 });
    stage.handle({ key: "p2", name: "p2", label: "vertex p2", value: [0, 4], colour: "blue", dx: -14, dy: -16 });
    stage.handle({ key: "p", name: "p", label: "point p where the ray meets the plane", value: [1, 2], colour: "red" });
    const say = ui.sentence();
    ui.choice({ key: "rule", label: "The code", value: "right", options: RULES });
    ui.choice({
      key: "side",
      label: "The ray comes",
      value: "front",
      options: [["front", "from the side of the normal"], ["back", "from behind"]],
    });
    ui.slider({
      key: "scale",
      label: "Size of everything",
      min: -24,
      max: 0,
      step: 1,
      value: 0,
      format: (k) => (k === 0 ? "1" : `2^${k} = ${(2 ** k).toPrecision(3)}`),
    });
    const show = ui.table({
      caption: "The numbers of this ray",
      head: ["", "computed in f64", "exact"],
    });

    ui.render = (state) => {
      const scale = 2 ** state.scale;
      const d = [-1, -0.5, state.side === "front" ? -2 : 2];
      const flat = ([x, y]) => [scale * x, scale * y, 0];
      const [p0, p1, p2, p] = ["p0", "p1", "p2", "p"].map((key) => flat(state[key]));
      const o = p.map((x, i) => x - 2 * scale * d[i]);
      const inputs = [o, d, p0, p1, p2];
      const computed = cramer(inputs);
      const truth = exact(inputs);
      draw(stage, state, computed, truth);

      const row = (name, float, fraction) => [name, Explore.text(float), fraction ? String(fraction) : "none"];
      const b0 = 1 - computed.b1 - computed.b2;
      show([
        row("D", computed.D, truth.D),
        row("b0", b0, truth.b0),
        row("b1", computed.b1, truth.b1),
        row("b2", computed.b2, truth.b2),
        row("t", computed.t, truth.t),
      ]);

      const right = truth.hits ? `a hit at t = ${truth.t}` : why(truth);
      if (state.rule === "right") {
        say(`The exact answer: ${right}.`);
      } else {
        const accepts = MISTAKES[state.rule](computed) && computed.t >= 0;
        const mark = accepts === truth.hits ? "✓ the same answer here" : "✗ wrong";
        say(`The exact answer: ${right}. This code answers: ${accepts ? "a hit" : "a miss"}, ${mark}.`);
      }
    };
  }

  function why(truth) {
    if (truth.D.sign() === 0) return "a miss, the triangle has no area";
    const negative = ["b0", "b1", "b2"].filter((name) => truth[name].sign() < 0);
    return `a miss, ${negative.join(" and ")} ${negative.length > 1 ? "are" : "is"} negative`;
  }

  function draw(stage, state, computed, truth) {
    const { p0, p1, p2, p } = state;
    const along = (a, b, s) => [a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])];
    const at = (b1, b2) => [0, 1].map((i) => p0[i] + b1 * (p1[i] - p0[i]) + b2 * (p2[i] - p0[i]));
    const area = (p1[0] - p0[0]) * (p2[1] - p0[1]) - (p1[1] - p0[1]) * (p2[0] - p0[0]);

    // What the code accepts. A mistake that looks at D accepts all of its region or nothing.
    const region = { wedge: [at(0, 0), at(60, 0), at(0, 60)], parallelogram: [at(0, 0), at(1, 0), at(1, 1), at(0, 1)] };
    const accepted = region[state.rule] || [p0, p1, p2];
    const middle = { ...computed, b1: 0.25, b2: 0.25 };
    const isEmpty = area === 0 || (state.rule !== "right" && !MISTAKES[state.rule](middle));
    if (!isEmpty && state.rule !== "right") stage.polygon(accepted, "hatch-red");
    for (const [a, b] of [[p0, p1], [p1, p2], [p2, p0]]) {
      stage.line([along(a, b, -9), along(a, b, 10)], "soft dash thin");
    }
    // Each weight is the area of the triangle opposite of its vertex.
    if (truth.hits) {
      stage.polygon([p, p1, p2], "tint blue");
      stage.polygon([p, p2, p0], "back-green");
      stage.polygon([p, p0, p1], "dots-purple");
    }
    stage.polygon([p0, p1, p2], "edge blue");
    if (area !== 0) {
      for (const [b1, b2, name] of [[1.05, 0.4, "b0 < 0"], [-0.4, 0.62, "b1 < 0"], [0.62, -0.36, "b2 < 0"]]) {
        stage.words(at(b1, b2), name, "soft small");
      }
    }
    if (truth.hits) {
      const centre = (a, b, c) => [(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3];
      for (const [name, corners, colour] of [["b0", [p, p1, p2], "blue"], ["b1", [p, p2, p0], "green"], ["b2", [p, p0, p1], "purple"]]) {
        if (truth[name].sign() > 0) stage.words(centre(...corners), name, `${colour} strong`, { dy: 5 });
      }
    }
    // The ray, as its shadow on the plane.
    const eye = [p[0] + 2, p[1] + 1];
    stage.line([eye, p], "ink dash");
    stage.circle(eye, 4, "solid ink");
    stage.words(eye, state.side === "front" ? "o, above" : "o, below", "ink small", { dx: 8, dy: -8, anchor: "start" });
    if (isEmpty && area !== 0) {
      stage.words(along(p1, p2, 0.5), "accepts no point", "red strong", { dx: 60, dy: -40 });
    }
  }

  Explore.figure("triangle", { needs: ["exact"], kernels: { cramer }, exact, start });
})();
