"""build123d: project_to_viewport of the same shell of plane faces; its visible edges.

The method draws OCCT's exact sharp, smooth (G1) and outline edges. Edges below the crease angle are marked as seamless (CN), which it
leaves out. It puts the eye at `focus` before the origin, so the origin is the league's target.
"""

import time
from importlib.metadata import version

import numpy as np
from build123d import Shell
from common import arguments, done, read_triangles
from occt_scene import shell, write
from OCP.GeomAbs import GeomAbs_CN

model, camera, drawing = arguments()
since = time.perf_counter()
points, triangles = read_triangles(model)
target, backward, up = (np.array(camera[name]) for name in ("target", "backward", "up"))
visible, _ = Shell(shell(points, triangles, points, GeomAbs_CN)).project_to_viewport(
    tuple(target), viewport_up=tuple(up), look_at=tuple(target - backward), focus=camera["distance"]
)
ends = [(*edge.position_at(0), *edge.position_at(1)) for edge in visible]
write(drawing, camera, [[(ax, ay, bx, by) for ax, ay, _, bx, by, _ in ends]])
done(f"build123d {version('build123d')}", "HLRBRep_Algo", since)
