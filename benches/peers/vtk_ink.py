"""VTK's smooth mesh with vtkFeatureEdges and vtkPolyDataSilhouette, off screen, without multisampling."""

import vtk
from turntable import CREASE_DEGREES, LINE_WIDTH_PX, eye, height, height_degrees, model, placed, run, width

reader = vtk.vtkOBJReader()
reader.SetFileName(model)
reader.Update()
mesh = reader.GetOutput()
middle, radius = placed(mesh.GetBounds()[0::2], mesh.GetBounds()[1::2])
vtk.vtkMapper.SetResolveCoincidentTopologyToPolygonOffset()
renderer = vtk.vtkRenderer()
renderer.SetBackground(1, 1, 1)
camera = renderer.GetActiveCamera()
camera.SetFocalPoint(middle)
camera.SetViewUp(0, 1, 0)
camera.SetViewAngle(height_degrees)


def add(source, color):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(color)
    actor.GetProperty().SetLineWidth(LINE_WIDTH_PX)
    renderer.AddActor(actor)
    return actor


normals = vtk.vtkPolyDataNormals()
normals.SetInputData(mesh)
normals.SplittingOff()
add(normals, (0.8, 0.7, 0.5))
features = vtk.vtkFeatureEdges()
features.SetInputData(mesh)
features.SetFeatureAngle(CREASE_DEGREES)
features.ColoringOff()
add(features, (0, 0, 0)).GetProperty().LightingOff()
silhouette = vtk.vtkPolyDataSilhouette()
silhouette.SetInputData(mesh)
silhouette.SetCamera(camera)
silhouette.SetEnableFeatureAngle(0)
add(silhouette, (0, 0, 0)).GetProperty().LightingOff()
window = vtk.vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetMultiSamples(0)
window.SetSize(width, height)
window.AddRenderer(renderer)
pixels = vtk.vtkUnsignedCharArray()


def turn(frame):
    camera.SetPosition(eye(middle, radius, frame))
    camera.SetClippingRange(radius * 0.5, radius * 8)
    window.Render()


def draw(frame):
    turn(frame)
    window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, pixels)
    return lambda: memoryview(pixels)


def save(path):
    turn(0)
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


run(f"VTK {vtk.VTK_VERSION}", draw, save)
