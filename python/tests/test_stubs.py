"""What editors read is what the tables say."""

import ast
from pathlib import Path

import tinta_npr
from tinta_npr import _stubs


def test_the_stub_file_is_the_one_that_the_tables_make():
    file = Path(tinta_npr.__file__).with_name("__init__.pyi")
    update = "python -m tinta_npr._stubs > python/tinta_npr/__init__.pyi"
    assert file.read_text() == _stubs.stubs(), f"write it anew: {update}"


def test_it_is_python_and_names_every_setting():
    names = {node.arg for node in ast.walk(ast.parse(_stubs.stubs())) if isinstance(node, ast.arg)}
    for function in tinta_npr._native.names("function"):
        assert {setting["name"] for setting in tinta_npr._native.settings(function)} <= names


def test_every_name_of_the_package_is_in_it():
    body = ast.parse(_stubs.stubs()).body
    named = {node.name for node in body if hasattr(node, "name")}
    named |= {node.target.id for node in body if isinstance(node, ast.AnnAssign)}
    assert set(tinta_npr.__all__) <= named
