"""The league's programs: how each is called, what it can draw, and how it is set up.

In a command MODEL, MATRIX, CAMERA and DRAWING are paths; TINTA, PYTHON, BLENDER, NODE, LARNT are what run.py was told.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Program:
    """One program with its settings."""

    name: str
    command: str
    ends: str  # of the drawing's file
    draws: str  # what it can draw
    settings: str
    year: int = 2026  # of the release that the requirements name
    needs_display: bool = False
    is_reference: bool = False  # the others are judged by its lines


TINTA = "TINTA render MODEL --camera MATRIX --size 512x512 -o DRAWING"
SCRIPT = "MODEL CAMERA DRAWING"

PROGRAMS = [
    Program("tinta lines", f"{TINTA} --style lines --crease-angle 30", "svg", "visible edges and intersections", "as by default: specks and folds are left out"),
    Program(
        "tinta lines, nothing left out",
        f"{TINTA} --style lines --crease-angle 30 --min-length 0",
        "svg",
        "visible edges and intersections",
        "`--min-length 0`: the reference itself, drawn",
        is_reference=True,
    ),
    Program(
        "tinta inking",
        f"{TINTA} --style inking --show borders --crease-angle 30",
        "png",
        "visible edges, by the depth buffer",
        "as published, but for the crease angle",
    ),
    Program(
        "tinta inking, exact silhouettes",
        f"{TINTA} --style inking --silhouette exact --show borders --crease-angle 30",
        "png",
        "visible edges, by the depth buffer",
        "`--silhouette exact`",
    ),
    Program("tinta ink", f"{TINTA} --style ink --show borders --crease-angle 30", "png", "edges found in a picture", "as by default"),
    Program("tinta three-pass", f"{TINTA} --style three-pass --show borders", "png", "edges found in a picture", "as published; it has no crease angle"),
    Program(
        "tinta three-pass, float map",
        f"{TINTA} --style three-pass --show borders --map-encoding float --slope-threshold on",
        "png",
        "edges found in a picture",
        "`--map-encoding float --slope-threshold on`",
    ),
    Program("Blender Freestyle", f"BLENDER blender_freestyle.py {SCRIPT}", "png", "visible edges", "silhouettes, borders, creases; Cycles, one sample", 2025),
    Program(
        "Blender Line Art",
        f"BLENDER blender_line_art.py {SCRIPT}",
        "svg",
        "visible edges and intersections",
        "contours, creases, intersections; Grease Pencil's SVG export, strokes set to 2 px",
        2025,
    ),
    Program("PyVista silhouette", f"PYTHON pyvista_lines.py {SCRIPT}", "png", "visible edges, by the depth buffer", "`add_silhouette` with a feature angle"),
    Program(
        "VTK silhouette and feature edges",
        f"PYTHON vtk_feature_edges.py {SCRIPT}",
        "png",
        "visible edges, by the depth buffer",
        "polygon offset for coincident topology, 4 samples",
    ),
    Program("three.js EdgesGeometry", f"NODE three/edges.mjs {SCRIPT}", "png", "creases and borders, no silhouettes", "polygon offset on the mesh, antialiasing, lines of 1 px, as `LineBasicMaterial` has them"),
    Program("OCCT HLR, polygons", f"PYTHON occt_poly.py {SCRIPT}", "svg", "visible edges", "creases as sharp edges, others as smooth; sharp edges and outlines"),
    Program("OCCT HLR, exact", f"PYTHON occt_exact.py {SCRIPT}", "svg", "sharp edges; outlines of curved faces only", "the same"),
    Program("build123d projection", f"PYTHON build123d_projection.py {SCRIPT}", "svg", "sharp edges; outlines of curved faces only", "`project_to_viewport`; edges below the crease angle seamless"),
    Program("Panda3D cartoon ink", f"PYTHON panda3d_ink.py {SCRIPT}", "png", "edges found in a picture of normals", "`setCartoonInk(separation=1)`, normals split at 30 degrees", 2025, needs_display=True),
    Program("larnt", f"LARNT {SCRIPT}", "svg", "all triangles' edges", "a step of one pixel"),
    Program("f3d edges", f"PYTHON f3d_edges.py {SCRIPT}", "png", "all triangles' edges", "`render.show_edges`, 2 px, a white unlit mesh"),
    Program("matplotlib triangles", f"PYTHON matplotlib_triangles.py {SCRIPT}", "png", "all triangles' edges, hidden by mean depth", "`Poly3DCollection`, white with black edges of 2 px"),
]

# Programs that were not found.
MISSING = {
    "three-edge-projection 0.0.10": "its page installs it from its repository alone, which was not reached; the package registry has no such name",
}
