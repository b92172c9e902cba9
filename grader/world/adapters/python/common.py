"""Reads cases, runs a library on them and writes its answers. An adapter calls `run` once for each row."""

import os
import struct
import sys
import time

import numpy as np


def read_case(path):
    """Vertices (n, 3) f64, faces (m, 3) u32, rays (k, 8) f64: origin, direction, min_t, max_t."""
    data = open(path, "rb").read()
    assert data[:8] == b"FLRAYS01", path
    n, m, k = struct.unpack("<3I", data[8:20])
    vertices = np.frombuffer(data, "<f8", 3 * n, 20).reshape(n, 3)
    faces = np.frombuffer(data, "<u4", 3 * m, 20 + 24 * n).reshape(m, 3)
    rays = np.frombuffer(data, "<f8", 8 * k, 20 + 24 * n + 12 * m).reshape(k, 8)
    return vertices, faces, rays


def run(row, library, version, interface, precision, build, trace, most=10**9, columns=lambda name: True):
    """Answers the first `most` rays of each case with `trace(build(vertices, faces), rays)`.

    `trace` returns arrays by name: `t` in units of the direction's length (inf for a miss), and, where the library
    reports them, `prim` and `count`. An exception is an answer, too: it is written instead of hits.
    """
    cases, out = sys.argv[1], os.path.join(sys.argv[2], row)
    os.makedirs(out, exist_ok=True)
    with open(os.path.join(out, "about.tsv"), "w") as about:
        about.write(f"library\t{library}\nversion\t{version}\ninterface\t{interface}\nprecision\t{precision}\n")
    only = os.environ.get("RAY_COLUMNS")
    for name in sorted(os.listdir(cases)):
        column, end = os.path.splitext(name)
        if end != ".case" or (only and column not in only.split(",")) or not columns(column):
            continue
        vertices, faces, rays = read_case(os.path.join(cases, name))
        rays = rays[:most]
        answer, error = (os.path.join(out, column + end) for end in (".answer", ".error"))
        for earlier in filter(os.path.exists, (answer, error)):
            os.remove(earlier)
        try:
            scene = build(vertices, faces)
            before = time.process_time()
            found = trace(scene, rays)
            seconds = time.process_time() - before
        except Exception as raised:
            first = (str(raised).splitlines() or [""])[0]
            open(error, "w").write(f"{type(raised).__name__}: {first}\n")
            continue
        hits = np.full((len(rays), 3), np.nan)
        hits[:, 0] = found["t"]
        for i, key in enumerate(["prim", "count"], 1):
            if key in found:
                hits[:, i] = found[key]
        with open(answer, "wb") as file:
            file.write(b"FLHITS01" + struct.pack("<Id", len(rays), seconds) + hits.astype("<f8").tobytes())


def lengths(rays):
    """The lengths of the directions."""
    return np.linalg.norm(rays[:, 3:6], axis=1)


def unit(rays):
    """Directions of unit length, for libraries that demand them."""
    return rays[:, 3:6] / lengths(rays)[:, None]


def segment_ends(rays, vertices):
    """Ends of segments that leave the mesh, for libraries that take segments, and the t of these ends."""
    reach = np.abs(np.nan_to_num(vertices)).max() + np.abs(rays[:, :3]).max(axis=1)
    t = np.minimum(rays[:, 7], 4.0 * reach / lengths(rays))
    return rays[:, :3] + rays[:, 3:6] * t[:, None], t
