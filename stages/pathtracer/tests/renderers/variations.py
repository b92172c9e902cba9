"""Small scenes that vary what an export to another renderer may get wrong, as COLLADA."""

import math

SQUARE = [(-0.5, 0, 0.5), (0.5, 0, 0.5), (0.5, 0, -0.5), (-0.5, 0, -0.5)]
CUBE = [(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]
CUBE_QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
OCTAHEDRON = [(0.5, 0, 0), (-0.5, 0, 0), (0, 0.5, 0), (0, -0.5, 0), (0, 0, 0.5), (0, 0, -0.5)]
OCTAHEDRON_FACES = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]

IMAGES = '<library_images><image id="img"><init_from>a.png</init_from></image></library_images>'


def numbers(points):
    return " ".join(repr(float(x)) for p in points for x in p)


def source(name, points):
    return (
        f'<source id="{name}"><float_array id="{name}-a" count="{3 * len(points)}">{numbers(points)}</float_array>'
        f'<technique_common><accessor source="#{name}-a" count="{len(points)}" stride="3"><param name="X"/>'
        f'<param name="Y"/><param name="Z"/></accessor></technique_common></source>'
    )


def mesh(name, points, faces, normals=None):
    """A geometry of polygons; `normals` has one for each point."""
    inputs = f'<input semantic="VERTEX" source="#{name}-v" offset="0"/>'
    sources = source(f"{name}-p", points)
    if normals:
        sources += source(f"{name}-n", normals)
        inputs += f'<input semantic="NORMAL" source="#{name}-n" offset="0"/>'
    counts, indices = " ".join(str(len(f)) for f in faces), " ".join(str(i) for f in faces for i in f)
    return (
        f'<geometry id="{name}"><mesh>{sources}<vertices id="{name}-v"><input semantic="POSITION" source="#{name}-p"/>'
        f'</vertices><polylist count="{len(faces)}" material="m">{inputs}<vcount>{counts}</vcount><p>{indices}</p>'
        f"</polylist></mesh></geometry>"
    )


def quad(name, points, normals=None):
    return mesh(name, points, [(0, 1, 2, 3)], normals)


def ball(name, radius):
    sphere = f'<sphere><radius>{radius!r}</radius></sphere>'
    return f'<geometry id="{name}"><extra><technique profile="CGL">{sphere}</technique></extra></geometry>'


