#!/usr/bin/env bash
# libigl 2.6.3, Debian's Python 3.11.
#
# `igl.AABB.intersect_ray` gets double precision. A ray through the inside of a triangle with legs of 1 is found; the same ray
# and the same triangle, all lengths multiplied by 2^-10 (about 0.001), is a miss, whatever the length of the direction: an
# absolute bound decides. `t` has the digits of single precision: 1/3 comes back as 0.3333333432674408.
#
# Output: size 1: 1 hit / size 2^-4: 1 hit / size 2^-10: 0 hits / size 2^-20: 0 hits / t of 1/3: 0.3333333432674408
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m pip install --quiet --target "$folder" libigl==2.6.3 numpy==1.26.4
PYTHONPATH=$folder python3 - <<'PYTHON'
import igl
import numpy as np


def hits(size, o=(0.25, 0.25, 1.0), d=(0.0, 0.0, -1.0)):
    vertices, faces = size * np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2]])
    tree = igl.AABB()
    tree.init(vertices, faces)
    return tree.intersect_ray(vertices, faces, size * np.array([o]), size * np.array([d]))[0]


counts = [len(hits(2.0**-k)) for k in (0, 4, 10, 20)]
t = hits(1.0, d=(0.0, 0.0, -3.0))[0][1]
names = ["1", "2^-4", "2^-10", "2^-20"]
print(" / ".join(f"size {n}: {c} hit{'s' * (c != 1)}" for n, c in zip(names, counts)), f"/ t of 1/3: {t}")
assert counts == [1, 1, 0, 0] and t == np.float32(1 / 3)
PYTHON
