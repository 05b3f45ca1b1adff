#!/usr/bin/env python3
"""What can happen to a run, at random and many times: it must end in good order, and what is resumed must give the same bits.

    torture.py PROGRAM CASES_FOLDER kills [--count N] [--seed S] [--minutes M]    kill -9 at random moments, resume, compare
    torture.py PROGRAM CASES_FOLDER every [...]                                   the same once for every shipped scene
    torture.py PROGRAM CASES_FOLDER disks [...]                                   a disk that is full at any byte
    torture.py PROGRAM CASES_FOLDER checkpoints [...]                             flipped bits and cuts in checkpoints
    torture.py PROGRAM CASES_FOLDER scenes [...]                                  changed scenes, overrides, references, studies

Prints a line per failure with what repeats it, counts at the end, and ends with 1 where anything failed. `disks` mounts small
file systems and needs root; without it the limit on a file's size stands in (ulimit -f).
"""
import argparse
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "regression"))
import compare_builds  # noqa: E402
import undex_runs as runs  # noqa: E402

US = 1e-6
# Scenes of every kind of state, each of some seconds on a quiet machine.
SCENES = {
    "water": ("rigid_cylinder", {"resolution.spacing": 0.005, "start.kind": "plain", "end_time": 60 * US,
                                 "output.field_interval": 7 * US}),
    "tube": ("al_tube_fem", {"resolution.spacing": 0.005, "end_time": 40 * US, "output.field_interval": 6 * US}),
    "one_system": ("al_tube_sph", {"resolution.spacing": 0.005, "solids.tube.spacing": 0.003175, "end_time": 25 * US,
                                   "output.field_interval": 5 * US}),
    "bar": ("taylor_bar_sph", {"resolution.spacing": 0.0008, "end_time": 15 * US, "output.field_interval": 3 * US}),
    "local_steps": ("al_tube_fem", {"resolution.spacing": 0.005, "end_time": 40 * US, "scheme.local_steps": "true",
                                    "output.field_interval": 6 * US}),
}
COUNT = 10
OFTEN = {"output.checkpoint_interval": 0.1}

# What a value of a scene, an override or a reference is changed into.
VALUES = ["0", "-1", "1", "2", "0.5", "-0.0", "1e-300", "1e300", "-1e300", "inf", "nan", "1e9", "1e-9", "9223372036854775807", '""',
          '"word"', "[]", "{}", "[[]]", "[1, 2]", "true", "1979-05-27", '"petn"', '{base = "petn"}', "[1e308, -1e308, 0]"]
NUMBER = re.compile(r"(?<=[ \[,=-])\d[\d.]*(?:e[+-]?\d+)?")
EXIT_CODES = {0, 2, 3, 4}  # 1 is the program's or the disk's own failure, and there is none here
AN_ANSWER = 20  # [s] within which the program has answered, or has begun to compute and ends at a signal


