// Part 3, Task 1: from the unit square to the disk and up to the hemisphere, with and without the
// root, and Pearson's test of the result.
(function () {
  "use strict";

  const TAU = 2 * Math.PI;
  const [RINGS, SECTORS] = [4, 8];
  const CELLS = RINGS * SECTORS;
  // Right code is above this once in a thousand times: the quantile of χ² with 31 degrees of freedom.
  const RARE = 61.1;

  // The direction that belongs to two numbers, as `direct::lambert_sample` has it: the radius is
  // the root.
  const lifted = (r, height, turn) => {
    const { sin, cos } = Explore.parts.libm;
    return [r * cos(TAU * turn), r * sin(TAU * turn), height];
  };
  const malley = ([u, turn]) => lifted(Math.sqrt(u), Math.sqrt(1 - u), turn);
  // Uniform over the hemisphere, as `kit::warp` has it.
  const uniform = ([z, turn]) => lifted(Math.sqrt(Math.max(1 - z * z, 0)), z, turn);

  const CODES = {
    root: malley,
    plain: ([u, turn]) => lifted(u, Math.sqrt(1 - u * u), turn),
    power: ([u, turn]) => lifted(Math.sqrt(Math.sqrt(u)), Math.sqrt(1 - Math.sqrt(u)), turn),
    uniform,
  };
  const OPTIONS = [
    ["root", "r = √u"],
    ["plain", "r = u, without the root"],
    ["power", "r = ∜u, another power"],
    ["uniform", "uniform directions"],
  ];

  // The cell of a point of the disk: rings of equal area, cut into eighths.
  function cell([x, y]) {
    const ring = Math.min(RINGS - 1, Math.floor(RINGS * (x * x + y * y)));
    const half = y < 0 ? 4 : 0;
    const [a, b] = y < 0 ? [-x, -y] : [x, y];
    const sector = half + (a >= 0 ? (b < a ? 0 : 1) : b > -a ? 2 : 3);
    return ring * SECTORS + sector;
  }

  // Σ (counted - expected)² / expected over the cells.
  function pearson(directions) {
    const counts = new Array(CELLS).fill(0);
    for (const direction of directions) counts[cell(direction)] += 1;
    const expected = directions.length / CELLS;
    let sum = 0;
    for (const count of counts) sum += ((count - expected) * (count - expected)) / expected;
    return { counts, sum };
  }

  function start(ui) {
    const row = ui.row();
    const wide = (width) => width >= 500;
    const third = (width) => (wide(width) ? 1 / 3 : 1 / 2);
    const square = ui.stage({ to: row, share: third, label: "The unit square of random numbers u", x: [-0.06, 1.06], y: [-0.16, 1.06], ratio: 1.05, margin: 4 });
    square.handle({ key: "u", name: "u", label: "a point of the unit square", value: [0.25, 0.125], snap: 0.0625, within: [[0, 1], [0, 1]], colour: "red", dx: 12, dy: -10 });
    const disk = ui.stage({ to: row, share: third, label: "The unit disk from above, divided into cells of equal area", x: [-1.1, 1.1], y: [-1.3, 1.1], ratio: 1.05, margin: 4 });
    const dome = ui.stage({ to: row, share: (width) => (wide(width) ? 1 / 3 : 1), label: "The hemisphere from the side", x: [-1.1, 1.1], y: [-0.35, 1.15], ratio: (width) => (wide(width) ? 1.05 : 0.6), margin: 4 });
    const say = ui.sentence();
    ui.choice({ key: "code", label: "The code", value: "root", options: OPTIONS });
    ui.slider({ key: "power", label: "Number of samples", min: 5, max: 12, step: 1, value: 9, format: (k) => String(2 ** k) });
    ui.slider({ key: "seed", label: "Seed", min: 1, max: 50, step: 1, value: 1 });
    const show = ui.table({ caption: "The point u, and all samples" });

    ui.render = (state) => {
      const sampler = new Explore.parts.sampler.PixelSampler(0, 0, state.seed);
      const numbers = Array.from({ length: 2 ** state.power }, () => sampler.getSample());
      const directions = numbers.map(CODES[state.code]);
      const { counts, sum } = pearson(directions);
      const u = state.u.map((x) => Math.min(Math.max(x, 0), 1 - 2 ** -53));
      const chosen = CODES[state.code](u);
      const expected = numbers.length / CELLS;
      const fits = sum <= RARE;
      show([
        ["u", u.map(Explore.text).join(", ")],
        ["direction x", Explore.text(chosen[0])],
        ["direction y", Explore.text(chosen[1])],
        ["direction z", Explore.text(chosen[2])],
        ["expected in a cell", String(expected)],
        ["fewest, most in a cell", `${Math.min(...counts)}, ${Math.max(...counts)}`],
        ["χ²", { text: `${sum.toFixed(1)} ${fits ? "✓" : "✗"}`, mark: fits ? "right" : "wrong" }],
      ]);
      say(
        fits
          ? `χ² is ${sum.toFixed(1)}. About 31 is expected of right code: the points may well be uniform on the disk.`
          : `✗ χ² is ${sum.toFixed(1)}. Points that are uniform on the disk exceed ${RARE} once in a thousand times.`,
      );
      drawSquare(square, numbers, u);
      drawDisk(disk, directions, counts, expected, chosen);
      drawDome(dome, directions, chosen);
    };
  }

  const size = (count) => (count > 1024 ? 1.2 : count > 256 ? 1.7 : 2.4);

  function drawSquare(stage, numbers, u) {
    stage.rect([0, 0], [1, 1], "edge ink");
    for (let i = 1; i < RINGS; i++) stage.line([[i / RINGS, 0], [i / RINGS, 1]], "soft thin");
    for (let i = 1; i < SECTORS; i++) stage.line([[0, i / SECTORS], [1, i / SECTORS]], "soft thin");
    for (const point of numbers) stage.circle(point, size(numbers.length), "solid blue");
    stage.words([0.5, 0], "u: the square", "ink small", { dy: 20 });
  }

  function drawDisk(stage, directions, counts, expected, chosen) {
    // Cells with far too many points are hatched one way, those with far too few the other way.
    for (let ring = 0; ring < RINGS; ring++) {
      for (let sector = 0; sector < SECTORS; sector++) {
        const off = (counts[ring * SECTORS + sector] - expected) / Math.sqrt(expected);
        if (Math.abs(off) < 3) continue;
        stage.polygon(outline(ring, sector), off > 0 ? "hatch-red" : "dots-purple");
      }
    }
    for (let ring = 1; ring <= RINGS; ring++) {
      stage.circle([0, 0], stage.scale[0] * Math.sqrt(ring / RINGS), ring === RINGS ? "edge ink" : "line soft thin hole");
    }
    for (let sector = 0; sector < SECTORS / 2; sector++) {
      const [x, y] = [Math.cos((TAU * sector) / SECTORS), Math.sin((TAU * sector) / SECTORS)];
      stage.line([[-x, -y], [x, y]], "soft thin");
    }
    for (const [x, y] of directions) stage.circle([x, y], size(directions.length), "solid blue");
    stage.line([[0, 0], chosen.slice(0, 2)], "red");
    stage.circle(chosen.slice(0, 2), 5, "solid red");
    stage.words([0, -1], "the disk, from above", "ink small", { dy: 20 });
  }

  function outline(ring, sector) {
    const points = [];
    const [inner, outer] = [Math.sqrt(ring / RINGS), Math.sqrt((ring + 1) / RINGS)];
    for (let i = 0; i <= 6; i++) points.push([outer, (sector + i / 6) / SECTORS]);
    for (let i = 6; i >= 0; i--) points.push([inner, (sector + i / 6) / SECTORS]);
    return points.map(([r, turn]) => [r * Math.cos(TAU * turn), r * Math.sin(TAU * turn)]);
  }

  function drawDome(stage, directions, chosen) {
    const arc = Array.from({ length: 61 }, (_, i) => [Math.cos((Math.PI * i) / 60), Math.sin((Math.PI * i) / 60)]);
    stage.line([...arc, [1, 0]], "ink");
    for (const [x, y, z] of directions) {
      // Points on the far side are grey.
      stage.circle([x, z], size(directions.length), y < 0 ? "solid blue" : "solid soft");
    }
    stage.line([[chosen[0], 0], [chosen[0], chosen[2]]], "red dash");
    stage.circle([chosen[0], chosen[2]], 5, "solid red");
    stage.words([0, 0], "the hemisphere, from the side", "ink small", { dy: 20 });
  }

  Explore.figure("warp", { needs: ["libm", "sampler"], kernels: { malley, uniform, pearson }, start });
})();
