"""The plane of a scene that is shown, and what it cuts."""
from dataclasses import dataclass

import numpy as np

from .run import AXES, Run
from .snapshots import Mesh

HEXAHEDRON_EDGES = np.array([(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)])


@dataclass(frozen=True)
class Section:
    """A plane across the axis `normal` at the coordinate `level`; `axes` are drawn to the right and upwards. Across the axes of
    `mirror` only the positive half is computed. `dimension` is that of the kernel sums: 2 in a plane scene or a meridian, else 3.
    """

    axes: tuple[int, int]
    normal: int
    level: float
    mirror: frozenset[int]
    dimension: int

    @staticmethod
    def of(run: Run, low: np.ndarray, high: np.ndarray, along: int | None = None) -> "Section":
        """The section of a run whose matter lies between `low` and `high` (3,): it contains the axis `along`, else the axis of
        revolution or the longest one, drawn to the right; in three dimensions it passes through the charge's middle."""
        mirror = {AXES.index(p) for p in run.setting("symmetry.planes", []) if p in tuple(AXES)}
        size = np.array([2 * high[d] if d in mirror else high[d] - low[d] for d in range(3)])
        gravity = np.abs(np.resize(np.array(run.setting("gravity", [0.0]), dtype=float), 3))
        upright = int(gravity.argmax()) if gravity.max() > 0 else None
        if run.dimension == "axisymmetric":
            right = AXES.index(run.setting("axis", "z"))
            radial = 0 if right != 0 else 1
            axes = (radial, right) if upright == right else (right, radial)
            return Section(axes, 3 - right - radial, 0.0, frozenset(mirror & {right} | {radial}), 2)
        if run.dimension == 2:
            right = 1 - upright if upright in (0, 1) else 0 if size[0] >= size[1] else 1
            return Section((right, 1 - right), 2, 0.0, frozenset(mirror & {0, 1}), 2)
        right = int(size.argmax()) if along is None else along
        normal = min((d for d in (1, 2, 0) if d not in (right, upright)), key=lambda d: d not in mirror)
        up = 3 - right - normal
        if upright == right:
            right, up = up, right
        return Section((right, up), normal, _level(run, normal, low, high, mirror), frozenset(mirror), 3)

    @property
    def words(self) -> str:
        """Which plane this is."""
        if self.dimension == 2:
            return f"the plane of {AXES[self.axes[0]]} and {AXES[self.axes[1]]}"
        return f"the plane {AXES[self.normal]} = {1e3 * self.level:g} mm" if self.level else f"the plane {AXES[self.normal]} = 0"

    def mirrors(self) -> tuple[bool, bool]:
        """Are the images across the axis to the right and the axis upwards to be drawn too?"""
        return self.axes[0] in self.mirror, self.axes[1] in self.mirror

    def weight_of_images(self) -> float:
        """Particles beside a symmetry plane that is shown count twice: their images lie behind it."""
        return 2.0 if self.dimension == 3 and self.normal in self.mirror else 1.0

    def in_plane(self, points: np.ndarray) -> np.ndarray:
        return points[:, self.axes]

    def distance(self, points: np.ndarray) -> np.ndarray:
        """Distance from the plane; zero in a plane scene."""
        return points[:, self.normal] - self.level if self.dimension == 3 else np.zeros(len(points))

    # ------------------------------------------------------------------------------------------------ meshes

    def cut_cells(self, mesh: Mesh) -> tuple[list[np.ndarray], np.ndarray]:
        """The polygons in which the plane cuts a mesh of hexahedra (or touches it), and the numbers of their cells; of a mesh of
        quadrangles in a meridian or plane scene all of them, of surfaces in space nothing."""
        cells = mesh.cells
        if self.dimension == 2:
            flat = [i for i, cell in enumerate(cells) if len(cell) in (3, 4)]
            return [self.in_plane(mesh.points[cells[i]]) for i in flat], np.array(flat, dtype=int)
        solid = np.array([i for i, cell in enumerate(cells) if len(cell) == 8], dtype=int)
        if not len(solid):
            return [], solid
        corners = np.stack([cells[i] for i in solid])
        height = mesh.points[:, self.normal]
        level = self._cutting_level(np.ptp(height[corners], axis=1))
        passed = (height[corners].min(axis=1) <= level) & (height[corners].max(axis=1) > level)
        polygons, numbers = [], []
        for number, cell in zip(solid[passed], corners[passed]):
            ends = self._crossings(mesh.points, cell[HEXAHEDRON_EDGES[:, 0]], cell[HEXAHEDRON_EDGES[:, 1]], level)
            if len(ends) >= 3:
                polygons.append(ends[np.argsort(np.arctan2(*(ends - ends.mean(axis=0)).T))])
                numbers.append(number)
        return polygons, np.array(numbers, dtype=int)

    def cut_surface(self, mesh: Mesh) -> list[np.ndarray]:
        """The segments in which the plane cuts a surface of quadrangles; of a surface of segments all."""
        height = mesh.points[:, self.normal]
        faces = mesh.cells
        level = self._cutting_level(np.array([np.ptp(height[face]) for face in faces if len(face) > 2] or [0.0]))
        segments = []
        for face in faces:
            ends = (
                self.in_plane(mesh.points[face])
                if len(face) == 2
                else self._crossings(mesh.points, face, np.roll(face, -1), level)
            )
            if len(ends) == 2:
                segments.append(ends)
        return segments

    def _cutting_level(self, spans: np.ndarray) -> float:
        """On a symmetry plane the first layer only touches the plane: it is cut a little way in."""
        return self.level + 1e-3 * float(np.median(spans)) if len(spans) else self.level

    def _crossings(self, points: np.ndarray, a: np.ndarray, b: np.ndarray, level: float) -> np.ndarray:
        height = points[:, self.normal]
        crossed = (height[a] <= level) != (height[b] <= level)
        a, b = a[crossed], b[crossed]
        share = ((level - height[a]) / (height[b] - height[a]))[:, None]
        return self.in_plane(points[a] + share * (points[b] - points[a]))


def _level(run: Run, normal: int, low: np.ndarray, high: np.ndarray, mirror: set[int]) -> float:
    """The charge's middle across the plane, else zero where that is inside, else the middle."""
    if normal in mirror:
        return 0.0
    for body in run.tables("bodies"):
        shape = body.get("shape", {})
        if "burn" in body and isinstance(shape, dict) and isinstance(shape.get("center"), list) and len(shape["center"]) == 3:
            return float(shape["center"][normal])
    return 0.0 if low[normal] < 0 < high[normal] else float(low[normal] + high[normal]) / 2
