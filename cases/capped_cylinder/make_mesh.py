#!/usr/bin/env python3
"""Meshes of the capped cylinder, as gmsh would write them (format 2.2, ASCII).

    make_mesh.py [FOLDER]    writes cylinder.msh, which is here, and cylinder_fine.msh, with cells half as wide, into FOLDER, by
                             default this one

The quarter y >= 0, z >= 0 of a cylinder of 0.1 m radius and 0.4 m length about z, of its flat cap at z = 0.2 m too. Groups of
surfaces: shell, cap. Normals point to the outside.
"""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from gmsh_mesh import QUADRANGLE, Mesh, pairs, steps, write_all

RADIUS, HALF_LENGTH = 0.1, 0.2
END = 0.0125
CORE = 0.55         # of the cap's middle, a bulged square, as a share of the radius


def cylinder(side, rings, along):
    """`side`: cells on half a side of the cap's square, so that 4 side of them go half round; `along`: as far as END from the end, where
    one cell holds the cap's thickness."""
    mesh = Mesh((2, "shell"), (2, "cap"))
    around = 4 * side
    rim = [(RADIUS * math.cos(math.pi * i / around), RADIUS * math.sin(math.pi * i / around)) for i in range(around + 1)]

    def on_square(i):
        """Half round a square from (1, 0) over (1, 1) and (-1, 1) to (-1, 0)."""
        if i <= side:
            return 1, i / side
        if i <= 3 * side:
            return 2 - i / side, 1
        return -1, 4 - i / side

    def in_core(x, y):
        """A place of the square, bulged towards a circle the more, the farther out."""
        size = max(abs(x), abs(y))
        if size == 0:
            return 0.0, 0.0
        bulge = 0.6 * size
        angle = math.pi / 4 * (y / x if abs(x) >= abs(y) else 2 - x / y)
        angle += math.pi if abs(x) >= abs(y) and x < 0 else 0
        stretch = 0.85
        return tuple(CORE * RADIUS * ((1 - bulge) * stretch * p + bulge * size * c)
                     for p, c in ((x, math.cos(angle)), (y, math.sin(angle))))

    for z0, z1 in pairs(steps(0, (HALF_LENGTH - END, along), (HALF_LENGTH, 1))):
        for a, b in pairs(rim):
            mesh.add(QUADRANGLE, 1, (*a, z0), (*b, z0), (*b, z1), (*a, z1))
    end = HALF_LENGTH
    for i in range(-side, side):
        for j in range(side):
            places = [in_core(p / side, q / side) for p, q in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))]
            mesh.add(QUADRANGLE, 2, *((*place, end) for place in places))
    for ring in range(rings):
        def at(i, r):
            inner, outer = in_core(*on_square(i)), rim[i]
            return tuple(p + (q - p) * r / rings for p, q in zip(inner, outer))
        for i in range(around):
            places = [at(i, ring), at(i, ring + 1), at(i + 1, ring + 1), at(i + 1, ring)]
            mesh.add(QUADRANGLE, 2, *((*place, end) for place in places))
    return mesh


if __name__ == "__main__":
    write_all(__file__, {"cylinder.msh": cylinder(6, 4, 15), "cylinder_fine.msh": cylinder(12, 8, 30)})
