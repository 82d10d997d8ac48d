"""Exact areas: arrays, files, matplotlib's patches and PyVista's colours."""

import copy
import io
import json
import pickle
import re
import warnings

import numpy as np
import pytest
import tinta_npr


def signed_area(corners):
    x, y = np.asarray(corners).T
    return 0.5 * float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


def is_inside(loops, point):
    """Whether a point is inside closed polygons, by the even-odd rule."""
    crossings = 0
    for corners in loops:
        ends = np.roll(corners, -1, axis=0)
        for (x1, y1), (x2, y2) in zip(corners, ends):
            if (y1 > point[1]) != (y2 > point[1]) and point[0] < x1 + (x2 - x1) * (point[1] - y1) / (y2 - y1):
                crossings += 1
    return crossings % 2 == 1


@pytest.fixture
def lines(cube):
    return tinta_npr.lines(*cube, camera=(30, 20), size=(160, 120))


@pytest.mark.parametrize("by", ["face", "material", "object", "tone"])
def test_areas_fill_the_picture(lines, by):
    areas = lines.regions(by)
    assert areas.by == by and areas.size == (160, 120) and len(areas) == len(areas.loops)
    assert areas.area.sum() == pytest.approx(160 * 120, rel=1e-9)
    for loops, area in zip(areas.loops, areas.area):
        assert abs(sum(signed_area(corners) for corners in loops)) == pytest.approx(area, rel=1e-9)
    assert {"face": 3, "material": 1, "object": 1}.get(by, int(areas.tone.max()) + 1) == (areas.object == 0).sum()
    assert (areas.face >= 0).any() == (by == "face") and (areas.tone >= 0).any() == (by == "tone")
    places = np.random.default_rng(1).uniform((0, 0), (160, 120), (200, 2))
    assert all(sum(is_inside(loops, place) for loops in areas.loops) == 1 for place in places)


def test_a_face_is_that_of_the_given_mesh(cube):
    """Each face's middle is in the area of that face, and nowhere else among visible ones."""
    vertices, faces = cube
    lines = tinta_npr.lines(vertices, faces, camera=(30, 20), size=(160, 120))
    areas = lines.regions()
    seen = areas.face[areas.object >= 0]
    assert len(set(seen)) == 3
    for index in np.flatnonzero(areas.object >= 0):
        middle = lines.project(vertices[faces[areas.face[index]]].mean(axis=0))
        assert is_inside(areas.loops[index], middle)
    values = np.arange(6) * 10.0
    found = areas.of_faces(values)
    assert np.isnan(found[areas.object < 0]).all() and (found[areas.object >= 0] == seen * 10).all()
    assert areas.of_faces(np.ones((6, 3))).shape == (len(areas), 3)
    # One mesh's values alone, in a list, and as a list of rows.
    assert (areas.of_faces([values])[areas.object >= 0] == seen * 10).all()
    colors = np.random.default_rng(2).uniform(size=(6, 3))
    for given in (colors, [colors], colors.tolist(), list(colors)):
        assert (areas.of_faces(given)[areas.object >= 0] == colors[seen]).all()
    with pytest.raises(ValueError, match="values: there are 2, but face"):
        areas.of_faces([1, 2])
    with pytest.raises(ValueError, match="by object; ask for by="):
        lines.regions("object").of_faces(values)


def test_several_meshes_have_values_of_their_own(cube):
    vertices, faces = cube
    beside = vertices + (2, 0, 0)
    areas = tinta_npr.lines([cube, (beside, faces)], camera=(30, 20)).regions()
    found = areas.of_faces([np.zeros(6), np.arange(6) + 1])
    assert (found[areas.object == 0] == 0).all() and (found[areas.object == 1] == areas.face[areas.object == 1] + 1).all()
    with pytest.raises(ValueError, match="give a list with the values of each"):
        areas.of_faces(np.zeros(6))


def test_tones_are_those_of_a_style(lines):
    assert set(lines.regions("tone", style="three-pass", tones=1).tone) == {-1, 0}
    assert lines.regions("tone", tones=2, tone_thresholds=(0, 0.5)).tone.max() == 1
    with pytest.raises(ValueError, match="style charcoal: it has no areas of tone; choose three-pass"):
        lines.regions("tone", style="charcoal")
    with pytest.raises(ValueError, match="tones: only areas of tone have this"):
        lines.regions("face", tones=2)
    with pytest.raises(ValueError, match="by faces: choose one of face, material, object, tone"):
        lines.regions("faces")


