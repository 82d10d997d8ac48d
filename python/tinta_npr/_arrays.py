"""Checks shapes and types of given arrays. The numbers are checked where they are copied."""

import numpy as np


def rows(argument, values, width):
    """An array (N, width) of float64."""
    unmasked(argument, values)
    try:
        array = np.asarray(values)
    except (ValueError, TypeError):
        raise ValueError(f"{argument}: the rows are of different lengths; give {width} numbers each") from None
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{argument}: these are of type {array.dtype}; give real numbers")
    if array.ndim != 2 or array.shape[1] != width:
        raise ValueError(f"{argument}: the shape is {array.shape}; give (N, {width})")
    return np.ascontiguousarray(array, dtype=np.float64)


def unmasked(argument, values):
    """Refuses numpy's masked values, which a plain array would show as if they were none."""
    rows = values if isinstance(values, (list, tuple)) and values and isinstance(values[0], np.ma.MaskedArray) else [values]
    if any(np.ma.is_masked(row) for row in rows):
        raise ValueError(f"{argument}: some values are masked; leave their rows out, or fill them")


def vector(argument, values):
    """Three finite numbers."""
    unmasked(argument, values)
    array = np.asarray(values)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{argument}: these are of type {array.dtype}; give real numbers")
    if array.shape != (3,):
        raise ValueError(f"{argument}: the shape is {array.shape}; give 3 numbers")
    if not np.isfinite(array).all():
        raise ValueError(f"{argument}: {array.tolist()} is not finite")
    return [float(number) for number in array]


def corners(values):
    """Faces as a flat array of corners, and the number of corners of each; `None` if all are triangles."""
    unmasked("faces", values)
    try:
        array = np.asarray(values)
    except (ValueError, TypeError):
        array = None
    if array is None or array.dtype == object:
        return _ragged(values)
    if array.size == 0:
        return np.empty(0, dtype=np.int64), None
    if array.dtype.kind not in "iu":
        raise TypeError(f"faces: these are of type {array.dtype}; give whole numbers")
    if array.ndim != 2 or array.shape[1] < 3:
        raise ValueError(f"faces: the shape is {array.shape}; give (M, 3), or more corners a row")
    if array.dtype == np.uint64 and array.max() > np.iinfo(np.int64).max:
        row = int(np.argmax(array.max(axis=1)))
        raise ValueError(f"faces: row {row} names vertex {array[row].max()}; no mesh has so many")
    sizes = None if array.shape[1] == 3 else np.full(len(array), array.shape[1], dtype=np.int64)
    return np.ascontiguousarray(array, dtype=np.int64).reshape(-1), sizes


def _ragged(values):
    """Faces of different numbers of corners."""
    lists = [np.asarray(face) for face in values]
    for row, face in enumerate(lists):
        if face.ndim != 1 or (face.size and face.dtype.kind not in "iu"):
            raise TypeError(f"faces: row {row} is no list of whole numbers")
    sizes = np.array([len(face) for face in lists], dtype=np.int64)
    return np.concatenate(lists).astype(np.int64), sizes


def padded(cells):
    """VTK's faces: each face's corners follow their number."""
    cells = np.asarray(cells, dtype=np.int64)
    if cells.size == 0:
        return cells, None
    first = int(cells[0])
    if cells.size % (first + 1) == 0 and (cells[:: first + 1] == first).all():
        return corners(cells.reshape(-1, first + 1)[:, 1:])
    return counted(cells)


def counted(cells):
    """VTK's cells of any kind: the numbers of all corners, and how many each cell has."""
    cells = np.asarray(cells, dtype=np.int64)
    starts, place = [], 0
    while place < cells.size:
        starts.append(place)
        place += int(cells[place]) + 1
    is_corner = np.ones(cells.size, dtype=bool)
    is_corner[starts] = False
    return cells[is_corner], cells[starts]


def same_places(points, distance=0.0):
    """Points within a distance of one another count as one: the first of each, and the number among these of each point."""
    groups = np.empty(points.shape, dtype=np.int64)
    for axis, values in enumerate(points.T):
        order = np.argsort(values)
        groups[order, axis] = np.cumsum(np.diff(values[order], prepend=values[order[:1]]) > distance)
    _, first, numbers = np.unique(groups, axis=0, return_index=True, return_inverse=True)
    return first, numbers.ravel()


def sides(corners, sizes):
    """The two corners of each side of faces, the lower first, each side once: (K, 2)."""
    sizes = np.full(len(corners) // 3, 3) if sizes is None else sizes
    following = np.arange(1, len(corners) + 1)
    ends = np.cumsum(sizes)
    following[ends - 1] = ends - sizes
    return np.unique(np.sort(np.column_stack([corners, corners[following]]), axis=1), axis=0)
