import numpy as np
import trimesh
from trimesh.ray import ray_triangle
from common import lengths, run


def build(vertices, faces):
    mesh = trimesh.Trimesh(vertices, faces.astype(np.int64), process=False)
    return ray_triangle.RayMeshIntersector(mesh)


def trace(intersector, rays):
    o, d = rays[:, :3], rays[:, 3:6]
    points, ray, triangle = intersector.intersects_location(o, d, multiple_hits=True)
    # Without any hit the points have no columns.
    points = np.reshape(points, (-1, 3))
    t = np.full(len(rays), np.inf)
    along = np.einsum("ij,ij->i", points - o[ray], d[ray]) / lengths(rays)[ray] ** 2
    np.minimum.at(t, ray, along)
    return {"t": t, "count": np.bincount(ray, minlength=len(rays))}


run("trimesh", "trimesh with rtree", trimesh.__version__, "ray_triangle.RayMeshIntersector.intersects_location", "f64",
    build, trace, most=500, columns=lambda column: column not in ("at_start", "at_end"))
