"""Objects of build123d and CadQuery, recognised by their attributes, without importing those packages.

In: a shape, a builder, a workplane or an assembly. Out: a mesh for each shape, whose faces have the numbers of the object's faces and whose
marked edges are the object's edges. The packages cut each face into triangles separately; an edge is a side that one face's triangles have
once. So the seam of a cylinder, whose sides meet in one face, is none.
"""

import numpy as np

from . import _native
from ._arrays import same_places

#: The distance between a curve and its chords, a share of the diagonal of the object's box, and the angle between two chords, radians.
_CHORD, _ANGLE = 1e-4, 0.1
#: The angle beside a given distance, which decides.
_WIDE = 0.5
#: The distance within which corners of two faces are one, the same share.
_SAME = 1e-7


def is_cad(thing):
    """Whether this is an object of build123d or CadQuery."""
    return _is_shape(thing) or any(
        all(hasattr(thing, name) for name in names)
        for names in (("part", "pending_faces"), ("vals", "newObject"), ("toCompound", "children"), ("distribute", "hull"))
    )


def is_among(things):
    """Whether this is such an object, or a list with one."""
    return any(map(is_cad, things)) if isinstance(things, (list, tuple)) else is_cad(things)


def _is_shape(thing):
    # An empty part of build123d refuses to say what it wraps. PyVista's data sets have both methods, too, and are VTK's objects.
    has_box = hasattr(thing, "bounding_box") or hasattr(thing, "BoundingBox")
    return has_box and hasattr(thing, "tessellate") and not hasattr(thing, "IsA")


def meshes_of(thing, name, reading):
    """A list of `Mesh`, z up unless the reading says otherwise."""
    reading = dict(reading)
    tolerance = reading.pop("tolerance", None)
    if reading.get("up_axis") in (None, "auto"):
        reading["up_axis"] = "z"
    try:
        shapes = [(shape, name or named) for shape, named in _shapes(thing)]
        cut = [(*_triangles(shape, tolerance), named) for shape, named in shapes]
    except (AttributeError, TypeError, ValueError, IndexError, RuntimeError) as problem:
        kind = f"{type(thing).__module__.split('.')[0]}.{type(thing).__name__}"
        raise ValueError(
            f"mesh: this {kind} gives no triangles as those of build123d 0.13 and CadQuery 2 do ({problem}); export it as .stl or .glb"
        ) from problem
    cut = [one for one in cut if len(one[1])]
    if not cut:
        raise ValueError("mesh: this object has no face; make a solid or a face of it, or give its edges as curves")
    return [_mesh(*one, reading) for one in cut]


def _shapes(thing):
    """The shapes of an object with their names."""
    if _is_shape(thing):
        return _named(thing, thing)
    if hasattr(thing, "distribute"):
        # A sketch of CadQuery: it gives its faces at their places.
        return [(type(thing._faces).makeCompound(thing), "sketch")]
    if hasattr(thing, "vals"):
        return [one for value in thing.vals() if _is_shape(value) for one in _named(value, value)]
    if hasattr(thing, "part"):
        return [] if thing.part is None else _shapes(thing.part)
    # An assembly of CadQuery: a place for each shape.
    return [(shape.moved(place), name) for shape, name, place, *_ in thing]


def _named(shape, tree):
    """A shape, or the shapes of an assembly of build123d. The assembly holds the names in a tree, and the shapes at their places when one
    iterates over it."""
    children = getattr(tree, "children", ())
    parts = list(shape) if children else []
    if parts and len(parts) == len(children):
        return [one for part, child in zip(parts, children) for one in _named(part, child)]
    return [(shape, getattr(tree, "label", None) or "part")]


def _triangles(shape, tolerance):
    """The corners of a shape's triangles (N, 3), triangles (M, 3), and each triangle's face (M,)."""
    own = list(shape.Faces() if hasattr(shape, "Faces") else shape.faces())
    if not own:
        return np.empty((0, 3)), np.empty((0, 3), dtype=np.int64), np.empty(0, dtype=np.int64)
    box = shape.BoundingBox() if hasattr(shape, "BoundingBox") else shape.bounding_box()
    diagonal = float(box.DiagonalLength if hasattr(box, "DiagonalLength") else box.diagonal)
    # The whole first: faces share the corners of their edges.
    fineness = (_CHORD * diagonal, _ANGLE) if tolerance is None else (float(tolerance), _WIDE)
    shape.tessellate(*fineness)
    points, triangles, faces, count = [np.empty((0, 3))], [np.empty((0, 3), dtype=np.int64)], [], 0
    for number, face in enumerate(own):
        corners, cut = face.tessellate(*fineness)
        if not len(cut):
            continue
        points.append(np.array([corner.toTuple() if hasattr(corner, "toTuple") else tuple(corner) for corner in corners], dtype=np.float64))
        triangles.append(np.array(cut, dtype=np.int64) + count)
        faces += [number] * len(cut)
        count += len(corners)
    points = np.concatenate(points)
    first, numbers = same_places(points, _SAME * diagonal)
    triangles, faces = numbers[np.concatenate(triangles)], np.array(faces, dtype=np.int64)
    # At a pole, two corners are one.
    kept = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
    return points[first], triangles[kept], faces[kept]


def _mesh(points, triangles, faces, name, reading):
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]], axis=2).reshape(-1, 2)
    of_faces, counts = np.unique(np.column_stack([np.repeat(faces, 3), sides]), axis=0, return_counts=True)
    edges = np.unique(of_faces[counts == 1, 1:], axis=0)
    mesh = _native.Mesh.of_arrays(points, np.ascontiguousarray(triangles).reshape(-1), None, name, reading)
    return mesh.with_marks(np.ascontiguousarray(faces, dtype=np.uint32), np.ascontiguousarray(edges, dtype=np.uint32))
