"""Meshes of other packages, recognised by their attributes, without importing those packages."""

import contextlib
import io
import os

import numpy as np

from . import _arrays, _cad, _native

#: The faces of a cell that has a volume, by meshio's names: each face's corners in a row, from whichever side.
_FACES_OF_CELLS = {
    "tetra": ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)),
    "hexahedron": ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)),
    "wedge": ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
    "pyramid": ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
}

#: The endings of files that tinta reads itself.
_ENDINGS = frozenset(_native.names("ending"))


def meshes_of(mesh, faces, name, reading, asked=()):
    """A list of `Mesh`; `reading` are the settings they are read with, `asked` those of them that a mesh must have been read with."""
    if faces is not None:
        return [of_arrays(mesh, faces, name, reading)]
    if isinstance(mesh, _native.Mesh):
        for setting in asked:
            if not mesh.was_read_with({setting: reading[setting]}):
                raise ValueError(f"{setting}: this Mesh has been read already; give it to tinta_npr.mesh()")
        return [mesh]
    if isinstance(mesh, (str, os.PathLike)):
        other = _read_by_others(os.fspath(mesh))
        if other is not None:
            return meshes_of(other, None, name or os.path.basename(os.fspath(mesh)), reading)
        return [_native.Mesh.of_file(os.fspath(mesh), reading)]
    if isinstance(mesh, (list, tuple)):
        if not mesh:
            raise ValueError("mesh: the list is empty; give at least one")
        if _is_pair(mesh):
            return [of_arrays(*mesh, name, reading)]
        if not any(_is_mesh(one) or _is_pair(one) for one in mesh):
            raise TypeError("mesh: these are vertices without faces; give lines(vertices, faces)")
        return [one for each in mesh for one in meshes_of(each, None, name, reading, asked)]
    if isinstance(mesh, np.ndarray):
        raise TypeError("faces: they are missing; give lines(vertices, faces)")
    if _cad.is_cad(mesh):
        return _cad.meshes_of(mesh, name, reading)
    # trimesh's scenes hold meshes at places.
    if hasattr(mesh, "geometry") and hasattr(mesh, "dump"):
        parts = mesh.dump()
        return meshes_of(list(parts), None, name, reading)
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        return [of_arrays(mesh.vertices, mesh.faces, name, reading)]
    # Open3D's; its newer class turns into the older one.
    if hasattr(mesh, "triangle") and hasattr(mesh, "to_legacy"):
        mesh = mesh.to_legacy()
    if hasattr(mesh, "vertices") and hasattr(mesh, "triangles"):
        return [of_arrays(np.asarray(mesh.vertices), np.asarray(mesh.triangles), name, reading)]
    if hasattr(mesh, "points") and hasattr(mesh, "cells") and hasattr(mesh, "cell_data") and _is_blocks(mesh.cells):
        return [_of_cells(mesh, name, reading)]
    if hasattr(mesh, "points") and hasattr(mesh, "faces"):
        return [_of_poly_data(mesh, name, reading)]
    # PyVista's blocks.
    if hasattr(mesh, "n_blocks") and hasattr(mesh, "keys"):
        return meshes_of([block for block in mesh if block is not None], None, name, reading)
    if hasattr(mesh, "extract_surface"):
        return [_of_poly_data(_surface(mesh), name, reading)]
    if hasattr(mesh, "IsA") and mesh.IsA("vtkDataSet"):
        return [_of_vtk(mesh, name, reading)]
    kind = type(mesh).__name__
    raise TypeError(f"mesh: give vertices and faces, a path, a mesh of trimesh, PyVista, VTK, meshio or Open3D, or a part of build123d or CadQuery, not {kind}")


def of_arrays(vertices, faces, name, reading):
    """A `Mesh` of vertices and faces."""
    corners, sizes = _arrays.corners(faces)
    return _native.Mesh.of_arrays(_arrays.rows("vertices", vertices, 3), corners, sizes, name or "mesh", reading)


def _is_mesh(one):
    is_named = isinstance(one, (str, os.PathLike, _native.Mesh))
    return is_named or _cad.is_cad(one) or any(hasattr(one, name) for name in ("vertices", "points", "geometry", "n_blocks", "IsA"))


def _is_pair(one):
    """Whether this is (vertices, faces): two tables, not two meshes."""
    if not isinstance(one, (list, tuple)) or len(one) != 2 or any(_is_mesh(table) for table in one):
        return False
    vertices, faces = one
    try:
        is_table = np.ndim(vertices) == 2 and np.shape(vertices)[1] == 3
    except ValueError:
        return False
    return is_table and hasattr(faces, "__len__") and len(faces) > 0 and hasattr(faces[0], "__len__")


