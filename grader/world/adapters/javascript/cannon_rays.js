import { Body, RaycastResult, Trimesh, Vec3, World } from "cannon-es";
import { length, run, segmentEnd, version } from "./common.js";

function build(vertices, faces) {
  const world = new World();
  world.addBody(new Body({ mass: 0, shape: new Trimesh(Array.from(vertices), Array.from(faces)) }));
  return world;
}

function trace(world, ray, vertices) {
  const end = segmentEnd(ray, vertices);
  const at = (t) => new Vec3(ray[0] + t * ray[3], ray[1] + t * ray[4], ray[2] + t * ray[5]);
  const result = new RaycastResult();
  const options = { skipBackfaces: false, checkCollisionResponse: false };
  return world.raycastClosest(at(0), at(end), options, result)
    ? [result.distance / length(ray), result.hitFaceIndex, NaN]
    : [Infinity, -1, NaN];
}

run("cannon", { library: "cannon-es", version: version("cannon-es"), interface: "World.raycastClosest on a Trimesh", precision: "f64" },
  build, trace, { most: 300, columns: (column) => column !== "at_start" });
