"""What `undex compare` wrote: the runs, the table's rows and the compared curves."""
import csv
from pathlib import Path

import numpy as np

from .errors import Missing

REFERENCE = "reference"
Key = tuple[str, str, str, str]  # probe, kind, quantity, unit


class Comparison:
    """Runs in their order, sources of a reference table, rows of comparison.csv, and `curves`: {key: {run or source: (time, value)}}."""

    def __init__(self, folder: str | Path):
        self.folder = Path(folder)
        for name in ("comparison.csv", "curves.csv"):
            if not (self.folder / name).is_file():
                raise Missing(f"{self.folder / name}: missing; give the folder that undex compare RUN RUN... -o DIR wrote to")
        try:
            self._read()
        except (ValueError, StopIteration) as error:
            raise Missing(f"{self.folder}: not what undex compare wrote ({error!r}); compare the runs again") from error

    def _read(self) -> None:
        with open(self.folder / "comparison.csv", newline="", encoding="utf-8") as file:
            header, *self.rows = list(csv.reader(file))
        self.runs = header[3 : header.index(REFERENCE, 3)]
        samples: dict[Key, dict[str, list[tuple[float, float]]]] = {}
        with open(self.folder / "curves.csv", newline="", encoding="utf-8") as file:
            next(file)
            for probe, kind, quantity, unit, run, time, value in csv.reader(file):
                samples.setdefault((probe, kind, quantity, unit), {}).setdefault(run, []).append((float(time), float(value)))
        # What is neither a run nor the reference history is a source of a table.
        self.sources = list(
            dict.fromkeys(run for runs in samples.values() for run in runs if run not in self.runs and run != REFERENCE)
        )
        self.curves = {key: {run: np.array(points).T for run, points in runs.items()} for key, runs in samples.items()}

    def select(self, wanted) -> dict[Key, dict[str, np.ndarray]]:
        """The curves of the quantities for which wanted(kind, quantity) holds, in the order of the file."""
        return {key: runs for key, runs in self.curves.items() if wanted(key[1], key[2])}
