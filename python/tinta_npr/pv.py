"""The exact lines and areas of a PyVista plotter's scene."""

import numpy as np

from . import _native, _with_settings
from . import lines as _lines
from ._arrays import padded, rows
from ._camera import size_of
from ._mesh import _surface, meshes_of
from ._results import _place, _written

__all__ = ["export_svg", "lines"]

#: The height of letters in pixels, and in millimetres where the drawing has a width on paper.
_LETTER, _LETTER_MM = 12, 3.53


def lines(plotter, *, look=None, preset=None, **settings):
    """Find the lines of all surfaces that a plotter shows, as its camera sees them.

    Warns of what it leaves out: points, curves, transparency.

    Parameters
    ----------
    plotter : pyvista.Plotter
        Its visible actors, at their current places; of subplots the active one.
    look, preset, **settings
        As in `tinta_npr.lines`. The size is the plotter's, or its subplot's, unless `size` is given; the background is white, not
        the plotter's.

    Returns
    -------
    tinta_npr.Lines
        ``object`` numbers the actors in their order.

    Settings
    --------
    """
    [shown] = _shown([plotter.renderer])
    see_through = len({id(actor) for actor, _ in shown if _opacity(actor) < 1})
    _warn_of(see_through, "is transparent, but hides lines like an opaque one", "are transparent, but hide lines like opaque ones")
    left, top, right, bottom = _box(plotter.renderer, plotter.window_size)
    if settings.get("size") is None:
        settings["size"] = right - left, bottom - top
    return _found(plotter.renderer, shown, {"look": look, "preset": preset, **settings})


def export_svg(plotter, file, *, fill=False, format=None, title=None, look=None, preset=None, **settings):
    """Write the exact lines of a plotter's scene: .svg, .pdf, .png or .json.

    Parameters
    ----------
    plotter, look, preset, **settings
        As in `lines`: ``hidden="dashed"``, ``look="technical"``, ``crease_angle=40`` … Subplots are written at their places; into
        .json the active one.
    fill : bool
        Whether to fill the surfaces below the lines: each face in one colour, the actor's or that of its scalar by the actor's
        lookup table, without light. A face with scalars at its points has the colour of their mean. What is opaque shows through
        a transparent actor, whose nearest surface alone is drawn. Scalar bars lie above the lines. Into .svg, .pdf or .json.
    file, format, title
        As in `tinta_npr.Lines.save`.

    Settings
    --------
    """
    path, ending = _place(file, format)
    settings = {"look": look, "preset": preset, **settings}
    renderers = list(plotter.renderers)
    if len(renderers) == 1 and not fill or ending not in (("svg", "pdf") if fill else ("svg", "pdf", "png")):
        found = lines(plotter, **settings)
        (found.regions() if fill else found).save(file, format=format, title=title)
        return
    if settings.get("areas") is not None and len(renderers) > 1:
        raise ValueError("areas: subplots have the colours of their actors by fill=True; leave areas out")
    whole = plotter.window_size if settings.get("size") is None else size_of(settings)
    letter = _LETTER_MM * whole[0] / float(settings["width_mm"]) if settings.get("width_mm") else _LETTER
    views, keys, count = [], [], 0
    for renderer, shown in zip(renderers, _shown(renderers)):
        box = _box(renderer, whole)
        views += _views(renderer, shown, box, settings, fill, count) if shown else []
        keys += [_key(bar, box, letter) for bar in _bars(plotter, renderer)] if fill else []
        count += len(shown)
    _written(file, path, _native.sheet(ending, tuple(whole), views, keys, title))


def _shown(renderers):
    """The actors with a surface of each renderer, and the surface: an actor of several blocks has several."""
    shown, others = [], 0
    for renderer in renderers:
        actors = [actor for actor in renderer.actors.values() if _is_of_data(actor)]
        surfaces = [_surfaces_of_actor(actor) for actor in actors]
        shown.append([(actor, surface) for actor, of_actor in zip(actors, surfaces) for surface in of_actor])
        others += sum(not of_actor for of_actor in surfaces)
    if not any(shown):
        raise ValueError("plotter: it shows no surface; add_mesh() first")
    _warn_of(others, "shows points or curves, which are left out", "show points or curves, which are left out")
    return shown


def _box(renderer, whole):
    """Left, top, right and bottom of a subplot in a picture of this size, pixels."""
    left, bottom, right, top = renderer.GetViewport()
    width, height = whole
    left, top = round(width * left), round(height * (1 - top))
    return left, top, max(left + 1, round(width * right)), max(top + 1, round(height * (1 - bottom)))


def _found(renderer, shown, settings):
    """The lines of surfaces together."""
    # PyVista sets its camera when it first shows the scene.
    if not renderer.camera.is_set:
        renderer.camera_position = renderer.get_default_cam_pos()
        renderer.reset_camera()
        renderer.camera.is_set = True
    return _lines([_mesh_of(actor, surface) for actor, surface in shown], camera=renderer.camera, **settings)


