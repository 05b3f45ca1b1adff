"""Panels of curves as data of a page: numbers of 32 bits in base64, so that nan needs no place in JSON."""
import numpy as np

from ..histories import Panel, axis_label, thinned
from .movie import base64_of


class ChartData:
    """The charts of a page in their order; `place` adds one and returns the element that the page's script fills."""

    def __init__(self) -> None:
        self.charts: list[dict] = []

    def add(self, panel: Panel, several_runs: bool = False) -> int:
        """Adds a panel and returns its number."""
        scaled = panel.scaled()
        numbers: list[str] = []
        place: dict[bytes, int] = {}

        def stored(values: np.ndarray) -> int:
            data = np.asarray(values, dtype="<f4").tobytes()
            if data not in place:
                place[data] = len(numbers)
                numbers.append(base64_of(data))
            return place[data]

        series, references, dashes = [], 0, {}
        for index, curve in enumerate(scaled.curves):
            thin = thinned(curve) if curve.kind == "line" else curve
            if curve.run is None:
                style = {"colour": -1, "mark": references}
                references += 1
            elif several_runs:
                style = {"colour": curve.run, "dash": dashes.setdefault(curve.run, 0)}
                dashes[curve.run] += 1
            else:
                style = {"colour": index, "dash": index // 7}
            series.append({"label": curve.label, "kind": curve.kind, "x": stored(thin.x), "y": stored(thin.y), **style})
        self.charts.append({"title": scaled.title, "x": axis_label(scaled.x_label, scaled.x_unit), "time": panel.x_unit == "s",
                            "y": axis_label(scaled.quantity, scaled.unit), "numbers": numbers, "series": series})
        return len(self.charts) - 1
