"""What every program's script shares: its arguments MODEL.obj CAMERA.json DRAWING, its last line, and plain SVG."""

import json
import sys
import time
from pathlib import Path

import numpy as np

CREASE_DEGREES = 30.0
LINE_WIDTH_PX = 2.0


def arguments():
    """Paths of the model and the drawing, and the camera between."""
    model, camera, drawing = sys.argv[1:4]
    return model, json.loads(Path(camera).read_text()), drawing


def done(version, renderer, since):
    """Says the program's version, what drew, and the seconds since its modules were loaded."""
    print(json.dumps({"version": version, "renderer": renderer, "drawing_seconds": time.perf_counter() - since}))


def read_triangles(path):
    """Points and triangles of a mesh that models.py wrote."""
    points, triangles = [], []
    with open(path) as lines:
        for line in lines:
            kind, *numbers = line.split()
            (points if kind == "v" else triangles).append(numbers)
    return np.array(points, dtype=float), np.array(triangles, dtype=np.int64) - 1


def edges(points, triangles):
    """Each edge with its corners, its first two faces (-1 for none), how many faces it has, and the angle between them in degrees."""
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    starts, ends = triangles.ravel(), triangles[:, [1, 2, 0]].ravel()
    faces = np.arange(len(starts)) // 3
    pairs = np.sort(np.c_[starts, ends], axis=1)
    order = np.lexsort((pairs[:, 1], pairs[:, 0]))
    pairs, faces, forward = pairs[order], faces[order], (starts < ends)[order]
    first = np.flatnonzero(np.r_[True, (pairs[1:] != pairs[:-1]).any(1)])
    counts = np.diff(np.r_[first, len(pairs)])
    second = np.where(counts > 1, first + 1, first)
    # Two faces that run along their edge the same way have normals on different sides.
    sign = np.where(forward[first] == forward[second], -1.0, 1.0)
    cosines = (normals[faces[first]] * normals[faces[second]]).sum(1) * sign
    angles = np.degrees(np.arccos(np.clip(cosines, -1, 1)))
    both = np.c_[faces[first], np.where(counts > 1, faces[second], -1)]
    return pairs[first], both, counts, np.where(counts > 1, angles, 180.0)


def write_svg(path, segments, size):
    """Segments in pixels, y down, as black lines."""
    lines = "".join(f"M{ax:.3f} {ay:.3f}L{bx:.3f} {by:.3f}" for ax, ay, bx, by in segments)
    Path(path).write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{size}" height="{size}" viewBox="0 0 {size} {size}">\n'
        f'<path fill="none" stroke="#000" stroke-width="{LINE_WIDTH_PX}" stroke-linecap="round" d="{lines}"/>\n</svg>\n'
    )
