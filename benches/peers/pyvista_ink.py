"""PyVista's mesh with silhouette and feature edges off screen: pyvista_ink.py POINTS TRIANGLES SIZE FRAMES

POINTS and TRIANGLES as for vtk_edges.py. Prints one JSON object with each frame's milliseconds, read-back included, no
multisampling. The camera turns by 3 degrees a frame.
"""
import json
import sys
import time

import numpy as np
import pyvista
import vtk

points = np.fromfile(sys.argv[1]).reshape(-1, 3)
triangles = np.fromfile(sys.argv[2], dtype=np.int64).reshape(-1, 3)
size, frames = int(sys.argv[3]), int(sys.argv[4])
faces = np.c_[np.full(len(triangles), 3), triangles].ravel()
mesh = pyvista.PolyData(points.astype(np.float32), faces)
plotter = pyvista.Plotter(off_screen=True, window_size=(size, size))
window = plotter.render_window
window.SetMultiSamples(0)
plotter.set_background("white")
plotter.add_mesh(mesh, color="tan", smooth_shading=True)
plotter.add_silhouette(mesh, color="black", line_width=2, feature_angle=None)
plotter.add_mesh(mesh.extract_feature_edges(float(np.degrees(np.arccos(0.4)))), color="black", line_width=2)
plotter.show(auto_close=False)
pixels = vtk.vtkUnsignedCharArray()
times = []
for frame in range(frames + 2):
    start = time.perf_counter()
    plotter.camera.azimuth = 3.0 * frame
    plotter.render()
    window.GetRGBACharPixelData(0, 0, size - 1, size - 1, 0, pixels)
    times.append((time.perf_counter() - start) * 1e3)
if len(sys.argv) > 5:
    plotter.screenshot(sys.argv[5])
print(json.dumps({"pyvista": pyvista.__version__, "vtk": vtk.VTK_VERSION, "frame_ms": times[2:]}))
