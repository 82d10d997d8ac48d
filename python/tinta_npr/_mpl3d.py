"""What matplotlib's 3-D axes hold, drawn again as vectors with exact hiding between all of it.

This reads attributes that matplotlib keeps for itself, of its versions 3.8 to 3.11; `mpl` imports it for `draw3d` alone.
"""

import warnings

import matplotlib
import numpy as np
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.colors import to_rgba, to_rgba_array
from matplotlib.markers import MarkerStyle
from matplotlib.path import Path
from mpl_toolkits.mplot3d import art3d
from mpl_toolkits.mplot3d.art3d import Line3D, Line3DCollection, Path3DCollection, Poly3DCollection

from . import _native

#: What its contours are of; older versions have no name for it.
Collection3D = getattr(art3d, "Collection3D", ())


class Surface:
    """A `Poly3DCollection`: polygons, each with the colour of its face."""

    def __init__(self, artist, ground):
        """`ground` is the colour behind a translucent surface."""
        polygons, kept = _polygons(artist)
        count = len(kept)
        kept = np.flatnonzero(kept)
        parts = [_simple(polygon) for polygon in polygons]
        self.polygons = [part for of_polygon in parts for part in of_polygon]
        kept = np.repeat(kept, [len(of_polygon) for of_polygon in parts])
        colors = artist.to_rgba(artist.get_array()) if artist.get_array() is not None else artist._facecolor3d
        self.colors = _one_each(colors, count)[kept]
        edges = _one_each(artist._edgecolor3d, count)[kept] if np.size(artist._edgecolor3d) else self.colors
        widths = _one_each(np.atleast_1d(artist.get_linewidth()), count)[kept]
        # By default an edge has its face's colour and closes the gap to its neighbour, which areas do anyway.
        self.has_edges = bool(((edges[:, 3] > 0) & (widths > 0) & (np.abs(edges - self.colors).max(axis=1) > 1e-3)).any())
        self.is_seen = self.colors[:, 3] > 0
        self.is_clear = bool((self.colors[self.is_seen, 3] < 1).any())
        # One opaque colour: through a translucent one its own far side and its seams would show.
        share = self.colors[:, 3:]
        self.colors = np.column_stack([self.colors[:, :3] * share + ground * (1 - share), self.is_seen.astype(float)])
        self.curves = [np.concatenate([polygon, polygon[:1]]) for polygon in self.polygons] if self.has_edges else []
        self.styles = [(edge, width, "solid") for edge, width in zip(edges, widths)] if self.has_edges else []

    def mesh_and_colors(self):
        """The polygons that are seen as a mesh, and a colour for each of its faces."""
        faces, colors = [], []
        for polygon, color in zip(self.polygons, self.colors):
            if color[3] > 0:
                parts = _bent_apart(polygon)
                faces += parts
                colors += [color] * len(parts)
        sizes = np.array([len(face) for face in faces], dtype=np.int64)
        corners = np.arange(sizes.sum(), dtype=np.int64)
        with warnings.catch_warnings():
            # Corners on a straight side make triangles without area, and nothing is lost with them.
            warnings.filterwarnings("ignore", r"surface: \d+ degenerate triangle")
            # Neighbours compute the same corner each in its own way.
            mesh = _native.Mesh.of_arrays(np.concatenate(faces), corners, sizes, "surface", {"weld": 1e-9})
        return mesh, np.array(colors)


def _bent_apart(polygon):
    """A polygon, or triangles around its middle if it has more than four corners and is not flat, as `plot_surface` makes them of several
    squares."""
    middle = polygon.mean(axis=0)
    if len(polygon) < 5 or np.linalg.svd(polygon - middle, compute_uv=False)[2] <= 1e-9 * np.abs(polygon - middle).max():
        return [polygon]
    return [np.array([middle, one, other]) for one, other in zip(polygon, np.roll(polygon, -1, axis=0))]


def _simple(polygon):
    """A polygon cut into ones that neither cross nor touch themselves, as `fill_between` may; those that are not flat stay whole."""
    if len(polygon) < 5:
        return [polygon]
    middle = polygon.mean(axis=0)
    _, spread, axes = np.linalg.svd(polygon - middle, full_matrices=False)
    if spread[2] > 1e-9 * spread[0]:
        return [polygon]
    polygon, flat = _crossed(polygon, (polygon - middle) @ axes[:2].T)
    numbers = np.unique(np.round(flat / (1e-9 * spread[0])), axis=0, return_inverse=True)[1].ravel()
    parts, path, place = [], [], {}
    for corner, number in enumerate(numbers):
        if number in place:
            # A loop has come back to its beginning.
            loop = path[place[number] :]
            parts.append(loop)
            del path[place[number] :]
            for left in loop:
                del place[numbers[left]]
        place[number] = len(path)
        path.append(corner)
    return [polygon[part] for part in [*parts, path] if len(part) > 2]


