"""Shapes of a scene as level functions: negative inside, zero on the surface, growing about as the distance does."""
from collections.abc import Callable

import numpy as np

from .run import AXES

Level = Callable[[np.ndarray], np.ndarray]  # of points (n, 3)
UNBOUNDED = (np.full(3, -np.inf), np.full(3, np.inf))


class NotDrawable(Exception):
    """A shape that has no level function here: a mesh or an STL file."""


def _vector(value, fill: float = 0.0) -> np.ndarray:
    given = np.atleast_1d(np.array(value, dtype=float))[:3]
    return np.concatenate([given, np.full(3 - len(given), fill)])


class Shape:
    """A shape of resolved.toml: its level function and its bounds (low, high). In two dimensions what it has along z is left out."""

    def __init__(self, table: dict, dimension: int | str = 3):
        kind = table.get("type")
        maker = _MAKERS.get(kind)
        if maker is None:
            raise NotDrawable(f'a shape of the type "{kind}" comes from a file')
        try:
            self.level, self.bounds = maker(table, dimension)
            self._turn_and_move(table)
        except (KeyError, TypeError, ValueError, IndexError) as error:
            raise NotDrawable(f'a shape of the type "{kind}" without what it needs ({error})') from error

    def _turn_and_move(self, table: dict) -> None:
        turn, move = table.get("rotate", 0.0), _vector(table.get("move", 0.0))
        vector = np.array([0.0, 0.0, float(turn)]) if np.ndim(turn) == 0 else _vector(turn)
        if not vector.any() and not move.any():
            return
        low, high = self.bounds
        middle = (low + high) / 2 if np.isfinite(low).all() and np.isfinite(high).all() else np.zeros(3)
        about = _vector(table["about"]) if "about" in table else middle
        matrix, level = _rotation(np.radians(vector)), self.level
        self.level = lambda points: level((points - move - about) @ matrix + about)
        if np.isfinite(low).all() and np.isfinite(high).all():
            corners = np.array(np.meshgrid(*zip(low, high))).reshape(3, -1).T
            turned = (corners - about) @ matrix.T + about + move
            self.bounds = turned.min(axis=0), turned.max(axis=0)


def _rotation(vector: np.ndarray) -> np.ndarray:
    angle = float(np.linalg.norm(vector))
    if angle == 0:
        return np.eye(3)
    x, y, z = vector / angle
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def _box(table: dict, dimension) -> tuple[Level, tuple]:
    low, high = _vector(table["low"], -np.inf), _vector(table["high"], np.inf)
    if dimension == 2:
        low[2], high[2] = -np.inf, np.inf
    used = np.isfinite(low)
    return (
        lambda p: np.maximum(low[used] - p[:, used], p[:, used] - high[used]).max(axis=1),
        (np.where(used, low, 0.0), np.where(used, high, 0.0)),
    )


def _slab(table: dict, _) -> tuple[Level, tuple]:
    axis, low, high = AXES.index(table["axis"]), float(table["low"]), float(table["high"])
    return lambda p: np.maximum(low - p[:, axis], p[:, axis] - high), UNBOUNDED


def _ellipsoid(table: dict, dimension) -> tuple[Level, tuple]:
    center = _vector(table.get("center", 0.0))
    size = _vector(table["semi_axes"], 1.0) if "semi_axes" in table else np.full(3, float(table["radius"]))
    flat = np.array([1.0, 1.0, 0.0]) if dimension == 2 else np.ones(3)
    return (
        lambda p: (np.linalg.norm((p - center) / size * flat, axis=1) - 1) * size.min(),
        (center - size * flat, center + size * flat),
    )


def _round(
    table: dict,
    dimension,
    inner: Callable[[np.ndarray], np.ndarray] | None,
    outer: Callable[[np.ndarray], np.ndarray],
    largest: float,
) -> tuple[Level, tuple]:
    """What lies between two radii that may change along the axis."""
    axis, center = AXES.index(table.get("axis", "z")), _vector(table.get("center", 0.0))
    low, high = float(table.get("low", -np.inf)), float(table.get("high", np.inf))
    across = [d for d in range(3) if d != axis and not (dimension == 2 and d == 2)]
    ends = not (dimension == 2 and axis == 2)

    def level(p: np.ndarray) -> np.ndarray:
        radius = np.linalg.norm(p[:, across] - center[across], axis=1)
        parts = [radius - outer(p[:, axis])]
        if inner is not None:
            parts.append(inner(p[:, axis]) - radius)
        if ends:
            parts += [low - p[:, axis], p[:, axis] - high]
        return np.max(parts, axis=0)

    bounds = np.array([center, center])
    bounds[0, across] -= largest
    bounds[1, across] += largest
    if ends:
        bounds[:, axis] = low, high
    return level, (bounds[0], bounds[1])


