import numpy as np
import open3d
from common import run


def build(vertices, faces):
    scene = open3d.t.geometry.RaycastingScene(nthreads=1)
    scene.add_triangles(open3d.core.Tensor(vertices.astype(np.float32)), open3d.core.Tensor(faces.copy()))
    return scene


def trace(scene, rays):
    both = open3d.core.Tensor(rays[:, :6].astype(np.float32))
    hits = scene.cast_rays(both, nthreads=1)
    return {
        "t": hits["t_hit"].numpy().astype(float),
        "prim": hits["primitive_ids"].numpy(),
    }


def count(scene, rays):
    both = open3d.core.Tensor(rays[:, :6].astype(np.float32))
    return {**trace(scene, rays), "count": scene.count_intersections(both, nthreads=1).numpy()}


for name, answer in (("parity", count), ("", trace)):
    run("open3d", "open3d", open3d.__version__, "RaycastingScene.cast_rays, count_intersections", "f32", build, answer,
        columns=lambda column: (column == "parity") == (name == "parity") and column not in ("at_start", "at_end"))
