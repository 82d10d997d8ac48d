#!/usr/bin/env python3
"""Makes the shapes of the tests of tangent edges with OpenCASCADE.

    pip install build123d
    python3 crates/tinta-geometry/tests/edges/tangent_shapes.py crates/tinta-geometry/tests/edges/tangent_shapes

Each file is a binary PLY in f32, whose faces have the number of their surface. A comment names each pair of surfaces that join
smoothly, with its kind: `flat` where one of them is a plane, `round` between cylinders, cones, spheres and tori, `free` where one of
them is none of these.
"""

import math
import struct
import sys
from pathlib import Path

from build123d import *
from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Surface
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.BRepTools import BRepTools
from OCP.GeomAbs import GeomAbs_Cone, GeomAbs_Cylinder, GeomAbs_Plane, GeomAbs_Sphere, GeomAbs_Torus
from OCP.GeomLProp import GeomLProp_SLProps
from OCP.TopAbs import TopAbs_Orientation
from OCP.TopLoc import TopLoc_Location

# Largest distance of a triangle from its surface, millimetres, and largest turn between two, radians.
TOLERANCES = [(0.1, 0.5), (0.1, 0.2), (0.01, 0.1)]
# Most triangles of a file. Of a shape of more an eighth or a quarter around z is written, or nothing.
LARGEST = 800
KINDS = {GeomAbs_Plane: "plane", GeomAbs_Cylinder: "cylinder", GeomAbs_Cone: "cone", GeomAbs_Sphere: "sphere", GeomAbs_Torus: "torus"}


def rod(radius, height, at=(0, 0, 0), turn=(0, 0, 0)):
    return Location(at, turn) * Cylinder(radius, height)


def block(x, y, z, at=(0, 0, 0)):
    return Pos(*at) * Box(x, y, z)


def upright(shape, at=Axis.Z):
    return shape.edges().filter_by(at)


def circles(shape, radius, z=None):
    found = [edge for edge in shape.edges().filter_by(GeomType.CIRCLE) if abs(edge.radius - radius) < 1e-6]
    return [edge for edge in found if z is None or abs(edge.center().Z - z) < 1e-6]


def free_edges(shape):
    """Those that are neither straight nor circles: where round surfaces cross."""
    return [edge for edge in shape.edges() if edge.geom_type not in (GeomType.LINE, GeomType.CIRCLE)]


def rounded(shape, radius, edges):
    return fillet(list(edges), radius)


