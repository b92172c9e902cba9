"""Compares how scene files are read with independent readers: pycollada for COLLADA, trimesh for glTF, OBJ and PLY.

    python3 compare.py MEASURE PATHTRACER FOLDER

MEASURE is the example of the crate `scenes`. Area, signed volume and bounding box of all triangles, the area of each
material that both readers name, the number of lights and whether there is a camera are compared for each file in
FOLDER. PATHTRACER renders each file small. A file counts as

- right: both agree;
- warned: they differ, and the reader here gave a warning, or the other one is known to be wrong (KNOWN);
- refused: the reader here gave an error;
- unread: the other reader fails, finds no triangles, or differs and reports errors of its own;
- unrendered: the renderer gives no picture of a file that was read, or a black one without a word;
- differing: none of these. The smallest ten of the last two are printed, and the exit code is 1.
"""

import re
import subprocess
import sys
import tempfile
import zlib
from collections import Counter
from pathlib import Path

import numpy as np

TOLERANCE = 1e-4
WIDTH = 32
FORMATS = {".dae", ".glb", ".gltf", ".obj", ".ply"}

# What the other readers are known to get wrong: a regular expression met in the file, and what it means.
KNOWN = {
    ".dae": [
        (r'<accessor[^>]* offset="[1-9]', "pycollada does not know where an accessor begins"),
        (r"<scale[^>]*>[^<]*\d{6}", "pycollada computes in single precision, too coarse for such scales"),
        (r"<vcount>[^<]*\b([5-9]|\d\d)", "pycollada cuts polygons into fans, also if they are not convex"),
        ("<ph>", "pycollada leaves out the holes of polygons"),
        ("<skew", "pycollada does not know skew"),
        ("<instance_controller", "pycollada places skins by their nodes"),
        ("<tristrips", "pycollada leaves out strips"),
        ("<trifans", "pycollada leaves out fans"),
        ('profile="CGL"', "pycollada does not know the course's shapes and materials"),
        ('profile="CMU462"', "pycollada does not know the course's shapes and materials"),
    ],
    ".obj": [(r"(?m)^f( +\S+){5}", "trimesh cuts polygons into fans, also if they are not convex")],
    ".gltf": [('"JOINTS_0"', "trimesh does not place skins")],
    ".glb": [('"JOINTS_0"', "trimesh does not place skins")],
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
    parts, areas = [], Counter()
    for geometry in document.scene.objects("geometry"):
        for primitive in geometry.primitives():
            if isinstance(primitive, (collada.polylist.BoundPolylist, collada.polygons.BoundPolygons)):
                primitive = primitive.triangleset()
            if not isinstance(primitive, collada.triangleset.BoundTriangleSet) or len(primitive) == 0:
                continue
            part = primitive.vertex[primitive.vertex_index].astype(float)
            # The front of a mirrored surface stays its front.
            part = part[:, ::-1] if np.linalg.det(geometry.matrix[:3, :3]) < 0 else part
            parts.append(part)
            if primitive.material is not None:
                areas[primitive.material.name or primitive.material.id] += measure(part)[0]
    triangles = np.concatenate(parts) if parts else np.zeros((0, 3, 3))
    x, y, z = (triangles[..., i].copy() for i in range(3))
    # The axes of the original course program.
    axes = {"Z_UP": (-x, z, y), "X_UP": (-y, x, z)}.get(document.assetInfo.upaxis, (x, y, z))
    lights, cameras = (len(list(document.scene.objects(kind))) for kind in ("light", "camera"))
    return measure(np.stack(axes, axis=-1)), lights, cameras > 0, areas, document.errors


def with_trimesh(path):
    import trimesh

    scene = trimesh.load(str(path), force="scene", process=False)
    meshes = [g for g in scene.dump() if isinstance(g, trimesh.Trimesh)]
    parts = [np.asarray(mesh.triangles, dtype=float) for mesh in meshes]
    return measure(np.concatenate(parts) if parts else np.zeros((0, 3, 3))), None, None, {}, []


def difference(ours, theirs, lights, camera, areas):
    """What differs; `None` if nothing does."""
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
    if camera is not None and (ours[12] == "1") != camera:
        return "no camera" if camera else "a camera that the other reader does not find"
    own = Counter()
    for name, area in (material.rsplit("=", 1) for material in ours[13:]):
        own[name] += float(area)
    for name in own.keys() & areas.keys():
        if abs(own[name] - areas[name]) > TOLERANCE * theirs[0]:
            return f"area {own[name]:.6g} of the material {name}, not {areas[name]:.6g}"
    return None


def is_black(png):
    """Whether a picture of WIDTH pixels in RGB has zeros only: then each row has, after its filter, zeros."""
    at, data = 8, b""
    while at < len(png):
        length, kind = int.from_bytes(png[at : at + 4], "big"), png[at + 4 : at + 8]
        if kind == b"IDAT":
            data += png[at + 8 : at + 8 + length]
        at += 12 + length
    rows = zlib.decompress(data)
    return not any(any(rows[at + 1 : at + 1 + 3 * WIDTH]) for at in range(0, len(rows), 1 + 3 * WIDTH))


def unrendered(pathtracer, path, picture):
    """Why there is no picture of a file, or a black one without a word; `None` if there is one."""
    small = ["-r", str(WIDTH), "24", "-s", "4", "-m", "2", "-t", "1"]
    run = subprocess.run([pathtracer, *small, "-f", picture, str(path)], capture_output=True, text=True, timeout=600)
    if run.returncode != 0:
        return f"not rendered: {run.stderr.strip().splitlines()[-1:]}"
    if is_black(Path(picture).read_bytes()) and "note" not in run.stderr and "warning" not in run.stderr:
        return "black, without a note"
    return None


def main():
    program, pathtracer, folder = sys.argv[1], sys.argv[2], Path(sys.argv[3])
    scratch = tempfile.TemporaryDirectory()
    picture = str(Path(scratch.name) / "picture.png")
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
        why = unrendered(pathtracer, path, picture)
        if why is not None:
            counts["unrendered"] += 1
            differing.append((path, why))
        suffix = path.suffix.lower()
        ours = columns[2:]
        try:
            theirs, *others, errors = (with_pycollada if suffix == ".dae" else with_trimesh)(path)
        except Exception as why:
            counts[f"unread by the other reader ({type(why).__name__})"] += 1
            continue
        if theirs is None and int(ours[1]) > 0:
            counts["unread by the other reader (it finds no triangles)"] += 1
            continue
        # Columns from the number of warnings on.
        what = difference(ours, theirs, *others)
        text = path.read_bytes()
        known = [reason for token, reason in KNOWN.get(suffix, []) if re.search(token.encode(), text)]
        if what is None:
            counts["right"] += 1
        elif int(ours[0]) > 0 or known:
            counts["warned"] += 1
        elif errors:
            counts["unread by the other reader (it reports errors)"] += 1
        else:
            counts["differing"] += 1
            differing.append((path, what))
    for name, count in sorted(counts.items()):
        print(f"{count:6} {name}")
    for path, what in sorted(differing, key=lambda entry: entry[0].stat().st_size)[:10]:
        print(f"{path} ({path.stat().st_size} bytes): {what}")
    sys.exit(1 if differing else 0)


main()
