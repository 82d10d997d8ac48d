"""Exact visible lines and cartoons of meshes.

    import tinta_npr

    tinta_npr.lines(mesh).save("mesh.svg")          # vectors with right occlusion; no OpenGL, no display
    tinta_npr.render(mesh).save("mesh.png")         # a picture in ink, drawn off-screen by OpenGL
    tinta_npr.pv.export_svg(plotter, "scene.svg")   # the scene of a PyVista plotter
    tinta_npr.mpl.draw(ax, mesh)                    # into matplotlib's axes, as vectors

A mesh is a pair of arrays (vertices, faces), the path of a model file, an object of trimesh, PyVista, VTK, meshio or Open3D, or a part of
build123d or CadQuery.
"""

import atexit as _atexit
import functools as _functools
import inspect as _inspect
import re as _re

from . import _cad, _native
from ._camera import settings_of as _camera_settings
from ._curves import mesh_of as _mesh_of_curves
from ._mesh import meshes_of as _meshes_of
from ._results import Comparison, Edges, Lines, Picture, Regions

__version__ = _native.VERSION

#: Classes of lines, in the order of ``Class``: an edge of several is drawn as the first.
CLASSES = tuple(_native.names("class"))
#: Names of styles, of which `render` draws one.
STYLES = tuple(_native.names("style"))
#: Names of looks: a style with settings that suit one another.
LOOKS = tuple(_native.names("look"))

Mesh = _native.Mesh

__all__ = [
    "CLASSES", "LOOKS", "STYLES", "Comparison", "Edges", "Lines", "Mesh", "Picture", "Regions",
    "compare", "edges", "lines", "measure", "mesh", "render", "silhouette",
]

# Closes the contexts before the driver unloads.
_atexit.register(_native.close)


def mesh(mesh, faces=None, *, name=None, tolerance=None, **settings):
    """Read a mesh once, to draw it often.

    Parameters
    ----------
    mesh : array_like (N, 3), (vertices, faces), path or object
        Vertices in units of your choice; or a model file (FORMATS,
        and those that an installed meshio, PyVista or trimesh reads) or ``"builtin:bust"``; or an object with ``vertices`` and ``faces`` (trimesh) or ``triangles`` (Open3D),
        or with ``points`` and cells (PyVista, meshio), or a data set of VTK; or a part or an assembly of build123d or CadQuery, which is
        read z-up and whose edges are of class ``"marked"``.
    faces : array_like (M, k) of int, or a list of lists, optional
        With `mesh` as vertices: each face's corners, counter-clockwise seen from outside; 3 or more.
    name : str, optional
        Its name in errors and drawings.
    tolerance : float, optional
        Of a part of build123d or CadQuery: the distance between a curve and its chords, in the part's units; a ten-thousandth of its size by
        default.

    Returns
    -------
    Mesh
        Pass it to the other functions in place of the mesh.

    Settings
    --------
    """
    if tolerance is not None and not (_cad.is_cad(mesh) and tolerance > 0):
        raise ValueError("tolerance: give a number above 0, beside a part of build123d or CadQuery; others have their triangles already")
    return _one(mesh, faces, name, settings, "mesh", {} if tolerance is None else {"tolerance": tolerance})


