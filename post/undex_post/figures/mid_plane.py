"""Pictures of the mid-plane: continuous fields at some times, with structures, obstacles and the surfaces between bodies."""
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path as Outline

from ..errors import Missing
from ..mid_plane import QUANTITIES, Frame, Layer, MidPlane
from ..run import AXES, Run
from ..units import scale_for
from .style import plain, plt

PAPER_TIMES = [15e-6, 30e-6, 45e-6, 60e-6, 75e-6, 90e-6, 105e-6, 120e-6]  # s, of Chen et al.'s pictures
CAVITATED = 1e-3  # void fraction above which water is shown as cavitated


def nearest(times: list[float], wanted: list[float]) -> list[int]:
    """Numbers of the snapshots nearest to the wanted times, each once, none further off than half the gap asked for. Where no times
    are wanted, or none is met: up to eight, evenly spread."""
    slack = 0.5 * min(np.diff(wanted)) if len(wanted) > 1 else np.inf
    chosen = []
    for time in wanted:
        index = int(np.abs(np.array(times) - time).argmin())
        if abs(times[index] - time) <= slack and index not in chosen:
            chosen.append(index)
    return chosen or sorted({int(i) for i in np.linspace(0, len(times) - 1, min(8, len(times)))})


def mid_plane_figure(run: Run, wanted: list[float]) -> Figure | None:
    """The fluid's pressure, cavitated water in white; each time with colours of its own."""
    with MidPlane(run, fluid_fields=("pressure", "void_fraction"), solid_fields=("plastic_strain",)) as plane:
        chosen = nearest(plane.times, wanted)
        frames = [plane.frame(i) for i in chosen]
        if all(frame.fluid is None for frame in frames):
            return None
        if any("pressure" not in frame.fluid.fields for frame in frames):
            raise Missing("the snapshots have no field 'pressure'; add it to output.particle_fields of the scene")
        figure, axes = _axes(plane, len(frames))
        for axis, frame in zip(axes, frames):
            pressure = 1e-6 * frame.fluid.fields["pressure"]
            void = frame.fluid.fields.get("void_fraction", np.zeros_like(pressure))
            wet = np.isfinite(pressure) & (void <= CAVITATED)
            top = max(float(np.quantile(pressure[wet], 0.995)) if wet.any() else 1.0, 1.0)
            shown = _field(axis, plane, frame.fluid, pressure, 0, top, "viridis", white=np.nan_to_num(void))
            _matter(axis, plane, frame)
            _frame(axis, plane, frame.time)
            figure.colorbar(shown, ax=axis, aspect=18, pad=0.01).ax.tick_params(labelsize=7)
        figure.suptitle(
            plain(
                f"{run.label()}\npressure [MPa] in {plane.section.words}, {AXES[plane.section.axes[0]]} to the right, mm; "
                "white: cavitated; grey: structures and solids; white lines: between bodies"
            ),
            fontsize=9.5,
        )
    return figure


def solids_figure(run: Run, wanted: list[float], quantity: str) -> Figure | None:
    """A field of solids in particles, one scale for all times; None where it is zero or not there."""
    with MidPlane(run, fluid_fields=(), solid_fields=(quantity,)) as plane:
        frames = [plane.frame(i) for i in nearest(plane.times, wanted)]
        frames = [frame for frame in frames if frame.solids is not None and quantity in frame.solids.fields]
        known = [frame.solids.fields[quantity][np.isfinite(frame.solids.fields[quantity])] for frame in frames]
        known = np.concatenate(known) if known else np.zeros(0)
        if not known.any():
            return None
        label, unit, _ = QUANTITIES[quantity]
        top = float(np.quantile(known, 0.998)) or float(known.max())
        factor, shown_unit = scale_for(unit, top)
        figure, axes = _axes(plane, len(frames))
        for axis, frame in zip(axes, frames):
            shown = _field(axis, plane, frame.solids, factor * frame.solids.fields[quantity], 0, factor * top, "inferno")
            _frame(axis, plane, frame.time)
        figure.colorbar(shown, ax=list(axes), aspect=30, pad=0.01).ax.tick_params(labelsize=7)
        figure.suptitle(
            plain(
                f"{run.label()}\n{label}{f' [{shown_unit}]' if shown_unit else ''} in {plane.section.words}, "
                f"{AXES[plane.section.axes[0]]} to the right, mm"
            ),
            fontsize=9.5,
        )
    return figure


# ------------------------------------------------------------------------------------------------ parts of a picture


def _box(plane: MidPlane) -> tuple[list[float], list[float]]:
    """Lowest and highest place of the whole picture [mm]."""
    low, high = [1e3 * x for x in plane.grid.low], [1e3 * x for x in plane.grid.high]
    return [-h if mirrored else l for l, h, mirrored in zip(low, high, plane.section.mirrors())], high


