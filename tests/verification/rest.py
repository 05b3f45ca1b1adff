#!/usr/bin/python3
"""Water at rest at 0.1 MPa stays at rest for a millisecond, in every geometry.

    rest.py PROGRAM CASES_FOLDER NAME      runs one scene; exit code 1 and one line per finding
    rest.py PROGRAM CASES_FOLDER --table   runs all of them and prints the table of docs/results/walls.md
    rest.py --names                        the scenes that are tests: those that take seconds

0.1 MPa is 4e-5 of rho c^2: what the pairs leave of uniform pressure is seen here before anything else. Needs NumPy and h5py.
"""
import pathlib
import subprocess
import sys
import tempfile

if sys.argv[1:] != ["--names"]:
    try:
        import h5py
        import numpy as np
    except ImportError:
        sys.exit(77)  # ctest: skipped

PRESSURE, END = 1e5, 1e-3
FASTEST, WORST = 1.0, 0.01  # m/s, share of the pressure


def scene(dimension, shape, spacing, more="", resolution="", walls=None):
    """Text of a scene: water that fills slip walls of one shape."""
    axis = 'axis = "z"\n' if dimension == "axisymmetric" else ""
    dimension = f'"{dimension}"' if axis else dimension
    return f"""title = "At rest"
dimension = {dimension}
{axis}end_time = {END}
[resolution]
spacing = {spacing}
{resolution}
[[bodies]]
name = "water"
shape = {shape}
material = "water-tait"
pressure = {PRESSURE}
[[walls]]
name = "vessel"
shape = {walls or shape}
{more}
"""


def box(low, high):
    return f'{{type = "box", low = {low}, high = {high}}}'


def cylinder(radius, low="", high=""):
    ends = f", low = {low}, high = {high}" if high else ""
    return f'{{type = "cylinder", axis = "z", radius = {radius}{ends}}}'


SPHERE = '{type = "sphere", radius = 0.04}'
CONE = '{type = "cone", axis = "z", low_radius = 0.01, high_radius = 0.04, low = 0, high = 0.06}'
TUBE = cylinder(0.044, "0", "0.06")
OCTANT = '[symmetry]\nplanes = ["x", "y", "z"]'
QUARTER = '[symmetry]\nplanes = ["x", "y"]'
FIT = 'fit = "vessel"'
RINGS = 'fit = "vessel"\nlattice = "rings"'
BALL = '[[obstacles]]\nname = "ball"\nshape = {type = "sphere", center = [0, 0, 0.03], radius = 0.012}\nmotion = "prescribed"\n' \
       'direction = [0, 0, 1]\ntime = [0.0]\nspeed = [0.0]'
OFF = "[0.0013, 0.0005]"
PLATE = """[structure]
shape = {type = "plate", low = [0, 0, 0.04], high = [0.02, 0.02, 0.044]}
element = "hexahedron"
cells = {x = 4, y = 4, z = 2}
material = "al-5083-h116"
wet = ["z_low"]
supports = [{face = "z_high", fixed = ["x", "y", "z"]}, {face = "z_low", fixed = ["x", "y", "z"]}]
[coupling]
slip = true"""
DUCT = box("[0, 0, 0]", "[0.02, 0.02, 0.04]")

