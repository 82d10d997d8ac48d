"""Parts of build123d and CadQuery: those of the real packages where they are installed, and objects with their attributes."""

import pickle

import numpy as np
import pytest
import tinta_npr as tn


class Vector:
    """As CadQuery's."""

    def __init__(self, numbers):
        self._numbers = tuple(map(float, numbers))

    def toTuple(self):
        return self._numbers


class Box:
    DiagonalLength = 4.0


class Face:
    def __init__(self, corners, triangles):
        self._cut = [Vector(corner) for corner in corners], triangles

    def tessellate(self, tolerance, angle):
        Face.fineness = tolerance, angle
        return self._cut


class Shape:
    """As CadQuery's: its faces are cut into triangles one by one."""

    def __init__(self, faces):
        self._faces = faces

    def tessellate(self, tolerance, angle):
        return [], []

    def BoundingBox(self):
        return Box()

    def Faces(self):
        return self._faces


@pytest.fixture
def block(cube):
    """A block 1 wide, 2 deep and 3 high."""
    vertices, faces = cube
    return Shape([Face(vertices[face] * (1, 2, 3), [(0, 1, 2), (0, 2, 3)]) for face in faces])


def tube():
    """A tube without ends, whose one face meets itself at a seam; and the number of its squares."""
    count = 24
    turn = np.linspace(0, 2 * np.pi, count + 1)
    ring = np.column_stack([np.cos(turn), np.sin(turn), 0 * turn])
    # To the last bit, the ends of a turn are two places.
    squares = [(place, place + 1, place + count + 2, place + count + 1) for place in range(count)]
    triangles = [part for a, b, c, d in squares for part in ((a, b, c), (a, c, d))]
    return Shape([Face(np.concatenate([ring, ring + (0, 0, 2)]), triangles)]), count


def test_its_edges_are_marked_and_diagonals_are_not(block):
    mesh = tn.mesh(block)
    marked = tn.edges(mesh, classes="marked", crease_angle=120)
    assert len(marked) == 12 and set(marked.cls) == {"marked"}
    lines = tn.lines(mesh, classes="marked", crease_angle=120, camera=(30, 20))
    assert lines.counts["marked"] == 12 and lines.visible.sum() == 9
    # An edge of several classes is of the first.
    assert set(tn.lines(block, camera=(30, 20)).cls) == {"silhouette", "crease"}


def test_its_faces_have_the_objects_numbers(block):
    areas = tn.lines(block, camera=(30, 20)).regions()
    seen = areas.face[areas.object == 0]
    assert len(areas) == 4 and len(set(seen)) == 3 and seen.max() < 6
    assert np.isfinite(areas.of_faces(np.arange(6))[areas.object == 0]).all()


def test_a_part_stands_z_up_unless_the_camera_is_in_its_coordinates(block):
    assert np.allclose(np.ptp(tn.mesh(block).vertices, axis=0), (1, 3, 2))
    assert np.allclose(np.ptp(tn.mesh(block, up_axis="y").vertices, axis=0), (1, 2, 3))
    lines = tn.lines(block, eye=(9, 8, 7), target=(0, 0, 0), up=(0, 0, 1))
    assert np.allclose(np.ptp(lines._asked[0][0].vertices, axis=0), (1, 2, 3))


def test_the_seam_of_a_face_is_no_edge():
    shape, count = tube()
    counts = tn.lines(shape, classes="boundary,crease,marked").counts
    assert counts["boundary"] == 2 * count and counts["crease"] == counts["marked"] == 0


def test_marks_stay_in_pickles_and_in_moved_views(block):
    mesh = tn.mesh(block)
    again = pickle.loads(pickle.dumps(mesh))
    assert len(tn.edges(again, classes="marked", crease_angle=120)) == 12
    assert (again.file_faces == mesh.file_faces).all() and len(mesh.file_faces) == 12
    # Oblong pixels: the vertices move.
    matrix = np.array([[60.0, 0, 10, 90], [0, -90, 20, 300], [0, 0, 0, 1]])
    lines = tn.lines(block, camera=matrix, size=400, classes="marked", crease_angle=175)
    assert lines.counts["marked"] == 12


