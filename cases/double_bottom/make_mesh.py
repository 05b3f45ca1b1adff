#!/usr/bin/env python3
"""Meshes of the double bottom, as gmsh would write them (format 2.2, ASCII).

    make_mesh.py [FOLDER]    writes double_bottom.msh and hexahedra.msh, which are here, and double_bottom_fine.msh and
                             hexahedra_fine.msh, with cells half as wide, into FOLDER, by default this one

A quarter of two square plates of 0.6 m, 0.15 m apart: the outer one begins at z = 0, where the water ends, the inner one at
z = 0.15 m. Between them stand a girder along x at y = 0.1 m and a floor along y at x = 0.1 m, with their mirror images. A frame of
0.1 m goes round the outer plate. Groups:

    shells       outer, frame, inner, girder, floor (surfaces); edge (curves: where all but the frame end, at 0.3 m)
    hexahedra    the same as volumes; outer_bottom, frame_bottom, frame_top, edge (surfaces)
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from gmsh_mesh import LINE, QUADRANGLE, Mesh, pairs, steps, write_all

HALF, FRAME = 0.3, 0.4          # of the plates, and with the frame
HEIGHT = 0.15
AT = 0.1                        # of girder and floor
OUTER, INNER, WEB = 0.008, 0.006, 0.006
WEB_CELLS = 7                   # from the outer plate to the inner one


def shells(refined):
    mesh = Mesh((2, "outer"), (2, "frame"), (2, "inner"), (2, "girder"), (2, "floor"), (1, "edge"))
    inside = steps(0, (AT, 6 * refined), (HALF, 12 * refined))
    across = steps(*([inside[0]] + [(x, 1) for x in inside[1:]]), (FRAME, 4))
    up = steps(0, (HEIGHT, WEB_CELLS * refined))

    def plate(group, places, z):
        for x0, x1 in pairs(places):
            for y0, y1 in pairs(places):
                own = group if max(x1, y1) < HALF + 1e-9 else 2
                mesh.add(QUADRANGLE, own, (x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z))

    plate(1, across, 0)
    plate(3, inside, HEIGHT)
    for a, b in pairs(inside):
        for z0, z1 in pairs(up):
            mesh.add(QUADRANGLE, 4, (a, AT, z0), (b, AT, z0), (b, AT, z1), (a, AT, z1))
            mesh.add(QUADRANGLE, 5, (AT, a, z0), (AT, b, z0), (AT, b, z1), (AT, a, z1))
        mesh.add(LINE, 6, (a, HALF, HEIGHT), (b, HALF, HEIGHT))
        mesh.add(LINE, 6, (HALF, a, HEIGHT), (HALF, b, HEIGHT))
    for z0, z1 in pairs(up):
        mesh.add(LINE, 6, (HALF, AT, z0), (HALF, AT, z1))
        mesh.add(LINE, 6, (AT, HALF, z0), (AT, HALF, z1))
    return mesh


def hexahedra(refined):
    """Two through plates and webs."""
    mesh = Mesh((3, "outer"), (3, "frame"), (3, "inner"), (3, "girder"), (3, "floor"), (2, "outer_bottom"), (2, "frame_bottom"),
                (2, "frame_top"), (2, "edge"))
    low, high = AT - WEB / 2, AT + WEB / 2
    xs = steps(0, (low, 6 * refined), (high, 2), (HALF, 12 * refined), (FRAME, 4))
    zs = steps(0, (OUTER, 2), (HEIGHT, WEB_CELLS * refined), (HEIGHT + INNER, 2))

    def is_web(pair):
        return low - 1e-9 < pair[0] and pair[1] < high + 1e-9

    for x in pairs(xs):
        for y in pairs(xs):
            outside = max(x[1], y[1]) > HALF + 1e-9
            for z in pairs(zs):
                in_outer, in_inner = z[1] < OUTER + 1e-9, z[0] > HEIGHT - 1e-9
                if in_outer:
                    group = 2 if outside else 1
                elif outside or not (in_inner or is_web(x) or is_web(y)):
                    continue
                else:
                    group = 3 if in_inner else 4 if is_web(y) else 5
                mesh.block(group, x, y, z)
                if not in_outer and x[1] > HALF - 1e-9:
                    mesh.add(QUADRANGLE, 9, (x[1], y[0], z[0]), (x[1], y[1], z[0]), (x[1], y[1], z[1]), (x[1], y[0], z[1]))
                if not in_outer and y[1] > HALF - 1e-9:
                    mesh.add(QUADRANGLE, 9, (x[0], y[1], z[0]), (x[1], y[1], z[0]), (x[1], y[1], z[1]), (x[0], y[1], z[1]))
            for group, z in ((7, 0), (8, OUTER)) if outside else ((6, 0),):
                mesh.add(QUADRANGLE, group, (x[0], y[0], z), (x[1], y[0], z), (x[1], y[1], z), (x[0], y[1], z))
    return mesh


if __name__ == "__main__":
    write_all(__file__, {"double_bottom.msh": shells(1), "double_bottom_fine.msh": shells(2), "hexahedra.msh": hexahedra(1),
                         "hexahedra_fine.msh": hexahedra(2)})
