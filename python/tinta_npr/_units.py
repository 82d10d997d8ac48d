"""Pixels in the model's units: places on the drawing, and the surfaces of faces that are seen."""

import math

import numpy as np

from . import _native


def axes(camera):
    """The directions right, up and forward of a camera."""
    forward = np.subtract(camera["target"], camera["eye"])
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, camera["up"])
    right = right / np.linalg.norm(right)
    return right, np.cross(right, forward), forward


def _shares(places, size):
    """Places in pixels, y down, as shares of half the picture's height from its middle: to the right and up."""
    width, height = size
    return (places - (width / 2, height / 2)) * (2 / height, -2 / height)


def on_the_drawing(camera, size):
    """The function from pixels to the model's units, along the picture's right and upper side from the model's origin."""
    if "height" not in camera:
        raise ValueError("units: an area far away is smaller by perspective; find the lines with parallel=True, or ask for pixels")
    right, up, _ = axes(camera)
    origin = np.array([right @ camera["eye"], up @ camera["eye"]])
    return lambda places: origin + _shares(places, size) * (camera["height"] / 2)


def seen_surfaces(lines, by):
    """The surface that is seen of each face, material or object, in the model's units: a dict."""
    meshes, settings, *_ = lines._asked
    if settings.get("part") is not None:
        raise ValueError("part: the surface of parts that hide otherwise is not known; leave part out")
    solid = [(number, mesh) for number, mesh in enumerate(meshes) if len(mesh.faces)]
    flat = [_native.Mesh.of_arrays(mesh.vertices, mesh.faces.astype(np.int64).reshape(-1), None, "mesh", {"weld": 0}) for _, mesh in solid]
    asked = {**lines.camera, "size": lines.size, "areas": "object", "no_borders": True}
    of_triangles = _native.regions(_native.lines(flat, asked), "face", {}, None, None)
    columns = of_triangles.arrays()
    # Of triangles without area, some may be gone.
    places = [dict(zip(mesh.file_faces.tolist(), mesh.vertices[mesh.faces])) for mesh in flat]
    pieces = {}
    for number, triangle, loops in zip(columns["object"].tolist(), columns["face"].tolist(), of_triangles.loops()):
        if number >= 0:
            seen = _surface(loops, places[number][triangle], lines)
            pieces[number, triangle] = pieces.get((number, triangle), 0.0) + seen
    sums = {}
    for (number, triangle), seen in pieces.items():
        given, mesh = solid[number]
        key = given, int(mesh.file_faces[triangle])
        # Seen nearly from its side, a triangle shows a hundredth of a pixel too much or too little.
        sums[key] = sums.get(key, 0.0) + min(seen, _whole(places[number][triangle], lines))
    if by == "face":
        return sums
    areas = lines.regions("face")
    materials = dict(zip(zip(areas.object.tolist(), areas.face.tolist()), areas.material.tolist()))
    joined = {}
    for (number, face), surface in sums.items():
        key = number if by == "object" else (number, materials.get((number, face), -1))
        joined[key] = joined.get(key, 0.0) + surface
    return joined


def _whole(corners, lines):
    """The surface of a triangle in the model's units."""
    if lines._moved_from_mesh is not None:
        corners = np.linalg.solve(lines._moved_from_mesh[:, :3], corners.T).T
    return float(np.linalg.norm(np.cross(corners[1] - corners[0], corners[2] - corners[0]))) / 2


def _surface(loops, corners, lines):
    """The surface of a part of a triangle that is seen as these loops."""
    right, up, forward = axes(lines.camera)
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    total = np.zeros(3)
    moved = lines._moved_from_mesh
    for loop in loops:
        across = _shares(loop, lines.size)
        if "height" in lines.camera:
            start = lines.camera["eye"] + across * (lines.camera["height"] / 2) @ np.array([right, up])
            rays = np.broadcast_to(forward, start.shape)
        else:
            rays = forward + across * math.tan(math.radians(lines.camera["fov"]) / 2) @ np.array([right, up])
            start = np.broadcast_to(lines.camera["eye"], rays.shape)
        places = start + rays * ((corners[0] - start) @ normal / (rays @ normal))[:, None]
        if moved is not None:
            places = np.linalg.solve(moved[:, :3], (places - moved[:, 3]).T).T
        places = places - places[0]
        total += np.cross(places, np.roll(places, -1, axis=0)).sum(axis=0)
    return float(np.linalg.norm(total)) / 2
