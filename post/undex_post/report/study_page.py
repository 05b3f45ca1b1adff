"""The report of a study: error against cost and against resolution, and the table of its runs."""
import math
import re
from pathlib import Path
from urllib.parse import quote

from ..study import Row, Study, number as value_of
from ..units import number
from .log_chart import COLOURS, DASHES, Line, LogChart, Point
from .page import Raw, join, page, table, tag


def anchor(run: str) -> str:
    """The identifier of a run's row."""
    return "run-" + re.sub(r"[^A-Za-z0-9_.-]", "-", run)


class StudyReport:
    """Builds the page of a study, which lies in `beside`: links to the runs' own reports are relative to it."""

    def __init__(self, study: Study, beside: Path):
        self._study, self._beside = study, beside.resolve()
        self._looks = study.looks()

    def text(self) -> str:
        """The HTML file."""
        study = self._study
        sections = [
            ("cost", "Error against cost", self._of_errors(self._cost)),
            ("order", "Error against resolution", join([self._of_errors(self._order), self._orders()])),
            ("runs", "The runs", self._runs()),
        ]
        if not study.resolution:
            del sections[1]
        return page(study.title, "undex report · study", self._head(), sections, {"charts": [], "movies": []})

    def _head(self) -> Raw:
        study = self._study
        counts: dict[str, int] = {}
        for row in study.rows:
            counts[row["status"]] = counts.get(row["status"], 0) + 1
        said = ", ".join(f"{count} {status}" for status, count in counts.items()) or "none"
        programs = sorted({row["program"] for row in study.rows if row.get("program")})
        return join(
            [
                tag("p", f"{len(study.rows)} runs ({said}) over {', '.join(study.axes) or 'no axis'}.", class_="lead"),
                tag("p", "Computed by " + "; ".join(programs) + f", in {study.folder.resolve()}.", class_="muted")
                if programs
                else Raw(""),
            ]
        )

    def _of_errors(self, chart) -> Raw:
        """A chart for each problem and error, with one legend."""
        study, parts = self._study, []
        if not study.done:
            return tag("p", "No run is done yet.")
        if not study.errors:
            return tag("p", "The study names no errors: add them to `errors` in its file.")
        for problem in study.problems:
            if problem:
                parts.append(tag("h3", problem))
            charts = []
            for error in study.errors:
                svg = chart(problem, error)
                charts.append(
                    tag(
                        "figure",
                        tag("h3", error),
                        Raw(svg) if svg else tag("p", "No run has a value above zero.", class_="muted"),
                    )
                )
            parts.append(tag("div", *charts, class_="charts"))
        return join([self._legend(), *parts])

    def _legend(self) -> Raw:
        items = []
        for curve in self._study.curves:
            colour, dash, _ = self._looks[curve]
            stroke = f'<path d="M0 6 H28" stroke="{COLOURS[colour % len(COLOURS)]}" stroke-width="2.4" stroke-dasharray="{DASHES[dash % len(DASHES)]}"/>'
            items.append(
                tag("span", Raw(f'<svg width="28" height="12" aria-hidden="true">{stroke}</svg> '), curve or self._study.title)
            )
        return tag("p", *items, class_="legend")

    def _line(self, curve: str, points: list[tuple[float, float, Row]]) -> Line:
        colour, dash, _ = self._looks[curve]
        return Line(
            curve,
            [Point(x, y, f"{row['run']}: {number(x, 3)}, {number(y, 3)}", self._link(row)) for x, y, row in points],
            colour,
            dash,
        )

    def _cost(self, problem: str, error: str) -> str:
        lines = [
            self._line(curve, points) for curve, points in self._study.points(problem, "cpu_time_s", f"error: {error}").items()
        ]
        return LogChart("CPU time [s]", error, lines, self._study.front(problem, error)).svg()

    def _order(self, problem: str, error: str) -> str:
        resolution = self._study.resolution
        lines = [
            self._line(curve, points) for curve, points in self._study.points(problem, resolution, f"error: {error}").items()
        ]
        return LogChart(f"{resolution} [m]" if resolution == "spacing" else resolution, error, lines, slopes=(1, 2)).svg()

    def _link(self, row: Row) -> str:
        """The run's own report where there is one, else its row."""
        return self._report(row) or "#" + anchor(row["run"])

    def _report(self, row: Row) -> str | None:
        path = (self._study.folder / "runs" / Path(row["run"]).name / "report.html").resolve()
        if not path.is_file() or not path.is_relative_to(self._beside):
            return None
        return quote(str(path.relative_to(self._beside)))

    def _runs(self) -> Raw:
        study = self._study
        head = ["run", *study.axes, "status", *study.errors, "CPU time [s]", "particles"]
        rows = []
        for row in study.rows:
            name = tag("a", row["run"], href=link) if (link := self._report(row)) else row["run"]
            errors = [self._error(row, error) for error in study.errors]
            said = row["status"] + (f": {row['message']}" if row.get("message") else "")
            rows.append(
                [
                    name,
                    *(row.get(axis, "") for axis in study.axes),
                    said,
                    *errors,
                    _shown(row.get("cpu_time_s")),
                    _shown(row.get("particles")),
                ]
            )
        first = 2 + len(study.axes)
        hint = (
            "Bold: no run of the same problem is as good in both CPU time and this error, and better in one. A run's own report is linked where it "
            "exists (undex report of its folder, then this report again)."
        )
        return join(
            [
                tag("p", hint, class_="muted"),
                table(head, rows, set(range(first, len(head))), [anchor(row["run"]) for row in study.rows]),
            ]
        )

    @staticmethod
    def _error(row: Row, error: str) -> Raw | str:
        text = _shown(row.get(f"error: {error}"))
        return tag("b", text) if row.get(f"pareto: {error}") == "1" else text

    def _orders(self) -> Raw:
        """The observed orders, a row a curve."""
        study = self._study
        shown = lambda order: "–" if math.isnan(order) else f"{order:.2f}"
        rows = [
            [curve or study.title, *(shown(study.orders.get((error, curve), math.nan)) for error in study.errors)]
            for curve in study.curves
        ]
        return join(
            [
                tag("h3", "Observed orders, by least squares"),
                table(["", *study.errors], rows, set(range(1, 1 + len(study.errors)))),
            ]
        )


def _shown(text: str | None) -> str:
    value = value_of(text)
    return "–" if math.isnan(value) else number(int(value) if value == int(value) and abs(value) < 1e15 else value, 3)


def write_study_report(folder: Path, output: Path) -> None:
    """Writes the report of a study into a file."""
    output.write_text(StudyReport(Study(folder), output.resolve().parent).text(), encoding="utf-8")
