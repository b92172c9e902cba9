// Compares the kernels of the figures with the records that `kernels.rs` wrote, bit for bit.
// Usage: node bits.js FOLDER
"use strict";
const { readFileSync, readdirSync } = require("node:fs");
const { join } = require("node:path");
const vm = require("node:vm");

const scripts = join(__dirname, "../../src/explore");
for (const file of ["explore.js", ...readdirSync(scripts).filter((file) => file.endsWith(".js") && file !== "explore.js")]) {
  vm.runInThisContext(readFileSync(join(scripts, file), "utf8"), { filename: file });
}
const { figures, parts } = globalThis.Explore;
const kernel = (name) => figures[name].kernels;
const { Fraction } = parts.exact;

const vectors = (numbers) => {
  const found = [];
  for (let i = 0; i + 3 <= numbers.length; i += 3) found.push(numbers.slice(i, i + 3));
  return found;
};

const sphere = (numbers) => {
  const [o, d, m] = vectors(numbers);
  return { o, d, m, r: numbers[9] };
};
const box = (numbers) => {
  const [o, d, l, h] = vectors(numbers);
  return { o, d, l, h };
};

function samples([x, y, seed, strata]) {
  const sampler = new parts.sampler.PixelSampler(x, y, seed, strata);
  sampler.getSample();
  return [...sampler.getSample(), ...sampler.next2d()];
}

// For each file of records: the results for its inputs.
const RESULTS = {
  sin: ([x]) => [parts.libm.sin(x)],
  cos: ([x]) => [parts.libm.cos(x)],
  tan: ([x]) => [parts.libm.tan(x)],

  triangle(numbers) {
    const [o, d, ...corners] = vectors(numbers);
    const { D, b1, b2, t } = kernel("triangle").cramer([o, d, ...corners]);
    const hits = D !== 0 && !(b1 < 0) && !(b1 > 1) && !(b2 < 0) && !(b1 + b2 > 1) && t >= 0 && t <= Infinity;
    return hits ? [1, t, ...o.map((x, i) => x + d[i] * t)] : [0, 0, 0, 0, 0];
  },

  exact_triangle(numbers) {
    const { hits, t } = figures.triangle.exact(vectors(numbers));
    return hits ? [1, t.number()] : [0, 0];
  },

  sphere_textbook: (numbers) => [kernel("sphere").textbook(sphere(numbers))],
  sphere_remedied: (numbers) => [kernel("sphere").remedied(sphere(numbers))],
  exact_sphere(numbers) {
    const given = sphere(numbers);
    if (given.d.every((x) => x === 0)) return [NaN];
    return [figures.sphere.exact(given)?.number() ?? NaN];
  },

  slabs(numbers) {
    let [near, far] = [0, Infinity];
    for (const pair of kernel("slabs").quotients(box(numbers))) {
      const [entry, exit] = pair[0] > pair[1] ? [pair[1], pair[0]] : pair;
      if (entry > near) near = entry;
      if (!(exit >= far)) far = Number.isNaN(exit) ? far : exit;
    }
    return near <= far ? [1, near, far] : [0, 0, 0];
  },
  exact_slabs(numbers) {
    const { inside } = figures.slabs.exact(box(numbers));
    return inside ? [1, inside[0].number(), inside[1]?.number() ?? Infinity] : [0, 0, 0];
  },

  traversal(numbers) {
    const distances = numbers.map((x) => (Number.isNaN(x) ? null : Fraction.of(x)));
    const named = (names, from) => Object.fromEntries([...names].map((name, i) => [name, distances[from + i]]));
    const world = { entries: named("ABCDEFG", 0), hits: named("DEFG", 7) };
    const { end, tests, leaves } = figures.traversal.walk(world, "near").at(-1);
    const order = leaves.reduce((sum, leaf) => 10 * sum + "DEFG".indexOf(leaf) + 1, 0);
    return [end?.number() ?? NaN, tests, order];
  },

  build(numbers) {
    const boxes = Array.from({ length: 6 }, (_, i) => [numbers[2 * i], numbers[2 * i + 1]].map(Fraction.of));
    const { split, places } = figures.build;
    const at = split(boxes, places(boxes).centroids);
    const bits = boxes.reduce((sum, box, i) => sum + (at.left.includes(box) ? 2 ** i : 0), 0);
    return [bits, at.a.number(), at.b.number(), at.expected.number()];
  },

  camera([alpha, beta, ...rest]) {
    return kernel("camera").through({ alpha, beta, columns: vectors(rest.slice(0, 9)) }, rest.slice(9)).d;
  },
  glass([cosine, sine, eta]) {
    const { p, s, F } = kernel("glass").amplitudes(cosine, sine, eta);
    return [p, s, F];
  },
  exact_glass([x, z, ior, F, wx, wz]) {
    const truth = figures.glass.exact([x, z], ior);
    const eta = truth.eta.number();
    const sine2 = (x * x) / (x * x + z * z);
    if (Math.abs(eta * eta * sine2 - 1) < 1e-12) return [1];
    // Near the critical angle, a root makes errors larger.
    const rounding = 1e-14 / Math.sqrt(Math.abs(1 - eta * eta * sine2));
    const near = (a, b) => Math.abs(a - b) < rounding;
    const sameWay = truth.isTotal
      ? Number.isNaN(wx)
      : near(truth.refracted[0], wx) && near(truth.refracted[1], wz);
    return [sameWay && near(truth.F.number(), F) ? 1 : 0];
  },
  lamp([x, height, edge, ...u]) {
    const { byDirection, byPoint } = kernel("lamp");
    const lamp = { x, height, edge };
    return [byDirection(lamp, u).value, byPoint(lamp, u).value];
  },
  stopping([x, y, seed, p, tolerance, isSure]) {
    const { means } = kernel("stopping").pixel([x, y], seed, p, tolerance, isSure ? "sure" : "plain", 512);
    return [32 * means.length, means.at(-1)];
  },
  sampler: samples,
  strata: samples,
  malley: (u) => kernel("warp").malley(u),
  uniform: (u) => kernel("warp").uniform(u),
};

