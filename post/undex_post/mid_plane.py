"""The mid-plane of a run as continuous fields, with the outlines of bodies, structures and obstacles.

    with MidPlane(run) as plane:
        frame = plane.frame(0)
        frame.fluid.fields["pressure"]      # on plane.grid, nan where there is no material

Only the computed part is there; `plane.section.mirrors()` says which images complete it.
"""
from contextlib import ExitStack
from dataclasses import dataclass, field

import numpy as np

from .errors import Missing
from .kernel_sum import Cloud, Grid, shepard
from .kernels import Kernel, kernel_named
from .particles import FluidParticles
from .run import AXES, Run
from .section import Section
from .snapshots import ParticleSnapshots, speed

FULL = 0.4  # filling from which on a place counts as material; exactly 1/2 on a flat surface
FLUID_FIELDS = ("pressure", "void_fraction", "speed", "density", "energy")
SOLID_FIELDS = ("plastic_strain", "von_mises", "speed", "pressure", "temperature", "damage")
STRUCTURE_FIELDS = ("plastic_strain", "von_mises", "pressure", "temperature")


# What each field is called, its unit in SI, and whether small values need finer steps than large ones.
QUANTITIES = {
    "pressure": ("pressure", "Pa", True),
    "void_fraction": ("void fraction", "-", False),
    "speed": ("speed", "m/s", True),
    "density": ("density", "kg/m3", False),
    "energy": ("specific internal energy", "J/kg", True),
    "plastic_strain": ("plastic strain", "-", True),
    "von_mises": ("von Mises stress", "Pa", False),
    "temperature": ("temperature", "K", False),
    "damage": ("damage", "-", False),
}


@dataclass
class Layer:
    """Fields of particles on the grid; closed outlines of where there is material, and the lines where bodies meet."""

    fields: dict[str, np.ndarray]
    outlines: list[np.ndarray]
    interfaces: list[np.ndarray]


@dataclass
class StructureCut:
    """The polygons of a structure in the plane, and what its cells have there."""

    name: str
    polygons: list[np.ndarray]
    fields: dict[str, np.ndarray]


@dataclass
class Frame:
    """One time of the mid-plane."""

    time: float
    fluid: Layer | None = None
    solids: Layer | None = None
    structures: list[StructureCut] = field(default_factory=list)
    obstacles: list[np.ndarray] = field(default_factory=list)


