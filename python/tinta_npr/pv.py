"""The exact lines and areas of a PyVista plotter's scene."""

import dataclasses

import numpy as np

from . import _native, _pixels, _with_settings
from . import lines as _lines
from ._arrays import counted, padded, rows, same_places, sides
from ._camera import size_of
from ._free import Free
from ._mesh import _surface, meshes_of
from ._results import _place, _written

__all__ = ["export_svg", "lines"]

#: The height of letters in pixels, and in millimetres where the drawing has a width on paper.
_LETTER, _LETTER_MM = 12, 3.53

#: The width of a digit of DejaVu Sans, in heights of letters.
_DIGIT = 0.64

#: The height of a text's letters, in those of labels, and its colour: as labels have them.
_PLAIN_FONT = [1.0, 0.0, 0.0, 0.0]


def lines(plotter, *, look=None, preset=None, **settings):
    """Find the lines of all surfaces, curves and points that a plotter shows, as its camera sees them.

    Edges that an actor shows are of class ``"marked"``, wireframes of class ``"curve"``, which hide nothing; labels stand beside their
    points. Curves and points have their actors' colours and sizes, and the colours of their scalars, where these are not the theme's;
    ``class_colors``, ``class_widths`` and ``line_width`` replace them. Warns of transparency, and of what it leaves out: volumes, axes.

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
        ``object`` numbers the actors with surfaces in their order; curves and points follow them, a number for each colour and size.

    Settings
    --------
    """
    [shown] = _shown([plotter.renderer])
    see_through = len({id(actor) for actor, _ in shown.surfaces if _opacity(actor) < 1})
    _warn_of(see_through, "is transparent, but hides lines like an opaque one", "are transparent, but hide lines like opaque ones")
    left, top, right, bottom = _box(plotter.renderer, plotter.window_size)
    if settings.get("size") is None:
        settings["size"] = right - left, bottom - top
    return _found(plotter.renderer, shown.surfaces, shown.free.meshes(), {"look": look, "preset": preset, **settings})


def export_svg(plotter, file, *, fill=False, format=None, title=None, look=None, preset=None, **settings):
    """Write the exact lines of a plotter's scene: .svg, .pdf, .png or .json.

    Parameters
    ----------
    plotter, look, preset, **settings
        As in `lines`: ``hidden="dashed"``, ``look="technical"``, ``crease_angle=40`` … Subplots are written at their places; into
        .json the active one. An .svg or .pdf has the plotter's texts and legends, too; labels of points have letters of one size.
    fill : bool
        Whether to fill the surfaces below the lines: each face in one colour, the actor's or that of its scalar by the actor's
        lookup table, without light. A face with scalars at its points has the colour of their mean. What is opaque shows through
        a transparent actor, whose nearest surface alone is drawn. Scalar bars lie above the lines, except in a .png.
    file, format, title
        As in `tinta_npr.Lines.save`.

    Settings
    --------
    """
    path, ending = _place(file, format)
    settings = {"look": look, "preset": preset, **settings}
    renderers = list(plotter.renderers)
    has_texts = ending in ("svg", "pdf") and any(_texts(renderer) for renderer in renderers)
    if len(renderers) == 1 and not fill and not has_texts or ending not in ("svg", "pdf", "png"):
        found = lines(plotter, **settings)
        (found.regions() if fill else found).save(file, format=format, title=title)
        return
    if settings.get("areas") is not None and len(renderers) > 1:
        raise ValueError("areas: subplots have the colours of their actors by fill=True; leave areas out")
    background = None
    if fill and ending == "png":
        background = _background(settings)
        settings = {**settings, "background": "transparent"}
    whole = plotter.window_size if settings.get("size") is None else size_of(settings)
    letter = _LETTER_MM * whole[0] / float(settings["width_mm"]) if settings.get("width_mm") else _LETTER
    views, keys, count = [], [], 0
    for renderer, shown in zip(renderers, _shown(renderers)):
        box = _box(renderer, whole)
        free, rules = shown.free.meshes()
        is_see_through = fill and any(_opacity(actor) < 1 for actor, _ in shown.surfaces)
        if rules and (len(renderers) > 1 or is_see_through):
            _native.warn("plotter: beside subplots or transparent actors, curves and points lose their colours and sizes")
            rules = {}
        views += _views(renderer, shown.surfaces, (free, rules), box, settings, fill, count)
        own = _box(renderer, plotter.window_size)
        of_window = own[2] - own[0], own[3] - own[1]
        if ending != "png":
            keys += [_key(bar, box, letter) for bar in _bars(plotter, renderer)] if fill else []
            keys += [_key_of_text(actor, box, of_window, letter, plotter.theme) for actor in _texts(renderer)]
        count += len(shown.surfaces) + len(free)
    content = _native.sheet(ending, tuple(whole), views, keys, title)
    _written(file, path, content if background is None else _filled_picture(content, views, background))


