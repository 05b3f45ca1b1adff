"""The animated mid-plane as data of a page: fields in 8 bits as PNG, lines and polygons as 16-bit places."""
import base64
import struct
import zlib

import numpy as np

from ..mid_plane import QUANTITIES, Frame, Layer, MidPlane, StructureCut
from ..units import scale_for

LEVELS = 254  # 0 stands for "nothing", 1 to 255 for values
PLACES = 16000  # steps along the picture's longer side

FLUID = ("pressure", "void_fraction", "speed")
SOLID = ("plastic_strain", "von_mises", "speed")
STRUCTURE = ("plastic_strain", "von_mises")


def base64_of(data: bytes) -> str:
    return base64.b64encode(data).decode("ascii")


def png(pixels: np.ndarray) -> bytes:
    """A grey picture of 8 bits, each row less the one above it (filter "Up"), which smooth fields compress well by."""
    rows, columns = pixels.shape
    up = np.vstack([pixels[:1], pixels[1:] - pixels[:-1]]).astype(np.uint8)  # modulo 256
    filtered = np.hstack([np.full((rows, 1), 2, dtype=np.uint8), up]).tobytes()

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", columns, rows, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(filtered, 7)) + chunk(b"IEND", b"")


def quantised(values: np.ndarray, fine: bool) -> tuple[np.ndarray, float, float, int]:
    """Values as 1 to 255 (0: nan), with the least, the largest and the power: value = least + (largest - least) q^power, q = 0 to 1.
    Of fields that are `fine` and not negative q is the square root, so that weak waves keep their shape beside strong ones."""
    known = np.isfinite(values)
    if not known.any():
        return np.zeros(values.shape, dtype=np.uint8), 0.0, 0.0, 1
    least, largest = float(values[known].min()), float(values[known].max())
    power = 2 if fine and least >= 0 else 1
    least = min(least, 0.0) if power == 2 else least
    share = np.zeros(values.shape)
    if largest > least:
        share[known] = np.clip((values[known] - least) / (largest - least), 0, 1) ** (1 / power)
    return np.where(known, 1 + np.round(LEVELS * share), 0).astype(np.uint8), least, largest, power


class Movie:
    """The data of a mid-plane at some of its times, built frame by frame."""

    def __init__(self, plane: MidPlane, most_frames: int = 150):
        self._plane = plane
        chosen = np.unique(np.linspace(0, len(plane) - 1, min(most_frames, len(plane))).round().astype(int))
        self._largest: dict[str, list[float]] = {}
        grid = plane.grid
        self._step = max(grid.high[0] - grid.low[0], grid.high[1] - grid.low[1]) / PLACES
        self._box = [grid.low[0], grid.low[1], grid.high[0], grid.high[1]]
        frames = [self._frame(plane.frame(int(i))) for i in chosen]
        self.left_out = len(plane) - len(frames)
        self.data = {
            "grid": {"low": grid.low, "columns": grid.columns, "rows": grid.rows, "pixel": grid.pixel},
            "step": self._step,
            "box": self._box,
            "mirror": plane.section.mirrors(),
            "axes": self._axes(),
            "quantities": self._quantities(),
            "frames": frames,
        }

    def _axes(self) -> list[str]:
        return ["xyz"[axis] for axis in self._plane.section.axes]

    def _frame(self, frame: Frame) -> dict:
        said: dict = {"time": frame.time}
        for name, layer, wanted in (("fluid", frame.fluid, FLUID), ("solids", frame.solids, SOLID)):
            if layer is not None:
                said[name] = self._layer(name, layer, wanted)
        said["structures"] = [self._structure(cut) for cut in frame.structures if cut.polygons]
        if frame.obstacles:
            said["obstacles"] = self._lines(frame.obstacles)
        return said

    def _layer(self, kind: str, layer: Layer, wanted: tuple[str, ...]) -> dict:
        planes, scales = [], {}
        for name in (name for name in wanted if name in layer.fields):
            pixels, least, largest, power = quantised(layer.fields[name], QUANTITIES[name][2])
            scales[name] = [len(planes), least, largest, power]
            planes.append(pixels[::-1])  # pictures begin at the top
            known = layer.fields[name][np.isfinite(layer.fields[name])]
            self._note(f"{kind}.{name}", float(np.quantile(known, 0.998)) if len(known) else 0.0)
        return {
            "png": base64_of(png(np.vstack(planes))) if planes else "",
            "scales": scales,
            "outlines": self._lines(layer.outlines),
            "interfaces": self._lines(layer.interfaces),
        }

    def _structure(self, cut: StructureCut) -> dict:
        places = np.concatenate(cut.polygons)
        self._box = [
            min(self._box[0], places[:, 0].min()),
            min(self._box[1], places[:, 1].min()),
            max(self._box[2], places[:, 0].max()),
            max(self._box[3], places[:, 1].max()),
        ]
        fields = {}
        for name in (name for name in STRUCTURE if name in cut.fields):
            values, least, largest, power = quantised(cut.fields[name], QUANTITIES[name][2])
            fields[name] = [base64_of(values.tobytes()), least, largest, power]
            self._note(f"structure.{name}", float(np.max(cut.fields[name], initial=0.0)))
        counts = np.array([len(polygon) for polygon in cut.polygons], dtype=np.uint8)
        return {"counts": base64_of(counts.tobytes()), "places": base64_of(self._places(places).tobytes()), "fields": fields}

    def _places(self, points: np.ndarray) -> np.ndarray:
        low = np.array(self._plane.grid.low)
        return np.clip(np.round((points - low) / self._step), -32768, 32767).astype("<i2")

    def _lines(self, lines: list[np.ndarray]) -> str:
        """Each line as the count of its points and their places."""
        parts = [np.concatenate([[len(line)], self._places(line).ravel()]).astype("<i2") for line in lines if len(line) < 32768]
        return base64_of(np.concatenate(parts).tobytes()) if parts else ""

    def _note(self, name: str, largest: float) -> None:
        self._largest.setdefault(name, []).append(largest)

    def _quantities(self) -> list[dict]:
        """What can be chosen, each with the unit it is shown in and the end of its colours at first: that which one frame in four
        passes."""
        said = []
        for key, largest in self._largest.items():
            label, unit, _ = QUANTITIES[key.partition(".")[2]]
            top = float(np.quantile(largest, 0.75)) or float(max(largest)) or 1.0
            factor, shown = scale_for(unit, top)
            said.append({"key": key, "label": label, "unit": shown, "factor": factor, "top": top, "largest": max(largest)})
        return said