def test_files_have_the_areas_below_the_lines(lines):
    areas = lines.regions()
    text = areas.svg(colors=np.full((len(areas), 3), 0.5), title="A cube")
    assert len(re.findall(r'<path data-face="\d" fill="#808080"', text)) == 3 and "visible-crease" in text and "A cube" in text
    assert "visible-crease" in areas.svg() and areas._repr_svg_() == areas.svg()
    file = io.BytesIO()
    areas.save(file, format="pdf")
    assert file.getvalue().startswith(b"%PDF") and areas.pdf() == file.getvalue()
    areas.save("areas.json")
    written = json.load(open("areas.json"))
    assert [region["area_px"] for region in written["regions"]] == areas.area.tolist() and written["objects"][0]["name"] == "mesh"
    for colors, problem in [([[2, 0, 0]] * len(areas), "from 0 to 1"), ([[0, 0, 0]], "give \\(4, 3\\)")]:
        with pytest.raises(ValueError, match=problem):
            areas.svg(colors=colors)
    with pytest.raises(ValueError, match="written as .svg, .pdf or .json, not as .png"):
        areas.save("areas.png")


def test_settings_of_areas_are_those_of_the_command_line(tinta, lines):
    drawn = dict(size=(96, 64), areas="object", no_borders=True)
    tinta_npr.lines("builtin:gear", **drawn).save("ours.svg")
    assert tinta("render", "builtin:gear", "-o", "theirs.svg", "--areas", "object", "--no-borders", "--size", "96x64") == (0, "")
    assert open("ours.svg").read() == open("theirs.svg").read()
    alone = lines.svg(areas="face", no_borders=True)
    assert "visible-" not in alone and "crispEdges" in alone and "visible-" in lines.svg()
    assert json.loads(tinta_npr.lines("builtin:gear", **drawn).json())["segments"] == []
    with pytest.raises(ValueError, match="areas: pixels and layers are of lines alone"):
        lines.png(areas="face")
    with pytest.raises(ValueError, match="no_borders: lines\\(\\) draws nothing but lines"):
        tinta_npr.lines("builtin:gear", no_borders=True)


def test_copies_and_pickles_are_the_same(lines):
    areas = lines.regions("tone", tones=2)
    for other in (copy.copy(areas), copy.deepcopy(areas), pickle.loads(pickle.dumps(areas))):
        assert (other.area == areas.area).all() and (other.tone == areas.tone).all() and other.svg() == areas.svg()
        assert all((a == b).all() for one, two in zip(other.loops, areas.loops) for a, b in zip(one, two))
    quads = pickle.loads(pickle.dumps(lines)).regions()
    assert sorted(quads.face) == sorted(lines.regions().face)


def test_matplotlib_fills_faces(lines, cube):
    pytest.importorskip("matplotlib").use("agg")
    import matplotlib.pyplot as plt

    figure, ax = plt.subplots()
    areas = tinta_npr.mpl.fill(ax, lines, values=np.arange(6), cmap="viridis", vmin=0, vmax=5)
    found = lines.regions()
    faces = found.face[found.object >= 0]
    assert areas.get_array().tolist() == faces.tolist() and areas.get_clim() == (0, 5)
    figure.colorbar(areas)
    figure.savefig("faces.svg")
    # The picture has the colours of the faces at their middles.
    tinta_npr.mpl.draw(ax, lines, color="k")
    figure.canvas.draw()
    pixels = np.asarray(figure.canvas.buffer_rgba())
    vertices, corners = cube
    for face in faces:
        x, y = lines.project(vertices[corners[face]].mean(axis=0))
        column, row = ax.transData.transform((x, 120 - y))
        expected = np.round(np.array(plt.get_cmap("viridis")(face / 5)[:3]) * 255)
        assert abs(pixels[int(len(pixels) - row), int(column), :3] - expected).max() <= 1
    for by in ("face", "material", "object", "tone"):
        assert len(tinta_npr.mpl.fill(ax, lines.regions(by)).get_paths()) == (lines.regions(by).object >= 0).sum()
    colored = tinta_npr.mpl.fill(ax, *cube, colors=np.eye(6, 3), camera=(30, 20))
    assert colored.get_facecolor().shape == (3, 4)
    with pytest.raises(ValueError, match="leave out one of values and colors"):
        tinta_npr.mpl.fill(ax, lines, values=np.arange(6), colors=np.eye(6, 3))
    plt.close(figure)