@dataclasses.dataclass
class _Scene:
    """What a renderer shows: surfaces with their actors, of which one with several blocks has several; curves and points."""

    surfaces: list = dataclasses.field(default_factory=list)
    free: Free = dataclasses.field(default_factory=Free)


def _shown(renderers):
    """The scene of each renderer; warns of what is left out of them."""
    left_out = {}
    scenes = [_scene(renderer, left_out) for renderer in renderers]
    if not any(scene.surfaces or scene.free for scene in scenes):
        raise ValueError("plotter: it shows no surface, curve or point; add_mesh() first")
    for kind in left_out:
        _native.warn(f"plotter: {kind} are left out")
    return scenes


#: Classes of VTK that are left out, and those drawn elsewhere or without effect on the scene.
_LEFT_OUT = {"vtkVolume": "volumes", "vtkCubeAxesActor": "axes with numbers", "vtkAxesActor": "axes of directions", "vtkAxisActor2D": "rulers"}
_DRAWN_ELSEWHERE = ("vtkScalarBarActor", "vtkTextActor", "vtkCornerAnnotation", "vtkLegendBoxActor")


def _scene(renderer, left_out):
    """A renderer's scene; adds the kinds of what is left out to a dict, which keeps their order."""
    scene = _Scene()
    for actor in renderer.actors.values():
        if not actor.GetVisibility() or any(map(actor.IsA, _DRAWN_ELSEWHERE)):
            continue
        kind = next((kind for name, kind in _LEFT_OUT.items() if actor.IsA(name)), None)
        if kind is None and (labels := _labels(actor)) is not None:
            points, texts = labels
            scene.free.add_points(points, labels=texts)
        elif kind is None and _is_of_data(actor):
            _take(scene, actor, renderer.parent.theme)
        elif kind is not None or not hasattr(actor, "prop"):
            left_out[kind or f"items of {actor.GetClassName()}"] = True
    if getattr(renderer, "axes_enabled", False):
        left_out[_LEFT_OUT["vtkAxesActor"]] = True
    return scene


def _take(scene, actor, theme):
    """Adds an actor's blocks to a scene, in the actor's style."""
    prop = getattr(actor, "prop", None)
    style = prop.GetRepresentation() if prop is not None else 2
    for block in _blocks(actor):
        points = _placed(actor, block.points)
        colors_of = _colors_of_free(actor, block, theme)
        width, size = _own(prop, "line_width", theme), _own(prop, "point_size", theme)
        # A dot is twice as wide as the lines of its style.
        dot = None if size is None else size / 2
        if style == 0:
            scene.free.add_points(points, [(color, dot) for color in colors_of(np.arange(len(points))[:, None])])
            continue
        if len(block.faces) and style == 1:
            ends = sides(*padded(block.faces))
            for two, color in zip(ends, colors_of(ends)):
                scene.free.add_curve(points[two], (color, width))
        elif len(block.faces):
            scene.surfaces.append((actor, block))
        if len(block.lines):
            corners, sizes = counted(block.lines)
            cells = np.repeat(np.arange(len(sizes)), sizes)
            first = np.flatnonzero(cells[:-1] == cells[1:])
            colors = colors_of(np.column_stack([corners[first], corners[first + 1]]), cells[first] + block.n_verts)
            for color, start, end in _runs(colors, first):
                scene.free.add_curve(points[corners[start : end + 1]], (color, width))
        if len(block.verts):
            corners, sizes = counted(block.verts)
            colors = colors_of(corners[:, None], np.repeat(np.arange(len(sizes)), sizes))
            scene.free.add_points(points[corners], [(color, dot) for color in colors])


