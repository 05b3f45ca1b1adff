#!/usr/bin/env python3
"""The fuzzers' first inputs and their dictionary, made of what the project holds.

    corpus.py PROJECT_FOLDER OUTPUT_FOLDER

Writes OUTPUT_FOLDER/<fuzzer>/ (scene, overrides, study, mesh, reference, record) and OUTPUT_FOLDER/<fuzzer>.dict. Words of scenes and
studies are the keys and values in the tables of docs/reference/scene-file.md, which the program writes from its records, and docs/reference/studies.md.
"""
import json
import pathlib
import re
import sys

RECORD = {
    "scene": "tube", "status": "done", "message": "", "warnings": ["a warning"], "program": "undex 0.1", "time_s": 1e-4, "steps": 100,
    "fluid_substeps": 3, "wall_time_s": 1.5, "cpu_time_s": 3.0, "threads": 2, "particles": 1000, "wall_particles": 10, "cells": 20,
    "particle_updates": 100000, "neighbour_interactions": 5000000, "peak_memory_bytes": 200000000, "solver_memory_bytes": 1000000,
    "mass_error": 0.0, "momentum_error": None, "angular_momentum_error": 1e-9, "energy_error": 1e-4, "interface_energy_error": 1e-3,
    "interface_impulse_error": 0.0, "clamps": {"density": 0, "energy": 2}, "passes": {"pairs": 1.0},
    "metrics": {"first_peak_pa": 6e8, "closure_s": None}, "missing": {"closure_s": "the cavity is open at the end"},
}
OVERRIDES = ["resolution.spacing=0.0015", "symmetry.planes=[]", "bodies.water.material=water-steinberg", "structure.material=al-5086-o",
             "bodies.charge.material.E0=5.5e6", "probes.midline.point=[0, 0.1, 0]", "walls.tank.faces.high=open", "bodies.0.shape.low=0",
             "solids.0.velocity=[1, 2, 3]", "structures.back.material=steel-s7", "start.kind=plain", "scheme.name=paper",
             "threads=2", "end_time=1e-5", "gravity=[0,0,-9.81]"]


def two_cubes(version):
    """Two unit cubes side by side, as gmsh writes them."""
    nodes = [(x, y, z) for x in range(3) for y, z in ((0, 0), (1, 0), (1, 1), (0, 1))]
    tags = range(1, 13)
    cells = [(1, 5, 6, 2, 4, 8, 7, 3), (5, 9, 10, 6, 8, 12, 11, 7)]
    faces = [(1, 2, 3, 4), (9, 10, 11, 12)]
    words = lambda numbers: " ".join(map(str, numbers))
    lines = ["$MeshFormat", f"{version} 0 8", "$EndMeshFormat", "$PhysicalNames", "1", '2 7 "wet side"', "$EndPhysicalNames"]
    if version < 4:
        lines += ["$Nodes", "12", *(words((tag, *node)) for tag, node in zip(tags, nodes)), "$EndNodes", "$Elements", "4"]
        lines += [f"{k + 1} 3 2 {7 + k} {7 + k} {words(face)}" for k, face in enumerate(faces)]
        lines += [f"{k + 3} 5 2 1 1 {words(cell)}" for k, cell in enumerate(cells)]
    else:
        lines += ["$Entities", "0 0 2 1", "7 0 0 0 0 1 1 1 7 0", "8 2 0 0 2 1 1 1 8 0", "1 0 0 0 2 1 1 1 1 2 7 8", "$EndEntities"]
        lines += ["$Nodes", "1 12 1 12", "3 1 0 12", *map(str, tags), *map(words, nodes), "$EndNodes"]
        lines += ["$Elements", "3 4 1 4"]
        lines += [line for k, face in enumerate(faces) for line in (f"2 {7 + k} 3 1", f"{k + 1} {words(face)}")]
        lines += ["3 1 5 2", *(f"{k + 3} {words(cell)}" for k, cell in enumerate(cells))]
    return "\n".join([*lines, "$EndElements", ""])


