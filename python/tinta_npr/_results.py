"""The results of functions."""

import os

import numpy as np

from . import _native, _units
from ._arrays import rows as _rows


_COLUMNS = frozenset(["object", "material", "tone", "face", "area"])
_ARRAYS = frozenset(["segments", "visible", "_code", "edge", "angle", "object", "outline", "covered"])


class Lines:
    """The lines of a mesh in a picture, in pieces that are wholly visible or wholly hidden.

    Attributes
    ----------
    segments : ndarray (N, 2, 2) of float64
        Both ends, pixels: x to the right, y down, (0, 0) the upper left corner.
    visible : ndarray (N,) of bool
    cls : ndarray (N,) of str
        The class, one of `tinta_npr.CLASSES`.
    edge : ndarray (N, 2) of int64
        The mesh edge it is part of, by the numbers of its vertices in the given mesh; -1 where faces intersect. For a curve the
        numbers of two positions among those of all curves, for a point its number after all of them, twice.
    angle : ndarray (N,) of float64
        Between the normals of its two faces, degrees; NaN for an edge without exactly two.
    object : ndarray (N,) of uint32
        The number of its mesh in the given list; curves and points follow the last.
    outline : ndarray (N,) of bool
        Whether it is visible and has only background on one side.
    covered : ndarray (N,) of bool
        Whether it is hidden and left out of drawings because another line is drawn in the same place.
    size : (width, height)
        The size of the picture, pixels.
    counts : dict
        The number of edges of each class.
    camera : dict
        In the form that `tinta_npr.lines` takes.
    labels : list of dict
        The labels of points in the picture: ``text``, ``at`` (pixels), ``visible``, ``object``.
    """

    def __init__(self, meshes, settings, look, preset, moved_from_mesh, classes):
        self._asked = meshes, settings, look, preset
        self._moved_from_mesh = moved_from_mesh
        self._classes = classes
        self.size = self._found.size
        self.counts = self._found.counts()
        self.labels = self._found.labels()

    def __getattr__(self, name):
        if name == "_found":
            self._found = _native.lines(*self._asked)
            return self._found
        if name == "camera":
            # A sheet of views has none.
            self.camera = self._found.camera()
            return self.camera
        # A drawing needs no hidden pieces: they are found on the first access to the arrays.
        if name not in _ARRAYS:
            raise AttributeError(f"{type(self).__name__} has no attribute {name}")
        for array, value in self._found.arrays().items():
            setattr(self, array if array != "code" else "_code", value)
        return getattr(self, name)

    def __getstate__(self):
        """A pickle holds the meshes and the arrays; a drawing of it finds the lines again, the same ones."""
        self.segments
        return {name: value for name, value in self.__dict__.items() if name != "_found"}

    def __copy__(self):
        copy = object.__new__(type(self))
        copy.__dict__.update(self.__dict__)
        return copy

    def __deepcopy__(self, memo):
        # Meshes and the compiled part never change; arrays, counts and camera may.
        copy = self.__copy__()
        for name, value in self.__dict__.items():
            if isinstance(value, (np.ndarray, dict)):
                setattr(copy, name, value.copy())
        return copy

    @property
    def cls(self):
        return np.array(self._classes)[self._code]

    @property
    def hidden(self):
        """The pieces that are hidden: (K, 2, 2) float64."""
        return self.segments[~self.visible]

    def __getitem__(self, name):
        """The visible pieces of a class: (K, 2, 2) float64."""
        return self.select(name)

    def select(self, *names, visible=True):
        """The pieces of some classes: visible, hidden, or both with ``visible=None``: (K, 2, 2) float64."""
        for name in names:
            if name not in self._classes:
                raise KeyError(f"there is no class {name}; choose one of {', '.join(self._classes)}")
        codes = [self._classes.index(name) for name in names]
        chosen = np.isin(self._code, codes)
        return self.segments[chosen if visible is None else chosen & (self.visible == visible)]

    def __len__(self):
        return len(self.segments)

    def __iter__(self):
        """The ends of its pieces, as in ``segments``."""
        return iter(self.segments)

    def __repr__(self):
        width, height = self.size
        seen = int(self.visible.sum())
        return f"<tinta_npr.Lines {width}x{height}: {seen} pieces visible, {len(self) - seen} hidden>"

    def _repr_svg_(self):
        return self.svg()

    def svg(self, *, title=None, **settings):
        """The drawing as SVG: a str. Settings given here override those given to `tinta_npr.lines`.

        Settings
        --------
        """
        return self._found.file("svg", settings, title).decode()

    def pdf(self, *, title=None, **settings):
        """The drawing as PDF: bytes. Settings as in `svg`.

        Settings
        --------
        """
        return self._found.file("pdf", settings, title)

    def png(self, **settings):
        """The drawing as PNG, as large as `size`: bytes. Settings as in `svg`, without a page.

        Settings
        --------
        """
        return self._found.file("png", settings)

    def json(self):
        """All pieces and the camera as JSON: a str."""
        return self._found.json()

    def regions(self, by="face", *, style=None, look=None, **settings):
        """Cut the view into exact areas: closed polygons with holes.

        Parameters
        ----------
        by : {"face", "material", "object", "tone"}
            One area for each visible part of a face of the given mesh, of a material or of an object, whose outlines they are; or
            of each tone of a cartoon style.
        style, look : str, optional
            With ``by="tone"``: the style of the tones, one of three-pass, two-pass, mrt and ink, or a look; by default the look
            print.

        Returns
        -------
        Regions

        Settings
        --------
        """
        return Regions(self, by, settings, style, look)

    def visible_area(self, by="face"):
        """The surface that is seen, in the model's units: of the faces themselves, not of their picture.

        A triangle seen nearly from its side, as at a contour, may count wrongly as a whole.

        Parameters
        ----------
        by : {"face", "material", "object"}

        Returns
        -------
        dict
            Surfaces by (object, face), by (object, material), or by object; only of those that are seen. Faces and materials have the
            numbers of `Regions`.
        """
        if by not in ("face", "material", "object"):
            raise ValueError(f"by {by}: choose one of face, material, object")
        return _units.seen_surfaces(self, by)

    def project(self, points):
        """Where points of the mesh's space are in the picture, for labels.

        Parameters
        ----------
        points : array_like (3,) or (N, 3)
            In the coordinates of the given vertices; for a model file in those of ``tinta_npr.mesh(file).vertices``, y up.

        Returns
        -------
        ndarray (2,) or (N, 2) of float64
            Pixels as in ``segments``, y down; NaN behind the eye. In 2-D axes of matplotlib, y is ``size[1] - y``.
        """
        given = np.asarray(points, dtype=np.float64)
        rows = np.ascontiguousarray(given.reshape(1, 3) if given.shape == (3,) else _rows("points", given, 3))
        rows = self._asked[0][0].turned(rows)
        if self._moved_from_mesh is not None:
            rows = np.ascontiguousarray(rows @ self._moved_from_mesh[:, :3].T + self._moved_from_mesh[:, 3])
        found = self._found.projected(rows)
        return found[0] if given.shape == (3,) else found

    def save(self, file, *, format=None, title=None, **settings):
        """Write a file: .svg, .pdf, .png or .json. Settings as in `svg`.

        `file` is a path, whose file appears whole or not at all, or an object with ``write``, opened for bytes, or
        for text where the format is one. `format` is
        ``"svg"``, ``"pdf"``, ``"png"`` or ``"json"``; by default a path's ending, and SVG for an object.

        Settings
        --------
        """
        path, format = _place(file, format)
        if format == "svg":
            content = self.svg(title=title, **settings).encode()
        elif format == "pdf":
            content = self.pdf(title=title, **settings)
        elif format == "png":
            content = self.png(**settings)
        elif format == "json" and not settings:
            content = self.json().encode()
        elif format == "json":
            raise ValueError(f"{next(iter(settings))}: a .json file holds all lines but no appearance; leave it out")
        else:
            raise ValueError(
                f"file: lines are written as .svg, .pdf, .png or .json, not as {'.' + format if format else 'a file without ending'}"
            )
        _written(file, path, content)

    def layers(self, **settings):
        """The drawing as plain values, from the lowest layer to the highest, as in the SVG.

        Each is a dict: ``name``, ``visible``, ``color`` (red, green, blue in 0 to 1), ``width`` and ``dash`` in pixels,
        ``opacity``, and ``paths``, arrays (K, 2) of points in pixels, y down. Settings as in `svg`.

        Settings
        --------
        """
        return self._found.layers(settings)


