// Reads cases, runs a library on them and writes its answers. An adapter calls `run` once for each row.
import fs from "node:fs";
import path from "node:path";

function readCase(file) {
  const bytes = fs.readFileSync(file);
  const [n, m, k] = [8, 12, 16].map((at) => bytes.readUInt32LE(at));
  const part = (at, length) => bytes.buffer.slice(bytes.byteOffset + at, bytes.byteOffset + at + length);
  const faces = 20 + 24 * n;
  const rays = new Float64Array(part(faces + 12 * m, 64 * k));
  return {
    vertices: new Float64Array(part(20, 24 * n)),
    faces: new Uint32Array(part(faces, 12 * m)),
    rays: Array.from({ length: k }, (_, i) => rays.subarray(8 * i, 8 * i + 8)),
  };
}

export const version = (name) => JSON.parse(fs.readFileSync(`node_modules/${name}/package.json`)).version;

export const length = (ray) => Math.hypot(ray[3], ray[4], ray[5]);

// The t of a segment's end beyond the mesh, for libraries that take segments.
export function segmentEnd(ray, vertices) {
  let reach = 0;
  for (const x of vertices) reach = Math.max(reach, Math.abs(x) || 0);
  return Math.min(ray[7], (4 * (reach + Math.max(...ray.slice(0, 3).map(Math.abs)))) / length(ray));
}

// Answers the first `most` rays of each case: `trace(scene, ray)` returns [t, triangle, count], t in units of the
// direction's length, Infinity for a miss; NaN for what the library does not report.
export function run(row, about, build, trace, { most = 1e9, columns = () => true } = {}) {
  const [cases, out] = [process.argv[2], path.join(process.argv[3], row)];
  fs.mkdirSync(out, { recursive: true });
  const lines = Object.entries(about).map(([key, value]) => `${key}\t${value}\n`);
  fs.writeFileSync(path.join(out, "about.tsv"), lines.join(""));
  const only = process.env.RAY_COLUMNS?.split(",");
  for (const file of fs.readdirSync(cases).filter((name) => name.endsWith(".case")).sort()) {
    const column = path.basename(file, ".case");
    if ((only && !only.includes(column)) || !columns(column)) continue;
    const { vertices, faces, rays } = readCase(path.join(cases, file));
    const asked = rays.slice(0, most);
    const answer = Buffer.alloc(20 + 24 * asked.length);
    const [answerFile, errorFile] = ["answer", "error"].map((end) => path.join(out, `${column}.${end}`));
    for (const earlier of [answerFile, errorFile]) fs.rmSync(earlier, { force: true });
    try {
      const scene = build(vertices, faces);
      const before = process.cpuUsage();
      const hits = asked.map((ray) => trace(scene, ray, vertices));
      const used = process.cpuUsage(before);
      answer.write("FLHITS01");
      answer.writeUInt32LE(asked.length, 8);
      answer.writeDoubleLE((used.user + used.system) * 1e-6, 12);
      hits.flat().forEach((x, i) => answer.writeDoubleLE(x, 20 + 8 * i));
      fs.writeFileSync(answerFile, answer);
    } catch (error) {
      fs.writeFileSync(errorFile, `${error.name}: ${String(error.message).split("\n")[0]}\n`);
    }
  }
}
