#!/usr/bin/env bash
# pybullet 3.2.7, Debian's Python 3.11.
#
# `rayTest` finds a triangle also beside its edge, where the ray misses it by up to 1/10,000 of its height: rays at right
# angles to one triangle with legs of S, outside its longest edge, through (S/2 + e, S/2 + e). With S = 1 a ray with
# e = 2^-15 hits. With S = 1,024 it hits with e = 1/32. All coordinates are exact in single precision, too, and so are
# their sums: by exact arithmetic each of these rays misses.
#
# Output: S = 1: e of 2^-14 nothing, of 2^-15 a hit, of 2^-20 a hit / S = 1024: e of 1/16 nothing, of 1/32 a hit, of 2^-10 a hit
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m pip install --quiet --target "$folder" pybullet==3.2.7 numpy==1.26.4
PYTHONPATH=$folder python3 - <<'PYTHON' | grep -v "^pybullet build time"
import pybullet

pybullet.connect(pybullet.DIRECT)


def test(size, e):
    pybullet.resetSimulation()
    shape = pybullet.createCollisionShape(pybullet.GEOM_MESH, vertices=[[0, 0, 0], [size, 0, 0], [0, size, 0]],
                                          indices=[0, 1, 2], flags=pybullet.GEOM_FORCE_CONCAVE_TRIMESH)
    pybullet.createMultiBody(0, shape)
    x = size / 2 + e
    return "a hit" if pybullet.rayTest([x, x, 1], [x, x, -1])[0][0] >= 0 else "nothing"


names = [["2^-14", "2^-15", "2^-20"], ["1/16", "1/32", "2^-10"]]
found = [[test(size, size * 2.0**-k) for k in (14, 15, 20)] for size in (1, 1024)]
print(" / ".join(f"S = {size}: e of " + ", of ".join(f"{e} {answer}" for e, answer in zip(e, answers))
                 for size, e, answers in zip((1, 1024), names, found)))
assert found == [["nothing", "a hit", "a hit"]] * 2, found
PYTHON
