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

HALF, FRAME = 0.2, 0.3          # of the plate, and with the frame
BAR_AT, BAR_TOP = 0.07, 0.048
PLATE, BAR = 0.008, 0.008       # thicknesses
CELL = 0.01


class Mesh:
    def __init__(self):
        self.nodes, self.tags, self.elements, self.names = [], {}, [], []

    def node(self, *x):
        x = tuple(round(value, 9) for value in x)
        if x not in self.tags:
            self.nodes.append(x)
            self.tags[x] = len(self.nodes)
        return self.tags[x]

    def name(self, dimension, number, name):
        self.names.append(f'{dimension} {number} "{name}"')

    def add(self, kind, group, *places):
        nodes = " ".join(str(self.node(*place)) for place in places)
        self.elements.append(f"{kind} 2 {group} {group} {nodes}")

    def write(self, path):
        number = lambda value: f"{value:.9g}"
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(self.names)), *self.names, "$EndPhysicalNames",
                 "$Nodes", str(len(self.nodes)),
                 *(f"{tag} {' '.join(map(number, x))}" for tag, x in enumerate(self.nodes, 1)), "$EndNodes",
                 "$Elements", str(len(self.elements)),
                 *(f"{tag} {element}" for tag, element in enumerate(self.elements, 1)), "$EndElements"]
        path.write_text("\n".join(lines) + "\n")
        print(f"{path.name}: {len(self.nodes)} nodes, {len(self.elements)} elements")


def steps(*stops):
    """Places from one stop to the next, in equal cells: (first place, (next place, cells), ...)."""
    places = [stops[0]]
    for end, cells in stops[1:]:
        begin = places[-1]
        places += [begin + (end - begin) * (i + 1) / cells for i in range(cells)]
    return places


def shells(refined):
    mesh = Mesh()
    for number, name in enumerate(("plate", "frame", "bars"), 1):
        mesh.name(2, number, name)
    mesh.name(1, 4, "bar_end")
    across = steps(0, (HALF, refined * round(HALF / CELL)), (FRAME, 5))
    for x0, x1 in zip(across, across[1:]):
        for y0, y1 in zip(across, across[1:]):
            inside = max(x1, y1) < HALF + 1e-9
            mesh.add(3, 1 if inside else 2, (x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0))
    up = steps(0, (PLATE + CELL / refined, 1), (BAR_TOP, 3 * refined + (refined - 1)))
    along = [x for x in across if x < HALF + 1e-9]
    for z0, z1 in zip(up, up[1:]):
        for x0, x1 in zip(along, along[1:]):
            mesh.add(3, 3, (x0, BAR_AT, z0), (x1, BAR_AT, z0), (x1, BAR_AT, z1), (x0, BAR_AT, z1))
        mesh.add(1, 4, (HALF, BAR_AT, z0), (HALF, BAR_AT, z1))
    return mesh


def hexahedra(cell, through):
    mesh = Mesh()
    for number, name in enumerate(("plate", "frame", "bars"), 1):
        mesh.name(3, number, name)
    for number, name in enumerate(("plate_bottom", "frame_bottom", "frame_top", "bar_end"), 4):
        mesh.name(2, number, name)
    count = lambda length: max(1, round(length / cell))
    xs = steps(0, (HALF, count(HALF)), (FRAME, 4))
    low, high = BAR_AT - BAR / 2, BAR_AT + BAR / 2
    ys = steps(0, (low, count(low)), (high, 2), (HALF, count(HALF - high)), (FRAME, 4))
    zs = steps(0, (PLATE, through))
    bar_zs = steps(PLATE, (BAR_TOP, count(BAR_TOP - PLATE)))

    def block(group, x, y, z):
        mesh.add(5, group, *((x[a], y[b], z[c]) for a, b, c in
                             ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))))

    pairs = lambda values: list(zip(values, values[1:]))
    for x in pairs(xs):
        for y in pairs(ys):
            inside = max(x[1], y[1]) < HALF + 1e-9
            for z in pairs(zs):
                block(1 if inside else 2, x, y, z)
            for group, z in ((4 if inside else 5, 0), (6, PLATE)):
                if group != 6 or not inside:
                    mesh.add(3, group, (x[0], y[0], z), (x[1], y[0], z), (x[1], y[1], z), (x[0], y[1], z))
            if x[1] < HALF + 1e-9 and low - 1e-9 < y[0] < high - 1e-9:
                for z in pairs(bar_zs):
                    block(3, x, y, z)
                    if x[1] > HALF - 1e-9:
                        mesh.add(3, 7, (x[1], y[0], z[0]), (x[1], y[1], z[0]), (x[1], y[1], z[1]), (x[1], y[0], z[1]))
    return mesh


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else __file__).resolve()
    folder = folder if folder.is_dir() else folder.parent
    shells(1).write(folder / "panel.msh")
    shells(2).write(folder / "panel_fine.msh")
    hexahedra(0.01, 2).write(folder / "hexahedra.msh")
    hexahedra(0.005, 2).write(folder / "hexahedra_fine.msh")
