"""A mesh of finite elements, read by meshio: its outside as lines, cells and all."""

import meshio
import numpy as np
import tinta_npr

# A block of hexahedra with a bent top, as a solver would write it.
nx, ny, nz = 8, 3, 3
x, y, z = np.meshgrid(np.linspace(0, 4, nx + 1), np.linspace(0, 1, ny + 1), np.linspace(0, 1, nz + 1), indexing="ij")
points = np.column_stack([x.ravel(), (y + 0.15 * np.sin(x * 1.5)).ravel(), z.ravel()])
number = lambda i, j, k: (i * (ny + 1) + j) * (nz + 1) + k
cells = [
    [number(i + a, j + b, k + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
    for i in range(nx) for j in range(ny) for k in range(nz)
]
meshio.Mesh(points, [("hexahedron", cells)]).write("block.vtu")

# %% The faces that only one cell has are its outside.
mesh = tinta_npr.mesh(meshio.read("block.vtu"), name="block")
print(mesh)

# %% Its outline thick; by a small crease angle every edge at which it bends, thin.
lines = tinta_npr.lines(
    mesh, view=(25, 25), framing="outline", size=(480, 240), crease_angle=0.5, class_widths={"crease": 0.7, "silhouette": 2}
)
lines.save("meshio.svg")
print(lines)
