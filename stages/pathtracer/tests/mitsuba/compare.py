"""Renders scenes with `pathtracer` and with Mitsuba 3 and prints the difference with its standard error.

Run by hand, from the top of the project:

    python3 -m venv target/mitsuba && target/mitsuba/bin/pip install mitsuba==3.9.1
    cargo build --release -p pathtracer
    target/mitsuba/bin/python stages/pathtracer/tests/mitsuba/compare.py

Each renders the same picture ROUNDS times with different random numbers. The means of blocks of pixels are compared by
t-tests: the probability that any block of any scene fails for two equal renderers is 1e-6 (Sidak).
"""

import math
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import mitsuba as mi

mi.set_variant("scalar_rgb")

ROUNDS = 8
SAMPLES = 64
WIDTH, HEIGHT = 96, 72
BLOCK = 12
FAMILY = 1e-6

# Scene and depth. Mirrors and glass show emitters one depth earlier in Mitsuba: their depth may truncate no path.
SCENES = [
    ("cornell_spheres", 1),
    ("cornell_spheres", 3),
    ("cornell_mirror_glass", 60),
    ("stones_sun", 4),
]


def blocks(picture):
    """Mean luminance of each block of a picture, a tensor [row][column][channel]."""
    channels = picture.shape[2]
    values = list(picture.array)
    means = []
    for y0 in range(0, HEIGHT, BLOCK):
        for x0 in range(0, WIDTH, BLOCK):
            total = 0.0
            for y in range(y0, y0 + BLOCK):
                for x in range(x0, x0 + BLOCK):
                    at = (y * WIDTH + x) * channels
                    r, g, b = values[at : at + 3]
                    total += 0.2126 * r + 0.7152 * g + 0.0722 * b
            means.append(total / (BLOCK * BLOCK))
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


def compare(name, depth, folder):
    scene = Path("scenes/dae") / f"{name}.dae"
    common = ["-r", str(WIDTH), str(HEIGHT), "-s", str(SAMPLES), "-m", str(depth), str(scene)]
    program = "target/release/pathtracer"
    xml = folder / f"{name}.xml"
    subprocess.run([program, "--export", "mitsuba", str(xml), *common], check=True, stdout=subprocess.DEVNULL)
    theirs_scene = mi.load_file(str(xml))
    ours, theirs = [], []
    for seed in range(ROUNDS):
        exr = folder / "ours.exr"
        subprocess.run(
            [program, "-f", str(exr), "--seed", str(seed), "-t", "2", *common], check=True, stdout=subprocess.DEVNULL
        )
        ours.append(blocks(mi.TensorXf(mi.Bitmap(str(exr)))))
        theirs.append(blocks(mi.render(theirs_scene, seed=seed)))
    count = len(ours[0])
    alarm = 1 - (1 - FAMILY) ** (1 / (count * len(SCENES)))
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
    totals = [statistics.mean(r) for r in ours], [statistics.mean(r) for r in theirs]
    mean = statistics.mean(totals[1])
    error = math.sqrt(sum(statistics.variance(t) for t in totals) / ROUNDS)
    difference = statistics.mean(totals[0]) - mean
    verdict = "agree" if least > alarm else "DIFFER"
    print(
        f"{name:<22} -m {depth:<3} {100 * difference / mean:+.3f} % ± {100 * error / mean:.3f} %   "
        f"worst of {count} blocks: t = {worst:.2f}, p = {least:.1e}   {verdict}",
        flush=True,
    )
    return least > alarm


def main():
    with tempfile.TemporaryDirectory() as folder:
        results = [compare(name, depth, Path(folder)) for name, depth in SCENES]
    sys.exit(0 if all(results) else 1)


main()
