#!/usr/bin/env bash
# pybullet 3.2.7, Debian's Python 3.11.
#
# `rayTest` takes a segment. One that ends exactly on a triangle, or begins on it, finds nothing; one that is longer by a
# quarter finds the triangle. All numbers are small integers and quarters, which double precision holds exactly.
#
# Output: crosses: hit at 0.8 / ends on the surface: nothing / begins on the surface: nothing
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m pip install --quiet --target "$folder" pybullet==3.2.7 numpy==1.26.4
PYTHONPATH=$folder python3 - <<'PYTHON' | grep -v "^pybullet build time"
import pybullet

pybullet.connect(pybullet.DIRECT)
shape = pybullet.createCollisionShape(pybullet.GEOM_MESH, vertices=[[0, 0, 0], [4, 0, 0], [0, 4, 0]], indices=[0, 1, 2],
                                      flags=pybullet.GEOM_FORCE_CONCAVE_TRIMESH)
pybullet.createMultiBody(0, shape)


def test(from_z, to_z):
    body, _, t, _, _ = pybullet.rayTest([1, 1, from_z], [1, 1, to_z])[0]
    return f"hit at {round(t, 6)}" if body >= 0 else "nothing"


found = [test(1, -0.25), test(1, 0), test(0, -1)]
print(" / ".join(f"{what}: {answer}" for what, answer in
                 zip(["crosses", "ends on the surface", "begins on the surface"], found)))
assert found == ["hit at 0.8", "nothing", "nothing"], found
PYTHON
