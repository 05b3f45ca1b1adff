"""Field files of a run: particles (H5Part) and meshes of structures and obstacles (VTKHDF)."""
import json
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .errors import Missing


class ParticleSnapshots:
    """The snapshots of an H5Part file: `times` [s]; `read(i)` gives the fields of one as arrays. Use it in a `with`."""

    def __init__(self, path: Path):
        import h5py

        if not path.is_file():
            raise Missing(f"{path}: missing; ask for snapshots in the scene's [output] (field_times, field_interval)")
        try:
            self._file = h5py.File(path)
        except OSError as error:
            raise Missing(f"{path}: cannot be read ({error}); a run that is still writing, or a damaged file") from error
        steps = sorted((name for name in self._file if re.fullmatch(r"Step#\d+", name)), key=lambda name: int(name[5:]))
        self.path = path
        self._steps, self.times = [], []
        for name in steps:
            group = self._file[name]
            if "TimeValue" in group.attrs and all(axis in group for axis in "xyz"):
                self._steps.append(name)
                self.times.append(float(np.ravel(group.attrs["TimeValue"])[0]))
        if not self._steps:
            self._file.close()
            raise Missing(f"{path}: no snapshots in it yet")

    def __len__(self) -> int:
        return len(self._steps)

    def __enter__(self) -> "ParticleSnapshots":
        return self

    def __exit__(self, *_) -> None:
        self._file.close()

    def fields(self, index: int) -> set[str]:
        """Names of the fields of a snapshot."""
        return set(self._file[self._steps[index]])

    def read(self, index: int) -> dict[str, np.ndarray]:
        """All fields of a snapshot in the order of `id`, and "position", an array (n, 3) [m]."""
        group = self._file[self._steps[index]]
        snapshot = {name: group[name][:] for name in group}
        if "id" in snapshot:
            order = np.argsort(snapshot["id"], kind="stable")
            snapshot = {name: values[order] for name, values in snapshot.items()}
        snapshot["position"] = np.stack([snapshot.pop(axis) for axis in "xyz"], axis=1).astype(float)
        return snapshot


def speed(snapshot: dict[str, np.ndarray]) -> np.ndarray | None:
    """Magnitude of the velocity [m/s], or None where the snapshot has none."""
    parts = [snapshot[name].astype(float) for name in ("velocity_0", "velocity_1", "velocity_2") if name in snapshot]
    return np.sqrt(sum(part**2 for part in parts)) if parts else None


@dataclass
class Mesh:
    """A snapshot of a structure or of surfaces: points [m] at their present places, cells as lists of points, fields by name."""

    points: np.ndarray
    offsets: np.ndarray
    connectivity: np.ndarray
    point_data: dict[str, np.ndarray]
    cell_data: dict[str, np.ndarray]

    @property
    def cells(self) -> list[np.ndarray]:
        """The points of each cell."""
        return np.split(self.connectivity, self.offsets[1:-1])


class MeshSnapshots:
    """The snapshots that an index file NAME.hdf.series lists: `times` [s]; `read(i)` gives a Mesh."""

    def __init__(self, index: Path):
        try:
            entries = json.loads(index.read_text())["files"]
            found = [(float(entry["time"]), index.parent / Path(entry["name"]).name) for entry in entries]
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise Missing(f"{index}: not an index of snapshots ({error!r})") from error
        found = [(time, path) for time, path in found if path.is_file()]
        self.name = index.name.removesuffix(".hdf.series")
        self.times = [time for time, _ in found]
        self._paths = [path for _, path in found]

    def nearest(self, time: float, within: float) -> Mesh | None:
        """The snapshot nearest to that time, or None where it is further off than `within` [s]."""
        if not self.times:
            return None
        index = int(np.abs(np.array(self.times) - time).argmin())
        return self.read(index) if abs(self.times[index] - time) <= within else None

    def read(self, index: int) -> Mesh:
        import h5py

        path = self._paths[index]
        try:
            with h5py.File(path) as file:
                root = file["VTKHDF"]
                data = [
                    {name: root[group][name][:] for name in root[group]} if group in root else {}
                    for group in ("PointData", "CellData")
                ]
                return Mesh(root["Points"][:].astype(float), root["Offsets"][:], root["Connectivity"][:], *data)
        except (OSError, KeyError) as error:
            raise Missing(f"{path}: cannot be read ({error})") from error


def structure_indices(folder: Path) -> list[Path]:
    """The index files of a run's structures, in the order of their names."""
    return sorted((folder / "fields").glob("structure*.hdf.series"))
