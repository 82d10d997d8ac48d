"""Lines whose places, classes and visibility are known otherwise."""

import copy
import io
import itertools
import json
import pickle

import numpy as np
import pytest
import tinta_npr as tn

ISO = {"view": "iso", "parallel": True, "size": 400}


def pixels_from_world(camera, size, points):
    """Where a camera of ours shows points, computed here once more."""
    eye, target, up = (np.array(camera[name]) for name in ("eye", "target", "up"))
    back = (eye - target) / np.linalg.norm(eye - target)
    right = np.cross(up, back)
    right /= np.linalg.norm(right)
    up = np.cross(back, right)
    seen = (points - eye) @ np.array([right, up, back]).T
    width, height = size
    if "height" in camera:
        scale = height / camera["height"]
        return np.column_stack([width / 2 + seen[:, 0] * scale, height / 2 - seen[:, 1] * scale]), -seen[:, 2]
    scale = height / 2 / np.tan(np.radians(camera["fov"] / 2)) / -seen[:, 2]
    return np.column_stack([width / 2 + seen[:, 0] * scale, height / 2 - seen[:, 1] * scale]), -seen[:, 2]


@pytest.mark.parametrize("view", [{"parallel": True}, {"fov": 50}])
def test_a_cube_has_nine_visible_edges_where_they_belong(cube, view):
    vertices, faces = cube
    lines = tn.lines(vertices, faces, view=(30, 20), size=(400, 300), **view)
    places, _ = pixels_from_world(lines.camera, lines.size, vertices)
    pairs = {tuple(sorted(pair)) for face in faces.tolist() for pair in zip(face, face[1:] + face[:1])}
    assert len(pairs) == 12 and {tuple(edge) for edge in lines.edge.tolist()} == pairs
    assert (np.abs(lines.angle - 90) < 1e-9).all() and set(lines.object) == {0}
    for pair in pairs:
        of_it = (lines.edge == pair).all(axis=1)
        ends = lines.segments[of_it].reshape(-1, 2)
        # From one vertex to the other, whichever comes first.
        for place in places[list(pair)]:
            assert np.linalg.norm(ends - place, axis=1).min() < 1e-6
        length = np.linalg.norm(np.diff(lines.segments[of_it], axis=1)[:, 0], axis=1).sum()
        assert length == pytest.approx(np.linalg.norm(np.diff(places[list(pair)], axis=0)), abs=1e-6)
        assert len(set(lines.visible[of_it].tolist())) == 1
    seen = {tuple(edge) for edge in lines.edge[lines.visible].tolist()}
    hidden = pairs - seen
    assert len(hidden) == 3 and len(set.intersection(*map(set, hidden))) == 1, "three that meet at the far corner"
    assert lines.counts["silhouette"] == 6 and lines.counts["crease"] == 6
    assert len(lines["silhouette"]) + len(lines["crease"]) == lines.visible.sum()
    assert len(lines.hidden) == (~lines.visible).sum() == 3
    assert lines.select("crease", visible=None).shape[1:] == (2, 2)
    with pytest.raises(KeyError, match="there is no class creases"):
        lines["creases"]


def torus(rings=24, sides=12):
    around, across = np.meshgrid(np.arange(rings) * 2 * np.pi / rings, np.arange(sides) * 2 * np.pi / sides, indexing="ij")
    vertices = np.stack(
        [(2 + np.cos(across)) * np.cos(around), np.sin(across), -(2 + np.cos(across)) * np.sin(around)], axis=-1
    ).reshape(-1, 3)
    number = lambda ring, side: ring % rings * sides + side % sides
    squares = [
        (number(i, j), number(i, j + 1), number(i + 1, j + 1), number(i + 1, j)) for i in range(rings) for j in range(sides)
    ]
    triangles = [corners for a, b, c, d in squares for corners in ((a, b, c), (a, c, d))]
    return vertices, np.array(triangles)