def _axes(plane: MidPlane, count: int) -> tuple[Figure, np.ndarray]:
    low, high = _box(plane)
    aspect = (high[1] - low[1]) / (high[0] - low[0])
    columns = min(2 if aspect < 0.6 else 4, count)
    rows = -(-count // columns)
    width = min(14, 8 * columns)
    figure, axes = plt.subplots(
        rows,
        columns,
        squeeze=False,
        layout="constrained",
        figsize=(width, (width / columns - 1.2) * aspect * rows + 0.45 * rows + 0.6),
    )
    for axis in axes.flat[count:]:
        axis.remove()
    return figure, axes.flat[:count]


def _frame(axis: Axes, plane: MidPlane, time: float) -> None:
    low, high = _box(plane)
    margin = 0.02 * max(high[0] - low[0], high[1] - low[1])
    axis.set(
        xlim=(low[0] - margin, high[0] + margin),
        ylim=(low[1] - margin, high[1] + margin),
        aspect="equal",
        title=f"{1e6 * time:.1f} µs",
    )
    axis.set_facecolor("0.93")
    axis.tick_params(labelsize=7)


def _mirrors(plane: MidPlane) -> list[np.ndarray]:
    """The factors of the two coordinates that make the whole picture of the computed part."""
    across, up = plane.section.mirrors()
    return [np.array([a, b]) for a in ((1, -1) if across else (1,)) for b in ((1, -1) if up else (1,))]


def _field(
    axis: Axes,
    plane: MidPlane,
    layer: Layer,
    values: np.ndarray,
    low: float,
    high: float,
    colours: str,
    white: np.ndarray | None = None,
):
    """The field within the outlines of its material, white where `white` is above CAVITATED, and the surfaces between bodies."""
    shown = None
    (left, bottom), (right, top) = plane.grid.low, plane.grid.high
    for factors in _mirrors(plane):
        outlines = [1e3 * factors * line for line in layer.outlines]
        if not outlines:
            continue
        codes = [
            code for line in outlines for code in [Outline.MOVETO] + [Outline.LINETO] * (len(line) - 2) + [Outline.CLOSEPOLY]
        ]
        patch = PathPatch(Outline(np.concatenate(outlines), codes), facecolor="none", edgecolor="none", transform=axis.transData)
        axis.add_patch(patch)
        extent = [1e3 * factors[0] * left, 1e3 * factors[0] * right, 1e3 * factors[1] * bottom, 1e3 * factors[1] * top]
        shown = axis.imshow(
            np.nan_to_num(values),
            extent=extent,
            origin="lower",
            vmin=low,
            vmax=high,
            cmap=colours,
            interpolation="bilinear",
            zorder=1.5,
        )
        shown.set_clip_path(patch)
        if white is not None and (white > CAVITATED).any():
            # Up to a cell beyond the edges, so that no seam shows where images meet.
            u, v = (
                np.concatenate([each[:1] - plane.grid.pixel, each, each[-1:] + plane.grid.pixel]) for each in plane.grid.middles()
            )
            holes = axis.contourf(
                1e3 * factors[0] * u,
                1e3 * factors[1] * v,
                np.pad(white, 1, mode="edge"),
                levels=[CAVITATED, 2.0],
                colors="white",
                zorder=1.6,
            )
            for collection in holes.collections:
                collection.set_clip_path(patch)
    lines = [1e3 * factors * line for line in layer.interfaces for factors in _mirrors(plane)]
    axis.add_collection(LineCollection(lines, colors="0.1", linewidths=1.3, zorder=3))
    axis.add_collection(LineCollection(lines, colors="white", linewidths=0.7, zorder=3))
    return shown if shown is not None else axis.imshow(np.full((1, 1), np.nan), vmin=low, vmax=high, cmap=colours)


def _matter(axis: Axes, plane: MidPlane, frame: Frame) -> None:
    """Structures and solids in grey, obstacles as lines."""
    for factors in _mirrors(plane):
        for cut in frame.structures:
            axis.add_collection(
                PolyCollection(
                    [1e3 * factors * polygon for polygon in cut.polygons],
                    facecolors="0.45",
                    edgecolors="0.2",
                    linewidths=0.2,
                    zorder=4,
                )
            )
        axis.add_collection(
            LineCollection([1e3 * factors * segment for segment in frame.obstacles], colors="black", linewidths=1.0, zorder=4)
        )
        if frame.solids is not None:
            axis.add_collection(
                PolyCollection(
                    [1e3 * factors * line for line in frame.solids.outlines],
                    facecolors="0.45",
                    edgecolors="0.2",
                    linewidths=0.3,
                    zorder=4,
                )
            )
