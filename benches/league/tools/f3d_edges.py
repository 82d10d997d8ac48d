"""f3d: its option --edges (render.show_edges), which draws the edges of all triangles; it has no silhouettes or creases.

The mesh is white and unlit, so that only lines are dark.
"""

import time

import f3d
from common import LINE_WIDTH_PX, arguments, done

model, camera, drawing = arguments()
since = time.perf_counter()
f3d.Log.set_verbose_level(f3d.Log.QUIET)
f3d.Engine.autoload_plugins()
engine = f3d.Engine.create_egl()
options = engine.options
options["render.show_edges"] = True
options["render.line_width"] = LINE_WIDTH_PX
options["render.background.color"] = [1.0, 1.0, 1.0]
options["model.unlit"] = True
options["model.color.rgb"] = [1.0, 1.0, 1.0]
for name in ("ui.axis", "ui.filename", "render.grid.enable"):
    options[name] = False
engine.window.size = (camera["size"], camera["size"])
engine.scene.add(model)
view = engine.window.camera
view.position = camera["eye"]
view.focal_point = camera["target"]
view.view_up = camera["up"]
view.view_angle = camera["fov_y_degrees"]
engine.window.render_to_image().save(drawing)
done(f"f3d {f3d.__version__}", "EGL", since)
