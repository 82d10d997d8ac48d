"""The league's models: their names and hashes, and one plain triangle mesh of each, which every program is given.

The files are fetched by whoever runs this and are never part of the project. Each becomes an OBJ file of triangles whose corners at
the same place are one vertex, so that no program suffers from how a file was written: y is up, nothing has a normal or a material.
"""

import hashlib
import math
import struct
from pathlib import Path

import numpy as np

# Name, file, SHA-256, where it is found.
FETCHED = [
    ("ant", "ant.ply", "1e825c23c85588c9ea8d31b53e09791a6cd20fa9f835e98d4c61389e4209a73b", "PyVista's example data"),
    ("beethoven", "beethoven.obj", "f5ca9dbd3cc2230453ef34eff81779ec526e2c89b2bcdede8a60f176e6de1271", "rezaali/webgl-sketches"),
    ("cow", "cow.obj", "69afce548640bc2beb0c44894d1a24d5766cc9cd3fd74f3ec55b4e229104b23f", "alecjacobson/common-3d-test-models"),
    ("faerie", "faerie.md2", "269c88ae49b744d571941ed6065fc8de598954d20fee5d532e8b12790daec779", "Debian's assimp-testmodels"),
    ("fandisk", "fandisk.obj", "ea5bab2fbf545b1915f0d9faf6cc61ff8c18e0d8174ad61f8e35de15d8f6e3f8", "alecjacobson/common-3d-test-models"),
    ("spot", "spot/spot_triangulated.obj", "0738b5e8608fed74e5e8c7aa8dd0af97b4b74f9f6cbf7aac84cd7e40b2e44a75", "Keenan Crane's 3D model repository"),
    ("bunny", "stanford-bunny.obj", "1eb35d1e21ce99e5ce911353b6be278990713448dd9e8f5c9387f9de39b32205", "alecjacobson/common-3d-test-models"),
    ("suzanne", "suzanne.obj", "d8684326f9bd8cfc24d3d302c1042fa16f63d2e66e49ed56b413fa20bed271e6", "alecjacobson/common-3d-test-models"),
    ("teapot", "teapot.obj", "1b5396fedd74b577e32cef41146582c2f2e1a050d5b4915193c0ac1ad4187ed4", "alecjacobson/common-3d-test-models"),
]

# Corners closer than this share of the model's size are one vertex.
WELD = 1e-7


def sphere():
    """A sphere of 48 x 24 squares, each two triangles."""
    return grid(48, 24, lambda u, v: (math.cos(u) * math.sin(v / 2), math.cos(v / 2), math.sin(u) * math.sin(v / 2)))


def torus():
    """A torus of 48 x 24 squares, each two triangles."""
    return grid(48, 24, lambda u, v: ((1 + 0.4 * math.cos(v)) * math.cos(u), 0.4 * math.sin(v), -(1 + 0.4 * math.cos(v)) * math.sin(u)))


def grid(columns, rows, point):
    """The surface of `point` over two angles from 0 to two pi."""
    points = [point(2 * math.pi * i / columns, 2 * math.pi * j / rows) for j in range(rows + 1) for i in range(columns + 1)]
    triangles = []
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            b, c, d = a + 1, a + columns + 2, a + columns + 1
            triangles += [(a, b, c), (a, c, d)]
    return np.array(points), np.array(triangles)


def stairs():
    """Ten boxes, each higher than the one before, in a circle; neighbours cut one another."""
    points, triangles = [], []
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    for step in range(10):
        x, z, height = 1.5 * math.cos(0.6 * step), 1.5 * math.sin(0.6 * step), 0.2 + 0.2 * step
        first = len(points)
        points += [(x + 0.7 * (k & 1), height * (k >> 1 & 1), z + 0.6 * (k >> 2)) for k in range(8)]
        for a, b, c, d in sides:
            triangles += [(first + a, first + c, first + b), (first + a, first + d, first + c)]
    return np.array(points), np.array(triangles)


MADE = {"sphere": sphere, "torus": torus, "stairs": stairs}


def prepare(name, models_folder, folder):
    """The path of `folder`/NAME.obj, written if it is not there yet."""
    path = folder / f"{name}.obj"
    if path.exists():
        return path
    points, triangles = MADE[name]() if name in MADE else read(name, models_folder)
    points, triangles = weld(points, triangles)
    folder.mkdir(parents=True, exist_ok=True)
    lines = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in points] + [f"f {a} {b} {c}" for a, b, c in triangles + 1]
    path.write_text("\n".join(lines) + "\n")
    return path


def read(name, models_folder):
    """A fetched model's points and triangles, if it is the file that is meant."""
    _, file, expected, source = next(model for model in FETCHED if model[0] == name)
    path = Path(models_folder) / file
    if not path.is_file():
        raise SystemExit(f"{path} is missing; it comes from {source}")
    data = path.read_bytes()
    found = hashlib.sha256(data).hexdigest()
    if found != expected:
        raise SystemExit(f"{path} is another file than the league's: its SHA-256 is {found}, not {expected}")
    return {".obj": read_obj, ".ply": read_ply, ".md2": read_md2}[path.suffix](data)


def read_obj(data):
    """Positions and faces of an OBJ file; polygons as fans."""
    points, triangles = [], []
    for line in data.decode("utf-8", "replace").splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            points.append([float(word) for word in words[1:4]])
        elif words[0] == "f":
            corners = [int(word.split("/")[0]) for word in words[1:]]
            corners = [corner - 1 if corner > 0 else len(points) + corner for corner in corners]
            triangles += [(corners[0], b, c) for b, c in zip(corners[1:], corners[2:])]
    return np.array(points), np.array(triangles)


def read_ply(data):
    """Positions and triangles of a PLY file with the libraries' own reader."""
    import io

    import trimesh

    mesh = trimesh.load(io.BytesIO(data), file_type="ply", process=False)
    return np.array(mesh.vertices, dtype=float), np.array(mesh.faces)


def read_md2(data):
    """The first frame of an MD2 file; its z is up, and its triangles are clockwise from outside."""
    header = struct.unpack_from("<17i", data)
    vertex_count, triangle_count, triangles_at, frames_at = header[6], header[8], header[13], header[14]
    scale = np.array(struct.unpack_from("<3f", data, frames_at))
    translate = np.array(struct.unpack_from("<3f", data, frames_at + 12))
    packed = np.frombuffer(data, np.uint8, vertex_count * 4, frames_at + 40).reshape(-1, 4)[:, :3]
    x, y, z = (packed * scale + translate).T
    corners = np.frombuffer(data, "<u2", triangle_count * 6, triangles_at).reshape(-1, 6)[:, [0, 2, 1]]
    return np.c_[x, z, -y], corners.astype(int)


def weld(points, triangles):
    """Corners at one place as one vertex; triangles without area, and corners of none, left out."""
    size = np.ptp(points, axis=0).max()
    _, first, index = np.unique(np.round(points / (size * WELD)), axis=0, return_index=True, return_inverse=True)
    triangles = index.reshape(-1)[triangles]
    corners = points[first][triangles]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    triangles = triangles[area > (size * WELD) ** 2]
    used, index = np.unique(triangles, return_inverse=True)
    return points[first][used], index.reshape(triangles.shape)
