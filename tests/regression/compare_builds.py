#!/usr/bin/env python3
"""Do two builds of the program give the same digits? Every shipped scene, coarse, with the one and with the other.

    compare_builds.py BEFORE AFTER CASES_FOLDER [--keep FOLDER] [--jobs N] [NAME ...]

BEFORE and AFTER are programs; NAME chooses some of the runs. Compared bit for bit: metrics and everything else of summary.json
but the cost, all histories and energies, all fields. --keep leaves the runs of BEFORE in a folder and takes them from there the
next time. Exit code 1 and a line per difference. For changes that must not change a digit; no test, since it needs two builds.
"""
import argparse
import concurrent.futures
import pathlib
import shutil
import sys
import tempfile

import regression
import undex_runs as runs

COARSE_BAR = {"resolution.spacing": 0.0008, "end_time": 20e-6}
IMPACT = {"resolution.spacing": 0.002, "end_time": 2e-6}
# Shipped scenes that no regression test runs, by their path below cases/: what makes them cheap. Hard cases are cheap as they are.
FURTHER = {
    "al_sphere_impact/axisymmetric.toml": IMPACT,
    "al_sphere_impact/experiment.toml": IMPACT,
    "al_sphere_impact/full.toml": IMPACT,
    "al_tube_fem/experiment.toml": {"resolution.spacing": 0.002, "end_time": 60e-6},
    "bleich_sandler/axisymmetric.toml": {"resolution.spacing": 0.1, "end_time": 2e-3},
    "bleich_sandler/case.toml": {"resolution.spacing": 0.1, "end_time": 2e-3},
    "cavitating_tube/column.toml": {"resolution.spacing": 0.004, "end_time": 0.1e-3},
    "colliding_rings/updated.toml": {"resolution.spacing": 0.002, "end_time": 1e-3},
    "free_field/axisymmetric.toml": {"resolution.spacing": 0.002, "end_time": 30e-6},
    "free_field/bubble.toml": {"resolution.spacing": 1e-4, "end_time": 200e-6},
    "free_field/deep_bubble.toml": {"resolution.spacing": 0.003, "end_time": 60e-6, "start.time": 12e-6},
    "free_field/deep_bubble_radius.toml": {"resolution.spacing": 1e-4, "end_time": 200e-6},
    "free_field/radial.toml": {"resolution.spacing": 1e-4, "end_time": 30e-6},
    "free_field/similitude.toml": {"resolution.spacing": 0.001, "end_time": 200e-6},
    "free_field/tnt.toml": {"resolution.spacing": 0.001, "end_time": 200e-6},
    "free_field/case.toml": {"resolution.spacing": 0.003, "end_time": 30e-6},
    "free_field/radiating.toml": {"resolution.spacing": 0.005, "end_time": 60e-6},
    "free_field/spherical.toml": {"resolution.spacing": 0.003, "end_time": 30e-6},
    "free_field/two_charges.toml": {"resolution.spacing": 0.003, "end_time": 15e-6},
    "gas_water_shock_tube/column.toml": {"resolution.spacing": 0.004},
    "gas_water_shock_tube/water_gas.toml": {"resolution.spacing": 0.001},
    "jwl_water/column.toml": {"resolution.spacing": 0.004},
    "obstacles/piston.toml": {"resolution.spacing": 0.0025},
    "petn_slab/column.toml": {"resolution.spacing": 8e-4},
    "rigid_cylinder/chained.toml": {"resolution.spacing": 0.004, "end_time": 30e-6},
    "rigid_cylinder/first_wave.toml": {},
    "rotating_stressed_disc/total.toml": {"resolution.spacing": 0.001, "end_time": 0.1e-3},
    "sedov/axisymmetric.toml": {},
    "sjogreen/column.toml": {"resolution.spacing": 0.01},
    "taylor_bar_fem/case.toml": {"end_time": 10e-6},
    "taylor_bar_fem/copper.toml": {"end_time": 10e-6},
    "taylor_bar_sph/copper.toml": COARSE_BAR,
    "taylor_bar_sph/updated.toml": COARSE_BAR,
    "taylor_plate/axisymmetric.toml": {"end_time": 12e-6},
    "taylor_plate/case.toml": {"resolution.spacing": 0.002, "end_time": 12e-6},
    "taylor_plate/light.toml": {"end_time": 2e-6},
    "water_shock_tube/column.toml": {"resolution.spacing": 0.004},
}
# Scenes whose own metrics regression.py leaves to others, with them; and what no scene asks for by itself.
VARIANTS = {
    "sjogreen/case.toml": {"resolution.spacing": 0.005},
    "cavitating_tube/case.toml": {"resolution.spacing": 0.002},
    "petn_slab/case.toml": {"resolution.spacing": 4e-4},
    "rigid_cylinder/case.toml+corrected": {"resolution.spacing": 0.004, "end_time": 40e-6, "scheme.name": "riemann_corrected"},
    "rigid_cylinder/case.toml+paper": {"resolution.spacing": 0.004, "end_time": 40e-6, "scheme.name": "paper"},
    "rigid_cylinder/case.toml+switch": {"resolution.spacing": 0.004, "end_time": 40e-6, "scheme.name": "monaghan_switch"},
    "rigid_cylinder/case.toml+rk3": {"resolution.spacing": 0.004, "end_time": 40e-6, "scheme.integrator": "ssp_rk3"},
    "al_tube_fem/case.toml+local": {"resolution.spacing": 0.004, "end_time": 30e-6, "scheme.local_steps": "true"},
    "al_tube_fem/case.toml+shells": {"resolution.spacing": 0.004, "end_time": 30e-6, "structure.element": "shell",
                                     "structure.cells": "{through = 1, around = 48, along = 36}"},
    "al_tube_fem/case.toml+paper": {"resolution.spacing": 0.004, "end_time": 30e-6, "scheme.name": "paper"},
    "al_tube_sph/case.toml+corrected": {"resolution.spacing": 0.004, "solids.tube.spacing": 0.003175, "end_time": 30e-6,
                                        "scheme.name": "riemann_corrected"},
}


