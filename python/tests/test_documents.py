"""What docs/guide/python.md shows runs, block after block."""

import os
import re
from pathlib import Path

import pytest

DOCUMENT = Path(os.environ.get("TINTA_DOCUMENT") or Path(__file__).parents[2] / "docs" / "guide" / "python.md")


def test_its_code_runs():
    pyvista = pytest.importorskip("pyvista")
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    import tinta_npr

    blocks = re.findall(r"```python\n(.*?)```", DOCUMENT.read_text(), re.S)
    assert len(blocks) > 5
    names = {"mesh": pyvista.Cube(), "tinta_npr": tinta_npr}
    for block in blocks:
        if "pandas" in block:
            pytest.importorskip("pandas")
        exec(block, names)
    assert all(Path(file).stat().st_size > 500 for file in ("figure.svg", "figure.pdf", "mesh.png"))


def test_names_of_settings_in_it_are_settings():
    import tinta_npr

    text = DOCUMENT.read_text()
    known = {setting["name"] for function in tinta_npr._native.names("function") for setting in tinta_npr._native.settings(function)}
    known |= {"style", "look", "preset", "camera", "left", "right", "styles", "off_screen", "figure", "projection", "xlim", "ylim", "zlim", "curves", "points", "labels"}
    code = "\n".join(re.findall(r"```python\n(.*?)```", text, re.S) + re.findall(r"`([^`\n]*)`", text.replace("```", "")))
    given = set(re.findall(r"[(,] ?([a-z_]+)=", code))
    assert len(given) > 12 and given <= known, given - known