def lines(
    mesh=None, faces=None, *, curves=None, points=None, labels=None, camera=None, look=None, preset=None, name=None, **settings
):
    """Find the visible and the hidden lines of a mesh, exactly, in float64.

    Needs neither OpenGL nor a display. Ctrl-C stops it; other threads keep running.

    Parameters
    ----------
    mesh, faces, name
        As in `tinta_npr.mesh`; a list of meshes makes one scene, of which those read with ``section`` are cut and others stay
        whole. May be left out if curves or points are given.
    curves : list of array_like (K, 3), optional
        Curves in the mesh's coordinates, each a list of positions in order; or an object with ``points`` and ``lines``
        (PyVista). Faces in front hide them; they hide nothing. Their class is ``"curve"``.
    points : array_like (N, 3), optional
        Points, drawn as dots of class ``"point"``.
    labels : sequence of str, optional
        A text for each point, None for a point without one. It stands beside the point where the point is drawn, in SVG and
        PDF.
    camera : optional
        A view's name (``"iso"``, ``"front"``, ``"top"`` …) or ``(azimuth, elevation)`` in degrees; a dict of the settings under
        Camera, such as ``{"eye": (3, 2, 5), "target": (0, 0, 0), "fov": 30}``; ``plotter.camera`` of PyVista; a `trimesh.Scene`;
        matplotlib's `Axes3D`; a matrix from world to pixels (3, 4) or to OpenGL's clip space (4, 4). The default
        is (30, 15), with the whole mesh in view. A matrix that tinta's camera cannot represent (a principal point off the
        middle, oblong pixels) moves the vertices instead; angles of creases are then measured on the moved mesh.
    look : {"technical"}, optional
        Settings that suit one another; those given here override them.
    preset : path, optional
        A TOML file of settings.

    Returns
    -------
    Lines
        With ``segments``, ``cls``, ``visible`` and other arrays, ``labels``, ``svg()``, ``pdf()``, ``png()``, ``save()``,
        ``project()`` for labels of your own, and ``regions()``, the areas between the lines.

    Settings
    --------
    """
    free = (curves, points, labels)
    meshes, settings, moved = _drawn("lines", mesh, faces, name, camera, settings, (None, look, preset), free)
    return Lines(meshes, settings, look, preset, moved, CLASSES)


def edges(mesh, faces=None, *, name=None, **settings):
    """Find the edges of a mesh that count as lines in every view: boundaries, creases, seams.

    Parameters
    ----------
    mesh, faces, name
        As in `tinta_npr.mesh`.

    Returns
    -------
    Edges
        ``vertices`` (N, 2): the numbers of both ends in the given mesh; ``cls`` (N,): the class; ``faces`` (N, 2): the
        adjacent triangles, -1 for none.

    Settings
    --------
    """
    return Edges(_native.edges(_one(mesh, faces, name, settings, "edges"), settings), CLASSES)


def silhouette(mesh, eye, faces=None, *, direction=False, name=None, **settings):
    """Find the edges between a front-facing and a back-facing face, exactly, including hidden ones.

    Parameters
    ----------
    mesh, faces, name
        As in `tinta_npr.mesh`. Given a `Mesh`, a second eye takes less time.
    eye : array_like (3,)
        The viewpoint, in the mesh's coordinates; with `direction` the direction towards a distant viewpoint.

    Returns
    -------
    ndarray (N, 2) of uint32
        The numbers of both ends in the given mesh.

    Settings
    --------
    """
    from ._arrays import vector

    return _native.silhouette(_one(mesh, faces, name, settings, "silhouette"), vector("eye", eye), bool(direction))


def render(
    mesh, faces=None, *, style=None, look=None, preset=None, camera=None, show=None, backend=None, name=None, **settings
):
    """Draw a mesh off-screen with OpenGL, on a graphics card or on the processor.

    The first call opens OpenGL (EGL, OSMesa; on Windows WGL), and raises RuntimeError with the missing parts if it fails.

    Parameters
    ----------
    mesh, faces, name, preset
        As in `tinta_npr.lines`.
    style : str, optional
        One of `tinta_npr.STYLES`.
    look : str, optional
        One of `tinta_npr.LOOKS`; ``"print"`` if style, preset and look are all missing.
    camera : optional
        As in `tinta_npr.lines`; a matrix must be one of a camera with square pixels and its principal point in the middle.
    show : str, optional
        One of the style's pictures: ``"final"``, ``"borders"``, ``"tones"`` …
    backend : {"auto", "egl", "surfaceless", "osmesa", "wgl", "cgl"}, optional
        The way to open OpenGL.

    Returns
    -------
    Picture
        An array (H, W, 4) of uint8: red, green, blue, alpha (straight), the top row first; with ``png()`` and ``save()``.

    Settings
    --------
    """
    basis = (style, look, preset)
    meshes, settings, _ = _drawn("render", mesh, faces, name, camera, settings, basis)
    drawn = _native.render(meshes, settings, style, look, preset, show, backend)
    return Picture(drawn.pixels, drawn.recipe)


