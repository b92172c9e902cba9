import mitsuba as mi
import numpy as np
from common import run

mi.set_variant("scalar_rgb")


def build(vertices, faces):
    mesh = mi.Mesh("mesh", len(vertices), len(faces))
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = vertices.astype(np.float32).ravel().tolist()
    parameters["faces"] = faces.ravel().tolist()
    parameters.update()
    return mi.load_dict({"type": "scene", "mesh": mesh})


def trace(scene, rays):
    t = np.full(len(rays), np.inf)
    for i, ray in enumerate(rays.tolist()):
        hit = scene.ray_intersect_preliminary(mi.Ray3f(ray[:3], ray[3:6], ray[7], 0.0, []))
        if hit.is_valid():
            t[i] = hit.t
    return {"t": t}


run("mitsuba", "mitsuba (Embree 4)", mi.__version__, "scalar_rgb, Scene.ray_intersect_preliminary", "f32", build, trace,
    most=20000, columns=lambda column: column != "at_start")
