#!/usr/bin/python3
"""The table that ends the demo: the wall's displacement of two runs and of the published SPH computation, less the experiment.

Usage: demo_table.py AXISYMMETRIC_RUN OCTANT_RUN      the folders of both runs
"""
import csv
import json
import pathlib
import sys

PROJECT = pathlib.Path(__file__).resolve().parent.parent
TIMES = (30, 40, 60, 80, 100, 120, 150)  # [us]


def references():
    """{time [us]: {source: displacement [mm]}} of the experiment and the paper."""
    with open(PROJECT / "cases/al_tube_fem/reference/displacement.csv", newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    table = {}
    for time in TIMES:
        row = next(row for row in rows if row["metric"] == f"displacement_{time}us_m")
        table[time] = {source: float(cell.split("+-")[0]) for source, cell in row.items()
                       if source in ("experiment", "expt. as paper", "paper Tait", "paper MG") and cell.strip()}
    return table


def displacements(folder):
    """{time [us]: displacement [mm]} of a run."""
    metrics = json.loads((pathlib.Path(folder) / "summary.json").read_text())["metrics"]
    return {time: 1e3 * metrics[f"displacement_{time}us_m"] for time in TIMES}


def cell(value, other):
    return f"{value:.2f} mm {100 * (value / other - 1):+5.1f} %" if value is not None and other else "-"


def main(folders):
    if len(folders) != 2:
        sys.exit(__doc__)
    table, (axis, octant) = references(), [displacements(folder) for folder in folders]
    print("Displacement of the tube's wall at mid-length, and its difference from the experiment\n")
    print(f"{'time':>8}  {'experiment':>10}  {'about the axis, 0.5 mm':>22}  {'octant, 2 mm':>18}  {'published SPH':>18}")
    worst = [0.0, 0.0, 0.0]
    for time in TIMES:
        known = table[time]
        paper = known.get("paper MG"), known.get("expt. as paper")
        print(f"{time:>5} us  {known['experiment']:>7.2f} mm  {cell(axis[time], known['experiment']):>22}  "
              f"{cell(octant[time], known['experiment']):>18}  {cell(*paper):>18}")
        for k, (value, other) in enumerate(((axis[time], known["experiment"]), (octant[time], known["experiment"]), paper)):
            if value and other:
                worst[k] = max(worst[k], 100 * abs(value / other - 1))
    print(f"{'largest':>8}  {'':>10}  {worst[0]:>20.1f} %  {worst[1]:>16.1f} %  {worst[2]:>16.1f} %")
    print("\nPublished SPH: Chen, Peng, Lien, Zhao 2019, in a shorter tube, less the experiment as that paper prints it.")


if __name__ == "__main__":
    main(sys.argv[1:])
