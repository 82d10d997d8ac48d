"""matplotlib's 3-D axes drawn again: every piece against rays, styles, places, and the way back."""

import os
import runpy
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

import tinta_npr as tn

plt = pytest.importorskip("matplotlib.pyplot")
plt.switch_backend("agg")
Line3DCollection = pytest.importorskip("mpl_toolkits.mplot3d.art3d").Line3DCollection

EXAMPLES = Path(os.environ.get("TINTA_EXAMPLES") or Path(__file__).parents[1] / "examples")
NAMES = ["orbit", "path_on_waves", "plane_arrow_points", "line_by_a_fold", "bars_and_their_means"]


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


def filled(name, **axes):
    ax = plt.figure(figsize=(4, 3)).add_subplot(projection="3d", **axes)
    runpy.run_path(str(EXAMPLES / "matplotlib_3d.py"))[name](ax)
    return ax


def triangles_of(ax, first):
    """All triangles of the axes' surfaces, squares cut from their corner `first`: (N, 3, 3); read before they are drawn again."""
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    from tinta_npr._mpl3d import Surface, _bent_apart

    found = []
    for artist in ax.get_children():
        if isinstance(artist, Poly3DCollection):
            for polygon in Surface(artist, np.ones(3), lambda points: points).polygons:
                for part in _bent_apart(polygon):
                    part = np.roll(part, -first, axis=0)
                    found += [(part[0], one, other) for one, other in zip(part[1:], part[2:])]
    return np.array(found)


def hits(triangles, points, towards):
    """How far along each ray the triangles lie, infinite where it passes them by (Moeller, Trumbore): (N, M); and how near to their
    edges."""
    a, ab, ac = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    across = np.cross(towards[:, None], ac[None])
    determinant = (ab[None] * across).sum(-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        away = points[:, None] - a[None]
        u = (away * across).sum(-1) / determinant
        turned = np.cross(away, ab[None])
        v = (turned * towards[:, None]).sum(-1) / determinant
        distance = (turned * ac[None]).sum(-1) / determinant
    inside = np.minimum(np.minimum(u, v), 1 - u - v)
    return np.where(np.isfinite(distance), distance, np.inf), np.where(np.isfinite(inside), inside, -np.inf)


@pytest.mark.parametrize("projection", ["persp", "ortho"])
@pytest.mark.parametrize("name", NAMES)
def test_pieces_of_curves_and_points_are_as_rays_say(name, projection):
    """A point of a curve is drawn if nothing lies between it and the eye; those within 2e-3 of a surface, and rays that graze an edge or
    the end of a piece, are left out, and points that depend on the diagonals of squares that are not flat."""
    ax = filled(name, proj_type=projection)
    ax.view_init(elev=25, azim=-50)
    both = [triangles_of(ax, first) for first in (0, 1)]
    from tinta_npr._mpl3d import Curves, held

    # Edges of surfaces come after the curves, and are near a surface everywhere.
    own = sum(len(curve) for one in held(ax)[1] if isinstance(one, Curves) for curve in one.curves)
    scene = tn.mpl.draw3d(ax)
    lines, matrix = scene.lines, ax.get_proj()
    # The eye, or the direction to it, is the point that the projection's rows x, y and w have no value for.
    eye = np.linalg.svd(matrix[[0, 1, 3]])[2][-1]
    positions = np.concatenate(scene._settings["curves"])
    is_curve = (lines.cls == "curve") & (lines.edge[:, 1] < own)
    random = np.random.default_rng(1)
    pieces = random.choice(np.flatnonzero(is_curve), 300)
    ends = positions[lines.edge[pieces]]
    share = random.random(len(pieces))
    points = ends[:, 0] + (ends[:, 1] - ends[:, 0]) * share[:, None]
    pixels = lines.project(points)
    towards = (eye[:3] / eye[3] - points) if abs(eye[3]) > 1e-9 else np.tile(eye[:3], (len(points), 1))
    if abs(eye[3]) <= 1e-9:
        elevation, azimuth = np.radians([25, -50])
        seen_from = [np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)]
        towards = towards * np.sign((eye[:3] * seen_from).sum()) * 1e6
    size = np.ptp(positions, axis=0).max()
    length = np.linalg.norm(towards, axis=1)
    blocked, is_unclear = [], np.zeros(len(points), dtype=bool)
    for triangles in both:
        distance, inside = hits(triangles, points, towards / length[:, None])
        is_near, is_grazed = (np.abs(distance) < 2e-3 * size) & (inside > -0.02), (np.abs(inside) < 1e-6) & (distance > 0)
        is_unclear |= (is_near | is_grazed).any(axis=1)
        blocked.append(((distance > 0) & (distance < length[:, None]) & (inside > 0)).any(axis=1))
    is_unclear |= blocked[0] != blocked[1]
    wrong = counted = 0
    for number, piece in enumerate(pieces):
        same = np.flatnonzero(is_curve & (lines.edge == lines.edge[piece]).all(axis=1))
        starts, stops = lines.segments[same, 0], lines.segments[same, 1]
        along = stops - starts
        lengths = np.maximum((along**2).sum(axis=1), 1e-30)
        at = ((pixels[number] - starts) * along).sum(axis=1) / lengths
        within = np.flatnonzero((at > 1e-3) & (at < 1 - 1e-3))
        if len(within) != 1 or is_unclear[number]:
            continue
        counted += 1
        wrong += bool(lines.visible[same[within[0]]]) == bool(blocked[0][number])
    assert counted > 60 and wrong == 0, f"{wrong} of {counted}"


