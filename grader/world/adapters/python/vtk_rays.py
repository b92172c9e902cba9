import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from common import run, segment_ends


def build(locator):
    def scene(vertices, faces):
        points, cells, mesh = vtk.vtkPoints(), vtk.vtkCellArray(), vtk.vtkPolyData()
        points.SetDataTypeToDouble()
        points.SetData(numpy_to_vtk(np.ascontiguousarray(vertices), deep=1))
        cells.SetData(3, numpy_to_vtkIdTypeArray(faces.astype(np.int64).ravel(), deep=1))
        mesh.SetPoints(points)
        mesh.SetPolys(cells)
        tree = locator()
        tree.SetDataSet(mesh)
        tree.SetTolerance(0.0)
        tree.BuildLocator()
        return tree, vertices

    return scene


def trace(scene, rays):
    tree, vertices = scene
    ends, end_t = segment_ends(rays, vertices)
    t, fraction, x, p = np.full(len(rays), np.inf), vtk.reference(0.0), [0] * 3, [0] * 3
    sub, cell, generic = vtk.reference(0), vtk.reference(0), vtk.vtkGenericCell()
    for i, (ray, end) in enumerate(zip(rays, ends)):
        if tree.IntersectWithLine(ray[:3], end, 0.0, fraction, x, p, sub, cell, generic):
            t[i] = float(fraction) * end_t[i]
    return {"t": t}


def trace_obb(scene, rays):
    tree, vertices = scene
    ends, _ = segment_ends(rays, vertices)
    t, count = np.full(len(rays), np.inf), np.zeros(len(rays))
    for i, (ray, end) in enumerate(zip(rays, ends)):
        points = vtk.vtkPoints()
        points.SetDataTypeToDouble()
        tree.IntersectWithLine(ray[:3], end, points, None)
        count[i] = points.GetNumberOfPoints()
        if count[i]:
            t[i] = np.linalg.norm(np.array(points.GetPoint(0)) - ray[:3]) / np.linalg.norm(ray[3:6])
    return {"t": t, "count": count}


version = vtk.vtkVersion.GetVTKVersion()
for locator in (vtk.vtkCellLocator, vtk.vtkStaticCellLocator, vtk.vtkModifiedBSPTree, vtk.vtkCellTreeLocator):
    run(locator.__name__, "vtk", version, f"{locator.__name__}, tolerance 0", "f64", build(locator), trace, most=2000,
        columns=lambda column: column != "at_start")
run("vtkOBBTree", "vtk", version, "vtkOBBTree, tolerance 0", "f64", build(vtk.vtkOBBTree), trace_obb, most=2000,
    columns=lambda column: column != "at_start")
