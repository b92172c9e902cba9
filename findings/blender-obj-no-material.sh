#!/usr/bin/env bash
# bpy (Blender) 4.5.3, Debian's Python 3.11. They take 920 MB while it runs.
#
# Three planes; only the second one has a material, red. The OBJ exporter writes no `usemtl` for an object without a
# material. But in OBJ a material stays in use until the next `usemtl`, also past an `o` line. So the third plane is red
# in the file, and what has no material depends on the order of the objects. Blender's own importer reads it as red. For
# faces without a material in an object with one, the exporter writes a `usemtl` without a name.
#
# Output: written: o first / f / o second / usemtl red / f / o third / f / read again: first -, second red, third red
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m pip install --quiet --target "$folder" bpy==4.5.3 numpy==1.26.4
cd "$folder"
PYTHONPATH=$folder python3 - <<'PYTHON'
import bpy

bpy.ops.wm.read_factory_settings(use_empty=True)
for x, name in enumerate(["first", "second", "third"]):
    bpy.ops.mesh.primitive_plane_add(location=(3 * x, 0, 0))
    bpy.context.object.name = name
bpy.data.objects["second"].data.materials.append(bpy.data.materials.new("red"))
bpy.ops.wm.obj_export(filepath="planes.obj")
lines = [line.split() for line in open("planes.obj")]
written = " / ".join("f" if line[0] == "f" else " ".join(line) for line in lines if line and line[0] in ("o", "usemtl", "f"))
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.wm.obj_import(filepath="planes.obj")
materials = {o.name: " ".join(m.name for m in o.data.materials) or "-" for o in bpy.data.objects}
read = ", ".join(f"{name} {materials[name]}" for name in sorted(materials))
print(f"written: {written} / read again: {read}")
assert written == "o first / f / o second / usemtl red / f / o third / f"
assert read == "first -, second red, third red"
PYTHON
