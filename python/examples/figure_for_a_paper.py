"""A figure for a paper, in millimetres, from one command to the page: lines over tones, dimensions in matplotlib."""

import matplotlib
import tinta_npr

matplotlib.use("agg")
import matplotlib.pyplot as plt

gear = tinta_npr.mesh("builtin:gear")
view = {"camera": "iso", "parallel": True, "size": 512}

# %% One column wide, as journals ask for: lines in tenths of millimetres.
lines = tinta_npr.lines(
    gear, **view, width_mm=85, line_width="0.25mm", class_widths={"outline": "0.5mm", "hidden": "0.15mm"}, hidden="dashed"
)
lines.save("paper.pdf", title="A gear")
lines.save("paper.svg", title="A gear")

# %% Tones below the same lines: both have the same camera, so they fit. A label at a point of the gear.
tones = tinta_npr.render(gear, **view, style="three-pass", show="tones", color="#f4e3c8")
figure, ax = plt.subplots(figsize=(85 / 25.4, 85 / 25.4))
ax.imshow(tones, extent=(0, 512, 0, 512))
tinta_npr.mpl.draw(ax, lines, line_width=0.7, hidden="none", class_widths={"outline": 1.4})
x, y = lines.project((0, 0.33, 0.34))  # pixels, y down
ax.annotate("keyway", xy=(x, 512 - y), xytext=(400, 480), arrowprops={"arrowstyle": "->"})
ax.set_axis_off()
figure.savefig("paper-tones.pdf", dpi=300)
figure.savefig("paper-tones.png", dpi=72)
