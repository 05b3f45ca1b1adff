#!/usr/bin/python3
"""What the runs of this folder's scenes came to, against their criteria.

    measure.py PROGRAM OUT [SCENE ...] [--csv FOLDER]
                                            runs the scenes (default: all) with the default scheme and with the paper's into
                                            OUT/<scene>_r and OUT/<scene>_m, unless they are there, and prints a line for each
                                            (about an axis monaghan stands in for the paper's, which has no rings)
                                            criterion; OUT "-" is a temporary folder; SCENE:default or SCENE:paper is one scheme alone;
                                            into FOLDER go hard_cases.csv, a row a criterion, and hard_cases_scenes.csv
Exit code 1 where a criterion is missed. Needs NumPy and h5py.
"""
import csv
import datetime
import json
import pathlib
import platform
import subprocess
import sys
import tempfile
import tomllib

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)  # ctest: skipped

HERE = pathlib.Path(__file__).resolve().parent
PAPER = ["scheme.name=paper"]   # which brings the Gaussian kernel; alpha 1 and beta 10 are the defaults
MONAGHAN = ["scheme.name=monaghan"]


class Run:
    def __init__(self, folder):
        self.folder = folder
        self.summary = json.loads((folder / "summary.json").read_text())
        self.largest_energy_error = max(abs(row[-1]) for row in self.table("energy.csv")[1])

    def table(self, name):
        rows = list(csv.reader((self.folder / name).open()))
        return rows[0], [[float(cell) for cell in row] for row in rows[1:]]

    def snapshots(self):
        with h5py.File(self.folder / "fields/particles.h5part") as file:
            steps = sorted(file, key=lambda name: int(name.split("#")[1]))
            return [(float(file[s].attrs["TimeValue"]), {k: file[s][k][()].astype(float) for k in file[s]}) for s in steps]

    def finite(self):
        """No value in any file that is not finite."""
        tables = [self.table(p.relative_to(self.folder)) for p in [self.folder / "energy.csv", *self.folder.glob("history/*.csv")]]
        return all(np.isfinite(rows).all() for _, rows in tables) and all(
            np.isfinite(values).all() for _, fields in self.snapshots() for values in fields.values())


def thick(fields):
    """Distance between neighbours along x, per particle, in order of x."""
    return np.diff(np.sort(fields["x"]))


# ---- Exact solutions -------------------------------------------------------------------------------------------------

def torn_apart(gamma, c0, u0, rho0, s):
    """Density at s = |x - 0.5|/t: a fan that ends in vacuum (escape speed 2 c0/(gamma - 1) < u0)."""
    edge = u0 - 2 * c0 / (gamma - 1)
    c = np.where(s >= u0 + c0, c0, np.where(s <= edge, 0.0, (s - edge) * (gamma - 1) / (gamma + 1)))
    return rho0 * (np.clip(c, 0, c0) / c0) ** (2 / (gamma - 1))


def contact(gas_pressure, water_pressure, length, time, gamma=1.4, B=3.31e8, N=7.15, A=1e5, rho_ref=1000.0):
    """Pressure and speed (towards the water) of the contact between `length` [m] of gas of 1 kg/m^3 (left) and Tait water."""
    density = lambda p: rho_ref * ((p - A) / B + 1) ** (1 / N)
    rho_w = density(water_pressure)

    def gas(p):  # velocity of the gas behind its wave, to the right
        c = np.sqrt(gamma * gas_pressure)
        if p <= gas_pressure:
            return 2 * c / (gamma - 1) * (1 - (p / gas_pressure) ** ((gamma - 1) / (2 * gamma)))
        return -(p - gas_pressure) * np.sqrt(2 / ((gamma + 1) * p + (gamma - 1) * gas_pressure))

    def water(p):  # velocity of the water behind its wave, to the right
        if p >= water_pressure:
            return np.sqrt((p - water_pressure) * (1 / rho_w - 1 / density(p)))
        rho = np.linspace(density(p), rho_w, 2001)
        sound = np.sqrt(N * B / rho_ref * (rho / rho_ref) ** (N - 1))
        f = sound / rho
        return -np.sum(0.5 * (f[1:] + f[:-1]) * np.diff(rho))

    if gas_pressure > water_pressure:
        # Sound crosses this gas many times while the water moves: it stays uniform and isentropic.
        x, steps = 0.0, 400
        for _ in range(steps):
            x += time / steps * water(gas_pressure * (1 + x / length) ** -gamma)
        return gas_pressure * (1 + x / length) ** -gamma, water(gas_pressure * (1 + x / length) ** -gamma)
    low, high = 1e3, water_pressure * 1.0001
    for _ in range(200):
        p = np.sqrt(low * high)
        low, high = (p, high) if gas(p) > water(p) else (low, p)
    return p, water(p)


