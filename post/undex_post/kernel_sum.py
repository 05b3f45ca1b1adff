"""Kernel sums of particles onto a regular grid of a plane: the continuous field that the particles stand for.

    grid = Grid.covering(low=(0, 0), high=(0.1, 0.05), pixel=0.0005)
    cloud = Cloud(points, offset, h, volume)
    values, filling = shepard(cloud, {"pressure": p}, grid, kernel_named("wendland_c2"), dimension=3)

Arrays on the grid have a row per place of the second coordinate, as pictures have.
"""
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from .kernels import Kernel

PAIRS_AT_A_TIME = 1_500_000  # bounds the memory of a sum


@dataclass(frozen=True)
class Grid:
    """Square cells of size `pixel`; values are those at their middles."""
    low: tuple[float, float]
    columns: int
    rows: int
    pixel: float

    @staticmethod
    def covering(low: tuple[float, float], high: tuple[float, float], pixel: float) -> "Grid":
        """The least grid from `low` that reaches `high`."""
        count = [max(1, int(np.ceil((high[k] - low[k]) / pixel - 1e-6))) for k in range(2)]
        return Grid((float(low[0]), float(low[1])), count[0], count[1], float(pixel))

    @property
    def high(self) -> tuple[float, float]:
        return self.low[0] + self.columns * self.pixel, self.low[1] + self.rows * self.pixel

    def middles(self) -> tuple[np.ndarray, np.ndarray]:
        """Coordinates of the columns' and of the rows' middles."""
        return (self.low[0] + (np.arange(self.columns) + 0.5) * self.pixel,
                self.low[1] + (np.arange(self.rows) + 0.5) * self.pixel)


@dataclass
class Cloud:
    """Particles near a plane: places in it (n, 2), distances from it (n,), smoothing lengths and volumes (areas in 2D)."""
    points: np.ndarray
    offset: np.ndarray
    h: np.ndarray
    volume: np.ndarray

    def __getitem__(self, which: np.ndarray) -> "Cloud":
        return Cloud(self.points[which], self.offset[which], self.h[which], self.volume[which])

    @staticmethod
    def joined(clouds: list["Cloud"]) -> "Cloud":
        parts = [[getattr(cloud, name) for cloud in clouds] for name in ("points", "offset", "h", "volume")]
        return Cloud(*(np.concatenate(part) for part in parts))


@dataclass
class _Pairs:
    """Grid cells and particles that see each other: flat index of the cell, index of the particle, W, and the way from cell to
    particle."""
    cell: np.ndarray
    particle: np.ndarray
    weight: np.ndarray
    way: tuple[np.ndarray, np.ndarray]


