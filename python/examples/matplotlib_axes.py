"""Exact lines in matplotlib's axes, 3-D and 2-D: vectors in PDF and SVG."""

import matplotlib
import numpy as np
import tinta_npr

matplotlib.use("agg")
import matplotlib.pyplot as plt


def ring(centre, upright, around=72, across=36):
    """A ring of squares."""
    u, v = np.meshgrid(np.arange(around) * 2 * np.pi / around, np.arange(across) * 2 * np.pi / across, indexing="ij")
    x, y, z = (2 + 0.5 * np.cos(v)) * np.cos(u), (2 + 0.5 * np.cos(v)) * np.sin(u), 0.5 * np.sin(v)
    vertices = np.stack([x, z, y] if upright else [x, y, z], axis=-1).reshape(-1, 3) + centre
    number = lambda i, j: ((i % around) * across + j % across).ravel()
    i, j = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    faces = np.column_stack([number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)])
    return tinta_npr.mesh(vertices, faces[:, ::-1] if upright else faces)


# %% In 3-D axes, in their own projection: turn them, and the lines are found anew. Each ring goes through the other, which
# sorting whole surfaces by their depth cannot show.
figure = plt.figure(figsize=(7, 3.4), layout="constrained")
ax = figure.add_subplot(1, 2, 1, projection="3d")
rings = [ring((0, 0, 0), upright=False), ring((2, 0, 0), upright=True)]
tinta_npr.mpl.draw(ax, rings, hidden="dashed", line_width=1.2)
ax.set(title="3-D axes", aspect="equal")

# %% In 2-D axes, as a drawing.
ax = figure.add_subplot(1, 2, 2)
tinta_npr.mpl.draw(
    ax, "builtin:gear", camera="iso", parallel=True, size=240, line_width=0.8,
    class_colors={"silhouette": (0.84, 0.37, 0.0)}, class_widths={"silhouette": 1.6},
)
ax.set(title="2-D axes", xlabel="pixels")
figure.savefig("matplotlib.pdf")
figure.savefig("matplotlib.svg")
figure.savefig("matplotlib.png", dpi=90)