def test_the_silhouette_of_a_torus_is_where_front_meets_back():
    vertices, faces = torus()
    eye = np.array([3.1, 4.2, 7.3])
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    is_front = np.einsum("ij,ij->i", np.cross(b - a, c - a), eye - a) > 0
    sides = {}
    for face, corners in enumerate(faces.tolist()):
        for pair in itertools.combinations(sorted(corners), 2):
            sides.setdefault(pair, []).append(is_front[face])
    expected = {pair for pair, (one, other) in sides.items() if one != other}
    assert len(expected) > 40
    assert {tuple(pair) for pair in np.sort(tn.silhouette(vertices, eye, faces), axis=1).tolist()} == expected
    mesh = tn.mesh(vertices, faces)
    assert {tuple(pair) for pair in np.sort(tn.silhouette(mesh, eye), axis=1).tolist()} == expected
    far = tn.silhouette(mesh, eye * 1e6)
    assert sorted(map(tuple, far.tolist())) == sorted(map(tuple, tn.silhouette(mesh, eye, direction=True).tolist()))


def test_a_drawing_shows_what_was_not_looked_for_at_first(cube):
    for asked in [{"hidden": "dashed"}, {"class_widths": "outline=3"}]:
        first, later = tn.lines(*cube, **asked), tn.lines(*cube)
        assert later.svg(**asked) == first.svg()
        assert (later.visible == first.visible).all() and len(later.hidden) == 3, "arrays have hidden pieces either way"


def test_what_of_a_torus_is_hidden_has_a_face_before_it():
    vertices, faces = torus()
    lines = tn.lines(vertices, faces, classes="silhouette", view=(20, 35), parallel=True)
    camera = lines.camera
    _, depths = pixels_from_world(camera, lines.size, vertices)
    places, _ = pixels_from_world(camera, lines.size, vertices)
    triangles, near = places[faces], depths[faces]
    judged = 0
    for piece, edge, is_seen in zip(lines.segments, lines.edge, lines.visible):
        middle = piece.mean(axis=0)
        if np.linalg.norm(piece[1] - piece[0]) < 1e-3:
            continue
        along = places[edge[1]] - places[edge[0]]
        share = (middle - places[edge[0]]) @ along / (along @ along)
        depth = depths[edge[0]] + share * (depths[edge[1]] - depths[edge[0]])
        one, two = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
        area = one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]
        from_first = middle - triangles[:, 0]
        u = (from_first[:, 0] * two[:, 1] - from_first[:, 1] * two[:, 0]) / area
        v = (one[:, 0] * from_first[:, 1] - one[:, 1] * from_first[:, 0]) / area
        inner = np.minimum(np.minimum(u, v), 1 - u - v)
        before = depth - (near[:, 0] + u * (near[:, 1] - near[:, 0]) + v * (near[:, 2] - near[:, 0]))
        if is_seen:
            assert not ((inner > 1e-6) & (before > 1e-6)).any()
        else:
            assert ((inner > -1e-9) & (before > 1e-9)).any()
        judged += 1
    assert judged > 60 and 0 < lines.visible.sum() < len(lines)


def test_quads_and_polygons_go_the_way_of_files(cube):
    vertices, faces = cube
    ragged = [list(face) for face in faces[:5].tolist()] + [[1, 5, 7], [1, 7, 3]]
    assert tn.mesh(vertices, ragged).faces.shape == tn.mesh(vertices, faces).faces.shape == (12, 3)
    whole, cut = tn.lines(vertices, faces, **ISO), tn.lines(vertices, ragged, **ISO)
    assert (whole.segments == cut.segments).all()
    assert tn.mesh(vertices.tolist(), faces.tolist()).vertices.shape == (8, 3)
    assert tn.mesh(vertices.astype(np.float32), faces.astype(np.uint8)).faces.dtype == np.uint32


def test_several_meshes_are_one_scene(cube):
    vertices, faces = cube
    near, far = tn.mesh(vertices + (0, 0, 3), faces), tn.mesh(vertices, faces)
    lines = tn.lines([near, far], view="front", parallel=True)
    assert set(lines.object.tolist()) == {0, 1}
    assert lines.visible[lines.object == 0].any() and not lines.visible[lines.object == 1].any(), "behind the other"


