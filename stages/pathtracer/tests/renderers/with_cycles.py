"""Compares pictures with those of Blender's Cycles: see `agree.py`. What is exported for Mitsuba is read here.

Run by `.ci/nightly cycles`, or by hand, from the top of the project, with Python 3.11:

    python3.11 -m venv target/cycles && target/cycles/bin/pip install bpy==4.5.3
    cargo build --release -p pathtracer
    target/cycles/bin/python stages/pathtracer/tests/renderers/with_cycles.py [SCENE.dae...]

Cycles has no spheres: they are meshes of 256 x 128 faces with the normals of the sphere, 0.01 % smaller.
"""

import math
import os
import sys
import tempfile
import xml.etree.ElementTree as ET
from pathlib import Path

import agree
import bpy
import bmesh  # only after bpy
from mathutils import Matrix, Vector

NAME = f"Cycles of Blender {bpy.app.version_string}"

SCENES = [("cornell_spheres", 1), ("cornell_spheres", 3), ("cornell_whale", 3), ("stones_sun", 4)]
VARIATIONS = ("cube lamp", "octahedron lamp", "point light", "directional light", "portrait")

# Of settings whose defaults change a picture, each is set to what changes nothing.
NO_BIAS = {
    "sample_clamp_direct": 0,
    "sample_clamp_indirect": 0,
    "blur_glossy": 0,
    "light_sampling_threshold": 0,
    "use_adaptive_sampling": False,
    "use_denoising": False,
    "pixel_filter_type": "BOX",
    "filter_width": 1,
}


def numbers(text):
    return [float(x) for x in text.split(",")]


def property_of(element, kind, name):
    return element.find(f"{kind}[@name='{name}']").get("value")


def mesh_of(path):
    """A mesh of a PLY file in ASCII, with the normals of its vertices."""
    lines = iter(path.read_text().splitlines())
    counts, columns = [], 0
    for line in lines:
        words = line.split()
        if words[0] == "element":
            counts.append(int(words[2]))
        columns += words[0] == "property" and len(counts) == 1
        if words[0] == "end_header":
            break
    vertices = [[float(x) for x in next(lines).split()] for _ in range(counts[0])]
    faces = [[int(i) for i in next(lines).split()[1:]] for _ in range(counts[1])]
    mesh = bpy.data.meshes.new(path.stem)
    mesh.from_pydata([v[:3] for v in vertices], [], faces)
    if columns >= 6:
        mesh.normals_split_custom_set_from_vertices([v[3:6] for v in vertices])
    return mesh


def ball_of(center, radius):
    mesh, made = bpy.data.meshes.new("ball"), bmesh.new()
    matrix = Matrix.Translation(center)
    bmesh.ops.create_uvsphere(made, u_segments=256, v_segments=128, radius=radius, matrix=matrix)
    made.to_mesh(mesh)
    mesh.normals_split_custom_set_from_vertices([(vertex.co - center) / radius for vertex in mesh.vertices])
    return mesh


def material(reflectance, radiance):
    """A Lambertian material, or one that emits on its front and reflects nothing."""
    made = bpy.data.materials.new("m")
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial").inputs["Surface"]
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = [*reflectance, 1]
    if radiance is None:
        links.new(diffuse.outputs[0], output)
        return made
    emission = nodes.new("ShaderNodeEmission")
    emission.inputs["Strength"].default_value = max(radiance)
    emission.inputs["Color"].default_value = [*(x / max(radiance) for x in radiance), 1]
    mix, geometry = nodes.new("ShaderNodeMixShader"), nodes.new("ShaderNodeNewGeometry")
    links.new(geometry.outputs["Backfacing"], mix.inputs[0])
    links.new(emission.outputs[0], mix.inputs[1])
    links.new(diffuse.outputs[0], mix.inputs[2])
    links.new(mix.outputs[0], output)
    return made


def put(data, matrix=Matrix()):
    placed = bpy.data.objects.new(data.name, data)
    placed.matrix_world = matrix
    bpy.context.scene.collection.objects.link(placed)
    return placed


def look(origin, target, up):
    """Camera to world. Cameras of Blender look along -z."""
    back = (origin - target).normalized()
    right = up.cross(back).normalized()
    return Matrix.Translation(origin) @ Matrix([right, back.cross(right), back]).transposed().to_4x4()