def _own(prop, name, theme):
    """A property of an actor; `None` if it is the theme's."""
    value = getattr(prop, name, None)
    return None if value is None or value == getattr(theme, name) else value


def _colors_of_free(actor, block, theme):
    """The colours of curves and points of a block, by the numbers of each one's corners (K, m) and of its cell: that of the mean of their
    scalars, or the actor's; `None` for the theme's, and where cells have scalars but are not given."""
    prop, mapper = getattr(actor, "prop", None), actor.mapper
    values, is_of_cells = _scalars(mapper, block) if getattr(mapper, "scalar_visibility", False) else (None, False)
    color = _own(prop, "color", theme)
    own = None if color is None else tuple(color.float_rgb)

    def colors_of(corners, cells=None):
        if values is None or is_of_cells and cells is None or not len(corners):
            return [own if values is None else None] * len(corners)
        colors = _shades(mapper, values[cells] if is_of_cells else values[corners].mean(axis=1))
        # Few colours, for each is a layer of the drawing.
        return [tuple(color) for color in (np.round(colors * 15) / 15).tolist()]

    return colors_of


def _runs(colors, first):
    """The pieces of curves of one colour each: the colour, the place of the first corner and that of the last. `colors` are those of the
    lines between two corners, `first` the places of their first corners."""
    runs = []
    for color, place in zip(colors, first.tolist()):
        if runs and runs[-1][0] == color and runs[-1][2] == place:
            runs[-1][2] = place + 1
        else:
            runs.append([color, place, place + 1])
    return runs


def _labels(actor):
    """The points and texts of an actor of labels; `None` if it is another."""
    mapper = actor.GetMapper() if hasattr(actor, "GetMapper") else None
    if mapper is None or not mapper.IsA("vtkLabelPlacementMapper"):
        return None
    source = mapper.GetInputAlgorithm()
    # Between the labels and the points may be a filter of visible ones.
    while source.GetNumberOfInputPorts() and source.GetNumberOfInputConnections(0):
        name = source.GetLabelArrayName() if hasattr(source, "GetLabelArrayName") else "labels"
        source = source.GetInputAlgorithm()
    data = source.GetOutputDataObject(0)
    texts = data.GetPointData().GetAbstractArray(name)
    count = data.GetNumberOfPoints()
    return np.array([data.GetPoint(number) for number in range(count)]), [str(texts.GetValue(number)) for number in range(count)]


def _box(renderer, whole):
    """Left, top, right and bottom of a subplot in a picture of this size, pixels."""
    left, bottom, right, top = renderer.GetViewport()
    width, height = whole
    left, top = round(width * left), round(height * (1 - top))
    return left, top, max(left + 1, round(width * right)), max(top + 1, round(height * (1 - bottom)))


def _found(renderer, surfaces, free, settings):
    """The lines of surfaces, curves and points together; `free` are the meshes of the latter, and their rules."""
    # PyVista sets its camera when it first shows the scene.
    if not renderer.camera.is_set:
        renderer.camera_position = renderer.get_default_cam_pos()
        renderer.reset_camera()
        renderer.camera.is_set = True
    meshes, rules = free
    meshes = [_mesh_of(actor, surface) for actor, surface in surfaces] + meshes
    return _lines(meshes or None, camera=renderer.camera, **{**settings, "part": _part(rules, settings)})