def test_matplotlib_finds_areas_again_in_each_view(cube):
    pytest.importorskip("matplotlib").use("agg")
    import matplotlib.pyplot as plt

    figure = plt.figure()
    ax = figure.add_subplot(projection="3d")
    areas = tinta_npr.mpl.fill(ax, *cube, values=np.arange(6))
    seen = set()
    for azimuth in (-60, 120):
        ax.view_init(20, azimuth)
        figure.canvas.draw()
        seen |= set(areas.get_array().tolist())
    assert len(areas.get_paths()) == 3 and len(seen) == 5, "the bottom is never seen"
    plt.close(figure)


def fills_of(file):
    """The colours of faces in an SVG, by the number of the object and of the face."""
    found = {}
    for group in re.findall(r'<g id="fill-(\d+)".*?</g>', open(file).read(), re.S):
        text = re.search(rf'<g id="fill-{group}".*?</g>', open(file).read(), re.S).group(0)
        for face, color in re.findall(r'data-face="(\d+)" fill="(#\w+)"', text):
            found[int(group), int(face)] = color
    return found


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_pyvista_fills_have_the_colours_of_its_mappers():
    pv = pytest.importorskip("pyvista")
    matplotlib = pytest.importorskip("matplotlib")
    sphere = pv.Sphere(theta_resolution=12, phi_resolution=8)
    sphere.cell_data["number"] = np.arange(sphere.n_cells, dtype=float)
    sphere.point_data["height"] = sphere.points[:, 2]
    plotter = pv.Plotter(off_screen=True, window_size=(160, 120))
    plotter.add_mesh(sphere.copy(), scalars="number", cmap="viridis", clim=[0, sphere.n_cells - 1], show_scalar_bar=False)
    plotter.add_mesh(sphere.translate((2, 0, 0)), scalars="height", cmap="viridis", show_scalar_bar=False)
    plotter.add_mesh(pv.Cube(center=(4, 0, 0)).cast_to_unstructured_grid(), color="red")
    plotter.view_xz()
    tinta_npr.pv.export_svg(plotter, "filled.svg", fill=True)
    found = fills_of("filled.svg")
    viridis = matplotlib.colormaps["viridis"]

    def is_near(color, share):
        rgb = [int(color[at : at + 2], 16) for at in (1, 3, 5)]
        return np.abs(np.array(viridis(share)[:3]) * 255 - rgb).max() <= 4

    heights = sphere.point_data["height"][sphere.faces.reshape(-1, 4)[:, 1:]].mean(axis=1)
    assert {object for object, _ in found} == {0, 1, 2}
    for (object, face), color in found.items():
        if object == 0:
            assert is_near(color, face / (sphere.n_cells - 1)), (face, color)
        elif object == 1:
            assert is_near(color, (heights[face] + 0.5)), (face, color)
        else:
            assert color == "#ff0000"
    colored = sphere.copy()
    colored.cell_data["own"] = (np.full((sphere.n_cells, 3), 255 * np.array([0, 1, 0]))).astype(np.uint8)
    other = pv.Plotter(off_screen=True)
    other.add_mesh(colored, scalars="own", rgb=True)
    other.add_mesh(sphere.translate((2, 0, 0)), scalars="number")
    tinta_npr.pv.export_svg(other, "other.svg", fill=True)
    assert {color for (object, _), color in fills_of("other.svg").items() if object == 0} == {"#00ff00"}
    for each in (plotter, other):
        each.close()


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
@pytest.mark.parametrize("is_upright", [False, True])
@pytest.mark.parametrize("is_logarithmic", [False, True])
def test_a_scalar_bar_is_vectors_whose_colours_and_numbers_are_those_of_its_table(is_upright, is_logarithmic):
    pv = pytest.importorskip("pyvista")
    matplotlib = pytest.importorskip("matplotlib")
    sphere = pv.Sphere(theta_resolution=12, phi_resolution=8)
    plotter = pv.Plotter(off_screen=True, window_size=(400, 300))
    bar = {"title": "Height [m]", "vertical": is_upright, "n_labels": 3, "n_colors": 16, "fmt": "%.1f"}
    plotter.add_mesh(
        sphere, scalars=sphere.points[:, 2] + 1, cmap="viridis", n_colors=16, clim=[1, 100], log_scale=is_logarithmic, scalar_bar_args=bar
    )
    tinta_npr.pv.export_svg(plotter, "bar.svg", fill=True)
    tinta_npr.pv.export_svg(plotter, "bar.pdf", fill=True, title="a sphere")
    with open("bar.svg") as file:
        text = file.read()
    texts = [(float(x), float(y), said) for x, y, said in re.findall(r'<text x="([-\d.]+)" y="([-\d.]+)"[^>]*>([^<]+)', text)]
    assert [said for *_, said in texts] == ["Height [m]", "1.0", "10.0" if is_logarithmic else "50.5", "100.0"]
    along = [-y if is_upright else x for x, y, _ in texts[1:]]
    assert along[1] - along[0] == pytest.approx(along[2] - along[1], abs=0.01) and along[2] > along[0] + 50
    boxes = re.findall(r'<rect x="([-\d.]+)" y="([-\d.]+)" width="([-\d.]+)" height="([-\d.]+)" fill="(#\w+)"', text)
    frame, steps, ticks = boxes[0], boxes[1:17], boxes[17:]
    assert len(ticks) == 3 and frame[4] == "#000000"
    for number, (*_, color) in enumerate(steps):
        rgb = [int(color[at : at + 2], 16) for at in (1, 3, 5)]
        assert np.abs(np.array(matplotlib.colormaps["viridis"].resampled(16)(number)[:3]) * 255 - rgb).max() <= 1.01, number
    # Equal steps up to the end.
    left, top, width, height = np.array([box[:4] for box in steps], dtype=float).T
    length, other = (height, width) if is_upright else (width, height)
    assert np.allclose(length / length[0], np.arange(16, 0, -1) / 16, atol=1e-3) and np.allclose(other, other[0])
    end = top if is_upright else left + width
    assert np.allclose(end, end[0], atol=2e-3)
    # On paper letters have ten points, and are not cut off.
    tinta_npr.pv.export_svg(plotter, "paper.svg", fill=True, width_mm=60)
    with open("paper.svg") as file:
        text = file.read()
    letter = float(re.search(r'font-size="([\d.]+)"', text).group(1))
    assert letter == pytest.approx(3.53 * 400 / 60, abs=0.01)
    for x, y, said in re.findall(r'<text x="([-\d.]+)" y="([-\d.]+)"[^>]*>([^<]+)', text):
        right = float(x) + 0.5 * letter * len(said) * (1 if is_upright else 0.5)
        assert letter <= float(y) <= 300 - 0.2 * letter and (right <= 400 or said == "Height [m]"), said
    with open("bar.pdf", "rb") as file:
        content = file.read()
    assert b"+DejaVuSans" in content and b"/Image" not in content
    assert all(b"<%04X>" % ord(letter) in content for letter in "Height [m]")
    plotter.close()


