"""The code that the page for Python shows runs as it stands, block after block."""

import os
import re
from pathlib import Path

import pytest

GUIDE = Path(os.environ.get("TINTA_GUIDE") or Path(__file__).parents[2] / "docs" / "guide")
WRITTEN = {"python.md": ["figure.svg", "hills-pyvista.svg", "hills-tinta.svg", "faces.svg", "tones.pdf", "outlines.svg", "mesh.png", "pipes-tinta.svg"]}


@pytest.mark.parametrize("page", WRITTEN)
def test_its_code_runs(page):
    for module in ("pyvista", "pandas"):
        pytest.importorskip(module)
    pytest.importorskip("matplotlib").use("agg")

    blocks = re.findall(r"```python\n(.*?)```", (GUIDE / page).read_text(), re.S)
    assert len(blocks) > 3
    names = {}
    for block in blocks:
        exec(block, names)
    assert all(Path(file).stat().st_size > 500 for file in WRITTEN[page])


@pytest.mark.parametrize("page", WRITTEN)
def test_names_of_settings_in_it_are_settings(page):
    import tinta_npr

    text = (GUIDE / page).read_text()
    known = {setting["name"] for function in tinta_npr._native.names("function") for setting in tinta_npr._native.settings(function)}
    known |= {"style", "look", "preset", "camera", "left", "right", "styles", "off_screen", "projection", "format", "axis", "xy", "curves", "points", "labels", "xlim", "ylim", "zlim", "figure", "figsize", "aspect", "yticks", "window_size", "scalar_bar_args", "tolerance"}
    known |= {"by", "values", "colors", "cmap", "fill"}
    code = "\n".join(re.findall(r"```python\n(.*?)```", text, re.S) + re.findall(r"`([^`\n]*)`", text.replace("```", "")))
    given = set(re.findall(r"[(,] ?([a-z_]+)=", code))
    assert len(given) > 5 and given <= known, given - known
