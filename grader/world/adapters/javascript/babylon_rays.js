import { Mesh, NullEngine, Ray, Scene, Vector3, VertexData } from "@babylonjs/core";
import { length, run, version } from "./common.js";

const scene = new Scene(new NullEngine());

function build(vertices, faces) {
  const mesh = new Mesh("mesh", scene);
  const data = new VertexData();
  data.positions = new Float32Array(vertices);
  data.indices = faces;
  data.applyToMesh(mesh);
  mesh.computeWorldMatrix(true);
  return mesh;
}

function trace(mesh, ray) {
  const l = length(ray);
  const d = new Vector3(ray[3], ray[4], ray[5]).scale(1 / l);
  const hit = new Ray(new Vector3(ray[0], ray[1], ray[2]), d, Math.min(ray[7] * l, 1e30)).intersectsMesh(mesh, false);
  return hit.hit ? [hit.distance / l, hit.faceId, NaN] : [Infinity, -1, NaN];
}

run("babylon", { library: "babylon.js", version: version("@babylonjs/core"), interface: "Ray.intersectsMesh", precision: "f64" },
  build, trace, { most: 1000, columns: (column) => column !== "at_start" });