def _part(rules, settings):
    """The setting ``part`` with rules of curves and points below the given ones. Settings for lines of all kinds replace theirs."""
    given = {key.replace("-", "_") for key, value in settings.items() if value is not None}
    replaced = {"color"} if "class_colors" in given else set()
    replaced |= {"line_width"} if given & {"line_width", "class_widths"} else set()
    rules = {part: {name: value for name, value in rule.items() if name not in replaced} for part, rule in rules.items()}
    rules = {part: rule for part, rule in rules.items() if rule}
    asked = settings.get("part")
    if not rules or asked is None:
        return rules or asked
    if hasattr(asked, "items"):
        return {**rules, **{part: {**rules.get(part, {}), **rule} for part, rule in asked.items()}}
    own = [f"{part}:" + ",".join(f"{name.replace('_', '-')}={_word(value)}" for name, value in rule.items()) for part, rule in rules.items()]
    return ";".join([*own, asked] if isinstance(asked, str) else [*own, *asked])


def _word(value):
    """A colour or a width as a word of a rule."""
    return "#" + "".join(f"{round(part * 255):02x}" for part in value) if isinstance(value, tuple) else value


def _views(renderer, shown, free, box, settings, fill, first):
    """A subplot's views on a sheet: curves, points and what is opaque, and above it what is transparent, for each opacity. `first` is the
    number of its first object on the sheet."""
    left, top, right, bottom = box
    settings = {**settings, "size": (right - left, bottom - top)}
    opacity = np.array([_opacity(actor) if fill else 1.0 for actor, _ in shown])
    see_through = len({id(actor) for (actor, _), share in zip(shown, opacity) if share < 1})
    _warn_of(see_through, "is transparent: its nearest surface alone is drawn", "are transparent: their nearest surface alone is drawn")

    def view(kept, among, free):
        drawn = [one for one, is_among in zip(shown, among) if is_among]
        found = _found(renderer, drawn, free, settings)
        areas = filled = None
        if fill and drawn:
            regions, colors = _filled(found, drawn)
            areas = regions._found, regions._colors(colors), float(opacity[kept][0])
            filled = regions, kept[among]
        numbers = np.where(kept, np.arange(len(shown)) + first, -1)
        # Curves and points come last.
        objects = [*numbers[among].tolist(), *range(len(shown) + first, len(shown) + first + len(free[0]))]
        return {"lines": found._found, "areas": areas, "at": (left, top), "objects": objects, "filled": filled}

    opaque, everything = opacity == 1, np.full(len(shown), True)
    views = [view(opaque, opaque, free)] if opaque.any() or free[0] else []
    return views + [view(opacity == share, everything, ([], {})) for share in np.unique(opacity[~opaque])[::-1]]


def _background(settings):
    """The background of pictures with these settings: red, green, blue and opacity, from 0 to 1."""
    settings = {name: settings.get(name) for name in ("look", "preset", "background")}
    # A corner of a picture of two points in the middle.
    return _pixels.of_png(_lines(points=[(0, 0, 0), (1, 0, 0)], size=64, **settings).png())[0, 0]


def _filled_picture(lines, views, background):
    """The PNG of views with areas; `lines` is that of their lines alone, over nothing."""
    lines = _pixels.multiplied(_pixels.of_png(lines))
    picture = np.broadcast_to(_pixels.multiplied(background), lines.shape)
    size = lines.shape[1::-1]
    for view in views:
        if view["filled"] is None:
            continue
        (regions, is_kept), (_, colors, opacity) = view["filled"], view["areas"]
        among = np.flatnonzero(np.append(is_kept, False)[regions.object])
        areas = [[corners + view["at"] for corners in regions.loops[number]] for number in among]
        picture = _pixels.laid(picture, _pixels.of_areas(size, areas, colors[among]), opacity)
    return _native.png(_pixels.divided(_pixels.laid(picture, lines)))


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


def _blocks(actor):
    """The data of an actor as polygons, lines and vertices."""
    # Before the scene is shown, its data may wait for the filter that makes them.
    actor.mapper.Update()
    data = actor.mapper.dataset
    blocks = [data] if not hasattr(data, "n_blocks") else [block for block in data.recursive_iterator() if block is not None]
    blocks = [block if hasattr(block, "faces") else _surface(block) for block in blocks]
    return [block.triangulate() if getattr(block, "n_strips", 0) else block for block in blocks]


