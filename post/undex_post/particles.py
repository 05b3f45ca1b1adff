"""What a kernel sum needs of particles and snapshots may leave out: bodies, masses, volumes, smoothing lengths."""
import numpy as np

from .kernels import Kernel, kernel_named
from .run import AXES, Run
from .snapshots import ParticleSnapshots


class FluidParticles:
    """The fluid's particles of a run: for any snapshot their body, volume and smoothing length.

    Where `output.particle_fields` has "material", "mass" and "smoothing_length" these are taken. Else bodies are told apart by
    their densities (particles are numbered body after body), masses are those of the checkpoint, or of the lattice's cells at the
    first snapshot, and smoothing lengths follow from the scheme's eta.
    """

    def __init__(self, run: Run, snapshots: ParticleSnapshots):
        self._run = run
        first = snapshots.read(0)
        self.kernel: Kernel = kernel_named(run.setting("scheme.kernel"))
        self.eta = float(run.setting("scheme.eta", self.kernel.usual_eta))
        self.dimension = 2 if run.dimension in (2, "axisymmetric") else 3
        self.spacing = self._spacing(first)
        last = snapshots.read(len(snapshots) - 1)
        self.bodies = self._bodies(first, last)
        self._mass = first.get("mass", _checkpoint_mass(run, first))
        if self._mass is None and "density" in first:
            self._mass = first["density"] * self._depth(first["position"]) * self.spacing**self.dimension

    def body_of(self, snapshot: dict[str, np.ndarray]) -> np.ndarray:
        """Number of each particle's body."""
        if "material" in snapshot:
            return snapshot["material"].astype(int)
        return self.bodies if len(self.bodies) == len(snapshot["position"]) else np.zeros(len(snapshot["position"]), dtype=int)

    def volume(self, snapshot: dict[str, np.ndarray]) -> np.ndarray:
        """Volumes; in plane and axisymmetric scenes areas in the plane. Beside an axis of revolution, where mass over density
        tells little of the area, it is held between a quarter and a hundred of the lattice's cells."""
        cell = self.spacing**self.dimension
        mass = snapshot.get("mass", self._mass)
        if mass is None or "density" not in snapshot or len(mass) != len(snapshot["density"]):
            return np.full(len(snapshot["position"]), cell)
        volume = mass / np.maximum(snapshot["density"], 1e-12) / self._depth(snapshot["position"])
        return np.clip(volume, 0.25 * cell, 100 * cell)

    def smoothing_length(self, snapshot: dict[str, np.ndarray], volume: np.ndarray) -> np.ndarray:
        """The run's own, and where particles have parted further than it reaches, eta times the particle's size: a field has no
        holes where the fluid has none."""
        size = self.eta * volume ** (1 / self.dimension)
        return np.maximum(snapshot.get("smoothing_length", self.eta * self.spacing * np.ones_like(size)), size)

    def _spacing(self, first: dict[str, np.ndarray]) -> float:
        given = self._run.setting("resolution.spacing")
        if isinstance(given, (int, float)) and given > 0:
            return float(given)
        sides = np.ptp(first["position"], axis=0)
        sides = sides[sides > 0]
        return float((np.prod(sides) / len(first["position"])) ** (1 / max(len(sides), 1)))

    def _depth(self, position: np.ndarray) -> np.ndarray:
        """The length of matter across the plane that a mass stands for: the ring's in a meridian, else 1."""
        if self._run.dimension != "axisymmetric":
            return np.ones(len(position))
        axis = AXES.index(self._run.setting("axis", "z"))
        radius = np.abs(position[:, 0 if axis != 0 else 1])
        return 2 * np.pi * np.maximum(radius, 0.25 * self.spacing)

    def _bodies(self, first: dict[str, np.ndarray], last: dict[str, np.ndarray]) -> np.ndarray:
        count = len(self._run.tables("bodies"))
        if "material" in first:
            return first["material"].astype(int)
        number = np.zeros(len(first["position"]), dtype=int)
        with_density = [each for each in (first, last) if "density" in each and len(each["density"]) == len(number)]
        if count < 2 or not with_density:
            return number
        for end in _steps_of(np.stack([np.log(np.maximum(each["density"], 1e-12)) for each in with_density]), count - 1):
            number[end:] += 1
        return number


def _steps_of(series: np.ndarray, count: int) -> list[int]:
    """The places where rows of numbers step: those that split them into `count` + 1 parts of least variance, one after another."""
    parts = [(0, series.shape[1])]
    for _ in range(count):
        gains = [(*_best_split(series[:, a:b]), a, b) for a, b in parts if b - a > 1]
        if not gains:
            break
        _, at, a, b = max(gains)
        parts.remove((a, b))
        parts += [(a, a + at), (a + at, b)]
    return sorted(a for a, _ in parts if a > 0)


def _best_split(series: np.ndarray) -> tuple[float, int]:
    """What is gained in variance by the best cut, and where it is."""
    n = series.shape[1]
    left = np.arange(1, n)
    total = series.cumsum(axis=1)
    before, after = total[:, :-1] / left, (total[:, -1:] - total[:, :-1]) / (n - left)
    gain = ((before - after) ** 2 * left * (n - left) / n).sum(axis=0)
    return float(gain.max()), int(gain.argmax()) + 1


def _checkpoint_mass(run: Run, first: dict[str, np.ndarray]) -> np.ndarray | None:
    """Masses by the particles' numbers, from the newest checkpoint."""
    import h5py

    if "id" not in first:
        return None
    for name in ("checkpoint.h5", "checkpoint_before.h5"):
        try:
            with h5py.File(run.folder / name) as file:
                group = file["state/simulation/fluid/particles"]
                number, mass = group["id"][:], group["mass"][:]
        except (OSError, KeyError):
            continue
        if len(number) == len(first["id"]) and np.array_equal(np.sort(number), first["id"]):
            return mass[np.argsort(number)]
    return None
