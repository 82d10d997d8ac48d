"""The exact lines of a PyVista plotter's scene."""

import numpy as np

from . import lines as _lines
from ._mesh import of_arrays, meshes_of

__all__ = ["export_svg", "lines"]


def lines(plotter, **settings):
    """Find the lines of all surfaces that a plotter shows, as its camera sees them.

    Parameters
    ----------
    plotter : pyvista.Plotter
        Its visible actors, at their current places; only those of the active renderer.
    **settings
        As in `tinta_npr.lines`. The size is the plotter's unless `size` is given; the background is white, not the plotter's.

    Returns
    -------
    tinta_npr.Lines
        ``object`` numbers the actors in their order.
    """
    meshes = [mesh for actor in plotter.renderer.actors.values() for mesh in _meshes_of_actor(actor)]
    if not meshes:
        raise ValueError("plotter: it shows no surface; add_mesh() first")
    settings.setdefault("size", tuple(plotter.window_size))
    # PyVista sets its camera when it first shows the scene.
    if not plotter.camera.is_set:
        plotter.camera_position = plotter.get_default_cam_pos()
        plotter.reset_camera()
        plotter.camera.is_set = True
    return _lines(meshes, camera=plotter.camera, **settings)


def export_svg(plotter, file, **settings):
    """Write the exact lines of a plotter's scene: .svg, .pdf or .json.

    Parameters
    ----------
    plotter, **settings
        As in `lines`: ``hidden="dashed"``, ``look="technical"``, ``crease_angle=40`` …
    file : path
    """
    lines(plotter, **settings).save(file)


def _meshes_of_actor(actor):
    """The surfaces of an actor, in the world's coordinates."""
    mapper = getattr(actor, "mapper", None)
    data = getattr(mapper, "dataset", None)
    if data is None or not actor.GetVisibility() or not hasattr(data, "points") and not hasattr(data, "n_blocks"):
        return []
    matrix = actor.GetMatrix()
    world_from_actor = np.array([[matrix.GetElement(row, column) for column in range(4)] for row in range(4)])
    try:
        meshes = meshes_of(data, None, None, {})
    except ValueError:
        # Points and curves have no faces.
        return []
    if (world_from_actor == np.eye(4)).all():
        return meshes
    moved = lambda mesh: mesh.vertices @ world_from_actor[:3, :3].T + world_from_actor[:3, 3]
    return [of_arrays(moved(mesh), mesh.faces, None, {}) for mesh in meshes]
