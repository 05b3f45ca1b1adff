#!/usr/bin/python3
"""Pictures of a study: error against CPU time, error and conservation against resolution.

Usage: /usr/bin/python3 scripts/plot_study.py DIR [--dpi N]      DIR: what undex study wrote

Reads DIR/study.json, study.csv and order.csv, and writes DIR/pictures/*.png: for each error and each problem (scene)
`cost_<error>.png` with the Pareto front and, where there is an axis of resolution, `order_<error>.png` with slopes;
`conservation.png`; `overview.png`: CPU time, memory a particle and speed. Runs that are not done are left out. Needs
python3-numpy and python3-matplotlib (Debian's own).
"""
import argparse
import csv
import json
import re
import sys
from pathlib import Path

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
except ImportError as error:
    sys.exit(f"plot_study.py: {error}. Run scripts/install_packages.sh, and this script with /usr/bin/python3 "
             f"(this is {sys.executable}).")

MARKERS = "osD^vP*X<>hd"
LINES = ["-", "--", "-.", ":"]
# Colours that stay apart for the colour-blind (Okabe and Ito, black last).
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#8a6d00", "#000000"]
LEDGERS = [("energy_error", "energy"), ("momentum_error", "momentum"), ("mass_error", "mass"),
           ("interface_energy_error", "interface energy"), ("interface_impulse_error", "interface impulse")]


class Missing(Exception):
    """Something that a picture needs is not there; the message says what and where."""


def number(text):
    try:
        return float(text)
    except ValueError:
        return np.nan