class MidPlane:
    """The section of a run in two or three dimensions, with so many cells at most along its longer side (of the computed part), and
    with those of the named fields that the snapshots have. Raises Missing where the run has no snapshots or one coordinate only.
    """

    def __init__(
        self,
        run: Run,
        cells: int = 320,
        fluid_fields: tuple[str, ...] = FLUID_FIELDS,
        solid_fields: tuple[str, ...] = SOLID_FIELDS,
    ):
        if run.is_on_a_line:
            raise Missing("the scene has one coordinate: it has profiles and no mid-plane")
        self._wanted = fluid_fields, solid_fields
        with ExitStack() as opened:
            self._fluid = _open(opened, run.particles)
            self._solids = _open(opened, run.solids)
            self._structures = [each for each in run.structures() if each.times]
            self._obstacles = run.obstacles()
            sources = [each for each in (self._fluid, self._solids, *self._structures) if each]
            if not sources:
                raise Missing("the run has no snapshots of its fields (output.field_times, output.field_interval)")
            self.times: list[float] = list(sources[0].times)
            self._within = 0.25 * float(np.min(np.diff(self.times))) if len(self.times) > 1 else np.inf
            self._particles = FluidParticles(run, self._fluid) if self._fluid else None
            self._solid_spacing = _solid_spacing(run)
            spacing = self._particles.spacing if self._particles else self._solid_spacing
            low, high = self._extent()
            self.section = Section.of(run, low, high, _solid_axis(run) if not self._fluid else None)
            self.grid = self._grid(low, high, spacing, cells)
            self._solid_kernel = kernel_named(run.setting("solid_scheme.kernel"))
            self._solid_eta = float(run.setting("solid_scheme.eta", 1.3))
            self._opened = opened.pop_all()

    def __enter__(self) -> "MidPlane":
        return self

    def __exit__(self, *_) -> None:
        self._opened.close()

    def __len__(self) -> int:
        return len(self.times)

    def frame(self, index: int) -> Frame:
        """The fields and outlines at the time `times[index]`."""
        frame = Frame(self.times[index])
        if self._fluid:
            frame.fluid = self._fluid_layer(index)
        if self._solids:
            nearest = int(np.abs(np.array(self._solids.times) - frame.time).argmin())
            if abs(self._solids.times[nearest] - frame.time) <= self._within:
                frame.solids = self._solid_layer(nearest)
        for structure in self._structures:
            mesh = structure.nearest(frame.time, self._within)
            if mesh is not None:
                polygons, cells = self.section.cut_cells(mesh)
                fields = {name: mesh.cell_data[name][cells].astype(float) for name in STRUCTURE_FIELDS if name in mesh.cell_data}
                frame.structures.append(StructureCut(structure.name, polygons, fields))
        surface = self._obstacles.nearest(frame.time, self._within) if self._obstacles else None
        if surface is not None:
            frame.obstacles = self.section.cut_surface(surface)
        return frame

    # ------------------------------------------------------------------------------------------------ layers

    def _fluid_layer(self, index: int) -> Layer:
        snapshot = self._fluid.read(index)
        body = self._particles.body_of(snapshot)
        volume = self._particles.volume(snapshot)
        h = self._particles.smoothing_length(snapshot, volume)
        return self._layer(snapshot, body, volume, h, self._particles.kernel, self._wanted[0])

    def _solid_layer(self, index: int) -> Layer:
        snapshot = self._solids.read(index)
        body = snapshot.get("material", np.zeros(len(snapshot["position"]))).astype(int)
        volume = np.full(len(body), self._solid_spacing**self.section.dimension)
        if self.section.dimension == 3 and "mass" in snapshot and "density" in snapshot:
            volume = snapshot["mass"] / np.maximum(snapshot["density"], 1e-12)
        h = self._solid_eta * np.maximum(volume, 1e-300) ** (1 / self.section.dimension)
        return self._layer(snapshot, body, volume, h, self._solid_kernel, self._wanted[1])

    def _layer(
        self,
        snapshot: dict[str, np.ndarray],
        body: np.ndarray,
        volume: np.ndarray,
        h: np.ndarray,
        kernel: Kernel,
        wanted: tuple[str, ...],
    ) -> Layer:
        """Shepard sums of each body alone, so that fields keep their steps where bodies meet; of every place the body that fills
        it most."""
        values = {name: snapshot[name].astype(float) for name in wanted if name in snapshot}
        if "speed" in wanted and speed(snapshot) is not None:
            values["speed"] = speed(snapshot)
        h = np.maximum(h, 0.75 * self.grid.pixel)  # finer particles must not fall between the grid's middles
        cloud = Cloud(
            self.section.in_plane(snapshot["position"]),
            self.section.distance(snapshot["position"]),
            h,
            self.section.weight_of_images() * volume,
        )
        shape = (self.grid.rows, self.grid.columns)
        best = np.zeros(shape)
        fields = {name: np.full(shape, np.nan) for name in values}
        fillings = []
        for number in np.unique(body):
            mine = np.flatnonzero((body == number) & (np.abs(cloud.offset) < kernel.support * h))
            if not len(mine):
                continue
            seen, source = self._with_images(cloud[mine], kernel)
            found, filling = shepard(
                seen, {name: each[mine][source] for name, each in values.items()}, self.grid, kernel, self.section.dimension
            )
            wins = filling > best
            best = np.where(wins, filling, best)
            for name, total in fields.items():
                total[wins] = found[name][wins]
            fillings.append(filling)
        whole = sum(fillings, np.zeros(shape))
        return Layer(fields, self._contours(whole, FULL, closed=True), self._interfaces(fillings, whole))

    def _with_images(self, cloud: Cloud, kernel: Kernel) -> tuple[Cloud, np.ndarray]:
        """The cloud and what symmetry planes (or the axis) mirror of it, as far as it reaches; and each one's number in the cloud."""
        source = np.arange(len(cloud.h))
        for axis, mirrored in enumerate(self.section.mirrors()):
            if mirrored:
                near = np.flatnonzero(np.abs(cloud.points[:, axis]) < kernel.support * cloud.h)
                image = cloud[near]
                image.points = image.points * np.where(np.arange(2) == axis, -1.0, 1.0)
                cloud, source = Cloud.joined([cloud, image]), np.concatenate([source, source[near]])
        return cloud, source

    # ------------------------------------------------------------------------------------------------ outlines

    def _contours(
        self, values: np.ndarray, level: float, closed: bool = False, mask: np.ndarray | None = None
    ) -> list[np.ndarray]:
        """Lines of that value, up to a cell beyond the edges, so that they meet their mirror images; closed ones go round there."""
        import contourpy

        u, v = self.grid.middles()
        pixel = self.grid.pixel
        beyond = pixel * np.array([1, 2] if closed else [1])
        u, v = (np.concatenate([each[0] - beyond[::-1], each, each[-1] + beyond]) for each in (u, v))
        values = np.pad(values, 1, mode="edge")
        values = np.pad(values, 1) if closed else values
        if mask is not None:
            values = np.ma.array(values, mask=np.pad(mask, 1, mode="edge"))
        if min(values.shape) < 2:
            return []
        return [
            simplified(line, 0.05 * pixel) for line in contourpy.contour_generator(u, v, values).lines(level) if len(line) > 3
        ]

    def _interfaces(self, fillings: list[np.ndarray], whole: np.ndarray) -> list[np.ndarray]:
        lines = []
        for i, filling in enumerate(fillings[:-1]):
            others = np.max([other for k, other in enumerate(fillings) if k != i], axis=0)
            lines += self._contours(filling - others, 0.0, mask=whole < 0.5 * FULL)
        return lines

    # ------------------------------------------------------------------------------------------------ extent

    def _extent(self) -> tuple[np.ndarray, np.ndarray]:
        """Where matter is at first, and later up to as far again as it is large (solids alone twice that); a few stray
        particles do not count."""
        indices = sorted({0, len(self.times) // 2, len(self.times) - 1})
        places = [self._places(index) for index in indices]
        low, high = np.full(3, np.inf), np.full(3, -np.inf)
        if len(places[0]):
            low, high = places[0].min(axis=0), places[0].max(axis=0)
            reach = (1.0 if self._fluid else 2.0) * float(np.max(high - low))
            for later in places[1:]:
                low = np.minimum(low, np.maximum(np.quantile(later, 0.002, axis=0), low - reach))
                high = np.maximum(high, np.minimum(np.quantile(later, 0.998, axis=0), high + reach))
        for structure in self._structures:
            for index in indices:
                points = structure.nearest(self.times[index], np.inf).points
                low, high = np.minimum(low, points.min(axis=0)), np.maximum(high, points.max(axis=0))
        return low, high

    def _places(self, index: int) -> np.ndarray:
        """The particles' places at that time."""
        parts = [np.zeros((0, 3))]
        for particles in (self._fluid, self._solids):
            if particles:
                nearest = int(np.abs(np.array(particles.times) - self.times[index]).argmin())
                parts.append(particles.read(nearest)["position"])
        return np.concatenate(parts)

    def _grid(self, low: np.ndarray, high: np.ndarray, spacing: float | None, cells: int) -> Grid:
        axes = list(self.section.axes)
        mirrored = np.array(self.section.mirrors())
        low, high = low[axes], high[axes]
        margin = 0.5 * (spacing or 0.01 * float(np.max(high - low)))
        low, high = np.where(mirrored, 0.0, low - margin), high + margin
        longest = float(np.max(high - low)) or 1.0
        pixel = max(min(0.5 * (spacing or longest), longest / (0.75 * cells)), longest / cells)
        return Grid.covering(tuple(low), tuple(high), pixel)


def simplified(line: np.ndarray, tolerance: float) -> np.ndarray:
    """The line without points that lie that close to the chord of their neighbours; of two neighbours one stays."""
    for _ in range(6):
        if len(line) < 5:
            break
        before, here, after = line[:-2], line[1:-1], line[2:]
        chord = after - before
        length = np.hypot(*chord.T)
        off = np.abs(chord[:, 0] * (here - before)[:, 1] - chord[:, 1] * (here - before)[:, 0])
        spare = off <= tolerance * np.maximum(length, 1e-300)
        spare[1::2] &= ~spare[:-1][: len(spare[1::2])]
        spare[2::2] &= ~spare[1:-1:2][: len(spare[2::2])]
        if not spare.any():
            break
        line = line[np.concatenate([[True], ~spare, [True]])]
    return line


def _open(opened: ExitStack, reader) -> ParticleSnapshots | None:
    try:
        return opened.enter_context(reader())
    except Missing:
        return None


def _solid_spacing(run: Run) -> float | None:
    common = run.setting("resolution.spacing")
    spacings = [solid.get("spacing", common) for solid in run.tables("solids")]
    spacings = [float(each) for each in spacings if isinstance(each, (int, float))]
    return min(spacings) if spacings else common


def _solid_axis(run: Run) -> int | None:
    """The axis that a section of solids alone must contain: that of motion, else of a tube or rod."""
    solids = run.tables("solids")
    speeds = np.max([np.abs(np.resize(solid.get("velocity", [0.0]), 3)) for solid in solids], axis=0) if solids else np.zeros(3)
    if speeds.max() > 0:
        return int(speeds.argmax())
    axes = [solid["shape"]["axis"] for solid in solids if isinstance(solid.get("shape"), dict) and "axis" in solid["shape"]]
    return AXES.index(axes[0]) if axes and axes[0] in tuple(AXES) else None