def shapes():
    cube = block(24, 16, 10)
    yield "box", cube
    yield "box-rounded", rounded(cube, 3, cube.edges())
    yield "box-upright", rounded(cube, 4, upright(cube))
    yield "box-top", rounded(cube, 2, cube.faces().sort_by(Axis.Z)[-1].edges())
    for thick in (2, 5, 8):
        plate = block(100, 60, thick)
        yield f"plate-{thick}", rounded(plate, 10, upright(plate))
    bracket = block(30, 16, 3) + block(3, 16, 24, (-13.5, 0, 10.5))
    inner = [edge for edge in upright(bracket, Axis.Y) if abs(edge.center().X + 12) < 1e-6 and abs(edge.center().Z - 1.5) < 1e-6]
    yield "bracket", bracket
    yield "bracket-rounded", rounded(bracket, 4, inner)
    boss = block(30, 30, 4) + rod(7, 14, (0, 0, 5))
    yield "boss", boss
    yield "boss-rounded", rounded(boss, 4, circles(boss, 7, 2))
    holed = block(30, 24, 8) - rod(6, 8)
    yield "hole", holed
    yield "hole-rounded", rounded(holed, 2, circles(holed, 6, 4))
    bends = FilletPolyline((0, 0, 0), (0, 0, 20), (20, 0, 20), (20, 18, 20), radius=8)
    yield "pipe", sweep(Plane.XY * Circle(3), path=bends)
    crossing = rod(10, 40) + rod(6, 40, turn=(0, 90, 0))
    yield "crossing", crossing
    yield "crossing-rounded", rounded(crossing, 1.5, free_edges(crossing))
    cone = Cone(12, 6, 30) - rod(3, 40, turn=(0, 90, 0))
    yield "cone-hole", cone
    yield "cone-hole-rounded", rounded(cone, 1, free_edges(cone))
    frustum = Cone(12, 6, 20)
    yield "cone-rounded", rounded(frustum, 2, frustum.edges().filter_by(GeomType.CIRCLE))
    cylinder = rod(12, 40) - rod(4, 40, turn=(0, 90, 0))
    yield "cylinder-hole", cylinder
    yield "cylinder-hole-rounded", rounded(cylinder, 1, free_edges(cylinder))
    ball = Sphere(12) + rod(4, 20, (0, 0, 10))
    yield "ball-boss", ball
    yield "ball-boss-rounded", rounded(ball, 2, [edge for edge in circles(ball, 4) if edge.center().Z < 15])
    wedge = extrude(Plane.XZ * make_face(Polyline((-15, 0), (15, 0), (15, 4), (-15, 16), close=True)), 10, both=True)
    yield "wedge", wedge
    yield "wedge-rounded", rounded(wedge, 2, wedge.edges())
    yield "capsule", rod(6, 20) + Pos(0, 0, 10) * Sphere(6) + Pos(0, 0, -10) * Sphere(6)
    tub = rounded(cube, 4, [*upright(cube), *cube.faces().sort_by(Axis.Z)[0].edges()])
    yield "tub", offset(tub, amount=-1.5, openings=tub.faces().sort_by(Axis.Z)[-1])
    knob = rod(10, 12) + Pos(0, 0, 6) * Cone(10, 8, 4, align=(Align.CENTER, Align.CENTER, Align.MIN))
    yield "knob", rounded(knob, 1.5, circles(knob, 8))
    yield "slot", block(40, 20, 5) - extrude(SlotOverall(24, 8), 5, both=True)
    tilted = block(40, 30, 4) + rod(6, 30, (0, 0, 6), (0, 25, 0)).intersect(block(60, 60, 40, (0, 0, 18)))
    yield "boss-tilted", tilted
    yield "ring", Torus(12, 4)
    yield "keyway", rod(10, 30) - block(4, 6, 40, (0, 9, 0))
    dome = block(30, 30, 4) + Sphere(9)
    yield "dome", dome
    yield "dome-rounded", rounded(dome, 2, [edge for edge in dome.edges().filter_by(GeomType.CIRCLE) if edge.center().Z > 0])
    shaft = rod(8, 16) + rod(5, 40)
    yield "shaft-rounded", rounded(shaft, 1.2, [*circles(shaft, 5, 8), *circles(shaft, 5, 20), *circles(shaft, 8)])


def normal(face, edge):
    """The surface's normal in the middle of an edge of the face."""
    curve = BRepAdaptor_Curve(edge)
    middle = 0.5 * (curve.FirstParameter() + curve.LastParameter())
    on_face = BRep_Tool.CurveOnSurface_s(edge, face, 0.0, 0.0)
    first, last = BRep_Tool.Range_s(edge)
    at = on_face.Value(middle) if hasattr(on_face, "Value") else on_face[0].Value(middle)
    props = GeomLProp_SLProps(BRep_Tool.Surface_s(face), at.X(), at.Y(), 1, 1e-9)
    return props.Normal()


def parameters(surface):
    """What tells a surface from another of its kind."""
    kind = KINDS.get(surface.GetType())
    if kind == "plane":
        plane = surface.Plane()
        return kind, plane.Axis().Direction(), plane.Location(), ()
    of = {"cylinder": surface.Cylinder, "cone": surface.Cone, "sphere": surface.Sphere, "torus": surface.Torus}.get(kind)
    if not of:
        return kind, None, None, ()
    of = of()
    numbers = {"cylinder": lambda: (of.Radius(),), "cone": lambda: (of.SemiAngle(),), "sphere": lambda: (of.Radius(),),
               "torus": lambda: (of.MajorRadius(), of.MinorRadius())}[kind]()
    return kind, None if kind == "sphere" else of.Axis().Direction(), of.Apex() if kind == "cone" else of.Location(), numbers


