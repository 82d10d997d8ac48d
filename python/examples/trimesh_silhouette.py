"""A mesh of trimesh as vectors: its lines by class, and its silhouette from a point."""

import numpy as np
import tinta_npr
import trimesh

# Two parts, one through the other: where they meet there is a line, too.
mesh = trimesh.util.concatenate(
    [trimesh.creation.box((2, 2, 2)), trimesh.creation.cylinder(radius=0.6, height=3.2, sections=48)]
)

# %% The visible lines; z is up in this mesh.
lines = tinta_npr.lines(mesh, up_axis="z", view="iso", size=360, hidden="dashed")
lines.save("trimesh.svg")
print(lines, lines.counts)

# %% They are arrays: how many pixels of each class are seen?
for name in tinta_npr.CLASSES:
    pieces = lines[name]
    if len(pieces):
        print(f"{name:13} {np.linalg.norm(pieces[:, 1] - pieces[:, 0], axis=1).sum():7.1f} px")

# %% The edges between front and back, by the mesh's own vertex numbers.
edges = tinta_npr.silhouette(mesh, eye=(6, 5, 4))
print(len(edges), "edges of the silhouette, together", np.linalg.norm(np.diff(mesh.vertices[edges], axis=1), axis=2).sum(), "long")