def measure(mesh, faces=None, *, styles=(), frames=21, tolerance=1 / 256, camera=None, backend=None, name=None, **settings):
    """Measure styles: the share of visible lines each draws, its false lines, and its time per frame.

    Parameters
    ----------
    mesh, faces, camera, name, backend
        As in `tinta_npr.render`.
    styles : sequence of str or dict, optional
        Styles by name, or with their settings: ``{"style": "ink", "quality": "best"}``. All styles as published by default.
    frames : int
        Number of timed frames for each style.
    tolerance : float
        Distance within which ink and line count as the same, as a share of the picture's height, up to 1/32.

    Returns
    -------
    list of dict
        A row for each style, ready for `pandas.DataFrame`; docs/results/measuring.md explains the columns.

    Settings
    --------
    """
    meshes, settings, _ = _drawn("measure", mesh, faces, name, camera, settings, ("three-pass", None, None))
    if isinstance(styles, (str, dict)):
        styles = [styles]
    asked = [{"style": style} if isinstance(style, str) else dict(style) for style in styles]
    return _native.measure(meshes, asked, settings, int(frames), float(tolerance), backend)


def compare(
    mesh, faces=None, *, left="three-pass", right="inking", tolerance=1 / 256, camera=None, backend=None, name=None, **settings
):
    """Draw a mesh in two styles, and show which lines both drew.

    Parameters
    ----------
    mesh, faces, camera, name, backend
        As in `tinta_npr.render`.
    left, right : str
        Two of `tinta_npr.STYLES` that draw lines.
    tolerance : float
        Distance within which two styles' ink counts as the same, as a share of the picture's height, up to 1/32.

    Returns
    -------
    Comparison
        ``numbers``, a dict, and the pictures ``left``, ``right`` and ``lines``: both dark grey, left alone vermilion, right
        alone blue.

    Settings
    --------
    """
    meshes, settings, _ = _drawn("compare", mesh, faces, name, camera, settings, (left, None, None))
    return Comparison(*_native.compare(meshes, settings, left, right, float(tolerance), backend))


def _one(mesh, faces, name, settings, function, of_parts=()):
    """Returns the single mesh of a function; removes the settings for reading it. `of_parts` are those that only parts have."""
    _native.check(function, settings)
    reading = {**_reading(settings), **dict(of_parts)}
    found = _meshes_of(mesh, faces, name, reading, tuple(reading))
    if len(found) != 1:
        raise ValueError(f"mesh: {function}() takes one mesh, not {len(found)}")
    return found[0]


