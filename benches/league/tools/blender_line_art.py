"""Blender's Line Art: contours, creases, edge boundaries and intersections of the modifier, written by Grease Pencil's own SVG export.

As the manual's page "Line Art Modifier" has it, on the whole scene. Its crease threshold is the angle between the faces themselves,
so that 150 degrees is what others call 30. The export is with uniform widths, which are then set to 2 px in the file.
"""

import math
import re
import time
from pathlib import Path

import bpy
from blender_scene import finish, prepare
from common import CREASE_DEGREES, LINE_WIDTH_PX, arguments

model, camera, drawing = arguments()
since = time.perf_counter()
scene, mesh = prepare(model, camera)
bpy.ops.object.grease_pencil_add(type="LINEART_SCENE")
pencil = bpy.context.object
art = next(modifier for modifier in pencil.modifiers if modifier.type == "LINEART")
art.use_contour = art.use_crease = art.use_intersection = True
art.use_loose = art.use_material = art.use_edge_mark = False
art.crease_threshold = math.radians(180 - CREASE_DEGREES)
art.level_start = art.level_end = 0
art.stroke_depth_offset = 0.0
bpy.context.view_layer.update()
# The export draws what a 3D view shows: that of the camera.
window = bpy.context.window_manager.windows[0]
area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
area.spaces[0].region_3d.view_perspective = "CAMERA"
region = next(region for region in area.regions if region.type == "WINDOW")
with bpy.context.temp_override(window=window, area=area, region=region):
    bpy.ops.wm.grease_pencil_export_svg(
        filepath=drawing,
        selected_object_type="ACTIVE",
        use_fill=False,
        use_clip_camera=True,
        use_uniform_width=True,
        stroke_sample=0.0,
    )
# A stroke's width follows its distance; in the file each becomes as wide as other programs' lines.
svg = Path(drawing)
svg.write_text(re.sub(r'stroke-width="[^"]*"', f'stroke-width="{LINE_WIDTH_PX}"', svg.read_text()))
finish("Line Art", since)
