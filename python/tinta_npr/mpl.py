"""Exact lines in matplotlib's axes: vectors in PDF and SVG."""

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgb

from . import CLASSES, Lines, _native, _reading, _with_settings
from . import lines as _lines
from ._mesh import meshes_of

__all__ = ["ExactLines", "draw"]


def draw(ax, mesh, faces=None, *, camera=None, extent=None, zorder=2, look=None, preset=None, color=None, **settings):
    """Add the visible lines of a mesh to axes.

    Parameters
    ----------
    ax : Axes or Axes3D
        2-D axes get a drawing in pixels as units (unless `extent` is given), y up, with equal aspect. 3-D axes get the lines in
        their own projection, updated when it changes; limits that you have not set are scaled to the mesh.
    mesh, faces
        As in `tinta_npr.lines`; for 2-D axes also its result.
    camera, look, preset
        As in `tinta_npr.lines`; 3-D axes have a camera of their own.
    extent : (left, right, bottom, top), optional
        The place of the picture in 2-D axes.
    zorder : float
        matplotlib's order of drawing.
    color : color, optional
        The colour of all lines; those of `class_colors` override it.
    **settings
        As in `tinta_npr.lines`. Widths are in points in 3-D axes, and in points for each pixel of the picture in 2-D ones:
        ``hidden="dashed"``, ``line_width=1``, ``class_colors={"crease": "tab:blue"}`` with any colours of matplotlib.

    Returns
    -------
    ExactLines or LineCollection
        Added to 3-D or 2-D axes.

    Settings
    --------
    """
    settings = {"look": look, "preset": preset, **_with_colors(settings, color)}
    if ax.name == "3d":
        if camera is not None or extent is not None:
            raise ValueError("camera: 3-D axes have a camera and limits of their own; leave camera and extent out")
        reading = {**_native.reading("lines", None, look, preset), **_reading(dict(settings))}
        collection = ExactLines(ax, meshes_of(mesh, faces, None, reading), settings, zorder)
        ax.add_collection(collection, autolim=False)
        return collection
    if isinstance(mesh, Lines):
        found, layers = mesh, mesh.layers(**{name: value for name, value in settings.items() if value is not None})
    else:
        found = _lines(mesh, faces, camera=camera, **settings)
        layers = found.layers()
    width, height = found.size
    left, right, bottom, top = (0, width, 0, height) if extent is None else extent
    scale = np.array([(right - left) / width, (bottom - top) / height])
    collection = LineCollection([], zorder=zorder, capstyle="round", joinstyle="round")
    _fill(collection, layers, lambda points: points * scale + (left, top))
    ax.add_collection(collection)
    if extent is None:
        ax.set_aspect("equal")
    ax.autoscale_view()
    return collection


class ExactLines(LineCollection):
    """The visible lines of meshes in the view of 3-D axes."""

    def __init__(self, axes, meshes, settings, zorder):
        super().__init__([], zorder=zorder, capstyle="round", joinstyle="round")
        self._meshes, self._settings = meshes, settings
        ends = [[mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)] for mesh in meshes]
        self._ends = np.concatenate(ends)
        self._seen = None
        self._is_warned = False
        axes.auto_scale_xyz(*self._ends.T, had_data=axes.has_data())
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
        self._warn_of_limits(axes)
        found = _lines(self._meshes, camera=axes, **self._settings)
        corners = axes.transData.inverted().transform([(box.x0, box.y1), (box.x1, box.y0)])
        scale = (corners[1] - corners[0]) / found.size
        _fill(self, found.layers(), lambda points: points * scale + corners[0])
        self._seen = seen

    def _warn_of_limits(self, axes):
        low, high = np.sort([axes.get_xlim(), axes.get_ylim(), axes.get_zlim()], axis=1).T
        slack = 1e-9 * (high - low)
        if not self._is_warned and ((self._ends < low - slack) | (self._ends > high + slack)).any():
            self._is_warned = True
            _native.warn("the mesh reaches beyond the limits of the axes, and is drawn there, too; widen the limits")


def _with_colors(settings, color):
    """Settings with matplotlib's colours as numbers; those that only tinta knows, such as ``rgb(1 2 3)``, stay."""
    named = settings.get("class_colors")
    if color is not None:
        if isinstance(named, str):
            raise ValueError("color: give class_colors as a dict beside it")
        named = {**dict.fromkeys(CLASSES, color), **(named or {})}
    if not hasattr(named, "items"):
        return settings

    def numbers(color):
        try:
            return to_rgb(color)
        except ValueError:
            return color

    return {**settings, "class_colors": {name: numbers(color) for name, color in named.items()}}


def _fill(collection, layers, placed):
    """Gives a collection the paths of a drawing with their colours, widths and dashes, the lowest first."""
    paths, colors, widths, styles = [], [], [], []
    for layer in layers:
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


_with_settings(draw, "lines")