def _drawn(function, mesh, faces, name, camera, settings, basis, free=(None, None, None)):
    """The meshes of a drawing, its settings with the camera's among them, and the matrix that moved the meshes, if any."""
    settings = dict(settings)
    camera, matrix = _camera_settings(camera, settings, is_exact=function != "lines")
    for key in camera:
        if settings.get(key) is not None:
            raise ValueError(f"camera: it says {key}, which is given too; leave one of them out")
    settings.update(camera)
    _native.check(function, settings)
    asked = _reading(settings)
    reading = {**_native.reading(function, *basis), **asked}
    if reading.get("section") and _says_uncut(settings.get("part")):
        # Silence would cut them, and the drawing's recipe would say that it does not.
        raise ValueError("part: here uncut spares no part; give a list: of what is cut mesh(..., section=...), of the rest the meshes as they are")
    of_curves = _mesh_of_curves(*free, reading)
    if mesh is None and of_curves is None:
        raise TypeError("mesh: it is missing; give a mesh, curves or points")
    if _cad.is_among(mesh) and (matrix is not None or any(settings.get(key) is not None for key in ("eye", "target", "up"))):
        # Such a camera is in the part's own coordinates.
        reading["up_axis"] = reading.get("up_axis") or "y"
    meshes = [] if mesh is None else _meshes_of(mesh, faces, name, reading, tuple(asked))
    meshes = meshes + ([] if of_curves is None else [of_curves])
    if matrix is None:
        return meshes, settings, None
    if reading.get("up_axis") not in (None, "auto", "y"):
        raise ValueError("up_axis: a camera's matrix is in the mesh's own coordinates; leave one of them out")
    meshes, camera, moved_from_mesh = matrix.of_meshes(meshes, reading)
    settings.update(camera)
    return meshes, settings, moved_from_mesh


def _says_uncut(part):
    """Whether rules for parts, as text, a list or a dict, leave one whole in a section."""
    if hasattr(part, "items"):
        return any(hasattr(rule, "items") and rule.get("uncut") for rule in part.values())
    if isinstance(part, (list, tuple)):
        return any(map(_says_uncut, part))
    return part is not None and _re.search(r"[:,]\s*uncut\s*([,;]|$)", str(part)) is not None


def _reading(settings):
    """Removes and returns the settings for reading a mesh."""
    found = {key: settings.pop(key) for key in list(settings) if key.replace("-", "_") in _READING}
    if found.get("section") is not None:
        found["section"] = _in_its_axes(found["section"])
    return {key: value for key, value in found.items() if value is not None}


def _in_its_axes(section):
    """Planes in the axes of the given mesh, as the command line reads them; a plane alone is one in tinta's axes, whose cut has no hatching."""
    if isinstance(section, (list, tuple)):
        return list(map(_in_its_axes, section))
    if not isinstance(section, str):
        return section
    planes = map(str.strip, section.split(";"))
    return "; ".join(f"file:{plane}" if "=" in plane and not plane.startswith("file:") else plane for plane in planes)


_READING = frozenset(setting["name"] for setting in _native.settings("mesh"))


# Several functions share a table.
_settings_of, _documentation_of = map(_functools.cache, (_native.settings, _native.documentation))


def _with_settings(function, name):
    """Gives a function the settings of `name` in its signature and its help, as editors show them."""
    signature = _inspect.signature(function)
    own = [one for one in signature.parameters.values() if one.kind is not one.VAR_KEYWORD]
    named = {one.name for one in own}
    settings = [
        _inspect.Parameter(setting["name"], _inspect.Parameter.KEYWORD_ONLY, default=None)
        for setting in _settings_of(name) if setting["name"] not in named
    ]
    function.__signature__ = signature.replace(parameters=own + settings)
    # Newer Pythons store a docstring without its indentation.
    if "\nSettings\n" in (document := _inspect.cleandoc(function.__doc__)):
        document = document.replace("FORMATS", ", ".join(_native.names("format")))
        function.__doc__ = document.rstrip() + "\n" + _documentation_of(name)


for _function in (mesh, lines, edges, silhouette, render, measure, compare):
    _with_settings(_function, _function.__name__)
for _name in ("svg", "pdf", "png", "save", "layers"):
    _with_settings(getattr(Lines, _name), "Lines.svg")
_with_settings(Lines.regions, "Lines.regions")
for _name in ("svg", "pdf", "save"):
    _with_settings(getattr(Regions, _name), "Lines.svg")


def __getattr__(name):
    # The modules that need matplotlib and PyVista are imported on first use.
    if name in ("mpl", "pv"):
        import importlib

        return importlib.import_module(f".{name}", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__():
    return sorted({*globals(), "mpl", "pv"})