def _crossed(polygon, flat):
    """A flat polygon and its places in its plane, with a corner more on both sides wherever two sides cross."""
    start, along = flat, np.roll(flat, -1, axis=0) - flat
    turned = lambda one, other: one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]
    found = []
    # Some sides with all others: the memory stays small.
    for some in np.array_split(np.arange(len(flat)), len(flat) ** 2 // 2_000_000 + 1):
        between = start[None] - start[some, None]
        with np.errstate(divide="ignore", invalid="ignore"):
            across = turned(along[some, None], along[None])
            at, at_other = turned(between, along[None]) / across, turned(between, along[some, None]) / across
        is_met = (at > 0) & (at < 1) & (at_other > 0) & (at_other < 1) & (np.arange(len(flat)) > some[:, None] + 1)
        row, second = np.nonzero(is_met)
        found.append((some[row], second, at[is_met], at_other[is_met]))
    first, second, at, at_other = map(np.concatenate, zip(*found))
    sides = np.concatenate([first, second])
    if not len(sides):
        return polygon, flat
    order = np.lexsort([np.concatenate([at, at_other]), sides])
    # Both sides have the same corner, to the last bit.
    one, other, shares = np.tile(first, 2)[order], np.tile(second, 2)[order], np.tile(at, 2)[order, None]

    def put(points):
        ends = np.roll(points, -1, axis=0)
        met = points[one] + (ends[one] - points[one]) * shares
        # It stays on a side along an axis, such as a base line: beside it, triangles would have no area.
        met = np.where(points[other] == ends[other], points[other], met)
        return np.insert(points, sides[order] + 1, met, axis=0)

    return put(polygon), put(flat)


def _polygons(artist):
    """The polygons of finite corners as arrays (K, 3), and which of the artist's they are."""
    if hasattr(artist, "_faces"):
        faces, missing = artist._faces, getattr(artist, "_invalid_vertices", False)
        missing = np.broadcast_to(missing, faces.shape[:2])
        polygons = [np.asarray(face, dtype=np.float64)[~gap] for face, gap in zip(faces, missing)]
    else:
        polygons = [np.asarray(artist._vec[:3, part].T, dtype=np.float64) for part in artist._segslices]
    # At a pole two corners of a square are one.
    nothing = 1e-12 * max((np.abs(polygon).max(initial=0.0, where=np.isfinite(polygon)) for polygon in polygons), default=0.0)
    polygons = [polygon[~(np.abs(polygon - np.roll(polygon, 1, axis=0)).max(axis=1) <= nothing)] for polygon in polygons]
    kept = np.array([len(polygon) > 2 and np.isfinite(polygon).all() for polygon in polygons], dtype=bool)
    return [polygon for polygon, is_kept in zip(polygons, kept) if is_kept], kept


def _one_each(values, count):
    """Values of a collection, which repeat."""
    values = np.asarray(values)
    return values[np.arange(count) % len(values)]


def _places(parts):
    """Coordinates as rows (N, 3), masked ones as NaN."""
    return np.column_stack([np.ma.filled(np.ma.asarray(part, dtype=np.float64), np.nan) for part in parts])


def _runs(curve):
    """A curve's parts between positions that are missing."""
    curve = np.ma.filled(np.ma.asarray(curve, dtype=np.float64), np.nan)
    is_there = np.isfinite(curve).all(axis=1)
    cuts = np.flatnonzero(~is_there)
    parts = np.split(curve, cuts)
    parts = [part[np.isfinite(part).all(axis=1)] for part in parts]
    return [part for part in parts if len(part) > 1]


class Curves:
    """A `Line3D`, a `Line3DCollection` (a wireframe, a quiver), or contour lines: curves with colours and widths."""

    def __init__(self, artist):
        if isinstance(artist, Line3D):
            self.curves = [] if artist.get_linestyle() in ("None", "", " ") else _runs(_places(artist.get_data_3d()))
            color = to_rgba_array(artist.get_color(), artist.get_alpha())[0]
            self.styles = [(color, artist.get_linewidth(), artist.get_linestyle())] * len(self.curves)
            return
        if isinstance(artist, Line3DCollection):
            several = [[segment] for segment in artist._segments3d]
        else:
            several = [np.split(corners, np.flatnonzero(codes == Path.MOVETO)[1:]) for corners, codes in artist._3dverts_codes]
        colors = artist.to_rgba(artist.get_array()) if artist.get_array() is not None else artist.get_edgecolor()
        colors, widths = _one_each(to_rgba_array(colors), len(several)), _one_each(artist.get_linewidth(), len(several))
        dashes = artist.get_linestyle()
        self.curves, self.styles = [], []
        for number, segments in enumerate(several):
            parts = [part for segment in segments for part in _runs(segment)]
            self.curves += parts
            self.styles += [(colors[number], widths[number], dashes[number % len(dashes)])] * len(parts)


class Dots:
    """A `Path3DCollection` (a scatter), or the markers of a `Line3D`: points with markers."""

    def __init__(self, artist):
        if isinstance(artist, Line3D):
            points = _places(artist.get_data_3d())
            marker = MarkerStyle(artist.get_marker())
            self.paths = [marker.get_path().transformed(marker.get_transform())]
            sizes, faces = np.array([artist.get_markersize() ** 2]), to_rgba_array(artist.get_markerfacecolor(), artist.get_alpha())
            edges, widths = to_rgba_array(artist.get_markeredgecolor(), artist.get_alpha()), [artist.get_markeredgewidth()]
        else:
            points = _places(artist._offsets3d)
            self.paths = artist.get_paths()
            sizes, widths = artist._sizes3d, np.atleast_1d(artist._linewidths3d)
            shown = artist.to_rgba(artist.get_array()) if artist.get_array() is not None else None
            faces = artist._facecolors if shown is None else shown
            edges = faces if artist._edgecolors is None or isinstance(artist._edgecolors, str) or shown is not None else artist._edgecolors
        kept = np.isfinite(points).all(axis=1)
        self.points = points[kept]
        each = lambda values: _one_each(values, len(points))[kept] if len(np.asarray(values)) else None
        self.sizes, self.faces, self.edges, self.widths = map(each, (sizes, faces, edges, widths))

    def seen(self, chosen):
        """The settings of a `PathCollection` of those chosen."""
        of = lambda values: "none" if values is None else values[chosen]
        return {"sizes": self.sizes[chosen], "facecolors": of(self.faces), "edgecolors": of(self.edges), "linewidths": self.widths[chosen]}


def held(axes):
    """What axes hold that this module draws: surfaces, curves, dots, and their artists."""
    try:
        return _held(axes)
    except AttributeError as problem:
        raise RuntimeError(
            f"draw3d reads 3-D axes of matplotlib 3.8 to 3.11, and {matplotlib.__version__} keeps them otherwise ({problem}); draw works with all"
        ) from problem


def _ground(axes):
    """The colour of the axes' background over that of the figure and of white paper."""
    color = np.ones(3)
    for layer in (axes.figure.get_facecolor(), axes.get_facecolor()):
        *shade, share = to_rgba(layer)
        color = color * (1 - share) + np.array(shade) * share
    return color


def _held(axes):
    surfaces, curves, dots, artists = [], [], [], []
    ground = _ground(axes)
    for artist in list(axes.get_children()):
        if not artist.get_visible() or getattr(artist, "is_exact", False):
            continue
        if isinstance(artist, Poly3DCollection):
            surfaces.append(Surface(artist, ground))
        elif isinstance(artist, Line3DCollection) or (isinstance(artist, Collection3D) and not getattr(artist, "filled", True)):
            curves.append(Curves(artist))
        elif isinstance(artist, Line3D):
            curves.append(Curves(artist))
            if artist.get_marker() not in (None, "None", "", " "):
                dots.append(Dots(artist))
        elif isinstance(artist, Path3DCollection):
            dots.append(Dots(artist))
        else:
            continue
        artists.append(artist)
    curves = [one for one in curves + surfaces if one.curves]
    # A surface without colour hides nothing; its edges are curves.
    surfaces = [surface for surface in surfaces if surface.is_seen.any()]
    return surfaces, curves, [dot for dot in dots if len(dot.points)], artists


class _Placed:
    """A collection in pixels whose place in the order of 3-D axes is given: larger is farther."""

    is_exact = True

    def do_3d_projection(self):
        return self._depth


class Strokes(_Placed, LineCollection):
    """The visible pieces of curves and of surfaces' lines."""

    _depth = -1.0


class Marks(_Placed, PathCollection):
    """The markers of points that are seen."""

    _depth = -2.0


#: How dark hidden pieces are drawn.
_GHOST = 0.3


def strokes_of(lines, styles, ends, outline, hidden):
    """The pieces of a drawing as paths, colours, widths and dashes, hidden ones first: those of curves have their artist's style,
    all others `outline`."""
    curve_of = np.where(lines.cls == "curve", np.searchsorted(ends, lines.edge[:, 0], side="right"), -1)
    curve_of[lines.cls == "point"] = -2
    paths, colors, widths, dashes = [], [], [], []
    for is_visible in (False, True) if hidden else (True,):
        chosen = np.flatnonzero((lines.visible == is_visible) & (curve_of > -2) & ~(lines.covered & ~is_visible))
        for path, number in _chains(lines.segments[chosen], curve_of[chosen]):
            color, width, dash = styles[number] if number >= 0 else outline
            faint = 1.0 if is_visible else _GHOST
            paths.append(path)
            colors.append((*color[:3], color[3] * faint))
            widths.append(width)
            dashes.append((0, (3, 2)) if hidden == "dashed" and not is_visible else dash)
    return paths, colors, widths, dashes


def _chains(segments, curve_of):
    """Pieces that follow one another on a curve as one path, so that dashes and joints run on; and the curve's number."""
    breaks = np.ones(len(segments), dtype=bool)
    breaks[1:] = (curve_of[1:] != curve_of[:-1]) | (curve_of[1:] < 0) | (np.abs(segments[1:, 0] - segments[:-1, 1]).max(axis=1) > 1e-6)
    starts = np.flatnonzero(breaks)
    for start, end in zip(starts, [*starts[1:], len(segments)]):
        yield np.concatenate([segments[start : start + 1, 0], segments[start:end, 1]]), int(curve_of[start])