def test_artists_keep_their_styles_and_come_back():
    ax = filled("bars_and_their_means")
    scene = tn.mpl.draw3d(ax, hidden="dashed")
    from mpl_toolkits.mplot3d.art3d import Line3D, Poly3DCollection

    held = [artist for artist in ax.get_children() if isinstance(artist, (Line3D, Poly3DCollection))]
    assert held and not any(artist.get_visible() for artist in held)
    widths = set(np.round(scene._strokes.get_linewidth(), 3))
    assert widths == {0.6, 1.5}, widths
    assert any(style != (0, None) for style in scene._strokes.get_linestyle())
    assert len(scene._marks) == 1 and 0 < len(scene._marks[0].get_offsets()) < 4
    scene.remove()
    assert all(artist.get_visible() for artist in held)
    assert scene not in ax.get_children()
    ax.figure.savefig("again.svg")


def test_it_lies_where_matplotlib_projects_it_and_follows_the_view():
    from mpl_toolkits.mplot3d import proj3d

    ax = plt.figure().add_subplot(projection="3d")
    ax.plot([0, 1, 1], [0, 0, 1], [0, 0.3, 1], "b")
    ax.scatter([0.5], [0.5], [0.2])
    scene = tn.mpl.draw3d(ax)
    for azimuth in (-60, 40):
        ax.view_init(elev=20, azim=azimuth)
        ax.figure.canvas.draw()
        x, y, _ = proj3d.proj_transform([0, 1, 1], [0, 0, 1], [0, 0.3, 1], ax.get_proj())
        [path] = scene._strokes.get_segments()
        assert np.abs(path - np.column_stack([x, y])).max() < 1e-6
        x, y, _ = proj3d.proj_transform([0.5], [0.5], [0.2], ax.get_proj())
        assert np.abs(scene._marks[0].get_offsets() - np.column_stack([x, y])).max() < 1e-6


def test_gaps_end_curves_and_holes_end_surfaces():
    ax = plt.figure().add_subplot(projection="3d")
    ax.plot([0, 1, np.nan, 2, 3], [0] * 5, [0] * 5)
    ax.scatter([0, np.nan], [1, 1], [0, 0])
    x, y = np.meshgrid([0.0, 1, 2], [0.0, 1, 2])
    z = np.where((x == 2) & (y == 2), np.nan, 0 * x - 1)
    ax.plot_surface(x, y, z)
    scene = tn.mpl.draw3d(ax)
    assert len(scene._strokes.get_segments()) == 2 and len(scene._marks[0].get_offsets()) == 1 and scene.get_paths()


def test_a_surface_without_colour_keeps_its_edges():
    ax = plt.figure().add_subplot(projection="3d")
    ax.plot_surface(*np.meshgrid([0.0, 1], [0.0, 1]), np.zeros((2, 2)), color=(0, 0, 0, 0), edgecolor="k")
    scene = tn.mpl.draw3d(ax)
    assert scene._strokes.get_segments() and not scene.get_paths()


