"""OCCT's HLRBRep_Algo (exact hidden lines) on the same shell of plane faces: visible sharp edges and outlines."""

import time

from common import arguments, done, read_triangles
from occt_scene import edges_of, perspective, shell, version, write
from OCP.HLRBRep import HLRBRep_Algo, HLRBRep_HLRToShape

model, camera, drawing = arguments()
since = time.perf_counter()
hidden = HLRBRep_Algo()
points, triangles = read_triangles(model)
hidden.Add(shell(points, triangles, points))
hidden.Projector(perspective(camera))
hidden.Update()
hidden.Hide()
result = HLRBRep_HLRToShape(hidden)
write(drawing, camera, [edges_of(shape) for shape in (result.VCompound(), result.OutLineVCompound())])
done(version(), "HLRBRep_Algo", since)
