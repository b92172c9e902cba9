import embreex
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh
import importlib.metadata
import numpy as np
from common import run


def build(robust):
    def scene(vertices, faces):
        scene = rtcore_scene.EmbreeScene(robust=robust)
        TriangleMesh(scene, vertices[faces].astype(np.float32))
        return scene

    return scene


def trace(scene, rays):
    o, d = rays[:, :3].astype(np.float32), rays[:, 3:6].astype(np.float32)
    t = np.array(scene.run(o, d, query="DISTANCE"), float)
    t[t > 1e30] = np.inf
    return {"t": t}


def whole_range(column):
    return column not in ("at_start", "at_end")  # the interface has no ranges


version = importlib.metadata.version("embreex")
for robust in (False, True):
    run("embreex_robust" if robust else "embreex", "embreex (Embree 4)", version, f"EmbreeScene(robust={robust}).run",
        "f32", build(robust), trace, columns=whole_range)
