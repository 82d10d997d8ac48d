"""A PyVista scene, before and after: contour lines on hills, in the colours of their scalars."""

import pyvista
import pyvista.examples
import tinta_npr

# %% PyVista's file is one picture of pixels, where lines sink into the surface.
hills = pyvista.examples.load_random_hills()
plotter = pyvista.Plotter(off_screen=True, window_size=(560, 360))
plotter.add_mesh(hills, color="linen")
plotter.add_mesh(hills.contour(12), line_width=3, scalar_bar_args={"vertical": True, "position_x": 0.8})
plotter.save_graphic("hills-pyvista.svg")
tinta_npr.pv.export_svg(plotter, "hills-tinta.svg", fill=True)
