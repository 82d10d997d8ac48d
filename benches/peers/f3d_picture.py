"""f3d's picture by its defaults, which have no lines, off screen; with a fifth argument `edges`, all triangles' edges.

A picture for PICTURE has f3d's own camera, which shows the whole model.
"""

import sys

import f3d
from turntable import LINE_WIDTH_PX, eye, frames, height, height_degrees, model, placed, run, width

f3d.Log.set_verbose_level(f3d.Log.QUIET)
f3d.Engine.autoload_plugins()
engine = f3d.Engine.create_egl()
options = engine.options
options["render.background.color"] = [1.0, 1.0, 1.0]
if sys.argv[-1] == "edges":
    options["render.show_edges"] = True
    options["render.line_width"] = float(LINE_WIDTH_PX)
engine.window.size = width, height
engine.scene.add(model)
camera = engine.window.camera


def turn(frame, middle, radius):
    camera.focal_point, camera.view_up, camera.view_angle = middle, (0, 1, 0), height_degrees
    camera.position = eye(middle, radius, frame)


def box():
    """The model's corners; f3d tells none."""
    with open(model) as lines:
        points = [[float(word) for word in line.split()[1:4]] for line in lines if line.startswith("v ")]
    return [[choose(axis) for axis in zip(*points)] for choose in (min, max)]


place = placed(*box()) if frames else None


def draw(frame):
    turn(frame, *place)
    content = engine.window.render_to_image().content
    return lambda: content


def save(path):
    engine.window.render_to_image().save(path)


run(f"f3d {f3d.__version__}", draw, save)
