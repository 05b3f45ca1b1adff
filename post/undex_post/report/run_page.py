"""The report of one run, or of several beside each other."""
import math
from pathlib import Path

from .. import histories
from ..errors import Missing
from ..mid_plane import MidPlane
from ..run import Run
from ..units import number, quantity, scale_for, shorter
from . import description, run_parts
from .chart_data import ChartData
from .movie import FLUID, SOLID, Movie
from .page import Raw, chips, colour_tables, html, join, notes, page, table, tag

DAMAGED = "This part cannot be made of what the run has left"
FEW_FRAMES = 25  # fewer pictures than this make no smooth animation


class RunReport:
    """Builds the page of some runs; `program` is the undex that is asked for the grades of materials, where there is one."""

    def __init__(self, runs: list[Run], program: str | None = None):
        self.runs = runs
        self.labels = labels_of(runs)
        self._program = program
        self._charts = ChartData()
        self._movies: list[dict] = []

    @property
    def _labelled(self) -> list[tuple[str, Run]]:
        return list(zip(self.labels, self.runs))

    @property
    def _several(self) -> bool:
        return len(self.runs) > 1

    def text(self) -> str:
        """The HTML file."""
        first = self.runs[0]
        parts = [
            ("computed", "What was computed", self._computed),
            ("resolution", "Resolution", self._resolution),
            ("trust", "Can it be trusted?", self._trust),
            ("results", "Results beside references", self._results),
            ("mid-plane", "Profiles" if all(run.is_on_a_line for run in self.runs) else "The mid-plane", self._mid_planes),
            ("histories", "Histories", self._histories),
            ("energy", "Energy and conservation", self._energy),
            ("steps", "Steps and cost", self._steps),
            ("warnings", "Warnings and limits", self._warnings),
            ("repeat", "Versions, and how to repeat it", self._repeat),
        ]
        sections = [(name, heading, _made(build)) for name, heading, build in parts]
        end = max(
            (histories.largest([run.energy["time"]]) for run in self.runs if run.energy and "time" in run.energy), default=0.0
        )
        factor, unit = scale_for("s", end or float(first.setting("end_time", 1e-6)))
        data = {
            "charts": self._charts.charts,
            "movies": self._movies,
            "colours": colour_tables(),
            "clock": {"factor": factor, "unit": unit},
        }
        title = (
            first.title
            if len({run.title for run in self.runs}) == 1
            else " / ".join(shorter(run.title, 60) for run in self.runs[:3])
        )
        return page(
            title, f"undex report · {len(self.runs)} runs" if self._several else "undex report", self._head(), sections, data
        )

    # ------------------------------------------------------------------------------------------------ head

    def _head(self) -> Raw:
        if not self._several:
            run = self.runs[0]
            message = run.summary.get("message")
            said = [tag("p", description.lead(run), class_="lead")]
            if message and run.summary.get("status") != "done":
                said.append(tag("p", f"It ended with the message: {message}", class_="bad"))
            return join([*said, *(tag("p", note, class_="warn") for note in run.notes), chips(description.chips(run))])
        rows = []
        for label, run in self._labelled:
            words, colour = description.status(run)
            cost = run.summary.get("cpu_time_s")
            rows.append(
                [
                    label,
                    tag("span", words, class_=colour),
                    quantity(run.setting("resolution.spacing"), "m"),
                    number(run.summary.get("particles")),
                    quantity(run.summary.get("time_s"), "s"),
                    description.duration(cost) if cost else "–",
                ]
            )
        warned = [tag("p", f"{label}: {note}", class_="warn") for label, run in self._labelled for note in run.notes]
        return join([table(["run", "status", "spacing", "particles", "time reached", "CPU time"], rows, {2, 3, 4, 5}), *warned])

    # ------------------------------------------------------------------------------------------------ the scene

    def _each(self, content, first_open: bool = True) -> Raw:
        """What a function says of each run; of several runs under their names, folded."""
        if not self._several:
            return content(self.runs[0])
        return join(
            tag("details", tag("summary", label), content(run), open="" if first_open and i == 0 else None)
            for i, (label, run) in enumerate(self._labelled)
        )

    def _computed(self) -> Raw:
        grades = run_parts.grades_of(self._program)
        return self._each(lambda run: run_parts.computed(run, grades))

    def _resolution(self) -> Raw:
        return run_parts.resolution(self.runs, self.labels)

    def _trust(self) -> Raw:
        return self._each(run_parts.trust)

    # ------------------------------------------------------------------------------------------------ results

    def _results(self) -> Raw:
        parts = [run_parts.results(self.runs, self.labels)]
        parts += [self._chart(panel) for panel in histories.reference_panels(self._labelled)]
        if not self._several:
            parts += [self._chart(panel) for panel in self._guarded(histories.profile_panels, self.runs[0])]
        parts += [run_parts.largest_values(run, self._named(label)) for label, run in self._labelled]
        return join(parts)

    # ------------------------------------------------------------------------------------------------ fields

    def _mid_planes(self) -> Raw:
        return join(self._mid_plane(label, run) for label, run in self._labelled)

    def _mid_plane(self, label: str, run: Run) -> Raw:
        head = [tag("h3", label)] if self._several else []
        try:
            if run.is_on_a_line:
                panels = histories.coordinate_panels(run)
                return join(
                    [
                        *head,
                        tag("p", "The scene has one coordinate: profiles at some of the snapshots' times."),
                        *map(self._chart, panels),
                    ]
                )
            with MidPlane(run, 320 if len(self.runs) < 3 else 200, FLUID, SOLID) as plane:
                movie = Movie(plane, 150 if len(self.runs) == 1 else 60)
                said = [
                    f"The section is {plane.section.words}. Fields are the particles' own kernel sums, body by body; white lines are the "
                    "surfaces between bodies. Where there is no material the background shows."
                ]
                if any(plane.section.mirrors()):
                    said.append("What was not computed is mirrored.")
        except Missing as error:
            return join(
                [*head, tag("p", f"There is no picture of the mid-plane: {error}."), self._hint(run, "Run it again with")]
            )
        self._movies.append(movie.data)
        if movie.left_out:
            said.append(f"{movie.left_out} of the run's snapshots are left out to keep the file small.")
        count = len(movie.data["frames"])
        if count < FEW_FRAMES:
            said += [
                f"The run kept {count} snapshot{'s' if count != 1 else ''}.",
                self._hint(run, "For a smooth animation run it with"),
            ]
        return join(
            [*head, tag("p", Raw(" ".join(map(html, said)))), tag("div", class_="movie", data_movie=len(self._movies) - 1)]
        )

    @staticmethod
    def _hint(run: Run, words: str) -> Raw:
        """The setting that gives enough snapshots for an animation."""
        interval = f"{_interval(run):.0e}".replace("e-0", "e-")
        return tag("span", f"{words} ", tag("code", f"-P output.field_interval={interval}"))

    # ------------------------------------------------------------------------------------------------ curves

    def _chart(self, panel: histories.Panel) -> Raw:
        return tag("div", class_="chart", data_chart=self._charts.add(panel, self._several))

    @staticmethod
    def _guarded(build, *arguments) -> list[histories.Panel]:
        """Panels of files that may be missing or damaged."""
        try:
            return build(*arguments)
        except (Missing, KeyError):
            return []

    def _histories(self) -> Raw:
        panels = histories.probe_panels(self._labelled) + histories.part_panels(self._labelled)
        for i, run in enumerate(self.runs):
            panels += self._guarded(histories.line_panels, run, i)
        if not panels:
            return tag("p", "The run has no histories: the scene has no probes, or they were not written yet.")
        together = tag(
            "label",
            tag("input", type="checkbox", id="together", checked=""),
            "charts over time keep the same range",
            class_="row",
        )
        hint = "Drag across a chart to zoom, Shift and drag to move, double-click for the whole; the buttons do the same."
        return join([tag("p", hint, class_="muted only-screen"), tag("div", together, class_="controls"), self._grid(panels)])

    def _grid(self, panels: list[histories.Panel]) -> Raw:
        """Charts beside each other where the screen is wide."""
        return tag("div", *map(self._chart, panels), class_="charts")

    def _energy(self) -> Raw:
        panels = histories.energy_panels(self._labelled)
        said = self._each(lambda run: notes(description.trust(run)))
        return join([said, self._grid(panels) if panels else tag("p", "energy.csv is missing.")])

    def _steps(self) -> Raw:
        parts = [self._each(run_parts.cost)]
        panel = histories.step_panel(self._labelled)
        if panel:
            parts.append(self._chart(panel))
        return join(parts)

    # ------------------------------------------------------------------------------------------------ warnings and origin

    def _repeat(self) -> Raw:
        return join(run_parts.origin(run, self._named(label), i) for i, (label, run) in enumerate(self._labelled))

    def _warnings(self) -> Raw:
        return self._each(run_parts.warnings)

    def _named(self, label: str) -> str:
        """The run's name where there are several."""
        return label if self._several else ""