class Torture:
    def __init__(self, arguments, scratch):
        self.program, self.cases, self.scratch = arguments.program, arguments.cases, scratch
        self.random = random.Random(arguments.seed)
        self.scenes = SCENES if arguments.kind != "every" else compare_builds.all_runs(arguments.cases)
        self.reference, self.seconds, self.code = {}, {}, {}
        self.failures = []
        self.codes = {}  # how often each exit code was seen, of changed scenes

    def start(self, *arguments, **options):
        return subprocess.Popen([str(self.program), *map(str, arguments)], env=runs.ENVIRONMENT, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True, **options)

    def run_arguments(self, name, folder, threads):
        scene, settings = self.scenes[name]
        return ["run", self.cases / scene, "-o", folder, "-q", "-j", threads, *runs.overrides({**settings, **OFTEN})]

    def uncut(self, name):
        """The folder of a run that nothing happened to, and how long it took [s]."""
        if name not in self.reference:
            folder = self.scratch / f"uncut_{name.replace('/', '_')}"
            since = time.monotonic()
            done = runs.call(self.program, *self.run_arguments(name, folder, 2), timeout=3600)
            if done.returncode not in (0, 3):  # 3: of hard cases
                raise SystemExit(f"{name}: exit code {done.returncode}\n{done.stderr}")
            self.reference[name], self.seconds[name] = folder, time.monotonic() - since
            self.code[name] = done.returncode
        return self.reference[name]

    def fail(self, what):
        self.failures.append(what)
        print("FAILED:", what, flush=True)

    def killed_after(self, process, seconds):
        """Whether kill -9 found it still running."""
        try:
            process.communicate(timeout=seconds)
            return False
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            return True

    def kill(self, number):
        names = sorted(self.scenes)
        name = names[number] if self.scenes is not SCENES else self.random.choice(names)
        uncut = self.uncut(name)
        folder = self.scratch / f"killed_{number}"
        log = []

        def command():
            begun = (folder / "resolved.toml").is_file() or any(folder.glob("checkpoint*.h5"))
            threads = self.random.choice([1, 2])
            return ["resume", folder, "-q", "-j", threads] if begun else self.run_arguments(name, folder, threads)

        for _ in range(self.random.choice([1, 1, 2, 3, 6])):
            after = self.random.uniform(0, 1.1 * self.seconds[name])
            process = self.start(*command())
            if not self.killed_after(process, after):
                break
            log.append(f"{after:.3f} s")
        else:
            process = self.start(*command())
            process.communicate()
        what = f"kills, {name}, run {number}, killed after {', '.join(log)}"
        if process.returncode != self.code[name]:
            self.fail(f"{what}: exit code {process.returncode}")
        elif found := runs.differences(uncut, folder):
            self.fail(f"{what}: {'; '.join(found[:3])}")
        shutil.rmtree(folder, ignore_errors=True)
        return len(log)

    def disk(self, number):
        """A run on a disk of a size at random: its last good checkpoint is good, and with room it goes on to the same bits."""
        name = self.random.choice(["water", "tube", "bar"])
        uncut = self.uncut(name)
        needed = sum(path.stat().st_size for path in uncut.rglob("*") if path.is_file())
        size = int(self.random.uniform(4096, 1.3 * needed)) // 4096 * 4096 + 4096
        folder = self.scratch / f"disk_{number}"
        mounted = self.mount(folder, size)
        run = folder / "run"
        limit = None if mounted else lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size // 4, size // 4))
        try:
            done = runs.call(self.program, *self.run_arguments(name, run, 2), timeout=3600, preexec_fn=limit)
            what = f"disks, {name}, run {number}, {size} bytes"
            if done.returncode not in (0, 1):
                self.fail(f"{what}: exit code {done.returncode}: {done.stderr[-300:]}")
            if done.returncode == 1 and not done.stderr.strip():
                self.fail(f"{what}: no message")
            if mounted:
                subprocess.run(["mount", "-o", f"remount,size={4 * needed + 2**24}", str(folder)], check=True)
            if (run / "resolved.toml").is_file() and not (done.returncode == 0 and (run / "summary.json").is_file()):
                again = runs.call(self.program, "resume", run, "-q", timeout=3600)
                if again.returncode != 0:
                    self.fail(f"{what}: resume ends with {again.returncode}: {again.stderr[-300:]}")
                elif found := [each for each in runs.differences(uncut, run) if "warnings" not in each]:
                    self.fail(f"{what}: {'; '.join(found[:3])}")
        finally:
            if mounted:
                subprocess.run(["umount", str(folder)], check=True)
            shutil.rmtree(folder, ignore_errors=True)
        return 1

    def mount(self, folder, size):
        folder.mkdir()
        if os.geteuid() != 0:
            return False
        return subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "undex_torture", str(folder)],
                              stderr=subprocess.DEVNULL).returncode == 0

    def checkpoint(self, number):
        """Damage in the newest checkpoint: the one before it is taken, with a message. In both: exit code 4."""
        name = "gas"
        folder = self.scratch / "checkpoints"
        if not folder.exists():
            done = runs.call(self.program, "run", self.cases / "sjogreen", "-o", folder, "-q", "-j1",
                             *runs.overrides({"resolution.spacing": 0.01, "end_time": 0.05, "output.field_times": "[]",
                                              "output.checkpoint_interval": 1e-3}))
            if done.returncode != 0 or len(list(folder.glob("checkpoint*.h5"))) != 2:
                raise SystemExit(f"no two checkpoints to damage: {done.stderr}")
        work = self.scratch / "damaged"
        shutil.rmtree(work, ignore_errors=True)
        shutil.copytree(folder, work)
        (work / "summary.json").unlink()
        names = self.random.choice([["checkpoint.h5"], ["checkpoint.h5"], ["checkpoint.h5", "checkpoint_before.h5"]])
        what = []
        for each in names:
            data = bytearray((work / each).read_bytes())
            how = self.random.choice(["flip", "flip", "cut", "fill", "append"])
            at = self.random.randrange(len(data))
            if how == "flip":
                for _ in range(self.random.choice([1, 1, 1, 20])):
                    data[self.random.randrange(len(data))] ^= 1 << self.random.randrange(8)
            elif how == "cut":
                del data[at:]
            elif how == "fill":
                data[at:at + 4096] = bytes(self.random.randrange(256) for _ in range(min(4096, len(data) - at)))
            else:
                data += bytes(self.random.randrange(1, 100))
            (work / each).write_bytes(data)
            what.append(f"{each}: {how} at {at}")
        try:
            done = runs.call(self.program, "resume", work, "-q", "-j1", timeout=20)
            wanted = 0 if len(names) == 1 else 4
            if done.returncode != wanted or "damaged" not in done.stderr:
                self.fail(f"checkpoints, {number}, {', '.join(what)}: exit code {done.returncode}: {done.stderr[-300:]}")
            elif wanted == 0 and (found := runs.differences(folder, work)):
                self.fail(f"checkpoints, {number}, {', '.join(what)}: {'; '.join(found[:3])}")
        except subprocess.TimeoutExpired:
            self.fail(f"checkpoints, {number}, {', '.join(what)}: more than 20 s ({name})")
        return 1

    def changed(self, text):
        """A text of numbers, keys and lines with one to three things changed."""
        for _ in range(self.random.choice([1, 1, 2, 3])):
            lines = text.split("\n")
            line, other = self.random.randrange(len(lines)), self.random.choice(lines)
            numbers = list(NUMBER.finditer(text))
            how = self.random.choice(["number", "number", "scale", "scale", "value", "swap", "drop", "repeat", "bytes", "cut"])
            if how in ("number", "scale") and numbers:
                found = self.random.choice(numbers)
                scaled = float(found.group()) * 10 ** self.random.uniform(-4, 4)
                new = self.random.choice(VALUES[:14]) if how == "number" else f"{scaled:.4g}"
                text = text[:found.start()] + new + text[found.end():]
            elif how == "bytes":
                at = self.random.randrange(len(text) + 1)
                new = self.random.choice(["\0", '"', "[", "}", "=", "\n", "é", "#", ",", "-", "."])
                text = text[:at] + new + text[at + self.random.choice([0, 1]):]
            elif how == "cut":
                text = text[:self.random.randrange(len(text) + 1)]
            else:
                if how == "value" and "=" in lines[line]:
                    lines[line] = lines[line].split("=")[0] + "= " + self.random.choice(VALUES)
                elif how == "swap" and "=" in lines[line] and "=" in other:
                    lines[line] = lines[line].split("=")[0] + "=" + other.split("=", 1)[1]
                elif how == "drop":
                    del lines[line]
                else:
                    lines.insert(line, other)
                text = "\n".join(lines)
        return text

    def override(self, text):
        """A key of the scene, or one that sounds like it, and a value."""
        tables = [name.strip("[] ") for name in re.findall(r"^\[+[\w.]+\]+", text, re.M)] or ["resolution"]
        keys = re.findall(r"^(\w+) *=", text, re.M) or ["end_time"]
        path = [self.random.choice(tables), self.random.choice(["0", "1", "water", "low"]), self.random.choice(keys)]
        del path[:self.random.randrange(3)]
        return f"{'.'.join(path)}={self.random.choice(VALUES)}"

    def scene(self, number):
        """A changed scene, override, reference or study: a documented exit code with a message in time, never a crash."""
        files = sorted(self.cases.rglob("*.toml"))
        given = self.random.choice(files)
        folder = self.scratch / "scene"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(given.parent, folder)
        target, overrides = folder / given.name, []
        kind = "study" if given.name == "study.toml" else self.random.choice(["scene", "scene", "override", "reference"])
        references = sorted(folder.glob("reference/*.csv"))
        if kind == "override" or (kind == "reference" and not references):
            overrides = [part for _ in range(self.random.choice([1, 2])) for part in ("-P", self.override(target.read_text()))]
        else:
            changed = self.random.choice(references) if kind == "reference" else target
            changed.write_text(self.changed(changed.read_text()))
        if kind == "study":
            command = ["study", target, "--list"]
        elif self.random.random() < 0.5:
            command = ["check", target, *overrides]
        else:
            command = ["run", target, "-o", self.scratch / "scene_run", "--force", "-q", "-j", 1, "--tend", "1e-6", *overrides]
        self.answers(number, kind, given, command, folder)
        return 1

    def answers(self, number, kind, given, command, folder):
        """Runs the command with little memory, so that scenes of many particles are refused."""
        most = 400 * 2**20
        process = self.start(*command, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_DATA, (most, most)))
        asked = False
        try:
            _, said = process.communicate(timeout=AN_ANSWER)
        except subprocess.TimeoutExpired:
            asked = command[0] == "run"
            process.send_signal(signal.SIGTERM if asked else signal.SIGKILL)
            try:
                _, said = process.communicate(timeout=AN_ANSWER)
            except subprocess.TimeoutExpired:
                process.kill()
                _, said = process.communicate()
        code = process.returncode
        self.codes[code] = self.codes.get(code, 0) + 1
        good = code in EXIT_CODES or (asked and code == 128 + signal.SIGTERM)
        good = good or (kind == "reference" and code == 1)  # a file that cannot be read
        if good and (code == 0 or said.strip()) and "internal error" not in said:
            return
        kept = pathlib.Path(tempfile.mkdtemp(prefix="undex_torture_scene_"))
        shutil.copytree(folder, kept, dirs_exist_ok=True)
        arguments = " ".join(repr(str(part).replace(str(folder), str(kept))) for part in command)
        self.fail(f"scenes, {number}, {kind} of {given.parent.name}: exit code {code}: {said[-300:]}\n  undex {arguments}")


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("program", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("cases", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("kind", choices=["kills", "every", "disks", "checkpoints", "scenes"])
    parser.add_argument("--count", type=int, default=COUNT)
    parser.add_argument("--seed", type=int, default=int(time.time()))
    parser.add_argument("--first", type=int, default=0, help="number of the first, to go on where a round was cut off")
    parser.add_argument("--minutes", type=float, default=1e9, help="begin none after so long")
    arguments = parser.parse_args()
    one = {"kills": Torture.kill, "every": Torture.kill, "disks": Torture.disk, "checkpoints": Torture.checkpoint,
           "scenes": Torture.scene}[arguments.kind]
    done = events = 0
    with tempfile.TemporaryDirectory(prefix="undex_torture_") as scratch:
        torture = Torture(arguments, pathlib.Path(scratch))
        if arguments.kind == "every":
            left = len(torture.scenes) - arguments.first
            arguments.count = min(arguments.count, left) if arguments.count != COUNT else left
        since = time.monotonic()
        while done < arguments.count and time.monotonic() - since < 60 * arguments.minutes:
            events += one(torture, arguments.first + done)
            done += 1
        print(f"{arguments.kind}, seed {arguments.seed}: {done} runs, {events} events, {len(torture.failures)} failed"
              + (f"; exit codes {dict(sorted(torture.codes.items()))}" if torture.codes else ""))
    return 1 if torture.failures else 0


if __name__ == "__main__":
    sys.exit(main())
