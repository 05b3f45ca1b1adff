#!/usr/bin/python3
"""Pictures of a finished (or running) undex run: histories against the references, the mid-plane's pressure, solids, energies.

Usage: /usr/bin/python3 scripts/plot.py DIR [--reference FOLDER] [--times 15,30,...] [--dpi N]
       /usr/bin/python3 scripts/plot.py --compare DIR [--dpi N]      DIR: what undex compare wrote

The first reads DIR/summary.json, resolved.toml, history/*.csv, energy.csv, bodies.csv, forces.csv, lines/*.csv,
fields/particles.h5part, solids.h5part and structure_*.hdf as far as they are there, and writes DIR/pictures/*.png.
Needs python3-numpy, python3-matplotlib, python3-h5py
(Debian's own).
"""
import argparse
import csv
import json
import re
import sys
import tomllib
from pathlib import Path

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
    from matplotlib.collections import EllipseCollection, LineCollection, PolyCollection
except ImportError as error:
    sys.exit(f"plot.py: {error}. Run scripts/install_packages.sh, and this script with /usr/bin/python3 "
             f"(this is {sys.executable}).")

PROJECT = Path(__file__).resolve().parent.parent
REFERENCE = {"rigid_cylinder": PROJECT / "cases/rigid_cylinder/reference",
             "tube": PROJECT / "cases/al_tube_fem/reference"}
PAPER_TIMES = [15, 30, 45, 60, 75, 90, 105, 120]  # us, of the paper's pressure pictures
CAVITATED = 1e-4  # void fraction above which a particle counts as cavitated


class Missing(Exception):
    """Something that a picture needs is not there; the message says what and where."""


# ---------------------------------------------------------------------------------------------------- reading

def read_history(path, of_a_run=True):
    """Columns of a CSV history by name without unit, e.g. {"time": ..., "pressure": ...}; # lines are comments. Of a run, which may
    have been killed, what comes after the last end of line is part of a row and left out."""
    with open(path, newline="") as file:
        lines = [line for line in file if line.endswith("\n") or not of_a_run]
    rows = [row for row in csv.reader(line for line in lines if not line.startswith("#")) if row]
    if len(rows) < 2:
        raise Missing(f"{path}: no samples")
    names = [re.sub(r"\s*\[.*\]$", "", cell).strip() for cell in rows[0]]
    try:
        values = np.array(rows[1:], dtype=float)
    except ValueError as error:
        raise Missing(f"{path}: not a history: {error}") from error
    return {name: values[:, i] for i, name in enumerate(names)}


def read_reference_table(path):
    """Rows of a reference table: (sources, {metric: (scale, [value or nan per source])})."""
    with open(path, newline="") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    number = lambda cell: float(cell.split("+-")[0]) if cell.strip() else float("nan")
    return rows[0][4:], {row[0]: (float(row[3]), [number(cell) for cell in row[4:]]) for row in rows[1:] if row}


class Run:
    """What a run left in its folder."""

    def __init__(self, folder):
        self.folder = Path(folder)
        if not self.folder.is_dir():
            raise Missing(f"{folder}: no such folder; give the output folder of a run (undex run ... -o DIR)")
        summary = self.folder / "summary.json"
        self.summary = json.loads(summary.read_text()) if summary.is_file() else {}
        if not self.summary:
            print(f"plot.py: {summary} is missing: the run is not finished, or this is not a run's folder")
        resolved = self.folder / "resolved.toml"
        self.scene = tomllib.loads(resolved.read_text()) if resolved.is_file() else {}
        self.histories = {}
        for path in sorted((self.folder / "history").glob("*.csv")):
            try:
                self.histories[path.stem] = read_history(path)
            except Missing as error:
                print(f"plot.py: {error}; left out")
        self.name = self.summary.get("scene") or self.scene.get("name") or self.folder.name
        if not (self.summary or self.scene or self.histories):
            raise Missing(f"{folder}: no summary.json, resolved.toml or history/*.csv here; give the output folder of a run")

    def setting(self, key, default=None):
        """A value of resolved.toml by its dotted key."""
        value = self.scene
        for part in key.split("."):
            if not isinstance(value, dict) or part not in value:
                return default
            value = value[part]
        return value

    @property
    def kind(self):
        """Which comparison this is: "rigid_cylinder", "tube" or None."""
        kind = self.setting("comparison.kind")
        if kind in REFERENCE:
            return kind
        if kind is None and "rigid_cylinder" in self.name:
            return "rigid_cylinder"
        return "tube" if kind is None and "tube" in self.name and "1d" not in self.name else None

    def history_with(self, column):
        """The history that the comparison is about: the named probe, else the first with such a column."""
        probe = self.setting("comparison.probe")
        candidates = [probe] if probe in self.histories else []
        for name in candidates + list(self.histories):
            if any(key.startswith(column) for key in self.histories[name]):
                return self.histories[name]
        raise Missing(f"{self.folder}/history: no CSV has a column '{column}'; add a probe with it to the scene")

    def body_name(self, number):
        bodies = self.setting("bodies", [])
        return bodies[number]["name"] if number < len(bodies) else f"body {number}"

    def title(self):
        parts = [self.name]
        spacing = self.setting("resolution.spacing")
        if spacing:
            parts.append(f"spacing {1e3 * spacing:g} mm")
        if self.summary.get("particles"):
            parts.append(f"{self.summary['particles']:,} particles")
        return ", ".join(parts)


# ------------------------------------------------------------------------------------------- histories