def _placed(actor, points):
    """Points of an actor in the world's coordinates."""
    matrix = actor.GetMatrix()
    world_from_actor = np.array([[matrix.GetElement(row, column) for column in range(4)] for row in range(4)])
    points = rows("points", points, 3)
    if (world_from_actor == np.eye(4)).all():
        return points
    return np.ascontiguousarray(points @ world_from_actor[:3, :3].T + world_from_actor[:3, 3])


def _mesh_of(actor, surface):
    """A surface in the world's coordinates, its sides marked if the actor shows them."""
    corners, sizes = padded(surface.faces)
    points = _placed(actor, surface.points)
    mesh = _native.Mesh.of_arrays(points, corners, sizes, "mesh", {})
    if not getattr(actor, "prop", None) or not actor.prop.GetEdgeVisibility():
        return mesh
    # Of several points at a place, the first counts.
    first, numbers = same_places(points)
    edges = first[sides(numbers[corners], sizes)].astype(np.uint32)
    count = len(corners) // 3 if sizes is None else len(sizes)
    return mesh.with_marks(np.arange(count, dtype=np.uint32), np.ascontiguousarray(edges))


def _filled(found, drawn):
    """The areas of surfaces, and a colour for each: whole actors where each has one colour, which takes less time than faces."""
    plain = [_plain_color(actor, surface) for actor, surface in drawn]
    if any(color is None for color in plain):
        regions = found.regions()
        return regions, regions.of_faces([_colors(actor, surface) for actor, surface in drawn])
    regions = found.regions("object")
    return regions, np.array([*plain, (0.0, 0.0, 0.0)])[regions.object]


def _plain_color(actor, surface):
    """The one colour of an actor's faces; `None` if they show scalars."""
    mapper = actor.mapper
    has_scalars = getattr(mapper, "scalar_visibility", False) and _scalars(mapper, surface)[0] is not None
    return None if has_scalars else actor.prop.color.float_rgb


def _colors(actor, surface):
    """A colour for each face of a surface, as its actor's mapper gives it: (M, 3), from 0 to 1."""
    mapper = actor.mapper
    values, is_of_cells = _scalars(mapper, surface) if getattr(mapper, "scalar_visibility", False) else (None, False)
    corners, sizes = padded(surface.faces)
    count = len(corners) // 3 if sizes is None else len(sizes)
    if values is None:
        return np.tile(actor.prop.color.float_rgb, (count, 1))
    if is_of_cells:
        # Cells are numbered with points and lines before faces.
        values = values[surface.n_verts + surface.n_lines :]
    else:
        sizes = np.full(count, 3) if sizes is None else sizes
        starts = np.cumsum(sizes) - sizes
        values = (np.add.reduceat(np.asarray(values, dtype=float)[corners], starts, axis=0).T / sizes).T
    return _shades(mapper, values)


def _shades(mapper, values):
    """The colours that a mapper gives to scalars, vectors or colours: (M, 3), from 0 to 1."""
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
    """The scalars that a mapper shows, colours from 0 to 1, and whether they are of cells, not of points. `None` if the surface has none."""
    of_points, of_cells = surface.point_data, surface.cell_data
    name = mapper.array_name or surface.active_scalars_name
    places = [of_cells, of_points] if "cell" in mapper.scalar_map_mode else [of_points, of_cells]
    place = next((place for place in places if name in place), None)
    if place is None:
        return None, False
    values = np.asarray(place[name])
    if values.dtype == np.uint8 and mapper.color_mode == "direct":
        values = values / 255.0
    return values, place is of_cells


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
    longest = _DIGIT * letter * max((len(label) for _, label in labels), default=0)
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
    texts = [(title[0], title[1] + _PLAIN_FONT)] if title[0] else []
    for number, label in labels:
        share = float((scale(number) - low) / (high - low)) if high > low else 0.5
        line, at = tick(*place(share))
        boxes.append([*line, 0, 0, 0])
        texts.append((label, at + _PLAIN_FONT))
    return boxes, texts