@pytest.mark.parametrize("count", [100, 101], ids=["sides cross", "corners touch"])
@pytest.mark.filterwarnings("error")
def test_an_area_between_curves_that_meet_is_whole(count):
    """As `fill_between` makes it, which older versions of matplotlib lack in 3-D."""
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    ax = plt.figure().add_subplot(projection="3d", xlim=(-3, 3), ylim=(-1, 1), zlim=(-1, 1))
    x = np.linspace(-3, 3, count)
    around = np.concatenate([np.column_stack([x, 0 * x, np.sin(x)]), np.column_stack([x, 0 * x, 0 * x])[::-1]])
    ax.add_collection3d(Poly3DCollection([around]))
    lines = tn.mpl.draw3d(ax).lines
    areas = lines.regions()
    found = areas.area[areas.object == 0].sum()
    # Both lobes, each between its curve and the base line.
    curve = np.column_stack([x, 0 * x, np.sin(x)])
    lobes = [np.concatenate([[[0, 0, 0]], side, [[side[-1, 0], 0, 0]]]) for side in (curve[x < -1e-9][::-1], curve[x > 1e-9])]
    wanted = 0.0
    for a, b in (lines.project(lobe).T for lobe in lobes):
        wanted += abs(np.dot(a, np.roll(b, -1)) - np.dot(b, np.roll(a, -1))) / 2
    assert found == pytest.approx(wanted, rel=1e-7)


def test_a_translucent_surface_is_one_opaque_colour_over_the_background():
    figure = plt.figure(facecolor="white")
    ax = figure.add_subplot(projection="3d", facecolor="yellow")
    x, y = np.meshgrid(np.linspace(-1, 1, 9), np.linspace(-1, 1, 9))
    ax.plot_surface(x, y, x * y, color="red", alpha=0.25, shade=False)
    with pytest.warns(UserWarning, match="translucent"):
        scene = tn.mpl.draw3d(ax)
    assert len(scene.get_paths()) > 30 and np.allclose(scene.get_facecolor(), (1, 0.75, 0, 1))
    assert len(scene._strokes.get_segments()) == 0, "no seams"


def test_a_translucent_surface_of_a_colour_map_is_said_and_mixed_like_one_of_one_colour():
    mapped = {}
    for alpha in (None, 0.25):
        ax = plt.figure(facecolor="white").add_subplot(projection="3d", facecolor="yellow")
        x, y = np.meshgrid(np.linspace(-1, 1, 9), np.linspace(-1, 1, 9))
        ax.plot_surface(x, y, x * y, cmap="viridis", alpha=alpha)
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            mapped[alpha] = tn.mpl.draw3d(ax).get_facecolor()
        assert ["translucent" in str(one.message) for one in said] == [True] * (alpha is not None)
    assert np.allclose(mapped[0.25][:, :3], mapped[None][:, :3] * 0.25 + np.array([1, 1, 0]) * 0.75)


def test_translucent_curves_and_points_of_a_colour_map_stay_translucent():
    ax = plt.figure().add_subplot(projection="3d")
    ax.scatter([0, 1], [0, 1], [0, 1], c=[0, 1], cmap="viridis", alpha=0.5, depthshade=False)
    segments = Line3DCollection([[(0, 0, 0), (1, 0, 0)], [(0, 1, 0), (1, 1, 0)]], cmap="viridis", array=[0, 1], alpha=0.5)
    ax.add_collection3d(segments)
    scene = tn.mpl.draw3d(ax)
    assert np.allclose(scene._marks[0].get_facecolor()[:, 3], 0.5)
    assert np.allclose(np.array(scene._strokes.get_edgecolor())[:, 3], 0.5)


def test_masked_places_are_gaps():
    ax = plt.figure().add_subplot(projection="3d")
    ax.plot(np.ma.masked_greater([0.0, 1, 99, 2, 3], 9), [0.0] * 5, [0.0] * 5, "o-")
    scene = tn.mpl.draw3d(ax)
    assert len(scene._strokes.get_segments()) == 2 and len(scene._marks[0].get_offsets()) == 4


def test_widths_have_matplotlibs_names_too():
    ax = plt.figure().add_subplot(projection="3d")
    ax.plot_surface(*np.meshgrid([0, 1], [0, 1]), np.zeros((2, 2)))
    for name in ("lw", "linewidth", "line_width"):
        scene = tn.mpl.draw3d(ax, classes="boundary", **{name: 3})
        assert set(scene._strokes.get_linewidth()) == {3}
        scene.remove()
    with pytest.raises(TypeError, match="linewidth: .* give one of them"):
        tn.mpl.draw3d(ax, lw=1, line_width=2)


def test_what_it_cannot_draw_is_said():
    figure = plt.figure()
    with pytest.raises(TypeError, match="3-D axes"):
        tn.mpl.draw3d(figure.add_subplot())
    ax = figure.add_subplot(projection="3d")
    with pytest.raises(ValueError, match="plot them first"):
        tn.mpl.draw3d(ax)
    ax.plot_surface(*np.meshgrid([0, 1], [0, 1]), np.zeros((2, 2)), alpha=0.5)
    with pytest.raises(ValueError, match="there is no class edge; choose from"):
        tn.mpl.draw3d(ax, classes="edge")
    with pytest.raises(ValueError, match="dashed or ghost, not dotted"):
        tn.mpl.draw3d(ax, hidden="dotted")
    with pytest.warns(UserWarning, match="translucent"):
        tn.mpl.draw3d(ax)
    ax = figure.add_subplot(projection="3d")
    ax.plot([np.nan, 1], [0, np.nan], [0, 0])
    with pytest.raises(ValueError, match="ax: nothing of its surfaces, curves and points is left to draw: their values are NaN"):
        tn.mpl.draw3d(ax)


