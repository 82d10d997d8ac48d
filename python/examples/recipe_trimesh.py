"""A trimesh scene, before and after: a bearing. trimesh's picture needs pyglet 1 and a display, or PYGLET_HEADLESS=1."""

from pathlib import Path

import numpy as np
import tinta_npr
import trimesh
from trimesh.creation import annulus, icosphere

# %% trimesh draws pixels; as vectors it writes no scene.
balls = [icosphere(4, 0.4).apply_translation((1.8 * np.cos(turn), 1.8 * np.sin(turn), 0)) for turn in np.arange(0, 6.2, np.pi / 4)]
scene = trimesh.Scene([annulus(1, 1.4, 0.9, sections=128), annulus(2.2, 2.6, 0.9, sections=128), *balls])
scene.set_camera(angles=(0.9, 0, 0.5))
Path("bearing-trimesh.png").write_bytes(scene.save_image((400, 300)))
tinta_npr.lines(scene, camera=scene, size=(400, 300), hidden="dashed").save("bearing-tinta.svg")
