import RAPIER from "@dimforge/rapier3d-compat";
import { run, version } from "./common.js";

await RAPIER.init();

function build(vertices, faces) {
  const world = new RAPIER.World({ x: 0, y: 0, z: 0 });
  world.createCollider(RAPIER.ColliderDesc.trimesh(new Float32Array(vertices), faces));
  world.step();
  return world;
}

function trace(world, r) {
  const ray = new RAPIER.Ray({ x: r[0], y: r[1], z: r[2] }, { x: r[3], y: r[4], z: r[5] });
  const hit = world.castRay(ray, Math.min(r[7], 1e30), false);
  return hit ? [hit.timeOfImpact, NaN, NaN] : [Infinity, -1, NaN];
}

run("rapier_javascript",
  { library: "rapier3d-compat", version: version("@dimforge/rapier3d-compat"), interface: "World.castRay", precision: "f32" },
  build, trace, { columns: (column) => column !== "at_start" });
