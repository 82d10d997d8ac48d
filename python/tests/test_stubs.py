"""What editors read is complete: every name, argument and setting of the package, and nothing else."""

import ast
import inspect
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import tinta_npr
from test_examples import EXAMPLES
from tinta_npr import _native, _stubs

pytest.importorskip("matplotlib")
STUBS = _stubs.stubs()
BODY = ast.parse(STUBS["__init__"]).body
CLASSES = {node.name: node for node in BODY if isinstance(node, ast.ClassDef)}
FUNCTIONS = {node.name: node for node in BODY if isinstance(node, ast.FunctionDef)}


def test_the_package_has_the_types_that_its_tables_make():
    for module, text in STUBS.items():
        assert Path(tinta_npr.__file__).with_name(f"{module}.pyi").read_text() == text


def test_every_name_of_the_package_is_in_them():
    named = {*CLASSES, *FUNCTIONS, *(node.target.id for node in BODY if isinstance(node, ast.AnnAssign))}
    assert set(tinta_npr.__all__) <= named
    assert {"mpl", "pv", "lines"} <= set(dir(tinta_npr))


def check_signature(stub, function, table):
    """The arguments of the stub and those that editors ask the function for: its own, and the settings of its table, if it has one."""
    expected = list(inspect.signature(function).parameters)
    settings = set() if table is None else {setting["name"] for setting in _native.settings(table)}
    assert settings <= set(expected) and "settings" not in expected
    arguments = [*stub.args.args, *stub.args.kwonlyargs]
    assert sorted(argument.arg for argument in arguments) == sorted(expected), stub.name
    assert all(argument.annotation for argument in arguments if argument.arg != "self"), stub.name
    assert stub.returns is not None, stub.name


def test_every_function_has_its_arguments_and_settings():
    names = [name for name in _native.names("function") if "." not in name]
    assert set(names) == set(FUNCTIONS)
    for name in names:
        check_signature(FUNCTIONS[name], getattr(tinta_npr, name), name)
    for module in ("mpl", "pv"):
        functions = [node for node in ast.parse(STUBS[module]).body if isinstance(node, ast.FunctionDef)]
        assert {node.name for node in functions} == {name for name in getattr(tinta_npr, module).__all__ if name.islower()}
        for node in functions:
            check_signature(node, getattr(getattr(tinta_npr, module), node.name), None if node.name == "draw3d" else "lines")


def test_every_method_is_in_them():
    for name in ("Lines", "Regions", "Picture", "Edges", "Comparison", "Mesh"):
        own = {method for method in vars(getattr(tinta_npr, name)) if not method.startswith("_") or method.startswith("_repr_")}
        stubs = {node.name for node in CLASSES[name].body if isinstance(node, ast.FunctionDef)}
        fields = {node.target.id for node in CLASSES[name].body if isinstance(node, ast.AnnAssign)}
        inside = {"of_file", "of_arrays", "of_curves", "of_pickle", "was_read_with", "turned", "free", "with_curves_of", "with_faces_of", "with_marks"}
        assert own - inside <= stubs | fields, name
    for owner, tables in _stubs._METHODS.items():
        methods = {node.name: node for node in CLASSES[owner].body if isinstance(node, ast.FunctionDef)}
        for name, table in tables.items():
            check_signature(methods[name], getattr(getattr(tinta_npr, owner), name), table)


def test_choices_are_those_of_the_tables():
    def names_in(node):
        return {constant.value for constant in ast.walk(node) if isinstance(constant, ast.Constant)}

    for name, stub in FUNCTIONS.items():
        types = {argument.arg: argument.annotation for argument in [*stub.args.args, *stub.args.kwonlyargs]}
        for setting in _native.settings(name):
            if setting["kind"] == "choice":
                assert set(setting["names"]) <= names_in(types[setting["name"]]), (name, setting["name"])
        if name in ("lines", "render"):
            assert ("technical" in names_in(types["look"])) == (name == "lines") != ("print" in names_in(types["look"]))


@pytest.mark.parametrize(
    "checker, words",
    [("mypy", ["--strict", "--no-error-summary", "--no-color-output"]), ("pyright", ["--level", "error", "--pythonpath", sys.executable])],
)
def test_calls_and_examples_have_no_wrong_types_but_the_two_made(checker, words):
    program = Path(sys.executable).with_name(checker)
    if not program.exists() and not (program := shutil.which(checker)):
        pytest.skip(f"{checker} is not installed")
    ours = Path("calls.py")
    ours.write_text(CALLS)
    files = [ours, *sorted(EXAMPLES.glob("*.py"))]
    said = subprocess.run([program, *words, *files], capture_output=True, text=True).stdout
    # In the examples, the other libraries' own types are not our business.
    wrong = [line for line in said.splitlines() if " error: " in line or " - error" in line]
    wrong = [line for line in wrong if "tinta" in line.split("error", 1)[1] or ours.name in line]
    assert len(wrong) == 2 and all(ours.name in line for line in wrong), said
    assert "doted" in wrong[0] and "hidn" in wrong[1], said


CALLS = """
import io

import numpy as np
import tinta_npr
from matplotlib.figure import Figure

mesh = tinta_npr.mesh(np.zeros((3, 3)), [[0, 1, 2]], weld=0)
lines = tinta_npr.lines(mesh, view="iso", hidden="dashed", width_mm=85, class_colors={"crease": (0, 0, 1)}, look="technical")
lines.save(io.BytesIO(), format="pdf", title="A triangle")
total: float = float(np.linalg.norm(lines.segments[lines.visible]))
place = lines.project((0, 0, 0)).tolist()
picture = tinta_npr.render(mesh, look="print", style="three-pass", size=(64, 48), background="transparent")
picture.save("a.png")
drawn = tinta_npr.mpl.draw(Figure().add_subplot(), lines, color="C0")
drawn.set_label("lines")
areas = lines.regions("tone", style="ink", tones=2)
areas.save("areas.svg", colors=np.ones((len(areas), 3)), hidden="ghost")
stress: float = float(lines.regions().of_faces([1.0]).max())
tinta_npr.mpl.fill(Figure().add_subplot(), lines, values=[1.0], cmap="magma", vmin=0).set_label("areas")
tinta_npr.pv.export_svg(object(), "b.svg", fill=True)
rows = tinta_npr.measure(mesh, styles=["ink"])
numbers = tinta_npr.compare(mesh, left="ink").numbers["only_left_px"]
tinta_npr.pv.export_svg(object(), "a.svg", hidden="ghost", title="A")
tinta_npr.mpl.draw(Figure().add_subplot(), lines, label="gear", lw=1.5)
lines.save(io.StringIO(), format="svg")
tinta_npr.render(mesh, style="three-pass", supersample=2)
tinta_npr.lines(mesh, hidden="doted")
tinta_npr.lines(mesh, hidn="dashed")
"""