def add_shape(shape, folder, reflectances):
    radiance = shape.find("emitter/rgb")
    radiance = None if radiance is None else numbers(radiance.get("value"))
    if shape.get("type") == "sphere":
        center = numbers(property_of(shape, "point", "center"))
        mesh = ball_of(Vector(center), float(property_of(shape, "float", "radius")))
    else:
        mesh = mesh_of(folder / property_of(shape, "string", "filename"))
    mesh.materials.append(material(reflectances[shape.find("ref").get("id")], radiance))
    cycles = put(mesh).cycles
    cycles.shadow_terminator_offset = cycles.shadow_terminator_geometry_offset = 0


def add_light(emitter):
    """A point light of I watts per steradian has 4 pi I watts; a sun has its irradiance."""
    if emitter.get("type") == "point":
        light, power = bpy.data.lights.new("point", "POINT"), numbers(property_of(emitter, "rgb", "intensity"))
        position = emitter.find("point[@name='position']").get("value")
        matrix, factor = Matrix.Translation(numbers(position)), 4 * math.pi
        light.shadow_soft_size = 0
    elif emitter.get("type") == "directional":
        light, power = bpy.data.lights.new("sun", "SUN"), numbers(property_of(emitter, "rgb", "irradiance"))
        direction = Vector(numbers(emitter.find("vector[@name='direction']").get("value")))
        matrix, factor = direction.to_track_quat("-Z", "Y").to_matrix().to_4x4(), 1
        light.angle = 0
    else:
        raise ValueError(f"no equivalent of the emitter {emitter.get('type')}")
    light.energy = factor * max(power)
    light.color = [x / max(power) for x in power]
    put(light, matrix)


def load(xml):
    """The exported scene as Blender's only scene."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    root, scene = ET.parse(xml).getroot(), bpy.context.scene
    scene.render.engine = "CYCLES"
    for name, value in NO_BIAS.items():
        setattr(scene.cycles, name, value)
    # Paths there are counted in edges, here in reflections after the first.
    depth = int(property_of(root.find("integrator"), "integer", "max_depth")) - 2
    for kind in ("max", "diffuse", "glossy", "transmission"):
        setattr(scene.cycles, f"{kind}_bounces", depth)
    reflectances = {
        bsdf.get("id"): numbers(bsdf.find(".//rgb[@name='reflectance']").get("value")) for bsdf in root.findall("bsdf")
    }
    for shape in root.findall("shape"):
        add_shape(shape, xml.parent, reflectances)
    for emitter in root.findall("emitter"):
        add_light(emitter)
    sensor = root.find("sensor")
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "HORIZONTAL"
    camera.angle = math.radians(float(property_of(sensor, "float", "fov")))
    camera.clip_start = float(property_of(sensor, "float", "near_clip"))
    camera.clip_end = float(property_of(sensor, "float", "far_clip"))
    lookat = sensor.find(".//lookat")
    scene.camera = put(camera, look(*(Vector(numbers(lookat.get(name))) for name in ("origin", "target", "up"))))
    film = sensor.find("film")
    scene.render.resolution_x = int(property_of(film, "integer", "width"))
    scene.render.resolution_y = int(property_of(film, "integer", "height"))
    scene.cycles.samples = int(property_of(sensor.find("sampler"), "integer", "sample_count"))
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    return scene


def read(exr):
    image = bpy.data.images.load(str(exr))
    image.colorspace_settings.name = "Linear Rec.709"
    (width, height), pixels = image.size, list(image.pixels)
    bpy.data.images.remove(image)
    values = [agree.luminance(*pixels[at : at + 3]) for at in range(0, len(pixels), 4)]
    # Blender's rows begin at the bottom.
    return [values[y * width : (y + 1) * width] for y in reversed(range(height))]


def render(scene, seed):
    with tempfile.TemporaryDirectory() as folder:
        scene.cycles.seed = seed
        scene.render.filepath = str(Path(folder) / "theirs.exr")
        # It prints its progress, which nobody reads.
        kept, null = os.dup(1), os.open(os.devnull, os.O_WRONLY)
        os.dup2(null, 1)
        try:
            bpy.ops.render.render(write_still=True)
        finally:
            os.dup2(kept, 1)
        return read(scene.render.filepath)


agree.run(sys.modules[__name__], SCENES, lambda name: name.startswith(VARIATIONS))
