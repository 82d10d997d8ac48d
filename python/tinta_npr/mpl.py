"""Exact lines and areas in matplotlib's axes: vectors in PDF and SVG."""

import warnings

import numpy as np
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.colors import to_rgb, to_rgba
from matplotlib.legend import Legend
from matplotlib.legend_handler import HandlerPolyCollection
from matplotlib.path import Path
from matplotlib.transforms import IdentityTransform

from . import CLASSES, Lines, Regions, _native, _reading, _with_settings
from . import lines as _lines
from ._camera import of_axes, refuse_scales
from ._mesh import meshes_of

__all__ = ["ExactAreas", "ExactLines", "ExactScene", "draw", "draw3d", "fill"]

#: Width of an area's edge in its own colour, points: without it the ground shines through between neighbours.
_EDGE = 0.4


def draw(
    ax, mesh, faces=None, *, camera=None, extent=None, zorder=2, look=None, preset=None, color=None, label=None, linewidth=None,
    lw=None, **settings
):
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
    label : str, optional
        The text in the axes' legend.
    linewidth, lw : float, optional
        The width of lines in points, as `line_width`.
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
    if (width := _width(linewidth, lw, settings.get("line_width"))) is not None:
        settings["line_width"] = width
    if ax.name == "3d":
        collection = ExactLines(ax, *_of_axes(mesh, faces, camera, extent, settings), zorder=zorder)
        collection.set_label(label)
        return _added_3d(ax, collection)
    if isinstance(mesh, Lines):
        found, layers = mesh, mesh.layers(**{name: value for name, value in settings.items() if value is not None})
    else:
        found = _lines(mesh, faces, camera=camera, **settings)
        layers = found.layers()
    collection = LineCollection([], zorder=zorder, capstyle="round", joinstyle="round", label=label)
    _fill(collection, layers, _placed(found.size, extent))
    return _added(ax, collection, extent)


def fill(
    ax, mesh, faces=None, *, by="face", values=None, colors=None, cmap=None, norm=None, vmin=None, vmax=None, camera=None,
    extent=None, zorder=1, look=None, preset=None, label=None, linewidth=None, lw=None, **settings
):
    """Add the visible areas of a mesh to axes, below its lines: opaque polygons, cut exactly where faces in front hide them.

    Parameters
    ----------
    ax : Axes or Axes3D
        As in `draw`.
    mesh, faces
        As in `tinta_npr.lines`; for 2-D axes also its result, and that of `tinta_npr.Lines.regions`.
    by : {"face", "material", "object", "tone"}
        As in `tinta_npr.Lines.regions`.
    values : array_like (M,), or a list of them, optional
        A scalar for each face of the mesh, mapped to colours by `cmap`, `norm`, `vmin` and `vmax` as everywhere in matplotlib; a
        list for several meshes. ``figure.colorbar`` takes the result.
    colors : array_like (M, 3) or (M, 4), or a list of them, optional
        A colour for each face of the mesh, from 0 to 1. Without values and colours, tones are grey, and faces, materials and
        objects have the colours of `cmap` by their numbers.
    camera, extent, look, preset, **settings
        As in `draw`; only the camera and the size matter.
    zorder : float
        matplotlib's order of drawing.
    label : str, optional
        The text in the axes' legend.
    linewidth, lw : float, optional
        The width of each area's edge, which has its own colour, points: 0.4, or 0 below an opacity of 1.

    Returns
    -------
    ExactAreas or PathCollection
        Added to 3-D or 2-D axes.

    Settings
    --------
    """
    settings = {"look": look, "preset": preset, **settings}
    shown = {"by": by, "values": values, "colors": colors, "width": _width(linewidth, lw, None)}
    scale = {"cmap": cmap, "norm": norm, "zorder": zorder, "label": label}
    if values is not None and colors is not None:
        raise ValueError("values: they become colours; leave out one of values and colors")
    if ax.name == "3d":
        collection = ExactAreas(ax, *_of_axes(mesh, faces, camera, extent, settings), shown=shown, **scale)
    elif isinstance(mesh, Regions):
        collection = _show(FlatAreas([], **scale), mesh, shown, _placed(mesh.size, extent))
    else:
        found = mesh if isinstance(mesh, Lines) else _lines(mesh, faces, camera=camera, **_of_areas(settings))
        collection = _show(FlatAreas([], **scale), found.regions(by), shown, _placed(found.size, extent))
    if vmin is not None or vmax is not None:
        collection.set_clim(vmin, vmax)
    return _added_3d(ax, collection) if ax.name == "3d" else _added(ax, collection, extent)


