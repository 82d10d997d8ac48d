"""Panda3D's toon ramp and cartoon ink, off screen, back faces culled as by default. The loader makes normals and splits them at 60 degrees."""

from panda3d.core import DirectionalLight, Filename, LightRampAttrib, PandaSystem, Point3, Vec3, loadPrcFileData
from turntable import eye, height, height_degrees, model, placed, run, width, WIDTH_DEGREES

loadPrcFileData(
    "",
    f"""window-type offscreen
load-display pandagl
win-size {width} {height}
sync-video #f
audio-library-name null
notify-level error
load-file-type p3assimp
assimp-gen-normals #t
assimp-smooth-normal-angle 60
framebuffer-multisample 0
multisamples 0
textures-power-2 none
""",
)

from direct.filter.CommonFilters import CommonFilters  # noqa: E402
from direct.showbase.ShowBase import ShowBase  # noqa: E402

base = ShowBase()
mesh = base.loader.loadModel(Filename.fromOsSpecific(model))
mesh.reparentTo(base.render)
middle, radius = placed(*mesh.getTightBounds())
base.disableMouse()
base.camLens.setFov(WIDTH_DEGREES, height_degrees)
base.camLens.setNearFar(radius * 0.5, radius * 8)
base.setBackgroundColor(1, 1, 1)
mesh.node().setAttrib(LightRampAttrib.makeDoubleThreshold(0.3, 0.3, 0.7, 0.8))
mesh.setShaderAuto()
light = base.camera.attachNewNode(DirectionalLight("light"))
light.setHpr(-30, -40, 0)
base.render.setLight(light)
if not CommonFilters(base.win, base.cam).setCartoonInk(separation=1):
    raise SystemExit("Panda3D has no cartoon ink on this driver")


def turn(frame):
    base.camera.setPos(*eye(middle, radius, frame))
    base.camera.lookAt(Point3(*middle), Vec3(0, 1, 0))
    base.graphicsEngine.renderFrame()
    base.graphicsEngine.syncFrame()


def draw(frame):
    turn(frame)
    return base.win.getScreenshot().getRamImage


def save(path):
    # What a filter draws into is made in the first frame.
    turn(0)
    turn(0)
    base.win.saveScreenshot(Filename.fromOsSpecific(path))


run(f"Panda3D {PandaSystem.getVersionString()}", draw, save)
