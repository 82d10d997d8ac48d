"""The league's cameras: one matrix from world to clip space for each view, and the same camera in words that programs take."""

import json
import math

import numpy as np

SIZE = 512
FOV_Y_DEGREES = 30.0

# Azimuth and elevation, as `tinta render --view` has them.
VIEWS = {"front": (0, 0), "30,15": (30, 15), "top": (0, 90)}


def around():
    """The 26 directions of a cube's faces, edges and corners."""
    directions = [(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1) if (x, y, z) != (0, 0, 0)]
    return {
        f"{x},{y},{z}": (math.degrees(math.atan2(x, z)), math.degrees(math.atan2(y, math.hypot(x, z)))) for x, y, z in directions
    }


def camera(points, azimuth_degrees, elevation_degrees):
    """A camera that looks at the middle of the points' box from where its ball fills the picture."""
    azimuth, elevation = math.radians(azimuth_degrees), math.radians(elevation_degrees)
    backward = np.array([math.sin(azimuth) * math.cos(elevation), math.sin(elevation), math.cos(azimuth) * math.cos(elevation)])
    up = np.array([-math.sin(azimuth) * math.sin(elevation), math.cos(elevation), -math.cos(azimuth) * math.sin(elevation)])
    target = (points.min(0) + points.max(0)) / 2
    radius = np.linalg.norm(points - target, axis=1).max()
    half = math.radians(FOV_Y_DEGREES) / 2
    distance = radius / math.sin(half) * 1.02
    near, far = distance - 1.1 * radius, distance + 1.1 * radius
    eye = target + distance * backward
    right = np.cross(up, backward)
    view = np.eye(4)
    view[:3, :3] = [right, up, backward]
    view[:3, 3] = -view[:3, :3] @ eye
    zoom = 1 / math.tan(half)
    clip = np.array(
        [[zoom, 0, 0, 0], [0, zoom, 0, 0], [0, 0, -(far + near) / (far - near), -2 * far * near / (far - near)], [0, 0, -1, 0]]
    )
    return {
        "clip_from_world": (clip @ view).tolist(),
        "view_from_world": view.tolist(),
        "eye": eye.tolist(),
        "target": target.tolist(),
        "up": up.tolist(),
        "right": right.tolist(),
        "backward": backward.tolist(),
        "distance": float(distance),
        "fov_y_degrees": FOV_Y_DEGREES,
        "near": float(near),
        "far": float(far),
        "size": SIZE,
    }


def write(camera_now, folder, name):
    """Writes NAME.txt, the matrix, which tinta takes, and NAME.json, all of it, which the other programs' scripts take."""
    folder.mkdir(parents=True, exist_ok=True)
    matrix = folder / f"{name}.txt"
    matrix.write_text("\n".join(" ".join(repr(number) for number in row) for row in camera_now["clip_from_world"]) + "\n")
    words = folder / f"{name}.json"
    words.write_text(json.dumps(camera_now, indent=1) + "\n")
    return matrix, words
