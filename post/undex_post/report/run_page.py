"""The report of one run, or of several beside each other."""
import json
import math
import shlex
import subprocess
from pathlib import Path


from .. import histories
from ..errors import Missing
from ..mid_plane import MidPlane
from ..run import Run
from ..units import number, quantity, scale_for, shorter
from . import description
from .chart_data import ChartData
from .movie import FLUID, SOLID, Movie
from .page import Raw, chips, colour_tables, html, join, notes, page, table, tag
from .results import missing, result_rows
from .scene_drawing import drawing

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
            ("results", "Results beside references", self._results),
            ("mid-plane", "The mid-plane", self._mid_planes),
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
        return self._each(self._computed_of)

    def _computed_of(self, run: Run) -> Raw:
        if not run.scene:
            return tag("p", "The scene is not known: resolved.toml is missing.")
        svg, legend, left_out = drawing(run)
        colours = dict(legend)
        swatch = (
            lambda name: tag("span", class_="swatch", style=f"background:{colours.get(name, 'none')}")
            if name in colours
            else Raw("")
        )
        listed = tag("dl", *(Raw(tag("dt", swatch(name), name) + tag("dd", words)) for name, words in description.parts(run)))
        figure = Raw("")
        if svg:
            figure = tag(
                "figure",
                tag("div", Raw(svg), class_="drawing"),
                tag(
                    "figcaption",
                    "The scene at its start, to scale; chain lines: symmetry; red crosses: probes. ",
                    " ".join(left_out),
                ),
            )
        content = tag("div", figure, tag("div", listed), class_="columns") if svg else join([listed, notes(left_out)])
        return join([tag("p", description.lead(run)) if self._several else Raw(""), content, self._materials(run)])

    def _materials(self, run: Run) -> Raw:
        known = self._grades()
        rows = []
        for material, users in description.materials(run):
            name = str(material.get("name") or material.get("law") or "")
            grade = known.get(name, {})
            said = "; ".join(f"{key} = {value}" for key, value in description.constants(material))
            rows.append(
                [
                    name,
                    ", ".join(users),
                    Raw(f"{tag('div', material.get('source', 'no source given'))}{tag('div', said, class_='muted')}"),
                    grade.get("grade", "–"),
                ]
            )
        if not rows:
            return Raw("")
        grades = (
            "Grades: A, B from an established code, data file or paper; C recalled or a community's set; D without reference. "
        )
        return join(
            [
                tag("h3", "Materials"),
                table(["material", "of", "source and constants (SI)", "grade"], rows),
                tag("p", grades + "Constants are those of this run.", class_="muted"),
            ]
        )

    def _grades(self) -> dict[str, dict]:
        """What `undex materials --json` says, by name."""
        if not self._program:
            return {}
        try:
            said = subprocess.run([self._program, "materials", "--json"], capture_output=True, timeout=20, check=True).stdout
            return {each["name"]: each for each in json.loads(said)}
        except (OSError, subprocess.SubprocessError, ValueError, KeyError, TypeError):
            return {}

    def _resolution(self) -> Raw:
        names = list(dict.fromkeys(what for run in self.runs for what, _ in description.resolution(run)))
        if not names:
            return tag("p", "Not known: resolved.toml is missing.")
        of_runs = [dict(description.resolution(run)) for run in self.runs]
        rows = [[name, *(each.get(name, "–") for each in of_runs)] for name in names]
        parts = [table(["", *(self.labels if self._several else ["this run"])], rows)]
        differing = _differing_settings(self.runs)
        if differing:
            parts += [tag("h3", "Settings that differ"), table(["setting", *self.labels], differing)]
        return join(parts)

    # ------------------------------------------------------------------------------------------------ results

    def _results(self) -> Raw:
        parts = []
        rows, sources = result_rows(self.runs)
        heads = self.labels if self._several else ["this run"]
        if rows:
            cells = []
            for row in rows:
                said = [
                    Raw(f"{row.sources[source].text} {tag('span', ' / '.join(row.sources[source].differences), class_='diff')}")
                    if source in row.sources
                    else ""
                    for source in sources
                ]
                cells.append([row.label, *(tag("b", value) for value in row.values), *said])
            parts.append(table(["result", *heads, *sources], cells, set(range(1, 1 + len(heads) + len(sources)))))
            if sources:
                parts.append(
                    tag(
                        "p",
                        "Beside each source's value: the run less the source, in percent of the source, times in their own unit"
                        + (", the runs in their order." if self._several else "."),
                        class_="muted",
                    )
                )
        else:
            parts.append(
                tag(
                    "p",
                    "The scene asks for no comparison, or the run has not come to its end: there are no results to compare. "
                    "A reference is named by comparison.reference.",
                )
            )
        reference = next((run.reference for run in self.runs if run.reference is not None), None)
        if reference is not None and reference.notes:
            parts.append(tag("details", tag("summary", "What the sources are"), tag("pre", reference.notes)))
        for label, run in self._labelled:
            gone = missing(run)
            if gone:
                parts += [
                    tag("h3", f"Without a value{f' ({label})' if self._several else ''}"),
                    notes([f"{names}: {reason}" for names, reason in gone]),
                ]
        parts += [self._chart(panel) for panel in histories.reference_panels(self._labelled)]
        if not self._several:
            parts += [self._chart(panel) for panel in self._guarded(histories.profile_panels, self.runs[0])]
        parts += [self._largest(label, run) for label, run in self._labelled]
        return join(parts)

    def _largest(self, label: str, run: Run) -> Raw:
        """The largest values of the run, and its bubbles."""
        units = {
            "pressure_pa": ("pressure", "Pa"),
            "speed_m_s": ("speed", "m/s"),
            "plastic_strain": ("plastic strain", "-"),
            "temperature_k": ("temperature", "K"),
        }
        rows = []
        for key, owners in (run.summary.get("largest") or {}).items():
            name, unit = units.get(key, (key.replace("_", " "), ""))
            for owner, said in owners.items() if isinstance(owners, dict) else []:
                if isinstance(said, dict) and isinstance(said.get("value"), (int, float)):
                    place = ", ".join(number(1e3 * x, 3) for x in said.get("place_m", []) if isinstance(x, (int, float)))
                    rows.append(
                        [
                            name,
                            owner,
                            quantity(said["value"], unit),
                            f"({place}) mm" if place else "–",
                            quantity(said.get("time_s"), "s"),
                        ]
                    )
        for bubble in [each for each in run.summary.get("bubbles") or [] if isinstance(each, dict)]:
            for key, what, unit in (
                ("largest_radius_m", "largest radius", "m"),
                ("least_radius_m", "least radius", "m"),
                ("period_s", "period", "s"),
            ):
                if isinstance(bubble.get(key), (int, float)):
                    rows.append(
                        [
                            what,
                            bubble.get("body", ""),
                            quantity(bubble[key], unit),
                            "–",
                            quantity(bubble.get("largest_radius_time_s"), "s") if key == "largest_radius_m" else "–",
                        ]
                    )
        if not rows:
            return Raw("")
        return tag(
            "details",
            tag("summary", f"Largest values{f' ({label})' if self._several else ''}"),
            table(["largest", "of", "value", "where", "when"], rows, {2, 3, 4}),
        )

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
        parts = [self._each(self._cost_of)]
        panel = histories.step_panel(self._labelled)
        if panel:
            parts.append(self._chart(panel))
        return join(parts)

    def _cost_of(self, run: Run) -> Raw:
        summary = run.summary
        if not summary:
            return tag("p", "Not known: the run has no summary.json.")
        steps, end = summary.get("steps"), summary.get("time_s")
        said = []
        if steps and end:
            said.append(
                f"{steps:,} steps, {quantity(end / steps, 's')} each on average"
                + (
                    f", with {summary['fluid_substeps']:,} substeps of the fluid's fast bodies."
                    if summary.get("fluid_substeps")
                    else "."
                )
            )
        said.append("What set each step is printed by undex run -v.")
        updates, cpu = summary.get("particle_updates"), summary.get("cpu_time_s")
        if updates and cpu:
            said.append(
                f"{description.duration(summary.get('wall_time_s', 0.0))} of wall time and {description.duration(cpu)} of CPU time on "
                f"{summary.get('threads', 1)} thread(s); {number(1e-6 * updates / cpu, 3)} million particle updates a CPU second; "
                f"{quantity(summary.get('peak_memory_bytes'), 'byte', 3)} of memory at most."
            )
        passes = {
            name: seconds
            for name, seconds in (summary.get("passes") or {}).items()
            if isinstance(seconds, (int, float)) and seconds > 0
        }
        total, top = sum(passes.values()), max(passes.values(), default=1.0)
        bars = [
            Raw(
                tag("span", name)
                + tag("span", tag("i", style=f"width:{100 * seconds / top:.1f}%"))
                + tag("span", f"{description.duration(seconds)} ({100 * seconds / total:.0f} %)")
            )
            for name, seconds in sorted(passes.items(), key=lambda each: -each[1])
            if seconds > 0.001 * total
        ]
        return join(
            [tag("p", " ".join(said)), tag("h3", "Wall time by part"), tag("div", *bars, class_="bars")]
            if bars
            else [tag("p", " ".join(said))]
        )

    # ------------------------------------------------------------------------------------------------ warnings and origin

    def _warnings(self) -> Raw:
        def of(run: Run) -> Raw:
            warned, bounded = [str(each) for each in run.summary.get("warnings") or []], description.clamps(run)
            if not run.summary:
                return tag("p", "Not known: the run has no summary.json.")
            return join(
                [
                    tag("h3", "Warnings"),
                    notes(warned) if warned else tag("p", "None."),
                    tag("h3", "Bounds that acted"),
                    notes(bounded) if bounded else tag("p", "None."),
                ]
            )

        return self._each(of)

    def _repeat(self) -> Raw:
        return join(self._repeat_of(i, label, run) for i, (label, run) in enumerate(self._labelled))

    def _repeat_of(self, index: int, label: str, run: Run) -> Raw:
        parts = [tag("h3", label)] if self._several else []
        parts.append(
            tag(
                "p",
                f"Computed by {run.summary.get('program', 'a program that is not known')}, in the folder {run.folder.resolve()}.",
            )
        )
        if run.scene_text:
            name = f"scene{index}"
            command = f"undex run {shlex.quote(f'{run.name}.toml')} -o out/again"
            parts += [
                tag(
                    "p",
                    "The scene as it was computed, with every default filled in, is in this page. Save it, and repeat the run by",
                ),
                tag("pre", command),
                tag(
                    "div",
                    tag("button", "Save the scene", type="button", data_save=name, data_name=f"{run.name}.toml"),
                    class_="controls",
                ),
                tag("details", tag("summary", "The scene (resolved.toml)"), tag("pre", run.scene_text, id=name)),
            ]
        return join(parts)


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


def _differing_settings(runs: list[Run]) -> list[list[str]]:
    """Settings of resolved.toml that are not the same in all runs, without titles, names and outputs."""

    def flat(value, path: str = "") -> dict[str, str]:
        if isinstance(value, dict):
            return {
                key: text for name, each in value.items() for key, text in flat(each, f"{path}.{name}" if path else name).items()
            }
        if isinstance(value, list) and value and all(isinstance(each, dict) for each in value):
            return {
                key: text for i, each in enumerate(value) for key, text in flat(each, f"{path}.{each.get('name', i)}").items()
            }
        return {path: json.dumps(value, default=str)}

    if len(runs) < 2:
        return []
    every = [flat(run.scene) for run in runs]
    keys = list(dict.fromkeys(key for each in every for key in each))
    differing = [
        key
        for key in keys
        if len({each.get(key) for each in every}) > 1
        and not key.startswith(("title", "name", "output.", "comparison.reference"))
        and not key.endswith((".source", ".name"))
    ]
    return [[key, *(shorter(each.get(key, "–"), 60) for each in every)] for key in differing[:40]]


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