def test_a_pair_is_a_mesh_alone_and_in_a_list(cube):
    vertices, faces = cube
    assert tn.lines((vertices, faces)).svg() == tn.lines([vertices.tolist(), faces.tolist()]).svg() == tn.lines(*cube).svg()
    both = tn.lines([(vertices, faces), (vertices + 2, faces[:3])])
    assert set(both.object.tolist()) == {0, 1}
    assert both.svg() == tn.lines([tn.mesh(vertices, faces), tn.mesh(vertices + 2, faces[:3])]).svg()


@pytest.mark.parametrize(
    "settings",
    [{}, {"fov": 20, "view": "iso"}, {"parallel": True}, {"up_axis": "z", "view": "top"}, {"up_axis": "-x", "framing": "outline"}],
)
@pytest.mark.parametrize("is_read_first", [False, True])
def test_points_are_projected_to_the_ends_of_their_lines(cube, settings, is_read_first):
    vertices, faces = cube
    settings = dict(settings)
    mesh = (vertices * (3, 2, 1), faces)
    if is_read_first:
        mesh = tn.mesh(*mesh, up_axis=settings.pop("up_axis", None))
    lines = tn.lines(mesh, size=(400, 300), **settings)
    places = lines.project(vertices * (3, 2, 1))
    for edge, ends in zip(lines.edge, lines.segments):
        inside = places[edge]
        along = inside[1] - inside[0]
        across = (ends - inside[0]) @ (along[1], -along[0]) / np.linalg.norm(along)
        assert np.abs(across).max() < 1e-6, "the pieces of an edge lie between its projected ends"
    assert (lines.project(vertices[0]) == places[0]).all() and lines.project(vertices[0]).shape == (2,)
    behind = 2 * np.array(lines.camera["eye"]) - lines.camera["target"]
    assert np.isnan(tn.lines(*cube, camera={**lines.camera}).project(behind)).all() == ("fov" in lines.camera)


def test_results_are_copied_and_pickled(cube):
    vertices, faces = cube
    mesh = tn.mesh(vertices, faces.tolist(), name="cube", up_axis="z")
    lines = tn.lines(mesh, hidden="dashed", class_colors={"crease": (0, 0.5, 1)}, camera=(12, 34))
    moved = tn.lines(mesh=(vertices, faces), camera=[[3, 0.1, 1, 90], [0, 2, 1, 80], [0, 0, 0.01, 1]], size=200)
    around = tn.lines(mesh, curves=[[(-2, 0, 0), (2, 0, 0)]], points=[(1, 1, 1)], labels=["corner"])
    for copied in (copy.copy, copy.deepcopy, lambda value: pickle.loads(pickle.dumps(value))):
        again = copied(mesh)
        assert repr(again) == repr(mesh) and again.was_read_with({"up_axis": "z"})
        assert tn.lines(again).svg() == tn.lines(mesh).svg()
        assert (tn.silhouette(again, (3, 4, 5)) == tn.silhouette(mesh, (3, 4, 5))).all(), "by the given vertices' numbers"
        assert (tn.render(again, size=48, style="phong") == tn.render(mesh, size=48, style="phong")).all()
        for found in (lines, moved, around):
            other = copied(found)
            assert (other.segments == found.segments).all() and (other.cls == found.cls).all() and other.camera == found.camera
            assert other.svg() == found.svg() and (other.project(vertices) == found.project(vertices)).all()
        gear = copied(tn.mesh("builtin:gear"))
        assert tn.lines(gear).svg() == tn.lines("builtin:gear").svg()
        picture = tn.render("builtin:gear", size=32)
        assert copied(picture).png() == picture.png() and copied(picture).recipe == picture.recipe is not None
        edges = tn.edges(mesh)
        assert (copied(edges).vertices == edges.vertices).all()
        comparison = tn.compare(mesh, size=32)
        assert copied(comparison).numbers == comparison.numbers
    deep = copy.deepcopy(lines)
    deep.segments[:] = 0
    assert lines.segments.any()


