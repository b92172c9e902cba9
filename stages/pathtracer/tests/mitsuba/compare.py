"""Renders scenes with `pathtracer` and with Mitsuba 3 and prints the means and their difference with its standard error.

Run by `.ci/nightly mitsuba`, or by hand, from the top of the project:

    python3 -m venv target/mitsuba && target/mitsuba/bin/pip install mitsuba==3.9.1
    cargo build --release -p pathtracer
    target/mitsuba/bin/python stages/pathtracer/tests/mitsuba/compare.py [SCENE.dae...]

Each renders the same picture ROUNDS times with different random numbers. The means of blocks of pixels are compared by
t-tests: the probability that any block of any scene fails for two equal renderers is 1e-6 (Sidak). A scene that the
export refuses is listed with the reason.
"""

import math
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import mitsuba as mi

from variations import variations

mi.set_variant("scalar_rgb")

ROUNDS = 8
SAMPLES = 64
BLOCK = 12
SMALL_BLOCK = 8
FAMILY = 1e-6

PROGRAM = os.environ.get("PATHTRACER", "target/release/pathtracer")

# Scenes of the course, and their depths. Mirrors and glass show emitters one depth earlier in Mitsuba: their depth may truncate no path.
SCENES = [
    ("cornell_spheres", 1),
    ("cornell_spheres", 3),
    ("cornell_mirror_glass", 60),
    ("stones_sun", 4),
]

# The depth at which small scenes are compared.
SMALL_DEPTH = 100


def blocks(picture, block):
    """Mean luminance of each block of a picture, a tensor [row][column][channel]."""
    height, width, channels = picture.shape
    values = list(picture.array)
    means = []
    for y0 in range(0, height, block):
        for x0 in range(0, width, block):
            total = 0.0
            for y in range(y0, y0 + block):
                for x in range(x0, x0 + block):
                    at = (y * width + x) * channels
                    r, g, b = values[at : at + 3]
                    total += 0.2126 * r + 0.7152 * g + 0.0722 * b
            means.append(total / (block * block))
    return means


def two_sided(t, degrees):
    """Chance that Student's t exceeds |t| on either side, by integrating its density (Simpson's rule)."""
    c = math.exp(math.lgamma((degrees + 1) / 2) - math.lgamma(degrees / 2)) / math.sqrt(degrees * math.pi)
    density = lambda x: c * (1 + x * x / degrees) ** (-(degrees + 1) / 2)
    # Substituting x = t + u / (1 - u) maps the tail to [0, 1).
    steps = 2000
    total = 0.0
    for i in range(steps + 1):
        u = min(i / steps, 1 - 1e-9)
        weight = 1 if i in (0, steps) else (4 if i % 2 else 2)
        total += weight * density(abs(t) + u / (1 - u)) / (1 - u) ** 2
    return min(1.0, 2 * total / (3 * steps))


def compare(name, scene, size, block, depth, scenes, folder):
    common = ["-r", str(size[0]), str(size[1]), "-s", str(SAMPLES), "-m", str(depth), str(scene)]
    xml = folder / "scene.xml"
    export = subprocess.run([PROGRAM, "--export", "mitsuba", str(xml), *common], capture_output=True, text=True)
    if export.returncode != 0:
        reason = export.stderr.strip().splitlines()[-1].strip()
        print(f"{name:<28} refused: {reason}", flush=True)
        return "cannot be exported" in export.stderr
    theirs_scene = mi.load_file(str(xml))
    ours, theirs = [], []
    for seed in range(ROUNDS):
        exr = folder / "ours.exr"
        subprocess.run(
            [PROGRAM, "-f", str(exr), "--seed", str(seed), "-t", "2", *common],
            check=True,
            capture_output=True,
        )
        ours.append(blocks(mi.TensorXf(mi.Bitmap(str(exr))), block))
        theirs.append(blocks(mi.render(theirs_scene, seed=seed), block))
    count = len(ours[0])
    alarm = 1 - (1 - FAMILY) ** (1 / (count * scenes))
    worst, least = 0.0, 1.0
    for i in range(count):
        a, b = [r[i] for r in ours], [r[i] for r in theirs]
        error = math.sqrt((statistics.variance(a) + statistics.variance(b)) / ROUNDS)
        difference = statistics.mean(a) - statistics.mean(b)
        if error > 0:
            z = difference / error
            worst = max(worst, abs(z))
            least = min(least, two_sided(z, 2 * ROUNDS - 2))
        elif abs(difference) > 1e-5 * statistics.mean(b):
            worst, least = math.inf, 0.0
    totals = [[statistics.mean(r) for r in pictures] for pictures in (ours, theirs)]
    means = [statistics.mean(t) for t in totals]
    errors = [math.sqrt(statistics.variance(t) / ROUNDS) for t in totals]
    verdict = "agree" if least > alarm else "DIFFER"
    print(
        f"{name:<28} {means[0]:.6f} ± {errors[0]:.6f}   {means[1]:.6f} ± {errors[1]:.6f}   "
        f"worst of {count} blocks: t = {worst:.2f}, p = {least:.1e}   {verdict}",
        flush=True,
    )
    return least > alarm


def main():
    own = Path("scenes/dae")
    cases = [(f"{name} -m {depth}", own / f"{name}.dae", (96, 72), BLOCK, depth) for name, depth in SCENES]
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        for i, (name, text, size) in enumerate(variations()):
            path = folder / f"{i}.dae"
            path.write_text(text)
            cases.append((name, path, size, SMALL_BLOCK, SMALL_DEPTH))
        given = [Path(scene) for scene in sys.argv[1:]]
        cases += [(path.stem, path, (32, 32), SMALL_BLOCK, SMALL_DEPTH) for path in given]
        print(f"{'scene':<28} pathtracer              Mitsuba {mi.__version__}", flush=True)
        results = [compare(*case, len(cases), folder) for case in cases]
    sys.exit(0 if all(results) else 1)


main()
