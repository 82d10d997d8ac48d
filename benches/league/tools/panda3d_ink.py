"""Panda3D: CommonFilters.setCartoonInk, as the manual's page "Common Image Filters" and the sample "Cartoon Shader" have it.

The mesh is white and unlit, so that only ink is dark. Normals are the loader's own (assimp), split where faces meet at more than the
crease angle. Back faces are drawn, for not every model is closed.
"""

import time

from panda3d.core import Filename, PandaSystem, Point3, Vec3, loadPrcFileData

from common import CREASE_DEGREES, arguments, done

model, camera, drawing = arguments()
since = time.perf_counter()
loadPrcFileData(
    "",
    f"""window-type offscreen
load-display pandagl
win-size {camera["size"]} {camera["size"]}
sync-video #f
audio-library-name null
notify-level error
load-file-type p3assimp
assimp-gen-normals #t
assimp-smooth-normal-angle {CREASE_DEGREES}
textures-power-2 none
""",
)

from direct.filter.CommonFilters import CommonFilters  # noqa: E402
from direct.showbase.ShowBase import ShowBase  # noqa: E402

base = ShowBase()
base.disableMouse()
base.setBackgroundColor(1, 1, 1)
mesh = base.loader.loadModel(Filename.fromOsSpecific(model))
mesh.reparentTo(base.render)
mesh.setTwoSided(True)
mesh.setMaterialOff(1)
mesh.setColor(1, 1, 1, 1, 1)
mesh.setShaderAuto()
base.camera.setPos(*camera["eye"])
base.camera.lookAt(Point3(*camera["target"]), Vec3(*camera["up"]))
base.camLens.setFov(camera["fov_y_degrees"], camera["fov_y_degrees"])
base.camLens.setNearFar(camera["near"], camera["far"])
if not CommonFilters(base.win, base.cam).setCartoonInk(separation=1):
    raise SystemExit("Panda3D has no cartoon ink on this driver")
for _ in range(2):
    base.graphicsEngine.renderFrame()
base.graphicsEngine.syncFrame()
base.win.saveScreenshot(Filename.fromOsSpecific(drawing))
done(f"Panda3D {PandaSystem.getVersionString()}", base.win.getGsg().getDriverRenderer(), since)
