"""PyVista's smooth mesh with add_silhouette, whose feature angle adds creases, off screen, without multisampling."""

import pyvista
from turntable import CREASE_DEGREES, LINE_WIDTH_PX, eye, height, height_degrees, model, placed, run, width

mesh = pyvista.read(model)
plotter = pyvista.Plotter(off_screen=True, window_size=(width, height))
plotter.render_window.SetMultiSamples(0)
plotter.set_background("white")
plotter.add_mesh(mesh, color="tan", smooth_shading=True)
plotter.add_silhouette(mesh, color="black", line_width=LINE_WIDTH_PX, feature_angle=CREASE_DEGREES)
middle, radius = placed(mesh.bounds[0::2], mesh.bounds[1::2])
camera = plotter.camera
camera.focal_point, camera.up, camera.view_angle = middle, (0, 1, 0), height_degrees
plotter.camera_set = True


def turn(frame):
    camera.position = eye(middle, radius, frame)
    camera.clipping_range = (radius * 0.5, radius * 8)


def draw(frame):
    turn(frame)
    plotter.render()
    return plotter.screenshot(return_img=True).tobytes


def save(path):
    turn(0)
    plotter.screenshot(path)


run(f"PyVista {pyvista.__version__}", draw, save)
