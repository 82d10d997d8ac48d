"""Surfaces, curves and points in matplotlib's 3-D axes, each hidden where it is behind another: vectors in PDF and SVG."""

import matplotlib
import numpy as np
import tinta_npr

matplotlib.use("agg")
import matplotlib.pyplot as plt


def orbit(ax):
    """An orbit, before and behind its planet."""
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 49), np.linspace(0, np.pi, 25))
    ax.plot_surface(np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v), color="steelblue")
    turn = np.linspace(0, 2 * np.pi, 200)
    ax.plot(1.5 * np.cos(turn), 1.5 * np.sin(turn), 0.3 * np.sin(turn), "r")


def path_on_waves(ax):
    """A path over waves, a little above them."""
    x, y = np.meshgrid(np.linspace(-5, 5, 41), np.linspace(-5, 5, 41))
    waves = lambda x, y: np.sin(np.hypot(x, y))
    ax.plot_surface(x, y, waves(x, y), cmap="coolwarm")
    along = np.linspace(-5, 5, 300)
    ax.plot(along, along, waves(along, along) + 0.08, "k")


def cylinder_through_a_plane(ax):
    """Two surfaces that go through each other."""
    turn, z = np.meshgrid(np.linspace(0, 2 * np.pi, 41), np.linspace(-1, 1, 5))
    ax.plot_surface(0.5 * np.cos(turn), 0.5 * np.sin(turn), z, color="tab:green")
    x, y = np.meshgrid([-1, 1], [-1, 1])
    ax.plot_surface(x, y, 0.4 * x, color="gold", shade=False)


def plane_arrow_points(ax):
    """An arrow through a plane, and points on both sides of it."""
    x, y = np.meshgrid([0, 5], [0, 5])
    ax.plot_surface(x, y, 0 * x + 1, color="white", edgecolor="k")
    ax.quiver(2, 2, -1, 0, 0, 4, color="crimson", arrow_length_ratio=0.2)
    ax.scatter([1, 3, 4, 1.5], [1, 3, 1.5, 4], [0.2, 2, 0.4, 1.6], c=[0, 1, 2, 3], s=40, cmap="viridis")


def line_by_a_fold(ax):
    """A straight line that passes below a fold of a surface."""
    u, v = np.meshgrid(np.linspace(-4, 4, 33), np.linspace(-4, 4, 33))
    ax.plot_surface(u**2, v**2, u + 2 * v, cmap="coolwarm")
    ax.plot([-2, 16], [-4, 16], [8, -8], "k", lw=2)


def bars_and_their_means(ax):
    """Bars with edges, and a line with markers between them."""
    x, y = (part.ravel() for part in np.meshgrid(np.arange(4.0), np.arange(3.0)))
    ax.bar3d(x, y, 0 * x, 0.6, 0.6, 1 + np.sin(x) + 0.5 * y, color="lightgray", edgecolor="k", linewidth=0.6)
    ax.plot([-0.5, 0.8, 1.8, 4], [1.8] * 3 + [0.8], [1.2] * 4, "o-", color="tab:red", markersize=4)


FIGURES = [orbit, path_on_waves, cylinder_through_a_plane, plane_arrow_points, line_by_a_fold, bars_and_their_means]


def field(file):
    """A surface in the colours of a scalar, field lines around it, named points, and a colour bar."""
    figure = plt.figure(figsize=(5, 4))
    ax = figure.add_subplot(projection="3d")
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 49), np.linspace(0, np.pi, 25))
    surface = ax.plot_surface(np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v), cmap="viridis")
    angle = np.linspace(0.3, np.pi - 0.3, 150)
    for turn in (0.2, 2.3, 4.4):
        away = 3 * np.sin(angle) ** 2
        ax.plot(away * np.sin(angle) * np.cos(turn), away * np.sin(angle) * np.sin(turn), away * np.cos(angle), "firebrick", lw=1.2)
    ax.scatter([0, 0], [0, 0], [1.05, -1.05], c="k", s=15)
    ax.text(0, 0, 1.3, "north")
    ax.set_aspect("equal")
    figure.colorbar(surface, shrink=0.6, pad=0.15, label="height")
    tinta_npr.mpl.draw3d(ax, classes=["silhouette"], hidden="dashed")
    figure.savefig(file)


if __name__ == "__main__":
    figure = plt.figure(figsize=(9, 6), layout="constrained")
    for number, fill in enumerate(FIGURES, 1):
        ax = figure.add_subplot(2, 3, number, projection="3d")
        fill(ax)
        tinta_npr.mpl.draw3d(ax, classes=["intersection"])
        ax.set_title(fill.__name__.replace("_", " "), fontsize=9)
    figure.savefig("matplotlib-3d.pdf")
    figure.savefig("matplotlib-3d.png", dpi=90)
    field("field-3d.pdf")
    field("field-3d.png")
