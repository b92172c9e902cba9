import importlib.metadata
import numpy as np
from CGAL.CGAL_AABB_tree import AABB_tree_Triangle_3_soup
from CGAL.CGAL_Kernel import Point_3, Ray_3, Triangle_3, Vector_3
from common import lengths, run


def build(vertices, faces):
    points = [Point_3(*vertex) for vertex in vertices.tolist()]
    triangles = [Triangle_3(points[a], points[b], points[c]) for a, b, c in faces.tolist()]
    return AABB_tree_Triangle_3_soup(triangles), triangles


def trace(scene, rays):
    tree, _ = scene
    t, count = np.full(len(rays), np.inf), np.zeros(len(rays))
    for i, ray in enumerate(rays.tolist()):
        found = []
        tree.all_intersections(Ray_3(Point_3(*ray[:3]), Vector_3(*ray[3:6])), found)
        count[i] = len(found)
        for pair in found:
            hit = pair.first
            if hit.is_Point_3():
                p = hit.get_Point_3()
                off = np.array([p.x() - ray[0], p.y() - ray[1], p.z() - ray[2]])
                t[i] = min(t[i], np.linalg.norm(off))
    return {"t": t / lengths(rays), "count": count}


run("cgal", "cgal", importlib.metadata.version("cgal"), "AABB_tree_Triangle_3_soup.all_intersections", "f64", build, trace,
    most=2000, columns=lambda column: column not in ("at_start", "at_end"))
