"""An Axes3D, before and after: two pipes through each other."""

import matplotlib
import numpy as np
import tinta_npr

matplotlib.use("agg")
import matplotlib.pyplot as plt

# %% matplotlib sorts whole surfaces by their depth.
turn, along = np.meshgrid(np.linspace(0, 2 * np.pi, 41), np.linspace(-1.6, 1.6, 5))
ax = plt.figure(figsize=(4, 3)).add_subplot(projection="3d")
ax.plot_surface(np.cos(turn), np.sin(turn), along, color="tab:green")
ax.plot_surface(along, np.cos(turn), np.sin(turn), color="gold")
ax.set(aspect="equal", yticks=[-1, 0, 1])
ax.figure.savefig("pipes-matplotlib.svg")
tinta_npr.mpl.draw3d(ax, classes=["boundary", "silhouette", "intersection"])
ax.figure.savefig("pipes-tinta.svg")