# ---- The cases: (criterion, measured) pairs -------------------------------------------------------------------------

def vacuum(run, gamma, c0, u0):
    time, f = run.snapshots()[-1]
    s = np.abs(f["x"] - 0.5) / time
    near = np.abs(f["x"] - 0.5) < 0.5 + (u0 - c0) * time - 0.03   # the free ends are not felt there
    exact = torn_apart(gamma, c0, u0, 1.0, s)
    volume = f.get("mass", 1.0 / len(f["x"])) / f["density"]
    error = np.sum(volume[near] * np.abs(f["density"] - exact)[near]) / np.sum(volume[near])
    gap = np.max(thick(f))
    wanted = 2 * time * (u0 - 2 * c0 / (gamma - 1))
    return [("L1 of density < 5 % of the start's", error < 0.05, f"{error:.3f}"),
            ("a gap at least as wide as the vacuum", gap >= wanted, f"{gap:.3f} (vacuum {wanted:.3f})"),
            ("symmetric to 1e-6", abs(np.mean(f["x"]) - 0.5) < 1e-6, f"{abs(np.mean(f['x']) - 0.5):.0e}")]


def contrast(run, gas_pressure, water_pressure, length=0.1):
    time, f = run.snapshots()[-1]
    p, u = contact(gas_pressure, water_pressure, length, time)
    layer = 1 if np.ptp(f["y"]) == 0 else 64                    # water particles of one layer
    water, gas = np.flatnonzero(f["material"] == 1), f["material"] == 0
    water = water[np.argsort(f["x"][water])]
    front, near = f["x"][water[:layer]].mean(), water[layer:4 * layer]
    speed, pressure = f["velocity_0"][near].mean(), f["pressure"][near].mean()
    mixed = np.sum(f["x"][gas] > front + 0.002)
    found = [("contact's speed within 5 %", abs(speed / u - 1) < 0.05, f"{speed:.0f} ({u:.0f} m/s)"),
             ("no gas particle two spacings beyond the contact", mixed == 0, str(mixed))]
    if gas_pressure > water_pressure:
        found.insert(1, ("contact's pressure within 10 %", abs(pressure / p - 1) < 0.1, f"{pressure / 1e6:.0f} ({p / 1e6:.0f} MPa)"))
    return found


def charge(run, along="x"):
    time, f = run.snapshots()[-1]
    out = np.sum(f[along] < 0)
    header, rows = run.table("history/beneath.csv")
    peak = max(row[1] for row in rows)
    return [("nobody behind the wall", out == 0, str(out)),
            ("peak on the wall beneath it between 5 and 100 GPa", 5e9 < peak < 100e9, f"{peak / 1e9:.1f} GPa")]


