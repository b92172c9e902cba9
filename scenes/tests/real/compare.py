"""Compares how scene files are read with independent readers: pycollada for COLLADA, trimesh for glTF, OBJ and PLY.

    python3 compare.py PROGRAM FOLDER

PROGRAM is the example `measure` of the crate `scenes`. Area, signed volume and bounding box of all triangles, and the
number of lights, of each file in FOLDER are compared. A file counts as

- right: both agree;
- warned: they differ, and the reader here gave a warning, or the other one is known to be wrong (KNOWN);
- refused: the reader here gave an error;
- unread: the other reader fails;
- differing: none of these. The smallest ten are printed, and the exit code is 1.
"""

import subprocess
import sys
from collections import Counter
from pathlib import Path

import numpy as np

TOLERANCE = 1e-4
FORMATS = {".dae", ".glb", ".gltf", ".obj", ".ply"}

# What the other readers are known to get wrong: a text in the file, and what it means.
KNOWN = {
    ".dae": [
        ("<ph>", "pycollada leaves out the holes of polygons"),
        ("<skew", "pycollada does not know skew"),
        ("<instance_controller", "pycollada places skins by their nodes"),
        ("<tristrips", "pycollada leaves out strips"),
        ("<trifans", "pycollada leaves out fans"),
        ('profile="CGL"', "pycollada does not know the course's shapes and materials"),
        ('profile="CMU462"', "pycollada does not know the course's shapes and materials"),
    ],
    ".gltf": [("\"JOINTS_0\"", "trimesh does not place skins")],
    ".glb": [("\"JOINTS_0\"", "trimesh does not place skins")],
}


def measure(triangles):
    """Area, signed volume and bounding box of an array of triangles."""
    if len(triangles) == 0:
        return None
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
    points = triangles.reshape(-1, 3)
    return area, volume, points.min(axis=0), points.max(axis=0)


def with_pycollada(path):
    import collada

    document = collada.Collada(str(path), ignore=[collada.common.DaeError])
    parts = []
    for geometry in document.scene.objects("geometry"):
        for primitive in geometry.primitives():
            if isinstance(primitive, (collada.polylist.BoundPolylist, collada.polygons.BoundPolygons)):
                primitive = primitive.triangleset()
            if not isinstance(primitive, collada.triangleset.BoundTriangleSet) or len(primitive) == 0:
                continue
            part = primitive.vertex[primitive.vertex_index].astype(float)
            parts.append(part)
    triangles = np.concatenate(parts) if parts else np.zeros((0, 3, 3))
    x, y, z = (triangles[..., i].copy() for i in range(3))
    # The axes of the original course program.
    axes = {"Z_UP": (-x, z, y), "X_UP": (-y, x, z)}.get(document.assetInfo.upaxis, (x, y, z))
    return measure(np.stack(axes, axis=-1)), len(list(document.scene.objects("light")))


def with_trimesh(path):
    import trimesh

    scene = trimesh.load(str(path), force="scene", process=False)
    meshes = [g for g in scene.dump() if isinstance(g, trimesh.Trimesh)]
    parts = [np.asarray(mesh.triangles, dtype=float) for mesh in meshes]
    return measure(np.concatenate(parts) if parts else np.zeros((0, 3, 3))), None


def difference(ours, theirs, lights):
    """What differs; `None` if nothing does."""
    if theirs is None:
        return "the other reader finds no triangles"
    area, volume = float(ours[3]), float(ours[4])
    lower, upper = np.array(ours[5:8], dtype=float), np.array(ours[8:11], dtype=float)
    size = max(float(np.linalg.norm(theirs[3] - theirs[2])), 1e-30)
    if abs(area - theirs[0]) > TOLERANCE * theirs[0]:
        return f"area {area:.6g}, not {theirs[0]:.6g}"
    distance = float(np.abs(theirs[2:]).max())
    if abs(volume - theirs[1]) > TOLERANCE * max(size, distance) * theirs[0]:
        return f"volume {volume:.6g}, not {theirs[1]:.6g}"
    if max(np.abs(lower - theirs[2]).max(), np.abs(upper - theirs[3]).max()) > TOLERANCE * size:
        return f"box {lower} {upper}, not {theirs[2]} {theirs[3]}"
    if lights is not None and int(ours[11]) != lights:
        return f"{ours[11]} lights, not {lights}"
    return None


def main():
    program, folder = sys.argv[1], Path(sys.argv[2])
    files = sorted(path for path in folder.rglob("*") if path.suffix.lower() in FORMATS)
    counts, differing = Counter(), []
    for path in files:
        run = subprocess.run([program, str(path)], capture_output=True, text=True, timeout=600)
        if run.returncode != 0:
            counts["crashed"] += 1
            differing.append((path, run.stderr.strip().splitlines()[-1:]))
            continue
        columns = run.stdout.rstrip("\n").split("\t")
        if columns[1] == "refused":
            counts["refused"] += 1
            continue
        suffix = path.suffix.lower()
        ours = columns[2:]
        try:
            theirs, lights = (with_pycollada if suffix == ".dae" else with_trimesh)(path)
        except Exception as why:
            counts[f"unread by the other reader ({type(why).__name__})"] += 1
            continue
        # Columns from the number of warnings on.
        what = difference(ours, theirs, lights)
        text = path.read_bytes()
        known = [reason for token, reason in KNOWN.get(suffix, []) if token.encode() in text]
        if what is None:
            counts["right"] += 1
        elif int(ours[0]) > 0 or known:
            counts["warned"] += 1
        else:
            counts["differing"] += 1
            differing.append((path, what))
    for name, count in sorted(counts.items()):
        print(f"{count:6} {name}")
    for path, what in sorted(differing, key=lambda entry: entry[0].stat().st_size)[:10]:
        print(f"{path} ({path.stat().st_size} bytes): {what}")
    sys.exit(1 if differing else 0)


main()