@pytest.mark.parametrize("name", ["categories", "one value", "opacities"])
def test_a_scalar_bar_of_few_values_names_each_once(name):
    pv = pytest.importorskip("pyvista")
    cube = pv.Cube().triangulate()
    plotter = pv.Plotter(off_screen=True, window_size=(400, 300))
    given = {"categories": np.array(list("abcabcabcabc")), "one value": np.full(12, 3.0), "opacities": np.arange(12.0)}[name]
    opacity = "linear" if name == "opacities" else 1.0
    plotter.add_mesh(cube, scalars=given, opacity=opacity, scalar_bar_args={"title": "kind", "fmt": "%.1f", "n_labels": 2})
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        tinta_npr.pv.export_svg(plotter, "few.svg", fill=True)
    ours = [str(one.message) for one in said if str(one.message).startswith("plotter")]
    assert ours == (["plotter: opacities of single scalars are left out; give the actor one opacity"] if name == "opacities" else [])
    with open("few.svg") as file:
        texts = re.findall(r"<text[^>]*>([^<]+)", file.read())
    assert texts == ["kind", *{"categories": "abc", "one value": ["3.0"], "opacities": ["0.0", "11.0"]}[name]]
    plotter.close()


def fills_by_object(text):
    """The sets of the data of all areas in the SVG's layers of objects."""
    found = {}
    for number, layer in re.findall(r'<g id="fill-(\d+)"[^>]*>(.*?)</g>', text, re.S):
        found.setdefault(int(number), set()).update(re.findall(r'data-face[^>]* d="([^"]+)"', layer))
    return found