def are_one(first, second):
    (kind, axis, point, numbers), (other, other_axis, other_point, other_numbers) = map(parameters, (first, second))
    if kind is None or kind != other or any(abs(a - b) > 1e-6 for a, b in zip(numbers, other_numbers)):
        return False
    apart = [point.X() - other_point.X(), point.Y() - other_point.Y(), point.Z() - other_point.Z()]
    if axis is None:
        return math.hypot(*apart) < 1e-6
    if axis.Crossed(other_axis).Magnitude() > 1e-6 if hasattr(axis.Crossed(other_axis), "Magnitude") else abs(abs(axis.Dot(other_axis)) - 1) > 1e-9:
        return False
    along = apart[0] * axis.X() + apart[1] * axis.Y() + apart[2] * axis.Z()
    if kind == "plane":
        return abs(along) < 1e-6
    beside = math.sqrt(max(0.0, sum(a * a for a in apart) - along * along))
    return beside < 1e-6 and (kind == "cylinder" or abs(along) < 1e-6)


def is_smooth(faces, edge):
    """Whether two faces join smoothly at an edge and are not of one surface."""
    normals = [normal(face.wrapped, edge.wrapped) for face in faces]
    return abs(normals[0].Dot(normals[1])) > math.cos(0.01) and not are_one(*(BRepAdaptor_Surface(face.wrapped) for face in faces))


def tessellated(shape, tolerance, angle):
    """The shape's points and triangles, each with the number of its face."""
    BRepTools.Clean_s(shape.wrapped)
    BRepMesh_IncrementalMesh(shape.wrapped, tolerance, False, angle, False)
    points, triangles = {}, []
    for number, face in enumerate(shape.faces()):
        mesh = BRep_Tool.Triangulation_s(face.wrapped, location := TopLoc_Location())
        nodes = [mesh.Node(node).Transformed(location.Transformation()) for node in range(1, mesh.NbNodes() + 1)]
        nodes = [tuple(round(number, 6) + 0.0 for number in (node.X(), node.Y(), node.Z())) for node in nodes]
        nodes = [points.setdefault(node, len(points)) for node in nodes]
        is_turned = face.wrapped.Orientation() == TopAbs_Orientation.TopAbs_REVERSED
        for at in range(1, mesh.NbTriangles() + 1):
            a, b, c = (nodes[node - 1] for node in mesh.Triangle(at).Get())
            if len({a, b, c}) == 3:
                triangles.append((a, c, b, number) if is_turned else (a, b, c, number))
    return list(points), triangles


def smooth_pairs(shape):
    """The numbers of faces that join smoothly, and how."""
    of_edges = {}
    faces = shape.faces()
    for number, face in enumerate(faces):
        for edge in face.edges():
            of_edges.setdefault(edge, set()).add(number)
    pairs = {}
    for edge, sides in of_edges.items():
        if len(sides) == 2 and not BRep_Tool.Degenerated_s(edge.wrapped):
            sides = tuple(sorted(sides))
            if is_smooth([faces[side] for side in sides], edge):
                kinds = [KINDS.get(BRepAdaptor_Surface(faces[side].wrapped).GetType()) for side in sides]
                pairs[sides] = "free" if None in kinds else "flat" if "plane" in kinds else "round"
    return pairs


def write(shape, path, tolerance, angle):
    for corners in (None, [(100, 0), (100, 100), (0, 100)], [(100, 0), (100, 100)]):
        if corners:
            sector = extrude(make_face(Polyline((0, 0), *corners, close=True)), 100, both=True)
            cut = shape.intersect(sector)
            [shape] = cut.solids() if hasattr(cut, "solids") else [part for solid in cut for part in solid.solids()]
        points, triangles = tessellated(shape, tolerance, angle)
        if len(triangles) <= LARGEST:
            break
    else:
        return
    pairs = smooth_pairs(shape)
    head = ["ply", "format binary_little_endian 1.0", *(f"comment smooth {a} {b} {kind}" for (a, b), kind in sorted(pairs.items())),
            f"element vertex {len(points)}", *(f"property float {axis}" for axis in "xyz"),
            f"element face {len(triangles)}", "property list uchar ushort vertex_indices", "property uchar surface", "end_header\n"]
    with open(path, "wb") as file:
        file.write("\n".join(head).encode())
        file.writelines(struct.pack("<3f", *point) for point in points)
        file.writelines(struct.pack("<B3HB", 3, *triangle) for triangle in triangles)
    print(path.name, len(triangles), sorted(set(pairs.values())))


def main():
    folder = Path(sys.argv[1])
    folder.mkdir(exist_ok=True)
    for name, shape in shapes():
        for tolerance, angle in TOLERANCES:
            write(shape, folder / f"{name}-{tolerance}-{angle}.ply", tolerance, angle)


if __name__ == "__main__":
    main()
