"""The package is the command line's twin: the same bytes, the same sentences."""

import functools
import json
import re
import subprocess
import sys

import numpy as np
import pytest
import tinta_npr as tn


@pytest.mark.parametrize(
    "words, settings",
    [
        ((), {}),
        (("--size", "200x150", "--hidden", "dashed"), {"size": (200, 150), "hidden": "dashed"}),
        (("--look", "technical"), {"look": "technical"}),
        (("--parallel", "--view", "iso", "--crease-angle", "40.5"), {"parallel": True, "view": "iso", "crease_angle": 40.5}),
        (("--eye", "3,2,5", "--fov", "40"), {"camera": {"eye": np.array([3, 2, 5]), "fov": 40}}),
        (
            ("--classes", "silhouette,boundary", "--class-colors", "silhouette=rgb(255 0 0)", "--class-widths", "outline=4"),
            {"classes": ["silhouette", "boundary"], "class_colors": {"silhouette": (1, 0, 0)}, "class_widths": {"outline": 4}},
        ),
        (("--page", "A4", "--pen", "--min-length", "1mm"), {"page": "A4", "pen": True, "min_length": "1mm"}),
        (("--weld", "0", "--normals", "flat", "--up-axis", "z"), {"weld": 0, "normals": "flat", "up_axis": "z"}),
    ],
)
@pytest.mark.parametrize("model", ["builtin:gear", "box.obj"])
def test_svg_is_the_command_lines_byte_for_byte(tinta, model, words, settings):
    with open("box.obj", "w") as file:
        file.write("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 0 0 1\nv 2 0 1\nf 1 2 3 4\nf 1 5 6 2\nf 1 4 5\n")
    # The look gives the style.
    style = () if "--look" in words else ("--style", "lines")
    assert tinta("render", model, "-o", "drawing.svg", *style, *words)[0] == 0
    lines = tn.lines(model, **settings)
    with open("drawing.svg") as file:
        assert lines.svg() == file.read()
    lines.save("ours.svg")
    with open("drawing.svg", "rb") as theirs, open("ours.svg", "rb") as ours:
        assert ours.read() == theirs.read()


def test_pdf_and_json_are_too(tinta):
    for name in ("drawing.pdf", "drawing.json"):
        assert tinta("render", "builtin:open-box", "-o", name, "--style", "lines")[0] == 0
    lines = tn.lines("builtin:open-box")
    with open("drawing.pdf", "rb") as file:
        assert lines.pdf() == file.read()
    with open("drawing.json") as theirs:
        assert lines.json() == theirs.read()


@pytest.mark.parametrize("model", ["builtin:bust", "builtin:gear", "builtin:open-box", "builtin:ant"])
@pytest.mark.parametrize("settings", [{}, {"hidden": "dashed"}, {"min_length": 6}, {"classes": "all", "class_widths": "outline=3"}])
def test_arrays_have_the_pieces_of_json(model, settings):
    lines = tn.lines(model, view="iso", **settings)
    pieces = json.loads(lines.json())["segments"]
    assert [piece["class"] for piece in pieces] == lines.cls.tolist()
    for array, key in [(lines.visible, "visible"), (lines.outline, "outline")]:
        assert [piece[key] for piece in pieces] == array.tolist(), key
    assert lines.outline.any() and not (lines.outline & ~lines.visible).any()


@pytest.mark.parametrize("words, settings", [((), {}), (("--look", "technical"), {"look": "technical"})])
def test_png_of_lines_is_too(tinta, words, settings):
    assert tinta("render", "builtin:gear", "-o", "drawing.png", "--style", "lines", "--size", "200x150", *words)[0] == 0
    lines = tn.lines("builtin:gear", size=(200, 150), **settings)
    lines.save("ours.png")
    pictures = []
    for name in ("drawing.png", "ours.png"):
        with open(name, "rb") as file:
            content = file.read()
        assert b"tinta-recipe" in content
        pictures.append(content[content.index(b"IDAT"):])
    assert pictures[0] == pictures[1]


