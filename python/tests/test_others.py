"""Meshes and cameras of the real libraries."""

import sys

import numpy as np
import pytest
import tinta_npr as tn


def bounds(points):
    return np.array([points.min(axis=0), points.max(axis=0)])


class TestTrimesh:
    trimesh = pytest.importorskip("trimesh")

    def test_a_mesh_is_its_arrays(self):
        ball = self.trimesh.creation.icosphere(subdivisions=2)
        assert tn.lines(ball).svg() == tn.lines(ball.vertices, ball.faces).svg()
        edges = tn.silhouette(ball, (0, 0, 9))
        assert edges.max() < len(ball.vertices)

    def test_a_scene_has_its_meshes_at_their_places_and_its_camera(self):
        box = self.trimesh.creation.box()
        scene = self.trimesh.Scene([box, box.copy().apply_translation((3, 0, 0))])
        lines = tn.lines(scene, camera=scene)
        assert set(lines.object.tolist()) == {0, 1}
        expected = np.linalg.inv(scene.camera_transform)
        assert np.allclose(lines.camera["eye"], scene.camera_transform[:3, 3]) and np.isfinite(expected).all()
        assert lines.camera["fov"] == pytest.approx(scene.camera.fov[1])


class TestOpen3D:
    def test_a_mesh_is_its_arrays(self, cube):
        vertices, faces = cube
        triangles = np.concatenate([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]])

        class TriangleMesh:
            """As Open3D's: lists of vectors with these names, and more besides."""

        mesh = TriangleMesh()
        mesh.vertices, mesh.triangles, mesh.triangle_normals = vertices.tolist(), triangles.tolist(), []
        assert tn.lines(mesh).svg() == tn.lines(vertices, triangles).svg()

    def test_the_real_class(self, cube):
        open3d = pytest.importorskip("open3d")
        box = open3d.geometry.TriangleMesh.create_box()
        assert tn.lines(box).svg() == tn.lines(np.asarray(box.vertices), np.asarray(box.triangles)).svg()
        assert tn.lines(open3d.t.geometry.TriangleMesh.from_legacy(box)).svg()


class TestFiles:
    @pytest.mark.parametrize("name, module", [("cube.vtk", "meshio"), ("cube.off", "trimesh"), ("cube.msh", "meshio")])
    def test_other_libraries_formats_are_read_by_them(self, cube, name, module):
        library = pytest.importorskip(module)
        vertices, faces = cube
        triangles = np.concatenate([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]])
        if module == "meshio":
            library.Mesh(vertices, [("triangle", triangles)]).write(name)
        else:
            library.Trimesh(vertices, triangles).export(name)
        mesh = tn.mesh(name)
        assert mesh.name == name and len(mesh.faces) == 12
        assert tn.lines(name).svg(title="") == tn.lines(vertices, triangles).svg(title="")


    def test_polygons_of_vtk_are_read_by_pyvista_or_refused_with_the_remedy(self, monkeypatch, capfd):
        """meshio reads other data in such files, and ends the program at polygons."""
        pytest.importorskip("meshio")
        pyvista = pytest.importorskip("pyvista")
        cube = pyvista.Cube().triangulate()
        for name in ("cube.vtk", "cube.vtp"):
            cube.save(name)
            assert tn.lines(name).svg(title="") == tn.lines(cube).svg(title="")
        monkeypatch.setitem(sys.modules, "pyvista", None)
        with pytest.raises(ValueError, match="cube.vtk: meshio cannot read it; install pyvista"):
            tn.lines("cube.vtk")
        assert capfd.readouterr().err == ""


