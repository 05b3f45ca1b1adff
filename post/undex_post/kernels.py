"""Smoothing kernels W(r, h) in one, two and three dimensions, as the solver has them (sph_fluid/pairs/kernels.hpp)."""
from collections.abc import Callable
from dataclasses import dataclass
from math import erf, exp, pi, sqrt

import numpy as np

Shape = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Kernel:
    """W = norm(d)/h^d shape(r/h), zero beyond `support` smoothing lengths; `usual_eta` is the usual h over the spacing."""

    name: str
    support: float
    usual_eta: float
    norms: tuple[float, float, float]
    shape: Shape

    def norm(self, dimension: int) -> float:
        return self.norms[dimension - 1]

    def __call__(self, distance: np.ndarray, h: np.ndarray | float, dimension: int) -> np.ndarray:
        """W at those distances [1/m^dimension]."""
        q = np.minimum(np.asarray(distance) / h, self.support)
        return self.norm(dimension) / h**dimension * self.shape(q)


def _wendland_c2(q: np.ndarray) -> np.ndarray:
    s = 1.0 - 0.5 * q
    s *= s
    return s * s * (2.0 * q + 1.0)


def _wendland_c4(q: np.ndarray) -> np.ndarray:
    s = 1.0 - 0.5 * q
    return s**6 * (35.0 / 12.0 * q * q + 3.0 * q + 1.0)


def _wendland_c6(q: np.ndarray) -> np.ndarray:
    s = 1.0 - 0.5 * q
    return s**8 * (4.0 * q**3 + 25.0 / 4.0 * q * q + 4.0 * q + 1.0)


def _cubic_spline(q: np.ndarray) -> np.ndarray:
    return np.where(q < 1.0, 1.0 - 1.5 * q * q + 0.75 * q**3, 0.25 * np.maximum(2.0 - q, 0.0) ** 3)


def _quintic_spline(q: np.ndarray) -> np.ndarray:
    part = [np.maximum(k - q, 0.0) ** 5 for k in (3.0, 2.0, 1.0)]
    return part[0] - 6.0 * part[1] + 15.0 * part[2]


def _gaussian(q: np.ndarray) -> np.ndarray:
    return np.exp(-q * q) - exp(-9.0)


_CUT = exp(-9.0)
_GAUSSIAN_NORMS = (
    1.0 / (sqrt(pi) * erf(3.0) - 6.0 * _CUT),
    1.0 / (pi * (1.0 - _CUT) - pi * 9.0 * _CUT),
    1.0 / (pi**1.5 * erf(3.0) - 2.0 * pi * 3.0 * _CUT - 4.0 / 3.0 * pi * 27.0 * _CUT),
)

KERNELS = {
    kernel.name: kernel
    for kernel in (
        Kernel("wendland_c2", 2.0, 1.5, (3.0 / 4.0, 7.0 / (4.0 * pi), 21.0 / (16.0 * pi)), _wendland_c2),
        Kernel("wendland_c4", 2.0, 1.75, (27.0 / 32.0, 9.0 / (4.0 * pi), 495.0 / (256.0 * pi)), _wendland_c4),
        Kernel("wendland_c6", 2.0, 2.0, (15.0 / 16.0, 78.0 / (28.0 * pi), 1365.0 / (512.0 * pi)), _wendland_c6),
        Kernel("cubic_spline", 2.0, 1.325, (2.0 / 3.0, 10.0 / (7.0 * pi), 1.0 / pi), _cubic_spline),
        Kernel("quintic_spline", 3.0, 1.1, (1.0 / 120.0, 7.0 / (478.0 * pi), 1.0 / (120.0 * pi)), _quintic_spline),
        Kernel("gaussian", 3.0, 1.2, _GAUSSIAN_NORMS, _gaussian),
    )
}


def kernel_named(name: str | None) -> Kernel:
    """The kernel of that name; of an unknown one Wendland's C2."""
    return KERNELS.get(name or "", KERNELS["wendland_c2"])
