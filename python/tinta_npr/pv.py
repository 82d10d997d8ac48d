"""The exact lines of a PyVista plotter's scene."""

import numpy as np

from . import _native, _with_settings
from . import lines as _lines
from ._mesh import of_arrays, meshes_of

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
    return _found(plotter, {"look": look, "preset": preset, **settings})


def export_svg(plotter, file, *, format=None, title=None, look=None, preset=None, **settings):
    """Write the exact lines of a plotter's scene: .svg, .pdf, .png or .json.

    Parameters
    ----------
    plotter, look, preset, **settings
        As in `lines`: ``hidden="dashed"``, ``look="technical"``, ``crease_angle=40`` …
    file, format, title
        As in `tinta_npr.Lines.save`.

    Settings
    --------
    """
    _found(plotter, {"look": look, "preset": preset, **settings}).save(file, format=format, title=title)


def _found(plotter, settings):
    actors = [actor for actor in plotter.renderer.actors.values() if _is_of_data(actor)]
    surfaces = [_meshes_of_actor(actor) for actor in actors]
    meshes = [mesh for surface in surfaces for mesh in surface]
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
    return _lines(meshes, camera=plotter.camera, **settings)


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


def _meshes_of_actor(actor):
    """The surfaces of an actor, in the world's coordinates; none of points and curves."""
    matrix = actor.GetMatrix()
    world_from_actor = np.array([[matrix.GetElement(row, column) for column in range(4)] for row in range(4)])
    try:
        meshes = meshes_of(actor.mapper.dataset, None, None, {})
    except ValueError:
        # They have no faces.
        return []
    if (world_from_actor == np.eye(4)).all():
        return meshes
    moved = lambda mesh: mesh.vertices @ world_from_actor[:3, :3].T + world_from_actor[:3, 3]
    return [of_arrays(moved(mesh), mesh.faces, None, {}) for mesh in meshes]


for _function in (lines, export_svg):
    _with_settings(_function, "lines")
