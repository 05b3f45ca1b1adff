"""What `undex study` left: its runs, errors, observed orders and Pareto fronts."""
import csv
import json
import math
from pathlib import Path

from .errors import Missing

Row = dict[str, str]


def number(text: str | None) -> float:
    """The number in a cell; nan where there is none."""
    try:
        return float(text or "nan")
    except ValueError:
        return math.nan


class Study:
    """A study's folder: `rows` of all runs, `done` of those that have ended so; `errors`, `axes`, `resolution` (or None), `curves` (what
    runs of different resolution share), `problems`, and least-squares `orders` by (error, curve)."""

    def __init__(self, folder: str | Path):
        self.folder = Path(folder)
        for name in ("study.json", "study.csv"):
            if not (self.folder / name).is_file():
                raise Missing(f"{self.folder / name}: missing; give the folder that undex study wrote")
        try:
            said = json.loads((self.folder / "study.json").read_text(encoding="utf-8"))
            self.title, self.axes = str(said["title"]), [str(axis) for axis in said["axes"]]
            self.resolution, self.errors = said["resolution"] or None, [str(error) for error in said["errors"]]
        except (ValueError, KeyError, TypeError) as error:
            raise Missing(f"{self.folder / 'study.json'}: not a study's ({error!r}); run the study again") from error
        self.rows = _rows(self.folder / "study.csv", ("run", "curve", "problem", "status"))
        self.done = [row for row in self.rows if row["status"] == "done"]
        for row in self.done:
            _add_speeds(row)
        self.orders = {
            (row["error"], row["curve"]): number(row["order"]) for row in self._orders() if row["kind"] == "least squares"
        }
        self.curves = list(dict.fromkeys(row["curve"] for row in self.done))
        self.problems = list(dict.fromkeys(row["problem"] for row in self.done))

    def _orders(self) -> list[Row]:
        path = self.folder / "order.csv"
        return _rows(path, ("error", "curve", "kind", "order")) if path.is_file() else []

    def points(self, problem: str, x: str, y: str) -> dict[str, list[tuple[float, float, Row]]]:
        """By curve: x, magnitude of y, and the row, by resolution (or by x), where both are positive."""
        found = {}
        for curve in self.curves:
            rows = [
                row
                for row in self.done
                if row["curve"] == curve and row["problem"] == problem and number(row.get(x)) > 0 and abs(number(row.get(y))) > 0
            ]
            rows.sort(key=lambda row: number(row.get(self.resolution or x)))
            if rows:
                found[curve] = [(number(row[x]), abs(number(row[y])), row) for row in rows]
        return found

    def front(self, problem: str, error: str) -> list[tuple[float, float]]:
        """CPU time and error of the runs of a problem that none beats in both."""
        return sorted(
            (time, value)
            for points in self.points(problem, "cpu_time_s", f"error: {error}").values()
            for time, value, row in points
            if row.get(f"pareto: {error}") == "1"
        )

    def looks(self) -> dict[str, tuple[int, int, int]]:
        """By curve the numbers of its colour, line and marker: colours by the first axis that tells curves apart, lines by the
        second, so that related curves look related."""
        free = [axis for axis in self.axes if axis != self.resolution]
        values = {axis: list(dict.fromkeys(row.get(axis, "") for row in self.done)) for axis in free}
        telling = [axis for axis in free if len(values[axis]) > 1]
        found = {}
        for i, curve in enumerate(self.curves):
            row = next(row for row in self.done if row["curve"] == curve)
            place = [values[axis].index(row.get(axis, "")) for axis in telling]
            found[curve] = (place[0], place[1], i) if len(place) == 2 and place[0] < 8 and place[1] < 4 else (i % 8, i // 8, i)
        return found


def _rows(path: Path, needed: tuple[str, ...]) -> list[Row]:
    with open(path, newline="", encoding="utf-8", errors="replace") as file:
        rows = list(csv.DictReader(file))
    if rows and any(name not in rows[0] for name in needed):
        raise Missing(f"{path}: has no column {next(name for name in needed if name not in rows[0])}; run the study again")
    return rows


def _add_speeds(row: Row) -> None:
    """Million particle updates and neighbours a CPU second."""
    time = number(row.get("cpu_time_s"))
    for name, source in (("updates", "particle_updates"), ("interactions", "neighbour_interactions")):
        row[name] = str(1e-6 * number(row.get(source)) / time) if time > 0 else ""
