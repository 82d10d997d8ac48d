"""Curves and points of a scene, each in its own style."""

import numpy as np

from . import _curves
from ._arrays import same_places

#: The style of what has none: lines and dots as in `tinta_npr.lines`.
PLAIN = None, None


class Free:
    """Curves, and points with their labels. A style is a colour, red, green and blue from 0 to 1, and the width of lines in pixels;
    either may be `None`."""

    def __init__(self):
        self._curves = {}
        self._points, self._styles, self._labels = [], [], []

    def __bool__(self):
        return bool(self._curves or self._points)

    def add_curve(self, points, style=PLAIN):
        self._curves.setdefault(style, []).append(points)

    def add_points(self, points, styles=None, labels=None):
        """Adds points with a style and a label for each."""
        self._points.append(points)
        self._styles += styles or [PLAIN] * len(points)
        self._labels += labels or [None] * len(points)

    def meshes(self):
        """A `Mesh` for each style, and the rules of ``part`` by the meshes' names."""
        points = self._points_by_style()
        meshes, rules = [], {}
        for number, style in enumerate({**self._curves, **points}, 1):
            places, labels = points.get(style, (None, None))
            mesh = _curves.mesh_of(self._curves.get(style), places, labels, {})
            if style != PLAIN:
                mesh = _named(mesh, f"curves {number}")
                rules[mesh.name] = {name: value for name, value in zip(("color", "line_width"), style) if value is not None}
            meshes.append(mesh)
        return meshes, rules

    def _points_by_style(self):
        """The points of each style and their labels. A point is drawn once, with a label and a style if it has them."""
        if not self._points:
            return {}
        points = np.concatenate(self._points)
        order = np.argsort([label is None for label in self._labels], kind="stable")
        first, numbers = same_places(points[order])
        styles = {}
        for place, row in zip(numbers, order):
            if styles.get(place, PLAIN) == PLAIN:
                styles[place] = self._styles[row]
        found = {}
        for row in np.sort(first):
            places, labels = found.setdefault(styles[numbers[row]], ([], []))
            places.append(points[order[row]])
            labels.append(self._labels[order[row]])
        return {style: (np.array(places), labels if any(labels) else None) for style, (places, labels) in found.items()}


def _named(mesh, name):
    """A mesh under another name, made as a pickle makes it."""
    make, (arrays, curves, marked, _, *others) = mesh.__reduce__()
    return make(arrays, curves, marked, name, *others)
