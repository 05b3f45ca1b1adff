"""Pictures of what `undex compare` wrote: a panel a quantity, a curve a run, the reference in grey."""
from pathlib import Path

from matplotlib.figure import Figure

from ..comparison import REFERENCE, Comparison
from ..histories import Curve, Panel
from ..units import number
from .panels import figure_of
from .style import COLOURS, Job, draw_all, plain, plt


def draw_comparison(folder: Path, dpi: int = 110) -> list[Path]:
    """Draws motion, pressure, energy, other and cost into folder/pictures, and returns the paths."""
    comparison = Comparison(folder)

    def motion(kind: str, quantity: str) -> bool:
        return kind == "structure" and ("displacement" in quantity or "velocity" in quantity or quantity == "plastic strain")

    def pressure(kind: str, quantity: str) -> bool:
        return kind in ("wall", "fluid") and quantity in ("pressure", "pressure, 1 us mean", "impulse")

    def other(kind: str, quantity: str) -> bool:
        return kind != "energy" and not motion(kind, quantity) and not pressure(kind, quantity) and "mean" not in quantity

    title = " / ".join(comparison.runs)
    jobs: dict[str, Job] = {
        name: lambda wanted=wanted: figure_of(panels(comparison, wanted), title, 3)
        for name, wanted in (
            ("motion", motion),
            ("pressure", pressure),
            ("energy", lambda kind, _: kind == "energy"),
            ("other", other),
        )
    }
    jobs["cost"] = lambda: cost_figure(comparison)
    pictures = comparison.folder / "pictures"
    return draw_all(jobs, pictures, dpi, [pictures / f"{name}.png" for name in jobs])


def panels(comparison: Comparison, wanted) -> list[Panel]:
    """The chosen quantities, the runs in their order, then the reference history, then sources of a table as points."""
    found = []
    for (probe, _, quantity, unit), runs in comparison.select(wanted).items():
        panel = Panel(probe, quantity, "" if unit == "-" else unit)
        for number_of, run in enumerate(comparison.runs):
            if run in runs:
                panel.curves.append(Curve(run, *runs[run], number_of))
        panel.curves += [
            Curve(source, *runs[source], None, "line" if source == REFERENCE else "points")
            for source in [REFERENCE, *comparison.sources]
            if source in runs
        ]
        found.append(panel)
    return found


def cost_figure(comparison: Comparison) -> Figure | None:
    """Bars: what each run cost, a panel a measure."""
    count = len(comparison.runs)
    rows = [row for row in comparison.rows if row[0] == "cost" and row[1] != "threads" and any(row[3 : 3 + count])]
    if not rows:
        return None
    columns = min(3, len(rows))
    lines = -(-len(rows) // columns)
    figure, axes = plt.subplots(
        lines, columns, figsize=(4.6 * columns, (1.0 + 0.36 * count) * lines + 0.5), squeeze=False, layout="constrained"
    )
    for axis in axes.flat[len(rows) :]:
        axis.remove()
    for axis, row in zip(axes.flat, rows):
        values = [float(cell) if cell else 0.0 for cell in row[3 : 3 + count]]
        bars = axis.barh(
            [plain(run) for run in comparison.runs], values, color=[COLOURS[i % len(COLOURS)] for i in range(count)], height=0.7
        )
        axis.bar_label(bars, [number(value) if value else "–" for value in values], padding=3, fontsize=8)
        axis.set_xlim(0, 1.25 * (max(values) or 1.0))
        axis.set_title(row[1] + (f" [{row[2]}]" if row[2] else ""), fontsize=10, loc="left")
        axis.invert_yaxis()
        axis.tick_params(labelsize=8)
        axis.locator_params(axis="x", nbins=5)
        axis.spines[["top", "right"]].set_visible(False)
    return figure