def _read_by_others(path):
    """The mesh of a file that tinta does not read, by meshio, PyVista or trimesh if one of them does and is installed; else `None`."""
    ending = os.path.splitext(path)[1].lower()
    if path.startswith("builtin:") or ending[1:] in _ENDINGS or not os.path.isfile(path):
        return None
    is_refused = False
    quiet = io.StringIO()
    try:
        import meshio
    except ImportError:
        pass
    else:
        if ending in meshio.extension_to_filetypes:
            try:
                with contextlib.redirect_stdout(quiet), contextlib.redirect_stderr(quiet):
                    return meshio.read(path)
            except (SystemExit, meshio.ReadError):
                # meshio ends the program at files that it cannot read, such as VTK's polygons.
                is_refused = True
    if is_refused or ending in (".vtk", ".vtp", ".vtu"):
        try:
            import pyvista
        except ImportError:
            pass
        else:
            return pyvista.read(path)
    try:
        import trimesh
    except ImportError:
        pass
    else:
        # It reads VTK's files by meshio.
        if ending[1:] in trimesh.available_formats() and not (is_refused and ending == ".vtk"):
            return trimesh.load(path)
    if is_refused:
        raise ValueError(f"{path}: meshio cannot read it; install pyvista, which may, or save it as .ply")
    return None


def _of_vtk(mesh, name, reading):
    """Makes a `Mesh` of a data set of VTK's own classes: its surface, faces undivided."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if not mesh.IsA("vtkPolyData") or mesh.GetNumberOfStrips():
        from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter

        outside = vtkGeometryFilter()
        outside.SetInputData(mesh)
        outside.Update()
        mesh = outside.GetOutput()
    if not mesh.GetNumberOfPolys():
        raise ValueError("cells: none of them has a face; give triangles, polygons or volumes")
    polygons = mesh.GetPolys()
    corners = vtk_to_numpy(polygons.GetConnectivityArray()).astype(np.int64)
    sizes = np.diff(vtk_to_numpy(polygons.GetOffsetsArray())).astype(np.int64)
    points = _arrays.rows("points", vtk_to_numpy(mesh.GetPoints().GetData()), 3)
    return _native.Mesh.of_arrays(points, corners, None if (sizes == 3).all() else sizes, name or "mesh", reading)


def _is_blocks(cells):
    return isinstance(cells, list) and all(hasattr(block, "type") and hasattr(block, "data") for block in cells)


def _surface(mesh):
    """The outside of PyVista's volumes, faces undivided; older versions have only one algorithm."""
    import inspect

    has_ways = "algorithm" in inspect.signature(mesh.extract_surface).parameters
    return mesh.extract_surface(algorithm=None) if has_ways else mesh.extract_surface()


def _of_poly_data(mesh, name, reading):
    """Makes a `Mesh` of PyVista's surfaces."""
    if getattr(mesh, "n_strips", 0):
        mesh = mesh.triangulate()
    corners, sizes = _arrays.padded(mesh.faces)
    return _native.Mesh.of_arrays(_arrays.rows("points", mesh.points, 3), corners, sizes, name or "mesh", reading)


def _of_cells(mesh, name, reading):
    """Makes a `Mesh` of meshio's cells: surfaces, and the faces of volumes that only one cell has."""
    points = np.asarray(mesh.points, dtype=np.float64)
    if points.ndim == 2 and points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    lists = []
    outside = {}
    for block in mesh.cells:
        data = np.asarray(block.data)
        # Corners come first, then the middles of edges and faces.
        kind = block.type.rstrip("0123456789") if block.type not in ("vertex", "line") else block.type
        if kind in ("triangle", "quad"):
            lists.append(data[:, : 3 if kind == "triangle" else 4])
        elif kind == "polygon":
            lists.append(data)
        elif kind in _FACES_OF_CELLS:
            for face in _FACES_OF_CELLS[kind]:
                for corners in _outwards(points, data[:, face], data).tolist():
                    key = tuple(sorted(corners))
                    outside[key] = None if key in outside else corners
    faces = [face for block in lists for face in block.tolist()] if len(lists) != 1 or outside else lists[0]
    if outside:
        faces = faces + [corners for corners in outside.values() if corners is not None]
    if len(faces) == 0:
        kinds = ", ".join(sorted({block.type for block in mesh.cells})) or "none"
        raise ValueError(f"cells: none of them has a face (there are: {kinds}); give triangles, polygons or volumes")
    return of_arrays(points, faces, name, reading)


def _outwards(points, faces, cells):
    """Faces of cells, counter-clockwise seen from outside: formats number the corners of a wedge from either side."""
    first, second, third = (points[faces[:, corner]] for corner in range(3))
    away = points[faces].mean(axis=1) - points[cells].mean(axis=1)
    is_inwards = np.einsum("ij,ij->i", np.cross(second - first, third - first), away) < 0
    return np.where(is_inwards[:, None], faces[:, ::-1], faces)
