// Part 1, Task 2: from a point of the film to the sensor and to a ray in the world.
(function () {
  "use strict";

  const DEGREE = Math.PI / 180;
  const tangent = (degrees) => Explore.parts.libm.tan(0.5 * degrees * DEGREE);

  // The camera of the worked example: it looks along +x.
  const EXAMPLE = [[0, 0, 1], [0, 1, 0], [-1, 0, 0]];

  // The chapter's formulas: the half sizes of the sensor, its point q, and the direction in a world
  // in which the camera's axes are `columns`.
  function through({ alpha, beta, columns }, [u, v]) {
    const [a, b] = [tangent(alpha), tangent(beta)];
    return { a, b, ...turned(columns, [(2 * u - 1) * a, (2 * v - 1) * b, -1]) };
  }

  function turned([r, s, c], q) {
    const world = [0, 1, 2].map((i) => r[i] * q[0] + s[i] * q[1] + c[i] * q[2]);
    const perLength = 1 / Math.sqrt(world[0] * world[0] + world[1] * world[1] + world[2] * world[2]);
    return { q, world, d: world.map((x) => x * perLength) };
  }

  // The point on the sensor that code with a mistake takes.
  const MISTAKES = {
    whole: ({ alpha, beta }, [u, v]) => {
      const { tan } = Explore.parts.libm;
      return [(2 * u - 1) * tan(alpha * DEGREE), (2 * v - 1) * tan(beta * DEGREE), -1];
    },
    degrees: ({ alpha, beta }, [u, v]) => {
      const { tan } = Explore.parts.libm;
      return [(2 * u - 1) * tan(0.5 * alpha), (2 * v - 1) * tan(0.5 * beta), -1];
    },
    quarter: ({ alpha, beta }, [u, v]) => [u * tangent(alpha), v * tangent(beta), -1],
    one: ({ beta }, [u, v]) => [(2 * u - 1) * tangent(beta), (2 * v - 1) * tangent(beta), -1],
    angles: ({ alpha, beta }, [u, v]) => [tangent((2 * u - 1) * alpha), tangent((2 * v - 1) * beta), -1],
  };
  const CODES = [
    ["right", "right"],
    ["whole", "takes the tangent of the whole angle"],
    ["degrees", "passes degrees to the tangent"],
    ["quarter", "maps [0, 1] to [0, 1]"],
    ["one", "vertical field of view for both axes"],
    ["angles", "spreads angles evenly"],
  ];

  function start(ui) {
    const row = ui.row();
    const film = ui.stage({
      to: row,
      share: (width) => (width < 500 ? 1 : 0.42),
      label: "The film in the shape of the sensor, with the point u, v",
      x: [-0.08, 1.08],
      y: [-0.16, 1.08],
      ratio: (width) => (width < 400 ? 0.62 : 0.8),
      margin: 6,
    });
    film.handle({ key: "uv", name: "u, v", label: "the point u, v on the film", value: [0.75, 0.5], snap: 0.0625, within: [[0, 1], [0, 1]], colour: "red", dx: 12, dy: -12 });
    const above = ui.stage({
      to: row,
      share: (width) => (width < 500 ? 1 : 0.58),
      label: "The camera, the sensor and the rays of five points of the film, from above",
      x: [-2.3, 2.3],
      y: [-0.35, 1.9],
      ratio: 0.58,
      margin: 4,
    });
    const say = ui.sentence();
    const angle = (x) => `${x}°`;
    ui.slider({ key: "alpha", label: "α, horizontal field of view", min: 2, max: 178, step: 2, value: 90, format: angle });
    ui.slider({ key: "beta", label: "β, vertical field of view", min: 2, max: 178, step: 2, value: 60, format: angle });
    ui.choice({ key: "code", label: "The code", value: "right", options: CODES });
    const show = ui.table({ caption: "The numbers of this ray" });

    ui.render = (state) => {
      const camera = { alpha: state.alpha, beta: state.beta, columns: EXAMPLE };
      const right = through(camera, state.uv);
      const wrong = state.code === "right" ? null : turned(EXAMPLE, MISTAKES[state.code](camera, state.uv));
      const vector = (v) => v.map((x) => Number(x.toPrecision(6))).join(", ");
      show([
        ["a = tan α/2", Explore.text(right.a)],
        ["b = tan β/2", Explore.text(right.b)],
        ["shape a : b", (right.a / right.b).toPrecision(5)],
        ["q", vector(right.q)],
        ["M q", vector(right.world)],
        ["d", vector(right.d)],
        ...(wrong ? [["d of this code", { text: vector(wrong.d), mark: same(wrong, right) ? "right" : "wrong" }]] : []),
      ]);
      const off = Math.atan2(right.q[0], 1) / DEGREE;
      const side = right.q[0] === 0 ? "straight ahead" : `${Math.abs(off).toFixed(1)}° to the ${off > 0 ? "right" : "left"}`;
      if (!wrong) say(`The ray of (${state.uv.join(", ")}) goes ${side}, seen from above.`);
      else if (same(wrong, right)) say(`✓ For this point, this code has the same ray: ${side}, seen from above.`);
      else say(`✗ The ray of this code is ${between(right.d, wrong.d)}° off.`);
      drawFilm(film, state, right, wrong);
      drawAbove(above, state, camera, right, wrong);
    };
  }

  const same = (a, b) => a.d.every((x, i) => Math.abs(x - b.d[i]) < 1e-12);
  const between = (a, b) => {
    const cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    return (Math.acos(Math.min(1, cosine)) / DEGREE).toFixed(1);
  };

  function drawFilm(stage, { uv }, right, wrong) {
    stage.setAspect(Math.min(4, Math.max(0.4, right.a / right.b)));
    for (let i = 0; i <= 4; i++) {
      stage.line([[i / 4, 0], [i / 4, 1]], "soft thin");
      stage.line([[0, i / 4], [1, i / 4]], "soft thin");
    }
    stage.rect([0, 0], [1, 1], "edge ink");
    stage.cross([0.5, 0.5], 5, "ink");
    stage.words([0, 0], "0, 0", "ink small", { dy: 17 });
    stage.words([1, 0], "1, 0", "ink small", { dy: 17 });
    // Where the wrong ray meets the sensor.
    if (wrong && !same(wrong, right)) {
      const at = [0, 1].map((i) => 0.5 + (0.5 * wrong.q[i]) / [right.a, right.b][i]);
      if (at.every((x) => x > -0.1 && x < 1.1)) {
        stage.line([uv, at], "orange dash");
        stage.cross(at, 7, "orange");
      }
    }
  }

  function drawAbove(stage, state, camera, right, wrong) {
    const reach = 1.75;
    const end = (q) => [q[0] * reach, reach];
    for (const u of [0, 0.25, 0.5, 0.75, 1]) {
      const { q } = through(camera, [u, 0.5]);
      stage.line([[0, 0], end(q)], `soft thin${u === 0 || u === 1 ? "" : " dash"}`);
      stage.circle([q[0], 1], 3, "solid blue");
    }
    stage.line([[-right.a, 1], [right.a, 1]], "blue thick");
    stage.words([Math.min(right.a, 1.7), 1], "sensor", "blue small", { dx: 10, dy: 16, anchor: "start" });
    stage.arrow([0, 0], [0, 0.55], "green");
    stage.words([0, 0.5], "-c", "green", { dx: -14 });
    stage.arrow([0, 0], [0.45, 0], "green");
    stage.words([0.45, 0], "r", "green", { dx: 10, dy: 5 });
    stage.line([[0, 0], end(right.q)], "red");
    stage.circle([right.q[0], 1], 5, "solid red");
    stage.words([right.q[0], 1], "q", "red strong", { dx: 12, dy: -8 });
    if (wrong && !same(wrong, right)) {
      stage.line([[0, 0], end(wrong.q)], "orange dash");
      stage.cross([wrong.q[0], 1], 6, "orange");
    }
    stage.circle([0, 0], 5, "solid ink");
    stage.words([0, 0], "camera", "ink small", { dy: 20 });
  }

  Explore.figure("camera", { needs: ["libm"], kernels: { through }, start });
})();