def plot_all_histories(run):
    """Every probe, one panel per quantity: what the run recorded, without comment."""
    panels = {}
    for name, history in run.histories.items():
        for column, values in history.items():
            if column != "time":
                panels.setdefault(column, []).append((name, history["time"], values))
    if not panels:
        raise Missing(f"{run.folder}/history: no histories")
    columns = min(3, len(panels))
    rows = -(-len(panels) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(5 * columns, 3 * rows), squeeze=False)
    for axis in axes.flat[len(panels):]:
        axis.remove()
    for axis, (column, curves) in zip(axes.flat, panels.items()):
        for name, time, values in curves:
            axis.plot(1e6 * time, values, lw=1, label=name)
        axis.set(xlabel="time [µs]", title=column)
        if len(panels) == 1 or len(curves) > 1 or len(run.histories) > 1:
            axis.legend(fontsize=7)
        axis.grid(alpha=0.3)
    figure.suptitle(run.title())
    return figure


def plot_rigid_cylinder(run, reference):
    history = run.history_with("pressure")
    exact = read_history(reference / "midline_wall_pressure.csv", of_a_run=False)
    sources, table = read_reference_table(reference / "metrics.csv")
    figure, axis = plt.subplots(figsize=(9, 5))
    column = next(key for key in exact if key != "time")
    axis.plot(1e6 * exact["time"], 1e-9 * exact[column], color="0.45", lw=1.2, label="converged (independent mesh code)")
    axis.plot(1e6 * history["time"], 1e-9 * history["pressure"], color="C0", lw=1.4, label="this run")
    if "paper SPH 1 mm" in sources:
        paper = {metric: values[sources.index("paper SPH 1 mm")] for metric, (_, values) in table.items()}
        points = [(paper["first_peak_time_s"], paper["first_peak_pa"]), (paper["cavitation_s"], 0),
                  (paper["collapse_s"], 0), (paper["second_peak_time_s"], paper["second_peak_5us_pa"]),
                  (paper["second_cavitation_s"], 0)]
        axis.plot(*zip(*points), "s", color="C3", mfc="none", ms=7, clip_on=False, label="paper's SPH, key points")
    axis.set(xlim=(0, max(1e6 * history["time"][-1], 20)), ylim=(-0.02, None), xlabel="time [µs]",
             ylabel="wall pressure at mid-height [GPa]", title=run.title())
    axis.grid(alpha=0.3)
    axis.legend()
    return figure


# Colour, marker, line and label of each source in the tube's plots.
TUBE_STYLE = {"converged Tait": dict(color="k", ls="-", marker="."), "converged MG": dict(color="0.5", ls="-", marker="."),
              "experiment": dict(color="C3", ls="", marker="o"), "hydrocode": dict(color="C2", ls="--", marker="^"),
              "expt. as paper": dict(color="C3", ls="", marker="x"), "paper Tait": dict(color="C1", ls=":", marker="s"),
              "paper MG": dict(color="C4", ls=":", marker="D")}


def largest_component(history, quantity):
    """Time and the component of a vector quantity that moves most, counted positive outwards (as it first moves)."""
    columns = [key for key in history if key == quantity or re.fullmatch(quantity + "_[xyz]", key)]
    best = max(columns, key=lambda key: np.abs(history[key]).max())
    values = history[best]
    return history["time"], values * (np.sign(values[np.abs(values).argmax()]) or 1), best[len(quantity):]


def plot_tube(run, reference):
    sources, table = read_reference_table(reference / "displacement.csv")
    wall = run.history_with("displacement")
    time, displacement, direction = largest_component(wall, "displacement")
    figure, (left, right) = plt.subplots(1, 2, figsize=(13, 5.2))
    left.plot(1e6 * time, 1e3 * displacement, color="C0", lw=2, label="this run", zorder=5)
    velocity = "velocity" + direction
    if velocity in wall:
        sign = np.sign(wall["displacement" + direction][np.abs(wall["displacement" + direction]).argmax()]) or 1
        right.plot(1e6 * time, sign * wall[velocity], color="C0", lw=2, label="this run", zorder=5)
    else:
        right.plot(1e6 * time, np.gradient(displacement, time), color="C0", lw=1, label="this run (slope)", zorder=5)
    for axis, pattern in ((left, r"displacement_(\d+)us_m"), (right, r"wall_velocity_(\d+)us_m_s")):
        for i, source in enumerate(sources):
            points = [(float(match[1]), values[i]) for metric, (_, values) in table.items()
                      if (match := re.fullmatch(pattern, metric)) and not np.isnan(values[i])]
            if points:
                axis.plot(*zip(*sorted(points)), label=source, ms=5, lw=1, **TUBE_STYLE.get(source, dict(marker=".")))
    end = max(1e6 * time[-1], 30)
    left.set(ylabel="outward displacement, mid-length [mm]", xlim=(0, 1.05 * end), ylim=(0, None))
    right.set(ylabel="wall velocity, mid-length [m/s]", xlim=(0, 1.05 * end))
    for axis in (left, right):
        axis.set_xlabel("time [µs]")
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    figure.suptitle(run.title())
    return figure


# ------------------------------------------------------------------------------------------- profiles

