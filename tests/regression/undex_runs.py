"""Runs of the program for the tests: start it, read what it wrote, and say what differs."""
import csv
import json
import os
import pathlib
import re
import subprocess

try:
    import h5py
except ImportError:  # the field files are then only looked for, not opened
    h5py = None

# Other tests run beside these: a thread that waits must not hold a core.
ENVIRONMENT = dict(os.environ, OMP_WAIT_POLICY="passive")

# What summary.json holds for every run; coupled runs also interface_energy_error and _impulse_error.
SUMMARY_KEYS = [
    "scene", "status", "time_s", "steps", "wall_time_s", "cpu_time_s", "threads", "particles", "wall_particles", "cells",
    "particle_updates", "neighbour_interactions", "peak_memory_bytes", "solver_memory_bytes", "mass_error", "momentum_error",
    "energy_error",
    "clamps", "passes", "metrics",
]


def call(program, *arguments, timeout=300, **options):
    """The finished process, with its output as text."""
    options.setdefault("env", ENVIRONMENT)
    return subprocess.run([str(program), *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          timeout=timeout, **options)


def overrides(settings):
    """{"resolution.spacing": 0.004} as arguments."""
    return [part for key, value in settings.items() for part in ("-P", f"{key}={value}")]


def summary(folder):
    return json.loads((pathlib.Path(folder) / "summary.json").read_text())


class Table:
    """A history: column names, their units, and the rows as text and as numbers."""

    def __init__(self, path):
        self.text = pathlib.Path(path).read_text()
        lines = self.text.splitlines()
        self.ends_whole = self.text.endswith("\n")
        self.names, self.units = [], []
        for head in next(csv.reader(lines[:1])):
            name, _, unit = head.rpartition(" [")
            self.names.append(name)
            self.units.append(unit[:-1] if unit.endswith("]") else None)
        self.rows = [[float(cell) for cell in row] for row in csv.reader(lines[1:])]

    def column(self, name):
        at = self.names.index(name)
        return [row[at] for row in self.rows]


def histories(folder):
    """All CSV files of a run by their name relative to its folder."""
    folder = pathlib.Path(folder)
    files = [folder / "energy.csv", *sorted((folder / "history").glob("*.csv"))]
    return {str(path.relative_to(folder)): Table(path) for path in files}


def particle_steps(folder, name="particles"):
    """[(time, {field: array})] of the snapshots of particles (or "solids"), in order."""
    steps = []
    with h5py.File(pathlib.Path(folder) / "fields" / f"{name}.h5part", "r") as file:
        for number in sorted(int(name.split("#")[1]) for name in file if name.startswith("Step#")):
            group = file[f"Step#{number}"]
            steps.append((float(group.attrs["TimeValue"]), {name: group[name][()] for name in group}))
    return steps


def structure_steps(folder, stem="structure"):
    """[(time, path)] of a structure's snapshots, from their index."""
    fields = pathlib.Path(folder) / "fields"
    index = json.loads((fields / f"{stem}.hdf.series").read_text())
    return [(float(entry["time"]), fields / entry["name"]) for entry in index["files"]]


def datasets(path):
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.__setitem__(name, item[()]) if isinstance(item, h5py.Dataset) else None)
    return found


def unequal_datasets(path, other):
    """Names of what is not in both files, bit for bit."""
    a, b = datasets(path), datasets(other)
    return sorted(key for key in a.keys() | b.keys() if key not in a or key not in b or a[key].tobytes() != b[key].tobytes())


def differences(one, other):
    """What differs, bit for bit, between the results of two runs; costs and the number of threads are not results."""
    found = []
    first, second = summary(one), summary(other)
    for record in (first, second):  # where a warning's key stands: in the scene, or in resolved.toml
        if "warnings" in record:
            record["warnings"] = [re.sub(r"^\S+\.toml:\d+:\d+: ", "", warning) for warning in record["warnings"]]
    for key in first.keys() | second.keys():
        if key in ("wall_time_s", "cpu_time_s", "threads", "passes", "peak_memory_bytes", "solver_memory_bytes", "scene",
                   "trust"):  # the last says in words what others say in numbers
            continue
        if first.get(key) != second.get(key):
            found.append(f"summary.json {key}: {first.get(key)} and {second.get(key)}")
    tables, others = histories(one), histories(other)
    if tables.keys() != others.keys():
        found.append(f"histories: {sorted(tables)} and {sorted(others)}")
    for name in tables.keys() & others.keys():
        if tables[name].text == others[name].text:
            continue
        lines = zip(tables[name].text.splitlines(), others[name].text.splitlines())
        where = next((i for i, (a, b) in enumerate(lines, 1) if a != b), "the end")
        found.append(f"{name} from line {where} on")
    texts = [{str(p.relative_to(f)): p.read_text() for pattern in ("bodies.csv", "forces.csv", "lines/*.csv")
              for p in pathlib.Path(f).glob(pattern)} for f in (one, other)]
    found += [name for name in sorted(texts[0].keys() | texts[1].keys()) if texts[0].get(name) != texts[1].get(name)]
    names = [{str(p.relative_to(f)) for p in (pathlib.Path(f) / "fields").glob("*.h*")} for f in (one, other)]
    if names[0] != names[1]:
        found.append(f"fields: {sorted(names[0])} and {sorted(names[1])}")
    elif h5py:
        for name in sorted(names[0]):
            if name.endswith(".series"):
                if (pathlib.Path(one) / name).read_text() != (pathlib.Path(other) / name).read_text():
                    found.append(name)
                continue
            unequal = unequal_datasets(pathlib.Path(one) / name, pathlib.Path(other) / name)
            if unequal:
                found.append(f"{name}: {', '.join(unequal[:5])}")
    evidence = [pathlib.Path(folder) / "evidence.h5" for folder in (one, other)]
    if h5py and all(path.is_file() for path in evidence):  # an older program leaves none
        if unequal := unequal_datasets(*evidence):
            found.append(f"evidence.h5: {', '.join(unequal[:5])}")
    return found