# name: (what it is, text of the scene, is it a test?)
SCENES = {
    "line": ("1D, half a spacing off its lattice", scene(1, box("0.001", "0.1007"), 0.002), False),
    "box_2d": ("2D, box, fitted", scene(2, box("[0, 0]", "[0.1, 0.05]"), 0.002, resolution=FIT), False),
    "box_2d_off": ("2D, box off its lattice", scene(2, box(OFF, "[0.1, 0.05]"), 0.002), False),
    "disc": ("2D, disc", scene(2, cylinder(0.04), 0.002), True),
    "disc_rings": ("2D, disc, rings", scene(2, cylinder(0.04), 0.002, resolution=RINGS), False),
    "box_3d": ("3D, box, fitted", scene(3, box("[0, 0, 0]", "[0.06, 0.04, 0.04]"), 0.004, resolution=FIT), False),
    "box_3d_off": ("3D, box off its lattice", scene(3, box("[0.0013, 0.0005, 0.002]", "[0.06, 0.04, 0.04]"), 0.004), False),
    "cylinder_rings": ("3D, cylinder, rings, a quarter", scene(3, TUBE, 0.004, QUARTER, RINGS), False),
    "cylinder": ("3D, cylinder, a quarter", scene(3, TUBE, 0.004, QUARTER), False),
    "cone": ("3D, cone, a quarter", scene(3, CONE, 0.004, QUARTER), False),
    "sphere": ("3D, sphere, an octant", scene(3, SPHERE, 0.004, OCTANT), True),
    "meridian_cylinder": ("meridian, cylinder, fitted", scene("axisymmetric", TUBE, 0.002, resolution=FIT), False),
    "meridian_cylinder_off": ("meridian, cylinder off its lattice",
                              scene("axisymmetric", cylinder(0.0437, "0.0005", "0.06"), 0.002), False),
    "meridian_cone": ("meridian, cone", scene("axisymmetric", CONE, 0.002), False),
    "meridian_sphere": ("meridian, sphere", scene("axisymmetric", SPHERE, 0.002), True),
    "meridian_sphere_1mm": ("the same at 1 mm", scene("axisymmetric", SPHERE, 0.001), False),
    "meridian_sphere_3mm": ("the same at 3 mm", scene("axisymmetric", SPHERE, 0.003), False),
    "meridian_ball": ("meridian, held ball in a cylinder", scene("axisymmetric", TUBE, 0.002, BALL), False),
    "ball": ("3D, held ball in a cylinder, a quarter", scene(3, TUBE, 0.004, QUARTER + "\n" + BALL), False),
    "plate": ("3D, held plate of elements on a box", scene(3, DUCT, 0.002, 'faces = {z_high = "open"}\n' + PLATE, 'fit = "water"',
                                                           box("[0, 0, 0]", "[0.02, 0.02, 0.08]")), False),
}


def measure(program, text, *changes):
    """Largest speed [m/s], least, mean and largest pressure [Pa] over the run, of three moments, and particles."""
    with tempfile.TemporaryDirectory(prefix="undex_rest_") as folder:
        path = pathlib.Path(folder) / "scene.toml"
        path.write_text(text + f'[scheme]\nsignal = 0\n[output]\nfield_times = [{0.1 * END}, {0.3 * END}, {END}]\n'
                        'particle_fields = ["pressure", "velocity"]\n')
        done = subprocess.run([program, "run", path, "-o", folder + "/run", "-q", "-j", "1", *(x for c in changes for x in ("-P", c))],
                              stderr=subprocess.PIPE, text=True, check=False)
        if done.returncode != 0:
            raise SystemExit(f"exit code {done.returncode}: {done.stderr.strip()}")
        with h5py.File(folder + "/run/fields/particles.h5part") as file:
            steps = [{k: file[s][k][()].astype(float) for k in file[s]} for s in file]
        steps = steps[-3:]
        speed = max(np.sqrt(sum(f[k] ** 2 for k in f if k.startswith("velocity"))).max() for f in steps)
        pressures = [f["pressure"] for f in steps]
        return (speed, min(p.min() for p in pressures), pressures[-1].mean(), max(p.max() for p in pressures), pressures[0].size)


def problems(program, name):
    speed, least, mean, most, _ = measure(program, SCENES[name][1])
    found = []
    if not speed < FASTEST:
        found.append(f"{speed:.3g} m/s")
    for what, p in (("least", least), ("mean", mean), ("largest", most)):
        if not abs(p / PRESSURE - 1) < WORST:
            found.append(f"{what} pressure {100 * (p / PRESSURE - 1):+.2f} %")
    return found


def main(arguments):
    if arguments == ["--names"]:
        print("\n".join(name for name, (_, _, is_test) in SCENES.items() if is_test))
        return 0
    program, _, *names = arguments
    if names[0] == "--table":
        print("| scene | particles | largest speed | least, largest pressure | mean after 1 ms | without settling |")
        print("|---|---|---|---|---|---|")
        for name, (what, text, _) in SCENES.items():
            if names[1:] and name not in names[1:]:
                continue
            speed, least, mean, most, count = measure(program, text)
            laid = measure(program, text, "resolution.settle=false")[2]
            off = [100 * (p / PRESSURE - 1) for p in (least, most, mean, laid)]
            print(f"| {what} | {count} | {1e3 * speed:.2g} mm/s | {off[0]:+.2f}, {off[1]:+.2f} % "
                  f"| {off[2]:+.2f} % | {off[3]:+.1f} % |", flush=True)
        return 0
    found = problems(program, names[0])
    for line in found:
        print(f"{names[0]}: {line}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