class TestMeshio:
    meshio = pytest.importorskip("meshio")

    def test_triangles_and_quads(self, cube):
        vertices, faces = cube
        mesh = self.meshio.Mesh(vertices, [("quad", faces[:4]), ("triangle", [[0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])])
        assert (tn.lines(mesh).segments == tn.lines(vertices, [*faces[:4].tolist(), [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]).segments).all()

    @pytest.mark.parametrize(
        "kind, points, faces",
        [
            ("tetra", [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], 4),
            ("hexahedron", [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)], 12),
            ("wedge", [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)], 8),
            ("pyramid", [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 1)], 6),
        ],
    )
    def test_volumes_are_seen_from_outside(self, kind, points, faces):
        points = np.array(points, float)
        mesh = tn.mesh(self.meshio.Mesh(points, [(kind, [list(range(len(points)))])]))
        a, b, c = (mesh.vertices[mesh.faces[:, corner]] for corner in range(3))
        outwards = np.einsum("ij,ij->i", np.cross(b - a, c - a), a - points.mean(axis=0))
        assert len(mesh.faces) == faces and (outwards > 0).all()
        assert not (tn.edges(mesh, crease_angle=1).cls == "boundary").any(), "closed"

    def test_faces_between_two_cells_are_not_seen(self):
        points = np.array([(x, y, z) for x in (0.0, 1, 2) for y in (0.0, 1) for z in (0.0, 1)])
        cell = np.array([0, 4, 6, 2, 1, 5, 7, 3])
        mesh = tn.mesh(self.meshio.Mesh(points, [("hexahedron", [cell, cell + 4])]))
        assert len(mesh.faces) == 20
        with pytest.raises(ValueError, match="cells: none of them has a face .*line"):
            tn.lines(self.meshio.Mesh(points, [("line", [[0, 1]])]))


