"""What the peers' scripts share: their arguments MODEL WIDTH HEIGHT FRAMES or MODEL WIDTH HEIGHT PICTURE, the camera, and their last line.

The eye stands 3.2 radii before the model's middle and half a radius above it; a radius is half the diagonal of the model's box. Its view
is 40 degrees wide. From frame to frame it goes 3 degrees around, as in benches/cartoon.rs.
"""

import json
import math
import sys
import time

CREASE_DEGREES = math.degrees(math.acos(0.4))
LINE_WIDTH_PX = 2
WIDTH_DEGREES = 40.0
WARM_UP_FRAMES = 3

model, width, height = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
frames = int(sys.argv[4]) if sys.argv[4].isdigit() else 0
picture = None if frames else sys.argv[4]
height_degrees = math.degrees(2 * math.atan(math.tan(math.radians(WIDTH_DEGREES / 2)) * height / width))


def placed(low, high):
    """The middle and the radius of a box."""
    return [(a + b) / 2 for a, b in zip(low, high)], math.dist(low, high) / 2


def eye(middle, radius, frame):
    """The eye's place, y up."""
    angle = math.radians(3 * frame)
    return [middle[0] + 3.2 * radius * math.sin(angle), middle[1] + 0.5 * radius, middle[2] + 3.2 * radius * math.cos(angle)]


def run(version, draw, save):
    """Times `draw(frame)`, which turns, draws and reads back, or has `save(path)` write the first frame; prints one JSON object.

    `draw` returns a function that gives the picture's bytes, or None where a program keeps them. The pictures must differ.
    """
    times, pictures = [], set()
    for frame in range(frames + WARM_UP_FRAMES if frames else 0):
        start = time.perf_counter()
        pixels = draw(max(frame - WARM_UP_FRAMES, 0))
        times.append((time.perf_counter() - start) * 1e3)
        pictures.add(hash(bytes(pixels())) if pixels else frame)
    if frames and len(pictures) < frames:
        raise SystemExit(f"{version} has drawn {len(pictures)} pictures in {frames} frames")
    if picture:
        save(picture)
    print(json.dumps({"version": version, "frame_ms": times[WARM_UP_FRAMES:]}))
