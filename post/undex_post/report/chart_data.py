"""Panels of curves as data of a page: numbers of 32 bits in base64, so that nan needs no place in JSON."""
import numpy as np

from ..histories import Panel, axis_label, thinned
from .movie import base64_of


class ChartData:
    """The charts of a page in their order."""

    def __init__(self) -> None:
        self.charts: list[dict] = []

    def add(self, panel: Panel, several_runs: bool = False) -> int:
        """Adds a panel and returns its number, by which an element of the page names it."""
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
                # Beside one run points have colours of their own; lines, and all beside several runs, are grey.
                own = curve.kind == "points" and not several_runs
                style = {"colour": 1 + references if own else -1, "mark": references}
                references += 1
            elif several_runs:
                style = {"colour": curve.run, "dash": dashes.setdefault(curve.run, 0)}
                dashes[curve.run] += 1
            else:
                style = {"colour": index, "dash": index // 7}
            series.append({"label": curve.label, "kind": curve.kind, "x": stored(thin.x), "y": stored(thin.y), **style})
        self.charts.append(
            {
                "title": scaled.title,
                "x": axis_label(scaled.x_label, scaled.x_unit),
                "time": panel.x_unit == "s",
                "y": axis_label(scaled.quantity, scaled.unit),
                "numbers": numbers,
                "series": series,
            }
        )
        return len(self.charts) - 1