def test_what_is_opaque_shows_through_a_transparent_actor():
    pv = pytest.importorskip("pyvista")

    def drawn(name, has_hull, opacity=0.5):
        plotter = pv.Plotter(off_screen=True, window_size=(200, 200))
        if has_hull:
            plotter.add_mesh(pv.Sphere(theta_resolution=8, phi_resolution=6), color="blue", opacity=opacity)
        plotter.add_mesh(pv.Cube(x_length=0.3, y_length=0.3, z_length=0.3), color="red")
        plotter.camera_position = [(3, 2.5, 2), (0, 0, 0), (0, 0, 1)]
        tinta_npr.pv.export_svg(plotter, name, fill=True)
        plotter.close()
        with open(name, "rb") as file:
            return file.read()

    alone = drawn("alone.svg", False).decode()
    with pytest.warns(UserWarning, match="an actor is transparent: its nearest surface alone is drawn") as said:
        through = drawn("through.svg", True).decode()
    assert len(said) == 1 and said[0].filename == __file__
    assert fills_by_object(through)[1] == fills_by_object(alone)[0], "the cube is drawn as without the sphere"
    lines = [set(re.findall(r'd="([^"]+)"', text.split("visible-crease")[1].split("</g>")[0])) for text in (alone, through)]
    assert lines[0] and lines[0] <= lines[1]
    [veil] = re.findall(r'<g opacity="0.5">(.*?)\n</g>\n<g id="visible', through, re.S)
    assert set(fills_by_object(veil)) == {0} and through.index("fill-1") < through.index("opacity")
    assert 'fill="#ff0000"' not in veil and 'fill="#0000ff"' in veil
    with pytest.warns(UserWarning):
        pdf = drawn("through.pdf", True)
    assert b"/ca 0.5" in pdf and b"/S /Transparency" in pdf
    hidden = drawn("hidden.svg", True, opacity=1.0).decode()
    assert set(fills_by_object(hidden)) == {0}
    invisible = drawn("invisible.svg", True, opacity=0.0).decode()
    assert fills_by_object(invisible) == fills_by_object(alone)


@pytest.mark.parametrize("fill", [False, True])
def test_subplots_are_drawn_at_their_places(fill):
    pv = pytest.importorskip("pyvista")
    meshes = [pv.Cube(), pv.Cone(resolution=5)]
    whole = pv.Plotter(off_screen=True, window_size=(400, 300), shape=(1, 2))
    paths = []
    for column, mesh in enumerate(meshes):
        whole.subplot(0, column)
        whole.add_mesh(mesh, show_scalar_bar=False)
        single = pv.Plotter(off_screen=True, window_size=(200, 300))
        single.add_mesh(mesh, show_scalar_bar=False)
        tinta_npr.pv.export_svg(single, "single.svg", fill=fill)
        with open("single.svg") as file:
            paths.append(sorted(points_of(file.read())))
        single.close()
    tinta_npr.pv.export_svg(whole, "whole.svg", fill=fill)
    with open("whole.svg") as file:
        text = file.read()
    assert 'width="400" height="300"' in text
    found = sorted(points_of(text))
    expected = sorted(paths[0] + [(x + 200, y) for x, y in paths[1]])
    assert len(found) == len(expected) and np.allclose(found, expected, atol=2e-3)
    ids = re.findall(r'<g id="([^"]+)"', text)
    assert len(ids) == len(set(ids)) and (len([name for name in ids if name in ("fill-0", "fill-1")]) == 2) == fill
    tinta_npr.pv.export_svg(whole, "whole.pdf", fill=fill)
    if not fill:
        tinta_npr.pv.export_svg(whole, "whole.png", size=(800, 600))
        with open("whole.png", "rb") as file:
            assert file.read()[16:24] == (800).to_bytes(4, "big") + (600).to_bytes(4, "big")
    with pytest.raises(ValueError, match="areas: subplots have the colours of their actors"):
        tinta_npr.pv.export_svg(whole, "whole.svg", areas="object")
    whole.close()


