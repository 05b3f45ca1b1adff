"""Matplotlib without a screen, and the colours, lines and markers of all figures."""
import re
from collections.abc import Callable
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend goes first)
from matplotlib.figure import Figure  # noqa: E402

from ..errors import Missing  # noqa: E402

# Colours that all eyes tell apart (Okabe and Ito), black last.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#8a6d00", "#000000"]
LINES = ["-", "--", "-.", (0, (1, 1)), (0, (5, 1, 1, 1, 1, 1)), (0, (8, 2))]
MARKERS = "osD^vP*X<>hd"

Job = Callable[[], Figure | None]


def draw_all(jobs: dict[str, Job], folder: Path, dpi: int, stale: list[Path]) -> list[Path]:
    """Draws each figure that there is something for into folder/NAME.png, and prints the path, or why there is none. Pictures of an
    older run, `stale`, must not pass for this one's."""
    folder.mkdir(exist_ok=True)
    for old in stale:
        old.unlink(missing_ok=True)
    drawn = []
    for name, draw in jobs.items():
        try:
            figure = draw()
        except Missing as error:
            print(f"{name}.png: not drawn: {error}")
            continue
        if figure is None:
            continue
        path = folder / f"{name}.png"
        figure.savefig(path, dpi=dpi)
        plt.close(figure)
        print(path)
        drawn.append(path)
    return drawn


def plain(text: str) -> str:
    """Text that Matplotlib does not read as mathematics."""
    return text.replace("$", r"\$")


def file_name(*parts: str) -> str:
    return "_".join(re.sub(r"[^\w.-]+", "_", part).strip("_") for part in parts if part)
