"""The package's overhead over the library's own time, and PyVista's silhouette for comparison.

    python python/benches/beside_the_program.py MODEL target/packaged/tinta [target/wheels/tinta_npr-*.whl]

MODEL is read as OBJ or PLY by the program and by trimesh. The program prints the library's own times (--json); both take turns, and
a busy moment hits both. Build the two in one profile: scripts/python --release, cargo build --profile packaged.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import time

import numpy as np
import tinta_npr as tn

ROUNDS = 15
SIZE = 512


def milliseconds(work):
    start = time.perf_counter()
    work()
    return 1e3 * (time.perf_counter() - start)


def said(values):
    values = sorted(values)
    quarter = len(values) // 4
    return f"{statistics.median(values):8.1f} ms (quartiles {values[quarter]:.1f} and {values[-1 - quarter]:.1f})"


def program(tinta, *words):
    done = subprocess.run([tinta, "render", *words, "--json"], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def lines(model, tinta):
    """In process, and as the library times itself within the program: edges, classes, hierarchy, cuts and rays."""
    ours, theirs = [], []
    for _ in range(ROUNDS):
        # A mesh caches its edges: each round has a new one.
        mesh = tn.mesh(model)
        ours.append(milliseconds(lambda: tn.lines(mesh)))
        # A drawing, like ours: a JSON file would add outlines.
        record = program(tinta, model, "-o", "lines.svg", "--no-recipe")
        theirs.append(sum(record[step] for step in ("topology_ms", "silhouette_ms", "visibility_ms")))
    print(f"lines            {said(ours)}\n  the library    {said(theirs)}")
    print(f"  ratio          {statistics.median(ours) / statistics.median(theirs):.3f}")


def pictures(model, tinta, style):
    mesh = tn.mesh(model)
    ours, theirs = [], []
    for _ in range(3):
        tn.render(mesh, style=style, size=SIZE)
    for _ in range(ROUNDS):
        ours.append(milliseconds(lambda: tn.render(mesh, style=style, size=SIZE)))
        record = program(tinta, model, "-o", "picture.png", "--style", style, "--size", str(SIZE), "--frames", "5")
        theirs.append(record["frame_ms"]["median"])
    print(f"render {style:10}{said(ours)}\n  the library    {said(theirs)}")
    print(f"  ratio          {statistics.median(ours) / statistics.median(theirs):.3f}")
    return statistics.median(ours)


def silhouettes(model, ours):
    try:
        import pyvista as pv
    except ImportError:
        return print("PyVista is not installed")
    mesh = tn.mesh(model)
    surface = pv.PolyData.from_regular_faces(mesh.vertices, mesh.faces.astype(np.int64))
    plotter = pv.Plotter(off_screen=True, window_size=(SIZE, SIZE))
    plotter.add_mesh(surface, silhouette=True)
    plotter.show(auto_close=False)
    times = []
    for _ in range(ROUNDS):
        def frame():
            # Another view, as a silhouette depends on it.
            plotter.camera.azimuth += 1
            plotter.render()
            plotter.screenshot(return_img=True)

        times.append(milliseconds(frame))
    plotter.close()
    print(f"PyVista's silhouette {said(times)}\n  times ours     {statistics.median(times) / ours:.1f}")


def imports():
    script = "import numpy, time; t = time.perf_counter(); import tinta_npr; print(1e3 * (time.perf_counter() - t))"
    times = [float(subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout) for _ in range(ROUNDS)]
    print(f"import, numpy there {said(times)}")


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("model")
    arguments.add_argument("tinta", help="the program")
    arguments.add_argument("wheel", nargs="?", help="a wheel, whose size is told")
    given = arguments.parse_args()
    mesh = tn.mesh(given.model)
    print(f"{given.model}: {len(mesh.faces)} triangles, {os.cpu_count()} cores")
    imports()
    if given.wheel:
        print(f"wheel            {os.path.getsize(given.wheel) / 1e6:.1f} MB")
    lines(given.model, given.tinta)
    ours = [pictures(given.model, given.tinta, style) for style in ("three-pass", "inking")]
    silhouettes(given.model, ours[1])


if __name__ == "__main__":
    main()
