"""undex_post: what runs of undex leave behind, for Python.

    from undex_post import Run, MidPlane

    run = Run("out/al_tube_fem")
    pressure = run.histories["midline_wall"]["pressure"]     # Pa, beside ["time"]
    with MidPlane(run) as plane:
        frame = plane.frame(0)                               # continuous fields on plane.grid

Modules: run (a run's folder), tables (CSV files), snapshots (field files), kernels and kernel_sum (fields on a grid), mid_plane (the
section that is shown), histories (which curves belong together), study, comparison, figures (PNG by Matplotlib), report (HTML).
All values are in SI units. Needed are NumPy, h5py and Matplotlib.
"""
from .comparison import Comparison
from .errors import Missing
from .kernel_sum import Cloud, Grid, kernel_sum, linear, shepard
from .kernels import KERNELS
from .mid_plane import MidPlane
from .run import Run
from .study import Study

__all__ = ["KERNELS", "Cloud", "Comparison", "Grid", "MidPlane", "Missing", "Run", "Study", "kernel_sum", "linear", "shepard"]
