"""The examples run, and write the files that they name."""

import os
import re
import runpy
from pathlib import Path

import pytest

GUIDE = Path(os.environ.get("TINTA_GUIDE") or Path(__file__).parents[2] / "docs" / "guide")
README = Path(os.environ.get("TINTA_README") or Path(__file__).parents[2] / "README.md")
EXAMPLES = Path(os.environ.get("TINTA_EXAMPLES") or Path(__file__).parents[1] / "examples")
WRITTEN = {
    "cad_sheet": ["cad-sheet.pdf", "cad-faces.svg"],
    "figure_for_a_paper": ["paper.pdf", "paper.svg", "paper-tones.pdf", "paper-tones.png"],
    "matplotlib_axes": ["matplotlib.pdf", "matplotlib.svg", "matplotlib.png"],
    "matplotlib_3d": ["matplotlib-3d.pdf", "matplotlib-3d.png", "field-3d.pdf", "field-3d.png"],
    "meshio_volume": ["meshio.svg"],
    "pyvista_export": ["pyvista.svg", "pyvista-hidden.svg", "pyvista.pdf", "pyvista-filled.svg", "pyvista-ink.png"],
    "recipe_matplotlib": ["pipes-matplotlib.svg", "pipes-tinta.svg"],
    "recipe_pyvista": ["hills-pyvista.svg", "hills-tinta.svg"],
    "recipe_trimesh": ["bearing-trimesh.png", "bearing-tinta.svg"],
    "trimesh_silhouette": ["trimesh.svg"],
}
NEEDS = {
    "cad_sheet": ["build123d"],
    "figure_for_a_paper": ["matplotlib"],
    "matplotlib_axes": ["matplotlib"],
    "matplotlib_3d": ["matplotlib"],
    "meshio_volume": ["meshio"],
    "pyvista_export": ["pyvista"],
    "recipe_matplotlib": ["matplotlib"],
    "recipe_pyvista": ["pyvista"],
    "recipe_trimesh": ["trimesh", "pyglet"],
    "trimesh_silhouette": ["trimesh"],
}


def test_all_are_known():
    assert sorted(path.stem for path in EXAMPLES.glob("*.py")) == sorted(WRITTEN)


@pytest.mark.parametrize("name", sorted(WRITTEN))
def test_it_runs(name, monkeypatch):
    # trimesh draws its picture in a window, unless pyglet needs no display.
    monkeypatch.setenv("PYGLET_HEADLESS", "1")
    for module in NEEDS[name]:
        pytest.importorskip(module)
    runpy.run_path(str(EXAMPLES / f"{name}.py"), run_name="__main__")
    for file in WRITTEN[name]:
        assert Path(file).stat().st_size > 500, file


@pytest.mark.parametrize("name", [name for name in sorted(WRITTEN) if name.startswith("recipe")])
def test_recipes_are_those_of_the_guide(name):
    _, recipe = (EXAMPLES / f"{name}.py").read_text().split("# %% ")
    lines = recipe.splitlines()[1:]
    of_guide = [line.strip() for line in (GUIDE / "python.md").read_text().splitlines()]
    start = of_guide.index(lines[0])
    assert of_guide[start : start + len(lines)] == lines


def test_the_readme_shows_a_recipe_as_it_is_typed():
    pytest.importorskip("pyvista")
    [block] = re.findall(r"```python\n(.*?)```", README.read_text(), re.S)
    _, recipe = (EXAMPLES / "recipe_pyvista.py").read_text().split("# %% ")
    assert block.endswith(recipe.split("\n", 1)[1])
    exec(block, {})
    assert Path("hills-tinta.svg").stat().st_size > 500


def test_recipes_are_exact_where_the_libraries_own_exports_are_not():
    """PyVista writes one picture of pixels; matplotlib draws the pipe that it draws last over the other."""
    for module in ("pyvista", "matplotlib"):
        pytest.importorskip(module)
    for name in ("recipe_pyvista", "recipe_matplotlib"):
        runpy.run_path(str(EXAMPLES / f"{name}.py"))
    before, after = (Path(f"hills-{by}.svg").read_text() for by in ("pyvista", "tinta"))
    assert "<image" in before and "<path" not in before
    assert "<image" not in after and after.count("visible-curve") > 8 and ">Elevation<" in after
    assert "stroke-width=\"3\"" in after
