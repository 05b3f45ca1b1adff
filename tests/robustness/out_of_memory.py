#!/usr/bin/env python3
"""Memory that runs out anywhere in a run: exit code 1 with a message, never a crash, a run that hangs or a false "done".

    out_of_memory.py PROGRAM CASES_FOLDER LIBRARY [tries a scene and way of failing]

LIBRARY (failing_memory.cpp) is preloaded and fails at a call of our choice, alone or for good. The calls are spread over a run and,
since the start makes most of them, as many over its steps; which ones UNDEX_SEED says (default: 1).
"""
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

FIRST = 50  # before some twenty the program's own constants are made, and main has not begun

SCENES = {
    "finite elements in water": ["al_tube_fem", "resolution.spacing=0.006", "start.kind='plain'", "output.field_times=[1e-6]",
                                 "structure.cells={through=2,around=24,along=12}", "end_time=8e-6"],
    "particles in water": ["al_tube_sph", "resolution.spacing=0.006", "start.kind='plain'", "output.field_times=[]",
                           "solids.tube.spacing=0.003175", "end_time=4e-6"],
    "detonation": ["jwl_water", "resolution.spacing=0.01", "end_time=1e-5"],
    "solids that meet": ["colliding_rings", "end_time=1e-6"],
}


def attempt(program, library, scene, folder, **failing):
    """Exit code (None: it hangs), stderr, status in summary.json."""
    environment = {**os.environ, "LD_PRELOAD": str(library), "OMP_WAIT_POLICY": "passive",
                   **{f"UNDEX_{key.upper()}": str(value) for key, value in failing.items()}}
    shutil.rmtree(folder, ignore_errors=True)  # what an older run has left is no end of this one
    command = [program, "run", scene[0], "-o", folder, "-q"] + [part for change in scene[1:] for part in ("-P", change)]
    try:
        done = subprocess.run(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, timeout=120)
    except subprocess.TimeoutExpired:
        return None, "", None
    summary = folder / "summary.json"
    return done.returncode, done.stderr, json.loads(summary.read_text())["status"] if summary.is_file() else None


def wrong(code, said, status):
    """What is wrong with such an end, or nothing."""
    if code == 0:
        return None if status == "done" else f"exit 0, status {status}"
    if code != 1:
        return f"exit {code}: {said[-300:]}"
    if not re.search("memory|cannot|bad_alloc", said):
        return f"no message: {said[-300:]}"
    return None  # a run recorded as done has all of its record: what was left to do then was to say so


def calls_of(program, library, scene, folder, counted):
    """How often a run asks for memory when nothing fails."""
    code, said, status = attempt(program, library, scene, folder, count=counted)
    if (code, status) != (0, "done"):
        sys.exit(f"{scene[0].name}: exit {code}, {status} without any failure: {said}")
    return int(counted.read_text())


def main(program, cases, library, tries):
    mistakes, recorded = [], 0
    chance = random.Random(int(os.environ.get("UNDEX_SEED", "1")))
    with tempfile.TemporaryDirectory(prefix="undex_memory_") as here:
        for name, (case, *changes) in SCENES.items():
            scene, folder, counted = [cases / case, *changes], pathlib.Path(here) / "run", pathlib.Path(here) / "count"
            calls = calls_of(program, library, scene, folder, counted)
            in_steps = calls - calls_of(program, library, [*scene, "end_time=1e-12"], folder, counted)
            for way in ("fail_at", "fail_from"):
                for first, last in ((FIRST, calls), (calls - 2 * in_steps, calls - in_steps)):  # the last of all write the results
                    for k in range(tries):
                        call = first + int((last - first) * (k + chance.random()) / tries)
                        end = attempt(program, library, scene, folder, **{way: call})
                        recorded += end[2] == "failed"
                        if problem := wrong(*end):
                            mistakes.append(f"{name}, {way}={call} of {calls}: {problem}")
    print("\n".join(mistakes))
    if recorded == 0:
        sys.exit("no run recorded its failure: the calls do not reach the steps")
    sys.exit(1 if mistakes else 0)


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(*(pathlib.Path(argument).resolve() for argument in sys.argv[1:4]), int(sys.argv[4]) if len(sys.argv) > 4 else 8)
