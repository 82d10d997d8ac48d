"""Wrong arguments raise an exception that names them; none ends the interpreter."""

import io
import warnings

import numpy as np
import pytest
import tinta_npr as tn

V = [[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
F = [[0, 1, 2], [0, 1, 3]]


def with_row(row, values, dtype=float):
    array = np.array(V if len(values) == 3 and dtype is float else F, dtype=dtype)
    array[row] = values
    return array


WRONG = [
    (lambda: tn.lines(with_row(2, (0, np.nan, 0)), F), ValueError, r"vertices: row 2 is not finite"),
    (lambda: tn.lines(with_row(1, (np.inf, 0, 0)), F), ValueError, r"vertices: row 1 is not finite"),
    (lambda: tn.lines([(0, 0), (1, 0), (0, 1)], F), ValueError, r"vertices: the shape is \(3, 2\); give \(N, 3\)"),
    (lambda: tn.lines(np.zeros(9), F), ValueError, r"vertices: the shape is \(9,\)"),
    (lambda: tn.lines([[0, 0, 0], [1, 0]], F), ValueError, r"vertices: the rows are of different lengths"),
    (lambda: tn.lines(np.zeros((0, 3)), F), ValueError, r"vertices: there are none"),
    (lambda: tn.lines([["a", "b", "c"]] * 3, F), TypeError, r"vertices: these are of type <U1; give real numbers"),
    (lambda: tn.lines(np.array(V, dtype=complex), F), TypeError, r"vertices: these are of type complex128"),
    (lambda: tn.lines(np.array(V, dtype=object), F), TypeError, r"vertices: these are of type object"),
    (lambda: tn.lines(np.ma.masked_equal(V, 1), F), ValueError, r"vertices: some values are masked; leave their rows out"),
    (lambda: tn.lines(V, np.ma.masked_equal(F, 3)), ValueError, r"faces: some values are masked"),
    (lambda: tn.lines(curves=[np.ma.masked_equal(V, 1)]), ValueError, r"curves: some values are masked"),
    (lambda: tn.lines(points=[np.ma.masked_equal(V[0], 0)]), ValueError, r"points: some values are masked"),
    (lambda: tn.lines(V, [[0, 1, 2], [0, 1, 4]]), ValueError, r"faces: row 1 names vertex 4, but vertices are numbered 0 to 3"),
    (lambda: tn.lines(V, [[0, 1, 2], [-1, 1, 2]]), ValueError, r"faces: row 1 names vertex -1"),
    (lambda: tn.lines(V, [[0, 1, 2], [0, 1, 2**40]]), ValueError, r"faces: row 1 names vertex 1099511627776"),
    (lambda: tn.lines(V, np.array([[0, 1, 2**64 - 1]], dtype=np.uint64)), ValueError, r"faces: row 0 names vertex 18446744073709551615"),
    (lambda: tn.lines(V, [[0, 1, 2], [0, 1, 3, 9]]), ValueError, r"faces: row 1 names vertex 9"),
    (lambda: tn.lines(V, [[0, 1, 2], [0, 1]]), ValueError, r"faces: row 1 has 2 corners; a face has 3 or more"),
    (lambda: tn.lines(V, [[0.0, 1, 2]]), TypeError, r"faces: these are of type float64; give whole numbers"),
    (lambda: tn.lines(V, [0, 1, 2]), ValueError, r"faces: the shape is \(3,\)"),
    (lambda: tn.lines(V, [[0, 1]]), ValueError, r"faces: the shape is \(1, 2\)"),
    (lambda: tn.lines(V, np.zeros((0, 3), dtype=int)), ValueError, r"faces: there are none"),
    (lambda: tn.lines(V, [[1, 1, 1]]), ValueError, r"mesh: .*nothing"),
    (lambda: tn.lines(np.array(V)), TypeError, r"faces: they are missing"),
    (lambda: tn.lines(V), TypeError, r"mesh: these are vertices without faces"),
    (lambda: tn.lines([]), ValueError, r"mesh: the list is empty"),
    (lambda: tn.lines(7), TypeError, r"mesh: give vertices and faces, a path, a mesh .*, or a part of build123d or CadQuery, not int"),
    (lambda: tn.lines(None), TypeError, "mesh: it is missing; give a mesh, curves or points"),
    (lambda: tn.lines("nowhere.obj"), FileNotFoundError, r"nowhere.obj: there is no such file"),
    (lambda: tn.lines("builtin:bost"), ValueError, r"builtin:bust"),
    (lambda: tn.lines(np.array(V) * 1e300, F), ValueError, r"mesh: its coordinates reach beyond"),
    (lambda: tn.lines(V, F, size=0), ValueError, r"size 0: a size is WIDTHxHEIGHT"),
    (lambda: tn.lines(V, F, size=(1, 2, 3)), ValueError, r"size 1,2,3"),
    (lambda: tn.lines(V, F, line_width=object()), TypeError, r"line_width: give .*, not a value of type object"),
    (lambda: tn.lines(V, F, classes=[]), ValueError, r"classes"),
    (lambda: tn.lines(V, F, classes=["crease", 3]), ValueError, r"classes crease,3"),
    (lambda: tn.lines(V, F, parallel="yes"), ValueError, r"parallel: give True or False"),
    (lambda: tn.lines(V, F, fov=True), ValueError, r"fov: give DEGREES, not True"),
    (lambda: tn.lines(V, F, hidden=True), ValueError, r"hidden: give none, dashed, ghost, not True"),
    (lambda: tn.lines(V, F, class_colors={"crease": (128, 64, 0)}), ValueError, r"class_colors crease \(128, 64, 0\): .* from 0 to 1; divide"),
    (lambda: tn.lines(V, F, background=(-0.5, 0, 1)), ValueError, r"background \(-0.5, 0, 1\): the numbers of a colour"),
    (lambda: tn.lines(V, F, line_width="1mm"), ValueError, r"add page=\"A4\", width_mm or dpi"),
    (lambda: tn.lines(V, F).project([[1, 2]]), ValueError, r"points: the shape is \(1, 2\); give \(N, 3\)"),
    (lambda: tn.lines(V, F, transparent=True), ValueError, r"^transparent: this option is gone; background transparent leaves"),
    (lambda: tn.lines(V, F, style="ink"), ValueError, r"lines has no option style"),
    (lambda: tn.lines(V, F, look="sketch"), ValueError, r"look sketch: this look is of pictures"),
    (lambda: tn.lines(V, F, look="techncal"), ValueError, r"look techncal: did you mean technical\?"),
    (lambda: tn.lines(V, F, preset="nowhere.toml"), FileNotFoundError, r"nowhere.toml: there is no such file"),
    (lambda: tn.lines(V, F, camera=7), TypeError, r"camera: give a view's name"),
    (lambda: tn.lines(V, F, camera={"eyes": (1, 2, 3)}), ValueError, r"camera: it has no eyes"),
    (lambda: tn.lines(V, F, camera={"fov": 30}, fov=40), ValueError, r"camera: it says fov, which is given too"),
    (lambda: tn.lines(V, F, camera=np.zeros((3, 4))), ValueError, r"camera: this matrix shows everything at one point"),
    (lambda: tn.lines(V, F, camera=np.full((4, 4), np.nan)), ValueError, r"camera: a number of it is not finite"),
    (lambda: tn.lines(V, F, camera=np.eye(4)), ValueError, r"camera: this matrix mirrors"),
    (lambda: tn.lines(V, F).save("a.gif"), ValueError, r"file: lines are written as .svg, .pdf, .png or .json, not as .gif"),
    (lambda: tn.lines(V, F).save(io.StringIO(), format="pdf"), TypeError, r"file: it is open for text, and this format is binary"),
    (lambda: tn.lines(V, F).save("a.png", page="A4"), ValueError, r"page"),
    (lambda: tn.lines(V, F).save("no/such/a.svg"), OSError, r"no/such"),
    (lambda: tn.lines(V, F).svg(marginn=3), ValueError, r"Lines.svg has no option marginn; did you mean margin"),
    (lambda: tn.silhouette(V, (1, 2), F), ValueError, r"eye: the shape is \(2,\)"),
    (lambda: tn.silhouette(V, (1, np.nan, 2), F), ValueError, r"eye: .* not finite"),
    (lambda: tn.edges(["builtin:gear", "builtin:ant"]), ValueError, r"mesh: edges\(\) takes one mesh, not 2"),
    (lambda: tn.render(V, F, style="three_pass"), ValueError, r"style three_pass: did you mean three-pass\?"),
    (lambda: tn.render(V, F, stylle="ink"), ValueError, r"render has no option stylle; did you mean style\?"),
    (lambda: tn.render(V, F, show="border", style="ink"), ValueError, r"show border: did you mean borders\?"),
    (lambda: tn.render(V, F, backend="ogl"), ValueError, r"backend ogl: did you mean egl\?"),
    (lambda: tn.render(V, F, look="technical"), ValueError, r"look technical: this look is of lines"),
    (lambda: tn.render(V, F, tones=9, style="three-pass"), ValueError, r"tones 9"),
    (lambda: tn.render(V, F, size=40_000_000, style="phong"), ValueError, r"size 40000000x40000000: the largest picture"),
    (lambda: tn.render(V, F, size=32).save("a.xyz"), OSError, r"not written as .xyz"),
    (lambda: tn.render(V, F, size=32, background="transparent").save("a.jpg"), OSError, r"no transparency"),
    (lambda: tn.render(V, F, camera=np.diag([2.0, 1, -1, 1])), ValueError, r"camera: pictures are drawn with square pixels"),
    (lambda: tn.measure(V, F, frames=0), ValueError, r"frames 0: at least one frame"),
    (lambda: tn.measure(V, F, tolerance=-1), ValueError, r"tolerance -1: it is a share of the picture"),
    (lambda: tn.measure(V, F, styles=["inc"]), ValueError, r"style inc: did you mean ink\?"),
    (lambda: tn.compare(V, F, left="phong"), ValueError, r"left: style phong has no lines to compare"),
]


@pytest.mark.parametrize("number", range(len(WRONG)))
def test_it_is_refused(number):
    call, kind, sentence = WRONG[number]
    with pytest.raises(kind, match=sentence) as refusal:
        call()
    text = str(refusal.value)
    assert "\n" not in text and "--" not in text, text


def test_there_are_thirty_kinds_and_more():
    assert len({sentence for _, _, sentence in WRONG}) == len(WRONG) > 30


def test_what_is_left_out_of_arrays_is_said_if_the_picture_lacks_it():
    crossing = [[0, 0, 9], [1, 1, 9], [1, 0, 9], [0, 1, 9]]
    with pytest.warns(UserWarning, match="mesh: 1 polygon that crosses itself; what such polygons fill is chance") as said:
        tn.lines([*V, *crossing], [*F, [len(V) + corner for corner in range(4)]])
    assert said[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert tn.mesh([*V, [9, 9, 9]], [*F, [1, 1, 2], F[0]]).remarks == []


def test_settings_without_effect_are_said():
    with pytest.warns(UserWarning, match="tones has no effect on style charcoal"):
        tn.render(V, F, size=32, style="charcoal", tones=2)
    with pytest.warns(UserWarning, match="no line of these classes is visible"):
        tn.lines(V, F, classes="intersection")
