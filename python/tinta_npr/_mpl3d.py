"""What matplotlib's 3-D axes hold, drawn again as vectors with exact hiding between all of it.

This reads attributes that matplotlib keeps for itself, of its versions 3.8 to 3.11; `mpl` imports it for `draw3d` alone.
"""


import matplotlib
import numpy as np
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.colors import to_rgba, to_rgba_array
from matplotlib.markers import MarkerStyle
from matplotlib.path import Path
from mpl_toolkits.mplot3d import art3d
from mpl_toolkits.mplot3d.art3d import Line3D, Line3DCollection, Path3DCollection, Poly3DCollection

from . import _native
from ._camera import scaled_axes

#: What its contours are of; older versions have no name for it.
Collection3D = getattr(art3d, "Collection3D", ())


class Surface:
    """A `Poly3DCollection`, or filled contours: polygons, each with the colour of its face."""

    def __init__(self, artist, ground, scaled):
        """`ground` is the colour behind a translucent surface."""
        if isinstance(artist, Poly3DCollection):
            self.polygons, kept = _polygons(artist, scaled)
            self._faces = np.arange(len(kept))
            mapped = _mapped(artist)
            colors = artist._facecolor3d if mapped is None else mapped
            edges = artist._edgecolor3d
        else:
            self.polygons, kept = _levels(artist, scaled)
            self._faces, colors, edges = kept, artist.get_facecolor(), []
        self.colors = _one_each(colors, kept)
        edges = _one_each(edges, kept) if np.size(edges) else self.colors
        widths = _one_each(np.atleast_1d(artist.get_linewidth()), kept)
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
        faces, numbers = [], []
        colors = np.zeros((self._faces.max() + 1, 4))
        colors[self._faces] = self.colors
        for polygon, number in zip(self.polygons, self._faces):
            if colors[number, 3] > 0:
                parts = _bent_apart(polygon)
                faces += parts
                numbers += [number] * len(parts)
        sizes = np.array([len(face) for face in faces], dtype=np.int64)
        corners = np.arange(sizes.sum(), dtype=np.int64)
        # Neighbours compute the same corner each in its own way.
        mesh = _native.Mesh.of_arrays(np.concatenate(faces), corners, sizes, "surface", {"weld": 1e-9})
        return mesh.with_marks(np.array(numbers, dtype=np.uint32), np.empty((0, 2), dtype=np.uint32)), colors


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


def _polygons(artist, scaled):
    """The polygons of finite corners as arrays (K, 3), and the numbers of the artist's that they are of."""
    if hasattr(artist, "_faces"):
        faces, missing = artist._faces, getattr(artist, "_invalid_vertices", False)
        missing = np.broadcast_to(missing, faces.shape[:2])
        polygons = [scaled(np.asarray(face, dtype=np.float64)[~gap]) for face, gap in zip(faces, missing)]
    else:
        polygons = [scaled(np.asarray(artist._vec[:3, part].T, dtype=np.float64)) for part in artist._segslices]
    # At a pole two corners of a square are one.
    nothing = 1e-12 * max((np.abs(polygon).max(initial=0.0, where=np.isfinite(polygon)) for polygon in polygons), default=0.0)
    polygons = [polygon[~(np.abs(polygon - np.roll(polygon, 1, axis=0)).max(axis=1) <= nothing)] for polygon in polygons]
    is_kept = [len(polygon) > 2 and np.isfinite(polygon).all() for polygon in polygons]
    return _numbered([_simple(polygon) if kept else [] for polygon, kept in zip(polygons, is_kept)])


def _numbered(lists):
    """The members of lists one after the other, and the numbers of the lists they are of."""
    return [member for members in lists for member in members], np.repeat(np.arange(len(lists)), [len(members) for members in lists])


def _levels(artist, scaled):
    """The triangles of filled contours and the numbers of the levels that they are of."""
    levels = []
    for corners, codes in artist._3dverts_codes:
        rings = [scaled(ring[:-1]) for ring in np.split(corners, np.flatnonzero(codes == Path.MOVETO)[1:])]
        rings = [ring for ring in rings if len(ring) > 2 and np.isfinite(ring).all()]
        levels.append(_cut(rings) if rings else [])
    return _numbered(levels)


class Crossing(ValueError):
    """Rings that cross, as contours do of a surface that lies above itself along their axis."""


def _cut(rings):
    """Triangles between rings in a plane across an axis: between outlines and holes, which run the other way than the largest ring."""
    across = np.argmin(np.ptp(np.concatenate(rings), axis=0))
    flat = [np.delete(ring, across, axis=1) for ring in rings]
    areas = np.array([np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) for x, y in (ring.T for ring in flat)])
    is_hole = areas * areas[np.argmax(np.abs(areas))] < 0
    outlines = sorted(np.flatnonzero(~is_hole), key=lambda ring: abs(areas[ring]))
    members = {outline: [outline] for outline in outlines}
    for hole in np.flatnonzero(is_hole):
        # It is in the smallest outline around it, whose corners it may share.
        around = [outline for outline in outlines if Path(flat[outline]).contains_points(flat[hole]).mean() > 0.5]
        if around:
            members[around[0]].append(hole)
    triangles = []
    for own in members.values():
        starts = np.cumsum([len(flat[ring]) for ring in own])[:-1]
        numbers = _native.triangles_of_rings(np.concatenate([flat[ring] for ring in own]), starts.tolist())
        triangles += list(np.concatenate([rings[ring] for ring in own])[numbers])
    a, b, c = np.reshape(triangles, (-1, 3, 3)).swapaxes(0, 1)
    # Twice their areas, as those of the rings.
    if abs(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() - abs(areas.sum())) > 1e-6 * np.abs(areas).sum():
        raise Crossing
    return triangles


