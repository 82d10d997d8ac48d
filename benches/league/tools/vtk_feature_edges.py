"""VTK: vtkFeatureEdges (boundary, feature and non-manifold edges) and vtkPolyDataSilhouette without angle, each an actor of its own.

As VTK's examples FeatureEdges and Silhouette have them, with vtkMapper's polygon offset for coincident topology, which VTK's
documentation names for lines over surfaces.
"""

import time

import vtk
from common import CREASE_DEGREES, LINE_WIDTH_PX, arguments, done

model, camera, drawing = arguments()
since = time.perf_counter()
reader = vtk.vtkOBJReader()
reader.SetFileName(model)
reader.Update()
mesh = reader.GetOutput()
renderer = vtk.vtkRenderer()
renderer.SetBackground(1, 1, 1)
view = renderer.GetActiveCamera()
view.SetPosition(camera["eye"])
view.SetFocalPoint(camera["target"])
view.SetViewUp(camera["up"])
view.SetViewAngle(camera["fov_y_degrees"])
view.SetClippingRange(camera["near"], camera["far"])

vtk.vtkMapper.SetResolveCoincidentTopologyToPolygonOffset()


def add(source, color):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(color, color, color)
    actor.GetProperty().LightingOff()
    actor.GetProperty().SetLineWidth(LINE_WIDTH_PX)
    renderer.AddActor(actor)


add(reader, 1)
features = vtk.vtkFeatureEdges()
features.SetInputData(mesh)
features.SetFeatureAngle(CREASE_DEGREES)
features.BoundaryEdgesOn()
features.FeatureEdgesOn()
features.NonManifoldEdgesOn()
features.ManifoldEdgesOff()
features.ColoringOff()
add(features, 0)
silhouette = vtk.vtkPolyDataSilhouette()
silhouette.SetInputData(mesh)
silhouette.SetCamera(view)
silhouette.SetEnableFeatureAngle(0)
add(silhouette, 0)

window = vtk.vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetMultiSamples(4)
window.SetSize(camera["size"], camera["size"])
window.AddRenderer(renderer)
window.Render()
picture = vtk.vtkWindowToImageFilter()
picture.SetInput(window)
writer = vtk.vtkPNGWriter()
writer.SetFileName(drawing)
writer.SetInputConnection(picture.GetOutputPort())
writer.Write()
name = next((line for line in window.ReportCapabilities().splitlines() if "renderer string" in line), "")
done(f"VTK {vtk.VTK_VERSION}", name.split(":")[-1].strip(), since)
