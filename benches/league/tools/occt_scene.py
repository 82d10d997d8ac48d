"""A mesh as OCCT's shape, the league's camera as its projector, and its edges as an SVG."""

import math
from importlib.metadata import version as package_version

import numpy as np
from common import CREASE_DEGREES, edges, write_svg
from OCP.BRep import BRep_Builder
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakeVertex, BRepBuilderAPI_MakeWire
from OCP.BRepLib import BRepLib
from OCP.GeomAbs import GeomAbs_C0, GeomAbs_G1
from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt
from OCP.HLRAlgo import HLRAlgo_Projector
from OCP.TopAbs import TopAbs_EDGE
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS, TopoDS_Shell


def version():
    """The package's version, which is OCCT's."""
    return f"OCCT {package_version('cadquery-ocp-novtk')}"


def in_perspective(points, camera):
    """Points moved so that a parallel projection along the axis shows them as the camera does; straight lines stay straight."""
    axes = np.array([camera["right"], camera["up"], camera["backward"]])
    seen = (points - camera["target"]) @ axes.T
    return seen * (camera["distance"] / (camera["distance"] - seen[:, 2:]))


def shell(points, triangles, angles_of, smooth=GeomAbs_G1):
    """One shell of plane triangles with shared corners and edges; edges below the crease angle are marked as `smooth`.

    `angles_of` are the points whose faces tell what a crease is.
    """
    builder = BRep_Builder()
    shape = TopoDS_Shell()
    builder.MakeShell(shape)
    corners = [BRepBuilderAPI_MakeVertex(gp_Pnt(*point)).Vertex() for point in points.tolist()]
    pairs, both, counts, angles = edges(angles_of, triangles)
    lines = {(a, b): BRepBuilderAPI_MakeEdge(corners[a], corners[b]).Edge() for a, b in pairs.tolist()}
    faces = []
    for triangle in triangles.tolist():
        wire = BRepBuilderAPI_MakeWire()
        for a, b in zip(triangle, triangle[1:] + triangle[:1]):
            line = lines[min(a, b), max(a, b)]
            wire.Add(line if a < b else TopoDS.Edge(line.Reversed()))
        face = BRepBuilderAPI_MakeFace(wire.Wire(), True)
        faces.append(face.Face() if face.IsDone() else None)
        if face.IsDone():
            builder.Add(shape, faces[-1])
    for (a, b), (first, second), count, angle in zip(pairs.tolist(), both.tolist(), counts.tolist(), angles.tolist()):
        if count == 2 and faces[first] is not None and faces[second] is not None:
            continuity = smooth if angle < CREASE_DEGREES else GeomAbs_C0
            builder.Continuity(lines[a, b], faces[first], faces[second], continuity)
    return shape


def perspective(camera):
    """OCCT's own perspective on the plane through the target, the eye at its distance."""
    axes = gp_Ax2(gp_Pnt(*camera["target"]), gp_Dir(*camera["backward"]), gp_Dir(*camera["right"]))
    return HLRAlgo_Projector(axes, camera["distance"])


def parallel():
    """Along the z axis of points that were put in perspective."""
    return HLRAlgo_Projector(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1), gp_Dir(1, 0, 0)))


def edges_of(compound):
    """Ends of each edge in the projector's plane; curves do not occur, for all faces are plane."""
    if compound is None or compound.IsNull():
        return []
    BRepLib.BuildCurves3d_s(compound)
    ends, explorer = [], TopExp_Explorer(compound, TopAbs_EDGE)
    while explorer.More():
        curve = BRepAdaptor_Curve(TopoDS.Edge(explorer.Current()))
        a, b = curve.Value(curve.FirstParameter()), curve.Value(curve.LastParameter())
        ends.append((a.X(), a.Y(), b.X(), b.Y()))
        explorer.Next()
    return ends


def write(path, camera, groups):
    """The ends in pixels, y down."""
    size = camera["size"]
    scale = size / 2 / (camera["distance"] * math.tan(math.radians(camera["fov_y_degrees"]) / 2))
    middle = size / 2
    pixels = [
        (middle + ax * scale, middle - ay * scale, middle + bx * scale, middle - by * scale)
        for group in groups
        for ax, ay, bx, by in group
    ]
    write_svg(path, pixels, size)