class Regions:
    """The exact areas of a view. With the background they fill the picture without gaps and overlaps.

    Attributes
    ----------
    object : ndarray (N,) of int64
        The number of the mesh in the given list; -1 for background.
    face : ndarray (N,) of int64
        The face by its number in the given mesh; -1 for background, and unless the areas are of faces.
    material : ndarray (N,) of int64
        The material in a model file; -1 for none, and in areas of objects.
    tone : ndarray (N,) of int64
        0 for the darkest; -1 for background, and unless the areas are of tones.
    area : ndarray (N,) of float64
        Without holes, square pixels.
    loops : list of N lists of ndarray (K, 2)
        Each area's corners, pixels, y down: the outer loop first, then holes, which run the other way.
    by : str
        What the areas are of.
    lines : Lines
        The lines of the same view.
    size : (width, height)
        The size of the picture, pixels.
    """

    def __init__(self, lines, by, settings, style, look):
        self.lines = lines
        self.by = by
        self._asked = settings, style, look
        self.size = lines.size
        for name, value in self._found.arrays().items():
            setattr(self, name, value)

    def __getattr__(self, name):
        if name == "_found":
            self._found = _native.regions(self.lines._found, self.by, *self._asked)
            return self._found
        if name != "loops":
            raise AttributeError(f"{type(self).__name__} has no attribute {name}")
        self.loops = self._found.loops()
        return self.loops

    def __getstate__(self):
        """A pickle holds the lines, the arrays and the loops; a drawing of it finds the areas again, the same ones."""
        self.loops
        return {name: value for name, value in self.__dict__.items() if name != "_found"}

    def __copy__(self):
        copy = object.__new__(type(self))
        copy.__dict__.update(self.__dict__)
        return copy

    def __deepcopy__(self, memo):
        copy = self.__copy__()
        for name in _COLUMNS:
            setattr(copy, name, getattr(self, name).copy())
        copy.loops = [[corners.copy() for corners in loops] for loops in self.loops]
        return copy

    def __len__(self):
        return len(self.area)

    def __repr__(self):
        width, height = self.size
        return f"<tinta_npr.Regions {width}x{height}: {len(self)} areas by {self.by}>"

    def _repr_svg_(self):
        return self.svg()

    def polygons(self, units="pixels"):
        """The areas as polygons with holes, as shapely takes them.

        Parameters
        ----------
        units : {"pixels", "model"}
            Pixels, y down; or the model's units, along the picture's right and upper side from the model's origin: from above x and y of a
            z-up model. The second needs a parallel projection.

        Returns
        -------
        list of N tuples (ndarray (K, 2), list of ndarray (K, 2))
            Of each area the outer ring and the holes: ``shapely.Polygon(*areas.polygons()[0])``. No ring touches itself.
        """
        if units not in ("pixels", "model"):
            raise ValueError(f"units {units}: choose one of pixels, model")
        if units == "model" and self.lines._moved_from_mesh is not None:
            raise ValueError("units: this camera's matrix has units of its own; ask for pixels, or give another camera")
        placed = _units.on_the_drawing(self.lines.camera, self.size) if units == "model" else np.asarray
        return [(placed(outer), [placed(hole) for hole in holes]) for outer, *holes in self.loops]

    def of_faces(self, values):
        """The values of the faces that the areas show.

        Parameters
        ----------
        values : array_like (M,) or (M, K), or a list of them
            One for each face of the given mesh; a list for several meshes, each with its own.

        Returns
        -------
        ndarray (N,) or (N, K) of float64
            NaN for background.
        """
        if self.by != "face":
            raise ValueError(f"values: these areas are by {self.by}; ask for by=\"face\"")
        count = int(self.object.max(initial=-1)) + 1
        is_list = isinstance(values, (list, tuple)) and len(values) > 0 and np.ndim(values[0]) > 0
        if is_list and sum(len(mesh.faces) > 0 for mesh in self.lines._asked[0]) < 2:
            # Of one mesh, a list of rows is no list of meshes.
            is_list = np.ndim(values[0]) == 2 or len(values) == 1
        if is_list and len(values) >= count:
            lists = [np.asarray(of_mesh, dtype=np.float64) for of_mesh in values]
        else:
            lists = [np.asarray(values, dtype=np.float64)]
        if len(lists) < count:
            raise ValueError("values: there are several meshes; give a list with the values of each")
        found = np.full((len(self), *lists[0].shape[1:]), np.nan)
        for number, of_mesh in enumerate(lists):
            chosen = self.object == number
            faces = self.face[chosen]
            if faces.size and faces.max() >= len(of_mesh):
                raise ValueError(f"values: there are {len(of_mesh)}, but face {faces.max()} is seen; give one for each face")
            found[chosen] = of_mesh[faces]
        return found

    def svg(self, *, colors=None, title=None, **settings):
        """The areas below their lines as SVG: a str.

        Parameters
        ----------
        colors : array_like (N, 3) or (N, 4), optional
            A colour for each area, red, green and blue from 0 to 1; opacity is ignored. By default those of tones and materials,
            and one for each number of a face or an object.
        title : str, optional

        Settings
        --------
        """
        return self._found.file("svg", settings, title, self._colors(colors)).decode()

    def pdf(self, *, colors=None, title=None, **settings):
        """The areas below their lines as PDF: bytes. Arguments as in `svg`.

        Settings
        --------
        """
        return self._found.file("pdf", settings, title, self._colors(colors))

    def json(self):
        """The areas and the camera as JSON: a str."""
        return self._found.json()

    def save(self, file, *, format=None, colors=None, title=None, **settings):
        """Write a file: .svg, .pdf or .json. `file` and `format` as in `Lines.save`, other arguments as in `svg`.

        Settings
        --------
        """
        path, format = _place(file, format)
        if format == "svg":
            content = self.svg(colors=colors, title=title, **settings).encode()
        elif format == "pdf":
            content = self.pdf(colors=colors, title=title, **settings)
        elif format == "json" and not settings and colors is None:
            content = self.json().encode()
        elif format == "json":
            raise ValueError(f"{next(iter(settings), 'colors')}: a .json file holds areas but no appearance; leave it out")
        else:
            said = "." + format if format else "a file without ending"
            raise ValueError(f"file: areas are written as .svg, .pdf or .json, not as {said}")
        _written(file, path, content)

    def _colors(self, colors):
        if colors is None:
            return None
        found = np.asarray(colors)
        if found.dtype.kind not in "fiu":
            raise TypeError(f"colors: these are of type {found.dtype}; give real numbers")
        if found.ndim != 2 or len(found) != len(self) or found.shape[1] not in (3, 4):
            raise ValueError(f"colors: the shape is {found.shape}; give ({len(self)}, 3)")
        found = np.ascontiguousarray(found[:, :3], dtype=np.float64)
        # The background has no colour.
        found[self.object < 0] = 0
        if not ((found >= 0) & (found <= 1)).all():
            raise ValueError("colors: the numbers of a colour are from 0 to 1; divide those from 0 to 255 by 255")
        return found


