"""Pictures of a study: error against CPU time with the Pareto front, error and conservation against resolution, cost."""
import math
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from ..errors import Missing
from ..study import Study
from .style import COLOURS, LINES, MARKERS, Job, draw_all, file_name, plain, plt

LEDGERS = [
    ("energy_error", "energy"),
    ("momentum_error", "momentum"),
    ("mass_error", "mass"),
    ("interface_energy_error", "interface energy"),
    ("interface_impulse_error", "interface impulse"),
]
OVERVIEW = [
    ("cpu_time_s", "CPU time [s]"),
    ("bytes_per_particle", "bytes a particle"),
    ("updates", "million particle updates a CPU second"),
    ("interactions", "million neighbours a CPU second"),
]
_LEGEND = dict(frameon=False, fontsize=8.5, handlelength=3.2)


def draw_study(folder: Path, dpi: int = 110) -> list[Path]:
    """Draws a set for each problem into folder/pictures, and returns the paths."""
    study = Study(folder)
    if not study.done:
        raise Missing(f"{study.folder / 'study.csv'}: no run is done yet")
    jobs: dict[str, Job] = {}
    for problem in study.problems:
        for error in study.errors:
            jobs[file_name("cost", error, problem)] = lambda e=error, p=problem: cost_figure(study, p, e)
            if study.resolution:
                jobs[file_name("order", error, problem)] = lambda e=error, p=problem: order_figure(study, p, e)
        x = study.resolution or "cpu_time_s"
        ledgers = [(column, f"|{name} error|, relative") for column, name in LEDGERS]
        jobs[file_name("conservation", problem)] = lambda p=problem: panels_figure(study, p, x, ledgers)
        jobs[file_name("overview", problem)] = lambda p=problem: panels_figure(study, p, x, OVERVIEW)
    pictures = study.folder / "pictures"
    return draw_all(jobs, pictures, dpi, list(pictures.glob("*.png")))


def shown_number(value: float, _=None) -> str:
    """1, 20, 0.03; powers of ten for what is smaller or larger."""
    if value <= 0:
        return ""
    exponent = math.floor(math.log10(value) + 1e-9)
    if -3 <= exponent <= 4:
        return f"{value:g}"
    head = value / 10**exponent
    return (f"{head:.3g}·" if abs(head - 1) > 1e-6 else "") + f"$10^{{{exponent}}}$"


def _style(study: Study, curve: str) -> dict:
    colour, line, marker = study.looks()[curve]
    paint = COLOURS[colour % len(COLOURS)]
    return {
        "color": paint,
        "ls": LINES[line % 4],
        "marker": MARKERS[marker % len(MARKERS)],
        "mfc": "white" if line % 2 else paint,
    }


def _logarithmic(axis: Axes, which: str) -> None:
    """A log axis whose ticks can be read also where it covers less than a decade."""
    axis.set_xscale("log") if which == "x" else axis.set_yscale("log")
    part = axis.xaxis if which == "x" else axis.yaxis
    low, high = axis.get_xlim() if which == "x" else axis.get_ylim()
    decades = np.log10(high / low)
    subs = (1.0,) if decades > 2.5 else (1.0, 2.0, 5.0) if decades > 1.2 else (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0)
    part.set_major_locator(LogLocator(subs=subs, numticks=20))
    part.set_major_formatter(FuncFormatter(shown_number))
    part.set_minor_formatter(NullFormatter())


def _finish(axis: Axes, title: str) -> None:
    for which in "xy":
        _logarithmic(axis, which)
    axis.grid(alpha=0.3, which="major")
    axis.grid(alpha=0.12, which="minor")
    axis.set_title(plain(title), fontsize=11, loc="left")
    axis.spines[["top", "right"]].set_visible(False)


def _head(study: Study, problem: str) -> str:
    return study.title + (f"\n{problem}" if problem else "")


def _resolution_label(study: Study) -> str:
    return f"{study.resolution} [m]" if study.resolution == "spacing" else str(study.resolution)


