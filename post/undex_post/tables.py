"""CSV files of a run: histories as columns, and reference tables of metrics."""
import csv
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .errors import Missing


class Columns(dict):
    """Columns of a CSV file by name without unit, {"time": array, ...}; `units` has the unit of each ("s", "-", or "")."""

    def __init__(self, columns: dict[str, np.ndarray], units: dict[str, str]):
        super().__init__(columns)
        self.units = units


def read_columns(path: Path, of_a_run: bool = True) -> Columns:
    """Reads a CSV file whose first row is `name [unit],...`. Lines that begin with # are comments. A run that was killed may have
    left part of a row: what comes after the last end of line is left out."""
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise Missing(f"{path}: {error.strerror or error}") from error
    lines = text.splitlines()
    if of_a_run and lines and not text.endswith("\n"):
        lines.pop()
    rows = [row for row in csv.reader(line for line in lines if not line.startswith("#")) if row]
    if len(rows) < 2:
        raise Missing(f"{path}: no rows in it")
    names, units = [], {}
    for cell in rows[0]:
        match = re.fullmatch(r"\s*(.*?)\s*(?:\[(.*)\])?\s*", cell)
        names.append(match[1])
        units[match[1]] = match[2] or ""
    try:
        values = np.array(rows[1:], dtype=float)
    except ValueError as error:
        raise Missing(f"{path}: not a table of numbers: {error}") from error
    if values.shape[1] != len(names):
        raise Missing(f"{path}: {values.shape[1]} columns below a header of {len(names)}")
    return Columns({name: values[:, i] for i, name in enumerate(names)}, units)


@dataclass
class Reference:
    """What one source says of a metric, in SI units."""

    value: float
    spread: float = 0.0


@dataclass
class ReferenceRow:
    """A metric of a reference table: how it is written, value = metric * scale in `unit`, and what each source says."""

    label: str
    unit: str
    scale: float
    sources: dict[str, Reference]


@dataclass
class ReferenceTable:
    """A table of metrics as in cases/*/reference (the format stands in judge/comparison_table.hpp)."""

    path: Path
    sources: list[str]
    rows: dict[str, ReferenceRow]
    notes: str


def read_reference_table(path: Path) -> ReferenceTable:
    """Reads a reference table; its comment lines are its notes on the sources."""
    try:
        lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError as error:
        raise Missing(f"{path}: {error.strerror or error}") from error
    comments = [line[1:] for line in lines if line.startswith("#")]
    cells = [row for row in csv.reader(line for line in lines if not line.startswith("#")) if row]
    if not cells or cells[0][:4] != ["metric", "label", "unit", "scale"]:
        raise Missing(f"{path}: not a table of metrics; its header must begin with metric,label,unit,scale")
    sources = cells[0][4:]
    rows = {}
    for row in cells[1:]:
        try:
            scale = float(row[3])
            said = {source: _reference(cell, scale) for source, cell in zip(sources, row[4:]) if cell.strip()}
        except (ValueError, IndexError, ZeroDivisionError) as error:
            raise Missing(f"{path}: row '{row[0]}': {error}") from error
        rows[row[0]] = ReferenceRow(row[1], row[2], scale, said)
    return ReferenceTable(path, sources, rows, "\n".join(comments))


def _reference(cell: str, scale: float) -> Reference:
    value, _, spread = cell.partition("+-")
    return Reference(float(value) / scale, float(spread) / abs(scale) if spread else 0.0)