def draw3d(ax, *, classes=(), hidden=None, color="black", line_width=None, linewidth=None, lw=None, on_surface=None):
    """Draw what 3-D axes hold again, with exact hiding between all of it.

    matplotlib sorts whole artists by one depth each. This takes surfaces (`plot_surface`, `plot_trisurf`, `bar3d`, `contourf`, any
    `Poly3DCollection`), curves (`plot`, `plot_wireframe`, `quiver`, `contour`) and points (`scatter`, markers) as they are now, makes
    them invisible, and adds areas, strokes and markers cut exactly where something hides them: vectors in PDF and SVG, found again when
    the view changes. Colours, widths, dashes and markers stay. Panes, axes, texts and legends stay matplotlib's; a warning names other
    artists that do. Give axes their scales, such as logarithmic ones, first.

    Parameters
    ----------
    ax : Axes3D
        Translucent surfaces are drawn as opaque ones, in their colour over that of the axes, with a warning; ``hidden`` shows the
        curves behind them. A marker is seen or hidden as
        a whole, by its point.
    classes : sequence of str
        Lines of surfaces to draw beside their own edges: ``["silhouette", "boundary", "crease", "intersection"]`` …
    hidden : {"dashed", "ghost"}, optional
        Draws hidden pieces of curves and lines, fainter.
    color, line_width, linewidth, lw
        Of the lines of `classes`; the width in points, 0.8 by default, by any of these names.
    on_surface : float, optional
        How far behind a face a curve or point may lie and still be drawn, a share of the scene's radius (0.0001 by default): for
        curves on a surface. Edges of polygons need it, too.

    Returns
    -------
    ExactScene
        ``lines``: the `tinta_npr.Lines` of the current view; ``remove()`` takes the drawing away and shows matplotlib's artists.
    """
    if getattr(ax, "name", None) != "3d":
        raise TypeError("ax: draw3d takes 3-D axes; draw and fill take 2-D ones")
    if hidden not in (None, "none", "dashed", "ghost"):
        raise ValueError(f"hidden: it is dashed or ghost, not {hidden}")
    classes = [classes] if isinstance(classes, str) else list(classes)
    for name in classes:
        if name not in CLASSES:
            raise ValueError(f"classes: there is no class {name}; choose from {', '.join(CLASSES)}")
    hidden = None if hidden == "none" else hidden
    width = _width(linewidth, lw, line_width)
    return ExactScene(ax, classes, hidden, (to_rgba(color), 0.8 if width is None else width, "solid"), on_surface)


def _width(linewidth, lw, line_width):
    """The one width that is given, by matplotlib's names or tinta's."""
    given = [width for width in (line_width, linewidth, lw) if width is not None]
    if len(given) > 1:
        raise TypeError("linewidth: lw, linewidth and line_width are one width; give one of them")
    return given[0] if given else None


def _of_areas(settings):
    """Settings that find no lines."""
    return {**settings, "areas": "object", "no_borders": True}


def _of_axes(mesh, faces, camera, extent, settings):
    """The meshes of 3-D axes, and the settings of their drawing."""
    if camera is not None or extent is not None:
        raise ValueError("camera: 3-D axes have a camera and limits of their own; leave camera and extent out")
    if isinstance(mesh, (Lines, Regions)):
        raise TypeError("mesh: 3-D axes find lines and areas in each view; give the mesh itself")
    reading = {**_native.reading("lines", None, settings["look"], settings["preset"]), **_reading(dict(settings))}
    return meshes_of(mesh, faces, None, reading), settings


def _placed(size, extent):
    """The function from pixels to 2-D axes."""
    width, height = size
    left, right, bottom, top = (0, width, 0, height) if extent is None else extent
    scale = np.array([(right - left) / width, (bottom - top) / height])
    return lambda points: points * scale + (left, top)


def _added(ax, collection, extent):
    ax.add_collection(collection)
    if extent is None:
        ax.set_aspect("equal")
    ax.autoscale_view()
    return collection


