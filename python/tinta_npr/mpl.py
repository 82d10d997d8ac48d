"""Exact lines in matplotlib's axes: vectors in PDF and SVG."""

import numpy as np
from matplotlib.collections import LineCollection

from . import lines as _lines

__all__ = ["ExactLines", "draw"]


def draw(ax, mesh, faces=None, *, camera=None, extent=None, zorder=2, **settings):
    """Add the visible lines of a mesh to axes.

    Parameters
    ----------
    ax : Axes or Axes3D
        2-D axes get a drawing in pixels as units (unless `extent` is given), with equal aspect. 3-D axes get the lines in their
        own projection, updated when it changes; the mesh must lie within their limits, which do not change.
    mesh, faces
        As in `tinta_npr.lines`.
    camera
        As in `tinta_npr.lines`; 3-D axes use their own.
    extent : (left, right, bottom, top), optional
        The place of the picture in 2-D axes.
    **settings
        As in `tinta_npr.lines`. Widths are in points in 3-D axes, and in points for each pixel of the picture in 2-D ones:
        ``hidden="dashed"``, ``line_width=1``, ``class_colors={"crease": "tab:blue"}`` with names of CSS or numbers.

    Returns
    -------
    ExactLines
        A `LineCollection`, added.
    """
    if ax.name == "3d":
        if camera is not None or extent is not None:
            raise ValueError("camera: 3-D axes have a camera and limits of their own; leave camera and extent out")
        collection = ExactLines(ax, mesh, faces, settings, zorder)
        ax.add_collection(collection, autolim=False)
        return collection
    found = _lines(mesh, faces, camera=camera, **settings)
    width, height = found.size
    left, right, bottom, top = (0, width, 0, height) if extent is None else extent
    scale = np.array([(right - left) / width, (bottom - top) / height])
    collection = LineCollection([], zorder=zorder, capstyle="round", joinstyle="round")
    _fill(collection, found, lambda points: points * scale + (left, top))
    ax.add_collection(collection)
    if extent is None:
        ax.set_aspect("equal")
    ax.autoscale_view()
    return collection


class ExactLines(LineCollection):
    """The visible lines of a mesh in the view of 3-D axes."""

    def __init__(self, axes, mesh, faces, settings, zorder):
        super().__init__([], zorder=zorder, capstyle="round", joinstyle="round")
        self._mesh, self._faces, self._settings = mesh, faces, settings
        self._seen = None
        self._find(axes)

    def do_3d_projection(self):
        """Finds the lines again if the view has changed; 3-D axes call it before they draw."""
        self._find(self.axes)
        # In front of everything with a depth: the lines already exclude hidden parts.
        return 0.0

    def _find(self, axes):
        box = axes.bbox
        seen = np.concatenate([axes.get_proj().ravel(), box.extents, [axes.figure.dpi]])
        if self._seen is not None and np.array_equal(seen, self._seen):
            return
        found = _lines(self._mesh, self._faces, camera=axes, **self._settings)
        corners = axes.transData.inverted().transform([(box.x0, box.y1), (box.x1, box.y0)])
        scale = (corners[1] - corners[0]) / found.size
        _fill(self, found, lambda points: points * scale + corners[0])
        self._seen = seen


def _fill(collection, found, placed):
    """Gives a collection the paths of a drawing with their colours, widths and dashes, the lowest first."""
    paths, colors, widths, styles = [], [], [], []
    for layer in found.layers():
        style = "solid"
        if layer["dash"] is not None:
            # matplotlib counts dashes in widths of their line.
            style = (0, [length / layer["width"] for length in layer["dash"]])
        for path in layer["paths"]:
            paths.append(placed(path))
            colors.append((*layer["color"], layer["opacity"]))
            widths.append(layer["width"])
            styles.append(style)
    collection.set_segments(paths)
    collection.set_color(colors)
    collection.set_linewidth(widths)
    collection.set_linestyle(styles or "solid")