def points_of(svg):
    """The corners of all paths in an SVG."""
    data = " ".join(re.findall(r' d="([^"]+)"', svg))
    numbers = [float(number) for number in re.findall(r"-?\d+(?:\.\d+)?", data)]
    return list(zip(numbers[::2], numbers[1::2]))


@pytest.mark.parametrize("by", ["face", "material", "object", "tone"])
def test_areas_are_valid_polygons_of_shapely(by):
    shapely = pytest.importorskip("shapely", reason="shapely is not installed: polygons are not tested by it")
    for model in ("builtin:bust", "builtin:gear", "builtin:open-box"):
        areas = tinta_npr.lines(model, camera="iso", parallel=True, size=300).regions(by)
        scale = areas.lines.camera["height"] / 300
        for units, unit in (("pixels", 1), ("model", scale**2)):
            polygons = [shapely.Polygon(*polygon) for polygon in areas.polygons(units)]
            assert all(polygon.is_valid for polygon in polygons)
            assert np.allclose([polygon.area for polygon in polygons], areas.area * unit, rtol=1e-6, atol=1e-9)


def test_outlines_are_in_the_models_units(cube):
    vertices, faces = cube
    hole = vertices * (0.5, 0.5, 0.5) + (0.25, 0.25, 3)
    areas = tinta_npr.lines([(vertices * (1, 2, 3), faces), (hole, faces)], view="top", parallel=True, up_axis="z").regions("object")
    polygons = dict(zip(areas.object.tolist(), areas.polygons("model")))
    outer, [hidden] = polygons[0]
    assert np.allclose(bounds(outer), [(0, 0), (1, 2)]) and np.allclose(bounds(hidden), [(0.25, 0.25), (0.75, 0.75)])
    front = tinta_npr.lines(vertices * (1, 2, 3), faces, view="front", parallel=True).regions("object")
    [(outer, holes)] = [polygon for polygon, number in zip(front.polygons("model"), front.object) if number == 0]
    assert np.allclose(bounds(outer), [(0, 0), (1, 2)]) and not holes
    with pytest.raises(ValueError, match="units: .*parallel=True"):
        tinta_npr.lines(*cube).regions().polygons("model")
    with pytest.raises(ValueError, match="units: this camera's matrix"):
        tinta_npr.lines(*cube, camera=OBLONG).regions().polygons("model")
    with pytest.raises(ValueError, match="units mm: choose one of pixels, model"):
        areas.polygons("mm")


OBLONG = np.array([[60.0, 0, 10, 90], [0, -90, 20, 300], [0, 0, 0, 1]])


def bounds(points):
    return np.array([points.min(axis=0), points.max(axis=0)])


@pytest.mark.parametrize("view", [{"camera": (30, 20)}, {"camera": (30, 20), "parallel": True}, {"camera": OBLONG}], ids=["near", "parallel", "oblong"])
def test_the_surface_that_is_seen_is_that_of_the_faces(cube, view):
    vertices, faces = cube
    lines = tinta_npr.lines(vertices * (1, 2, 3), faces, size=400, **view)
    found = lines.visible_area()
    whole = {(0, number): side for number, side in enumerate([6, 6, 3, 3, 2, 2])}
    assert len(found) == 3 and found == pytest.approx({key: whole[key] for key in found}, rel=1e-6)
    assert lines.visible_area("object") == pytest.approx({0: 11}, rel=1e-6)
    assert lines.visible_area("material") == pytest.approx({(0, -1): 11}, rel=1e-6)


