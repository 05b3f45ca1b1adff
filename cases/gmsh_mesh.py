"""Meshes in the form that gmsh writes (format 2.2, ASCII), for the make_mesh.py of cases."""
import pathlib
import sys

LINE, QUADRANGLE, HEXAHEDRON = 1, 3, 5     # gmsh's kinds of elements


class Mesh:
    """Nodes are shared by place, to 1e-9 m. groups: (dimension, name) of physical groups, whose numbers are 1, 2, ..."""

    def __init__(self, *groups):
        self.nodes, self.tags, self.elements, self.groups = [], {}, [], groups

    def node(self, *x):
        x = tuple(round(value, 9) + 0.0 for value in x)
        if x not in self.tags:
            self.nodes.append(x)
            self.tags[x] = len(self.nodes)
        return self.tags[x]

    def add(self, kind, group, *places):
        """An element of a group, by number, with its corners in gmsh's order."""
        nodes = " ".join(str(self.node(*place)) for place in places)
        self.elements.append(f"{kind} 2 {group} {group} {nodes}")

    def block(self, group, x, y, z):
        """A hexahedron between two values of each coordinate."""
        self.add(HEXAHEDRON, group, *((x[a], y[b], z[c]) for a, b, c in
                                      ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))))

    def write(self, path):
        number = lambda value: f"{value:.9g}"
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat",
                 "$PhysicalNames", str(len(self.groups)),
                 *(f'{dimension} {tag} "{name}"' for tag, (dimension, name) in enumerate(self.groups, 1)), "$EndPhysicalNames",
                 "$Nodes", str(len(self.nodes)),
                 *(f"{tag} {' '.join(map(number, x))}" for tag, x in enumerate(self.nodes, 1)), "$EndNodes",
                 "$Elements", str(len(self.elements)),
                 *(f"{tag} {element}" for tag, element in enumerate(self.elements, 1)), "$EndElements"]
        path.write_text("\n".join(lines) + "\n")
        print(f"{path.name}: {len(self.nodes)} nodes, {len(self.elements)} elements")


def steps(*stops):
    """Places from one stop to the next, in equal cells: first place, (next place, cells), ..."""
    places = [stops[0]]
    for end, cells in stops[1:]:
        begin = places[-1]
        places += [begin + (end - begin) * (i + 1) / cells for i in range(cells)]
    return places


def pairs(values):
    return list(zip(values, values[1:]))


def write_all(script, meshes):
    """Meshes by name, into the folder that the command line names, or else that of the script."""
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(script).resolve().parent
    folder.mkdir(parents=True, exist_ok=True)
    for name, mesh in meshes.items():
        mesh.write(folder / name)
