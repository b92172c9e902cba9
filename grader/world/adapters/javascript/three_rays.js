import * as THREE from "three";
import { MeshBVH } from "three-mesh-bvh";
import { length, run, version } from "./common.js";

function geometry(vertices, faces) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(vertices), 3));
  geometry.setIndex(new THREE.BufferAttribute(faces, 1));
  return geometry;
}

function mesh(vertices, faces) {
  const mesh = new THREE.Mesh(geometry(vertices, faces), new THREE.MeshBasicMaterial({ side: THREE.DoubleSide }));
  mesh.updateMatrixWorld();
  return mesh;
}

const vectors = (ray) => [new THREE.Vector3(ray[0], ray[1], ray[2]), new THREE.Vector3(ray[3], ray[4], ray[5]).normalize()];

function raycaster(mesh, ray) {
  const l = length(ray);
  const hits = new THREE.Raycaster(...vectors(ray), ray[6] * l, ray[7] * l).intersectObject(mesh);
  return hits.length ? [hits[0].distance / l, hits[0].faceIndex, hits.length] : [Infinity, -1, 0];
}

function closest(bvh, ray) {
  const l = length(ray);
  const hit = bvh.raycastFirst(new THREE.Ray(...vectors(ray)), THREE.DoubleSide, ray[6] * l, ray[7] * l);
  return hit ? [hit.distance / l, hit.faceIndex, NaN] : [Infinity, -1, NaN];
}

function all(bvh, ray) {
  const hits = bvh.raycast(new THREE.Ray(...vectors(ray)), THREE.DoubleSide);
  return hits.length ? [Math.min(...hits.map((hit) => hit.distance)) / length(ray), hits[0].faceIndex, hits.length] : [Infinity, -1, 0];
}

run("three", { library: "three", version: version("three"), interface: "Raycaster.intersectObject", precision: "f64" },
  mesh, raycaster, { most: 1000 });
for (const counted of [false, true]) {
  run("three_mesh_bvh",
    { library: "three-mesh-bvh", version: version("three-mesh-bvh"), interface: "MeshBVH.raycastFirst, raycast", precision: "f64" },
    (vertices, faces) => new MeshBVH(geometry(vertices, faces), { indirect: true }),
    counted ? all : closest, { columns: (column) => (column === "parity") === counted });
}