def test_the_surface_of_a_ball_is_seen_by_half_and_behind_others_not_at_all(cube):
    vertices, faces = cube
    count = 24
    turn, fall = np.meshgrid(np.arange(2 * count) * np.pi / count, np.arange(1, count) * np.pi / count)
    ring = np.column_stack([(np.sin(fall) * np.cos(turn)).ravel(), np.cos(fall).ravel(), (np.sin(fall) * np.sin(turn)).ravel()])
    first, across = np.arange(2 * count), np.roll(np.arange(2 * count), -1)
    squares = [[a + row, a + row + 2 * count, b + row + 2 * count, b + row] for row in range(0, 2 * count * (count - 2), 2 * count) for a, b in zip(first, across)]
    ends = [[2 * count * (count - 1), b, a] for a, b in zip(first, across)]
    last = 2 * count * (count - 2)
    ends += [[2 * count * (count - 1) + 1, last + a, last + b] for a, b in zip(first, across)]
    points, faces_of_ball = np.concatenate([ring, [(0, 1, 0), (0, -1, 0)]]), [*squares, *[face[::-1] for face in ends]]
    faces_of_ball = [face[::-1] for face in faces_of_ball]
    found = tinta_npr.lines(points, faces_of_ball, camera=(13, 17), parallel=True).visible_area("object")
    assert found[0] == pytest.approx(2 * np.pi, rel=0.01)
    hidden = tinta_npr.lines([cube, (vertices - (0, 0, 3), faces)], view="front", parallel=True, curves=[[(0, 0, 0), (2, 2, 2)]])
    assert hidden.visible_area("object") == pytest.approx({0: 1})
    with pytest.raises(ValueError, match="by tone: choose one of face, material, object"):
        hidden.visible_area("tone")


def test_a_png_has_the_areas_below_its_lines():
    pv = pytest.importorskip("pyvista")
    plotter = pv.Plotter(off_screen=True, window_size=(200, 100), shape=(1, 2), border=False)
    plotter.add_mesh(pv.Sphere(), color="blue", opacity=0.5)
    plotter.add_mesh(pv.Cube(x_length=0.3, y_length=0.3, z_length=0.3), color="red")
    plotter.view_xz()
    plotter.subplot(0, 1)
    sphere = pv.Sphere()
    plotter.add_mesh(sphere, scalars=sphere.points[:, 2], cmap=["lime", "navy"], n_colors=2)
    plotter.view_xz()

    def drawn(name, **settings):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tinta_npr.pv.export_svg(plotter, name, fill=True, **settings)
        return tinta_npr._pixels.of_png(open(name, "rb").read())

    yellow = drawn("yellow.png", background="yellow")
    assert yellow.shape == (100, 200, 4) and (yellow[..., 3] == 1).all()
    colors = {"corner": yellow[0, 0], "ball": yellow[25, 50], "box": yellow[50, 50], "upper": yellow[30, 150], "lower": yellow[70, 150]}
    expected = {"corner": (1, 1, 0), "ball": (0.5, 0.5, 0.5), "box": (0.5, 0, 0.5), "upper": (0, 0, 128 / 255), "lower": (0, 1, 0)}
    for place, color in expected.items():
        assert np.abs(colors[place][:3] - color).max() < 0.01, place
    assert np.abs(yellow[..., :3]).sum(axis=2).min() < 0.01, "lines are black"
    clear = drawn("clear.png", background="transparent")
    assert clear[0, 0].tolist() == [0, 0, 0, 0] and clear[25, 50] == pytest.approx((0, 0, 1, 0.5), abs=0.01)
    plotter.close()


def test_pixels_have_the_exact_shares_of_areas():
    from tinta_npr._pixels import of_areas

    corners = np.array([(-3, -2), (-3, 7.25), (9, 7.25), (9, -2)], dtype=float)
    hole = np.array([(1.5, 1.25), (4.25, 1.5), (3, 4.75)])
    both = [[corners, hole], [hole[::-1]]]
    pixels = of_areas((6, 8), both, np.array([(1, 0, 0), (0, 0.5, 1)]))
    triangle = 0.5 * abs(np.linalg.det((hole - hole[0])[1:]))
    assert pixels[..., 1].sum() == pytest.approx(0.5 * triangle) and pixels[..., 0].sum() == pytest.approx(6 * 7.25 - triangle)
    assert np.allclose(pixels[:7, :, 3], 1) and np.allclose(pixels[7, :, 3], 0.25), "neighbours leave no seam"
    assert (of_areas((6, 8), [], np.empty((0, 3))) == 0).all()