def all_runs(cases):
    """{name: (scene, settings)} of everything that is compared; no scene file is left out."""
    found = {name: (case.scene, case.settings) for name, case in regression.CASES.items()}
    covered = {f"{scene}/case.toml" if not scene.endswith(".toml") else scene for scene, _ in found.values()}
    for scene, settings in {**FURTHER, **VARIANTS}.items():
        found[scene] = (scene.partition("+")[0], settings)
    for path in sorted(cases.glob("*/*.toml")):
        scene = str(path.relative_to(cases))
        if "[[axes]]" in path.read_text() or scene in covered or scene in FURTHER:  # studies are no scenes
            continue
        if path.parent.name != "hard_cases":
            raise SystemExit(f"compare_builds.py: no test resolution for cases/{scene}; add it to FURTHER")
        found[scene] = (scene, {})
    return found


def run(program, cases, scene, settings, folder):
    shutil.rmtree(folder, ignore_errors=True)
    done = runs.call(program, "run", cases / scene, "-o", folder, "-q", "-j1", *runs.overrides(settings), timeout=1800)
    if done.returncode not in (0, 3):  # 3: the numerics stopped it, in both
        raise SystemExit(f"{program} run {scene}: exit code {done.returncode}\n{done.stderr}")


def compare(arguments, scratch, name, scene, settings):
    folder = name.replace("/", "_")
    before = (arguments.keep or scratch / "before") / folder
    if not (before / "summary.json").is_file():
        run(arguments.before, arguments.cases, scene, settings, before)
    after = scratch / "after" / folder
    run(arguments.after, arguments.cases, scene, settings, after)
    found = [each for each in runs.differences(before, after) if not each.startswith("summary.json program")]
    shutil.rmtree(after)
    return found


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("before", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("after", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("cases", type=pathlib.Path)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    chosen = {name: each for name, each in all_runs(arguments.cases).items()
              if not arguments.names or any(part in name for part in arguments.names)}
    failed = 0
    with tempfile.TemporaryDirectory(prefix="undex_builds_") as scratch, concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        jobs = {name: pool.submit(compare, arguments, pathlib.Path(scratch), name, *each) for name, each in chosen.items()}
        for name, job in jobs.items():
            found = job.result()
            print(f"{name}: {'the same' if not found else 'DIFFERS'}", flush=True)
            for line in found:
                print(f"    {line}", flush=True)
            failed += bool(found)
    print(f"{len(chosen)} runs, {failed} differ")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