def test_lines_are_saved_to_paths_and_open_files(cube, tmp_path):
    lines = tn.lines(*cube)
    for format, begin in [("svg", b"<?xml"), ("pdf", b"%PDF"), ("png", b"\x89PNG"), ("json", b"{")]:
        text = io.StringIO()
        lines.save(text, format="svg")
        assert text.getvalue() == lines.svg()
        opened = io.BytesIO()
        lines.save(opened, format=format)
        lines.save(tmp_path / f"cube.{format}")
        assert opened.getvalue().startswith(begin) and (tmp_path / f"cube.{format}").read_bytes() == opened.getvalue()
    lines.save(tmp_path / "cube", format="svg", title="A cube")
    assert b"<title>A cube" in (tmp_path / "cube").read_bytes()


def test_a_sheet_is_asked_for_with_the_lines_or_with_the_file(cube):
    lines = tn.lines(*cube, sheet="third", hidden="dashed")
    assert lines.svg() == tn.lines(*cube).svg(sheet="third", hidden="dashed") and repr(lines)
    with pytest.raises(ValueError, match="sheet: a sheet has four cameras"):
        lines.camera


def test_edges_have_their_classes_and_faces(cube):
    vertices, faces = cube
    edges = tn.edges(vertices, faces[:5])
    assert sorted(set(edges.cls.tolist())) == ["boundary", "crease"] and len(edges) == 12
    assert ((edges.faces[edges.cls == "boundary"] >= 0).sum(axis=1) == 1).all()
    assert len(tn.edges(vertices, faces, crease_angle=91)) == 0
    assert len(tn.edges(vertices, faces, classes="boundary")) == 0


def test_a_mesh_is_read_once_and_seen_often(cube):
    mesh = tn.mesh(*cube, name="cube")
    assert mesh.name == "cube" and repr(mesh) == '<tinta_npr.Mesh "cube": 8 vertices, 12 triangles>'
    for view in ("front", "iso", "top", (12, 34)):
        assert tn.lines(mesh, view=view).svg() == tn.lines(*cube, name="cube", view=view).svg()
    assert tn.render(mesh, size=64).shape == (64, 64, 4)
    with pytest.raises(ValueError, match="^weld: this Mesh has been read already"):
        tn.lines(mesh, weld=0.001)
    assert len(tn.lines(mesh, weld=None)) > 0


def test_layers_are_the_drawing(cube):
    lines = tn.lines(*cube, hidden="dashed", class_colors={"crease": (0, 0, 1), "hidden": "red"}, line_width=3)
    layers = lines.layers()
    assert [layer["visible"] for layer in layers] == sorted(layer["visible"] for layer in layers), "hidden ones below"
    names = {(layer["name"], layer["visible"]) for layer in layers}
    assert names == {("crease", False), ("crease", True), ("silhouette", True)}
    hidden, crease = layers[0], next(layer for layer in layers if layer["visible"] and layer["name"] == "crease")
    assert hidden["color"] == [1, 0, 0] and hidden["width"] == 1.5 and hidden["dash"] == [9.0, 7.5]
    assert crease["color"] == [0, 0, 1] and crease["width"] == 3 and crease["dash"] is None
    assert all(path.shape[1] == 2 and path.dtype == np.float64 for layer in layers for path in layer["paths"])
    outline = next(layer for layer in layers if layer["name"] == "silhouette")["paths"]
    assert len(outline) == 1 and (outline[0][0] == outline[0][-1]).all(), "closed"
    assert len(lines.layers(hidden="none")) == 2