def _added_3d(ax, collection):
    ax.add_collection(collection, autolim=False)
    return collection


class _InView:
    """A collection that 3-D axes find again in each view."""

    def _begin(self, axes, meshes, settings):
        refuse_scales(axes)
        self._meshes, self._settings = meshes, settings
        ends = [[mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)] for mesh in meshes]
        self._ends = np.concatenate(ends)
        self._seen = None
        self._is_warned = False
        axes.auto_scale_xyz(*self._ends.T, had_data=axes.has_data())
        self._find(axes)

    def do_3d_projection(self):
        """Finds them again if the view has changed; 3-D axes call it before they draw."""
        self._find(self.axes)
        # In front of everything with a depth: hidden parts are excluded already.
        return -1e9

    def _find(self, axes):
        box = axes.bbox
        seen = np.concatenate([axes.get_proj().ravel(), box.extents, [axes.figure.dpi]])
        if self._seen is not None and np.array_equal(seen, self._seen):
            return
        self._warn_of_limits(axes)
        settings = dict(self._settings)
        found = _lines(self._meshes or None, camera=self._view_of(axes, settings), **settings)
        corners = axes.transData.inverted().transform([(box.x0, box.y1), (box.x1, box.y0)])
        scale = (corners[1] - corners[0]) / found.size
        self._take(found, lambda points: points * scale + corners[0])
        self._seen = seen

    def _view_of(self, axes, _settings):
        return axes

    def _warn_of_limits(self, axes):
        low, high = np.sort([axes.get_xlim(), axes.get_ylim(), axes.get_zlim()], axis=1).T
        slack = 1e-9 * (high - low)
        if not self._is_warned and ((self._ends < low - slack) | (self._ends > high + slack)).any():
            self._is_warned = True
            _native.warn("the mesh reaches beyond the limits of the axes, and is drawn there, too; widen the limits")


class ExactLines(_InView, LineCollection):
    """The visible lines of meshes in the view of 3-D axes."""

    def __init__(self, axes, meshes, settings, zorder):
        super().__init__([], zorder=zorder, capstyle="round", joinstyle="round")
        self._begin(axes, meshes, settings)

    def _take(self, found, placed):
        _fill(self, found.layers(), placed)


class ExactAreas(_InView, PathCollection):
    """The visible areas of meshes in the view of 3-D axes."""

    def __init__(self, axes, meshes, settings, shown, **scale):
        super().__init__([], **scale)
        self._shown = shown
        self._begin(axes, meshes, _of_areas(settings))

    def _take(self, found, placed):
        _show(self, found.regions(self._shown["by"]), self._shown, placed)


class FlatAreas(PathCollection):
    """The visible areas of meshes in 2-D axes."""


# A legend shows them as a rectangle, and not as the first area.
Legend.update_default_handler_map({ExactAreas: HandlerPolyCollection(), FlatAreas: HandlerPolyCollection()})


