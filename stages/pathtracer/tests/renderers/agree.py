"""Renders scenes with `pathtracer` and with another renderer, and compares the means of blocks of pixels.

Each renders the same picture ROUNDS times with different random numbers. The means of blocks are compared by t-tests:
the probability that any block of any scene fails for two equal renderers is 1e-6 (Sidak). A scene that the export
refuses is listed with the reason.
"""

import math
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from variations import variations

ROUNDS = int(os.environ.get("ROUNDS", "8"))
SAMPLES = 64
BLOCK = 12
SMALL_BLOCK = 8
FAMILY = 1e-6

PROGRAM = os.environ.get("PATHTRACER", "target/release/pathtracer")

# The depth at which small scenes are compared.
SMALL_DEPTH = 100


def luminance(r, g, b):
    return 0.2126 * r + 0.7152 * g + 0.0722 * b


def blocks(picture, block):
    """Means of the blocks of a picture, rows of luminances."""
    means = []
    for y0 in range(0, len(picture), block):
        for x0 in range(0, len(picture[0]), block):
            values = [x for row in picture[y0 : y0 + block] for x in row[x0 : x0 + block]]
            means.append(sum(values) / len(values))
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


def compare(renderer, name, scene, size, block, depth, scenes, folder):
    """Whether both pictures of a scene agree, or its export is refused with the reason."""
    common = ["-r", str(size[0]), str(size[1]), "-s", str(SAMPLES), "-m", str(depth), str(scene)]
    xml = folder / "scene.xml"
    export = subprocess.run([PROGRAM, "--export", "mitsuba", str(xml), *common], capture_output=True, text=True)
    if export.returncode != 0:
        reason = export.stderr.strip().splitlines()[-1].strip()
        print(f"{name:<28} refused: {reason}", flush=True)
        return "cannot be exported" in export.stderr
    theirs_scene = renderer.load(xml)
    ours, theirs = [], []
    for seed in range(ROUNDS):
        exr = folder / "ours.exr"
        subprocess.run(
            [PROGRAM, "-f", str(exr), "--seed", str(seed), "-t", "2", *common],
            check=True,
            capture_output=True,
        )
        ours.append(blocks(renderer.read(exr), block))
        theirs.append(blocks(renderer.render(theirs_scene, seed), block))
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


def run(renderer, scenes, chosen=lambda name: True):
    """Compares the scenes of the course in `scenes`, with their depths, the variations whose names are chosen, and those
    of the command line. Ends the program."""
    own = Path("scenes/dae")
    cases = [(f"{name} -m {depth}", own / f"{name}.dae", (96, 72), BLOCK, depth) for name, depth in scenes]
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        for i, (name, text, size) in enumerate(variations()):
            if not chosen(name):
                continue
            path = folder / f"{i}.dae"
            path.write_text(text)
            cases.append((name, path, size, SMALL_BLOCK, SMALL_DEPTH))
        given = [Path(scene) for scene in sys.argv[1:]]
        cases += [(path.stem, path, (32, 32), SMALL_BLOCK, SMALL_DEPTH) for path in given]
        print(f"{'scene':<28} pathtracer              {renderer.NAME}", flush=True)
        results = [compare(renderer, *case, len(cases), folder) for case in cases]
    sys.exit(0 if all(results) else 1)