def cost_figure(study: Study, problem: str, error: str) -> Figure | None:
    """Error against CPU time, a curve a scheme, the Pareto front as a staircase behind."""
    curves = study.points(problem, "cpu_time_s", f"error: {error}")
    if not curves:
        return None
    figure, axis = plt.subplots(figsize=(8.4, 6.4), layout="constrained")
    for curve, points in curves.items():
        times, values = [p[0] for p in points], [p[1] for p in points]
        axis.plot(times, values, lw=1.5, ms=6.5, label=plain(curve), zorder=3, **_style(study, curve))
        for i in {0, len(points) - 1} if study.resolution and len(points) > 1 else ():  # the ends say which resolution they are
            axis.annotate(
                points[i][2][study.resolution],
                (times[i], values[i]),
                textcoords="offset points",
                xytext=(6, 5),
                fontsize=7,
                color=_style(study, curve)["color"],
            )
    front = study.front(problem, error)
    if front:
        times, values = np.array(front).T
        axis.plot(times, values, "o", ms=14, mfc="none", mec="0.35", mew=1.2, zorder=2, label="not beaten in both")
        axis.step(times, values, where="post", color="0.6", lw=5, alpha=0.35, zorder=1, solid_capstyle="round")
    axis.set(xlabel="CPU time [s]", ylabel=plain(error))
    _finish(axis, _head(study, problem))
    axis.legend(loc="upper left", bbox_to_anchor=(-0.02, -0.13), ncol=2, **_LEGEND)
    return figure


def order_figure(study: Study, problem: str, error: str) -> Figure | None:
    """Error against resolution; the legend has the observed order of each curve."""
    curves = study.points(problem, study.resolution, f"error: {error}")
    if not any(len(points) > 1 for points in curves.values()):
        return None
    figure, axis = plt.subplots(figsize=(8.4, 6.4), layout="constrained")
    for curve, points in curves.items():
        order = study.orders.get((error, curve), math.nan)
        label = plain(curve) + ("" if math.isnan(order) else f"   order {order:.2f}")
        axis.plot([p[0] for p in points], [p[1] for p in points], lw=1.5, ms=6.5, zorder=3, label=label, **_style(study, curve))
    for order in (1, 2):
        _slope(axis, curves, order)
    axis.set(xlabel=_resolution_label(study), ylabel=plain(error))
    _finish(axis, _head(study, problem))
    axis.legend(loc="upper left", bbox_to_anchor=(-0.02, -0.13), ncol=2, **_LEGEND)
    return figure


def _slope(axis: Axes, curves: dict, order: int) -> None:
    """A dashed line of that order below all points, with its name."""
    every = [(x, value) for points in curves.values() for x, value, _ in points]
    coarse, fine = max(x for x, _ in every), min(x for x, _ in every)
    if coarse / fine < 1.01:
        return
    low = min(value * (coarse / x) ** order for x, value in every)
    ends = np.array([fine, coarse])
    line = 0.75 * low * (ends / coarse) ** order
    axis.plot(ends, line, color="0.55", lw=1, ls=(0, (4, 3)), zorder=1)
    axis.annotate(f"order {order:g}", (ends[0], line[0]), textcoords="offset points", xytext=(2, -10), fontsize=8, color="0.4")


def panels_figure(study: Study, problem: str, x: str, quantities: list[tuple[str, str]]) -> Figure | None:
    """A panel a quantity (column, label) that some run has, one legend for all. What closes exactly is not on a logarithmic axis."""
    present = [(label, study.points(problem, x, column)) for column, label in quantities]
    present = [each for each in present if each[1]]
    if not present:
        return None
    columns = min(2, len(present))
    lines = -(-len(present) // columns)
    figure, axes = plt.subplots(
        lines, columns, figsize=(4.6 * columns + 3.0, 3.8 * lines + 0.3), squeeze=False, layout="constrained"
    )
    for axis in axes.flat[len(present) :]:
        axis.remove()
    handles = {}
    for axis, (label, curves) in zip(axes.flat, present):
        for curve, points in curves.items():
            (handles[plain(curve)],) = axis.plot(
                [p[0] for p in points], [p[1] for p in points], lw=1.5, ms=6, **_style(study, curve)
            )
        axis.set(xlabel=_resolution_label(study) if x == study.resolution else "CPU time [s]")
        _finish(axis, label)
    axes[0, -1].legend(list(handles.values()), list(handles), loc="upper left", bbox_to_anchor=(1.01, 1.0), **_LEGEND)
    figure.suptitle(plain(_head(study, problem)), fontsize=11)
    return figure
