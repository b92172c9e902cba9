import igl
import importlib.metadata
import numpy as np
from common import run


def build(vertices, faces):
    tree = igl.AABB()
    faces = faces.astype(np.int64)
    tree.init(vertices, faces)
    return tree, vertices, faces


def trace(scene, rays):
    tree, vertices, faces = scene
    hits = tree.intersect_ray(vertices, faces, rays[:, :3].copy(), rays[:, 3:6].copy())
    t = [min((hit[1] for hit in found), default=np.inf) for found in hits]
    return {"t": t, "count": [len(found) for found in hits]}


run("libigl", "libigl", importlib.metadata.version("libigl"), "AABB.intersect_ray", "f64", build, trace,
    columns=lambda column: column not in ("at_start", "at_end"))
