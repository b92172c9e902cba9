"""Renders exported scenes with LuxCore, a second independent renderer, and compares means as `compare.py` does.

    python3 -m venv target/luxcore && target/luxcore/bin/pip install mitsuba==3.9.1 pyluxcore==2.11.2
    cargo build --release -p pathtracer
    target/luxcore/bin/python stages/pathtracer/tests/mitsuba/second.py

The scenes are those that `--export mitsuba` writes, read here without Mitsuba. LuxCore has no spheres: they are meshes.
"""

import math
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ET
from pathlib import Path

import pyluxcore

from compare import PROGRAM, ROUNDS, SAMPLES, SMALL_BLOCK, agree, blocks, mi, own_picture

SIZE = 32

# Scenes, and their depths in `pathtracer`. LuxCore counts the ray to the lamp, too.
SCENES = [("cornell_spheres", 1), ("cornell_spheres", 3), ("cornell_mirror_glass", 60), ("stones_sun", 4)]


def numbers(text):
    return [float(x) for x in text.split(",")]


def value(element, name):
    return next(child.get("value") for child in element if child.get("name") == name)


def ply(path):
    lines = path.read_text().splitlines()
    count = {line.split()[1]: int(line.split()[2]) for line in lines if line.startswith("element")}
    rows = [line.split() for line in lines[lines.index("end_header") + 1 :]]
    vertices = [[float(x) for x in row] for row in rows[: count["vertex"]]]
    faces = [tuple(int(x) for x in row[1:4]) for row in rows[count["vertex"] :]]
    return [tuple(v[:3]) for v in vertices], faces, [tuple(v[3:6]) for v in vertices]


def ball(center, radius, rings=96):
    """A mesh of a sphere whose volume is that of the sphere."""
    points, faces, normals = [], [], []
    scale = radius * (1 + 0.55 / rings**2 * math.pi**2 / 2)
    for i in range(rings + 1):
        for j in range(2 * rings):
            theta, phi = math.pi * i / rings, math.pi * j / rings
            n = (math.sin(theta) * math.cos(phi), math.cos(theta), -math.sin(theta) * math.sin(phi))
            normals.append(n)
            points.append(tuple(c + scale * x for c, x in zip(center, n)))
    for i in range(rings):
        for j in range(2 * rings):
            a, b = i * 2 * rings + j, i * 2 * rings + (j + 1) % (2 * rings)
            c, d = a + 2 * rings, b + 2 * rings
            faces += [(a, c, d), (a, d, b)]
    return points, faces, normals


def material(name, bsdf):
    """Properties of a material. Mitsuba's `twosided` is what LuxCore always does."""
    inner = bsdf[0] if bsdf.get("type") == "twosided" else bsdf
    kind = inner.get("type")
    rgb = lambda which: " ".join(str(x) for x in numbers(value(inner, which)))
    prefix = f"scene.materials.{name}."
    if kind == "diffuse":
        return [(prefix + "type", "matte"), (prefix + "kd", rgb("reflectance"))]
    if kind == "conductor":
        return [(prefix + "type", "mirror"), (prefix + "kr", rgb("specular_reflectance"))]
    if kind == "dielectric":
        return [
            (prefix + "type", "glass"),
            (prefix + "kr", rgb("specular_reflectance")),
            (prefix + "kt", rgb("specular_transmittance")),
            (prefix + "interiorior", value(inner, "int_ior")),
            (prefix + "exteriorior", value(inner, "ext_ior")),
        ]
    raise ValueError(f"no material {kind}")


