// Part 1, Task 4: how many digits of the near root are right, with the formula as it stands and
// with both remedies of "Where the formulas break".
(function () {
  "use strict";

  const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

  // The near root (b - √Δ) / a with Δ = b² - ac; NaN without a root.
  function textbook({ o, d, m, r }) {
    const f = minus(o, m);
    const [a, b, c] = [dot(d, d), -dot(f, d), dot(f, f) - r * r];
    return (b - Math.sqrt(b * b - a * c)) / a;
  }

  // The same root with Δ / a = r² - ℓ², and as c / q if the ray goes towards the sphere.
  function remedied({ o, d, m, r }) {
    const f = minus(o, m);
    const [a, b] = [dot(d, d), -dot(f, d)];
    const ratio = b / a;
    const nearest = f.map((x, i) => x + d[i] * ratio);
    const chord = Math.sqrt(a * (r * r - dot(nearest, nearest)));
    if (b < 0) return (b - chord) / a;
    const q = b + chord;
    const near = (dot(f, f) - r * r) / q;
    // A tangent at the ray's own origin: 0/0.
    return Number.isNaN(near) ? q / a : near;
  }

  // The near root as a fraction with 300 bits behind the point; null without one. Everything but
  // the root itself is exact.
  function exact({ o, d, m, r }) {
    const { Fraction, vector } = Explore.parts.exact;
    const [dv, f] = [vector.of(d), vector.sub(vector.of(o), vector.of(m))];
    const radius = Fraction.of(r);
    const a = vector.dot(dv, dv);
    const b = vector.dot(f, dv).neg();
    const c = vector.dot(f, f).sub(radius.mul(radius));
    const discriminant = b.mul(b).sub(a.mul(c));
    if (discriminant.sign() < 0) return null;
    return b.sub(discriminant.root(300)).div(a);
  }

  // The digits of a float, those that are right and the rest. The first n digits are right if the
  // error is at most half a unit of the n-th one; all are, if the error is at
  // most one unit in the last place.
  function compare(x, truth) {
    const { Fraction } = Explore.parts.exact;
    if (!Number.isFinite(x)) return { right: 0, good: "", bad: "none: the root of a negative number" };
    const value = Fraction.of(x);
    const error = Math.abs(value.sub(truth).number());
    const words = value.decimal(17);
    if (error <= Math.abs(x) * 2 ** -52) return { right: 17, good: words, bad: "" };
    const power = Math.floor(Math.log10(Math.abs(truth.number())));
    const right = Math.min(16, Math.max(0, Math.floor(1 + power - Math.log10(2 * error))));
    let seen = 0;
    let end = 0;
    while (seen < right && end < words.length) {
      if (/[1-9]/.test(words[end]) || (seen > 0 && words[end] === "0")) seen += 1;
      end += 1;
    }
    return { right, good: words.slice(0, end), bad: words.slice(end) };
  }

  // The distance of the origin from the surface: 10^exponent, with four digits.
  const gapWords = (exponent) => {
    const power = Math.floor(exponent);
    const digits = (10 ** (exponent - power)).toFixed(3);
    return `${Number(digits)}e${power}`;
  };
  const gap = (exponent) => Number(gapWords(exponent));

  // A sphere of radius 1 around the origin of coordinates. The ray comes from a direction that is
  // no axis; it passes the centre at the distance `beside`.
  function inputs({ exponent, beside }) {
    const distance = 1 + gap(exponent);
    // Two directions at right angles.
    const [back, side] = [[2 / 7, 3 / 7, 6 / 7], [6 / 7, 2 / 7, -3 / 7]];
    const point = (along, across) => back.map((x, i) => along * x + across * side[i]);
    // The origin is at this distance from the centre, the nearest point of the line at `beside`.
    const along = Math.sqrt(Math.max(0, distance * distance - beside * beside));
    return { o: point(along, beside), d: back.map((x) => -x), m: [0, 0, 0], r: 1 };
  }

  const relative = (x, truth) => {
    const { Fraction } = Explore.parts.exact;
    if (!Number.isFinite(x)) return 1;
    if (truth.sign() === 0) return x === 0 ? 0 : 1;
    return Math.min(1, Math.abs(Fraction.of(x).sub(truth).div(truth).number()));
  };

  function start(ui) {
    const picture = ui.stage({
      label: "A ray that passes a sphere of radius 1",
      x: [-1.6, 4.4],
      y: [-1.25, 1.35],
      ratio: (width) => (width < 500 ? 0.5 : 0.34),
    });
    const plot = ui.stage({
      label: "The relative error of t against the distance of the origin from the surface, for both formulas",
      x: [-8, 10],
      y: [-17, 0.6],
      ratio: (width) => (width < 500 ? 0.8 : 0.46),
      stretch: true,
      margin: [18, 12, 40, 46],
    });
    const say = ui.sentence();
    ui.slider({
      key: "exponent",
      label: "Distance from the surface",
      min: -8,
      max: 10,
      step: 0.25,
      value: 3,
      format: (k) => `${gapWords(k)} r`,
    });
    ui.slider({
      key: "beside",
      label: "The line passes the centre at",
      min: 0,
      max: 1.25,
      step: 0.0625,
      value: 0.625,
      format: (x) => `${Explore.text(x)} r`,
    });
    const show = ui.table({ caption: "The distance t, with 17 digits", head: ["", "t", "right"] });

    // The curves depend on one slider only.
    let curves = { beside: NaN };
    const measured = (beside) => {
      if (curves.beside === beside) return curves;
      const points = [];
      for (let k = -8; k <= 10; k += 0.125) {
        const given = inputs({ exponent: k, beside });
        const truth = exact(given);
        if (!truth || truth.sign() <= 0) continue;
        points.push([k, relative(textbook(given), truth), relative(remedied(given), truth)]);
      }
      return (curves = { beside, points });
    };

    ui.render = (state) => {
      const given = inputs(state);
      const truth = exact(given);
      const answers = [["textbook", textbook(given)], ["remedied", remedied(given)]];
      if (!truth) {
        show([["exact", "no hit", ""], ...answers.map(([name, t]) => [name, Number.isFinite(t) ? `${t} (wrong)` : "no hit", ""])]);
        const wrong = answers.filter(([, t]) => Number.isFinite(t)).map(([name]) => name);
        say(wrong.length ? `The ray misses. ✗ ${wrong.join(" and ")} finds a hit.` : "The ray misses, and both formulas say so.");
      } else {
        const rows = answers.map(([name, t]) => [name, compare(t, truth)]);
        show([
          ["exact", truth.decimal(17), ""],
          ...rows.map(([name, { good, bad, right }]) => [
            name,
            { parts: [{ text: good }, { tag: "mark", text: bad }] },
            `${right === 0 ? "✗ none" : right > 16 ? "✓ all, ± 1 ulp" : right}`,
          ]),
        ]);
        const [first, second] = rows.map(([, { right }]) => (right > 16 ? "all digits" : right === 0 ? "no digit" : `${right} digit${right > 1 ? "s" : ""}`));
        say(`Of t, the textbook formula gets ${first} right, the remedied one ${second}.`);
      }
      drawPicture(picture, state, truth);
      drawPlot(plot, state, measured(state.beside));
    };
  }

  function drawPicture(stage, { exponent, beside }, truth) {
    stage.circle([0, 0], stage.scale[0], "edge blue");
    stage.circle([0, 0], 3, "solid blue");
    stage.words([0, 0], "m", "blue", { dx: -12, dy: 14 });
    const distance = 1 + gap(exponent);
    const along = Math.sqrt(Math.max(0, distance * distance - beside * beside));
    const eye = Math.min(along, 4);
    if (along > 4) {
      stage.line([[4.3, beside], [3.4, beside]], "ink dot");
      stage.words([4.3, beside], `o, at ${distance > 1000 ? distance.toExponential(0).replace("+", "") : distance.toFixed(1)} r`, "ink small", { dy: -8, anchor: "end" });
    } else {
      stage.circle([eye, beside], 4, "solid ink");
      stage.words([eye, beside], "o", "ink", { dx: 10, dy: -8, anchor: "start" });
    }
    stage.arrow([Math.min(eye, 3.4), beside], [-1.5, beside], "ink");
    if (beside > 0) {
      stage.line([[0, 0], [0, beside]], "green dash");
      stage.words([0, beside / 2], "ℓ", "green strong", { dx: -10, dy: 5 });
    }
    if (truth) {
      const half = Math.sqrt(Math.max(0, 1 - beside * beside));
      stage.circle([half, beside], 5, "solid red");
      stage.words([half, beside], "t", "red strong", { dx: 10, dy: 18 });
    } else {
      stage.words([0, 1], "no hit", "red strong", { dx: 80, dy: 0 });
    }
  }

  function drawPlot(stage, { exponent }, { points }) {
    const log = (error) => Math.max(-17, Math.log10(error || 1e-17));
    for (const power of [-16, -12, -8, -4, 0]) {
      stage.line([[-8, power], [10, power]], "soft thin");
      stage.words([-8, power], `1e${power}`, "ink small", { dx: -6, dy: 4, anchor: "end" });
    }
    for (const power of [-8, -4, 0, 4, 8]) {
      stage.words([power, -17], `1e${power}`, "ink small", { dy: 16 });
    }
    stage.words([1, -17], "distance from the surface, in radii", "ink small", { dy: 33 });
    stage.words([-8, 0.6], "relative error of t", "ink small", { dx: -30, dy: -4, anchor: "start" });
    stage.line(points.map(([k, error]) => [k, log(error)]), "red");
    stage.line(points.map(([k, , error]) => [k, log(error)]), "green dash");
    stage.words([5.4, -8.6], "textbook", "red strong", { anchor: "end" });
    stage.words([9.8, -14.4], "remedied", "green strong", { anchor: "end" });
    stage.line([[exponent, -17], [exponent, 0.6]], "ink dot");
  }

  Explore.figure("sphere", { needs: ["exact"], kernels: { textbook, remedied }, keepsPicture: true, exact, start });
})();