def test_the_wheel_brings_the_program():
    def run(*words):
        return subprocess.run([sys.executable, "-m", "tinta_npr", *words], capture_output=True, text=True)

    tn.lines("builtin:gear", hidden="dashed").save("gear.svg")
    assert run("again", "gear.svg", "-o", "again.svg").returncode == 0
    with open("gear.svg") as first, open("again.svg") as again:
        assert first.read() == again.read()
    assert run("--version").stdout.split() == ["tinta", tn.__version__]
    wrong = run("render", "builtin:gear", "-o", "a.svg", "--crease-angel", "3")
    assert wrong.returncode == 2 and "--crease-angle" in wrong.stderr
    assert run("compare", "builtin:gear", "--left", "ink", "--right", "inking", "--size", "64", "-o", "c.png").returncode in (0, 1)


@pytest.mark.parametrize(
    "words, settings",
    [
        ((), {}),
        (("--look", "sketch"), {"look": "sketch"}),
        (("--style", "three-pass", "--tones", "2"), {"style": "three-pass", "tones": 2}),
        (("--style", "inking", "--line-width", "3", "--silhouette", "exact"), {"style": "inking", "line_width": 3.0, "silhouette": "exact"}),
        (("--background", "transparent", "--show", "borders", "--style", "two-pass"), {"background": "transparent", "show": "borders", "style": "two-pass"}),
        (("--look", "print", "--style", "three-pass"), {"look": "print", "style": "three-pass"}),
        (("--preset", "paper:dachsbacher-inking"), {"preset": "paper:dachsbacher-inking"}),
        (("--backend", "surfaceless", "--style", "inking", "--joints", "off"), {"backend": "surfaceless", "style": "inking", "joints": False}),
    ],
)
def test_png_is_the_command_lines_byte_for_byte(tinta, words, settings):
    assert tinta("render", "builtin:bust", "-o", "drawing.png", "--size", "160x120", *words)[0] == 0
    picture = tn.render("builtin:bust", size=(160, 120), **settings)
    assert picture.shape == (120, 160, 4) and picture.dtype == np.uint8
    with open("drawing.png", "rb") as file:
        assert picture.png() == file.read()
    # A part of it is another picture, without the recipe.
    assert picture[:50].recipe is None and picture[:50].png() != picture.png()


def test_what_the_program_says_of_a_file_is_a_warning(tinta):
    with open("odd.obj", "w") as file:
        file.write("mtllib nowhere.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 1 2\n")
    code, said = tinta("render", "odd.obj", "-o", "odd.svg")
    with pytest.warns(UserWarning) as warnings:
        assert tn.lines("odd.obj").svg()
    assert code == 0 and [in_python(line) for line in said.splitlines()] == [str(warning.message) for warning in warnings]
    assert all(warning.filename == __file__ for warning in warnings), "said of the line that asks"


def test_arrays_are_drawn_as_the_file_of_them(tinta, cube):
    vertices, faces = cube
    with open("cube.obj", "w") as file:
        file.writelines(f"v {x} {y} {z}\n" for x, y, z in vertices)
        file.writelines("f " + " ".join(str(corner + 1) for corner in face) + "\n" for face in faces)
    assert tinta("render", "cube.obj", "-o", "cube.svg", "--style", "lines", "--no-recipe")[0] == 0
    assert tinta("render", "cube.obj", "-o", "cube.png", "--no-recipe", "--size", "64")[0] == 0
    with open("cube.svg") as file:
        assert tn.lines(vertices, faces).svg(title="cube.obj") == file.read()
    with open("cube.png", "rb") as file:
        assert tn.render(vertices, faces, size=64).png() == file.read()


