import importlib.metadata
import numpy as np
import pybullet
from common import run, segment_ends

pybullet.connect(pybullet.DIRECT)


def build(vertices, faces):
    pybullet.resetSimulation()
    shape = pybullet.createCollisionShape(pybullet.GEOM_MESH, vertices=vertices.tolist(), indices=faces.ravel().tolist(),
                                          flags=pybullet.GEOM_FORCE_CONCAVE_TRIMESH)
    pybullet.createMultiBody(0, shape)
    return vertices


def trace(vertices, rays):
    ends, end_t = segment_ends(rays, vertices)
    hits = []
    for i in range(0, len(rays), 4000):
        part = slice(i, i + 4000)
        hits += pybullet.rayTestBatch(rays[part, :3].tolist(), ends[part].tolist(), numThreads=1)
    return {"t": np.where([hit[0] >= 0 for hit in hits], [hit[2] for hit in hits], np.inf) * end_t}


run("pybullet", "pybullet", importlib.metadata.version("pybullet"), "rayTestBatch on a concave mesh", "f64", build, trace,
    most=20000, columns=lambda column: column != "at_start")