class TestPyVista:
    pv = pytest.importorskip("pyvista")

    def test_surfaces_are_their_arrays(self):
        ball = self.pv.Sphere(theta_resolution=20, phi_resolution=20)
        assert (tn.lines(ball).segments == tn.lines(ball.points, ball.regular_faces).segments).all()
        mixed = self.pv.Cylinder(resolution=7)
        mesh = tn.mesh(mixed)
        assert len(mesh.faces) == 7 * 2 + 2 * 5
        assert len(tn.edges(mesh, crease_angle=30)) == 7 * 3

    def test_volumes_and_blocks(self):
        grid = self.pv.ImageData(dimensions=(3, 3, 3))
        assert len(tn.mesh(grid).faces) == 6 * 4 * 2
        assert len(tn.mesh(grid.cast_to_unstructured_grid()).faces) == 6 * 4 * 2
        blocks = self.pv.MultiBlock([self.pv.Cube(), self.pv.Cube(center=(3, 0, 0))])
        assert set(tn.lines(blocks, view="iso").object.tolist()) == {0, 1}

    @pytest.mark.parametrize("is_parallel", [False, True])
    def test_a_plotters_camera_shows_points_where_vtk_does(self, is_parallel):
        import vtk

        cube = self.pv.Cube()
        plotter = self.pv.Plotter(off_screen=True, window_size=(400, 300))
        plotter.add_mesh(cube)
        plotter.camera.position, plotter.camera.focal_point, plotter.camera.up = (3, 2.5, 2), (0.1, 0, 0), (0, 0, 1)
        plotter.camera.parallel_projection = is_parallel
        plotter.camera.parallel_scale = 1.3
        plotter.camera.is_set = True
        lines = tn.pv.lines(plotter)
        matrix = plotter.camera.GetCompositeProjectionTransformMatrix(400 / 300, -1, 1)
        clip = np.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(4)])
        points = np.column_stack([cube.points, np.ones(cube.n_points)]) @ clip.T
        places = np.column_stack([(points[:, 0] / points[:, 3] + 1) * 200, (1 - points[:, 1] / points[:, 3]) * 150])
        ends = lines.segments.reshape(-1, 2)
        assert np.linalg.norm(ends[None] - places[:, None], axis=2).min(axis=1).max() < 1e-3, vtk.vtkVersion().GetVTKVersion()
        # VTK's own matrix is a camera too.
        again = tn.lines(cube, camera=clip, size=(400, 300))
        assert np.abs(np.sort(again.segments.ravel()) - np.sort(lines.segments.ravel())).max() < 1e-3
        plotter.close()

    def test_what_a_plotter_shows_is_exported(self):
        plotter = self.pv.Plotter(off_screen=True, window_size=(320, 240))
        plotter.add_mesh(self.pv.Cube())
        moved = plotter.add_mesh(self.pv.Cube())
        moved.position = (0, 2, 0)
        away = plotter.add_mesh(self.pv.Sphere())
        away.visibility = False
        plotter.add_mesh(self.pv.PolyData(np.random.default_rng(1).normal(size=(5, 3))))
        plotter.view_isometric()
        lines = tn.pv.lines(plotter)
        assert set(lines.object.tolist()) == {0, 1, 2} and lines.size == (320, 240)
        assert set(lines.object[lines.cls == "point"].tolist()) == {2}, "points come after the meshes"
        tn.pv.export_svg(plotter, "scene.svg", hidden="dashed")
        with open("scene.svg") as file:
            text = file.read()
        assert text.count("<g id=") >= 3 and 'width="320"' in text
        plotter.close()

    def test_vtks_own_classes_are_pyvistas(self):
        import vtk

        for source, mine in [(vtk.vtkConeSource(), None), (vtk.vtkCubeSource(), None)]:
            source.Update()
            raw = source.GetOutput()
            assert type(raw) is vtk.vtkPolyData
            assert tn.lines(raw).svg() == tn.lines(self.pv.wrap(raw)).svg()
        raw = vtk.vtkUnstructuredGrid()
        raw.DeepCopy(self.pv.ImageData(dimensions=(3, 3, 3)).cast_to_unstructured_grid())
        assert len(tn.mesh(raw).faces) == 6 * 4 * 2
        with pytest.raises(ValueError, match="cells: none of them has a face"):
            tn.mesh(vtk.vtkPolyData())

    def scene(self, **more):
        plotter = self.pv.Plotter(off_screen=True, window_size=(320, 240), **more)
        plotter.add_mesh(self.pv.Cube(), label="cube", color="tan")
        plotter.view_isometric()
        return plotter

    def test_curves_points_and_wireframes_are_drawn_and_hidden(self):
        plotter = self.scene()
        plotter.add_mesh(self.pv.Line((-1, 0, 0), (1, 0, 0)))
        plotter.add_points(np.array([(0, 0, 0.8), (0, 0, 0)]))
        wires = plotter.add_mesh(self.pv.Plane(center=(0, 0, 1), i_size=0.2, j_size=0.2, i_resolution=1, j_resolution=1), style="wireframe")
        wires.position = (0, 0, 1)
        plotter.add_mesh(self.pv.Cube(center=(0, 0, 4)), style="points")
        lines = tn.pv.lines(plotter)
        assert lines.counts["curve"] == 1 + 4 and lines.counts["point"] == 2 + 8
        visible = lines.visible[lines.cls == "curve"]
        assert visible.any() and not visible.all(), "the line is hidden in the cube"
        assert (~lines.visible[lines.cls == "point"]).sum() == 1
        ends = lines.segments[lines.cls == "curve"].reshape(-1, 2)
        assert np.abs(ends - lines.project((0.1, 0.1, 2))).sum(axis=1).min() < 1e-3, "the wireframe has its actor's place"
        assert set(lines.object[lines.cls == "curve"].tolist()) == {1, 2}, "an object for each colour"
        plotter.close()

    def test_without_a_surface_curves_and_points_are_a_scene(self):
        for fill in (False, True):
            plotter = self.pv.Plotter(off_screen=True, window_size=(320, 240))
            plotter.add_points(np.eye(3))
            tn.pv.export_svg(plotter, "points.svg", fill=fill)
            with open("points.svg") as file:
                assert "visible-point" in file.read()
            plotter.close()

    @pytest.mark.parametrize("is_filled", [False, True])
    def test_edges_that_are_shown_are_marked(self, is_filled):
        plotter = self.pv.Plotter(off_screen=True, window_size=(320, 240))
        plotter.add_mesh(self.pv.Plane(i_resolution=4, j_resolution=3), show_edges=True, color="tan")
        plotter.add_mesh(self.pv.Plane(center=(2, 0, 0), i_resolution=4, j_resolution=3))
        lines = tn.pv.lines(plotter)
        assert lines.counts["marked"] == 3 * 3 + 2 * 4 and set(lines.object[lines.cls == "marked"].tolist()) == {0}
        tn.pv.export_svg(plotter, "edges.svg", fill=is_filled)
        with open("edges.svg") as file:
            text = file.read()
        assert "visible-marked" in text and ("#d2b48c" in text) == is_filled
        plotter.close()

    def layers(self, plotter, **settings):
        """The colour and width of each visible layer of curves and points."""
        layers = tn.pv.lines(plotter, **settings).layers()
        return {(layer["name"], tuple(round(255 * part) for part in layer["color"]), layer["width"]) for layer in layers if layer["name"] in ("curve", "point")}

    def test_curves_and_points_have_their_actors_colours_and_sizes(self):
        plotter = self.scene()
        plotter.add_mesh(self.pv.Line((-1, 0, 1), (1, 0, 1)), color="red", line_width=3)
        plotter.add_mesh(self.pv.PolyData(np.array([(-1, 1, 1), (1, 1, 1.0)]), lines=[2, 0, 1]))
        plotter.add_points(np.array([(0, 0, 1.5)]), color="navy", point_size=10)
        plotter.add_mesh(self.pv.Plane(center=(0, 0, 2)), style="wireframe", color="green")
        red, navy, green, black = (255, 0, 0), (0, 0, 128), (0, 128, 0), (0, 0, 0)
        assert self.layers(plotter) == {("curve", red, 3), ("curve", black, 2), ("curve", green, 2), ("point", navy, 10)}
        # Settings for all curves replace the actors'.
        green_curves = {"class_colors": {"curve": "green"}, "line_width": 4}
        assert self.layers(plotter, **green_curves) == {("curve", green, 4), ("point", black, 8)}
        for part in ({"curves 1": {"color": "green"}}, "curves 1: color=green", ["curves 1: color=green"]):
            found = self.layers(plotter, part=part)
            assert ("curve", green, 3) in found and ("point", navy, 10) in found, "a given rule is the stronger one"
        tn.pv.export_svg(plotter, "styles.svg", fill=True)
        with open("styles.svg") as file:
            text = file.read()
        assert 'stroke="#ff0000" stroke-width="3"' in text and 'stroke="#000080" stroke-width="10"' in text
        plotter.close()

    def test_curves_and_points_have_the_colours_of_their_scalars(self):
        plotter = self.scene()
        line = self.pv.Line((-1, 0, 2), (1, 0, 2), resolution=4)
        line["x"] = line.points[:, 0]
        plotter.add_mesh(line, cmap=["blue", "red"], n_colors=2)
        dots = self.pv.PolyData(np.array([(0, 0, 1.0), (0, 0, 1.5)]))
        dots["colour"] = np.array([(255, 0, 0), (0, 255, 0)], dtype=np.uint8)
        plotter.add_mesh(dots, scalars="colour", rgb=True)
        red, green, blue = (255, 0, 0), (0, 255, 0), (0, 0, 255)
        found = self.layers(plotter)
        assert {color for name, color, _ in found if name == "curve"} >= {red, blue}
        assert {color for name, color, _ in found if name == "point"} == {red, green}
        # Cells have theirs, too, also behind vertices.
        cells = self.pv.PolyData(np.eye(3), lines=[2, 0, 1, 2, 1, 2], verts=[1, 0])
        cells.cell_data["value"] = [1.0, 0.0, 1.0]
        other = self.pv.Plotter(off_screen=True)
        other.add_mesh(cells, cmap=["blue", "red"])
        assert self.layers(other) == {("curve", blue, 2), ("curve", red, 2), ("point", red, 4)}
        other.close()
        plotter.close()

    def test_actors_of_one_colour_are_filled_as_a_whole(self):
        plotter = self.scene()
        plotter.add_mesh(self.pv.Cube(center=(0.4, 0, 1)), color="red")
        tn.pv.export_svg(plotter, "plain.svg", fill=True)
        with open("plain.svg") as file:
            text = file.read()
        assert text.count('<path fill="#') == 2, "one for each cube, not for each face"
        assert 'fill="#d2b48c"' in text and 'fill="#ff0000"' in text
        plotter.close()

    def test_a_dot_with_a_label_has_the_colour_of_its_points(self):
        plotter = self.scene()
        plotter.add_point_labels(np.array([(0, 0, 1.0), (1, 0, 1)]), ["above", "aside"], point_color="red", point_size=12)
        lines = tn.pv.lines(plotter)
        assert lines.counts["point"] == 2 and [label["text"] for label in lines.labels] == ["above", "aside"]
        assert self.layers(plotter) == {("point", (255, 0, 0), 12)}
        plotter.close()

    def test_several_views_have_one_style_with_a_warning(self):
        plotter = self.pv.Plotter(off_screen=True, window_size=(400, 300), shape=(1, 2))
        plotter.add_mesh(self.pv.Line(), color="red")
        plotter.subplot(0, 1)
        plotter.add_mesh(self.pv.Cube())
        with pytest.warns(UserWarning, match="curves and points lose their colours and sizes"):
            tn.pv.export_svg(plotter, "two.svg")
        plotter.close()

    def test_texts_labels_and_legends_are_written(self):
        plotter = self.scene()
        plotter.add_point_labels([(0, 0, 1), (0, 0, 0)], ["above", "inside"])
        plotter.add_text("a cube\nof one")
        plotter.add_text("here", position=(0.25, 0.5), viewport=True)
        plotter.add_text("small", position=(0.5, 0.5), viewport=True, font_size=5, color="red")
        plotter.add_legend()
        lines = tn.pv.lines(plotter)
        assert [(label["text"], label["visible"]) for label in lines.labels] == [("above", True), ("inside", False)]
        assert lines.counts["point"] == 2, "a label and the dot beside it are one point"
        tn.pv.export_svg(plotter, "texts.svg")
        with open("texts.svg") as file:
            text = file.read()
        for word in (">a cube<", ">of one<", ">here<", ">cube<", ">above<"):
            assert word in text, word
        assert ">inside<" not in text and "#d2b48c" in text
        # PyVista's letters are twice as high as its font size; this theme's colour is that of labels.
        assert '<text x="80" y="112.8" font-size="36" fill="#000000">here<' in text
        assert '<text x="160" y="118" font-size="10" fill="#ff0000">small<' in text
        for ending in ("pdf", "png", "json"):
            tn.pv.export_svg(plotter, f"texts.{ending}")
        plotter.close()

    def test_what_is_left_out_of_a_scene_is_said_once_for_each_kind(self):
        plotter = self.scene()
        plotter.add_mesh(self.pv.Cube(center=(2, 0, 0)), opacity=0.5)
        for _ in range(2):
            plotter.add_volume(np.ones((3, 3, 3)), show_scalar_bar=False)
        plotter.add_axes()
        plotter.show_grid()
        for draw in (tn.pv.lines, lambda plotter: tn.pv.export_svg(plotter, "scene.svg")):
            with pytest.warns(UserWarning) as warnings:
                draw(plotter)
            said = sorted(str(warning.message) for warning in warnings)
            assert said == [
                "plotter: an actor is transparent, but hides lines like an opaque one",
                "plotter: axes of directions are left out",
                "plotter: axes with numbers are left out",
                "plotter: volumes are left out",
            ]
            assert all(warning.filename == __file__ for warning in warnings)
        plotter.close()

    def test_of_subplots_the_active_one_is_drawn_at_its_size(self):
        plotter = self.pv.Plotter(off_screen=True, window_size=(400, 300), shape=(1, 2))
        for column, mesh in enumerate([self.pv.Cube(), self.pv.Sphere()]):
            plotter.subplot(0, column)
            plotter.add_mesh(mesh)
        assert tn.pv.lines(plotter).size == (200, 300) and tn.pv.lines(plotter).counts["crease"] == 0
        plotter.subplot(0, 0)
        assert tn.pv.lines(plotter).counts["silhouette"] == 6
        assert tn.pv.lines(plotter, size=64).size == (64, 64)
        plotter.close()

    def test_a_plotter_that_was_never_shown_is_seen_as_when_it_will_be(self):
        plotter = self.pv.Plotter(off_screen=True, window_size=(300, 300))
        plotter.add_mesh(self.pv.Cube(x_length=3))
        camera = tn.pv.lines(plotter).camera
        plotter.show(auto_close=False)
        assert np.allclose(camera["eye"], plotter.camera.position) and camera["fov"] == plotter.camera.view_angle
        plotter.close()
        with pytest.raises(ValueError, match="plotter: it shows no surface"):
            tn.pv.lines(self.pv.Plotter(off_screen=True))