def _texts(renderer):
    """The visible texts and legends of a renderer."""
    kinds = ("vtkTextActor", "vtkCornerAnnotation", "vtkLegendBoxActor")
    return [actor for actor in renderer.actors.values() if actor.GetVisibility() and any(map(actor.IsA, kinds))]


#: Where the texts of a vtkCornerAnnotation stand: shares of the width and height of the subplot, from the left and from the top.
_CORNERS = [(0, 1), (1, 1), (0, 0), (1, 0), (0.5, 1), (1, 0.5), (0, 0.5), (0.5, 0)]


def _key_of_text(actor, box, of_viewport, letter, theme):
    """A text or a legend in a subplot's box as rectangles and texts; a legend's letters are as high as those of scalar bars.
    `of_viewport` is the width and height of the subplot in the plotter's window."""
    left, top, right, bottom = box
    if actor.IsA("vtkLegendBoxActor"):
        return _key_of_legend(actor, box, letter)
    # Corners choose their letters' height by the room that the window has.
    of_labels, prop = letter, actor.GetTextProperty()
    if actor.IsA("vtkTextActor"):
        letter = prop.GetFontSize() * (right - left) / of_viewport[0]
    # The theme's colour suits its background, which is not drawn.
    color = prop.GetColor() if prop.GetColor() != theme.font.color.float_rgb else (0, 0, 0)
    font = [letter / of_labels, *color]
    texts, gap = [], 0.5 * letter
    if actor.IsA("vtkTextActor"):
        x, y, _ = actor.GetPositionCoordinate().GetValue()
        is_share = "Normalized" in actor.GetPositionCoordinate().GetCoordinateSystemAsString()
        width, height = (1, 1) if is_share else of_viewport
        lines = [line for line in actor.GetInput().split("\n") if line]
        # It stands above its place, beside it or below, and to the right of it or around it or to the left.
        below, across = prop.GetVerticalJustification() / 2, prop.GetJustification() / 2
        x, y = left + x / width * (right - left), bottom - y / height * (bottom - top) + 1.3 * letter * below * len(lines)
        return [], [(line, [x, y - 1.3 * letter * (len(lines) - 1 - row), across, -0.2] + font) for row, line in enumerate(lines)]
    for (across, down), text in zip(_CORNERS, map(actor.GetText, range(8))):
        lines = [line for line in (text or "").split("\n") if line]
        x = left + gap + across * (right - left - 2 * gap)
        first = top + gap + down * (bottom - top - 2 * gap - 1.3 * letter * len(lines))
        texts += [(line, [x, first + 1.3 * letter * row, float(across), 1.0] + font) for row, line in enumerate(lines)]
    return [], texts


def _key_of_legend(legend, box, letter):
    """A legend: a coloured square and a text for each entry, from the upper end of its place."""
    left, top, right, bottom = box
    (x, y), (_, height) = legend.GetPosition(), legend.GetPosition2()
    entries = [(legend.GetEntryString(number), legend.GetEntryColor(number)) for number in range(legend.GetNumberOfEntries())]
    longest = _DIGIT * letter * max((len(text) for text, _ in entries), default=0)
    # A text that would be cut off at the picture's end moves it.
    x = min(left + x * (right - left), right - 2 * letter - longest)
    y = bottom - (y + height) * (bottom - top)
    boxes, texts = [], []
    for number, (text, color) in enumerate(entries):
        upper = y + 1.5 * letter * number
        boxes += [[x - 1, upper - 1, x + letter + 1, upper + letter + 1, 0, 0, 0], [x, upper, x + letter, upper + letter, *color]]
        texts.append((text, [x + 1.5 * letter, upper + letter / 2, 0.0, 0.35] + _PLAIN_FONT))
    return boxes, texts


def _number(format, number):
    """A number in the format of a scalar bar: printf's, or that of newer versions of VTK."""
    return (format.format(number) if "{" in format else format % number).strip()


for _function in (lines, export_svg):
    _with_settings(_function, "lines")
