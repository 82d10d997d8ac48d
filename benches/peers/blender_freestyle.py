"""Blender's Freestyle, silhouettes, borders and creases, over a mesh that Cycles draws with one sample, from its Python module.

A frame is a render into memory; Blender offers no picture before that is done. With a fifth argument `stages`, Freestyle also prints
how long its stages take.
"""

import math
import sys
from pathlib import Path

import bpy
from mathutils import Matrix, Vector
from turntable import CREASE_DEGREES, LINE_WIDTH_PX, eye, height, height_degrees, model, placed, run, width

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.app.debug_freestyle = sys.argv[-1] == "stages"
scene = bpy.context.scene
bpy.ops.wm.obj_import(filepath=model, forward_axis="Y", up_axis="Z")
mesh = bpy.context.selected_objects[0]
corners = [Vector(corner) for corner in mesh.bound_box]
low, high = ([choose(corner[axis] for corner in corners) for axis in range(3)] for choose in (min, max))
middle, radius = placed(low, high)
world = bpy.data.worlds.new("world")
world.use_nodes = True
world.node_tree.nodes["Background"].inputs[0].default_value = (1, 1, 1, 1)
scene.world = world
lens = bpy.data.cameras.new("camera")
lens.sensor_fit = "VERTICAL"
lens.angle = math.radians(height_degrees)
lens.clip_start, lens.clip_end = radius * 0.5, radius * 8
camera = bpy.data.objects.new("camera", lens)
scene.collection.objects.link(camera)
scene.camera = camera
render = scene.render
render.engine = "CYCLES"
scene.cycles.samples = 1
scene.cycles.use_denoising = False
scene.cycles.max_bounces = 0
scene.cycles.device = "CPU"
render.use_persistent_data = True
render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
render.image_settings.file_format = "PNG"
render.use_freestyle = True
render.line_thickness_mode = "ABSOLUTE"
layer = bpy.context.view_layer
layer.use_freestyle = True
freestyle = layer.freestyle_settings
freestyle.crease_angle = math.radians(180 - CREASE_DEGREES)
lines = freestyle.linesets[0] if freestyle.linesets else freestyle.linesets.new("lines")
lines.select_silhouette = lines.select_border = lines.select_crease = True
lines.select_contour = lines.select_external_contour = False
style = lines.linestyle or bpy.data.linestyles.new("ink")
lines.linestyle = style
style.thickness = LINE_WIDTH_PX
style.color = (0, 0, 0)


def turn(frame):
    place = Vector(eye(middle, radius, frame))
    backward = (place - Vector(middle)).normalized()
    right = Vector((0, 1, 0)).cross(backward).normalized()
    axes = Matrix((right, backward.cross(right), backward)).transposed()
    camera.matrix_world = Matrix.Translation(place) @ axes.to_4x4()


def draw(frame):
    turn(frame)
    bpy.ops.render.render()
    return None


def save(path):
    turn(0)
    render.filepath = str(Path(path).resolve())
    bpy.ops.render.render(write_still=True)


run(f"Blender {bpy.app.version_string}", draw, save)