def test_another_matplotlib_is_named(monkeypatch):
    from mpl_toolkits.mplot3d.art3d import Line3D

    ax = plt.figure().add_subplot(projection="3d")
    ax.plot([0, 1], [0, 1], [0, 1])
    monkeypatch.delattr(Line3D, "get_data_3d")
    with pytest.raises(RuntimeError, match="draw3d reads 3-D axes of matplotlib 3.8 to .*get_data_3d.*draw works with all"):
        tn.mpl.draw3d(ax)


def test_drawing_in_plain_axes_imports_nothing_private():
    program = "import sys, tinta_npr.mpl as m; from matplotlib.figure import Figure; " \
        "m.draw(Figure().add_subplot(), 'builtin:gear'); sys.exit('tinta_npr._mpl3d' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", program]).returncode == 0


def test_every_kind_of_plot_is_vectors():
    ax = plt.figure().add_subplot(projection="3d")
    x, y = np.meshgrid(np.linspace(-1, 1, 9), np.linspace(-1, 1, 9))
    z = x * y
    ax.plot_wireframe(x, y, z + 1)
    ax.plot_trisurf(x.ravel(), y.ravel(), z.ravel(), cmap="viridis")
    ax.contour(x, y, z - 1)
    ax.quiver(0, 0, 0, 1, 1, 1)
    scene = tn.mpl.draw3d(ax, hidden="ghost")
    assert len(scene.get_paths()) > 30 and len(scene._strokes.get_segments()) > 20
    ax.figure.savefig("all.pdf")
    assert b"/Subtype /Image" not in Path("all.pdf").read_bytes()


def waves():
    x, y = np.meshgrid(np.linspace(-3, 3, 13), np.linspace(-2, 2, 12))
    return x, y, np.sin(x) * np.cos(2 * y) + 0.1 * x


def signed(ring):
    return (np.dot(ring[:, 0], np.roll(ring[:, 1], -1)) - np.dot(ring[:, 1], np.roll(ring[:, 0], -1))) / 2


@pytest.mark.parametrize("kind,zdir", [("contourf", "x"), ("contourf", "z"), ("tricontourf", "z")])
def test_filled_contours_are_planes_with_their_holes(kind, zdir):
    from matplotlib.path import Path

    ax = plt.figure().add_subplot(projection="3d")
    u, v, w = map(np.ravel, waves()) if kind == "tricontourf" else waves()
    filled = getattr(ax, kind)(*((w, u, v) if zdir == "x" else (u, v, w)), zdir=zdir, offset=-4, cmap="magma")
    ax.set(**{f"{zdir}lim": (-4, 1)})
    scene = tn.mpl.draw3d(ax)
    areas = scene.lines.regions()
    assert set(areas.object) == {-1, 0} and not filled.get_visible()
    colors = {tuple(color) for color in scene.get_facecolor()}
    assert len(colors) > 4 and colors <= {tuple(color) for color in filled.get_facecolor()}
    for level, (corners, codes) in enumerate(filled._3dverts_codes):
        rings = np.split(corners, np.flatnonzero(codes == Path.MOVETO)[1:])
        wanted = abs(sum(signed(scene.lines.project(ring)) for ring in rings))
        assert areas.area[areas.face == level].sum() == pytest.approx(wanted, rel=1e-6, abs=1e-3), level


def test_filled_contours_of_a_surface_that_folds_along_their_axis_are_named():
    ax = plt.figure().add_subplot(projection="3d")
    x, y, z = waves()
    ax.plot_surface(x, y, z)
    filled = ax.contourf(x, y, z, zdir="x", offset=-4)
    with pytest.warns(UserWarning, match="^QuadContourSet3D: draw3d leaves this to matplotlib"):
        scene = tn.mpl.draw3d(ax)
    ax.figure.canvas.draw()
    assert filled.get_visible() and filled.get_zorder() < scene.get_zorder()


