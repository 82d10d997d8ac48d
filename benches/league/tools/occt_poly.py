"""OCCT's HLRBRep_PolyAlgo (hidden lines of a triangulation): visible sharp edges and outlines.

The mesh becomes one shell of plane faces that share their edges; an edge whose faces meet at less than the crease angle is marked as
smooth (G1), so that it counts as OCCT's own smooth edges do and is not drawn. The algorithm hides as a parallel projection does,
so the mesh is put in perspective first.
"""

import time

from common import arguments, done, read_triangles
from occt_scene import edges_of, in_perspective, parallel, shell, version, write
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.HLRBRep import HLRBRep_PolyAlgo, HLRBRep_PolyHLRToShape

model, camera, drawing = arguments()
since = time.perf_counter()
points, triangles = read_triangles(model)
shape = shell(in_perspective(points, camera), triangles, points)
BRepMesh_IncrementalMesh(shape, 1.0)
hidden = HLRBRep_PolyAlgo()
hidden.Load(shape)
hidden.Projector(parallel())
hidden.Update()
result = HLRBRep_PolyHLRToShape()
result.Update(hidden)
write(drawing, camera, [edges_of(shape) for shape in (result.VCompound(), result.OutLineVCompound())])
done(version(), "HLRBRep_PolyAlgo", since)
