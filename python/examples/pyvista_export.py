"""The scene of a PyVista plotter, as vectors for a paper."""

import pyvista as pv
import tinta_npr

# %% A scene as PyVista draws it.
plotter = pv.Plotter(off_screen=True, window_size=(480, 360))
plotter.add_mesh(pv.ParametricTorus(ringradius=1.0, crosssectionradius=0.4), color="tan")
plotter.add_mesh(pv.Cube(center=(0, 0, 0), x_length=0.7, y_length=0.7, z_length=0.7))
plotter.view_isometric()

# %% The same scene from the same camera as lines: the usual ones, hidden ones dashed, a manual's.
tinta_npr.pv.export_svg(plotter, "pyvista.svg")
tinta_npr.pv.export_svg(plotter, "pyvista-hidden.svg", hidden="dashed", line_width=1.5)
tinta_npr.pv.export_svg(plotter, "pyvista.pdf", class_widths={"outline": 3}, width_mm=85)

# %% With the colours of its actors below the lines: the height of the torus with its scalar bar, and tan, seen through it.
plotter.clear_actors()
torus = pv.ParametricTorus(ringradius=1.0, crosssectionradius=0.4)
plotter.add_mesh(torus, scalars=torus.points[:, 2], cmap="viridis", opacity=0.7, scalar_bar_args={"title": "height"})
plotter.add_mesh(pv.Cube(x_length=0.7, y_length=0.7, z_length=0.7), color="tan")
tinta_npr.pv.export_svg(plotter, "pyvista-filled.svg", fill=True, classes="boundary,silhouette")

# %% In ink, with the same camera.
torus = pv.ParametricTorus(ringradius=1.0, crosssectionradius=0.4)
tinta_npr.render(torus, camera=plotter.camera, style="ink", size=(480, 360)).save("pyvista-ink.png")
plotter.close()
