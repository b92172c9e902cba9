#!/usr/bin/env bash
# vtk 9.7.2, Debian's Python 3.11.
#
# A closed terrain with integer coordinates and vertical segments at its inner vertices. `vtkOBBTree` finds no
# intersection for any of them, `vtkModifiedBSPTree` misses some; segments at inner points of the triangles are all found.
#
# Output: vtkOBBTree: lost 361 of 361 at vertices, 0 inside / vtkModifiedBSPTree: lost 13 of 361 at vertices, 0 inside
# (the last number may vary: 1 to 100).
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m pip install --quiet --target "$folder" vtk==9.7.2 numpy==1.26.4
PYTHONPATH=$folder python3 - <<'PYTHON'
import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray

n = 20
height = np.random.default_rng(1).integers(1, 9, (n + 1, n + 1))
top = [(i, j, height[i, j]) for i in range(n + 1) for j in range(n + 1)]
vertices = np.array(top + [(i, j, 0) for i in range(n + 1) for j in range(n + 1)], float)
m, at, faces = len(top), lambda i, j: i * (n + 1) + j, []
for i in range(n):
    for j in range(n):
        a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
        faces += [(a, b, c), (a, c, d), (m + a, m + c, m + b), (m + a, m + d, m + c)]
for k in range(n):
    for p, q in [(at(k, 0), at(k + 1, 0)), (at(n, k), at(n, k + 1)), (at(k + 1, n), at(k, n)), (at(0, k + 1), at(0, k))]:
        faces += [(m + p, m + q, q), (m + p, q, p)]
points, cells, mesh = vtk.vtkPoints(), vtk.vtkCellArray(), vtk.vtkPolyData()
points.SetDataTypeToDouble()
points.SetData(numpy_to_vtk(vertices, deep=1))
cells.SetData(3, numpy_to_vtkIdTypeArray(np.array(faces, np.int64).ravel(), deep=1))
mesh.SetPoints(points)
mesh.SetPolys(cells)


def lost(locator, x, y):
    tree, count = locator(), 0
    tree.SetDataSet(mesh)
    tree.BuildLocator()
    for i in range(1, n):
        for j in range(1, n):
            # One point inside the block, so the segment crosses the terrain once.
            found, o, e = vtk.vtkPoints(), (i + x, j + y, 32.0), (i + x, j + y, 0.5)
            if isinstance(tree, vtk.vtkOBBTree):
                tree.IntersectWithLine(o, e, found, None)
                count += found.GetNumberOfPoints() == 0
            else:
                t, sub = vtk.reference(0.0), vtk.reference(0)
                count += tree.IntersectWithLine(o, e, 0.0, t, [0] * 3, [0] * 3, sub) == 0
    return count


obb, bsp = ([lost(locator, 0, 0), lost(locator, 0.5, 0.25)] for locator in (vtk.vtkOBBTree, vtk.vtkModifiedBSPTree))
print(f"vtkOBBTree: lost {obb[0]} of 361 at vertices, {obb[1]} inside / "
      f"vtkModifiedBSPTree: lost {bsp[0]} of 361 at vertices, {bsp[1]} inside")
assert obb == [361, 0] and 1 <= bsp[0] <= 100 and bsp[1] == 0
PYTHON