def closes(run, centre, wanted, tolerance, along="x", across=("y", "z")):
    """A void is closed when the water that meets in it has its largest mean pressure within the first radius of its middle."""
    best = (0.0, 0.0)
    for time, f in run.snapshots():
        inside = (f[along] - centre) ** 2 + sum(f[a] ** 2 for a in across) < 0.01 ** 2
        if inside.sum() > 5:
            best = max(best, (f["pressure"][inside].mean(), time))
    pressure, time = best
    end = run.summary["time_s"]
    return [(f"closed within {100 * tolerance:.0f} % of {wanted * 1e6:.1f} us", abs(time / wanted - 1) < tolerance and time < 0.99 * end,
             f"{time * 1e6:.0f} us, mean pressure there {pressure / 1e6:.0f} MPa")]


def rests(run, pressure, limit):
    found = []
    for time, f in run.snapshots():
        off = np.abs(f["pressure"] / pressure - 1)
        found.append((f"pressure at {time * 1e3:.1f} ms within {100 * limit:g} %", off.max() < limit, f"{100 * off.max():.2f} %"))
    return found


def implodes(run):
    """Nothing depends on the place along the axis."""
    time, f = run.snapshots()[-1]
    rows = [np.array(run.table(f"history/{name}.csv")[1]) for name in ("axis", "axis_10mm")]
    apart, most = np.abs(rows[0][:, 1] - rows[1][:, 1]).max(), rows[0][:, 1].max()
    return [("the same pressure along the axis within 1 % of its peak", apart < 0.01 * most, f"{apart / most:.1e} of {most / 1e9:.1f} GPa"),
            ("nobody beyond the axis or the wall", f["x"].min() > 0 and f["x"].max() < 0.04, f"{f['x'].min():.1e} to {f['x'].max():.4f} m")]


def encloses(run, radius):
    time, f = run.snapshots()[-1]
    out = np.sum(np.hypot(f["x"], f["z"]) > radius)
    return [("nobody outside", out == 0, str(out))]


def encloses_in_cone(run, low_radius, high_radius, low, high):
    time, f = run.snapshots()[-1]
    side = low_radius + (high_radius - low_radius) * (f["z"] - low) / (high - low)
    out = np.sum((f["x"] > side) | (f["z"] < low) | (f["z"] > high))
    return [("nobody outside", out == 0, str(out))]


def quiescent(run, speed_limit=1.0, pressure_limit=0.01):
    found = []
    for time, f in run.snapshots():
        speed = np.sqrt(sum(f[f"velocity_{a}"] ** 2 for a in range(3)))
        found.append((f"speed at {time * 1e3:.1f} ms below {speed_limit:g} m/s", speed.max() < speed_limit, f"{speed.max():.2g} m/s"))
        off = np.abs(f["pressure"] / 10e6 - 1)
        found.append((f"pressure at {time * 1e3:.1f} ms within a share of {pressure_limit:g}", off.max() < pressure_limit,
                      f"{off.max():.2g}, mean {np.mean(f['pressure']) / 10e6 - 1:+.2g}"))
    return found


def hydrostatic(run, depth=0.064, level=0.064, gravity=9.81, surface=1e5):
    """Speed against a free fall's; pressure against that of its place, over what the water weighs. (The density is uniform to 3e-7.)"""
    found = []
    for time, f in run.snapshots():
        speed = np.sqrt(sum(f[f"velocity_{a}"] ** 2 for a in range(3)))
        fall = gravity * time
        found.append((f"speed at {time * 1e3:.1f} ms below a tenth of a free fall's", speed.max() < 0.1 * fall,
                      f"{speed.max():.2g} m/s, rms {np.sqrt(np.mean(speed ** 2)):.2g} (fall {fall:.2g})"))
        weight = 1000 * gravity * depth
        off = (f["pressure"] - surface - 1000 * gravity * (level - f["z"])) / weight
        found.append((f"pressure at {time * 1e3:.1f} ms within a tenth of the weight, rms", np.sqrt(np.mean(off ** 2)) < 0.1,
                      f"{np.sqrt(np.mean(off ** 2)):.2g}, largest {np.abs(off).max():.2g}, mean {off.mean():+.2g}"))
    return found