def plot_profile(run):
    """The particles as dots and the exact solution as a line, a panel per quantity."""
    computed = read_history(run.folder / "profile.csv")
    exact = read_history(run.folder / "profile_exact.csv")
    figure, axes = plt.subplots(3, 1, figsize=(9, 10), sharex=True)
    for axis, quantity, unit in zip(axes, ("density", "velocity", "pressure"), ("kg/m³", "m/s", "Pa")):
        axis.plot(exact["coordinate"], exact["exact_" + quantity], color="0.35", lw=1.2, label="exact", zorder=1)
        for body in np.unique(computed["body"]):
            mine = computed["body"] == body
            axis.plot(computed["coordinate"][mine], computed[quantity][mine], ".", ms=2.5, rasterized=True,
                      label=run.body_name(int(body)), zorder=2)
        axis.set(ylabel=f"{quantity} [{unit}]")
        axis.grid(alpha=0.3)
    axes[0].legend(fontsize=8)
    axes[-1].set_xlabel("x [m]" if run.setting("comparison.solution") == "riemann" else "radius [m]")
    axes[0].set_title(run.title())
    return figure


# ------------------------------------------------------------------------------------------- energies

def plot_energy(run):
    path = run.folder / "energy.csv"
    if not path.is_file():
        raise Missing(f"{path}: missing")
    energy = read_history(path)
    time = energy.pop("time")
    figure, (upper, lower) = plt.subplots(2, 1, figsize=(9, 7), sharex=True, height_ratios=[3, 1])
    total = energy.get("total")
    errors = {name: energy.pop(name) for name in list(energy) if "error" in name}
    with open(path) as file:
        header = next(line for line in file if not line.startswith("#"))
    for name in errors:  # relative to the start's total, whether the file says so or gives joules
        if f"{name} [J]" in header and total is not None and total[0] != 0:
            errors[name] = errors[name] / abs(total[0])
    for name, values in energy.items():
        if np.any(values != 0):
            upper.plot(1e6 * time, 1e-3 * values, lw=2 if name == "total" else 1.2,
                       color="k" if name == "total" else None, label=name.replace("_", " "))
    upper.set(ylabel="energy [kJ]", title=run.title())
    upper.legend(fontsize=8, ncol=2)
    upper.grid(alpha=0.3)
    for name, values in errors.items():
        lower.plot(1e6 * time, 100 * values, lw=1, label=name.replace("_", " "))
    if not errors and total is not None and total[0] != 0:
        lower.plot(1e6 * time, 100 * (total / total[0] - 1), lw=1, label="total, change")
    lower.set(xlabel="time [µs]", ylabel="error [%]")
    if lower.lines:
        lower.legend(fontsize=8)
    lower.grid(alpha=0.3)
    return figure


# A panel each: what of the columns' last word, its label, and the factor.
BODY_PANELS = [(("radius",), "radius [mm]", 1e3), (("volume", "cavitated_volume", "void_volume"), "volume [cm³]", 1e6),
               (("pressure",), "mean pressure [MPa]", 1e-6), (("kinetic", "internal"), "energy [kJ]", 1e-3)]
FORCE_PANELS = [(("force",), "force [kN]", 1e-3), (("impulse",), "impulse [N s]", 1.0)]


def plot_parts(run, file, wanted):
    """bodies.csv or forces.csv: a curve a column NAME.WORD, or NAME.WORD_x, in the panel of its word."""
    columns = read_history(run.folder / file)
    time = columns.pop("time")
    word = lambda column: re.sub(r"_[xyz]$", "", column.rpartition(".")[2])
    panels = [(label, factor, [c for c in columns if word(c) in words]) for words, label, factor in wanted]
    panels = [panel for panel in panels if panel[2]]
    figure, axes = plt.subplots(len(panels), 1, figsize=(9, 2.6 * len(panels)), sharex=True, squeeze=False)
    for axis, (label, factor, names) in zip(axes[:, 0], panels):
        for name in names:
            axis.plot(1e6 * time, factor * columns[name], lw=1.2, label=name.replace("_", " "))
        axis.set(ylabel=label)
        axis.legend(fontsize=8)
        axis.grid(alpha=0.3)
    axes[0, 0].set(title=run.title())
    axes[-1, 0].set(xlabel="time [µs]")
    return figure


def plot_lines(run):
    """lines/*.csv: a panel a line and quantity, a curve a time (ten of them at most)."""
    panels = []
    for path in sorted((run.folder / "lines").glob("*.csv")):
        columns = read_history(path)
        for name in columns:
            if name not in ("time", "distance", "x", "y", "z"):
                panels.append((path.stem, name, columns))
    if not panels:
        return None
    figure, axes = plt.subplots(len(panels), 1, figsize=(9, 2.6 * len(panels)), squeeze=False)
    for axis, (line, name, columns) in zip(axes[:, 0], panels):
        times = np.unique(columns["time"])
        for time in times[np.unique(np.linspace(0, len(times) - 1, 10).astype(int))]:
            now = columns["time"] == time
            axis.plot(1e3 * columns["distance"][now], columns[name][now], lw=1, label=f"{1e6 * time:.4g} µs")
        axis.set(xlabel="distance [mm]", ylabel=f"{line}: {name.replace('_', ' ')}")
        axis.legend(fontsize=7, ncol=2)
        axis.grid(alpha=0.3)
    axes[0, 0].set(title=run.title())
    return figure


# ------------------------------------------------------------------------------------------- mid-plane

AXES = "xyz"


def symmetric_axes(run, low, spacing):
    """Axes across which the computed part must be mirrored: what the scene says, else where nothing is below zero."""
    planes = run.setting("symmetry.planes")
    if planes is not None:
        return {AXES.index(p) if isinstance(p, str) else int(p) for p in planes}
    return {d for d in range(3) if low[d] > -0.1 * spacing}


