"""Blender's Freestyle: silhouettes, borders and creases of a line set, rendered by Cycles with one sample over a white world.

As the manual's pages "Freestyle: View Layer" and "Line Set" have it. Its crease angle is the one between the faces themselves, so
that 150 degrees is what others call 30. The mesh emits white, so that only lines are dark; strokes are black and 2 px wide.
"""

import math
import time

import bpy
from blender_scene import finish, prepare
from common import CREASE_DEGREES, LINE_WIDTH_PX, arguments

model, camera, drawing = arguments()
since = time.perf_counter()
scene, mesh = prepare(model, camera)
render = scene.render
render.engine = "CYCLES"
scene.cycles.samples = 1
scene.cycles.use_denoising = False
scene.cycles.max_bounces = 0
scene.cycles.device = "CPU"
render.use_freestyle = True
render.line_thickness_mode = "ABSOLUTE"
render.line_thickness = 1.0
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
render.filepath = drawing
bpy.ops.render.render(write_still=True)
finish("Freestyle", since)
