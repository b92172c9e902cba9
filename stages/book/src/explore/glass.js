// Part 4, Task 1: where light goes at a boundary of glass, and how much of it.
(function () {
  "use strict";

  const of = (x) => Explore.parts.exact.Fraction.of(x);
  const BITS = 160;

  // The chapter's formulas in floats: the reflected fraction, from cosine and sine of the angle.
  function amplitudes(cosine, sine, eta) {
    const other = Math.sqrt(1 - eta * sine * (eta * sine));
    const p = (cosine - eta * other) / (cosine + eta * other);
    const s = (eta * cosine - other) / (eta * cosine + other);
    return { p, s, F: (p * p + s * s) / 2 };
  }

  // Without rounding but for the roots: direction [x, z] of any length, seen from the side of z.
  // The squares of all sines and cosines are fractions.
  function exact([x, z], ior) {
    const square = (q) => q.mul(q);
    const eta = z > 0 ? of(1).div(of(ior)) : of(ior);
    const length2 = square(of(x)).add(square(of(z)));
    const sine2 = square(of(x)).div(length2);
    const other2 = square(eta).mul(sine2);
    if (z === 0 || other2.cmp(of(1)) >= 0) return { eta, isTotal: true, F: of(1) };
    const cosine = of(1).sub(sine2).root(BITS);
    const other = of(1).sub(other2).root(BITS);
    const ratio = (a, b) => square(a.sub(b).div(a.add(b)));
    const F = ratio(cosine, eta.mul(other)).add(ratio(eta.mul(cosine), other)).div(of(2));
    // The refracted direction: the part along the surface times -eta, on the other side.
    const along = other2.root(BITS).number() * (x > 0 ? -1 : 1);
    return { eta, isTotal: false, F, refracted: [x === 0 ? 0 : along, other.number() * (z > 0 ? -1 : 1)] };
  }

  const unit = ([x, z]) => {
    const length = Math.hypot(x, z);
    return [x / length, z / length];
  };
  const snell = ([x, z], eta, sign = -1) => {
    const along = eta * x;
    return Math.abs(along) < 1 ? [sign * along, -Math.sign(z) * Math.sqrt(1 - along * along)] : null;
  };
  const MISTAKES = {
    straight: ([x, z]) => [-x, -z],
    oneEta: (o, ior) => snell(o, 1 / ior),
    inverse: (o, ior) => snell(o, o[1] > 0 ? ior : 1 / ior),
    sameSide: (o, ior) => snell(o, o[1] > 0 ? 1 / ior : ior, 1),
  };
  const CODES = [
    ["right", "right"],
    ["straight", "lets light go straight through"],
    ["oneEta", "uses the same η on both sides"],
    ["inverse", "inverts the index of refraction"],
    ["sameSide", "does not turn the part along the surface round"],
  ];

  function start(ui) {
    const row = ui.row();
    const view = ui.stage({
      to: row,
      share: (width) => (width < 500 ? 1 : 0.5),
      label: "A boundary with glass below, the direction to the viewer, and the directions of reflection and refraction",
      x: [-1.3, 1.3],
      y: [-1.3, 1.3],
      ratio: (width) => (width < 500 ? 0.86 : 0.95),
      margin: 2,
    });
    view.handle({ key: "o", name: "ωo", label: "tip of the direction to the viewer", value: [0.75, 1], snap: 0.0625, within: [[-1.25, 1.25], [-1.25, 1.25]], dx: 12, dy: -8 });
    const graph = ui.stage({
      to: row,
      share: (width) => (width < 500 ? 1 : 0.5),
      label: "The reflected fraction F against the angle, from outside and from inside",
      x: [0, 90],
      y: [0, 1],
      ratio: 0.75,
      stretch: true,
      margin: [22, 14, 38, 34],
    });
    const say = ui.sentence();
    ui.slider({ key: "ior", label: "ior", min: 1, max: 2.5, step: 0.0625, value: 1.5 });
    ui.choice({ key: "code", label: "The code", value: "right", options: CODES });
    const show = ui.table({ caption: "The numbers of this direction", head: ["", "computed in f64", "exact"] });

    ui.render = (state) => {
      if (state.o[0] === 0 && state.o[1] === 0) return say("The direction is 0: move its tip.");
      const o = unit(state.o);
      const truth = exact(state.o, state.ior);
      const eta = truth.eta.number();
      const computed = amplitudes(Math.abs(o[1]), Math.abs(o[0]), eta);
      const digits = (q) => (q ? q.decimal(10) : "none");
      const angle = (cosine) => `${((Math.acos(Math.min(1, Math.abs(cosine))) * 180) / Math.PI).toFixed(2)}°`;
      show([
        ["η", Explore.text(eta), String(truth.eta)],
        ["angle θo", angle(o[1]), ""],
        ["angle θi", truth.isTotal ? "none" : angle(truth.refracted[1]), ""],
        ["rp, rs", Number.isNaN(computed.p) ? "NaN, NaN" : `${computed.p.toPrecision(6)}, ${computed.s.toPrecision(6)}`, ""],
        ["F", Number.isNaN(computed.F) ? { text: "⚠ NaN", mark: "loud" } : Explore.text(computed.F), digits(truth.F)],
      ]);
      const wrong = state.code === "right" ? undefined : MISTAKES[state.code](o, state.ior);
      const percent = `${(100 * truth.F.number()).toFixed(1)} %`;
      const facts = truth.isTotal
        ? state.o[1] === 0
          ? "The direction is in the plane of the surface: all is reflected."
          : "Total internal reflection: nothing goes through, F = 1."
        : `${percent} is reflected, the rest goes through.`;
      const same = sameDirection(wrong, truth.isTotal ? null : truth.refracted);
      const verdict = wrong === undefined ? "" : same ? " This code: ✓ the same here." : wrong === null ? " ✗ This code finds no refracted direction." : " ✗ This code sends the light elsewhere.";
      say(facts + verdict);
      drawView(view, state, o, truth, same ? undefined : wrong);
      drawGraph(graph, state, o, truth);
    };
  }

  const sameDirection = (a, b) => (a && b ? Math.hypot(a[0] - b[0], a[1] - b[1]) < 1e-9 : a === b);

  function drawView(stage, { ior }, o, truth, wrong) {
    stage.rect([-3, -3], [3, 0], "dots-soft");
    stage.line([[-3, 0], [3, 0]], "ink");
    stage.line([[0, -1.25], [0, 1.25]], "soft dash");
    // The name of a half-space is not where light is refracted to.
    const name = (y, words) => {
      const side = o[1] * y < 0 && o[0] > 0 ? 1 : -1;
      stage.words([1.28 * side, y], words, "ink small", { anchor: side < 0 ? "start" : "end", dy: 4 });
    };
    name(1.2, "outside, n = 1");
    name(-1.22, `inside, n = ${Explore.text(ior)}`);
    stage.words([0, 1.2], "m", "ink", { dx: 10 });
    stage.arrow([0, 0], o, "ink");
    const F = truth.F.number();
    const tip = (d, words, colour) => stage.words([d[0] * 1.1, d[1] * 1.1], words, `${colour} strong small`, { dy: d[1] > 0 ? -2 : 12 });
    const mirrored = [-o[0], o[1]];
    if (F > 0) {
      stage.arrow([0, 0], mirrored, `blue ${F > 0.5 ? "thick" : "thin"}`);
      tip(mirrored, `F = ${F.toFixed(3)}`, "blue");
    }
    if (!truth.isTotal) {
      stage.arrow([0, 0], truth.refracted, `green ${F < 0.5 ? "thick" : "thin"}`);
      tip(truth.refracted, `1 - F = ${(1 - F).toFixed(3)}`, "green");
    }
    if (wrong) {
      stage.arrow([0, 0], wrong, "red dash");
      tip(wrong, "this code", "red");
    }
  }

  function drawGraph(stage, { ior }, o, truth) {
    for (const y of [0, 0.5, 1]) {
      stage.line([[0, y], [90, y]], "soft thin");
      stage.words([0, y], String(y), "ink small", { dx: -6, dy: 4, anchor: "end" });
    }
    for (const x of [0, 30, 60, 90]) stage.words([x, 0], `${x}°`, "ink small", { dy: 16 });
    stage.words([45, 0], "angle to the normal", "ink small", { dy: 32 });
    stage.words([90, 1], "reflected fraction F", "ink small", { dy: -8, anchor: "end" });
    const curve = (eta, style) => {
      const points = [];
      for (let x = 0; x <= 90; x += 0.5) {
        const { F } = amplitudes(Math.cos((x * Math.PI) / 180), Math.sin((x * Math.PI) / 180), eta);
        points.push([x, Number.isNaN(F) ? 1 : F]);
      }
      stage.line(points, style);
    };
    curve(1 / ior, "blue");
    curve(ior, "orange dash");
    stage.words([4, 0.14], "from outside", "blue small strong", { anchor: "start" });
    stage.words([4, 0.27], "- - from inside", "orange small strong", { anchor: "start" });
    const at = (Math.acos(Math.min(1, Math.abs(o[1]))) * 180) / Math.PI;
    stage.line([[at, 0], [at, 1]], "ink dot");
    stage.circle([at, truth.F.number()], 5, "solid red");
  }

  Explore.figure("glass", { needs: ["exact"], kernels: { amplitudes }, exact, start });
})();
