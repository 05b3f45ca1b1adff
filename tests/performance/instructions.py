#!/usr/bin/env python3
"""Instructions that a particle update takes, counted by valgrind: they must stay what was recorded, to 5 %.

    instructions.py PROGRAM BUILD NAME               runs one test; exit code 1 and one line per finding, 77: skipped
    instructions.py PROGRAM BUILD --record [NAME...] writes recorded.json anew, for all variants or some: after a change
                                                     whose cost is meant (or saves some), and with the reason
    instructions.py --names                          the tests

PROGRAM is block_steps; BUILD names compiler and build type ("GNU 12 Release"): the record holds for these alone. Counted
is a whole step of a block of water on one thread, without the block's construction, at x86-64-v3 (valgrind has no AVX-512).
Unlike a time the count does not depend on who else uses the machine: it repeats to the last instruction, and a lost
vectorisation shows on any. It knows nothing of caches, and a division counts as an addition does: times are the business
of bench/fluid_bench. A further step differs by 0.1 %, a block of 8000 particles by 0.5 %.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

RECORDED = pathlib.Path(__file__).with_name("recorded.json")
TOLERANCE = 0.05
PARTICLES, STEPS, LEVEL = 5832, 1, "x86-64-v3"
SKIPPED = 77
OWN_TESTS = ["the_check_can_fail", "every_variant_is_recorded"]


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def count(program, name):
    """Instructions per particle update of the variant of that name."""
    if shutil.which("valgrind") is None:
        skip("valgrind is not installed (scripts/install_packages.sh)")
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", "--toggle-collect=counted_steps",
               program, name, str(PARTICLES), str(STEPS)]
    done = subprocess.run(command, env=dict(os.environ, UNDEX_CPU_LEVEL=LEVEL), stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True)
    collected = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode != 0 or collected is None:
        sys.exit(f"{' '.join(command)}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    particles, level = done.stdout.split()
    if level != LEVEL:
        skip(f"the pair loops run at {level} here, the record is of {LEVEL}")
    return int(collected[1]) / (int(particles) * STEPS)


def judge(counted, recorded):
    change = counted / recorded - 1
    if abs(change) <= TOLERANCE:
        return []
    return [f"{counted:.0f} instructions per particle update, {100 * change:+.1f} % from the {recorded} recorded; if that "
            "is meant, record anew (see --record)"]


def read():
    return json.loads(RECORDED.read_text()) if RECORDED.exists() else {"build": "", "instructions_per_update": {}}


def variants(program):
    return subprocess.run([program, "--names"], stdout=subprocess.PIPE, text=True, check=True).stdout.split()


def record(program, build, names):
    known = variants(program)
    old = read()
    if old["build"] != build and names:
        sys.exit(f"the record is of {old['build']}, this is {build}: record all")
    counts = old["instructions_per_update"]
    for name in names or known:
        before = counts.get(name)
        counts[name] = round(count(program, name))
        print(f"{name}: {counts[name]}" + (f" ({100 * (counts[name] / before - 1):+.1f} %)" if before else ""), flush=True)
    whole = {"build": build, "instructions_per_update": {name: counts[name] for name in known if name in counts}}
    RECORDED.write_text(json.dumps(whole, indent=1) + "\n")


def test(program, build, name):
    recorded = read()
    counts = recorded["instructions_per_update"]
    if name == "the_check_can_fail":
        passes = [bool(judge(1000 * factor, 1000)) for factor in (0.94, 0.96, 1.0, 1.04, 1.06)]
        return [] if passes == [True, False, False, False, True] else [f"judged {passes}"]
    if name == "every_variant_is_recorded":
        return [f"{one} is not in recorded.json, or only there" for one in sorted(set(variants(program)) ^ set(counts))]
    if recorded["build"] != build:
        skip(f"the record is of {recorded['build']}, this is {build}")
    counted = count(program, name)
    print(f"{name}: {counted:.0f} instructions per particle update, recorded {counts[name]}")
    return judge(counted, counts[name])


def main():
    arguments = sys.argv[1:]
    names = [*read()["instructions_per_update"], *OWN_TESTS]
    if arguments == ["--names"]:
        print("\n".join(names))
        return 0
    if len(arguments) >= 3 and arguments[2] == "--record":
        record(arguments[0], arguments[1], arguments[3:])
        return 0
    if len(arguments) != 3 or arguments[2] not in names:
        print(__doc__, file=sys.stderr)
        return 2
    findings = test(*arguments)
    for finding in findings:
        print(f"{arguments[2]}: {finding}")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
