"""Curves over time that pictures and reports draw: which belong together, beside which references, in which units."""
import re
from dataclasses import dataclass, field

import numpy as np

from .run import Run, component_axis
from .tables import Columns
from .units import pretty_unit, scale_for


@dataclass
class Curve:
    """A curve, or points where `kind` is "points"; `run` is the number of the run it is of, None for references."""

    label: str
    x: np.ndarray
    y: np.ndarray
    run: int | None = 0
    kind: str = "line"


@dataclass
class Panel:
    """Curves with common axes, in SI units until `scaled`. `x_unit` is "s" for histories."""

    title: str
    quantity: str
    unit: str
    curves: list[Curve] = field(default_factory=list)
    x_label: str = "time"
    x_unit: str = "s"
    note: str = ""

    def scaled(self) -> "Panel":
        """The same in the units that suit the numbers."""
        x_factor, x_unit = scale_for(self.x_unit, largest(curve.x for curve in self.curves))
        y_factor, unit = scale_for(self.unit, largest(curve.y for curve in self.curves))
        curves = [Curve(c.label, c.x * x_factor, c.y * y_factor, c.run, c.kind) for c in self.curves]
        return Panel(self.title, self.quantity, unit, curves, self.x_label, x_unit, self.note)


def largest(arrays) -> float:
    """The largest finite magnitude in some arrays, 0 where there is none."""
    tops = [float(np.max(np.abs(values[np.isfinite(values)]), initial=0.0)) for values in arrays]
    return max(tops, default=0.0)