def load(xml):
    """The scene of an exported file."""
    root = ET.parse(xml).getroot()
    scene = pyluxcore.Scene()
    sensor = root.find("sensor")
    look = sensor.find("transform/lookat")
    properties = [
        ("scene.camera.type", "perspective"),
        ("scene.camera.lookat.orig", look.get("origin").replace(",", " ")),
        ("scene.camera.lookat.target", look.get("target").replace(",", " ")),
        ("scene.camera.up", look.get("up").replace(",", " ")),
        ("scene.camera.fieldofview", value(sensor, "fov")),
        ("scene.camera.cliphither", value(sensor, "near_clip")),
        ("scene.camera.clipyon", value(sensor, "far_clip")),
        ("scene.camera.autofocus.enable", "0"),
    ]
    bsdfs = {bsdf.get("id"): bsdf for bsdf in root.findall("bsdf")}
    for i, shape in enumerate(root.findall("shape")):
        name = f"s{i}"
        properties += material(name, bsdfs[shape.find("ref").get("id")])
        emitter = shape.find("emitter")
        if emitter is not None:
            radiance = " ".join(str(x) for x in numbers(value(emitter, "radiance")))
            properties += [
                (f"scene.materials.{name}.emission", radiance),
                (f"scene.materials.{name}.emission.power", "0"),
                (f"scene.materials.{name}.emission.gain.normalizebycolor", "0"),
            ]
        if shape.get("type") == "sphere":
            center = shape.find("point").get("value")
            points, faces, normals = ball(numbers(center), float(value(shape, "radius")))
        else:
            points, faces, normals = ply(xml.parent / value(shape, "filename"))
        scene.DefineMesh(name, points, faces, normals, None, None, None)
        properties += [(f"scene.objects.{name}.shape", name), (f"scene.objects.{name}.material", name)]
    for i, emitter in enumerate(root.findall("emitter")):
        prefix = f"scene.lights.l{i}."
        if emitter.get("type") == "directional":
            direction = next(c for c in emitter if c.get("name") == "direction").get("value")
            properties += [
                (prefix + "type", "sharpdistant"),
                (prefix + "direction", direction.replace(",", " ")),
                (prefix + "color", " ".join(str(x) for x in numbers(value(emitter, "irradiance")))),
                (prefix + "gain", "1 1 1"),
                (prefix + "normalizebycolor", "0"),
            ]
        else:
            raise ValueError(f"no lamp {emitter.get('type')}")
    scene.Parse(to_properties(properties))
    return scene


def to_properties(pairs):
    properties = pyluxcore.Properties()
    for key, text in pairs:
        words = str(text).split()
        properties.Set(pyluxcore.Property(key, words if len(words) > 1 else words[0]))
    return properties


def render(scene, depth, seed):
    config = to_properties(
        [
            ("renderengine.type", "PATHCPU"),
            ("renderengine.seed", seed + 1),
            ("sampler.type", "RANDOM"),
            ("native.threads.count", 2),
            ("film.width", SIZE),
            ("film.height", SIZE),
            ("film.filter.type", "NONE"),
            ("film.imagepipelines.0.0.type", "NOP"),
            ("film.outputs.0.type", "RGB"),
            ("film.outputs.0.filename", "out.exr"),
            ("path.pathdepth.total", depth),
            ("path.pathdepth.diffuse", depth),
            ("path.pathdepth.glossy", depth),
            ("path.pathdepth.specular", depth),
            ("path.russianroulette.cap", "1"),
            ("path.clamping.variance.maxvalue", "0"),
            ("batch.haltspp", SAMPLES),
        ]
    )
    session = pyluxcore.RenderSession(pyluxcore.RenderConfig(config, scene))
    session.Start()
    while not session.HasDone():
        time.sleep(0.05)
        session.UpdateStats()
    session.Stop()
    pixels = bytearray(SIZE * SIZE * 3 * 4)
    session.GetFilm().GetOutputFloat(pyluxcore.FilmOutputType.RGB, pixels)
    values = memoryview(pixels).cast("f")
    # Rows from the bottom.
    rows = [values[y * SIZE * 3 : (y + 1) * SIZE * 3].tolist() for y in reversed(range(SIZE))]
    return mi.TensorXf(sum(rows, []), (SIZE, SIZE, 3))


def main():
    pyluxcore.Init()
    pyluxcore.SetLogHandler(lambda text: None)
    results = []
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        for name, depth in SCENES:
            scene, xml = f"scenes/dae/{name}.dae", folder / "scene.xml"
            common = ["-r", str(SIZE), str(SIZE), "-s", str(SAMPLES), "-m", str(depth), scene]
            subprocess.run([PROGRAM, "--export", "mitsuba", str(xml), *common], check=True, capture_output=True)
            loaded = load(xml)
            ours = [blocks(own_picture(seed, common, folder), SMALL_BLOCK) for seed in range(ROUNDS)]
            theirs = [blocks(render(loaded, depth + 1, seed), SMALL_BLOCK) for seed in range(ROUNDS)]
            results.append(agree(f"{name} -m {depth}", ours, theirs, len(SCENES)))
    sys.exit(0 if all(results) else 1)


if __name__ == "__main__":
    main()
