"""All pictures of a run."""
from pathlib import Path


from .. import histories
from ..run import Run
from .mid_plane import PAPER_TIMES, mid_plane_figure, solids_figure
from .panels import figure_of
from .style import Job, draw_all

NAMES = (
    "histories",
    "references",
    "energy",
    "bodies",
    "lines",
    "profile",
    "mid_plane",
    "fields",
    "solids_plastic_strain",
    "solids_von_mises",
    "solids_speed",
)


def draw_run(folder: Path, times: list[float] | None = None, dpi: int = 110) -> list[Path]:
    """Draws what the run has into folder/pictures, and returns the paths."""
    run = Run(folder)
    for note in run.notes:
        print(note)
    wanted = times if times is not None else PAPER_TIMES
    runs = [(run.name, run)]
    jobs: dict[str, Job] = {
        "histories": lambda: figure_of(histories.probe_panels(runs), run.label(), 3),
        "references": lambda: figure_of(histories.reference_panels(runs), run.label()),
        "energy": lambda: figure_of(histories.energy_panels(runs), run.label()),
        "bodies": lambda: figure_of(histories.part_panels(runs), run.label()),
        "lines": lambda: figure_of(histories.line_panels(run), run.label()),
        "profile": lambda: figure_of(histories.profile_panels(run), run.label(), 1),
    }
    if run.is_on_a_line:
        jobs["fields"] = lambda: figure_of(histories.coordinate_panels(run), run.label())
    else:
        jobs["mid_plane"] = lambda: mid_plane_figure(run, wanted)
        if run.tables("solids"):
            for quantity in ("plastic_strain", "von_mises", "speed"):
                jobs[f"solids_{quantity}"] = lambda quantity=quantity: solids_figure(run, wanted, quantity)
    pictures = run.folder / "pictures"
    return draw_all(jobs, pictures, dpi, [pictures / f"{name}.png" for name in NAMES])
