"""Parts of a report that need no charts: tables and sentences about runs."""

import json
import shlex
import subprocess

from ..run import Run
from ..units import number, quantity, shorter
from . import description
from .page import Raw, join, notes, table, tag
from .results import missing, result_rows
from .scene_drawing import drawing


def computed(run: Run, grades: dict[str, str]) -> Raw:
    """The drawing of the scene, its parts in words, and its materials."""
    if not run.scene:
        return tag("p", "The scene is not known: resolved.toml is missing.")
    svg, legend, left_out = drawing(run)
    colours = dict(legend)

    def swatch(name: str) -> Raw:
        return tag("span", class_="swatch", style=f"background:{colours[name]}") if name in colours else Raw("")

    listed = tag("dl", *(Raw(tag("dt", swatch(name), name) + tag("dd", words)) for name, words in description.parts(run)))
    figure = Raw("")
    if svg:
        figure = tag(
            "figure",
            tag("div", Raw(svg), class_="drawing"),
            tag(
                "figcaption", "The scene at its start, to scale; chain lines: symmetry; red crosses: probes. ", " ".join(left_out)
            ),
        )
    content = tag("div", figure, tag("div", listed), class_="columns") if svg else join([listed, notes(left_out)])
    return join([content, materials(run, grades)])


def materials(run: Run, grades: dict[str, str]) -> Raw:
    """The table of materials, with their sources."""
    rows = []
    for material, users in description.materials(run):
        name = str(material.get("name") or material.get("law") or "")
        said = "; ".join(f"{key} = {value}" for key, value in description.constants(material))
        rows.append(
            [
                name,
                ", ".join(users),
                Raw(f"{tag('div', material.get('source', 'no source given'))}{tag('div', said, class_='muted')}"),
                grades.get(name, "–"),
            ]
        )
    if not rows:
        return Raw("")
    words = "Grades: A, B from an established code, data file or paper; C recalled or a community's set; D without reference. "
    return join(
        [
            tag("h3", "Materials"),
            table(["material", "of", "source and constants (SI)", "grade"], rows),
            tag("p", words + "Constants are those of this run.", class_="muted"),
        ]
    )


def grades_of(program: str | None) -> dict[str, str]:
    """The grades of materials by name, as `undex materials --json` says; nothing where it cannot be asked."""
    if not program:
        return {}
    try:
        said = subprocess.run([program, "materials", "--json"], capture_output=True, timeout=20, check=True).stdout
        return {each["name"]: str(each["grade"]) for each in json.loads(said)}
    except (OSError, subprocess.SubprocessError, ValueError, KeyError, TypeError):
        return {}


def resolution(runs: list[Run], labels: list[str]) -> Raw:
    """How finely each run resolves what, and which settings differ."""
    names = list(dict.fromkeys(what for run in runs for what, _ in description.resolution(run)))
    if not names:
        return tag("p", "Not known: neither the scene nor the record says.")
    of_runs = [dict(description.resolution(run)) for run in runs]
    rows = [[name, *(each.get(name, "–") for each in of_runs)] for name in names]
    parts = [table(["", *(labels if len(runs) > 1 else ["this run"])], rows)]
    differing = _differing_settings(runs)
    if differing:
        parts += [tag("h3", "Settings that differ"), table(["setting", *labels], differing)]
    return join(parts)


def results(runs: list[Run], labels: list[str]) -> Raw:
    """The table of metrics beside their references, what the sources are, and what has no value."""
    parts = []
    rows, sources = result_rows(runs)
    heads = labels if len(runs) > 1 else ["this run"]
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
                    + (", the runs in their order." if len(runs) > 1 else "."),
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
    reference = next((run.reference for run in runs if run.reference is not None), None)
    if reference is not None and reference.notes:
        parts.append(tag("details", tag("summary", "What the sources are"), tag("pre", reference.notes)))
    for label, run in zip(labels, runs):
        gone = missing(run)
        if gone:
            parts += [
                tag("h3", f"Without a value{f' ({label})' if len(runs) > 1 else ''}"),
                notes([f"{names}: {reason}" for names, reason in gone]),
            ]
    return join(parts)


def largest_values(run: Run, label: str) -> Raw:
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
        tag("summary", f"Largest values{f' ({label})' if label else ''}"),
        table(["largest", "of", "value", "where", "when"], rows, {2, 3, 4}),
    )


def trust(run: Run) -> Raw:
    """What the program says of each matter that its numbers depend on."""
    marks = {"good": ("ok", "good"), "notice": ("note", "warn"), "bad": ("bad", "bad")}
    rows = []
    for each in run.summary.get("trust") or []:
        if isinstance(each, dict):
            word, colour = marks.get(str(each.get("level")), ("bad", "bad"))
            if each.get("about") == "known limit":  # of the scheme, not of this run
                word, colour = "–", "muted"
            rows.append([Raw(f'{tag("b", word, class_=colour)} {tag("span", each.get("about", ""))}'), each.get("text", "")])
    return table(["matter", "what is known"], rows) if rows else tag("p", "The record of the run does not say.")


def cost(run: Run) -> Raw:
    """Steps, times, memory, and where the time went."""
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
    said += description.step_limits(run)
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


def warnings(run: Run) -> Raw:
    """Warnings of the record, and how often bounds acted."""
    if not run.summary:
        return tag("p", "Not known: the run has no summary.json.")
    warned, bounded = [str(each) for each in run.summary.get("warnings") or []], description.clamps(run)
    return join(
        [
            tag("h3", "Warnings"),
            notes(warned) if warned else tag("p", "None."),
            tag("h3", "Bounds that acted"),
            notes(bounded) if bounded else tag("p", "None."),
        ]
    )


def origin(run: Run, label: str, index: int) -> Raw:
    """Program, folder, command and scene; `index` tells the scenes of a page apart."""
    parts = [tag("h3", label)] if label else []
    parts.append(
        tag(
            "p", f"Computed by {run.summary.get('program', 'a program that is not known')}, in the folder {run.folder.resolve()}."
        )
    )
    if run.scene_text:
        name = f"scene{index}"
        command = f"undex run {shlex.quote(f'{run.name}.toml')} -o out/again"
        parts += [
            tag(
                "p", "The scene as it was computed, with every default filled in, is in this page. Save it, and repeat the run by"
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
