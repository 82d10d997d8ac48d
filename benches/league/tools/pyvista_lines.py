"""PyVista: add_silhouette with its feature angle, over a white mesh, as its example "Display the silhouette of a mesh" has it.

vtkPolyDataSilhouette draws silhouettes, feature edges and borders in one. Coincident topology is resolved by PyVista's own default for
lines over surfaces; multisampling is PyVista's default.
"""

import time

import pyvista
from common import CREASE_DEGREES, LINE_WIDTH_PX, arguments, done

model, camera, drawing = arguments()
since = time.perf_counter()
mesh = pyvista.read(model)
plotter = pyvista.Plotter(off_screen=True, window_size=(camera["size"], camera["size"]))
plotter.set_background("white")
plotter.add_mesh(mesh, color="white", lighting=False)
plotter.add_silhouette(mesh, color="black", line_width=LINE_WIDTH_PX, feature_angle=CREASE_DEGREES)
plotter.camera.position = camera["eye"]
plotter.camera.focal_point = camera["target"]
plotter.camera.up = camera["up"]
plotter.camera.view_angle = camera["fov_y_degrees"]
plotter.camera.clipping_range = (camera["near"], camera["far"])
plotter.camera_set = True
plotter.screenshot(drawing)
renderer = next((line for line in plotter.render_window.ReportCapabilities().splitlines() if "renderer string" in line), "")
done(f"PyVista {pyvista.__version__}, VTK {'.'.join(map(str, pyvista.vtk_version_info))}", renderer.split(":")[-1].strip(), since)