def scene(scale=1.0, origin=(0, 0, 0), near=0.1, far=100.0, aspect=1.0, lamp=None, light="", mirrored=False, texture=""):
    """A floor, a wall, a ball and a lamp, in units of `scale`, moved by `origin`."""

    def at(p):
        return tuple(scale * x + o for x, o in zip(p, origin))

    def effect(name, inside, extra=""):
        return (
            f'<effect id="{name}-e"><profile_COMMON><technique sid="c"><lambert><diffuse>{inside}</diffuse></lambert>'
            f"</technique></profile_COMMON>{extra}</effect>"
        )

    radiance = '<extra><technique profile="CGL"><emission><radiance>12 10 8</radiance></emission></technique></extra>'
    grey = texture or "<color>0.5 0.6 0.7 1</color>"
    effects = effect("grey", grey) + effect("lamp", "<color>0 0 0 1</color>", radiance)
    materials = "".join(f'<material id="{m}"><instance_effect url="#{m}-e"/></material>' for m in ("grey", "lamp"))
    lamp = lamp if lamp is not None else (lambda size: quad("lamp-g", [(x * size, 0, -z * size) for x, _, z in SQUARE]))
    shapes = [
        ("floor", quad("floor", [at(p) for p in [(-3, 0, 3), (3, 0, 3), (3, 0, -3), (-3, 0, -3)]]), (0, 0, 0), "grey"),
        ("wall", quad("wall", [at(p) for p in [(-3, 0, -2), (3, 0, -2), (3, 4, -2), (-3, 4, -2)]]), (0, 0, 0), "grey"),
        ("ball", ball("ball", 0.7 * scale), at((0.9, 0.8, 0.5)), "grey"),
    ]
    if lamp:
        shapes.append(("lamp", lamp(scale), at((-0.3, 2.4, 0.4)), "lamp"))
    nodes = ""
    for name, geometry, position, material in shapes:
        mirror = "<scale>-1 1 1</scale>" if mirrored and name == "lamp" else ""
        url = "lamp-g" if name == "lamp" else name
        place = " ".join(repr(float(x)) for x in position)
        nodes += (
            f'<node id="{name}-n"><translate>{place}</translate>{mirror}<instance_geometry url="#{url}"><bind_material>'
            f'<technique_common><instance_material symbol="m" target="#{material}"/></technique_common></bind_material>'
            f"</instance_geometry></node>"
        )
    camera = (
        f'<camera id="cam"><optics><technique_common><perspective><yfov>40</yfov><aspect_ratio>{aspect!r}</aspect_ratio>'
        f"<znear>{near * scale!r}</znear><zfar>{far * scale!r}</zfar></perspective></technique_common></optics></camera>"
    )
    place = " ".join(repr(x) for x in at((0.4, 1.3, 5.0)))
    nodes += f'<node id="cam-n"><translate>{place}</translate><instance_camera url="#cam"/></node>'
    lights = ""
    if light:
        lights = f'<library_lights><light id="l"><technique_common>{light}</technique_common></light></library_lights>'
        place = " ".join(repr(x) for x in at((-0.5, 3.0, 1.5)))
        nodes += f'<node id="l-n"><translate>{place}</translate><rotate>1 0 0 -80</rotate><instance_light url="#l"/></node>'
    return (
        '<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">'
        "<asset><up_axis>Y_UP</up_axis></asset>"
        f"<library_cameras>{camera}</library_cameras>{lights}{IMAGES}<library_effects>{effects}</library_effects>"
        f"<library_materials>{materials}</library_materials>"
        f"<library_geometries>{''.join(g for _, g, _, _ in shapes)}</library_geometries>"
        f'<library_visual_scenes><visual_scene id="s">{nodes}</visual_scene></library_visual_scenes>'
        '<scene><instance_visual_scene url="#s"/></scene></COLLADA>'
    )


def cube_lamp(size):
    return mesh("lamp-g", [tuple(size * x for x in p) for p in CUBE], CUBE_QUADS)


def octahedron_lamp(size):
    return mesh("lamp-g", [tuple(size * x for x in p) for p in OCTAHEDRON], OCTAHEDRON_FACES)


def tilted_lamp(size):
    """A square whose normals are tilted by 40 degrees."""
    n = (math.sin(math.radians(40)), -math.cos(math.radians(40)), 0.0)
    return quad("lamp-g", [(x * size, 0, -z * size) for x, _, z in SQUARE], [n] * 4)


def sphere_lamp(size):
    return ball("lamp-g", 0.4 * size)


def variations():
    """Names, scenes, and the size of each picture in pixels."""
    point = "<point><color>{0} {0} {0}</color></point>"
    square = (32, 32)
    return [
        ("plain", scene(), square),
        ("scale 1e-4", scene(scale=1e-4), square),
        ("scale 1e5", scene(scale=1e5), square),
        ("far origin", scene(origin=(4e4, -3e4, 5e4)), square),
        ("origin at 4e6 units", scene(origin=(4e6, -3e6, 5e6)), square),
        ("cube lamp", scene(lamp=cube_lamp), square),
        ("octahedron lamp, mirrored", scene(lamp=octahedron_lamp, mirrored=True), square),
        ("lamp with tilted normals", scene(lamp=tilted_lamp), square),
        ("sphere lamp", scene(lamp=sphere_lamp), square),
        ("point light, scale 1e-3", scene(scale=1e-3, lamp=False, light=point.format(8e-6)), square),
        ("directional light", scene(lamp=False, light="<directional><color>3 3 3</color></directional>"), square),
        ("portrait", scene(aspect=0.5), (24, 48)),
        ("near plane hides a ball", scene(near=4.2), square),
        ("far plane hides the wall", scene(far=6.0), square),
        ("texture", scene(texture='<texture texture="img" texcoord="UV"/>'), square),
    ]
