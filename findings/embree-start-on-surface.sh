#!/usr/bin/env bash
# embreex 4.4.0.post1 (Embree 4), Debian's Python 3.11.
#
# Rays start exactly on a triangle of a plane, at inner points, and go away from it: t = 0 is in the range, which begins at 0.
# In its default mode Embree finds none of these hits, with the flag `robust` all of them. So the flag, which is meant for
# rays at edges, also decides whether a shadow ray meets the surface that it leaves. All numbers are small integers and
# quarters, which single precision holds exactly.
#
# Output: default: 0 of 64 hits at t = 0, robust: 64 of 64; from 1 above, default: 64 of 64, robust: 64 of 64
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m pip install --quiet --target "$folder" embreex==4.4.0.post1 numpy==1.26.4
PYTHONPATH=$folder python3 - <<'PYTHON'
import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene

triangles = []
for i in range(8):
    for j in range(8):
        a, b, c, d = (i, j, 0), (i + 1, j, 0), (i + 1, j + 1, 0), (i, j + 1, 0)
        triangles += [(a, b, c), (a, c, d)]
triangles = np.array(triangles, np.float32)


def hits(robust, height):
    scene = EmbreeScene(robust=robust)
    TriangleMesh(scene, triangles)
    o = np.array([(i + 0.5, j + 0.25, height) for i in range(8) for j in range(8)], np.float32)
    d = np.tile(np.array([0, 0, -1], np.float32), (64, 1))
    return int((scene.run(o, d, query="INTERSECT") >= 0).sum())


on = [hits(robust, 0) for robust in (False, True)]
above = [hits(robust, 1) for robust in (False, True)]
print(f"default: {on[0]} of 64 hits at t = 0, robust: {on[1]} of 64; "
      f"from 1 above, default: {above[0]} of 64, robust: {above[1]} of 64")
assert on == [0, 64] and above == [64, 64]
PYTHON
