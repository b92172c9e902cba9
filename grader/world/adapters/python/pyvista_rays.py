import numpy as np
import pyvista
from common import lengths, run, segment_ends


def build(vertices, faces):
    return pyvista.make_tri_mesh(vertices, faces.astype(np.int64)), vertices


def trace(scene, rays):
    mesh, vertices = scene
    ends, _ = segment_ends(rays, vertices)
    t, count = np.full(len(rays), np.inf), np.zeros(len(rays))
    for i, (ray, end) in enumerate(zip(rays, ends)):
        points, _ = mesh.ray_trace(ray[:3], end)
        count[i] = len(points)
        if len(points):
            t[i] = np.linalg.norm(points - ray[:3], axis=1).min()
    return {"t": t / lengths(rays), "count": count}


run("pyvista", "pyvista (vtk)", pyvista.__version__, "PolyData.ray_trace", "f64", build, trace, most=300,
    columns=lambda column: column != "at_start")
