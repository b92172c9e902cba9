"""Compares pictures with those of Mitsuba 3: see `agree.py`.

Run by `.ci/nightly mitsuba`, or by hand, from the top of the project:

    python3 -m venv target/mitsuba && target/mitsuba/bin/pip install mitsuba==3.9.1
    cargo build --release -p pathtracer
    target/mitsuba/bin/python stages/pathtracer/tests/renderers/with_mitsuba.py [SCENE.dae...]
"""

import sys

import agree
import mitsuba as mi

mi.set_variant("scalar_rgb")

NAME = f"Mitsuba {mi.__version__}"

# Mirrors and glass show emitters one depth earlier in Mitsuba: their depth may truncate no path.
SCENES = [
    ("cornell_spheres", 1),
    ("cornell_spheres", 3),
    ("cornell_mirror_glass", 60),
    ("stones_sun", 4),
]


def load(xml):
    return mi.load_file(str(xml))


def rows(picture):
    """Luminances of a tensor [row][column][channel]."""
    height, width, channels = picture.shape
    values = list(picture.array)
    pixels = [agree.luminance(*values[at : at + 3]) for at in range(0, len(values), channels)]
    return [pixels[y * width : (y + 1) * width] for y in range(height)]


def read(exr):
    return rows(mi.TensorXf(mi.Bitmap(str(exr))))


def render(scene, seed):
    return rows(mi.render(scene, seed=seed))


agree.run(sys.modules[__name__], SCENES)