class TestMatplotlib:
    matplotlib = pytest.importorskip("matplotlib")

    @pytest.fixture(autouse=True)
    def without_a_display(self):
        self.matplotlib.use("agg")
        # Without compression the test can read the file.
        self.matplotlib.rcParams["pdf.compression"] = 0
        import matplotlib.pyplot as plt

        self.plt = plt
        yield
        plt.close("all")
        self.matplotlib.rcdefaults()

    def vectors(self, pdf):
        """How many lines a PDF file draws, and whether a picture is in it."""
        with open(pdf, "rb") as file:
            content = file.read()
        return content.count(b" l\n"), b"/Subtype /Image" in content

    def test_a_drawing_in_plain_axes_is_vectors(self, cube):
        figure, ax = self.plt.subplots()
        ax.set_axis_off()
        figure.savefig("empty.pdf")
        collection = tn.mpl.draw(ax, *cube, hidden="dashed", extent=(0, 2, 0, 2))
        figure.savefig("cube.pdf")
        (before, _), (count, is_picture) = self.vectors("empty.pdf"), self.vectors("cube.pdf")
        assert count - before >= 12 - len(collection.get_paths()) + 3 and not is_picture
        assert collection in ax.collections and all((path.vertices >= 0).all() and (path.vertices <= 2).all() for path in collection.get_paths())
        lines = tn.lines(*cube, hidden="dashed")
        assert len(collection.get_paths()) == sum(len(layer["paths"]) for layer in lines.layers())
        assert len({str(style) for style in collection.get_linestyles()}) == 2

    @pytest.mark.parametrize("projection", ["persp", "ortho"])
    @pytest.mark.parametrize("limits", [(-1, 2), (-1, 5)], ids=["even", "uneven"])
    def test_lines_in_3d_axes_lie_where_matplotlib_projects_them(self, cube, projection, limits):
        from mpl_toolkits.mplot3d import proj3d

        vertices, faces = cube
        figure = self.plt.figure(figsize=(4, 3))
        ax = figure.add_subplot(projection="3d", proj_type=projection)
        ax.set(xlim=(-1, 2), ylim=limits, zlim=(-1, 2))
        collection = tn.mpl.draw(ax, vertices, faces, crease_angle=1)
        for azimuth in (-60, 25):
            ax.view_init(elev=20, azim=azimuth, roll=10)
            figure.savefig("cube3d.pdf")
            x, y, _ = proj3d.proj_transform(*vertices.T, ax.get_proj())
            ends = np.concatenate([path.vertices for path in collection.get_paths()])
            distances = np.linalg.norm(ends[None] - np.column_stack([x, y])[:, None], axis=2).min(axis=1)
            seen = distances < 1e-6
            assert seen.sum() == 7, "all corners but the one behind"
            assert (bounds(ends) - bounds(np.column_stack([x, y])) < 1e-6).all()
        assert not self.vectors("cube3d.pdf")[1]

    def test_3d_axes_scale_to_their_meshes_unless_limits_are_set(self, cube):
        vertices, faces = cube
        ax = self.plt.figure().add_subplot(projection="3d")
        ax.set_zlim(-5, 30)
        tn.mpl.draw(ax, vertices * 20, faces)
        limits = np.array([ax.get_xlim(), ax.get_ylim()])
        assert (limits[:, 0] <= 0).all() and (limits[:, 0] > -2).all() and (limits[:, 1] >= 20).all() and (limits[:, 1] < 22).all()
        assert ax.get_zlim() == (-5, 30)
        drawn = tn.mpl.draw(ax, [(vertices - 10, faces)])
        assert ax.get_xlim()[0] <= -10 and ax.get_xlim()[1] >= 20 and len(drawn.get_paths())
        ax.set_zlim(0, 3)
        with pytest.warns(UserWarning, match="the mesh reaches beyond the limits of the axes"):
            ax.figure.canvas.draw()

    def test_colours_are_matplotlibs(self, cube):
        from matplotlib.colors import to_rgba

        figure, (ax, other) = self.plt.subplots(1, 2)
        for short in ("C0", "k", "0.5", "tab:blue", (0.2, 0.4, 0.6)):
            drawn = tn.mpl.draw(ax, *cube, camera="iso", color=short, class_colors={"crease": "r"})
            expected = {tuple(round(255 * part) for part in to_rgba(color)) for color in (short, "r")}
            assert {tuple(round(255 * part) for part in color) for color in drawn.get_colors()} == expected

    def test_labels_and_widths_are_matplotlibs(self, cube):
        figure, ax = self.plt.subplots()
        solid = self.plt.figure().add_subplot(projection="3d")
        for axes in (ax, solid):
            lines = tn.mpl.draw(axes, *cube, label="edges", linewidth=1.5)
            assert set(lines.get_linewidths()) == {1.5}
            areas = tn.mpl.fill(axes, *cube, colors=np.full((6, 4), 0.5), label="faces", lw=2)
            assert set(areas.get_linewidths()) == {2}
            line, area = axes.legend().legend_handles
            assert line.get_linewidth() == 1.5 and area.get_facecolor() == (0.5, 0.5, 0.5, 0.5) and area.get_width() > area.get_height()
            assert set(tn.mpl.fill(axes, *cube, colors=np.full((6, 4), 0.5)).get_linewidths()) == {0}, "no net"
        with pytest.raises(TypeError, match="linewidth: .* give one of them"):
            tn.mpl.draw(ax, *cube, line_width=1, lw=1)

    def test_lines_that_are_found_are_drawn_with_labels_at_their_points(self, cube):
        vertices, faces = cube
        lines = tn.lines(vertices, faces, view="iso", size=(300, 200))
        figure, ax = self.plt.subplots()
        drawn = tn.mpl.draw(ax, lines, hidden="dashed")
        ends = np.concatenate([path.vertices for path in drawn.get_paths()])
        places = lines.project(vertices) * (1, -1) + (0, 200)
        assert np.linalg.norm(ends[None] - places[:, None], axis=2).min(axis=1).max() < 0.01

    def test_a_figure_pickles_with_its_lines(self, cube):
        import pickle

        ax = self.plt.figure().add_subplot(projection="3d")
        tn.mpl.draw(ax, tn.mesh(*cube))
        again = pickle.loads(pickle.dumps(ax.figure))
        again.axes[0].view_init(elev=10, azim=20)
        again.savefig("again.pdf")
        assert self.vectors("again.pdf")[0] > 9

    def test_a_camera_is_the_axes_own(self, cube):
        figure = self.plt.figure()
        ax = figure.add_subplot(projection="3d")
        ax.set(xlim=(0, 1), ylim=(0, 1), zlim=(0, 1), aspect="equal")
        lines = tn.lines(*cube, camera=ax)
        assert lines.size == (round(ax.bbox.width * 72 / figure.dpi + 0.5), round(ax.bbox.height * 72 / figure.dpi + 0.5)) or lines.size[0] > 100
        with pytest.raises(ValueError, match="camera: 3-D axes have a camera"):
            tn.mpl.draw(ax, *cube, camera="iso")
        with pytest.raises(TypeError, match="camera: give"):
            tn.lines(*cube, camera=figure)
