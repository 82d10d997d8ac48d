"""The exact lines and areas of a PyVista plotter's scene."""

import numpy as np

from . import _native, _with_settings
from . import lines as _lines
from ._arrays import padded, rows
from ._mesh import _surface, meshes_of
from ._results import _place

__all__ = ["export_svg", "lines"]


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
    return _found(plotter, {"look": look, "preset": preset, **settings})[0]


def export_svg(plotter, file, *, fill=False, format=None, title=None, look=None, preset=None, **settings):
    """Write the exact lines of a plotter's scene: .svg, .pdf, .png or .json.

    Parameters
    ----------
    plotter, look, preset, **settings
        As in `lines`: ``hidden="dashed"``, ``look="technical"``, ``crease_angle=40`` …
    fill : bool
        Whether to fill the surfaces below the lines: each face in one colour, the actor's or that of its scalar by the actor's
        lookup table, without light and opaque. A face with scalars at its points has the colour of their mean. The scalar bar is
        left out, with a warning. Into .svg, .pdf or .json.
    file, format, title
        As in `tinta_npr.Lines.save`.

    Settings
    --------
    """
    found, shown = _found(plotter, {"look": look, "preset": preset, **settings})
    if not fill:
        found.save(file, format=format, title=title)
        return
    if len(getattr(plotter, "scalar_bars", ())):
        _native.warn("plotter: its scalar bar is left out; matplotlib's colorbar draws one as vectors")
    regions = found.regions()
    if _place(file, format)[1] == "json":
        regions.save(file, format=format)
        return
    colors = regions.of_faces([_colors(actor, surface) for actor, surface in shown])
    regions.save(file, format=format, title=title, colors=colors)


def _found(plotter, settings):
    """The lines, and the actor and the surface of each mesh."""
    actors = [actor for actor in plotter.renderer.actors.values() if _is_of_data(actor)]
    surfaces = [_surfaces_of_actor(actor) for actor in actors]
    shown = [(actor, surface) for actor, of_actor in zip(actors, surfaces) for surface in of_actor]
    meshes = [_mesh_of(actor, surface) for actor, surface in shown]
    if not meshes:
        raise ValueError("plotter: it shows no surface; add_mesh() first")
    _warn_of(sum(not surface for surface in surfaces), "shows points or curves, which are left out", "show points or curves, which are left out")
    see_through = sum(_opacity(actor) < 1 for actor, surface in zip(actors, surfaces) if surface)
    _warn_of(see_through, "is transparent, but hides lines like an opaque one", "are transparent, but hide lines like opaque ones")
    left, bottom, right, top = plotter.renderer.GetViewport()
    width, height = plotter.window_size
    size = max(1, round(width * (right - left))), max(1, round(height * (top - bottom)))
    if settings.get("size") is None:
        settings = {**settings, "size": size}
    # PyVista sets its camera when it first shows the scene.
    if not plotter.camera.is_set:
        plotter.camera_position = plotter.get_default_cam_pos()
        plotter.reset_camera()
        plotter.camera.is_set = True
    return _lines(meshes, camera=plotter.camera, **settings), shown


def _warn_of(count, one, several):
    if count:
        _native.warn(f"plotter: an actor {one}" if count == 1 else f"plotter: {count} actors {several}")


def _is_of_data(actor):
    """Whether an actor is visible and shows a data set in the scene, unlike texts, axes and scalar bars."""
    data = getattr(getattr(actor, "mapper", None), "dataset", None)
    return bool(data is not None and actor.GetVisibility() and (hasattr(data, "points") or hasattr(data, "n_blocks")))


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
        return np.clip(values[:, :3], 0, 1)
    if values.ndim == 2:
        values = np.linalg.norm(values, axis=1)
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

    table = mapper.lookup_table
    if not mapper.GetUseLookupTableScalarRange() and hasattr(table, "SetTableRange"):
        # As a mapper does before it draws.
        table.SetTableRange(*mapper.scalar_range)
    mapped = table.MapScalars(numpy_to_vtk(np.ascontiguousarray(values, dtype=float)), 1, -1)
    return vtk_to_numpy(mapped)[:, :3] / 255.0


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


for _function in (lines, export_svg):
    _with_settings(_function, "lines")
