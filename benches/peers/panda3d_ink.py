"""Panda3D's toon ramp and cartoon ink off screen: panda3d_ink.py MODEL WIDTH HEIGHT FRAMES

Prints one JSON object: the renderer and each frame's milliseconds, read-back included. The camera stands at 3.2 bounding
radii with Panda's own field of view (40 degrees across), as benches/cartoon.rs places ours, and the model turns by 3
degrees a frame. Panda culls back faces, as it does by default.
"""
import json
import sys
import time

from panda3d.core import DirectionalLight, Filename, LightRampAttrib, loadPrcFileData

model_path, width, height, frames = sys.argv[1], *map(int, sys.argv[2:5])
loadPrcFileData(
    "",
    f"""window-type offscreen
win-size {width} {height}
sync-video #f
audio-library-name null
notify-level error
load-file-type p3assimp
framebuffer-multisample 0
multisamples 0
""",
)

from direct.filter.CommonFilters import CommonFilters  # noqa: E402
from direct.showbase.ShowBase import ShowBase  # noqa: E402

base = ShowBase()
model = base.loader.loadModel(Filename.fromOsSpecific(model_path))
turntable = base.render.attachNewNode("turntable")
model.reparentTo(turntable)
model.setP(90)
low, high = model.getTightBounds()
model.setPos(-(low + high) / 2)
radius = (high - low).length() / 2

base.disableMouse()
base.camera.setPos(0, -3.2 * radius, 0.5 * radius)
base.camera.lookAt(0, 0, 0)
base.camLens.setNearFar(radius * 0.5, radius * 8)
base.setBackgroundColor(1, 1, 1)
model.node().setAttrib(LightRampAttrib.makeDoubleThreshold(0.3, 0.3, 0.7, 0.8))
model.setShaderAuto()
light = base.render.attachNewNode(DirectionalLight("light"))
light.setHpr(-30, -40, 0)
base.render.setLight(light)
if not CommonFilters(base.win, base.cam).setCartoonInk(separation=1):
    sys.exit("Panda3D has no cartoon ink on this driver")

times = []
for frame in range(frames + 3):
    turntable.setH(frame * 3)
    start = time.perf_counter()
    base.graphicsEngine.renderFrame()
    base.graphicsEngine.syncFrame()
    base.win.getScreenshot()
    times.append((time.perf_counter() - start) * 1e3)
print(json.dumps({"renderer": base.win.getGsg().getDriverRenderer(), "frame_ms": times[3:]}))