const floats = new Float64Array(2);
const words = new BigUint64Array(floats.buffer);
// NaN is NaN, whatever its payload.
function same(a, b) {
  floats[0] = a;
  floats[1] = b;
  return words[0] === words[1] || (a !== a && b !== b);
}

// Halves are rounded to the even float; no random fraction is one.
for (const [odd, rounded] of [[1, 0], [3, 4]]) {
  const sum = Fraction.of(2 ** 53).add(Fraction.of(odd));
  if (sum.number() !== 2 ** 53 + rounded) throw new Error(`2^53 + ${odd} is rounded to ${sum.number()}`);
}

let failures = 0;
const folder = process.argv[2];
const files = readdirSync(folder).filter((file) => file.endsWith(".bin"));
const missing = Object.keys(RESULTS).filter((name) => !files.includes(`${name}.bin`));
if (missing.length > 0) throw new Error(`no records of ${missing}`);
for (const file of files.sort()) {
  const name = file.slice(0, -4);
  const bytes = readFileSync(join(folder, file));
  const numbers = new Float64Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
  const [inputs, size] = numbers;
  let records = 0;
  let wrong = 0;
  for (let at = 2; at < numbers.length; at += size) {
    const given = Array.from(numbers.subarray(at, at + inputs));
    const expected = Array.from(numbers.subarray(at + inputs, at + size));
    const found = RESULTS[name](given);
    records += 1;
    if (found.length === expected.length && found.every((x, i) => same(x, expected[i]))) continue;
    if (wrong++ < 3) console.error(`${name}(${given})\n  in Rust       ${expected}\n  in JavaScript ${found}`);
  }
  failures += wrong;
  console.log(`${name.padEnd(20)} ${String(records).padStart(7)} inputs, ${wrong} differ`);
}
console.log(`${files.length} kernels, ${failures} results differ`);
process.exit(failures > 0 || files.length === 0 ? 1 : 0);