def mirrored(points, values, axes, plane_axes):
    """Copies of 2D points (n, 2) and their values across each mirrored axis of the plane."""
    for k, axis in enumerate(plane_axes):
        if axis in axes:
            flipped = points.copy()
            flipped[:, k] *= -1
            points, values = np.concatenate([points, flipped]), [np.concatenate([v, v]) for v in values]
    return points, values


def structure_sections(folder, stem="structure"):
    """Times and files of the snapshots of the structure, or of the obstacles' surfaces, by the index."""
    index = folder / f"{stem}.hdf.series"
    if not index.is_file():
        return []
    return [(entry["time"], folder / entry["name"]) for entry in json.loads(index.read_text())["files"]]


def cut_edges(points, height, level, a, b):
    """The places where the edges from points `a` to points `b` pass that height."""
    crossed = (height[a] <= level) != (height[b] <= level)
    a, b = a[crossed], b[crossed]
    share = ((level - height[a]) / (height[b] - height[a]))[:, None]
    return points[a] + share * (points[b] - points[a])


def with_mirror_images(shapes, plane_axes, mirror):
    """Shapes in the plane, and their images across the symmetry planes."""
    for k, axis in enumerate(plane_axes):
        if axis in mirror:
            sign = np.ones(2)
            sign[k] = -1
            shapes = shapes + [shape * sign for shape in shapes]
    return shapes


def structure_polygons(path, normal, plane_axes, mirror):
    """The cells of a structure that the plane through the origin cuts (or touches), as polygons in the plane; of a meridian all."""
    import h5py

    # Edges of a VTK hexahedron.
    edges = np.array([(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)])
    with h5py.File(path) as file:
        points = file["VTKHDF/Points"][:].astype(float)
        cells = file["VTKHDF/Connectivity"][:].reshape(len(file["VTKHDF/Types"]), -1)
    if cells.shape[1] == 4:
        return with_mirror_images([points[cell][:, plane_axes] for cell in cells], plane_axes, mirror)
    height = points[:, normal]
    size = np.ptp(height[cells], axis=1)
    low, high = height[cells].min(axis=1), height[cells].max(axis=1)
    # On a symmetry plane the first layer only touches it: cut a little way in.
    level = 1e-3 * np.median(size)
    polygons = []
    for cell in cells[(low <= level) & (high > level)]:
        corners = cut_edges(points, height, level, cell[edges[:, 0]], cell[edges[:, 1]])[:, plane_axes]
        if len(corners) < 3:
            continue
        middle = corners.mean(axis=0)
        order = np.argsort(np.arctan2(*(corners - middle).T))
        polygons.append(corners[order])
    return with_mirror_images(polygons, plane_axes, mirror)


def surface_segments(path, normal, plane_axes, mirror):
    """What the plane through the origin cuts of a surface's faces, as segments in the plane; of segments all."""
    import h5py

    with h5py.File(path) as file:
        points = file["VTKHDF/Points"][:].astype(float)
        offsets = file["VTKHDF/Offsets"][:]
        faces = np.split(file["VTKHDF/Connectivity"][:], offsets[1:-1])
    height = points[:, normal]
    spans = [np.ptp(height[face]) for face in faces if len(face) == 4]
    level = 1e-3 * np.max(spans) if spans else 0.0  # on a symmetry plane the first faces only touch it: cut a little way in
    segments = []
    for face in faces:
        if len(face) == 2:
            segments.append(points[face][:, plane_axes])
            continue
        ends = cut_edges(points, height, level, face, np.roll(face, -1))
        if len(ends) == 2:
            segments.append(ends[:, plane_axes])
    return with_mirror_images(segments, plane_axes, mirror)


def particle_sizes(step, spacing, count, dimension=3):
    """Diameter of the disc that stands for each particle: that of its volume (area) where mass and density tell it."""
    if "mass" in step and "density" in step:
        volume = step["mass"][:] / np.maximum(step["density"][:], 1e-12)
        size = volume ** (1 / dimension)
        # A particle on an octant's plane keeps its whole mass, so the sizes need no correction.
        return np.clip(size, 0.5 * spacing, 6 * spacing)
    if "smoothing_length" in step:
        h = step["smoothing_length"][:]
        return spacing * h / np.median(h)
    return np.full(count, spacing)


def nearest(times, wanted):
    """Indices of the snapshots nearest to the wanted times, each once, none further off than half the gap asked for.
    Where no times are wanted, or none is met: up to eight, evenly spread."""
    times = np.asarray(times)
    chosen = []
    slack = 0.5 * min(np.diff(wanted)) if len(wanted) > 1 else np.inf
    for time in wanted:
        i = int(np.abs(times - time).argmin())
        if abs(times[i] - time) <= slack and i not in chosen:
            chosen.append(i)
    return chosen or sorted({int(i) for i in np.linspace(0, len(times) - 1, min(8, len(times)))})


def plot_profiles(run, file, steps, times, wanted_us):
    """One-dimensional scenes: pressure along x."""
    figure, axis = plt.subplots(figsize=(9, 5))
    for i in nearest(times, [1e-6 * t for t in wanted_us]):
        order = np.argsort(file[steps[i]]["x"][:])
        axis.plot(1e3 * file[steps[i]]["x"][:][order], 1e-6 * file[steps[i]]["pressure"][:][order], lw=1,
                  label=f"{1e6 * times[i]:.1f} µs")
    axis.set(xlabel="x [mm]", ylabel="pressure [MPa]", title=run.title())
    axis.legend(fontsize=8)
    axis.grid(alpha=0.3)
    return figure