def test_an_object_of_another_version_is_refused_in_a_sentence():
    class Part:
        def tessellate(self, tolerance):
            return []

        def BoundingBox(self):
            return Box()

    with pytest.raises(ValueError, match=r"mesh: this test_cad.Part gives no triangles as those of build123d 0.13 and CadQuery 2 do") as refusal:
        tn.lines(Part())
    assert "\n" not in str(refusal.value) and "export it as .stl or .glb" in str(refusal.value)
    with pytest.raises(ValueError, match="mesh: this object has no face; make a solid"):
        tn.lines(Shape([]))


class EmptyPart:
    """As build123d's, of which only its kernel's shape is missing."""

    @property
    def wrapped(self):
        raise AssertionError

    def tessellate(self, tolerance, angle):
        raise ValueError("Cannot tessellate an empty shape")

    def bounding_box(self):
        return Box()

    def faces(self):
        return []


def test_a_data_set_of_vtk_with_the_same_methods_is_no_part():
    """As PyVista's, which can tessellate and have a bounding box."""

    class DataSet(EmptyPart):
        def IsA(self, name):
            return False

    with pytest.raises(TypeError, match="mesh: give vertices and faces, .*, not DataSet"):
        tn.lines(DataSet())


def test_an_empty_part_is_refused_in_a_sentence():
    with pytest.raises(ValueError, match="mesh: this object has no face; make a solid"):
        tn.lines(EmptyPart())


def test_a_sketch_gives_its_faces_at_their_places(block):
    class Faces(Shape):
        makeCompound = staticmethod(lambda faces: Shape(list(faces)))

    class Sketch:
        _faces = Faces([])
        distribute = hull = vals = vertices = faces = None

        def __iter__(self):
            return iter(block.Faces()[:2])

    mesh = tn.mesh(Sketch())
    assert mesh.name == "sketch" and len(mesh.faces) == 4 and set(mesh.file_faces) == {0, 1}


def test_the_distance_of_chords_can_be_given(block):
    tn.mesh(block)
    assert Face.fineness == (4e-4, 0.1)
    tn.mesh(block, tolerance=0.25)
    assert Face.fineness == (0.25, 0.5)
    for part, tolerance in [(block, 0), (block, -1), ("builtin:gear", 0.1)]:
        with pytest.raises(ValueError, match="tolerance: give a number above 0, beside a part"):
            tn.mesh(part, tolerance=tolerance)


def length(mesh, edges):
    """The length of edges, whose numbers are those of the mesh's vertices if no face left any out."""
    ends = mesh.vertices[edges.vertices]
    return np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).sum()