def _views(renderer, shown, box, settings, fill, first):
    """A subplot's views on a sheet: what is opaque, and above it what is transparent, for each opacity. `first` is the number of its
    first object on the sheet."""
    left, top, right, bottom = box
    settings = {**settings, "size": (right - left, bottom - top)}
    opacity = np.array([_opacity(actor) if fill else 1.0 for actor, _ in shown])
    see_through = len({id(actor) for (actor, _), share in zip(shown, opacity) if share < 1})
    _warn_of(see_through, "is transparent: its nearest surface alone is drawn", "are transparent: their nearest surface alone is drawn")

    def view(kept, among):
        drawn = [one for one, is_among in zip(shown, among) if is_among]
        found = _found(renderer, drawn, settings)
        areas = None
        if fill:
            regions = found.regions()
            colors = regions.of_faces([_colors(actor, surface) for actor, surface in drawn])
            areas = regions._found, regions._colors(colors), float(opacity[kept][0])
        numbers = np.where(kept, np.arange(len(shown)) + first, -1)
        return {"lines": found._found, "areas": areas, "at": (left, top), "objects": numbers[among].tolist()}

    opaque, everything = opacity == 1, np.full(len(shown), True)
    views = [view(opaque, opaque)] if opaque.any() else []
    return views + [view(opacity == share, everything) for share in np.unique(opacity[~opaque])[::-1]]


def _warn_of(count, one, several):
    if count:
        _native.warn(f"plotter: an actor {one}" if count == 1 else f"plotter: {count} actors {several}")


def _is_of_data(actor):
    """Whether an actor is visible and shows a data set in the scene, unlike texts, axes and scalar bars."""
    data = getattr(getattr(actor, "mapper", None), "dataset", None)
    is_seen = data is not None and actor.GetVisibility() and _opacity(actor) > 0
    return bool(is_seen and (hasattr(data, "points") or hasattr(data, "n_blocks")))


def _opacity(actor):
    prop = getattr(actor, "prop", None)
    return getattr(prop, "opacity", 1.0)


def _surfaces_of_actor(actor):
    """The surfaces of an actor as polygons; none of points and curves."""
    data = actor.mapper.dataset
    blocks = [data] if not hasattr(data, "n_blocks") else [block for block in data.recursive_iterator() if block is not None]
    surfaces = [block if hasattr(block, "faces") else _surface(block) for block in blocks]
    surfaces = [surface.triangulate() if getattr(surface, "n_strips", 0) else surface for surface in surfaces]
    return [surface for surface in surfaces if len(surface.faces)]


def _mesh_of(actor, surface):
    """A surface in the world's coordinates."""
    matrix = actor.GetMatrix()
    world_from_actor = np.array([[matrix.GetElement(row, column) for column in range(4)] for row in range(4)])
    [mesh] = meshes_of(surface, None, None, {})
    if (world_from_actor == np.eye(4)).all():
        return mesh
    corners, sizes = padded(surface.faces)
    points = rows("points", surface.points, 3) @ world_from_actor[:3, :3].T + world_from_actor[:3, 3]
    return _native.Mesh.of_arrays(np.ascontiguousarray(points), corners, sizes, "mesh", {})


def _colors(actor, surface):
    """A colour for each face of a surface, as its actor's mapper gives it: (M, 3), from 0 to 1."""
    mapper = actor.mapper
    values = _scalars(mapper, surface) if getattr(mapper, "scalar_visibility", False) else None
    corners, sizes = padded(surface.faces)
    count = len(corners) // 3 if sizes is None else len(sizes)
    if values is None:
        return np.tile(actor.prop.color.float_rgb, (count, 1))
    if len(values) == surface.n_points:
        sizes = np.full(count, 3) if sizes is None else sizes
        starts = np.cumsum(sizes) - sizes
        values = (np.add.reduceat(np.asarray(values, dtype=float)[corners], starts, axis=0).T / sizes).T
    if values.ndim == 2 and mapper.color_mode == "direct":
        return _opaque(np.clip(values, 0, 1))
    if values.ndim == 2:
        values = np.linalg.norm(values, axis=1)
    table = mapper.lookup_table
    if not mapper.GetUseLookupTableScalarRange() and hasattr(table, "SetTableRange"):
        # As a mapper does before it draws.
        table.SetTableRange(*mapper.scalar_range)
    return _opaque(_mapped(table, values))


def _opaque(colors):
    """Colours without their opacity."""
    if colors.shape[1] > 3 and (colors[:, 3] < 1).any():
        _native.warn("plotter: opacities of single scalars are left out; give the actor one opacity")
    return colors[:, :3]


