# SPDX-License-Identifier: MIT
# What Blender makes of a file that we wrote: tells its objects, vertices, attributes and cameras, and draws it by its colours alone, unlit.
#
#     blender --background --factory-startup --python blender.py -- room.glb room.png
import sys

import bpy
import numpy
from mathutils import Vector

numpy.bool = bool  # Blender 3.4 asks for it, NumPy 1.24 has it no more

path, picture = sys.argv[sys.argv.index("--") + 1 :]
bpy.ops.wm.read_factory_settings(use_empty=True)
readers = {
    "glb": lambda: bpy.ops.import_scene.gltf(filepath=path),
    "obj": lambda: bpy.ops.wm.obj_import(filepath=path),
    "ply": lambda: bpy.ops.import_mesh.ply(filepath=path),
}
readers[path.rsplit(".", 1)[1]]()
scene = bpy.context.scene
meshes = [o for o in scene.objects if o.type == "MESH"]
if not meshes:
    sys.exit("no mesh was read")
low, high = [1e300] * 3, [-1e300] * 3
for o in meshes:
    attributes = ", ".join(f"{a.name} ({a.domain.lower()}, {a.data_type.lower()})" for a in o.data.attributes if not a.name.startswith("."))
    print(f"mesh {o.name}: {len(o.data.vertices)} vertices, {len(o.data.polygons)} faces; {attributes}")
    for corner in o.bound_box:
        place = o.matrix_world @ Vector(corner)
        low, high = [min(a, b) for a, b in zip(low, place)], [max(a, b) for a, b in zip(high, place)]
    # Its colours as they are: emission of the attribute, seen from the front alone, as the solver's surfaces are.
    colors = o.data.color_attributes
    if colors:
        material = bpy.data.materials.new("colours")
        material.use_nodes = True
        nodes, links = material.node_tree.nodes, material.node_tree.links
        nodes.clear()
        kinds = ("VertexColor", "Emission", "NewGeometry", "BsdfTransparent", "MixShader", "OutputMaterial")
        attribute, light, place, nothing, either, out = (nodes.new("ShaderNode" + kind) for kind in kinds)
        attribute.layer_name = colors[0].name
        links.new(attribute.outputs[0], light.inputs[0])
        links.new(place.outputs["Backfacing"], either.inputs[0])
        links.new(light.outputs[0], either.inputs[1])
        links.new(nothing.outputs[0], either.inputs[2])
        links.new(either.outputs[0], out.inputs[0])
        o.data.materials.clear()
        o.data.materials.append(material)
print("bounds", *(f"{v:.4g}" for v in low + high))
cameras = [o for o in scene.objects if o.type == "CAMERA"]
print("cameras", *(c.name for c in cameras))
if not cameras:
    middle, size = (Vector(low) + Vector(high)) / 2, (Vector(high) - Vector(low)).length
    camera = bpy.data.objects.new("view", bpy.data.cameras.new("view"))
    camera.location = middle + size * Vector((-0.5, -1.1, 0.55))
    camera.rotation_euler = (middle - camera.location).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(camera)
    cameras = [camera]
scene.camera = cameras[0]
scene.render.engine = "CYCLES"
scene.cycles.samples = 4
scene.cycles.device = "CPU"
scene.cycles.max_bounces = 0
scene.cycles.use_denoising = False
scene.render.threads_mode, scene.render.threads = "FIXED", 1
scene.view_settings.view_transform = "Standard"
scene.render.resolution_x, scene.render.resolution_y = 400, 300
scene.render.filepath = picture
bpy.ops.render.render(write_still=True)
