"""Cameras, converted to tinta's settings, or to a matrix that gives the settings once the meshes are known."""

import math

import numpy as np

from . import _mesh, _native

_NAMES = frozenset(_native.camera_names())

#: Counts as 0 beside lengths of about 1: matrices come from products of a few f64.
_NOTHING = 1e-9
_MIRRORED = "camera: this matrix mirrors the picture; turn the sign of one of its first two rows"


def settings_of(camera, settings, is_exact):
    """Returns a camera's settings, and a `Matrix` if they depend on the meshes; `is_exact` refuses matrices that move meshes."""
    if camera is None:
        return {}, None
    if isinstance(camera, str):
        return {"view": camera}, None
    if hasattr(camera, "items"):
        for key in camera:
            if key.replace("-", "_") not in _NAMES:
                raise ValueError(f"camera: it has no {key}; choose from {', '.join(sorted(_NAMES))}")
        return {key.replace("-", "_"): value for key, value in camera.items() if value is not None}, None
    if hasattr(camera, "get_proj") and hasattr(camera, "transData"):
        refuse_scales(camera)
        return {}, of_axes(camera, settings)
    if isinstance(camera, Matrix):
        return {}, camera
    if hasattr(camera, "position") and hasattr(camera, "focal_point"):
        return _of_vtk(camera), None
    if hasattr(camera, "camera_transform") and hasattr(camera, "camera"):
        return _of_pose(camera.camera_transform, camera.camera.fov[1]), None
    try:
        array = np.asarray(camera, dtype=np.float64)
    except (ValueError, TypeError):
        array = np.empty(0)
    if array.shape in ((2,), (3, 3), (3, 4), (4, 4)) and not np.isfinite(array).all():
        raise ValueError("camera: a number of it is not finite")
    if array.shape == (2,):
        return {"view": array.tolist()}, None
    if array.shape == (3, 3):
        return dict(zip(("eye", "target", "up"), array.tolist())), None
    size = size_of(settings)
    if array.shape == (3, 4):
        return {}, Matrix(array, size, is_exact)
    if array.shape == (4, 4):
        width, height = size
        x, y, depth, w = array
        return {}, Matrix(np.array([(x + w) * width / 2, (w - y) * height / 2, w]), size, is_exact, depth[:3])
    given = f"an array {array.shape}" if array.size else type(camera).__name__
    raise TypeError(
        "camera: give a view's name, a dict, a PyVista camera, a trimesh.Scene, an Axes3D, a matrix (3, 4) from world to pixels "
        f"or (4, 4) to clip space, or (eye, target, up), not {given}"
    )


def _of_vtk(camera):
    """PyVista's camera, or its camera position."""
    up = camera.up if hasattr(camera, "up") else camera.viewup
    settings = {"eye": tuple(camera.position), "target": tuple(camera.focal_point), "up": tuple(up)}
    if getattr(camera, "parallel_projection", False):
        settings.update(parallel=True, height=2.0 * camera.parallel_scale)
    elif hasattr(camera, "view_angle"):
        settings["fov"] = camera.view_angle
    return settings


def _of_pose(world_from_camera, fov):
    """A camera that looks along its own -z, y up."""
    pose = np.asarray(world_from_camera, dtype=np.float64)
    eye, back, up = pose[:3, 3], pose[:3, 2], pose[:3, 1]
    return {"eye": eye.tolist(), "target": (eye - back).tolist(), "up": up.tolist(), "fov": float(fov)}


def size_of(settings):
    """The picture's width and height from the settings."""
    size = settings.get("size")
    if size is None:
        size = next(entry["default"] for entry in _native.settings("lines") if entry["name"] == "size")
    if isinstance(size, str):
        size = size.lower().replace("x", ",").split(",")
    try:
        sides = [int(side) for side in np.ravel(size)]
    except (ValueError, TypeError):
        sides = []
    if len(sides) not in (1, 2) or min(sides) < 1:
        raise ValueError(f"size: {settings['size']!r} is no width and height in pixels")
    return sides[0], sides[-1]


def scaled_axes(axes):
    """The names of the axes whose scale, such as a logarithmic one, matplotlib applies before its matrix; before 3.11 it applied none."""
    return [name for name in "xyz" if hasattr(axes, "_get_scaled_limits") and getattr(axes, f"get_{name}scale")() != "linear"]


def refuse_scales(axes):
    """Refuses axes on which a flat face may be none."""
    for name in scaled_axes(axes):
        raise ValueError(f"camera: the {name} axis has a scale that bends faces; give linear axes")


def of_axes(axes, settings):
    """The view of matplotlib's 3-D axes, in a picture with one pixel per point, which makes widths points."""
    if axes.name != "3d":
        raise TypeError("camera: these are 2-D axes; give an Axes3D, or another camera")
    points = 72.0 / axes.figure.dpi
    box = axes.bbox
    size = max(1, math.ceil(box.width * points)), max(1, math.ceil(box.height * points))
    if settings.get("size") is not None:
        size = size_of(settings)
    settings["size"] = size
    (left, bottom), (right, top) = axes.transData.inverted().transform([(box.x0, box.y0), (box.x1, box.y1)])
    x, y, _, w = axes.get_proj()
    x = (x - left * w) * (size[0] / (right - left))
    y = (top * w - y) * (size[1] / (top - bottom))
    return Matrix(np.array([x, y, w]), size, False)


