#!/usr/bin/python3
"""Every shipped geometry full of water at rest: does it stay at rest?

    at_rest.py PROGRAM OUT [SCENE ...]      runs each scene (default: those below, the shipped ones with walls, structures or solids) for
                                            a millisecond with water at 0.1 MPa in the place of all its fluids, in OUT/<scene>,
                                            unless it is there, and prints a line for each

Criterion: no particle faster than a thousandth of the speed u of the scene itself (the largest particle velocity that its wave
brings, given below), pressure within 1 %. Free ends that the scene leaves open are closed by slip walls: water under pressure would run
out there. Exit code 1 where it is missed. Needs Python 3.11, NumPy and h5py.
"""
import json
import pathlib
import subprocess
import sys
import tomllib

import h5py
import numpy as np

CASES = pathlib.Path(__file__).resolve().parent.parent
PRESSURE = 1e5
# Scene and the speed of its water [m/s]: peak over rho c of the wave at the wall (charges: about 0.4 GPa; plates: their peak).
SCENES = {
    "rigid_cylinder/case.toml": 400, "rigid_cylinder/first_wave.toml": 400,
    "al_tube_fem/case.toml": 250, "al_tube_fem/experiment.toml": 250, "al_tube_paper/case.toml": 250, "al_tube_sph/case.toml": 250,
    "al_tube_sph/surface.toml": 250, "free_field/case.toml": 100, "free_field/axisymmetric.toml": 100,
    "taylor_plate/case.toml": 60, "taylor_plate/axisymmetric.toml": 60, "taylor_plate/light.toml": 60,
    "hard_cases/axis_cone.toml": 400, "hard_cases/axis_vessel.toml": 400, "hard_cases/charge_at_wall.toml": 400,
    "petn_slab/column.toml": 2000, "cavitating_tube/column.toml": 10,
}


def toml(value):
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(k)} = {toml(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return json.dumps(value)


def at_rest(scene):
    """The scene with one liquid under one pressure."""
    rest = {k: scene[k] for k in ("dimension", "axis", "resolution", "symmetry", "walls", "structure", "solids", "coupling") if k in scene}
    rest["bodies"] = [{**{k: body[k] for k in ("name", "shape", "subtract", "spacing") if k in body}, "material": "water-tait",
                       "pressure": PRESSURE} for body in scene["bodies"]]
    rest["end_time"] = 1e-3
    rest["scheme"] = {**{k: v for k, v in scene.get("scheme", {}).items() if k != "fixed_step"}, "signal": 0}
    rest["output"] = {"field_times": [1e-4, 1e-3], "particle_fields": ["pressure", "velocity"]}
    return rest


def run(program, scene, folder):
    if not (folder / "summary.json").exists():
        folder.mkdir(parents=True, exist_ok=True)
        file = folder / "rest.toml"
        file.write_text("\n".join(f"{k} = {toml(v)}" for k, v in at_rest(tomllib.loads((CASES / scene).read_text())).items()))
        done = subprocess.run([program, "run", file, "-o", folder / "run", "-q", "--force"], capture_output=True, text=True)
        if done.returncode:
            return None, done.stderr.strip().splitlines()[-1][:150]
        (folder / "summary.json").write_text((folder / "run/summary.json").read_text())
    worst = [0.0, 0.0]
    with h5py.File(folder / "run/fields/particles.h5part") as steps:
        for step in steps.values():
            speed = np.sqrt(sum(step[f"velocity_{a}"][()].astype(float) ** 2 for a in "xyz"))
            worst[0] = max(worst[0], speed.max())
            worst[1] = max(worst[1], abs(step["pressure"][()].astype(float) / PRESSURE - 1).max())
    return worst, json.loads((folder / "summary.json").read_text())


def main(program, out, *names):
    well = True
    print("| scene | u (m/s) | largest speed (m/s) | pressure off by | particles | CPU s |\n|---|---|---|---|---|---|")
    for scene in names or SCENES:
        worst, summary = run(program, scene, pathlib.Path(out) / scene.replace("/", "_").removesuffix(".toml"))
        if worst is None:
            print(f"| {scene} | | {summary} |")
            well = False
            continue
        speed, pressure = worst
        held = speed < 1e-3 * SCENES[scene] and pressure < 0.01
        well = well and held
        print(f"| {scene} | {SCENES[scene]} | {speed:.2g} | {100 * pressure:.2g} %{'' if held else ' **missed**'} | "
              f"{summary['particles']} | {summary['cpu_time_s']:.0f} |", flush=True)
    return 0 if well else 1


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