class ExactScene(_InView, PathCollection):
    """What 3-D axes held, drawn with exact hiding: its areas, with its strokes and markers above them."""

    is_exact = True

    def __init__(self, axes, classes, hidden, outline, on_surface):
        # It reads what matplotlib keeps for itself: other drawings work without.
        from . import _mpl3d

        super().__init__([], linewidth=_EDGE)
        surfaces, curves, self._dots, self._replaced = _mpl3d.held(axes)
        if not self._replaced:
            raise ValueError("ax: it holds no surfaces, curves and points; plot them first")
        if not (surfaces or curves or self._dots):
            raise ValueError("ax: nothing of its surfaces, curves and points is left to draw: their values are NaN or masked")
        if any(surface.is_clear for surface in surfaces):
            _native.warn("translucent surfaces are drawn as opaque ones; hidden=\"ghost\" shows the curves behind them")
        self._hidden, self._outline = hidden, outline
        paths = [path for one in curves for path in one.curves]
        self._styles = [style for one in curves for style in one.styles]
        self._path_ends = np.cumsum([len(path) for path in paths])
        self._strokes = _mpl3d.Strokes([], capstyle="butt", joinstyle="round")
        self._marks = [_mpl3d.Marks(dots.paths, offsets=np.empty((0, 2)), offset_transform=axes.transData) for dots in self._dots]
        for marks in self._marks:
            # Sizes are in points already.
            marks.set_transform(IdentityTransform())
        of_surfaces = [surface.mesh_and_colors() for surface in surfaces]
        self._meshes, self._colors = [mesh for mesh, _ in of_surfaces], [colors for _, colors in of_surfaces]
        points = [dots.points for dots in self._dots]
        self._settings = {"classes": [*classes, "curve", "point"], "on_surface": on_surface}
        self._settings |= {"curves": paths} if paths else {}
        self._settings |= {"points": np.concatenate(points)} if points else {}
        # Limits stay as they are.
        self._ends, self._seen, self._is_warned = np.empty((0, 3)), None, True
        # Before matplotlib's artists go: what cannot be drawn leaves the axes as they were.
        self._find(axes)
        for artist in self._replaced:
            artist.set_visible(False)
        for collection in (self, self._strokes, *self._marks):
            axes.add_collection(collection, autolim=False)

    def _view_of(self, axes, settings):
        # Its positions are on the axes' scales already.
        return of_axes(axes, settings)

    def _find(self, axes):
        with warnings.catch_warnings():
            # Areas and points are enough.
            warnings.filterwarnings("ignore", "no line of these classes")
            super()._find(axes)

    def _take(self, found, placed):
        from . import _mpl3d

        self.lines = found
        if self._meshes:
            colors = self._colors if len(self._colors) > 1 else self._colors[0]
            _show(self, found.regions("face"), {"values": None, "colors": colors, "by": "face", "width": None}, placed)
        lines, colors, widths, dashes = _mpl3d.strokes_of(found, self._styles, self._path_ends, self._outline, self._hidden)
        self._strokes.set_segments([placed(path) for path in lines])
        self._strokes.set_color(colors)
        self._strokes.set_linewidth(widths)
        self._strokes.set_linestyle(dashes or "solid")
        is_point = (found.cls == "point") & found.visible
        first = self._path_ends[-1] if len(self._path_ends) else 0
        numbers, places = found.edge[is_point, 0] - first, placed(found.segments[is_point, 0])
        for marks, dots in zip(self._marks, self._dots):
            own = (numbers >= 0) & (numbers < len(dots.points))
            marks.set_offsets(places[own])
            marks.set(**dots.seen(numbers[own]))
            numbers = numbers - len(dots.points)

    def remove(self):
        """Takes the drawing away and shows matplotlib's artists."""
        super().remove()
        for collection in (self._strokes, *self._marks):
            collection.remove()
        for artist in self._replaced:
            artist.set_visible(True)


def _show(collection, regions, shown, placed):
    """Gives a collection the areas except the background, with their values or colours."""
    chosen = np.flatnonzero(regions.object >= 0)
    loops = regions.loops
    collection.set_paths([_path([placed(corners) for corners in loops[index]]) for index in chosen])
    values, colors, width = shown["values"], shown["colors"], _EDGE
    if colors is not None:
        colors = regions.of_faces(colors)[chosen]
        collection.set_facecolor(colors)
        # Overlapping edges would draw a net.
        width = _EDGE if colors.shape[1] < 4 or (colors[:, 3] == 1).all() else 0.0
    elif values is not None:
        collection.set_array(regions.of_faces(values)[chosen])
    elif regions.by == "tone":
        greys = (0.55 + 0.45 * regions.tone[chosen] / max(1, regions.tone.max(initial=0))).astype(str)
        collection.set_facecolor(greys.tolist())
    else:
        numbers = {"face": regions.face, "material": regions.material, "object": regions.object}[regions.by]
        collection.set_array(numbers[chosen].astype(float))
    collection.set_edgecolor("face")
    collection.set_linewidth(width if shown["width"] is None else shown["width"])
    return collection


def _path(loops):
    """Closed polygons as one path."""
    codes = [np.full(len(corners) + 1, Path.LINETO, dtype=Path.code_type) for corners in loops]
    for code in codes:
        code[0], code[-1] = Path.MOVETO, Path.CLOSEPOLY
    corners = [np.concatenate([corners, corners[:1]]) for corners in loops]
    return Path(np.concatenate(corners), np.concatenate(codes))


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


for _function in (draw, fill):
    _with_settings(_function, "lines")
