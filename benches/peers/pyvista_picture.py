"""A model's picture by PyVista's own defaults, off screen: pyvista_picture.py MODEL PICTURE WIDTH HEIGHT"""

import sys

import pyvista

model, picture, width, height = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
plotter = pyvista.Plotter(off_screen=True, window_size=(width, height))
plotter.add_mesh(pyvista.read(model))
plotter.screenshot(picture)