def thinned(curve: Curve, most: int = 1500) -> Curve:
    """A curve of at most so many points: of each of equal portions the least and the largest value stay."""
    n = len(curve.x)
    if n <= most:
        return curve
    edges = np.linspace(0, n, most // 2 + 1).astype(int)
    y = np.where(np.isfinite(curve.y), curve.y, 0.0)
    keep = {0, n - 1}
    for a, b in zip(edges, edges[1:]):
        if b > a:
            keep.update((a + int(y[a:b].argmin()), a + int(y[a:b].argmax())))
    index = np.array(sorted(keep))
    return Curve(curve.label, curve.x[index], curve.y[index], curve.run, curve.kind)


# ------------------------------------------------------------------------------------------------ probes


def probe_panels(runs: list[tuple[str, Run]]) -> list[Panel]:
    """A panel a quantity, a curve a probe, component and run; a panel a probe where there are more than ten curves."""
    found: dict[str, list[tuple[str, str, Curve]]] = {}
    units: dict[str, str] = {}
    for number, (label, run) in enumerate(runs):
        for probe, history in run.histories.items():
            for column, values in moving_columns(history):
                name, axis = component_axis(column)
                words = " ".join(part for part in (probe.replace("_", " "), axis, f"({label})" if len(runs) > 1 else "") if part)
                found.setdefault(name, []).append((probe, column, Curve(words, history["time"], values, number)))
                units[name] = history.units.get(column, "")
            flow = run.one_dimensional.get(probe)
            if flow is not None and "pressure" in flow:
                found.setdefault("pressure", []).append(
                    (
                        probe,
                        "pressure",
                        Curve(f"{probe.replace('_', ' ')}: one-dimensional flow", flow["time"], flow["pressure"], None),
                    )
                )
                units.setdefault("pressure", "Pa")
    panels = []
    for name, curves in found.items():
        words = name.replace("_", " ")
        if len({curve.label for _, _, curve in curves}) <= 10 * len(runs):
            panels.append(Panel(words.capitalize(), words, units[name], [curve for _, _, curve in curves]))
            continue
        for probe in dict.fromkeys(probe for probe, _, _ in curves):
            panels.append(
                Panel(
                    f"{words.capitalize()}, {probe.replace('_', ' ')}",
                    words,
                    units[name],
                    [curve for owner, _, curve in curves if owner == probe],
                )
            )
    return panels


def moving_columns(history: Columns) -> list[tuple[str, np.ndarray]]:
    """The columns without time, and without components that are nothing beside the others."""
    tops: dict[str, float] = {}
    for column, values in history.items():
        name = component_axis(column)[0]
        tops[name] = max(tops.get(name, 0.0), largest([values]))
    return [
        (column, values)
        for column, values in history.items()
        if column != "time" and (not component_axis(column)[1] or largest([values]) > 1e-6 * tops[component_axis(column)[0]])
    ]


# ------------------------------------------------------------------------------------------------ references


def reference_panels(runs: list[tuple[str, Run]]) -> list[Panel]:
    """The compared probe beside the references of the scene, for the comparisons that have histories."""
    kind = runs[0][1].setting("comparison.kind")
    if kind == "tube":
        return _tube_panels(runs)
    return _rigid_cylinder_panels(runs) if kind == "rigid_cylinder" else []


def outward(history: Columns, quantity: str) -> tuple[np.ndarray, str] | None:
    """The component of a vector that moves most, counted positive as it moves, and its axis."""
    columns = [key for key in history if component_axis(key)[0] == quantity]
    if not columns:
        return None
    best = max(columns, key=lambda key: largest([history[key]]))
    values = history[best]
    return values * (np.sign(values[np.nanargmax(np.abs(values))]) or 1.0), component_axis(best)[1]


def _tube_panels(runs: list[tuple[str, Run]]) -> list[Panel]:
    panels = [
        Panel("Outward displacement of the wall beside the references", "outward displacement", "m"),
        Panel("Outward velocity of the wall beside the references", "outward velocity", "m/s"),
    ]
    for number, (label, run) in enumerate(runs):
        probe = run.compared_probe("displacement")
        if probe is None:
            continue
        history = run.histories[probe]
        moved = outward(history, "displacement")
        if moved is None:
            continue
        name = label if len(runs) > 1 else "this run"
        panels[0].curves.append(Curve(name, history["time"], moved[0], number))
        column = f"velocity_{moved[1]}"
        if column in history:
            panels[1].curves.append(Curve(name, history["time"], history[column] * _sign_of(history, moved[1]), number))
    table = runs[0][1].reference
    patterns = (r"displacement_(\d+)us_m", r"wall_velocity_(\d+)us_m_s")
    for panel, pattern in zip(panels, patterns):
        for source in table.sources if table else []:
            points = sorted(
                (1e-6 * float(match[1]), row.sources[source].value)
                for metric, row in table.rows.items()
                if (match := re.fullmatch(pattern, metric)) and source in row.sources
            )
            if points:
                panel.curves.append(Curve(source, *np.array(points).T, None, "points"))
    return [panel for panel in panels if any(curve.run is not None for curve in panel.curves)]


def _sign_of(history: Columns, axis: str) -> float:
    values = history[f"displacement_{axis}"] if axis else history["displacement"]
    return float(np.sign(values[np.abs(values).argmax()]) or 1.0)


def _rigid_cylinder_panels(runs: list[tuple[str, Run]]) -> list[Panel]:
    panel = Panel("Pressure on the wall at mid-height beside the references", "pressure", "Pa")
    for number, (label, run) in enumerate(runs):
        probe = run.compared_probe("pressure")
        if probe is not None:
            history = run.histories[probe]
            panel.curves.append(Curve(label if len(runs) > 1 else "this run", history["time"], history["pressure"], number))
    if not panel.curves:
        return []
    exact = runs[0][1].reference_history
    if exact is not None:
        column = next(key for key in exact if key != "time")
        panel.curves.append(Curve("converged (mesh code)", exact["time"], exact[column], None))
    table = runs[0][1].reference
    times = {"first_peak_pa": "first_peak_time_s", "second_peak_5us_pa": "second_peak_time_s"}
    for source in table.sources if table else []:
        said = {metric: row.sources[source].value for metric, row in table.rows.items() if source in row.sources}
        points = [(said[time], said[peak]) for peak, time in times.items() if peak in said and time in said]
        points += [(said[time], 0.0) for time in ("cavitation_s", "collapse_s", "second_cavitation_s") if time in said]
        if points:
            panel.curves.append(Curve(f"{source}: peaks, cavitation", *np.array(sorted(points)).T, None, "points"))
    return [panel]


# ------------------------------------------------------------------------------------------------ ledgers and parts


def energy_panels(runs: list[tuple[str, Run]]) -> list[Panel]:
    """The energies that are not zero throughout, and the ledger's error."""
    energies = Panel("Energies", "energy", "J")
    errors = Panel("Error of the energy balance", "error", "-", note="of the scale in docs/reference/outputs.md")
    for number, (label, run) in enumerate(runs):
        if run.energy is None or "time" not in run.energy:
            continue
        after = f" ({label})" if len(runs) > 1 else ""
        time = run.energy["time"]
        top = largest(values for name, values in run.energy.items() if name not in ("time", "error"))
        for name, values in run.energy.items():
            if name == "error":
                errors.curves.append(Curve("error" + after, time, values, number))
            elif name != "time" and largest([values]) > 1e-9 * top:
                energies.curves.append(Curve(name.replace("_", " ") + after, time, values, number))
    return [panel for panel in (energies, errors) if panel.curves]


_PARTS = (
    ("radius", "m", ("radius",)),
    ("volume", "m3", ("volume", "cavitated_volume", "void_volume")),
    ("mean pressure", "Pa", ("pressure",)),
    ("energy", "J", ("kinetic", "internal")),
    ("force", "N", ("force",)),
    ("impulse", "N s", ("impulse",)),
)


def part_panels(runs: list[tuple[str, Run]]) -> list[Panel]:
    """What bodies.csv and forces.csv say, a panel a kind of quantity."""
    panels = {
        name: Panel(("Bodies: " if unit[0] != "N" else "On structures and walls: ") + name, name, unit)
        for name, unit, _ in _PARTS
    }
    for number, (label, run) in enumerate(runs):
        liquids = {body.get("name") for body in run.tables("bodies") if body.get("variable_h") is False}
        for table in (run.bodies, run.forces):
            for column, values in (table or {}).items():
                owner, _, word = column.rpartition(".")
                word, axis = component_axis(word)
                if word == "radius" and owner in liquids:
                    continue  # a sphere as large as all the water says nothing
                for name, _, words in _PARTS:
                    if owner and word in words and largest([values]) > 0:
                        text = " ".join(
                            part
                            for part in (
                                owner,
                                word.replace("_", " ") if len(words) > 1 else "",
                                axis,
                                f"({label})" if len(runs) > 1 else "",
                            )
                            if part
                        )
                        panels[name].curves.append(Curve(text, table["time"], values, number))
    return [panel for panel in panels.values() if panel.curves]


def step_panel(runs: list[tuple[str, Run]]) -> Panel | None:
    """The step over time, where energy.csv has a row a step."""
    panel = Panel("Step over time", "step", "s")
    for number, (label, run) in enumerate(runs):
        if run.energy is None or run.setting("output.history_interval", 0) or len(run.energy.get("time", [])) < 3:
            continue
        time = run.energy["time"]
        panel.curves.append(Curve(f"step{f' ({label})' if len(runs) > 1 else ''}", time[1:], np.diff(time), number))
    return panel if panel.curves else None


# ------------------------------------------------------------------------------------------------ over a coordinate


def line_panels(run: Run, number: int = 0) -> list[Panel]:
    """Profiles along the scene's lines, ten times at most."""
    panels = []
    for line, columns in run.lines.items():
        times = np.unique(columns["time"])
        for name in columns:
            if name in ("time", "distance", *"xyz"):
                continue
            panel = Panel(
                f"{line.replace('_', ' ')}: {name.replace('_', ' ')}",
                name.replace("_", " "),
                columns.units.get(name, ""),
                [],
                "distance",
                "m",
            )
            for time in evenly(times, 10):
                now = columns["time"] == time
                panel.curves.append(Curve(_when(time), columns["distance"][now], columns[name][now], number))
            panels.append(panel)
    return panels


def profile_panels(run: Run) -> list[Panel]:
    """The particles at the end beside the exact solution."""
    found = run.profile()
    if found is None:
        return []
    computed, exact = found
    label = "x" if run.setting("comparison.solution") == "riemann" else "radius"
    panels = []
    for name, unit in (("density", "kg/m3"), ("velocity", "m/s"), ("pressure", "Pa")):
        if name not in computed or "exact_" + name not in exact:
            continue
        panel = Panel(f"{name.capitalize()} beside the exact solution", name, unit, [], label, "m")
        for body in np.unique(computed.get("body", np.zeros(1))):
            mine = computed["body"] == body if "body" in computed else slice(None)
            panel.curves.append(Curve(run.body_name(int(body)), computed["coordinate"][mine], computed[name][mine], 0, "points"))
        panel.curves.append(Curve("exact", exact["coordinate"], exact["exact_" + name], None))
        panels.append(panel)
    return panels


def coordinate_panels(run: Run, count: int = 12) -> list[Panel]:
    """Scenes with one coordinate: fields along it at some of the snapshots' times."""
    label, panels = ("radius" if run.dimension == "spherical" else "x"), {}
    with run.particles() as snapshots:
        for index in evenly(np.arange(len(snapshots)), count):
            snapshot = snapshots.read(int(index))
            order = np.argsort(snapshot["position"][:, 0])
            x = snapshot["position"][order, 0]
            for field_name, name, unit in (
                ("pressure", "pressure", "Pa"),
                ("velocity_0", "velocity", "m/s"),
                ("density", "density", "kg/m3"),
                ("void_fraction", "void fraction", "-"),
            ):
                if field_name in snapshot:
                    panel = panels.setdefault(name, Panel(f"{name.capitalize()} along {label}", name, unit, [], label, "m"))
                    panel.curves.append(
                        Curve(_when(snapshots.times[int(index)]), x, snapshot[field_name][order].astype(float), 0)
                    )
    return [panel for panel in panels.values() if largest(curve.y for curve in panel.curves) > 0]


def evenly(values: np.ndarray, count: int) -> np.ndarray:
    """At most so many of some values, evenly spread, with the first and the last."""
    return values[np.unique(np.linspace(0, len(values) - 1, min(count, len(values))).round().astype(int))]


def _when(time: float) -> str:
    factor, unit = scale_for("s", time) if time > 0 else (1e6, "µs")
    return f"{time * factor:.4g} {unit}"


def axis_label(name: str, unit: str) -> str:
    unit = pretty_unit(unit)
    return f"{name} [{unit}]" if unit else name
