"""A drawing of a scene to scale, as SVG: bodies, walls, structures, solids, obstacles and probes where the section cuts them."""
from html import escape

import numpy as np

from ..errors import Missing
from ..kernel_sum import Grid
from ..mid_plane import simplified
from ..run import AXES, Run
from ..section import Section
from ..shapes import NotDrawable, Shape
from ..units import number

WIDTH = 640.0
CELLS = 700  # along the longer side, for outlines
FILLS = {
    "liquid": "#bcd9f0",
    "charge": "#e8883a",
    "gas": "#f2d08b",
    "structure": "#7d8794",
    "solid": "#9aa3ae",
    "obstacle": "#4d5560",
}


class _Part:
    """Something that is drawn: its name, kind, and outline as lines in the plane [m]."""

    def __init__(self, name: str, kind: str, lines: list[np.ndarray], closed: bool = True):
        self.name, self.kind, self.lines, self.closed = name, kind, lines, closed


def kind_of_body(body: dict) -> str:
    """What a body is drawn as: a charge, a gas, or a liquid."""
    material = body.get("material", {})
    law = str(material.get("law", "")) if isinstance(material, dict) else ""
    if law == "jwl":
        return "charge"
    gaseous = "gas" in law or "gas" in str(material.get("name", "")) or body.get("variable_h") is True
    return "gas" if gaseous else "liquid"


def drawing(run: Run) -> tuple[str, list[tuple[str, str]], list[str]]:
    """The SVG, a legend of (name, colour), and what could not be drawn, in words. Without anything to draw the SVG is empty."""
    if not run.scene or run.is_on_a_line:
        return "", [], []
    shapes, left_out = _shapes(run)
    meshes = _undeformed(run)
    bounds = [shape.bounds for _, _, shape in shapes if np.isfinite(shape.bounds).all()]
    bounds += [(points.min(axis=0), points.max(axis=0)) for points in meshes[1]]
    if not bounds:
        return "", [], left_out
    low, high = np.min([each[0] for each in bounds], axis=0), np.max([each[1] for each in bounds], axis=0)
    section = Section.of(run, np.where([axis in run.setting("symmetry.planes", []) for axis in AXES], 0.0, low), high)
    a, b = low[list(section.axes)], high[list(section.axes)]
    margin = 0.02 * float(np.max(b - a))
    grid = Grid.covering(tuple(a - margin), tuple(b + margin), float(np.max(b - a)) * 1.04 / CELLS)
    parts = [_Part(name, kind, _outline(shape, section, grid, low, high)) for name, kind, shape in shapes]
    parts += [_Part(name, "structure", lines) for name, lines in meshes[0](section)]
    parts = [part for part in parts if part.lines]
    drawn = {part.name for part in parts}
    left_out = [words for name, words in left_out if name not in drawn]
    svg = _svg(run, section, parts, a, b)
    legend = [(part.name, FILLS.get(part.kind, "none")) for part in parts]
    return svg, list(dict.fromkeys(legend)), left_out


def _shapes(run: Run) -> tuple[list[tuple[str, str, Shape]], list[tuple[str, str]]]:
    """Names, kinds and shapes, the largest first, and what has no shape that can be drawn."""
    found, missing = [], []
    every = [(body, kind_of_body(body)) for body in run.tables("bodies")]
    every += [(table, "structure") for table in run.tables("structures")] + [(table, "solid") for table in run.tables("solids")]
    every += [(table, "obstacle") for table in run.tables("obstacles")] + [(table, "wall") for table in run.tables("walls")]
    for table, kind in every:
        name = str(table.get("name", kind))
        try:
            shape = table.get("shape", {})
            taken = [part for part in table.get("subtract", []) if isinstance(part, dict)]
            if taken:
                shape = {"type": "difference", "shapes": [shape, *taken]}
            found.append((name, kind, Shape(shape, run.dimension)))
        except NotDrawable as error:
            missing.append((name, f"'{name}' is not drawn: {error}"))
    order = {"liquid": 0, "gas": 1, "charge": 2, "solid": 3, "structure": 4, "obstacle": 5, "wall": 6}
    return sorted(found, key=lambda each: order[each[1]]), missing


def _undeformed(run: Run):
    """Structures from meshes as they were at the start, from their first snapshot: a function of the section that gives names and
    outlines, and their points."""
    from_files = [table for table in run.tables("structures") if table.get("shape", {}).get("type") == "gmsh"]
    meshes = []
    if from_files:
        try:
            for snapshots in run.structures():
                mesh = snapshots.read(0)
                mesh.points = mesh.points - mesh.point_data.get("displacement", np.zeros_like(mesh.points))
                meshes.append((snapshots.name, mesh))
        except (Missing, IndexError):
            meshes = []
    names = {f"structure_{table.get('name')}": str(table.get("name")) for table in from_files}
    if len(from_files) == 1:
        names["structure"] = str(from_files[0].get("name", "structure"))

    def outlines(section: Section) -> list[tuple[str, list[np.ndarray]]]:
        found = []
        for name, mesh in meshes:
            if name not in names:
                continue
            lines = section.cut_cells(mesh)[0]
            for axis, mirrored in enumerate(section.mirrors()):
                if mirrored:
                    lines = lines + [line * np.where(np.arange(2) == axis, -1.0, 1.0) for line in lines]
            found.append((names[name], lines))
        return found

    return outlines, [mesh.points for name, mesh in meshes if name in names]


