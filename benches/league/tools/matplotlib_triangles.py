"""matplotlib: a Poly3DCollection of white triangles with black edges, sorted by their mean depth, as plot_trisurf draws them.

The axes take the camera's matrix in place of the one that elevation and azimuth give. A line is 2 px wide.
"""

import time

import matplotlib

matplotlib.use("agg")

import numpy as np  # noqa: E402
from common import LINE_WIDTH_PX, arguments, done, read_triangles  # noqa: E402
from matplotlib import pyplot  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: E402

DOTS_PER_INCH = 100

model, camera, drawing = arguments()
since = time.perf_counter()
points, triangles = read_triangles(model)
figure = pyplot.figure(figsize=(camera["size"] / DOTS_PER_INCH, camera["size"] / DOTS_PER_INCH), dpi=DOTS_PER_INCH)
axes = figure.add_axes((0, 0, 1, 1), projection="3d")
axes.set_axis_off()
matrix = np.array(camera["clip_from_world"])
axes.get_proj = lambda: matrix
width = LINE_WIDTH_PX * 72 / DOTS_PER_INCH
axes.add_collection3d(Poly3DCollection(points[triangles], facecolors="white", edgecolors="black", linewidths=width))
# The picture's edges, in the flat axes below the three-dimensional ones.
axes.viewLim.intervalx = axes.viewLim.intervaly = (-1, 1)
figure.savefig(drawing, dpi=DOTS_PER_INCH)
done(f"matplotlib {matplotlib.__version__}", "Agg", since)