def _mapped(table, values):
    """The colours that a lookup table gives to values, from 0 to 1."""
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

    mapped = table.MapScalars(numpy_to_vtk(np.ascontiguousarray(values, dtype=float)), 1, -1)
    return vtk_to_numpy(mapped) / 255.0


def _scalars(mapper, surface):
    """The scalars that a mapper shows, of cells or of points; colours from 0 to 1. `None` if the surface has none."""
    of_points, of_cells = surface.point_data, surface.cell_data
    name = mapper.array_name or surface.active_scalars_name
    places = [of_cells, of_points] if "cell" in mapper.scalar_map_mode else [of_points, of_cells]
    place = next((place for place in places if name in place), None)
    if place is None:
        return None
    values = np.asarray(place[name])
    if values.dtype == np.uint8 and mapper.color_mode == "direct":
        values = values / 255.0
    # Cells are numbered with points and lines before faces.
    return values[surface.n_verts + surface.n_lines :] if place is of_cells else values


def _bars(plotter, renderer):
    """The visible scalar bars of a renderer."""
    return [bar for _, bar in plotter.scalar_bars.items() if bar.GetVisibility() and renderer.HasViewProp(bar)]


def _key(bar, box, letter):
    """A scalar bar in a subplot's box as rectangles and texts: steps of colour in a frame, a tick beside each number, the title. `letter` is
    the height of letters in pixels."""
    left, top, right, bottom = box
    x, y = bar.GetPosition()
    left, bottom = left + x * (right - left), bottom - y * (bottom - top)
    width, height = bar.GetWidth() * (right - box[0]), bar.GetHeight() * (box[3] - top)
    is_upright = bar.GetOrientation() == 1
    table = bar.GetLookupTable()
    ends = np.array(table.GetRange(), dtype=float)
    is_logarithmic = hasattr(table, "GetScale") and table.GetScale() == 1
    scale, value = (np.log10, lambda share: 10.0**share) if is_logarithmic else (np.asarray, np.asarray)
    low, high = scale(ends)
    count = min(table.GetNumberOfAvailableColors() or 256, 256)
    colors = _mapped(table, value(low + (high - low) * (np.arange(count) + 0.5) / count))[:, :3]
    annotated = [(table.GetAnnotatedValue(number).ToDouble(), table.GetAnnotation(number)) for number in range(table.GetNumberOfAnnotatedValues())]
    # One value alone has the whole bar, and its number in the middle.
    many = bar.GetNumberOfLabels()
    numbers = value(np.linspace(low, high, many) if many > 1 and low < high else np.full(min(many, 1), low))
    labels = annotated or [(number, _number(bar.GetLabelFormat(), number)) for number in numbers]
    longest = 0.6 * letter * max((len(label) for _, label in labels), default=0)
    if is_upright:
        thickness = max(letter, 0.375 * width)
        # Numbers that would be cut off at the picture's end move it.
        left, bottom = min(left, box[2] - thickness - 8 - longest), min(bottom, box[3] - 0.6 * letter)
        room = height - 2 * letter if bar.GetTitle() else height
        title = (bar.GetTitle(), [left, bottom - room, 0.0, -0.8])
        place = lambda share: (left + thickness, bottom - share * room)
        box_of = lambda start, end: [left, bottom - end * room, left + thickness, bottom - start * room]
        tick = lambda x, y: ([x, y - 0.5, x + 4, y + 0.5], [x + 7, y, 0.0, 0.35])
    else:
        thickness = max(letter, 0.375 * height)
        left = min(left, box[2] - width - longest / 2)
        under = min(bottom - (height - thickness) / 2, box[3] - 4 - 1.4 * letter)
        title = (bar.GetTitle(), [left + width / 2, under - thickness, 0.5, -0.5])
        place = lambda share: (left + share * width, under)
        box_of = lambda start, end: [left + start * width, under - thickness, left + end * width, under]
        tick = lambda x, y: ([x - 0.5, y, x + 0.5, y + 4], [x, y + 4, 0.5, 1.1])
    frame = np.array(box_of(0, 1)) + (-1, -1, 1, 1)
    boxes = [[*frame, 0, 0, 0]]
    # Each step reaches to the end, so that no gap is between two.
    boxes += [[*box_of(step / count, 1), *color] for step, color in enumerate(colors)]
    texts = [title] if title[0] else []
    for number, label in labels:
        share = float((scale(number) - low) / (high - low)) if high > low else 0.5
        line, at = tick(*place(share))
        boxes.append([*line, 0, 0, 0])
        texts.append((label, at))
    return boxes, texts


def _number(format, number):
    """A number in the format of a scalar bar: printf's, or that of newer versions of VTK."""
    return (format.format(number) if "{" in format else format % number).strip()


for _function in (lines, export_svg):
    _with_settings(_function, "lines")