def against(run, other, limit, what):
    """Fields of the half x > 0 against another run's."""
    time, f = run.snapshots()[-1]
    _, g = other.snapshots()[-1]
    keep = g["material"] == 0
    mine, theirs = np.arange(len(f["x"])), np.flatnonzero(keep)
    a, b = mine[np.argsort(f["id"])], theirs[np.argsort(g["id"][theirs])]
    rho_c_u = 1000 * 1500 * 200
    dp = np.abs(f["pressure"][a] - g["pressure"][b]).max() / rho_c_u
    dx = np.abs(f["x"][a] - g["x"][b]).max() / 0.002
    return [(f"{what}: pressures within {limit:g} rho c u", dp < limit, f"{dp:.1e}"),
            ("of places, in spacings", dx < limit, f"{dx:.1e}")]


rayleigh = 0.91468 * 0.01 * np.sqrt(1000 / 10e6)
def flies_apart(run):
    """A ball in nothing stays one, and its fastest particle has less than 2 c/(gamma - 1)."""
    f = run.snapshots()[-1][1]
    width, height = np.sqrt((f["mass"] * f["x"] ** 2).sum() / 2), np.sqrt((f["mass"] * f["z"] ** 2).sum())
    fastest = np.hypot(f["velocity_0"], f["velocity_2"]).max()
    return [("as wide as high within 10 %", abs(width / height - 1) < 0.1, f"{width / height - 1:+.3f}"),
            ("no faster than gas escapes, 74.5 m/s", fastest < 74.5, f"{fastest:.1f} m/s")]


CASES = {
    "vacuum_barotropic": lambda run, get: vacuum(run, 2.0, np.sqrt(0.8), 2.0),
    "vacuum_ideal": lambda run, get: vacuum(run, 5 / 3, 1.0, 5.0),
    "gas_drives_water": lambda run, get: contrast(run, 1e9, 1e5),
    "water_drives_gas": lambda run, get: contrast(run, 1e5, 1e9),
    "gas_drives_water_3d": lambda run, get: contrast(run, 1e9, 1e5, 0.05),
    "water_drives_gas_3d": lambda run, get: contrast(run, 1e5, 1e9, 0.05),
    "charge_at_wall": lambda run, get: charge(run),
    "cavity_free": lambda run, get: closes(run, 0.0, rayleigh, 0.05),
    # Rattray 1951 (recalled): the time is longer by 0.205 R/d beside a wall at the distance d of the centre.
    "cavity_at_wall": lambda run, get: closes(run, 0.01, 1.205 * rayleigh, 0.1),
    "quiescent_box": lambda run, get: quiescent(run),
    "quiescent_box_no_slip": lambda run, get: quiescent(run, 1e-3, 1e-5),   # to the round-off of single precision
    "quiescent_jitter": lambda run, get: quiescent(run),
    "quiescent_rings": lambda run, get: quiescent(run),
    "hydrostatic_box": lambda run, get: hydrostatic(run),
    "axis_rest": lambda run, get: rests(run, 1e9, 0.01),
    "axis_implosion": lambda run, get: implodes(run),
    "axis_charge_at_wall": lambda run, get: charge(run, "z"),
    "axis_jet": lambda run, get: closes(run, 0.01, 1.205 * rayleigh, 0.1, "z", ("x",)),
    "axis_vacuum": lambda run, get: flies_apart(run),
    "axis_vessel": lambda run, get: encloses(run, 0.04),
    "axis_cone": lambda run, get: encloses_in_cone(run, 0.01, 0.04, 0.0, 0.06),
    "shock_on_plane": lambda run, get: against(run, get("shock_on_shock"), 1e-6, "plane and two shocks"),
    "shock_on_wall": lambda run, get: against(run, get("shock_on_plane"), 0.05, "wall and plane"),
}


