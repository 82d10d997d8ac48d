"""Blender Freestyle's lines of a model, for benches/lines.rs.

blender -b --factory-startup --debug-freestyle -P freestyle_lines.py -- MODEL OUT.png

The same classes of lines and the same crease angle as tinta's default: silhouettes, borders, creases. Freestyle prints how
long its stages take; the script adds nothing but the picture it needs to be asked for.
"""
import math
import sys

import bpy
from mathutils import Vector

model, picture = sys.argv[sys.argv.index("--") + 1 :]
bpy.ops.object.select_all(action="SELECT")
bpy.ops.object.delete()
if hasattr(bpy.ops.wm, "obj_import"):
    bpy.ops.wm.obj_import(filepath=model)
else:
    bpy.ops.import_scene.obj(filepath=model)
thing = bpy.context.selected_objects[0]
corners = [thing.matrix_world @ Vector(corner) for corner in thing.bound_box]
centre = sum(corners, Vector()) / 8
scale = 1 / max((corner - centre).length for corner in corners)
thing.location -= centre
thing.scale = (scale,) * 3
thing.location *= scale

scene = bpy.context.scene
lens = bpy.data.cameras.new("camera")
camera = bpy.data.objects.new("camera", lens)
scene.collection.objects.link(camera)
scene.camera = camera
lens.angle = math.radians(40)
camera.location = (1.5, -2.6, 1.0)
camera.rotation_euler = (-camera.location).to_track_quat("-Z", "Y").to_euler()

render = scene.render
render.engine = "BLENDER_WORKBENCH"
render.resolution_x = render.resolution_y = 512
render.resolution_percentage = 100
render.filepath = picture
render.use_freestyle = True
layer = bpy.context.view_layer
layer.use_freestyle = True
settings = layer.freestyle_settings
settings.crease_angle = math.pi - math.acos(0.4)
lines = settings.linesets[0] if settings.linesets else settings.linesets.new("lines")
lines.select_silhouette = lines.select_border = lines.select_crease = True
bpy.ops.preferences.addon_enable(module="render_freestyle_svg")
scene.svg_export.use_svg_export = True
scene.svg_export.mode = "FRAME"
bpy.ops.render.render(write_still=True)