def _cylinder(table: dict, dimension) -> tuple[Level, tuple]:
    radius = float(table["radius"])
    return _round(table, dimension, None, lambda z: np.full_like(z, radius), radius)


def _tube(table: dict, dimension) -> tuple[Level, tuple]:
    inner, outer = float(table["inner_radius"]), float(table["outer_radius"])
    return _round(table, dimension, lambda z: np.full_like(z, inner), lambda z: np.full_like(z, outer), outer)


def _cone(table: dict, dimension) -> tuple[Level, tuple]:
    ends = [float(table["low"]), float(table["high"])]
    radii = [float(table["low_radius"]), float(table["high_radius"])]
    slope = (radii[1] - radii[0]) / (ends[1] - ends[0])
    return _round(table, dimension, None, lambda z: radii[0] + slope * (z - ends[0]), max(radii))


def _half_space(table: dict, _) -> tuple[Level, tuple]:
    point, normal = _vector(table.get("point", 0.0)), _vector(table["normal"])
    normal = normal / np.linalg.norm(normal)
    return lambda p: (p - point) @ normal, UNBOUNDED


def _revolution(table: dict, dimension) -> tuple[Level, tuple]:
    axis, center = AXES.index(table.get("axis", "z")), _vector(table.get("center", 0.0))
    corners = np.array(table["points"], dtype=float)
    across = [d for d in range(3) if d != axis and not (dimension == 2 and d == 2)]
    ends = np.roll(corners, -1, axis=0)

    def level(p: np.ndarray) -> np.ndarray:
        at = np.stack([np.linalg.norm(p[:, across] - center[across], axis=1), p[:, axis]], axis=1)
        inside = np.zeros(len(at), dtype=bool)
        distance = np.full(len(at), np.inf)
        for a, b in zip(corners, ends):
            way = b - a
            share = np.clip(((at - a) @ way) / max(way @ way, 1e-300), 0, 1)
            distance = np.minimum(distance, np.linalg.norm(at - a - share[:, None] * way, axis=1))
            if a[1] != b[1]:
                passed = (a[1] > at[:, 1]) != (b[1] > at[:, 1])
                inside ^= passed & (at[:, 0] < a[0] + (at[:, 1] - a[1]) / (b[1] - a[1]) * way[0])
        return np.where(inside, -distance, distance)

    bounds = np.array([center, center])
    bounds[0, across] -= corners[:, 0].max()
    bounds[1, across] += corners[:, 0].max()
    bounds[:, axis] = corners[:, 1].min(), corners[:, 1].max()
    return level, (bounds[0], bounds[1])


def _combined(table: dict, dimension) -> tuple[Level, tuple]:
    shapes = [Shape(part, dimension) for part in table["shapes"]]
    kind = table["type"]
    lows, highs = np.array([shape.bounds[0] for shape in shapes]), np.array([shape.bounds[1] for shape in shapes])
    if kind == "union":
        return lambda p: np.min([shape.level(p) for shape in shapes], axis=0), (lows.min(axis=0), highs.max(axis=0))
    if kind == "intersection":
        return lambda p: np.max([shape.level(p) for shape in shapes], axis=0), (lows.max(axis=0), highs.min(axis=0))
    return (lambda p: np.max([shapes[0].level(p)] + [-shape.level(p) for shape in shapes[1:]], axis=0), shapes[0].bounds)


_MAKERS = {
    "box": _box,
    "plate": _box,
    "slab": _slab,
    "sphere": _ellipsoid,
    "ellipsoid": _ellipsoid,
    "cylinder": _cylinder,
    "rod": _cylinder,
    "tube": _tube,
    "ring": _tube,
    "cone": _cone,
    "half_space": _half_space,
    "revolution": _revolution,
    "union": _combined,
    "intersection": _combined,
    "difference": _combined,
}
