#!/usr/bin/env python3
"""Meshes of the stiffened panel, as gmsh would write them (format 2.2, ASCII).

    make_mesh.py [FOLDER]    writes panel.msh and hexahedra.msh, which are here, and panel_fine.msh and hexahedra_fine.msh, with
                             cells half as wide, into FOLDER, by default this one

A quarter of a square plate of 0.4 m in the plane z = 0, which a frame of 0.1 m width goes round. Two flat bars stand on it along x,
at y = 0.07 m and its mirror image, from the plate to z = 0.048 m. Groups:

    shells       plate, frame, bars (surfaces); bar_end (a curve: where the bar meets the frame's inner edge)
    hexahedra    plate, frame, bars (volumes); plate_bottom, frame_bottom, frame_top, bar_end (surfaces)
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from gmsh_mesh import LINE, QUADRANGLE, Mesh, pairs, steps, write_all

HALF, FRAME = 0.2, 0.3          # of the plate, and with the frame
BAR_AT, BAR_TOP = 0.07, 0.048
PLATE, BAR = 0.008, 0.008       # thicknesses
CELL = 0.01


def shells(refined):
    mesh = Mesh((2, "plate"), (2, "frame"), (2, "bars"), (1, "bar_end"))
    across = steps(0, (HALF, refined * round(HALF / CELL)), (FRAME, 5))
    for x0, x1 in pairs(across):
        for y0, y1 in pairs(across):
            inside = max(x1, y1) < HALF + 1e-9
            mesh.add(QUADRANGLE, 1 if inside else 2, (x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0))
    up = steps(0, (PLATE + CELL / refined, 1), (BAR_TOP, 3 * refined + (refined - 1)))
    along = [x for x in across if x < HALF + 1e-9]
    for z0, z1 in pairs(up):
        for x0, x1 in pairs(along):
            mesh.add(QUADRANGLE, 3, (x0, BAR_AT, z0), (x1, BAR_AT, z0), (x1, BAR_AT, z1), (x0, BAR_AT, z1))
        mesh.add(LINE, 4, (HALF, BAR_AT, z0), (HALF, BAR_AT, z1))
    return mesh


def hexahedra(cell, through):
    mesh = Mesh((3, "plate"), (3, "frame"), (3, "bars"), (2, "plate_bottom"), (2, "frame_bottom"), (2, "frame_top"), (2, "bar_end"))
    count = lambda length: max(1, round(length / cell))
    xs = steps(0, (HALF, count(HALF)), (FRAME, 4))
    low, high = BAR_AT - BAR / 2, BAR_AT + BAR / 2
    ys = steps(0, (low, count(low)), (high, 2), (HALF, count(HALF - high)), (FRAME, 4))
    zs = steps(0, (PLATE, through))
    bar_zs = steps(PLATE, (BAR_TOP, count(BAR_TOP - PLATE)))

    for x in pairs(xs):
        for y in pairs(ys):
            inside = max(x[1], y[1]) < HALF + 1e-9
            for z in pairs(zs):
                mesh.block(1 if inside else 2, x, y, z)
            for group, z in ((4 if inside else 5, 0), (6, PLATE)):
                if group != 6 or not inside:
                    mesh.add(QUADRANGLE, group, (x[0], y[0], z), (x[1], y[0], z), (x[1], y[1], z), (x[0], y[1], z))
            if x[1] < HALF + 1e-9 and low - 1e-9 < y[0] < high - 1e-9:
                for z in pairs(bar_zs):
                    mesh.block(3, x, y, z)
                    if x[1] > HALF - 1e-9:
                        mesh.add(QUADRANGLE, 7, (x[1], y[0], z[0]), (x[1], y[1], z[0]), (x[1], y[1], z[1]), (x[1], y[0], z[1]))
    return mesh


if __name__ == "__main__":
    write_all(__file__, {"panel.msh": shells(1), "panel_fine.msh": shells(2), "hexahedra.msh": hexahedra(0.01, 2),
                         "hexahedra_fine.msh": hexahedra(0.005, 2)})