def in_python(sentence):
    """A sentence of the program as the package says it: there, a setting inside an option has its own name."""
    inside = r"--(?:clip|page|texture) (dpi|far|margin|near|skin|width-mm)(=?)"
    sentence = re.sub(inside, lambda name: f"--{name[1]}" + name[2].replace("=", " "), sentence)
    sentence = re.sub(r"--([a-z-]+) (A4|inking)\b", r'--\1="\2"', sentence)
    sentence = re.sub(r"--([a-z][a-z-]*)", lambda name: name[1].replace("-", "_"), sentence)
    return sentence.replace("style lines", "lines()").removeprefix("tinta: ")


@pytest.mark.parametrize(
    "words, settings",
    [
        (("--line-width", "0"), {"line_width": 0}),
        (("--page", "margin=3"), {"margin": 3}),
        (("--line-width", "1mm"), {"line_width": "1mm"}),
        (("--fov", "180"), {"fov": 180}),
        (("--height", "3"), {"height": 3}),
        (("--near", "5", "--far", "1"), {"near": 5, "far": 1}),
        (("--copies", "0"), {"copies": 0}),
        (("--weld", "2"), {"weld": 2}),
        (("--eye", "0,0,0", "--target", "0,0,0"), {"eye": (0, 0, 0), "target": [0, 0, 0]}),
        (("--silhouette", "paper"), {"silhouette": "paper"}),
        (("--texture", "skin=nowhere.png"), {"skin": "nowhere.png"}),
        (("--min-length", "-1"), {"min_length": -1}),
        (("--page", "9x9mm,margin=6"), {"page": "9x9mm", "margin": 6}),
        (("--page", "width-mm=0"), {"width_mm": 0}),
    ],
)
def test_refusals_are_the_same_sentences(tinta, words, settings):
    code, sentence = tinta("render", "builtin:open-box", "-o", "a.svg", *words)
    with pytest.raises((ValueError, FileNotFoundError)) as refusal:
        tn.lines("builtin:open-box", **settings).svg()
    assert code == 2 and str(refusal.value) == in_python(sentence)


def test_names_that_are_none_get_the_one_that_was_meant(tinta):
    code, sentence = tinta("render", "builtin:open-box", "-o", "a.svg", "--crease-angel", "40")
    with pytest.raises(ValueError) as refusal:
        tn.lines("builtin:open-box", crease_angel=40)
    assert code == 2
    # The program has its name before the command's, and Python underscores for hyphens.
    assert str(refusal.value) == in_python(sentence).replace("tinta render", "lines")
    for name, value, meant in [("view", "tpo", "top"), ("classes", "crease,boundry", "boundary"), ("hidden", "dahsed", "dashed")]:
        code, sentence = tinta("render", "builtin:open-box", "-o", "a.svg", f"--{name}", value)
        with pytest.raises(ValueError) as refusal:
            tn.lines("builtin:open-box", **{name: value})
        assert code == 2 and str(refusal.value) == f"{name} {value}: did you mean {meant}?"
        assert sentence.endswith(f": did you mean {meant}?")


def test_every_setting_of_the_tables_is_taken_and_told(tinta):
    for function in tn._native.names("function"):
        settings = tn._native.settings(function)
        names = [setting["name"] for setting in settings]
        assert names and len(set(names)) == len(names)
        owner = functools.reduce(getattr, function.split("."), tn)
        for setting in settings:
            assert f"  {setting['name']} : " in owner.__doc__ and setting["help"] in owner.__doc__
    told = {setting["name"] for setting in tn._native.settings("lines")}
    assert {"line_width", "crease_angle", "eye", "up_axis", "hidden"} <= told


def test_the_packages_program_draws_a_batch(tmp_path):
    models = ["builtin:gear", "builtin:open-box"]
    words = [sys.executable, "-m", "tinta_npr", "batch", *models, "-o", "drawn", "--size", "64", "--jobs", "2"]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert len(list((tmp_path / "drawn").glob("*.png"))) == 2