class Study:
    """What undex study left in its folder."""

    def __init__(self, folder):
        self.folder = Path(folder)
        for name in ("study.json", "study.csv"):
            if not (self.folder / name).is_file():
                raise Missing(f"{self.folder / name}: missing; give the folder that undex study wrote")
        try:
            said = json.loads((self.folder / "study.json").read_text())
            self.title, self.axes = said["title"], said["axes"]
            self.resolution, self.errors = said["resolution"], said["errors"]
        except (ValueError, KeyError, TypeError) as error:
            raise Missing(f"{self.folder / 'study.json'}: not a study's ({error!r}); run the study again") from error
        with open(self.folder / "study.csv", newline="") as file:
            self.rows = [row for row in csv.DictReader(file) if row["status"] == "done"]
        if not self.rows:
            raise Missing(f"{self.folder / 'study.csv'}: no run is done yet")
        self.orders = {}
        if (self.folder / "order.csv").is_file():
            with open(self.folder / "order.csv", newline="") as file:
                for row in csv.DictReader(file):
                    if row["kind"] == "least squares":
                        self.orders[row["error"], row["curve"]] = number(row["order"])
        self.curves = list(dict.fromkeys(row["curve"] for row in self.rows))
        self.problems = list(dict.fromkeys(row["problem"] for row in self.rows))
        self.style = self.styles()

    def styles(self):
        """Colour for the first axis of a curve, line for the second, marker for the curve: related curves look related."""
        free = [axis for axis in self.axes if axis != self.resolution]
        values = {axis: list(dict.fromkeys(row[axis] for row in self.rows)) for axis in free}
        telling = [axis for axis in free if len(values[axis]) > 1]
        result = {}
        for i, curve in enumerate(self.curves):
            row = next(row for row in self.rows if row["curve"] == curve)
            place = [values[axis].index(row[axis]) for axis in telling]
            two = len(telling) == 2 and len(values[telling[1]]) <= len(LINES) and len(values[telling[0]]) <= len(COLOURS)
            colour, line = (place[0], place[1]) if two else (i, i // len(COLOURS))
            paint = COLOURS[colour % len(COLOURS)]
            result[curve] = {"color": paint, "ls": LINES[line % len(LINES)], "marker": MARKERS[i % len(MARKERS)],
                             "mfc": "white" if two and place[1] % 2 else paint}
        return result

    def points(self, problem, x, y):
        """{curve: (x, |y|, rows)} sorted by resolution (or by x), where both are positive."""
        result = {}
        for curve in self.curves:
            rows = [row for row in self.rows if row["curve"] == curve and row["problem"] == problem
                    and number(row.get(x, "")) > 0 and abs(number(row.get(y, ""))) > 0]
            rows.sort(key=lambda row: number(row[self.resolution if self.resolution else x]))
            if rows:
                result[curve] = (*(np.array([abs(number(row[column])) for row in rows]) for column in (x, y)), rows)
        return result


def shown_number(value, _=None):
    """1, 20, 0.03; powers of ten for what is smaller or larger."""
    if value <= 0:
        return ""
    exponent = int(np.floor(np.log10(value) + 1e-9))
    if -3 <= exponent <= 4:
        return f"{value:g}"
    head = value / 10 ** exponent
    return (f"{head:.3g}·" if abs(head - 1) > 1e-6 else "") + f"$10^{{{exponent}}}$"


def logarithmic(axis, which):
    """A log axis whose ticks can be read also where it covers less than a decade."""
    axis.set_xscale("log") if which == "x" else axis.set_yscale("log")
    part = axis.xaxis if which == "x" else axis.yaxis
    low, high = axis.get_xlim() if which == "x" else axis.get_ylim()
    decades = np.log10(high / low)
    subs = (1.0,) if decades > 2.5 else (1.0, 2.0, 5.0) if decades > 1.2 else (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0)
    part.set_major_locator(LogLocator(subs=subs, numticks=20))
    part.set_major_formatter(FuncFormatter(shown_number))
    part.set_minor_formatter(NullFormatter())


def finish(axis, title):
    for which in "xy":
        logarithmic(axis, which)
    axis.grid(alpha=0.3, which="major")
    axis.grid(alpha=0.12, which="minor")
    axis.set_title(title, fontsize=11, loc="left")
    axis.spines[["top", "right"]].set_visible(False)


LEGEND = dict(frameon=False, fontsize=8.5, handlelength=3.2)


def legend_below(axis):
    """Under the panel, where it covers no curve."""
    axis.legend(loc="upper left", bbox_to_anchor=(-0.02, -0.13), ncol=2, **LEGEND)


def resolution_label(study):
    return f"{study.resolution} [m]" if study.resolution == "spacing" else study.resolution


def plot_cost(study, problem, error):
    """Error against CPU time, a curve a scheme, the Pareto front as a staircase behind."""
    curves = study.points(problem, "cpu_time_s", f"error: {error}")
    if not curves:
        return None
    figure, axis = plt.subplots(figsize=(8.4, 6.4), layout="constrained")
    front = []
    for curve, (time, values, rows) in curves.items():
        axis.plot(time, values, lw=1.5, ms=6.5, label=curve, zorder=3, **study.style[curve])
        front += [(t, e) for t, e, row in zip(time, values, rows) if row[f"pareto: {error}"] == "1"]
    if front:
        front.sort()
        times, values = np.array(front).T
        axis.plot(times, values, "o", ms=14, mfc="none", mec="0.35", mew=1.2, zorder=2, label="not beaten in both")
        axis.step(times, values, where="post", color="0.6", lw=5, alpha=0.35, zorder=1, solid_capstyle="round")
    for curve, (time, values, rows) in curves.items():  # the ends of a curve say which resolution they are
        for i in ({0, len(rows) - 1} if study.resolution and len(rows) > 1 else ()):
            axis.annotate(rows[i][study.resolution], (time[i], values[i]), textcoords="offset points", xytext=(6, 5),
                          fontsize=7, color=study.style[curve]["color"])
    axis.set(xlabel="CPU time [s]", ylabel=error)
    finish(axis, study.title + (f"\n{problem}" if problem else ""))
    legend_below(axis)
    return figure


def slope_guide(axis, curves, order):
    """A dashed line of that order below all points, with its name."""
    h = np.concatenate([x for x, _, _ in curves.values()])
    if h.max() / h.min() < 1.01:
        return
    ends = np.array([h.min(), h.max()])
    low = min(float(np.min(values * (h.max() / x) ** order)) for x, values, _ in curves.values())
    line = 0.75 * low * (ends / h.max()) ** order
    axis.plot(ends, line, color="0.55", lw=1, ls=(0, (4, 3)), zorder=1)
    axis.annotate(f"order {order:g}", (ends[0], line[0]), textcoords="offset points", xytext=(2, -10), fontsize=8, color="0.4")


def plot_order(study, problem, error):
    """Error against resolution; the legend has the observed order of each curve."""
    curves = study.points(problem, study.resolution, f"error: {error}")
    if not any(len(x) > 1 for x, _, _ in curves.values()):
        return None
    figure, axis = plt.subplots(figsize=(8.4, 6.4), layout="constrained")
    for curve, (h, values, _) in curves.items():
        order = study.orders.get((error, curve), np.nan)
        label = curve + ("" if np.isnan(order) else f"   order {order:.2f}")
        axis.plot(h, values, lw=1.5, ms=6.5, zorder=3, label=label, **study.style[curve])
    for order in (1, 2):
        slope_guide(axis, curves, order)
    axis.set(xlabel=resolution_label(study), ylabel=error)
    finish(axis, study.title + (f"\n{problem}" if problem else ""))
    legend_below(axis)
    return figure


def panels_of(study, problem, x, quantities):
    """A panel a quantity (column, label) that some run has, one legend for all."""
    present = [(column, label, study.points(problem, x, column)) for column, label in quantities]
    present = [each for each in present if each[2]]
    if not present:
        return None
    columns = min(2, len(present))
    lines = -(-len(present) // columns)
    figure, axes = plt.subplots(lines, columns, figsize=(4.6 * columns + 3.0, 3.8 * lines + 0.3), squeeze=False,
                                layout="constrained")
    for axis in axes.flat[len(present):]:
        axis.remove()
    handles = {}
    for axis, (column, label, curves) in zip(axes.flat, present):
        for curve, (values_x, values, _) in curves.items():
            handles[curve], = axis.plot(values_x, values, lw=1.5, ms=6, **study.style[curve])
        axis.set(xlabel=resolution_label(study) if x == study.resolution else "CPU time [s]")
        finish(axis, label)
    axes[0, -1].legend(list(handles.values()), list(handles), loc="upper left", bbox_to_anchor=(1.01, 1.0), **LEGEND)
    figure.suptitle(study.title + (f": {problem}" if problem else ""), fontsize=11)
    return figure


def plot_conservation(study, problem):
    """Errors of the ledgers, in magnitude; what closes exactly is not on a logarithmic axis."""
    x = study.resolution or "cpu_time_s"
    return panels_of(study, problem, x, [(column, f"|{name} error|, relative") for column, name in LEDGERS])


def plot_overview(study, problem):
    """What a run costs."""
    for row in study.rows:
        time = number(row["cpu_time_s"])
        row["updates"] = str(1e-6 * number(row["particle_updates"]) / time) if time > 0 else ""
        row["interactions"] = str(1e-6 * number(row["neighbour_interactions"]) / time) if time > 0 else ""
    return panels_of(study, problem, study.resolution or "cpu_time_s",
                     [("cpu_time_s", "CPU time [s]"), ("bytes_per_particle", "bytes a particle"),
                      ("updates", "million particle updates a CPU second"),
                      ("interactions", "million neighbours a CPU second")])


def file_name(*parts):
    return "_".join(re.sub(r"[^\w.-]+", "_", part).strip("_") for part in parts if part) + ".png"


def main():
    parser = argparse.ArgumentParser(description="Pictures of a study, into DIR/pictures.")
    parser.add_argument("folder", metavar="DIR", help="the output folder of undex study")
    parser.add_argument("--dpi", type=int, default=110)
    options = parser.parse_args()
    try:
        study = Study(options.folder)
    except (Missing, OSError) as error:
        print(f"plot_study.py: {error}", file=sys.stderr)
        return 2
    pictures = study.folder / "pictures"
    pictures.mkdir(exist_ok=True)
    for old in pictures.glob("*.png"):  # an older study's must not pass for this one's
        old.unlink()
    drawn = 0
    for problem in study.problems:
        jobs = {}
        for error in study.errors:
            jobs[file_name("cost", error, problem)] = lambda error=error: plot_cost(study, problem, error)
            if study.resolution:
                jobs[file_name("order", error, problem)] = lambda error=error: plot_order(study, problem, error)
        jobs[file_name("conservation", problem)] = lambda: plot_conservation(study, problem)
        jobs[file_name("overview", problem)] = lambda: plot_overview(study, problem)
        for name, draw in jobs.items():
            figure = draw()
            if figure is None:  # no run has it
                continue
            figure.savefig(pictures / name, dpi=options.dpi)
            plt.close(figure)
            print(pictures / name)
            drawn += 1
    return 0 if drawn else 1


if __name__ == "__main__":
    sys.exit(main())