def test_a_notebook_shows_lines_and_pictures(cube):
    assert tn.lines(*cube)._repr_svg_().startswith("<?xml")
    picture = tn.render(*cube, size=32)
    assert json.loads(json.dumps([picture.mean(), picture.max(), picture.std()])) == pytest.approx([np.mean(np.asarray(picture)), 255, np.std(np.asarray(picture))])
    assert np.ma.masked_equal(picture, 255).min() == picture.min()
    assert type(picture.mean(axis=2)) is type(picture) and type(picture.sum()) is int
    assert picture._repr_png_().startswith(b"\x89PNG") and picture[0]._repr_png_() is None
    picture.save("cube.png")
    picture.save("cube.jpg")
    with open("cube.png", "rb") as file:
        assert file.read() == picture.png()


def test_styles_are_measured_and_compared(cube):
    rows = tn.measure(*cube, styles=["ink", {"style": "three-pass", "filter": "sobel"}], frames=1, size=96)
    assert [row["style"] for row in rows] == ["ink", "three-pass"] and rows[1]["options"] == "style three-pass filter sobel"
    assert all(0 < row["f1"] <= 1 and row["median_ms"] > 0 and row["width_px"] == 96 for row in rows)
    comparison = tn.compare(*cube, left="ink", right="inking", size=96)
    numbers = comparison.numbers
    assert comparison.left.shape == comparison.right.shape == comparison.lines.shape == (96, 96, 4)
    colors, counts = np.unique(comparison.lines.reshape(-1, 4), axis=0, return_counts=True)
    count = dict(zip(map(tuple, colors.tolist()), counts.tolist()))
    assert count.get((213, 94, 0, 255), 0) == numbers["only_left_px"]
    assert count.get((0, 114, 178, 255), 0) == numbers["only_right_px"]


def test_curves_and_points_are_hidden_by_faces_and_labels_follow_their_points(cube):
    vertices, faces = cube
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    middle, size = (low + high) / 2, high - low
    view = {"view": "front", "parallel": True, "size": 200}
    # Along the view through the cube, before it, behind it, and across its front face.
    depth = np.array([0, 0, 1]) * size
    beside = np.array([1, 0.05, 0]) * size
    behind = [middle - depth - beside, middle - depth + beside]
    before = [middle + depth - beside, middle + depth + beside]
    across = [middle + depth / 2 - beside / 4, middle + depth / 2 + beside / 4]
    points = [middle, middle + depth, middle - depth]
    lines = tn.lines(vertices, faces, curves=[behind, before, across], points=points, labels=["in", "before", None], **view)
    is_curve = lines.cls == "curve"
    of = {number: lines.visible[is_curve & (lines.edge[:, 0] == 2 * number)].tolist() for number in range(3)}
    assert of[0] == [True, False, True] and of[1] == [True] and of[2] == [True]
    assert lines.visible[lines.cls == "point"].tolist() == [False, True, False]
    assert [(label["text"], label["visible"]) for label in lines.labels] == [("in", False), ("before", True)]
    assert lines.counts["curve"] == 3 and lines.counts["point"] == 3
    svg = lines.svg()
    assert ">before</text>" in svg and ">in</text>" not in svg and ">in</text>" in lines.svg(hidden="dashed")
    assert all(part in lines.pdf() for part in (b"+DejaVuSans", b"/FontFile2", b"<0001> <0062>")), "b of before"
    alone = tn.lines(curves=np.array(across), view="front")
    assert set(alone.cls) == {"curve"} and alone.visible.all()
    # The same through a matrix that tinta's camera has not, which moves positions.
    matrix = np.array([[90, 0, 3.0, 100], [0, -100, 7.0, 100], [0, 0, 0, 1]]) + 0.0
    moved = tn.lines(vertices - middle, faces, curves=[np.array(behind) - middle], camera=matrix, size=200)
    assert moved.visible[moved.cls == "curve"].tolist() == [True, False, True]


