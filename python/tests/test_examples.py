"""The examples run, and write the files that they name."""

import os
import runpy
from pathlib import Path

import pytest

EXAMPLES = Path(os.environ.get("TINTA_EXAMPLES") or Path(__file__).parents[1] / "examples")
WRITTEN = {
    "cad_sheet": ["cad-sheet.pdf", "cad-faces.svg"],
    "figure_for_a_paper": ["paper.pdf", "paper.svg", "paper-tones.pdf", "paper-tones.png"],
    "matplotlib_axes": ["matplotlib.pdf", "matplotlib.svg", "matplotlib.png"],
    "matplotlib_3d": ["matplotlib-3d.pdf", "matplotlib-3d.png", "field-3d.pdf", "field-3d.png"],
    "meshio_volume": ["meshio.svg"],
    "pyvista_export": ["pyvista.svg", "pyvista-hidden.svg", "pyvista.pdf", "pyvista-filled.svg", "pyvista-ink.png"],
    "trimesh_silhouette": ["trimesh.svg"],
}
NEEDS = {"cad_sheet": "build123d", "matplotlib_axes": "matplotlib", "matplotlib_3d": "matplotlib", "meshio_volume": "meshio", "pyvista_export": "pyvista", "trimesh_silhouette": "trimesh", "figure_for_a_paper": "matplotlib"}


def test_all_are_known():
    assert sorted(path.stem for path in EXAMPLES.glob("*.py")) == sorted(WRITTEN)


@pytest.mark.parametrize("name", sorted(WRITTEN))
def test_it_runs(name):
    pytest.importorskip(NEEDS[name])
    runpy.run_path(str(EXAMPLES / f"{name}.py"), run_name="__main__")
    for file in WRITTEN[name]:
        assert Path(file).stat().st_size > 500, file