def _pairs(cloud: Cloud, grid: Grid, kernel: Kernel, dimension: int) -> Iterator[_Pairs]:
    """All pairs, in portions. Particles whose windows are equally wide go together."""
    reach = np.sqrt(np.maximum((kernel.support * cloud.h) ** 2 - cloud.offset**2, 0.0))
    place = (cloud.points - np.array(grid.low)) / grid.pixel - 0.5  # in cells; whole numbers are middles
    half = reach / grid.pixel
    seen = (reach > 0) & np.all(place + half[:, None] >= 0, axis=1)
    seen &= (place[:, 0] - half <= grid.columns - 1) & (place[:, 1] - half <= grid.rows - 1)
    # Widths grow by a factor of sqrt(2), so that there are few groups.
    width = np.where(seen, np.ceil(2 ** (np.ceil(2 * np.log2(2 * half + 1)) / 2)), 0).astype(int)
    for size in np.unique(width[seen]):
        group = np.flatnonzero(width == size)
        portion = max(1, PAIRS_AT_A_TIME // int(size) ** 2)
        steps = np.arange(size)
        for first in range(0, len(group), portion):
            mine = group[first:first + portion]
            corner = np.ceil(place[mine] - half[mine, None]).astype(int)
            column, row = corner[:, 0, None] + steps, corner[:, 1, None] + steps
            du = (place[mine, 0, None] - column) * grid.pixel
            dv = (place[mine, 1, None] - row) * grid.pixel
            square = du[:, None, :] ** 2 + dv[:, :, None] ** 2 + cloud.offset[mine, None, None] ** 2
            inside = square < (kernel.support * cloud.h[mine, None, None]) ** 2
            inside &= ((column >= 0) & (column < grid.columns))[:, None, :] & ((row >= 0) & (row < grid.rows))[:, :, None]
            which, v, u = np.nonzero(inside)
            particle = mine[which]
            weight = kernel(np.sqrt(square[inside]), cloud.h[particle], dimension)
            yield _Pairs(row[which, v] * grid.columns + column[which, u], particle, weight, (du[which, u], dv[which, v]))


def _scattered(pairs: _Pairs, values: np.ndarray, grid: Grid) -> np.ndarray:
    return np.bincount(pairs.cell, values, minlength=grid.rows * grid.columns)


def kernel_sum(cloud: Cloud, quantity: np.ndarray, grid: Grid, kernel: Kernel, dimension: int) -> np.ndarray:
    """Sum of quantity W: with masses the density, with volumes the filling (1 inside, 1/2 on a flat surface)."""
    total = np.zeros(grid.rows * grid.columns)
    for pairs in _pairs(cloud, grid, kernel, dimension):
        total += _scattered(pairs, quantity[pairs.particle] * pairs.weight, grid)
    return total.reshape(grid.rows, grid.columns)


def shepard(cloud: Cloud, values: dict[str, np.ndarray], grid: Grid, kernel: Kernel,
            dimension: int) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """Normalised sums (sum of V f W)/(sum of V W), and the filling, the sum of V W. They reproduce constant fields. Where no
    particle reaches, values are nan."""
    filling = np.zeros(grid.rows * grid.columns)
    sums = {name: np.zeros_like(filling) for name in values}
    for pairs in _pairs(cloud, grid, kernel, dimension):
        weight = cloud.volume[pairs.particle] * pairs.weight
        filling += _scattered(pairs, weight, grid)
        for name, total in sums.items():
            total += _scattered(pairs, weight * values[name][pairs.particle], grid)
    shape = grid.rows, grid.columns
    with np.errstate(invalid="ignore", divide="ignore"):
        return {name: (total / filling).reshape(shape) for name, total in sums.items()}, filling.reshape(shape)


def linear(cloud: Cloud, values: dict[str, np.ndarray], grid: Grid, kernel: Kernel,
           dimension: int) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """Moving least squares of first order, and the filling. They reproduce linear fields, also beside surfaces. Where too few
    particles reach for a slope, the values are Shepard's."""
    size = 3 if dimension == 2 else 4
    count = grid.rows * grid.columns
    moments = np.zeros((size, size, count))
    sums = {name: np.zeros((size, count)) for name in values}
    for pairs in _pairs(cloud, grid, kernel, dimension):
        weight = cloud.volume[pairs.particle] * pairs.weight
        h = cloud.h[pairs.particle]
        basis = [np.ones_like(h), pairs.way[0] / h, pairs.way[1] / h, cloud.offset[pairs.particle] / h][:size]
        for i in range(size):
            for k in range(i, size):
                moments[i, k] += _scattered(pairs, weight * basis[i] * basis[k], grid)
                moments[k, i] = moments[i, k]
            for name, total in sums.items():
                total[i] += _scattered(pairs, weight * basis[i] * values[name][pairs.particle], grid)
    filling = moments[0, 0].copy()
    matrices = np.moveaxis(moments, 2, 0) / np.maximum(filling, 1e-300)[:, None, None]
    sound = np.abs(np.linalg.det(matrices)) > 1e-6
    first = np.zeros((count, size))
    first[:, 0] = 1.0
    first[sound] = np.linalg.inv(matrices[sound])[:, 0]
    shape = grid.rows, grid.columns
    with np.errstate(invalid="ignore", divide="ignore"):
        fields = {name: ((first * total.T).sum(axis=1) / filling).reshape(shape) for name, total in sums.items()}
    return fields, filling.reshape(shape)