def test_filled_contours_are_hidden_where_a_surface_is_in_front():
    """A figure of matplotlib's gallery: a surface above its own contours."""
    ax = plt.figure().add_subplot(projection="3d")
    x, y, z = waves()
    ax.plot_surface(x, y, z)
    ax.contourf(x, y, z, zdir="z", offset=-4)
    ax.view_init(elev=89.9)
    areas = tn.mpl.draw3d(ax).lines.regions()
    alone = plt.figure().add_subplot(projection="3d")
    alone.contourf(x, y, z, zdir="z", offset=-4)
    alone.set(xlim=ax.get_xlim(), ylim=ax.get_ylim(), zlim=ax.get_zlim())
    alone.view_init(elev=89.9)
    whole = tn.mpl.draw3d(alone).lines.regions()
    # Both are as wide, and perspective shows the nearer one larger.
    left = areas.area[areas.object == 1].sum() / whole.area[whole.object == 0].sum()
    assert left < 0.01, left


def test_filled_contours_at_their_levels_and_contours_on_them_are_all_seen():
    ax = plt.figure().add_subplot(projection="3d")
    x, y, z = waves()
    ax.contourf(x, y, z)
    ax.contour(x, y, z, zdir="z", offset=2, colors="k")
    ax.contourf(x, y, z, zdir="z", offset=2)
    ax.view_init(elev=60)
    lines = tn.mpl.draw3d(ax).lines
    assert lines.visible[lines.cls == "curve"].mean() > 0.99


def test_other_artists_are_named():
    from matplotlib.patches import Circle
    from mpl_toolkits.mplot3d.art3d import pathpatch_2d_to_3d

    ax = plt.figure().add_subplot(projection="3d")
    ax.plot([0, 1], [0, 1], [0, 1])
    ax.text(0, 0, 0, "texts are known to stay")
    hidden = ax.add_patch(Circle((0, 0), 1, visible=False))
    circle = ax.add_patch(Circle((5, 5), 3))
    pathpatch_2d_to_3d(circle, z=0, zdir="x")
    with pytest.warns(UserWarning, match="^PathPatch3D: draw3d leaves this to matplotlib") as warned:
        tn.mpl.draw3d(ax)
    assert len(warned) == 1 and circle.get_visible() and not hidden.get_visible()


SCALES = {"log": {}, "symlog": {"linthresh": 2}, "function": {"functions": (np.cbrt, lambda value: value**3)}}


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("axis", ["x", "y", "z"])
def test_scales_are_those_of_the_axes(axis, scale):
    ax = plt.figure().add_subplot(projection="3d")
    if not hasattr(ax, "_get_scaled_limits"):
        pytest.skip("this matplotlib draws all 3-D axes as linear ones")
    getattr(ax, f"set_{axis}scale")(scale, **SCALES[scale])
    way = np.geomspace(1, 100, 9)
    x, y = np.meshgrid(way, way)
    surface = ax.plot_surface(x, y, 1 + 0 * x, color="r", shade=False)
    [curve] = ax.plot(way, way, 2 * way, "k-")
    dots = ax.scatter(way, way, 3 * way)
    ax.figure.canvas.draw()
    by_matplotlib = curve.get_xydata().copy(), np.array(dots.get_offsets()), [path.vertices for path in surface.get_paths()]
    scene = tn.mpl.draw3d(ax)
    ends = np.concatenate(scene._strokes.get_segments())
    assert np.abs(ends[[0, -1]] - by_matplotlib[0][[0, -1]]).max() < 1e-6
    places = np.array(sorted(scene._marks[0].get_offsets().tolist()))
    assert np.abs(places - sorted(by_matplotlib[1].tolist())).max() < 1e-6
    drawn, wanted = (np.concatenate([path.vertices for path in scene.get_paths()]), np.concatenate(by_matplotlib[2]))
    for side in (np.min, np.max):
        assert np.abs(side(drawn, axis=0) - side(wanted, axis=0)).max() < 1e-6
    with pytest.raises(ValueError, match=f"camera: the {axis} axis has a scale that bends faces; give linear axes"):
        tn.lines("builtin:gear", camera=ax)
    with pytest.raises(ValueError, match=f"camera: the {axis} axis has a scale"):
        tn.mpl.draw(ax, "builtin:gear")


def test_what_a_logarithmic_axis_cannot_show_is_a_gap():
    ax = plt.figure().add_subplot(projection="3d")
    if not hasattr(ax, "_get_scaled_limits"):
        pytest.skip("this matplotlib draws all 3-D axes as linear ones")
    ax.set_zscale("log")
    ax.plot([0, 1, 2, 3, 4], [0] * 5, [1, 10, 0, 10, 100], "k-o")
    scene = tn.mpl.draw3d(ax)
    assert len(scene._strokes.get_segments()) == 2 and len(scene._marks[0].get_offsets()) == 4