def _made(build) -> Raw:
    """A part of the page; what is damaged in one part must not cost the others."""
    try:
        return build()
    except (Missing, LookupError, TypeError, ValueError, AttributeError, ArithmeticError) as error:
        return tag("p", f"{DAMAGED} ({type(error).__name__}: {error}).", class_="bad")


def labels_of(runs: list[Run]) -> list[str]:
    """Short names that tell the runs apart: of their folders, with as many of the folders above as it takes."""
    paths = [run.folder.resolve().parts for run in runs]
    for depth in range(1, max(map(len, paths)) + 1):
        names = ["/".join(path[-depth:]) for path in paths]
        if len(set(names)) == len(names):
            return names
    return [f"{i + 1}: {path[-1]}" for i, path in enumerate(paths)]


def _interval(run: Run) -> float:
    """An interval of snapshots that makes some sixty to a hundred of them: one, two or five times a power of ten."""
    end = float(run.setting("end_time", run.summary.get("time_s") or 1e-4))
    raw = end / 75
    size = 10.0 ** math.floor(math.log10(raw))
    return size * min((1, 2, 5, 10), key=lambda step: abs(math.log(raw / size / step)))


def write_run_report(folders: list[Path], output: Path, program: str | None = None) -> None:
    """Writes the report of these runs into a file."""
    report = RunReport([Run(folder) for folder in folders], program)
    output.write_text(report.text(), encoding="utf-8")
