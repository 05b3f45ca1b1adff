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

PAIRS_AT_A_TIME = 100_000  # small enough for the processor's caches


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
        return (
            self.low[0] + (np.arange(self.columns) + 0.5) * self.pixel,
            self.low[1] + (np.arange(self.rows) + 0.5) * self.pixel,
        )


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
class _Windows:
    """Square windows of cells about some particles: flat indices of the cells in the padded grid and W (n, size, size), numbers of
    the particles (n,), and the way from cell to particle along both axes."""

    cell: np.ndarray
    weight: np.ndarray
    particle: np.ndarray
    way: tuple[np.ndarray, np.ndarray]

    def add(self, total: "_Total", quantity: np.ndarray, basis: np.ndarray | float = 1.0) -> None:
        """Adds quantity times W (times a function of the way) of each particle to the cells."""
        values = self.weight * quantity[self.particle, None, None] * basis
        total.flat += np.bincount(self.cell.ravel(), values.ravel(), minlength=len(total.flat))


class _Total:
    """A sum on the grid, padded so that no window ends outside."""

    def __init__(self, grid: Grid, pad: int):
        self._grid, self._pad = grid, pad
        self.flat = np.zeros((grid.rows + 2 * pad) * (grid.columns + 2 * pad))

    @property
    def inner(self) -> np.ndarray:
        pad = self._pad
        whole = self.flat.reshape(self._grid.rows + 2 * pad, self._grid.columns + 2 * pad)
        return whole[pad : pad + self._grid.rows, pad : pad + self._grid.columns]


class _Scatter:
    """The windows of all particles that reach the grid, in portions of equal size."""

    def __init__(self, cloud: Cloud, grid: Grid, kernel: Kernel, dimension: int):
        self._cloud, self._grid, self._kernel, self._dimension = cloud, grid, kernel, dimension
        reach = np.sqrt(np.maximum((kernel.support * cloud.h) ** 2 - cloud.offset**2, 0.0))
        self._place = (cloud.points - np.array(grid.low)) / grid.pixel - 0.5  # in cells; whole numbers are middles
        self._half = reach / grid.pixel
        seen = (reach > 0) & np.all(self._place + self._half[:, None] >= 0, axis=1)
        seen &= np.all(self._place - self._half[:, None] <= np.array([grid.columns, grid.rows]) - 1, axis=1)
        # Sizes grow by steps of a fifth, so that there are few groups.
        size = np.ceil(1.2 ** np.ceil(np.log(2 * self._half + 1) / np.log(1.2))).astype(int)
        self._size = np.where(seen, size, 0)
        self.pad = int(self._size.max(initial=1)) + 1

    def total(self) -> _Total:
        return _Total(self._grid, self.pad)

    def __iter__(self) -> Iterator[_Windows]:
        for size in np.unique(self._size[self._size > 0]):
            group = np.flatnonzero(self._size == size)
            portion = max(1, PAIRS_AT_A_TIME // int(size) ** 2)
            for first in range(0, len(group), portion):
                yield self._windows(group[first : first + portion], np.arange(size))

    def _windows(self, mine: np.ndarray, steps: np.ndarray) -> _Windows:
        grid, place = self._grid, self._place[mine]
        corner = np.ceil(place - self._half[mine, None]).astype(int)
        column, row = corner[:, 0, None] + steps, corner[:, 1, None] + steps
        du, dv = (place[:, 0, None] - column) * grid.pixel, (place[:, 1, None] - row) * grid.pixel
        distance = np.sqrt((du**2)[:, None, :] + (dv**2 + self._cloud.offset[mine, None] ** 2)[:, :, None])
        weight = self._kernel(distance, self._cloud.h[mine, None, None], self._dimension)
        cell = ((row + self.pad) * (grid.columns + 2 * self.pad))[:, :, None] + (column + self.pad)[:, None, :]
        return _Windows(cell, weight, mine, (du[:, None, :], dv[:, :, None]))


def kernel_sum(cloud: Cloud, quantity: np.ndarray, grid: Grid, kernel: Kernel, dimension: int) -> np.ndarray:
    """Sum of quantity W: with masses the density, with volumes the filling (1 inside, 1/2 on a flat surface)."""
    scatter = _Scatter(cloud, grid, kernel, dimension)
    total = scatter.total()
    for windows in scatter:
        windows.add(total, quantity)
    return total.inner


def shepard(
    cloud: Cloud, values: dict[str, np.ndarray], grid: Grid, kernel: Kernel, dimension: int
) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """Normalised sums (sum of V f W)/(sum of V W), and the filling, the sum of V W. They reproduce constant fields. Where no
    particle reaches, values are nan."""
    scatter = _Scatter(cloud, grid, kernel, dimension)
    filling, sums = scatter.total(), {name: scatter.total() for name in values}
    for windows in scatter:
        windows.add(filling, cloud.volume)
        for name, total in sums.items():
            windows.add(total, cloud.volume * values[name])
    with np.errstate(invalid="ignore", divide="ignore"):
        return {name: total.inner / filling.inner for name, total in sums.items()}, filling.inner


def linear(
    cloud: Cloud, values: dict[str, np.ndarray], grid: Grid, kernel: Kernel, dimension: int
) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """Moving least squares of first order, and the filling. They reproduce linear fields, also beside surfaces. Where too few
    particles reach for a slope, the values are Shepard's. In three dimensions the particles on both sides of the plane are needed.
    """
    size = 3 if dimension == 2 else 4
    scatter = _Scatter(cloud, grid, kernel, dimension)
    moments = {(i, k): scatter.total() for i in range(size) for k in range(i, size)}
    sums = {name: [scatter.total() for _ in range(size)] for name in values}
    for windows in scatter:
        h = cloud.h[windows.particle, None, None]
        basis = [1.0, windows.way[0] / h, windows.way[1] / h, cloud.offset[windows.particle, None, None] / h][:size]
        for (i, k), total in moments.items():
            windows.add(total, cloud.volume, basis[i] * basis[k])
        for name, totals in sums.items():
            for i, total in enumerate(totals):
                windows.add(total, cloud.volume * values[name], basis[i])
    filling = moments[0, 0].inner
    matrices = np.empty((*filling.shape, size, size))
    for (i, k), total in moments.items():
        matrices[..., i, k] = matrices[..., k, i] = total.inner / np.maximum(filling, 1e-300)
    sound = np.abs(np.linalg.det(matrices)) > 1e-6
    first = np.zeros((*filling.shape, size))
    first[..., 0] = 1.0
    first[sound] = np.linalg.inv(matrices[sound])[..., 0]
    with np.errstate(invalid="ignore", divide="ignore"):
        fields = {
            name: sum(first[..., i] * total.inner for i, total in enumerate(totals)) / filling for name, totals in sums.items()
        }
    return fields, filling
