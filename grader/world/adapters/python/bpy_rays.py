import bpy
import numpy as np
from mathutils.bvhtree import BVHTree
from common import lengths, run, unit


def build(vertices, faces):
    return BVHTree.FromPolygons(vertices.tolist(), faces.tolist(), all_triangles=True)


def trace(tree, rays):
    t = np.full(len(rays), np.inf)
    for i, (o, d) in enumerate(zip(rays[:, :3].tolist(), unit(rays).tolist())):
        _, _, _, distance = tree.ray_cast(o, d)
        if distance is not None:
            t[i] = distance
    return {"t": t / lengths(rays)}


run("blender", "bpy", bpy.app.version_string, "mathutils.bvhtree.BVHTree.ray_cast", "f32", build, trace, most=20000,
    columns=lambda column: column not in ("at_start", "at_end"))
