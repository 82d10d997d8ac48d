"""Curves, points and labels given beside a mesh."""

import numpy as np

from . import _arrays, _native


def mesh_of(curves, points, labels, reading):
    """A `Mesh` of curves and points alone; `None` if none are given."""
    if curves is None and points is None:
        if labels is not None:
            raise ValueError("labels: they are texts of points; give points, too")
        return None
    lists = _curves(curves)
    ends = np.cumsum([len(curve) for curve in lists], dtype=np.int64)
    joined = np.concatenate(lists) if lists else np.empty((0, 3))
    dots = np.empty((0, 3)) if points is None else _points(points)
    texts = [] if labels is None else ["" if text is None else str(text) for text in labels]
    if labels is not None and len(texts) != len(dots):
        raise ValueError(f"labels: there are {len(texts)} for {len(dots)} points; give each point one, or None")
    kept = {key: value for key, value in reading.items() if key.replace("-", "_") == "up_axis"}
    return _native.Mesh.of_curves(np.ascontiguousarray(joined), ends, np.ascontiguousarray(dots), texts, kept)


def _curves(curves):
    """Curves as a list of arrays (K, 3): given so, as one array, or as PyVista's lines."""
    if curves is None:
        return []
    _arrays.unmasked("curves", curves)
    if hasattr(curves, "points") and hasattr(curves, "lines"):
        points, (corners, sizes) = np.asarray(curves.points, dtype=np.float64), _arrays.counted(curves.lines)
        return [points[part] for part in np.split(corners, np.cumsum(sizes)[:-1])] if len(sizes) else []
    if isinstance(curves, np.ndarray) and curves.dtype != object and curves.ndim == 2:
        curves = [curves]
    if not isinstance(curves, (list, tuple, np.ndarray)):
        raise TypeError(f"curves: give a list of arrays (K, 3), not {type(curves).__name__}")
    is_one = len(curves) and all(np.ndim(row) == 1 for row in curves)
    lists = [_arrays.rows("curves", curve, 3) for curve in ([curves] if is_one else curves)]
    for number, curve in enumerate(lists):
        if len(curve) < 2:
            raise ValueError(f"curves: curve {number} has {len(curve)} of the 2 or more positions of a curve")
    return lists


def _points(points):
    """Points as an array (N, 3): given so, or by PyVista."""
    points = getattr(points, "points", points)
    _arrays.unmasked("points", points)
    array = np.asarray(points)
    return np.empty((0, 3)) if array.size == 0 else _arrays.rows("points", points, 3)