def test_bad_curves_points_and_labels_are_refused_by_name(cube):
    vertices, faces = cube
    line = [[0, 0, 0], [1, 1, 1]]
    for given, problem in [
        ({"curves": [line, [[0, 0, 0]]]}, "curves: curve 1 has 1 of the 2 or more positions of a curve"),
        ({"curves": [[[0, 0, 0], [1, np.nan, 1]]]}, "curves: row 1 is not finite"),
        ({"curves": [[[0, 0], [1, 1]]]}, "curves: the shape is"),
        ({"points": [[0, 0, np.inf]]}, "points: row 0 is not finite"),
        ({"points": line, "labels": ["a"]}, "labels: there are 1 for 2 points"),
        ({"labels": ["a"]}, "labels: they are texts of points"),
        ({"points": line, "labels": ["a" * 1001, ""]}, "label 0 has more than 1000 letters"),
    ]:
        with pytest.raises(ValueError, match=problem):
            tn.lines(vertices, faces, **given)
    with pytest.raises(TypeError, match="curves: give a list"):
        tn.lines(vertices, faces, curves="line")
    with pytest.raises(TypeError, match="mesh: it is missing"):
        tn.lines()
    greek = tn.lines(vertices, faces, points=[[9, 9, 9]], labels=["λ"])
    assert ">λ</text>" in greek.svg()
    assert b"<0001> <03BB>" in greek.pdf()
    with pytest.raises(ValueError, match="no letter '山'; write it as .svg"):
        tn.lines(vertices, faces, points=[[9, 9, 9]], labels=["山"]).pdf()


def test_lines_are_as_many_as_they_say_when_one_goes_through_them(cube):
    lines = tn.lines(*cube, **ISO)
    assert len(list(lines)) == len(lines) and np.array_equal(np.array(list(lines)), lines.segments)


def test_a_section_is_in_the_axes_of_its_mesh_and_hatched_as_on_the_command_line(cube, tinta):
    with open("cube.obj", "w") as file:
        file.writelines("v {} {} {}\n".format(*vertex) for vertex in cube[0])
        file.writelines("f {} {} {} {}\n".format(*corners) for corners in cube[1] + 1)
    assert tinta("render", "cube.obj", "-o", "cut.svg", "--style", "lines", "--up-axis", "z", "--section", "z=0.5", "--section", "x=0.25") == (0, "")
    for section in ("z=0.5; x=0.25", ["z=0.5", "x=0.25"], ["file:z=0.5", "x=0.25"]):
        lines = tn.lines("cube.obj", up_axis="z", section=section)
        lines.save("python.svg")
        with open("python.svg") as mine, open("cut.svg") as theirs:
            assert mine.read() == theirs.read()
        of_arrays = tn.lines(*cube, up_axis="z", section=section)
        assert of_arrays.counts == lines.counts and lines.counts["curve"] > 20, "strokes"
    mesh = tn.mesh(*cube, up_axis="z", section="z=0.5")
    assert mesh.vertices[:, 1].max() == 0.5 and len(tn.lines(mesh, section="z=0.5")) == len(tn.lines(mesh))
    with pytest.raises(ValueError, match="did you mean z=3"):
        tn.lines(*cube, section="Z: 3")


def test_meshes_of_a_list_are_cut_one_by_one(cube):
    vertices, faces = cube
    pin = vertices * 0.4 + 0.3 + np.array([0, 0, 0.2])
    cut = tn.mesh(vertices, faces, up_axis="z", section="z=0.5", name="box")

    def height(pin):
        lines = tn.lines([cut, pin], view=(30, 40), classes="silhouette,crease")
        return np.ptp(lines.segments[lines.object == 1][..., 1])

    assert height(tn.mesh(pin, faces, up_axis="z")) > 1.2 * height(tn.mesh(pin, faces, up_axis="z", section="z=0.6"))
    for part in ("pin*:uncut", "pin*: color=red, uncut", ["a:color=red", "pin*:uncut"], {"pin*": {"uncut": True}}):
        with pytest.raises(ValueError, match="part: here uncut spares no part; give a list"):
            tn.lines("builtin:plates", section="z=0", part=part)
    assert len(tn.lines("builtin:plates", section="z=0", part="pin*:color=red"))
