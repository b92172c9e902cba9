#!/usr/bin/env bash
# three 0.187.0, Node 20.
#
# A mesh of two triangles far apart. One vertex of the second is NaN, as some exporters write for a point without data.
# `Raycaster` then returns a hit of the second triangle at the distance NaN for every ray, also for one that passes 40 units
# beside both. Sorted by distance, such a hit may come before the right one. The library prints an error about the bounding
# sphere on the console.
#
# Output: whole mesh, ray at the first triangle: [[0,1]] / with a NaN: [[0,1],[1,null]] / with a NaN, ray far beside both: [[1,null]]
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund three@0.187.0
cat > run.mjs <<'JAVASCRIPT'
import * as THREE from "three";
console.error = () => {};
function hits(last, [x, y]) {
  const geometry = new THREE.BufferGeometry();
  const positions = new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 0, 0, 10, 0, 0, 9, last, 0]);
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  const mesh = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ side: THREE.DoubleSide }));
  const found = new THREE.Raycaster(new THREE.Vector3(x, y, 1), new THREE.Vector3(0, 0, -1)).intersectObject(mesh);
  return JSON.stringify(found.map((hit) => [hit.faceIndex, hit.distance]));
}
const [at, beside] = [[0.25, 0.25], [50, 50]];
const [whole, spoilt, far] = [hits(1, at), hits(NaN, at), hits(NaN, beside)];
console.log(`whole mesh, ray at the first triangle: ${whole} / with a NaN: ${spoilt} / with a NaN, ray far beside both: ${far}`);
if (whole !== "[[0,1]]" || spoilt !== "[[0,1],[1,null]]" || far !== "[[1,null]]") process.exit(1);
JAVASCRIPT
node run.mjs
