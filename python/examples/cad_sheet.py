"""A part of build123d as a third-angle sheet, edges hidden behind it dashed; a part of CadQuery is given in the same way."""

import build123d as cad
import tinta_npr

plate = cad.Box(60, 40, 20) - cad.Pos(12, 0, 0) * cad.Cylinder(8, 20) - cad.Pos(12, 0, 8) * cad.Cylinder(12, 4)
part = cad.fillet(plate.edges().filter_by(cad.Axis.Z).filter_by(cad.GeomType.LINE), 6)
tinta_npr.lines(part, sheet="third", page="A4-landscape", hidden="dashed").save("cad-sheet.pdf", title="A plate")
tinta_npr.lines(part, view="iso").regions().save("cad-faces.svg")
