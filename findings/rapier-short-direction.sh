#!/usr/bin/env bash
# @dimforge/rapier3d-compat 0.21.0 (parry), Node 20.
#
# Vertical rays from 8 above a plane of unit triangles, at inner points. A ray with the direction (0, 0, -2^-10) is found, one
# with (0, 0, -2^-20) is not: 64 of 64 are lost, though t = 2^23 is far below the limit of 1e30. Rays of unit direction that
# start 2^24 above are lost, too. The tree takes 2^23 for 1/0, so the plane of a box that is parallel to the ray seems to be
# crossed at a finite t. All numbers are powers of two and quarters, which single precision holds exactly.
#
# Output: direction 1: 64 of 64, 2^-10: 64, 2^-20: 0; start at 2^12: 64, at 2^24: 0
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund @dimforge/rapier3d-compat@0.21.0
cat > run.mjs <<'JAVASCRIPT'
import RAPIER from "@dimforge/rapier3d-compat";
console.warn = () => {};
await RAPIER.init();
const [vertices, faces, n] = [[], [], 8];
for (let i = 0; i <= n; i++) for (let j = 0; j <= n; j++) vertices.push(i, j, 0);
const at = (i, j) => i * (n + 1) + j;
for (let i = 0; i < n; i++) {
  for (let j = 0; j < n; j++) {
    faces.push(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1));
  }
}
const world = new RAPIER.World({ x: 0, y: 0, z: 0 });
world.createCollider(RAPIER.ColliderDesc.trimesh(new Float32Array(vertices), new Uint32Array(faces)));
world.step();
function found(z, length) {
  let count = 0;
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < n; j++) {
      const ray = new RAPIER.Ray({ x: i + 0.5, y: j + 0.25, z }, { x: 0, y: 0, z: -length });
      if (world.castRay(ray, 1e30, false)) count++;
    }
  }
  return count;
}
const counts = [found(8, 1), found(8, 2 ** -10), found(8, 2 ** -20), found(2 ** 12, 1), found(2 ** 24, 1)];
const [one, shorter, shortest, near, far] = counts;
console.log(`direction 1: ${one} of 64, 2^-10: ${shorter}, 2^-20: ${shortest}; start at 2^12: ${near}, at 2^24: ${far}`);
if (counts.join() !== "64,64,0,64,0") process.exit(1);
JAVASCRIPT
node run.mjs
