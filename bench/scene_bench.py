#!/usr/bin/env python3
"""What whole scenes cost: runs the program on shipped scenes and prints a Markdown table.

    scene_bench.py PROGRAM [--threads 1 2] [--repeat 3] [--runs rigid_cylinder:3 al_tube_fem:2 ...] [--cases FOLDER]

A run is scene:spacing, the spacing in mm. Each is repeated; the table has the medians of what summary.json says:

  wall, CPU          s, of the whole process: set-up and spherical start included (CPU: all threads)
  M updates/s/core   particles times steps, per second of wall time and thread
  ns/neighbour       wall time times threads per true neighbour (directed; walls and images among them)
  B/particle         peak resident memory of the process, its libraries (some 100 MB) included, over the particles
  error              l1_0_95us of rigid_cylinder; of a tube the mean deviation of its displacements from the first source
                     of the scene's reference (the converged solution): a cost says nothing without it
  passes             shares of the wall time that the solvers' timers saw, the largest first

The default runs take about a minute of CPU time a repetition.
"""
import argparse
import csv
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

CASES = pathlib.Path(__file__).resolve().parent.parent / "cases"
RUNS = ["rigid_cylinder:3", "rigid_cylinder:2", "al_tube_fem:3", "al_tube_fem:2"]
COLUMNS = ["scene", "spacing (mm)", "threads", "particles", "steps", "updates (M)", "wall (s)", "CPU (s)",
           "M updates/s/core", "ns/neighbour", "B/particle", "error", "passes (% of wall)"]
SMALLEST_SHARE = 0.5  # % of the wall time; passes below are left out


def run(program, cases, scene, spacing, threads):
    """summary.json of one run."""
    with tempfile.TemporaryDirectory(prefix="undex_bench_") as folder:
        command = [program, "run", str(cases / scene), "-o", f"{folder}/run", "-q", "-j", str(threads),
                   "-P", f"resolution.spacing={spacing * 1e-3:.9g}", "-P", "output.field_times=[]"]
        # A thread that waits must not hold a core: on a shared machine it would take it from those that work.
        done = subprocess.run(command, env={"OMP_WAIT_POLICY": "passive", **os.environ}, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)}: exit code {done.returncode}\n{done.stdout}")
        return json.loads(pathlib.Path(folder, "run", "summary.json").read_text())


def displacement_error(metrics, reference):
    """Mean deviation of the tube's displacements from the first source of a reference table, or None."""
    if not reference.exists():
        return None
    with reference.open() as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    deviations = []
    for metric, _, _, scale, value, *_ in rows[1:]:
        ours = metrics.get(metric)
        if metric.startswith("displacement_") and ours is not None and value:
            deviations.append(abs(ours * float(scale) / float(value.split("+-")[0]) - 1))
    return statistics.mean(deviations) if deviations else None


def error(cases, scene, metrics):
    for name, value in metrics.items():
        if name.startswith("l1_") and value is not None:
            return f"{100 * value:.2f} % ({name})"
    deviation = displacement_error(metrics, cases / scene / "reference" / "displacement.csv")
    return "-" if deviation is None else f"{100 * deviation:.2f} % (displacement)"


def row(cases, scene, spacing, threads, summaries):
    first = summaries[0]
    wall, cpu, memory = (statistics.median(s[key] for s in summaries)
                         for key in ("wall_time_s", "cpu_time_s", "peak_memory_bytes"))
    shares = sorted(((100 * statistics.median(s["passes"][name] / s["wall_time_s"] for s in summaries), name)
                     for name in first["passes"]), reverse=True)
    updates, neighbours = first["particle_updates"], first["neighbour_interactions"]
    return [scene, f"{spacing:g}", threads, first["particles"], first["steps"], f"{updates / 1e6:.2f}",
            f"{wall:.2f}", f"{cpu:.2f}",
            f"{updates / (wall * threads) / 1e6:.3f}" if updates else "-",
            f"{1e9 * wall * threads / neighbours:.2f}" if neighbours else "-",
            f"{memory / first['particles']:.0f}" if first["particles"] else "-",
            error(cases, scene, first["metrics"]),
            ", ".join(f"{name} {share:.1f}" for share, name in shares if share >= SMALLEST_SHARE)]


def scene_and_spacing(text):
    scene, _, spacing = text.partition(":")
    try:
        return scene, float(spacing)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is not scene:spacing, like rigid_cylinder:3") from None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="the program undex, e.g. build/release/undex")
    parser.add_argument("--runs", nargs="+", type=scene_and_spacing, default=[scene_and_spacing(one) for one in RUNS],
                        metavar="SCENE:MM", help=f"default: {' '.join(RUNS)}")
    parser.add_argument("--threads", nargs="+", type=int, default=[1], metavar="N", help="default: 1")
    parser.add_argument("--repeat", type=int, default=3, metavar="N", help="default: 3")
    parser.add_argument("--cases", type=pathlib.Path, default=CASES, help="folder of the scenes; default: the project's")
    options = parser.parse_args()
    if options.repeat < 1 or min(options.threads) < 1:
        parser.error("--repeat and --threads want at least 1")

    header = None
    for scene, spacing in options.runs:
        for threads in options.threads:
            summaries = [run(options.program, options.cases, scene, spacing, threads) for _ in range(options.repeat)]
            if header is None:
                program = summaries[0]["program"]
                told = ", ".join(map(str, program.values())) if isinstance(program, dict) else program
                header = [f"{told}; median of {options.repeat}", "", f"| {' | '.join(COLUMNS)} |",
                          "|---" * len(COLUMNS) + "|"]
                print("\n".join(header))
            print(f"| {' | '.join(map(str, row(options.cases, scene, spacing, threads, summaries)))} |", flush=True)


if __name__ == "__main__":
    main()
