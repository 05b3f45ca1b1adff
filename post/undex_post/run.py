"""What a run left in its folder, as Python and NumPy values."""
import json
import re
import tomllib
from functools import cached_property
from pathlib import Path
from typing import Any

from .errors import Missing
from .snapshots import MeshSnapshots, ParticleSnapshots, structure_indices
from .tables import Columns, ReferenceTable, read_columns, read_reference_table

AXES = "xyz"
_NUMBERS = (
    "time_s",
    "fluid_substeps",
    "steps",
    "wall_time_s",
    "cpu_time_s",
    "threads",
    "particles",
    "wall_particles",
    "cells",
    "particle_updates",
    "neighbour_interactions",
    "peak_memory_bytes",
    "solver_memory_bytes",
    "mass_error",
    "momentum_error",
    "angular_momentum_error",
    "energy_error",
    "interface_impulse_error",
    "interface_energy_error",
)
_KINDS = {
    **{name: (int, float) for name in _NUMBERS},
    **{name: (str,) for name in ("scene", "status", "message", "program")},
    **{name: (list,) for name in ("warnings", "bubbles", "structures", "obstacles", "trust")},
    **{name: (dict,) for name in ("largest", "clamps", "step_limits", "passes", "metrics", "missing")},
}


class Run:
    """A run's folder. What is not there is empty or None; `notes` says in words what could not be read.

    `summary`: summary.json; `scene`: resolved.toml; `histories`: {probe: columns}, without the one-dimensional flows, which are in
    `one_dimensional`; `energy`, `bodies`, `forces`: columns or None; `lines`: {line: columns}.
    """

    def __init__(self, folder: str | Path):
        self.folder = Path(folder)
        self.notes: list[str] = []
        if not self.folder.is_dir():
            raise Missing(f"{folder}: no such folder; give the output folder of a run (undex run ... -o DIR)")
        self.summary = self._read_summary(self.folder / "summary.json")
        self.scene, self.scene_text = self._read_scene()
        every = self._tables("history")
        self.one_dimensional = {
            name.removesuffix("_1d"): columns
            for name, columns in every.items()
            if name.endswith("_1d") and name.removesuffix("_1d") in every
        }
        self.histories = {
            name: columns for name, columns in every.items() if not (name.endswith("_1d") and name.removesuffix("_1d") in every)
        }
        self.lines = self._tables("lines")
        self.energy = self._table("energy.csv")
        self.bodies = self._table("bodies.csv")
        self.forces = self._table("forces.csv")
        if not (self.summary or self.scene or self.histories or self.energy):
            raise Missing(
                f"{folder}: no summary.json, resolved.toml, energy.csv or history/*.csv here; " "give the output folder of a run"
            )
        if not self.summary:
            self.notes.append(
                "The run has no summary.json: it was killed or is still going. Results, cost and warnings are not known."
            )

    # ------------------------------------------------------------------------------------------------ what it was

    @property
    def name(self) -> str:
        return str(self.summary.get("scene") or self.scene.get("name") or self.folder.resolve().name)

    @property
    def title(self) -> str:
        return str(self.scene.get("title") or self.name)

    @property
    def dimension(self) -> int | str:
        """1, 2, 3, "axisymmetric", "spherical" or "plane"."""
        return self.scene.get("dimension", 3)

    @property
    def is_on_a_line(self) -> bool:
        """Is there one coordinate only?"""
        return self.dimension in (1, "spherical", "plane")

    def setting(self, key: str, default: Any = None) -> Any:
        """A value of resolved.toml by its dotted key."""
        value = self.scene
        for part in key.split("."):
            if not isinstance(value, dict) or part not in value:
                return default
            value = value[part]
        return value

    def tables(self, key: str) -> list[dict]:
        """A list of tables of resolved.toml, such as its bodies; `structures` has the one of `[structure]` too."""
        found = self.scene.get(key, [])
        found = [table for table in found if isinstance(table, dict)] if isinstance(found, list) else []
        if key == "structures" and isinstance(self.scene.get("structure"), dict):
            found = [self.scene["structure"], *found]
        return found

    def body_name(self, number: int) -> str:
        bodies = self.tables("bodies")
        return str(bodies[number].get("name", f"body {number}")) if number < len(bodies) else f"body {number}"

    def label(self) -> str:
        """Name, spacing and number of particles, for the head of a picture."""
        parts = [self.name]
        spacing = self.setting("resolution.spacing")
        if spacing:
            parts.append(f"spacing {1e3 * spacing:g} mm")
        if self.summary.get("particles"):
            parts.append(f"{self.summary['particles']:,} particles")
        return ", ".join(parts)

    # ------------------------------------------------------------------------------------------------ comparison

    @cached_property
    def reference(self) -> ReferenceTable | None:
        """The table of metrics that the scene compares with, where its file is still there."""
        path = self.setting("comparison.reference")
        if not isinstance(path, str) or not path:
            return None
        try:
            return read_reference_table(Path(path))
        except Missing as error:
            self.notes.append(f"The reference table is not shown: {error}.")
            return None

    @cached_property
    def reference_history(self) -> Columns | None:
        """The reference pressure history of a rigid cylinder, which lies beside its table."""
        path = self.setting("comparison.reference")
        if self.setting("comparison.kind") != "rigid_cylinder" or not isinstance(path, str):
            return None
        beside = Path(path).parent / "midline_wall_pressure.csv"
        try:
            return read_columns(beside, of_a_run=False) if beside.is_file() else None
        except Missing:
            return None

    def compared_probe(self, column: str) -> str | None:
        """The probe that the comparison is about, else the first one that has a column of that beginning."""
        named = self.setting("comparison.probe")
        for name in ([named] if named in self.histories else []) + list(self.histories):
            if any(key.startswith(column) for key in self.histories[name]):
                return name
        return None

    def profile(self) -> tuple[Columns, Columns] | None:
        """Particles beside an exact solution, and the solution, where the run has them."""
        paths = [self.folder / "profile.csv", self.folder / "profile_exact.csv"]
        return (read_columns(paths[0]), read_columns(paths[1])) if all(path.is_file() for path in paths) else None

    # ------------------------------------------------------------------------------------------------ fields

    def particles(self) -> ParticleSnapshots:
        """Snapshots of the fluid's particles."""
        return ParticleSnapshots(self.folder / "fields" / "particles.h5part")

    def solids(self) -> ParticleSnapshots:
        """Snapshots of solids in particles."""
        return ParticleSnapshots(self.folder / "fields" / "solids.h5part")

    def structures(self) -> list[MeshSnapshots]:
        return [MeshSnapshots(index) for index in structure_indices(self.folder)]

    def obstacles(self) -> MeshSnapshots | None:
        index = self.folder / "fields" / "obstacles.hdf.series"
        return MeshSnapshots(index) if index.is_file() else None

    # ------------------------------------------------------------------------------------------------ reading

    def _read_summary(self, path: Path) -> dict:
        """The record, without what is not of the kind that it should be."""
        if not path.is_file():
            return {}
        try:
            found = json.loads(path.read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            self.notes.append(f"{path.name} cannot be read: {error}.")
            return {}
        if not isinstance(found, dict):
            self.notes.append(f"{path.name} is not a run's record.")
            return {}
        sound = {
            name: value
            for name, value in found.items()
            if value is not None and not isinstance(value, bool) and isinstance(value, _KINDS.get(name, object))
        }
        wrong = [name for name, value in found.items() if name not in sound and value is not None]
        if wrong:
            self.notes.append(f"Left out of {path.name}, as not of the kind that they should be: {', '.join(wrong)}.")
        return sound

    def _read_scene(self) -> tuple[dict, str]:
        path = self.folder / "resolved.toml"
        if not path.is_file():
            self.notes.append("resolved.toml is missing: the scene is not known.")
            return {}, ""
        text = path.read_text(encoding="utf-8", errors="replace")
        try:
            return tomllib.loads(text), text
        except tomllib.TOMLDecodeError as error:
            self.notes.append(f"resolved.toml cannot be read: {error}.")
            return {}, text

    def _table(self, name: str) -> Columns | None:
        path = self.folder / name
        if not path.is_file():
            return None
        try:
            return read_columns(path)
        except Missing as error:
            self.notes.append(f"Left out: {error}.")
            return None

    def _tables(self, folder: str) -> dict[str, Columns]:
        found = {path.stem: self._table(f"{folder}/{path.name}") for path in sorted((self.folder / folder).glob("*.csv"))}
        return {name: columns for name, columns in found.items() if columns is not None}


def component_axis(column: str) -> tuple[str, str]:
    """A column's quantity and the axis of its component: ("velocity", "x"), or ("pressure", "")."""
    match = re.fullmatch(r"(.*)_([xyz])", column)
    return (match[1], match[2]) if match else (column, "")
