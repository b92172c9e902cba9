#!/usr/bin/env bash
# mujoco 4.0.0, Debian's Python 3.11.
#
# Vertical rays at the inner vertices of a closed terrain whose vertices have integer coordinates: each ray must hit the
# terrain. `mj_ray` on the mesh geom returns -1, a miss, for a part of them; rays at inner points of the triangles are found.
#
# Output: at vertices: lost 19 of 361 / inside triangles: lost 0 of 361 (the first number may vary: 5 to 200).
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m pip install --quiet --target "$folder" mujoco==4.0.0 numpy==1.26.4
PYTHONPATH=$folder python3 - <<'PYTHON'
import mujoco
import numpy as np

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
spec = mujoco.MjSpec()
mesh = spec.add_mesh(name="m", uservert=vertices.ravel().tolist(), userface=np.ravel(faces).tolist())
spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname="m")
model = spec.compile()
data = mujoco.MjData(model)
mujoco.mj_forward(model, data)


def lost(x, y):
    geom, count = np.zeros(1, np.int32), 0
    for i in range(1, n):
        for j in range(1, n):
            t = mujoco.mj_ray(model, data, np.array([i + x, j + y, 32.0]), np.array([0, 0, -1.0]), None, 1, -1, geom)
            count += t < 0
    return count


vertex, inside = lost(0, 0), lost(0.5, 0.25)
print(f"at vertices: lost {vertex} of {(n - 1) ** 2} / inside triangles: lost {inside} of {(n - 1) ** 2}")
assert 5 <= vertex <= 200 and inside == 0
PYTHON
