#!/usr/bin/env bash
# pycollada 0.9.3, Debian's Python 3.11.
#
# A triangle with the normal of its plane, in a node that scales x by 4. The primitives that `scene.objects("geometry")`
# returns have points and normals in the scene's coordinates. Both are multiplied by the node's matrix. For normals
# that is right only without a scale, or, up to their length, with the same one along all axes; else they need the inverse
# transpose. Here the normal is 62 degrees off the triangle, and 2.9 long. `generateNormals` of the bound triangles
# replaces the normals of the file by smooth ones of the scaled triangles.
#
# Output: scale 1: length 1.00, 0.0 degrees off / scale 4: length 2.92, 61.9 degrees off / polygons: 61.9 degrees off
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m pip install --quiet --target "$folder" pycollada==0.9.3 numpy==1.26.4
PYTHONPATH=$folder python3 - <<'PYTHON'
import io

import collada
import numpy as np


def source(name, numbers):
    axes = "".join(f'<param name="{axis}" type="float"/>' for axis in "XYZ")
    return f"""<source id="{name}"><float_array id="{name}-a" count="{len(numbers)}">{" ".join(map(str, numbers))}
        </float_array><technique_common><accessor source="#{name}-a" count="{len(numbers) // 3}" stride="3">{axes}
        </accessor></technique_common></source>"""


def document(scale, kind):
    corners = "<vcount>3</vcount>" if kind == "polylist" else ""
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><created>2026-01-01T00:00:00</created><modified>2026-01-01T00:00:00</modified></asset>
  <library_geometries><geometry id="g"><mesh>
    {source("points", [0, 0, 0, 1, 0, 1, 0, 1, 0])}{source("normals", [-(0.5**0.5), 0, 0.5**0.5])}
    <vertices id="v"><input semantic="POSITION" source="#points"/></vertices>
    <{kind} count="1"><input semantic="VERTEX" source="#v" offset="0"/>
      <input semantic="NORMAL" source="#normals" offset="1"/>{corners}<p>0 0 1 0 2 0</p></{kind}>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s"><node id="n"><scale>{scale} 1 1</scale><instance_geometry url="#g"/>
  </node></visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>"""


def normal(scale, kind):
    scene = collada.Collada(io.BytesIO(document(scale, kind).encode()))
    (geometry,) = scene.scene.objects("geometry")
    (bound,) = geometry.primitives()
    (polygon,) = bound
    a, b, c = np.asarray(polygon.vertices, float)
    plane, n = np.cross(b - a, c - a), np.asarray(polygon.normals[0], float)
    cosine = abs(n @ plane) / np.linalg.norm(n) / np.linalg.norm(plane)
    return f"length {np.linalg.norm(n):.2f}", f"{np.degrees(np.arccos(min(1, cosine))):.1f} degrees off"


one, four = (", ".join(normal(scale, "triangles")) for scale in (1, 4))
output = f"scale 1: {one} / scale 4: {four} / polygons: {normal(4, 'polylist')[1]}"
print(output)
assert output == (
    "scale 1: length 1.00, 0.0 degrees off / scale 4: length 2.92, 61.9 degrees off / polygons: 61.9 degrees off"
)
PYTHON
