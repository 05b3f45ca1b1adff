"""A small run for the tests, made by the program itself: the aluminium tube about its axis, coarse."""
import atexit
import os
import shutil
import subprocess
import tempfile
from functools import cache
from pathlib import Path

UNDEX = os.environ["UNDEX_PROGRAM"]
CASES = Path(os.environ["UNDEX_CASES"])


def temporary_folder() -> Path:
    """A folder that goes away with the tests."""
    folder = Path(tempfile.mkdtemp(prefix="undex_post_"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def undex(*arguments: object, environment: dict[str, str] | None = None) -> subprocess.CompletedProcess:
    """Runs the program with these arguments."""
    return subprocess.run(
        [UNDEX, *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
        env={**os.environ, "OMP_NUM_THREADS": "1", **(environment or {})},
    )


@cache
def tube() -> Path:
    """The folder of the run, with a dozen snapshots. Tests must not change it: `changed_tube` gives a copy."""
    folder = temporary_folder() / "tube"
    done = undex(
        "run",
        CASES / "al_tube_fem" / "experiment.toml",
        "-q",
        "-o",
        folder,
        "-P",
        "resolution.spacing=0.002",
        "--tend",
        "60e-6",
        "-P",
        "output.field_interval=3e-6",
        "-P",
        "output.field_times=[]",
        "-P",
        'output.particle_fields=["pressure", "density", "velocity", "void_fraction", "mass", "material"]',
    )
    if done.returncode != 0:
        raise RuntimeError(f"undex run: exit code {done.returncode}: {done.stderr}")
    return folder


def changed_tube() -> Path:
    """A copy of the run to do damage to."""
    folder = temporary_folder() / "tube"
    shutil.copytree(tube(), folder)
    return folder