def _place(file, format):
    """The path of a file, empty for an object with ``write``, and the format."""
    is_path = not hasattr(file, "write")
    path = os.fspath(file) if is_path else ""
    return path, (format or (os.path.splitext(path)[1] if is_path else "svg")).lower().removeprefix(".")


def _written(file, path, content):
    """Writes a path's file, or to an object, opened for bytes or, unless the content is binary, for text."""
    if not hasattr(file, "write"):
        _native.write(path, content)
        return
    try:
        file.write(content)
    except TypeError:
        if content.startswith((b"%PDF", b"\x89PNG")):
            raise TypeError("file: it is open for text, and this format is binary; open it for bytes (\"wb\", io.BytesIO)") from None
        file.write(content.decode())


class Edges:
    """Edges of a mesh: ``vertices`` (N, 2) uint32, ``cls`` (N,) str, ``faces`` (N, 2) int64, -1 for none."""

    def __init__(self, found, classes):
        self.vertices = found["vertices"]
        self.faces = found["faces"]
        self.cls = np.array(classes)[found["code"]]

    def __len__(self):
        return len(self.vertices)

    def __repr__(self):
        names, counts = np.unique(self.cls, return_counts=True)
        said = ", ".join(f"{count} {name}" for name, count in zip(names, counts))
        return f"<tinta_npr.Edges: {said or 'none'}>"


