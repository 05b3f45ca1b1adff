"""Figures of panels of curves."""
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..histories import Panel, axis_label
from .style import COLOURS, LINES, MARKERS, plain, plt


def draw_panel(axis: Axes, panel: Panel) -> None:
    """One panel, in the units that suit it."""
    scaled = panel.scaled()
    runs, references = 0, 0
    for curve in scaled.curves:
        if curve.kind == "points":
            style = dict(
                ls="", marker=MARKERS[references % len(MARKERS)], ms=5, mfc="none", color=COLOURS[(1 + references) % len(COLOURS)]
            )
            if curve.run is not None:
                style = dict(ls="", marker=".", ms=2.5, color=COLOURS[runs % len(COLOURS)], rasterized=True)
        elif curve.run is None:
            style = dict(color="0.4", lw=1.1, ls=LINES[1 + references % 3])
        else:
            style = dict(color=COLOURS[runs % len(COLOURS)], ls=LINES[runs // len(COLOURS) % len(LINES)], lw=1.3)
        runs, references = runs + (curve.run is not None), references + (curve.run is None)
        axis.plot(curve.x, curve.y, label=plain(curve.label), **style)
    axis.set(xlabel=axis_label(scaled.x_label, scaled.x_unit), ylabel=plain(axis_label(scaled.quantity, scaled.unit)))
    axis.set_title(plain(panel.title), fontsize=10, loc="left")
    axis.grid(alpha=0.3)
    axis.spines[["top", "right"]].set_visible(False)
    if len(scaled.curves) > 1 or scaled.curves[0].label != panel.quantity:
        axis.legend(fontsize=7.5, frameon=False, ncol=2 if len(scaled.curves) > 6 else 1)


def figure_of(panels: list[Panel], title: str, columns: int = 2) -> Figure | None:
    """All panels in one figure, or None where there are none."""
    if not panels:
        return None
    columns = min(columns, len(panels))
    rows = -(-len(panels) // columns)
    figure, axes = plt.subplots(
        rows, columns, figsize=(max(6.0 * columns, 8.0), 3.3 * rows + 0.5), squeeze=False, layout="constrained"
    )
    for axis in axes.flat[len(panels) :]:
        axis.remove()
    for axis, panel in zip(axes.flat, panels):
        draw_panel(axis, panel)
    figure.suptitle(plain(title), fontsize=11)
    return figure
