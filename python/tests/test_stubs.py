"""What editors read is complete: every name, argument and setting of the package, and nothing else."""

import ast
import inspect
from pathlib import Path

import tinta_npr
from tinta_npr import _native, _stubs

BODY = ast.parse(_stubs.stubs()).body
CLASSES = {node.name: node for node in BODY if isinstance(node, ast.ClassDef)}
FUNCTIONS = {node.name: node for node in BODY if isinstance(node, ast.FunctionDef)}


def test_the_package_has_the_types_that_its_tables_make():
    assert Path(tinta_npr.__file__).with_name("__init__.pyi").read_text() == _stubs.stubs()


def test_every_name_of_the_package_is_in_them():
    named = {*CLASSES, *FUNCTIONS, *(node.target.id for node in BODY if isinstance(node, ast.AnnAssign))}
    assert set(tinta_npr.__all__) <= named


def check_signature(stub, function, table):
    """The stub's arguments are the function's own, in order, and then the settings of its table; each has a type."""
    parameters = inspect.signature(function).parameters.values()
    expected = [parameter.name for parameter in parameters if parameter.kind is not parameter.VAR_KEYWORD]
    expected += [setting["name"] for setting in _native.settings(table)]
    arguments = [*stub.args.args, *stub.args.kwonlyargs]
    assert sorted(argument.arg for argument in arguments) == sorted(expected), stub.name
    assert all(argument.annotation for argument in arguments if argument.arg != "self"), stub.name
    assert stub.returns is not None, stub.name


def test_every_function_has_its_arguments_and_settings():
    names = [name for name in _native.names("function") if "." not in name]
    assert set(names) == set(FUNCTIONS)
    for name in names:
        check_signature(FUNCTIONS[name], getattr(tinta_npr, name), name)


def test_every_method_that_takes_settings_has_them():
    methods = {node.name: node for node in CLASSES["Lines"].body if isinstance(node, ast.FunctionDef)}
    for name in ("svg", "pdf", "save", "layers"):
        check_signature(methods[name], getattr(tinta_npr.Lines, name), "Lines.svg")


def test_choices_are_those_of_the_tables():
    def names_in(node):
        return {constant.value for constant in ast.walk(node) if isinstance(constant, ast.Constant)}

    for name, stub in FUNCTIONS.items():
        types = {argument.arg: argument.annotation for argument in [*stub.args.args, *stub.args.kwonlyargs]}
        for setting in _native.settings(name):
            if setting["kind"] == "choice":
                assert set(setting["names"]) <= names_in(types[setting["name"]]), (name, setting["name"])