class Picture(np.ndarray):
    """A picture: an array (H, W, 4) of uint8, red, green, blue, alpha, the top row first."""

    # A masked array of it, as matplotlib makes one, holds a plain array: it takes no plain numbers for results.
    _baseclass = np.ndarray

    def __new__(cls, pixels, recipe=None):
        picture = np.asarray(pixels).view(cls)
        picture.recipe = recipe
        return picture

    def __array_finalize__(self, source):
        # An array derived from a picture, such as a part of it, does not match the recipe.
        self.recipe = None

    def __array_wrap__(self, array, context=None, return_scalar=False):
        # A mean or a maximum of all is a number of Python's, as JSON takes it.
        return array.item() if np.ndim(array) == 0 else super().__array_wrap__(array, context)

    def __reduce__(self):
        make, arguments, state = super().__reduce__()
        return make, arguments, (state, self.recipe)

    def __setstate__(self, state):
        state, recipe = state
        super().__setstate__(state)
        self.recipe = recipe

    def __copy__(self):
        return Picture(np.array(self), self.recipe)

    def __deepcopy__(self, memo):
        return self.__copy__()

    def png(self):
        """The PNG file: bytes. For a mesh from a file it holds the recipe, from which `tinta again` redraws it."""
        return _native.png(self._pixels(), self.recipe)

    def save(self, path):
        """Write a file: .png, .jpg, .bmp, .tga or .ppm. It appears whole or not at all."""
        _native.save(self._pixels(), os.fspath(path), self.recipe)

    def _pixels(self):
        return np.ascontiguousarray(self, dtype=np.uint8)

    def _repr_png_(self):
        is_picture = self.ndim == 3 and self.shape[2] == 4 and self.dtype == np.uint8 and self.size
        return self.png() if is_picture else None


class Comparison:
    """Two styles' drawings: ``numbers``, and the pictures ``left``, ``right`` and ``lines``."""

    def __init__(self, numbers, pictures):
        self.numbers = numbers
        self.left, self.right, self.lines = (Picture(pixels) for pixels in pictures)

    def __repr__(self):
        return f"<tinta_npr.Comparison {self.numbers}>"

    def _repr_png_(self):
        return self.lines.png()