class TestBuild123d:
    @pytest.fixture(autouse=True)
    def installed(self):
        self.cad = pytest.importorskip("build123d", reason="build123d is not installed: its parts are not tested")

    def plate(self):
        cad = self.cad
        plate = cad.Box(60, 40, 20) - cad.Pos(10, 0, 0) * cad.Cylinder(8, 20)
        return cad.fillet(plate.edges().filter_by(cad.Axis.Z).filter_by(cad.GeomType.LINE), 6)

    def test_a_plate_with_a_hole_and_fillets(self):
        part = self.plate()
        mesh = tn.mesh(part)
        # The seam of the hole is an edge of the part, and no line.
        seams = 20
        marked = length(mesh, tn.edges(mesh, classes="marked", crease_angle=179))
        assert marked == pytest.approx(sum(edge.length for edge in part.edges()) - seams, rel=1e-3)
        assert set(mesh.file_faces) == set(range(len(part.faces())))
        # Where fillets begin, planes go on without a fold: no crease, and yet an edge.
        lines = tn.lines(part, camera=(30, 20))
        assert {"marked", "crease", "silhouette"} == set(lines.cls[lines.visible])

    def test_builders_assemblies_and_lists(self):
        cad = self.cad
        with cad.BuildPart() as builder:
            cad.Box(1, 1, 1)
        assert len(tn.mesh(builder).faces) == 12
        pin = cad.Pos(20, 0, 0) * cad.Cylinder(4, 12)
        pin.label = "pin"
        both = cad.Pos(0, 0, 100) * cad.Compound(label="both", children=[cad.Box(1, 2, 3), pin])
        lines = tn.lines(both)
        assert [mesh.name for mesh in lines._asked[0]] == ["part", "pin"]
        assert lines._asked[0][1].vertices.min(axis=0) == pytest.approx((16, 94, -4), abs=0.01)
        assert set(tn.lines([builder, pin]).object.tolist()) == {0, 1}
        for empty in (cad.Part(), cad.Sketch()):
            with pytest.raises(ValueError, match="mesh: this object has no face"):
                tn.lines(empty)
        with pytest.raises(ValueError, match="mesh: this object has no face"):
            tn.lines(cad.Edge.make_line((0, 0, 0), (1, 1, 1)))

    def test_step_files_come_by_cascadio(self):
        cascadio = pytest.importorskip("cascadio", reason="cascadio is not installed: STEP files are not tested")
        self.cad.export_step(self.plate(), "plate.step")
        cascadio.step_to_glb("plate.step", "plate.glb", 0.01, 0.1)
        mesh = tn.mesh("plate.glb", up_axis="z")
        assert np.ptp(mesh.vertices, axis=0) == pytest.approx((0.06, 0.02, 0.04)), "metres"
        lines = tn.lines(mesh, camera=(30, 20))
        assert set(lines.cls[lines.visible]) == {"crease", "silhouette"}, "no edges where a face goes on without a fold"


class TestCadQuery:
    @pytest.fixture(autouse=True)
    def installed(self):
        self.cq = pytest.importorskip("cadquery", reason="CadQuery is not installed: its parts are not tested")

    def test_a_plate_with_a_hole_and_fillets(self):
        part = self.cq.Workplane("XY").box(60, 40, 20).edges("|Z").fillet(6).faces(">Z").workplane().hole(16)
        mesh = tn.mesh(part)
        marked = length(mesh, tn.edges(mesh, classes="marked", crease_angle=179))
        assert marked == pytest.approx(sum(edge.Length() for edge in part.val().Edges()) - 20, rel=1e-3)
        assert set(mesh.file_faces) == set(range(len(part.val().Faces())))
        assert len(tn.mesh(part.val()).faces) == len(mesh.faces)

    def test_a_sketch_is_its_faces(self):
        mesh = tn.mesh(self.cq.Sketch().rarray(5, 1, 2, 1).circle(1), tolerance=0.01)
        assert np.ptp(mesh.vertices, axis=0) == pytest.approx((7, 0, 2), abs=0.05) and set(mesh.file_faces) == {0, 1}

    def test_an_assembly_has_its_parts_at_their_places(self):
        cq = self.cq
        inner = cq.Assembly(name="inner").add(cq.Workplane().box(1, 2, 3), name="block")
        inner.add(cq.Workplane().sphere(4), name="ball", loc=cq.Location(cq.Vector(20, 0, 0)))
        outer = cq.Assembly(name="outer").add(inner, loc=cq.Location(cq.Vector(0, 0, 100)))
        lines = tn.lines(outer)
        assert [mesh.name for mesh in lines._asked[0]] == ["outer/inner/block", "outer/inner/ball"]
        assert lines._asked[0][1].vertices.min(axis=0) == pytest.approx((16, 96, -4), abs=0.02)
        assert tn.lines(outer, sheet="third", page="A4-landscape", hidden="dashed").pdf().startswith(b"%PDF")