def tee(version):
    """A plate of 2 x 2 quadrangles with a stiffener on it, and a second one across; of the second order where version is 2.1."""
    tags, nodes = {}, []

    def node(*x):
        if x not in tags:
            tags[x] = len(nodes) + 1
            nodes.append(x)
        return tags[x]

    quads = [(1, [node(i + a, j + b, 0) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]) for i in range(2) for j in range(2)]
    quads += [(2, [node(i, 1, 0), node(i + 1, 1, 0), node(i + 1, 1, 1), node(i, 1, 1)]) for i in range(2)]
    quads += [(3, [node(1, j, 0), node(1, j + 1, 0), node(1, j + 1, 1), node(1, j, 1)]) for j in range(2)]
    edge = [node(0, 0, 0), node(1, 0, 0)]
    words = lambda numbers: " ".join(map(str, numbers))
    middle = lambda a, b: node(*(0.5 * (p + q) for p, q in zip(nodes[a - 1], nodes[b - 1])))
    kind = 3
    if version == 2.1:
        kind = 16
        quads = [(group, quad + [middle(quad[k], quad[(k + 1) % 4]) for k in range(4)]) for group, quad in quads]
    lines = ["$MeshFormat", f"{2.2 if version == 2.1 else version} 0 8", "$EndMeshFormat",
             "$PhysicalNames", "3", '1 5 "edge"', '2 1 "plate"', '2 2 "bars"', "$EndPhysicalNames"]
    if version < 4:
        lines += ["$Nodes", str(len(nodes)), *(words((tag + 1, *x)) for tag, x in enumerate(nodes)), "$EndNodes"]
        lines += ["$Elements", str(len(quads) + 1), f"1 1 2 5 5 {words(edge)}"]
        lines += [f"{k + 2} {kind} 2 {group} {group} {words(quad)}" for k, (group, quad) in enumerate(quads)]
    else:
        lines += ["$Entities", "0 1 3 0", "5 0 0 0 1 0 0 1 5 0", *(f"{g} 0 0 0 2 2 1 1 {g} 0" for g in (1, 2, 3)), "$EndEntities"]
        lines += ["$Nodes", f"1 {len(nodes)} 1 {len(nodes)}", f"2 1 0 {len(nodes)}", *map(str, range(1, len(nodes) + 1)), *map(words, nodes)]
        lines += ["$EndNodes", "$Elements", f"4 {len(quads) + 1} 1 {len(quads) + 1}", "1 5 1 1", f"1 {words(edge)}"]
        for g in (1, 2, 3):
            mine = [(k, quad) for k, (group, quad) in enumerate(quads) if group == g]
            lines += [f"2 {g} 3 {len(mine)}", *(f"{k + 2} {words(quad)}" for k, quad in mine)]
    return "\n".join([*lines, "$EndElements", ""])


def keys_of(page):
    """Words in the tables of a page: keys, and values in quotes."""
    text = "\n".join(line for line in page.read_text().splitlines() if line.startswith("|"))
    return sorted(set(re.findall(r"`([A-Za-z_][\w.-]*)`", text)) | set(re.findall(r'"([\w-]+)"', text)))


def main(project, output):
    cases = project / "cases"
    inputs = {"scene": {}, "overrides": {}, "study": {}, "mesh": {}, "reference": {}, "record": {}}
    for path in sorted(cases.rglob("*.toml")):
        inputs["study" if path.name == "study.toml" else "scene"]["_".join(path.relative_to(cases).parts)] = path.read_text()
    for number, _ in enumerate(inputs["scene"]):
        inputs["overrides"][str(number)] = chr(number) + "\n".join(OVERRIDES[number % 4:: 4])
    for path in sorted(cases.glob("*/reference/*.csv")):
        inputs["reference"]["_".join(path.relative_to(cases).parts)] = "\n".join(path.read_text().splitlines()[:40])
    for path in sorted(project.rglob("tests/unit/**/*.msh")):
        inputs["mesh"][path.name] = path.read_text()
    inputs["mesh"].update({f"two_cubes_{version}.msh": two_cubes(version) for version in (2.2, 4.1)})
    inputs["mesh"].update({f"tee_{version}.msh": tee(version) for version in (2.1, 2.2, 4.1)})
    inputs["record"] = {"full": json.dumps(RECORD, indent=2), "least": '{"scene": "a", "status": "done"}'}

    scene_words = keys_of(project / "docs" / "reference" / "scene-file.md")
    words = {
        "scene": scene_words, "overrides": scene_words, "study": scene_words + keys_of(project / "docs" / "reference" / "studies.md"),
        "mesh": ["$MeshFormat", "$EndMeshFormat", "$PhysicalNames", "$EndPhysicalNames", "$Entities", "$EndEntities", "$Nodes",
                 "$EndNodes", "$Elements", "$EndElements", "$Comments", "2.2 0 8", "4.1 0 8", "nan", "1e999", "-1", "18446744073709551616"],
        "reference": ["metric,", "label,unit,scale,", "time [s],", "pressure [Pa]", "+-", "nan", "inf", "1e999", "-1", "0x1p3", "#"],
        "record": [*RECORD, *RECORD["clamps"], "null", "true", "1e999", "-1", "18446744073709551616", "{}", "[]"],
    }
    for name, files in inputs.items():
        folder = output / name
        folder.mkdir(parents=True, exist_ok=True)
        for file, text in files.items():
            (folder / file).write_bytes(text.encode())
        escaped = (word.replace("\\", "\\\\").replace('"', '\\"') for word in dict.fromkeys(words[name]))
        (output / f"{name}.dict").write_text("".join(f'"{word}"\n' for word in escaped))
        print(f"{name}: {len(files)} inputs, {len(words[name])} words")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]))
