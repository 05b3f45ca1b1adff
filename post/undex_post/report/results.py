"""Metrics of runs beside their references, as rows of a table."""
import math
import re
from dataclasses import dataclass

from ..run import Run
from ..tables import ReferenceTable
from ..units import label_of_metric, number, percent, pretty_unit, scale_for, unit_of_metric

# Metrics that are themselves what others are compared with: the word in their names, and who says so.
_OWN_REFERENCES = {
    "1d": "one-dimensional solution",
    "exact": "exact solution",
    "similitude": "similitude law",
    "acoustic": "acoustic theory",
}


@dataclass
class Cell:
    """What a source says, and how far each run is from it."""

    text: str
    differences: list[str]


@dataclass
class Row:
    """A metric: its name with the unit, each run's value, and cells by source."""

    label: str
    values: list[str]
    sources: dict[str, Cell]


def result_rows(runs: list[Run]) -> tuple[list[Row], list[str]]:
    """The rows of the table, and the names of the sources in their order."""
    metrics = [run.summary.get("metrics") or {} for run in runs]
    table = next((run.reference for run in runs if run.reference is not None), None)
    names = list(dict.fromkeys([*(table.rows if table else []), *(name for each in metrics for name in each)]))
    partners = {name: _partner(name, names) for name in names}
    rows, used = [], []
    for name in names:
        values = [_finite(each.get(name)) for each in metrics]
        if all(value is None for value in values) or partners[name]:
            continue
        said = _said_of(name, table, metrics, partners)
        rows.append(_row(name, values, said, table))
        used += [source for source in said if source not in used]
    ordered = [source for source in (table.sources if table else []) if source in used]
    return rows, ordered + [source for source in used if source not in ordered]


def _finite(value) -> float | None:
    return float(value) if isinstance(value, (int, float)) and math.isfinite(value) else None


def _partner(name: str, names: list[str]) -> str | None:
    """The metric that this one is the reference of, or None."""
    for word in _OWN_REFERENCES:
        base = re.sub(rf"(^|_){word}(?=_|$)", "", name, count=1).lstrip("_")
        if base != name and base in names:
            return base
    return None


def _said_of(
    name: str, table: ReferenceTable | None, metrics: list[dict], partners: dict
) -> dict[str, tuple[list[float | None], float]]:
    """By source: the value that each run is compared with, and its uncertainty."""
    said: dict[str, tuple[list[float | None], float]] = {}
    if table and name in table.rows:
        for source, reference in table.rows[name].sources.items():
            said[source] = ([reference.value] * len(metrics), reference.spread)
    for other, base in partners.items():
        if base == name:
            word = next(word for word in _OWN_REFERENCES if re.search(rf"(^|_){word}(_|$)", other))
            said[_OWN_REFERENCES[word]] = ([_finite(each.get(other)) for each in metrics], 0.0)
    return said


def _row(name: str, values: list[float | None], said: dict, table: ReferenceTable | None) -> Row:
    listed = table.rows.get(name) if table else None
    if listed:
        factor, unit, label = (
            listed.scale,
            listed.unit.replace("us", "µs") if listed.unit == "us" else listed.unit,
            listed.label.replace(" us", " µs"),
        )
    else:
        unit = unit_of_metric(name)
        factor, unit = scale_for(unit, max((abs(value) for value in values if value is not None), default=0.0))
        label = label_of_metric(name)
    is_time = name.endswith("_s") and not name.endswith(("_m_s", "_pa_s"))
    cells = {}
    for source, (references, spread) in said.items():
        differences = []
        for value, reference in zip(values, references):
            if value is None or reference is None:
                differences.append("–")
            elif is_time:
                differences.append(f"{factor * (value - reference):+.3g} {unit}")
            else:
                differences.append(percent(value / reference - 1) if reference else "–")
        text = number(factor * references[0]) if references[0] is not None else "–"
        cells[source] = Cell(text + (f" ± {number(factor * spread, 2)}" if spread else ""), differences)
    unit = pretty_unit(unit)
    return Row(
        f"{label} [{unit}]" if unit else label, [number(factor * value) if value is not None else "–" for value in values], cells
    )


def missing(run: Run) -> list[tuple[str, str]]:
    """Metrics without a value, and why: metrics of one reason together."""
    reasons: dict[str, list[str]] = {}
    said = run.summary.get("missing") or {}
    for name, reason in said.items() if isinstance(said, dict) else []:
        reasons.setdefault(str(reason), []).append(label_of_metric(name))
    return [(", ".join(names), reason) for reason, names in reasons.items()]