def _mapped(artist):
    """The colours of an artist's values, as translucent as it is; `None` without values."""
    values = artist.get_array()
    return None if values is None else artist.to_rgba(values, artist.get_alpha())


def _one_each(values, numbers):
    """Values of a collection by number, which repeat."""
    values = np.asarray(values)
    return values[numbers % len(values)]


def _places(parts):
    """Coordinates as rows (N, 3), masked ones as NaN."""
    return np.column_stack([np.ma.filled(np.ma.asarray(part, dtype=np.float64), np.nan) for part in parts])


def _runs(curve, scaled):
    """A curve's parts between positions that are missing."""
    curve = scaled(np.ma.filled(np.ma.asarray(curve, dtype=np.float64), np.nan))
    is_there = np.isfinite(curve).all(axis=1)
    cuts = np.flatnonzero(~is_there)
    parts = np.split(curve, cuts)
    parts = [part[np.isfinite(part).all(axis=1)] for part in parts]
    return [part for part in parts if len(part) > 1]


class Curves:
    """A `Line3D`, a `Line3DCollection` (a wireframe, a quiver), or contour lines: curves with colours and widths."""

    def __init__(self, artist, scaled):
        if isinstance(artist, Line3D):
            self.curves = [] if artist.get_linestyle() in ("None", "", " ") else _runs(_places(artist.get_data_3d()), scaled)
            color = to_rgba_array(artist.get_color(), artist.get_alpha())[0]
            self.styles = [(color, artist.get_linewidth(), artist.get_linestyle())] * len(self.curves)
            return
        if isinstance(artist, Line3DCollection):
            several = [[segment] for segment in artist._segments3d]
        else:
            several = [np.split(corners, np.flatnonzero(codes == Path.MOVETO)[1:]) for corners, codes in artist._3dverts_codes]
        mapped = _mapped(artist)
        colors = artist.get_edgecolor() if mapped is None else mapped
        numbers = np.arange(len(several))
        colors, widths = _one_each(to_rgba_array(colors), numbers), _one_each(artist.get_linewidth(), numbers)
        dashes = artist.get_linestyle()
        self.curves, self.styles = [], []
        for number, segments in enumerate(several):
            parts = [part for segment in segments for part in _runs(segment, scaled)]
            self.curves += parts
            self.styles += [(colors[number], widths[number], dashes[number % len(dashes)])] * len(parts)


class Dots:
    """A `Path3DCollection` (a scatter), or the markers of a `Line3D`: points with markers."""

    def __init__(self, artist, scaled):
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
            shown = _mapped(artist)
            faces = artist._facecolors if shown is None else shown
            edges = faces if artist._edgecolors is None or isinstance(artist._edgecolors, str) or shown is not None else artist._edgecolors
        points = scaled(points)
        kept = np.flatnonzero(np.isfinite(points).all(axis=1))
        self.points = points[kept]
        each = lambda values: _one_each(values, kept) if len(np.asarray(values)) else None
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


def _scales(axes):
    """The function from positions to those that the axes' matrix projects: places that a scale has not, as 0 on a logarithmic one, become
    NaN."""
    scales = [("xyz".index(name), getattr(axes, f"{name}axis")) for name in scaled_axes(axes)]

    def scaled(positions):
        positions = np.array(positions, dtype=np.float64)
        for place, axis in scales:
            values = positions[:, place]
            positions[:, place] = np.where(axis._scale.val_in_range(values), axis.get_transform().transform(values), np.nan)
        return positions

    return scaled


def _held(axes):
    surfaces, curves, dots, artists, others = [], [], [], [], set()
    ground, scaled = _ground(axes), _scales(axes)
    for artist in [*axes.collections, *axes.lines, *axes.patches, *axes.images, *axes.artists]:
        if not artist.get_visible() or getattr(artist, "is_exact", False):
            continue
        if isinstance(artist, Poly3DCollection):
            surfaces.append(Surface(artist, ground, scaled))
        elif isinstance(artist, Collection3D) and getattr(artist, "filled", False):
            try:
                surfaces.append(Surface(artist, ground, scaled))
            except Crossing:
                others.add(type(artist).__name__)
                continue
        elif isinstance(artist, Line3DCollection) or (isinstance(artist, Collection3D) and hasattr(artist, "filled")):
            curves.append(Curves(artist, scaled))
        elif isinstance(artist, Line3D):
            curves.append(Curves(artist, scaled))
            if artist.get_marker() not in (None, "None", "", " "):
                dots.append(Dots(artist, scaled))
        elif isinstance(artist, Path3DCollection):
            dots.append(Dots(artist, scaled))
        else:
            others.add(type(artist).__name__)
            continue
        artists.append(artist)
    if others:
        _native.warn(f"{', '.join(sorted(others))}: draw3d leaves this to matplotlib; it hides nothing, and nothing hides it")
    curves = [one for one in curves + surfaces if one.curves]
    # A surface without colour hides nothing; its edges are curves.
    surfaces = [surface for surface in surfaces if surface.is_seen.any()]
    return surfaces, curves, [dot for dot in dots if len(dot.points)], artists


class _Placed:
    """A collection whose place in the order of 3-D axes is given: larger is farther."""

    is_exact = True

    def do_3d_projection(self):
        return self._depth


class Strokes(_Placed, LineCollection):
    """The visible pieces of curves and of surfaces' lines."""

    _depth = -2e9


class Marks(_Placed, PathCollection):
    """The markers of points that are seen."""

    _depth = -3e9


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