def _outline(shape: Shape, section: Section, grid: Grid, low: np.ndarray, high: np.ndarray) -> list[np.ndarray]:
    import contourpy

    u, v = grid.middles()
    points = np.zeros((len(u) * len(v), 3))
    points[:, section.normal] = section.level if section.dimension == 3 else 0.0
    across, up = np.meshgrid(u, v)
    points[:, section.axes[0]], points[:, section.axes[1]] = across.ravel(), up.ravel()
    level = np.pad(shape.level(points).reshape(len(v), len(u)), 1, constant_values=1e9)
    pixel = grid.pixel
    u, v = np.concatenate([[u[0] - pixel], u, [u[-1] + pixel]]), np.concatenate([[v[0] - pixel], v, [v[-1] + pixel]])
    level = np.clip(level, -2 * pixel, 2 * pixel)
    return [simplified(line, 0.02 * pixel) for line in contourpy.contour_generator(u, v, level).lines(0.0)]


# ------------------------------------------------------------------------------------------------ SVG


def _svg(run: Run, section: Section, parts: list[_Part], low: np.ndarray, high: np.ndarray) -> str:
    size = high - low
    scale = min((WIDTH - 110) / size[0], 460 / size[1])
    left, top = (WIDTH - 60 - scale * size[0]) / 2 + 50, 26.0
    height = top + scale * size[1] + 62

    def at(point) -> str:
        return f"{left + (point[0] - low[0]) * scale:.1f} {top + (high[1] - point[1]) * scale:.1f}"

    lines = [
        f'<svg viewBox="0 0 {WIDTH:.0f} {height:.0f}" role="img" font-family="system-ui, sans-serif" font-size="13" '
        f'aria-label="{escape("Drawing of the scene: " + ", ".join(part.name for part in parts))}">'
    ]
    for part in parts:
        path = " ".join("M" + " L".join(at(point) for point in line) + "Z" for line in part.lines)
        if part.kind == "wall":
            lines.append(
                f'<path d="{path}" fill="none" stroke="#1d2433" stroke-width="2.4"><title>{escape(part.name)}</title></path>'
            )
        else:
            lines.append(
                f'<path d="{path}" fill="{FILLS[part.kind]}" fill-rule="evenodd" stroke="#1d2433" stroke-width=".7">'
                f"<title>{escape(part.name)}</title></path>"
            )
    lines += _symmetry_lines(section, low, high, at)
    lines += _probes(run, section, at, low, high)
    lines += _dimensions(section, low, high, left, top, scale)
    return "\n".join([*lines, "</svg>"])


def _symmetry_lines(section: Section, low, high, at) -> list[str]:
    """Chain lines where symmetry planes and the axis of revolution cut the section."""
    ends = []
    across, up = section.mirrors()
    if across and low[0] < 0 < high[0]:
        ends.append(((0.0, low[1]), (0.0, high[1])))
    if up and low[1] < 0 < high[1]:
        ends.append(((low[0], 0.0), (high[0], 0.0)))
    return [
        f'<path d="M{at(a)} L{at(b)}" stroke="#5b6474" stroke-width="1" stroke-dasharray="12 3 2 3" fill="none"/>'
        for a, b in ends
    ]


def _probes(run: Run, section: Section, at, low, high) -> list[str]:
    marks = []
    reach = 0.02 * float(np.max(high - low))
    for probe in run.tables("probes"):
        point = np.resize(np.array(probe.get("point", [0.0]), dtype=float), 3) if "point" in probe else None
        if point is None or (section.dimension == 3 and abs(point[section.normal] - section.level) > reach):
            continue
        x, y = at(point[list(section.axes)]).split()
        marks.append(
            f'<path d="M{x} {y} m-4 -4 l8 8 m0 -8 l-8 8" stroke="#b3261e" stroke-width="1.6" fill="none">'
            f'<title>probe {escape(str(probe.get("name", "")))}</title></path>'
        )
    return marks


def _dimensions(section: Section, low, high, left: float, top: float, scale: float) -> list[str]:
    """The whole length below and the whole height at the left, in mm, with arrows at their ends."""
    size = high - low
    right, bottom = left + scale * size[0], top + scale * size[1]
    y, x = bottom + 22, left - 20
    names = [AXES[axis] for axis in section.axes]
    arrows = (
        '<path d="M{0:.1f} {1:.1f} L{2:.1f} {3:.1f}" stroke="#5b6474" fill="none"/>'
        '<path d="M{0:.1f} {1:.1f} l{4} M{2:.1f} {3:.1f} l{5}" stroke="#5b6474" fill="none"/>'
    )
    return [
        arrows.format(left, y, right, y, "6 -3 m-6 3 l6 3", "-6 -3 m6 3 l-6 3"),
        f'<text x="{(left + right) / 2:.1f}" y="{y + 18:.1f}" text-anchor="middle" fill="#1d2433">{number(1e3 * float(size[0]))} mm '
        f"along {names[0]}</text>",
        arrows.format(x, top, x, bottom, "-3 6 m3 -6 l3 6", "-3 -6 m3 6 l3 -6"),
        f'<text transform="translate({x - 8:.1f} {(top + bottom) / 2:.1f}) rotate(-90)" text-anchor="middle" fill="#1d2433">'
        f"{number(1e3 * float(size[1]))} mm along {names[1]}</text>",
    ]