class Matrix:
    """A matrix (3, 4) from world to pixels, y down: (x w, y w, w), with w above 0 in front of the eye."""

    def __init__(self, pixels_from_world, size, is_exact, away=None):
        """`away` is the direction of growing depth, if the matrix has one."""
        self._matrix, self._size, self._is_exact, self._away = pixels_from_world, size, is_exact, away
        linear = np.abs(pixels_from_world[:, :3])
        if not linear[:2].any(axis=1).all():
            raise ValueError("camera: this matrix shows everything at one point")

    def of_meshes(self, meshes, reading):
        """The meshes to draw, their settings, and the matrix (3, 4) that moved them to give tinta's camera the same view."""
        corners = np.concatenate([_box(np.concatenate([mesh.vertices, mesh.free])) for mesh in meshes])
        far = np.abs(corners).max()
        is_parallel = np.abs(self._matrix[2, :3]).max() * far <= _NOTHING * abs(self._matrix[2, 3])
        rotation, moved, scale, eye = (_parallel if is_parallel else _perspective)(self._matrix, self._size, corners)
        if is_parallel and self._away is not None and rotation[2] @ self._away < 0:
            raise ValueError(_MIRRORED)
        height = self._size[1] / scale
        settings = {"parallel": True, "height": height} if is_parallel else {"fov": math.degrees(2 * math.atan(height / 2))}
        if np.abs(moved - np.eye(3)).max() <= 1e3 * _NOTHING:
            target = eye + rotation[2] * max(np.abs(corners - eye).max(), far)
            settings.update(eye=eye.tolist(), target=target.tolist(), up=(-rotation[1]).tolist())
            return meshes, settings, None
        if self._is_exact:
            raise ValueError(
                "camera: pictures are drawn with square pixels and the principal point in the middle, which this matrix has not; "
                "lines() takes it"
            )
        through = moved @ rotation
        # The settings that still apply to moved vertices.
        kept = {key: value for key, value in reading.items() if key in ("normals", "smooth_angle")}

        def in_view(mesh):
            surface = mesh
            if len(mesh.faces):
                surface = _mesh.of_arrays((mesh.vertices - eye) @ through.T, mesh.faces, mesh.name, kept).with_faces_of(mesh)
            return surface.with_curves_of(mesh, np.ascontiguousarray((mesh.free - eye) @ through.T)) if len(mesh.free) else surface

        meshes = [in_view(mesh) for mesh in meshes]
        moved_from_mesh = np.column_stack([through, -through @ eye])
        return meshes, {**settings, "eye": (0, 0, 0), "target": (0, 0, 1), "up": (0, -1, 0)}, moved_from_mesh


def _box(points):
    """The corners of the box around points."""
    ends = np.array([points.min(axis=0), points.max(axis=0)])
    return np.array([[ends[corner >> axis & 1][axis] for axis in range(3)] for corner in range(8)])


def _perspective(matrix, size, _corners):
    """The eye's axes (right, down, forward), the transformation to square pixels with the middle straight ahead, the pixels
    across one unit at distance 1, and the eye."""
    matrix = matrix / np.linalg.norm(matrix[2, :3])
    linear = matrix[:, :3]
    if abs(np.linalg.det(linear)) <= _NOTHING * np.prod(np.linalg.norm(linear, axis=1)):
        raise ValueError("camera: this matrix has no eye: its rows lie in a plane")
    rotation, shape = _axes(linear)
    scale = shape[1, 1]
    wanted = np.array([[scale, 0, size[0] / 2], [0, scale, size[1] / 2], [0, 0, 1]])
    return rotation, np.linalg.solve(wanted, shape), scale, np.linalg.solve(linear, -matrix[:, 3])


def _parallel(matrix, size, corners):
    """The same for a parallel projection, with an eye in front of all corners."""
    if matrix[2, 3] <= 0:
        raise ValueError("camera: this matrix has everything behind the eye")
    across, offset = matrix[:2, :3] / matrix[2, 3], matrix[:2, 3] / matrix[2, 3]
    forward = np.cross(*across)
    if np.linalg.norm(forward) <= _NOTHING * np.prod(np.linalg.norm(across, axis=1)):
        raise ValueError("camera: this matrix shows everything on a line")
    rotation, shape = _axes(np.vstack([across, forward / np.linalg.norm(forward)]))
    depths = corners @ rotation[2]
    middle = np.linalg.solve(shape[:2, :2], np.array(size) / 2 - offset)
    eye = np.array([*middle, 2 * depths.min() - depths.max() - np.ptp(corners, axis=0).max()]) @ rotation
    moved = np.eye(3)
    moved[:2, :2] = shape[:2, :2] / shape[1, 1]
    return rotation, moved, shape[1, 1], eye


def _axes(linear):
    """Splits a matrix whose last row is a unit vector into right, down and forward, and an upper triangular matrix."""
    forward = linear[2]
    middle = linear[:2] @ forward
    across = linear[:2] - np.outer(middle, forward)
    down_scale = np.linalg.norm(across[1])
    down = across[1] / down_scale
    skew = across[0] @ down
    right = across[0] - skew * down
    right_scale = np.linalg.norm(right)
    right = right / right_scale
    if np.cross(right, down) @ forward < 0:
        raise ValueError(_MIRRORED)
    shape = np.array([[right_scale, skew, middle[0]], [0, down_scale, middle[1]], [0, 0, 1]])
    return np.array([right, down, forward]), shape