def main():
    arguments = sys.argv[1:]
    tables = None
    if "--csv" in arguments:
        at = arguments.index("--csv")
        tables = pathlib.Path(arguments[at + 1])
        del arguments[at:at + 2]
    program, out, *scenes = arguments
    if out != "-":
        sys.exit(measure(program, pathlib.Path(out), scenes, tables))
    with tempfile.TemporaryDirectory(prefix="undex_hard_cases_") as folder:
        sys.exit(measure(program, pathlib.Path(folder), scenes, tables))


def write_tables(folder, program, found):
    """A row a criterion with what both schemes came to, and a row a scene with how many criteria they hold."""
    version = subprocess.run([program, "version"], capture_output=True, text=True, check=True).stdout.split(" (")[0]
    origin = f"# cases/hard_cases/measure.py PROGRAM OUT --csv docs/results; {version}; {platform.processor() or platform.machine()}; " \
             f"{datetime.date.today()}\n"
    with open(folder / "hard_cases.csv", "w", newline="") as criteria, open(folder / "hard_cases_scenes.csv", "w", newline="") as counts:
        criteria.write(origin)
        counts.write(origin)
        row, count = csv.writer(criteria, lineterminator="\n"), csv.writer(counts, lineterminator="\n")
        row.writerow(["scene", "criterion", "default", "paper or monaghan"])
        count.writerow(["scene", "what", "default", "paper", "monaghan"])
        for scene, schemes in found.items():
            criteria_of = dict.fromkeys(what for checks in schemes.values() for what, _, _ in checks)
            for what in criteria_of:
                row.writerow([scene, what, *(came_to(schemes.get(scheme, []), what) for scheme in schemes)])
            held = {scheme: f"{sum(bool(passed) for _, passed, _ in checks)} of {len(criteria_of)}" for scheme, checks in schemes.items()}
            title = tomllib.loads((HERE / f"{scene}.toml").read_text())["title"].partition(":")[0]
            count.writerow([f"`{scene}`", title, held["default"], held.get("paper", ""), held.get("monaghan", "")])


def came_to(checks, what):
    """A criterion's value, and whether it is missed; nothing where the run did not come so far."""
    for name, passed, value in checks:
        if name == what:
            return (value or "yes") if passed else f"misses: {value}" if value else "misses"
    return ""


def measure(program, out, scenes, tables=None):
    """1 where a criterion is missed, else 0."""
    failed, found = False, {}
    for scene, _, scheme in (name.partition(":") for name in scenes or CASES):
        other = "monaghan" if scene.startswith("axis_") else "paper"
        for suffix, changes in (("r", []), ("m", MONAGHAN if other == "monaghan" else PAPER)):
            if scheme == (other if suffix == "r" else "default"):
                continue
            def get(name):
                folder = out / f"{name}_{suffix}"
                if not (folder / "summary.json").exists():
                    command = [program, "run", HERE / f"{name}.toml", "-o", folder, "-q", "--force", "-j", "1"]
                    subprocess.run([*command, *(x for change in changes for x in ("-P", change))], check=False)
                return Run(folder)
            run = get(scene)
            s = run.summary
            checks = [("done", s["status"] == "done", s["status"] + (" at %.3g s" % s["time_s"] if s["status"] != "done" else "")),
                      ("all finite", run.finite(), ""),
                      ("energy error < 1 %", run.largest_energy_error < 0.01, f"{run.largest_energy_error:.1e}")]
            if s["status"] == "done":
                checks += CASES[scene](run, get)
            acted = {k: v for k, v in s["clamps"].items() if v}
            print(f"{scene} {'default' if suffix == 'r' else other}: {s['steps']} steps, {s['cpu_time_s']:.0f} s CPU, bounds {acted}")
            found.setdefault(scene, {})["default" if suffix == "r" else other] = checks
            for what, passed, value in checks:
                failed = failed or not passed
                print(f"    {'pass' if passed else 'FAIL'}  {what}: {value}")
    if tables:
        write_tables(tables, program, found)
    return int(failed)


if __name__ == "__main__":
    main()