def read_snapshots(path):
    """An open H5Part file, and names and times of its snapshots."""
    if not path.is_file():
        raise Missing(f"{path}: missing; ask for field snapshots in the scene's [output]")
    import h5py

    file = h5py.File(path)
    steps = sorted((name for name in file if re.fullmatch(r"Step#\d+", name)), key=lambda name: int(name[5:]))
    if not steps:
        raise Missing(f"{path}: no snapshots in it yet")
    return file, steps, [float(np.ravel(file[name].attrs["TimeValue"])[0]) for name in steps]


def positions(step):
    return np.stack([step[axis][:] for axis in AXES], axis=1).astype(float)


class Section:
    """The plane through the origin that is shown: it contains the axis `along` (the longest where none is named), drawn to
    the right, and x, or y where x is that axis. A plane scene is its own section."""

    def __init__(self, run, position, spacing, along=None):
        low, high = position.min(axis=0), position.max(axis=0)
        if not spacing:
            sides = (high - low)[high > low]
            spacing = float((np.prod(sides) / len(position)) ** (1 / max(len(sides), 1)))
        self.spacing = spacing
        self.mirror = {d for d in symmetric_axes(run, low, spacing) if high[d] > low[d]}
        self.extent = np.where([d in self.mirror for d in range(3)], 2 * high, high - low)
        self.dimension = int((self.extent > 1e-9 * self.extent.max()).sum())
        self.length = int(self.extent.argmax()) if along is None else along
        self.across = 0 if self.length != 0 else 1
        if self.dimension == 2:
            self.across = ({0, 1, 2} - {self.length, int(self.extent.argmin())}).pop()
        self.normal = 3 - self.length - self.across
        self.axes = (self.length, self.across)

    def cut(self, position, size, values, start=None):
        """Points of the particles that the plane meets, with the mirrored ones, and their values. Where the places at the
        start are given, those that it met then count as long as they are near: stretched, they have moved away from it."""
        reach = 0.75 * np.maximum(size, self.spacing)
        inside = np.abs(position[:, self.normal]) < reach
        if start is not None:
            inside |= (np.abs(start[:, self.normal]) < reach) & (np.abs(position[:, self.normal]) < 4 * reach)
        return mirrored(position[inside][:, self.axes], [value[inside] for value in values], self.mirror, self.axes)

    def panels(self, count, aspect):
        """A figure with so many panels of that height over width."""
        columns = min(2 if aspect < 0.6 else 4, count)
        rows = -(-count // columns)
        width = min(14, 8 * columns)
        figure, axes = plt.subplots(rows, columns, squeeze=False, layout="constrained",
                                    figsize=(width, (width / columns - 1.2) * aspect * rows + 0.45 * rows + 0.6))
        for axis in axes.flat[count:]:
            axis.remove()
        return figure, axes.flat[:count]

    def frame(self, axis, low, high, time):
        """Limits [mm] round low..high [m], equal axes, the time as title."""
        margin = 1e3 * self.spacing
        axis.set(xlim=(1e3 * low[0] - margin, 1e3 * high[0] + margin), ylim=(1e3 * low[1] - margin, 1e3 * high[1] + margin),
                 aspect="equal", title=f"{1e6 * time:.1f} µs")
        axis.set_facecolor("0.92")
        axis.tick_params(labelsize=7)


def discs(axis, points, size, values=None, **style):
    """Particles as discs [m], coloured by values from `clim` or of one colour."""
    width = 1e3 * np.sqrt(2) * size  # on a square lattice they then leave no gaps
    clim = style.pop("clim", None)
    collection = EllipseCollection(width, width, 0, units="xy", offsets=1e3 * points, transOffset=axis.transData, linewidths=0,
                                   **style)
    if values is not None:
        collection.set_array(values)
        collection.set_clim(*clim)
    return axis.add_collection(collection)


def plot_mid_plane(run, wanted_us):
    path = run.folder / "fields/particles.h5part"
    file, steps, times = read_snapshots(path)
    with file:
        section = Section(run, positions(file[steps[0]]), run.setting("resolution.spacing"))
        if section.dimension < 2:
            return plot_profiles(run, file, steps, times, wanted_us)
        structures = [structure_sections(run.folder / "fields", index.name.removesuffix(".hdf.series"))
                      for index in sorted((run.folder / "fields").glob("structure*.hdf.series"))]
        obstacles = structure_sections(run.folder / "fields", "obstacles")
        chosen = nearest(times, [1e-6 * t for t in wanted_us])
        figure, axes = section.panels(len(chosen), float(section.extent[section.across] / section.extent[section.length]))
        grey = lines = ""
        for axis, i in zip(axes, chosen):
            step = file[steps[i]]
            if "pressure" not in step:
                raise Missing(f"{path}: no field 'pressure'; add it to output.particle_fields of the scene")
            position = positions(step)
            pressure = step["pressure"][:].astype(float)
            void = step["void_fraction"][:] if "void_fraction" in step else np.zeros(len(pressure))
            size = particle_sizes(step, section.spacing, len(pressure), section.dimension)
            points, (values, empty, width) = section.cut(position, size, [1e-6 * pressure, void, size])
            wet = empty <= CAVITATED
            top = max(np.quantile(values[wet], 0.995) if wet.any() else 1.0, 1.0)
            shown = discs(axis, points[wet], width[wet], values[wet], clim=(0, top), cmap="turbo")
            discs(axis, points[~wet], width[~wet], facecolors="white")
            for structure in structures:
                when, solid = min(structure, key=lambda entry: abs(entry[0] - times[i]))
                if abs(when - times[i]) < 1e-6 and solid.is_file():
                    polygons = [1e3 * p for p in structure_polygons(solid, section.normal, section.axes, section.mirror)]
                    axis.add_collection(PolyCollection(polygons, facecolors="0.35", edgecolors="0.2", linewidths=0.2))
                    points = np.concatenate([points] + [1e-3 * p for p in polygons])
                    grey = "; grey: structure" + "s" * (len(structures) > 1)
            if obstacles:
                when, surface = min(obstacles, key=lambda entry: abs(entry[0] - times[i]))
                if abs(when - times[i]) < 1e-6 and surface.is_file():
                    segments = [1e3 * s for s in surface_segments(surface, section.normal, section.axes, section.mirror)]
                    axis.add_collection(LineCollection(segments, colors="black", linewidths=1.0))
                    points = np.concatenate([points] + [1e-3 * s for s in segments])
                    lines = "; black: obstacles"
            if (run.folder / "fields/solids.h5part").is_file():
                solids, solid_steps, solid_times = read_snapshots(run.folder / "fields/solids.h5part")
                with solids:
                    k = int(np.abs(np.array(solid_times) - times[i]).argmin())
                    place = positions(solids[solid_steps[k]])
                    spacing = solid_spacing(run, solids[solid_steps[k]], len(place))
                    place, (width,) = section.cut(place, spacing, [spacing])
                    discs(axis, place, width, facecolors="0.35")
                    points = np.concatenate([points, place])
                    grey = "; grey: solids"
            section.frame(axis, points.min(axis=0), points.max(axis=0), times[i])
            figure.colorbar(shown, ax=axis, aspect=15, pad=0.01).ax.tick_params(labelsize=7)
        figure.suptitle(f"{run.title()}\npressure [MPa] in the plane {AXES[section.normal]} = 0 ({AXES[section.length]} to the "
                        f"right, mm); white: cavitated{grey}{lines}", fontsize=10)
    return figure


# ------------------------------------------------------------------------------------------- solids in particles

# What solids are coloured by: the fields it is made of, factor and unit.
SOLID_COLOURS = {"plastic_strain": (["plastic_strain"], 1, "-"), "von_mises": (["von_mises"], 1e-6, "MPa"),
                 "speed": ([f"velocity_{d}" for d in range(3)], 1, "m/s")}


def solid_spacing(run, step, count):
    """Spacing of the lattice that each particle of a solid comes from; the finest where the snapshot does not tell whose."""
    common = run.setting("resolution.spacing")
    spacing = [solid.get("spacing", common) for solid in run.setting("solids", [])] or [common]
    if None in spacing:
        return np.full(count, Section(run, positions(step), None).spacing)
    if "material" in step:
        return np.array(spacing)[step["material"][:].astype(int)]
    return np.full(count, min(spacing))


def solid_axis(run):
    """The axis that a picture of solids must show: that of motion, else of a tube or rod; None: whichever is longest."""
    solids = run.setting("solids", [])
    if run.setting("dimension", 3) < 3:
        return None
    speed = np.max([np.abs(np.resize(solid.get("velocity", [0.0]), 3)) for solid in solids], axis=0) if solids else np.zeros(3)
    if speed.max() > 0:
        return int(speed.argmax())
    axes = [AXES.index(solid["shape"]["axis"]) for solid in solids if "axis" in solid.get("shape", {})]
    return axes[0] if axes else None


def plot_solids(run, wanted_us, quantity):
    """The mid-plane of solids in particles, coloured by plastic strain, von Mises stress or speed; one scale for all times."""
    fields, factor, unit = SOLID_COLOURS[quantity]
    file, steps, times = read_snapshots(run.folder / "fields/solids.h5part")
    with file:
        if any(field not in file[steps[0]] for field in fields):
            return None  # output.solid_fields left it out
        chosen = nearest(times, [1e-6 * t for t in wanted_us])
        first = positions(file[steps[0]])
        section = Section(run, first, solid_spacing(run, file[steps[0]], len(first)).min(), solid_axis(run))
        cuts = []
        for i in chosen:
            step = file[steps[i]]
            position = positions(step)
            value = factor * np.sqrt(sum(step[field][:].astype(float) ** 2 for field in fields))
            size = solid_spacing(run, step, len(position))
            start = np.empty_like(position)
            start[np.argsort(step["id"][:])] = first[np.argsort(file[steps[0]]["id"][:])]
            cuts.append(section.cut(position, size, [value, size], start))
    everything = np.concatenate([values for _, (values, _) in cuts])
    if not everything.any():
        return None  # an elastic solid has no plastic strain to show
    low = np.min([points.min(axis=0) for points, _ in cuts], axis=0)
    high = np.max([points.max(axis=0) for points, _ in cuts], axis=0)
    figure, axes = section.panels(len(chosen), float((high - low)[1] / (high - low)[0]))
    for axis, i, (points, (values, size)) in zip(axes, chosen, cuts):
        shown = discs(axis, points, size, values, clim=(0, np.quantile(everything, 0.998) or 1), cmap="turbo")
        section.frame(axis, low, high, times[i])
    figure.colorbar(shown, ax=list(axes), aspect=30, pad=0.01).ax.tick_params(labelsize=7)
    figure.suptitle(f"{run.title()}\n{quantity.replace('_', ' ')} [{unit}] in the plane {AXES[section.normal]} = 0 "
                    f"({AXES[section.length]} to the right, mm)", fontsize=10)
    return figure


# ------------------------------------------------------------------------------------------- several runs

# Colours that all eyes tell apart (Okabe and Ito); line styles tell the runs apart in grey too.
RUN_COLORS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"]
RUN_LINES = ["-", "--", "-.", (0, (1, 1)), (0, (5, 1, 1, 1, 1, 1)), (0, (8, 2))]
REFERENCE_LABEL = "reference"
SOURCE_MARKERS = "osD^vx+"  # of a reference table's sources


def panels(count):
    """Rows and columns of a figure with so many panels."""
    columns = 2 if count in (2, 4) else min(3, count)
    return -(-count // columns), columns


class Comparison:
    """What undex compare wrote: runs in their order, the curves of each quantity, and the table's rows."""

    def __init__(self, folder):
        self.folder = Path(folder)
        for name in ("comparison.csv", "curves.csv"):
            if not (self.folder / name).is_file():
                raise Missing(f"{self.folder / name}: missing; give the folder that undex compare RUN RUN... -o DIR wrote to")
        with open(self.folder / "comparison.csv", newline="") as file:
            header, *self.rows = list(csv.reader(file))
        self.runs = header[3:header.index("reference", 3)]
        samples = {}
        with open(self.folder / "curves.csv", newline="") as file:
            next(file)
            for probe, kind, quantity, unit, run, time, value in csv.reader(file):
                samples.setdefault((probe, kind, quantity, unit), {}).setdefault(run, []).append((float(time), float(value)))
        # In the order in which they stand, what is neither a run nor the reference history is a source of a table.
        self.sources = list(dict.fromkeys(run for runs in samples.values() for run in runs
                                          if run not in self.runs and run != REFERENCE_LABEL))
        self.curves = {key: {run: np.array(points).T for run, points in runs.items()} for key, runs in samples.items()}

    def select(self, wanted):
        """Curves of the quantities for which wanted(kind, quantity) holds, in the order of the file."""
        return {key: runs for key, runs in self.curves.items() if wanted(key[1], key[2])}

    def style(self, run):
        if run == REFERENCE_LABEL:
            return dict(color="0.35", ls="-", lw=0.9, zorder=1)
        if run in self.sources:
            marker = SOURCE_MARKERS[self.sources.index(run) % len(SOURCE_MARKERS)]
            return dict(color="0.25", ls="", marker=marker, mfc="none", ms=5, zorder=3)
        i = self.runs.index(run)
        return dict(color=RUN_COLORS[i % len(RUN_COLORS)], ls=RUN_LINES[i % len(RUN_LINES)], lw=1.6, zorder=2)


def in_shown_unit(unit, largest):
    """Unit and factor that suit a picture."""
    scales = {"Pa": ("MPa", 1e-6), "Pa s": ("kPa s", 1e-3), "m": ("mm", 1e3), "s": ("µs", 1e6)}
    if unit == "J" and largest >= 1e3:
        return "kJ", 1e-3
    return scales.get(unit, ("" if unit == "-" else unit, 1))


def legend_above(figure, handles, labels):
    """One legend for all panels, above them: it can cover no curve."""
    columns = max(1, min(len(labels), int(9 * figure.get_figwidth() / max(map(len, labels), default=1) / 1.2)))
    rows = -(-len(labels) // columns)
    height = figure.get_figheight()
    figure.legend(handles, labels, loc="upper center", ncol=columns, frameon=False, fontsize=9, handlelength=3.5)
    figure.tight_layout(rect=(0, 0, 1, 1 - (0.1 + 0.22 * rows) / height))


def plot_curves(comparison, wanted):
    """A panel per quantity, a curve per run, the reference in grey."""
    selected = comparison.select(wanted)
    if not selected:
        return None
    rows, columns = panels(len(selected))
    figure, axes = plt.subplots(rows, columns, figsize=(max(4.6 * columns, 6.5), 3.2 * rows + 0.5), squeeze=False)
    for axis in axes.flat[len(selected):]:
        axis.remove()
    handles = {}
    for axis, ((probe, _, quantity, unit), runs) in zip(axes.flat, selected.items()):
        shown, factor = in_shown_unit(unit, max(np.abs(values).max() for _, values in runs.values()))
        end = max(runs[run][0][-1] for run in comparison.runs if run in runs)
        clock, scale = ("ms", 1e3) if end > 2e-3 else ("µs", 1e6)
        for run in [*comparison.runs, REFERENCE_LABEL, *comparison.sources]:
            if run in runs:
                time, values = runs[run]
                handles[run], = axis.plot(scale * time, factor * values, **comparison.style(run))
        axis.set(xlabel=f"time [{clock}]", ylabel=f"{quantity}" + (f" [{shown}]" if shown else ""), xlim=(0, 1.02 * scale * end))
        axis.set_title(probe, fontsize=10)
        axis.grid(alpha=0.3)
    legend_above(figure, list(handles.values()), list(handles))
    return figure


def plot_cost(comparison):
    """Bars: what each run cost, a panel per measure."""
    rows = [row for row in comparison.rows if row[0] == "cost" and row[1] != "threads" and any(row[3:3 + len(comparison.runs)])]
    if not rows:
        return None
    lines, columns = panels(len(rows))
    n = len(comparison.runs)
    figure, axes = plt.subplots(lines, columns, figsize=(4.6 * columns, (0.9 + 0.32 * n) * lines + 0.5), squeeze=False)
    for axis in axes.flat[len(rows):]:
        axis.remove()
    bars = []
    for axis, row in zip(axes.flat, rows):
        values = [float(cell) if cell else 0.0 for cell in row[3:3 + n]]
        bars = axis.barh(range(n), values, color=[comparison.style(run)["color"] for run in comparison.runs], height=0.7)
        axis.bar_label(bars, [f"{value:,.4g}" if value < 1e4 else f"{value:,.0f}" if value else "-" for value in values],
                       padding=3, fontsize=8)
        axis.set(yticks=[], xlim=(0, 1.25 * max(values)), title="")
        axis.set_title(row[1] + (f" [{row[2]}]" if row[2] else ""), fontsize=10)
        axis.invert_yaxis()
        axis.locator_params(axis="x", nbins=5)
        axis.spines[["top", "right"]].set_visible(False)
    legend_above(figure, list(bars), comparison.runs)
    return figure


def draw_comparison(folder, dpi):
    comparison = Comparison(folder)
    pictures = comparison.folder / "pictures"
    pictures.mkdir(exist_ok=True)

    def motion(kind, quantity):
        return kind == "structure" and ("displacement" in quantity or "velocity" in quantity or quantity == "plastic strain")

    def pressure(kind, quantity):
        return kind in ("wall", "fluid") and quantity in ("pressure", "pressure, 1 us mean", "impulse")

    def other(kind, quantity):
        return kind != "energy" and not motion(kind, quantity) and not pressure(kind, quantity) and "mean" not in quantity

    jobs = {"motion": lambda: plot_curves(comparison, motion), "pressure": lambda: plot_curves(comparison, pressure),
            "energy": lambda: plot_curves(comparison, lambda kind, quantity: kind == "energy"),
            "other": lambda: plot_curves(comparison, other), "cost": lambda: plot_cost(comparison)}
    for name, draw in jobs.items():
        figure = draw()
        (pictures / f"{name}.png").unlink(missing_ok=True)  # an older comparison's must not pass for this one's
        if figure is None:
            continue
        figure.savefig(pictures / f"{name}.png", dpi=dpi)
        plt.close(figure)
        print(pictures / f"{name}.png")
    return 0


# ------------------------------------------------------------------------------------------- main

def main():
    parser = argparse.ArgumentParser(description="Pictures of an undex run, or of a comparison of runs, into DIR/pictures.")
    parser.add_argument("folder", metavar="DIR", help="the run's output folder; with --compare the one of undex compare")
    parser.add_argument("--compare", action="store_true", help="DIR was written by undex compare: its runs beside each other")
    parser.add_argument("--reference", type=Path, help="folder of the reference CSV files (default: those of the scene's case)")
    parser.add_argument("--times", help="times of the section's pictures [us], such as 15,30,45 (default: the paper's for "
                                        "its own scenes, else evenly spread)")
    parser.add_argument("--dpi", type=int, default=110)
    options = parser.parse_args()
    if options.compare:
        try:
            return draw_comparison(options.folder, options.dpi)
        except (Missing, ValueError) as error:
            print(f"plot.py: {error}", file=sys.stderr)
            return 2
    try:
        run = Run(options.folder)
        wanted = PAPER_TIMES if run.kind else []
        if options.times:
            wanted = sorted(float(time) for time in options.times.split(","))
    except (Missing, ValueError) as error:
        print(f"plot.py: {error}", file=sys.stderr)
        return 2
    pictures = run.folder / "pictures"
    pictures.mkdir(exist_ok=True)

    reference = options.reference or REFERENCE.get(run.kind)
    profile = (run.folder / "profile.csv").is_file()  # such a scene needs neither probes nor snapshots
    jobs = {}
    if run.histories or not profile:
        jobs["histories"] = lambda: plot_all_histories(run)
    if run.kind == "rigid_cylinder":
        jobs["wall_pressure"] = lambda: plot_rigid_cylinder(run, reference)
    if run.kind == "tube":
        jobs["wall_motion"] = lambda: plot_tube(run, reference)
    if profile:
        jobs["profile"] = lambda: plot_profile(run)
    jobs["energy"] = lambda: plot_energy(run)
    for file, panels in (("bodies", BODY_PANELS), ("forces", FORCE_PANELS)):
        if (run.folder / f"{file}.csv").is_file():
            jobs[file] = lambda file=file, panels=panels: plot_parts(run, f"{file}.csv", panels)
    if (run.folder / "lines").is_dir():
        jobs["lines"] = lambda: plot_lines(run)
    if (run.setting("bodies") or not run.setting("solids")) and \
            not (profile and not (run.folder / "fields/particles.h5part").is_file()):
        jobs["mid_plane"] = lambda: plot_mid_plane(run, wanted)
    if run.setting("solids"):
        for quantity in SOLID_COLOURS:
            jobs[f"solids_{quantity}"] = lambda quantity=quantity: plot_solids(run, wanted, quantity)
    drawn = 0
    for name, draw in jobs.items():
        try:
            figure = draw()
        except (Missing, OSError) as error:
            print(f"plot.py: no {name}.png: {error}", file=sys.stderr)
            continue
        drawn += 1
        if figure is None:  # nothing in it
            continue
        if not figure.get_constrained_layout():
            figure.tight_layout()
        figure.savefig(pictures / f"{name}.png", dpi=options.dpi)
        plt.close(figure)
        print(pictures / f"{name}.png")
    return 0 if drawn == len(jobs) else 1


if __name__ == "__main__":
    sys.exit(main())
