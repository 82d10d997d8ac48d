"""Feature edges and silhouettes by VTK and numpy: vtk_edges.py POINTS TRIANGLES REPEATS

POINTS holds three float64 a vertex, TRIANGLES three int64 a face. Prints one JSON object with the milliseconds of each
repeat and the counts found. The feature angle is the one whose cosine is 0.4. The eye walks around the model at 1.5
bounding-box diagonals, 0.1 radians a step, as benches/edges.rs walks.
"""
import json
import sys
import time

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray

points = np.fromfile(sys.argv[1]).reshape(-1, 3)
triangles = np.fromfile(sys.argv[2], dtype=np.int64).reshape(-1, 3)
repeats = int(sys.argv[3])
angle = float(np.degrees(np.arccos(0.4)))
low, high = points.min(0), points.max(0)
middle, diagonal = (low + high) / 2, np.linalg.norm(high - low)


def eye(step):
    return middle + diagonal * np.array([1.5 * np.sin(0.1 * step), 0.3, 1.5 * np.cos(0.1 * step)])


def poly_data():
    coordinates = vtk.vtkPoints()
    coordinates.SetData(numpy_to_vtk(points.astype(np.float32), deep=1))
    cells = vtk.vtkCellArray()
    cells.SetData(3, numpy_to_vtkIdTypeArray(triangles.ravel(), deep=1))
    data = vtk.vtkPolyData()
    data.SetPoints(coordinates)
    data.SetPolys(cells)
    return data


def timed(prepare, work):
    times, result = [], None
    for step in range(repeats + 1):
        argument = prepare(step)
        start = time.perf_counter()
        result = work(argument)
        times.append((time.perf_counter() - start) * 1e3)
    return times[1:], result


def feature_edges(data):
    edges = vtk.vtkFeatureEdges()
    edges.SetInputData(data)
    edges.SetFeatureAngle(angle)
    edges.ColoringOff()
    edges.BoundaryEdgesOn()
    edges.FeatureEdgesOn()
    edges.NonManifoldEdgesOn()
    edges.ManifoldEdgesOff()
    edges.Update()
    return edges.GetOutput().GetNumberOfLines()


def numpy_edges(_):
    normals = np.cross(points[triangles[:, 1]] - points[triangles[:, 0]], points[triangles[:, 2]] - points[triangles[:, 0]])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    a, b = triangles.ravel(), triangles[:, [1, 2, 0]].ravel()
    keys = (np.minimum(a, b) << 32) | np.maximum(a, b)
    order = np.argsort(keys, kind="stable")
    keys, faces = keys[order], order // 3
    starts = np.flatnonzero(np.r_[True, keys[1:] != keys[:-1]])
    counts = np.diff(np.r_[starts, len(keys)])
    inner = starts[counts == 2]
    numpy_edges.found = (faces[inner].astype(np.int32), faces[inner + 1].astype(np.int32), normals)
    creases = int(((normals[faces[inner]] * normals[faces[inner + 1]]).sum(1) < 0.4).sum())
    return int((counts != 2).sum()) + creases


silhouette = vtk.vtkPolyDataSilhouette()
silhouette.SetInputData(poly_data())
silhouette.SetEnableFeatureAngle(0)
silhouette.BorderEdgesOff()


def camera(step):
    view = vtk.vtkCamera()
    view.SetPosition(*eye(step))
    view.SetFocalPoint(*middle)
    return view


def vtk_silhouette(view):
    silhouette.SetCamera(view)
    silhouette.Update()
    return silhouette.GetOutput().GetNumberOfLines()


feature_times, feature_count = timed(lambda _: poly_data(), feature_edges)
numpy_times, numpy_count = timed(lambda _: None, numpy_edges)
silhouette_times, silhouette_count = timed(camera, vtk_silhouette)
first, second, normals = numpy_edges.found
planes = np.c_[normals, -(normals * points[triangles[:, 0]]).sum(1)].astype(np.float32)


def numpy_silhouette(position):
    front = planes @ np.append(position, 1).astype(np.float32) > 0
    return len(np.flatnonzero(front[first] != front[second]))


numpy_silhouette_times, numpy_silhouette_count = timed(eye, numpy_silhouette)
print(json.dumps({
    "vtk": vtk.VTK_VERSION,
    "numpy": np.__version__,
    "feature_edges_ms": feature_times,
    "feature_edges": feature_count,
    "numpy_edges_ms": numpy_times,
    "numpy_edges": numpy_count,
    "silhouette_ms": silhouette_times,
    "silhouette": silhouette_count,
    "numpy_silhouette_ms": numpy_silhouette_times,
    "numpy_silhouette": numpy_silhouette_count,
}))
