#!/usr/bin/env python3
"""The program from outside: exit codes, messages, what is written and what is left alone, signals, full and read-only disks.

    command_line.py PROGRAM CASES_FOLDER [unittest's options and names, e.g. Signals.test_interrupt]
    command_line.py --names

Exit codes: 0 done, 1 internal or I/O, 2 usage or scene, 3 stopped by the numerics, 130 and 143 interrupted and terminated.
"""
import csv
import fcntl
import json
import math
import os
import pathlib
import pty
import re
import resource
import select
import shutil
import signal
import stat
import struct
import subprocess
import sys
import tempfile
import termios
import time
import unittest
import xml.etree.ElementTree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "regression"))
import undex_runs as runs  # noqa: E402

PROGRAM = CASES = None
# The program of the preset "checked": it is slow, needs terabytes of address space, and takes SIGSEGV for its own.
SANITIZED = os.environ.get("UNDEX_SANITIZE") == "ON"
NOBODY = 65534
# A tenth of a second of work: gas in one dimension.
QUICK = {"resolution.spacing": 0.01, "end_time": 0.02, "output.field_times": "[]"}
# Seconds of it: only to be interrupted.
LONG = {"resolution.spacing": 0.006, "start.kind": "plain", "end_time": 0.1, "output.field_times": "[]"}
# tube_pulse with a load that turns its cells inside out.
CRUSHED = {"structure.cells": "{through = 2, around = 16, along = 8}", "output.history_interval": 0, "output.field_interval": 0,
           "structure.loads.0.time": "[0, 2e-5, 3e-5, 4e-5]", "structure.loads.0.pressure": "[0, 3e10, 3e10, 0]"}


def contents(folder):
    """Every file of a folder with its bytes, every folder with None."""
    return {str(path.relative_to(folder)): path.read_bytes() if path.is_file() else None for path in pathlib.Path(folder).rglob("*")}


def as_nobody():
    """For preexec_fn: file permissions do not bind root."""
    if os.geteuid() == 0:
        os.setgroups([])
        os.setgid(NOBODY)
        os.setuid(NOBODY)


class Case(unittest.TestCase):
    """Each test in an empty working folder of its own."""

    maxDiff = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="undex_command_line_")
        self.addCleanup(folder.cleanup)
        self.here = pathlib.Path(folder.name)

    def undex(self, *arguments, **options):
        options.setdefault("cwd", self.here)
        return runs.call(PROGRAM, *arguments, **options)

    def quick(self, output="out", *arguments, changes=(), **options):
        settings = {**QUICK, **dict(changes)}
        return self.undex("run", CASES / "sjogreen", "-o", output, "-q", *runs.overrides(settings), *arguments, **options)

    def ends(self, finished, code, *patterns):
        said = f"exit {finished.returncode}\n{finished.stdout}\n{finished.stderr}"
        self.assertEqual(finished.returncode, code, said)
        if code != 0:
            self.assertTrue(finished.stderr.strip(), "no message on stderr")
        for pattern in patterns:
            self.assertRegex(finished.stderr, pattern)

    def scene(self, text, name="case.toml"):
        path = self.here / name
        path.write_text(text)
        return path

    def interrupted_record(self, folder, status, message):
        record = runs.summary(folder)
        self.assertEqual(record["status"], status)
        self.assertRegex(record["message"], message)
        tables = runs.histories(folder)
        self.assertGreater(len(tables), 1)
        for name, table in tables.items():
            self.assertTrue(table.ends_whole, name)
            self.assertTrue(all(len(row) == len(table.names) for row in table.rows), name)
            # The step that the numerics stopped is not sampled: the structure may have begun it.
            self.assertIn(len(table.rows), (record["steps"] + 1, record["steps"] + (status == "interrupted")), name)
            self.assertLess(abs(table.column("time")[-1] / record["time_s"] - 1), 1e-7 if status == "interrupted" else 0.5, name)
        return record


class Mistakes(Case):
    GAS = """end_time = 1e-3
dimension = 1
[resolution]
spacing = 0.01
[[bodies]]
name = "gas"
shape = {type = "box", low = 0, high = 1}
material = {law = "ideal_gas", rho0 = 1, gamma = 1.4}
energy = 2.5
"""

    def nothing_written(self, before):
        self.assertEqual(contents(self.here), before)

    def test_unknown_key(self):
        scene = self.scene(self.GAS.replace("energy = 2.5", "energie = 2.5"))
        before = contents(self.here)
        for command in ("run", "check"):
            self.ends(self.undex(command, scene), 2, r"case\.toml:9:1: .*energie", r"did you mean '?energy")
            self.nothing_written(before)

    def test_every_mistake_at_once(self):
        scene = self.scene(self.GAS.replace("spacing = 0.01", "spacing = -1\nlatice = 'x'").replace("gamma = 1.4", "gamma = 'a'"))
        before = contents(self.here)
        finished = self.undex("run", scene)
        self.ends(finished, 2, r"case\.toml:4:\d+: .*spacing", r"case\.toml:5:1: .*latice", r"case\.toml:9:\d+: .*gamma")
        self.nothing_written(before)

    def test_not_toml(self):
        scene = self.scene(self.GAS + "energy = = 2\n")
        before = contents(self.here)
        self.ends(self.undex("run", scene), 2, r"case\.toml:10:\d+: not TOML")
        self.nothing_written(before)

    def test_very_many_mistakes(self):
        """What nobody reads is counted, not said."""
        scene = self.scene("".join(f"key{k} = {k}\n" for k in range(100000)) + self.GAS)
        finished = self.undex("check", scene)
        self.ends(finished, 2, r"case\.toml:1:1: unknown key 'key0'", r"and \d+ more; mend these first")
        self.assertLess(len(finished.stderr), 100000)

    def test_picture(self):
        flat = self.GAS.replace("dimension = 1", "dimension = 2").replace("low = 0, high = 1", "low = [0, 0], high = [1, 0.5]")
        scene = self.scene(flat + '[[obstacles]]\nname = "egg"\nshape = {type = "ellipsoid", center = [0.5, 0.25], '
                                  'semi_axes = [0.2, 0.1], rotate = 30}\n[[probes]]\nname = "here"\npoint = [0.1, 0.1]\n')
        before = contents(self.here)
        self.ends(self.undex("check", scene, "--picture", "scene.png"), 1, r"scene\.png: pictures are drawn as \.svg")
        self.nothing_written(before)
        self.ends(self.undex("check", scene, "--picture", "scene.svg"), 0)
        drawing = (self.here / "scene.svg").read_text()
        xml.etree.ElementTree.fromstring(drawing)
        for word in ("gas", "obstacles", "here"):
            self.assertIn(f">{word}<", drawing)
        self.assertLess(abs(drawing.count("z\"") + drawing.count("zM") - 4372), 20)  # a square each: (0.5 - 0.02 pi) / spacing^2

    def test_what_never_ends(self):
        self.ends(self.undex("check", "/dev/zero", timeout=60), 1, "/dev/zero: larger than")

    def test_wrong_override(self):
        for change, says in (({"resolution.spacng": 1}, r"-P resolution\.spacng.*did you mean"),
                             ({"bodies.lefd.density": 1}, r"-P bodies\.lefd.*left"),
                             ({"bodies.7.density": 1}, r"-P bodies\.7"),
                             ({"resolution.spacing": "[1"}, r"-P resolution\.spacing.*cannot read"),
                             ({"end_time": -1}, r"-P end_time")):
            with self.subTest(change=change):
                self.ends(self.quick(changes=change), 2, says)
                self.nothing_written({})

    def test_a_start_that_cannot_be(self):
        """What only the one-dimensional start can know is a mistake of the scene like any other: refused before writing."""
        for change in ({"start.time": 1e-3}, {"resolution.spacing": 0.012}):
            settings = {"resolution.spacing": 0.006, "start.kind": "spherical", **change}
            for command in (["run", "-o", "out"], ["check"]):
                with self.subTest(change=change, command=command[0]):
                    finished = self.undex(command[0], CASES / "rigid_cylinder", *command[1:], *runs.overrides(settings))
                    written = sorted(contents(self.here))
                    shutil.rmtree(self.here / "out", ignore_errors=True)
                    self.ends(finished, 2, r"start\.(kind|time)", r"case\.toml:\d+:\d+: |-P start")
                    self.assertEqual(written, [])

    @unittest.skipIf(SANITIZED, "its address space cannot be limited")
    def test_more_memory_than_there_is(self):
        """Refused from volumes and counts, before anything is allocated: the shell allows one gigabyte and a half."""
        most = 1500 * 2**20
        for scene, change in (("rigid_cylinder", {"resolution.spacing": 2e-4}),
                              ("tube_pulse", {"structure.cells": "{through = 20, around = 2000, along = 1000}"})):
            for command in (["run", "-o", "out"], ["check"]):
                with self.subTest(scene=scene, command=command[0]):
                    began = time.monotonic()
                    finished = self.undex(command[0], CASES / scene, *command[1:], *runs.overrides(change),
                                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_DATA, (most, most)))
                    self.ends(finished, 2, r"-P \S+: .* need about [\d.]+ GB of memory; this machine has 1\.57 GB; take")
                    self.assertLess(time.monotonic() - began, 20)
                    self.nothing_written({})

    def test_a_solver_names_the_place(self):
        """A body without a particle is found when the lattice is laid out."""
        scene = self.scene(self.GAS.replace("dimension = 1", "dimension = 2").replace("low = 0, high = 1}", "low = [0, 0], high = [1, 1]}")
                           .replace("spacing = 0.01", "spacing = 0.4") + """
[[bodies]]
name = "drop"
shape = {type = "sphere", center = [2.0, 2.0], radius = 0.21}
material = {law = "ideal_gas", rho0 = 1, gamma = 1.4}
energy = 2.5
""")
        finished = self.undex("check", scene)
        self.ends(finished, 2, r"case\.toml:11:\d+: body 'drop' gets no particle")

    def test_a_structure_with_wrong_supports(self):
        """Findings of the solvers' own set-up come before anything is written too."""
        change = {"structure.supports": '[{face = "middle"}]'}
        self.ends(self.undex("run", CASES / "tube_pulse", "-o", "out", *runs.overrides(change)), 2, "middle")
        self.nothing_written({})

    def test_command_line(self):
        scene = CASES / "sjogreen"
        for arguments in ([], ["rum"], ["run"], ["run", scene, "--colour"], ["run", scene, "-j", "-1"], ["run", scene, "-j", "two"],
                          ["run", scene, "-P", "spacing"], ["run", scene, "-P", "=3"], ["run", scene, "-P"],
                          ["run", scene, "-q", "-v"], ["run", scene, scene], ["check"], ["run", scene, "--tend", "soon"],
                          ["version", "--xml"], ["run", scene, "-P", "a..b=1"]):
            with self.subTest(arguments=arguments):
                finished = self.undex(*arguments)
                self.assertEqual(finished.returncode, 2, finished.stderr)
                self.assertTrue(finished.stderr + finished.stdout)
                self.nothing_written({})

    def test_scene_that_cannot_be_read(self):
        (self.here / "empty").mkdir()
        before = contents(self.here)
        for scene in ("missing.toml", "missing", "empty"):
            for command in ("run", "check"):
                with self.subTest(scene=scene, command=command):
                    self.ends(self.undex(command, scene), 1, scene)
                    self.nothing_written(before)

    def test_scene_without_permission(self):
        scene = self.scene(self.GAS)
        self.here.chmod(0o755)
        scene.chmod(0)
        self.needs_nobody()
        self.ends(self.undex("check", scene, preexec_fn=as_nobody), 1, r"case\.toml")

    def needs_nobody(self):
        if subprocess.run(["test", "-x", str(PROGRAM)], preexec_fn=as_nobody).returncode != 0:
            self.skipTest("another user may not run the program here")


class OutputFolder(Case):
    def test_default_name(self):
        finished = self.undex("run", CASES / "sjogreen", *runs.overrides(QUICK))
        self.ends(finished, 0)
        self.assertEqual(runs.summary(self.here / "out" / "sjogreen")["status"], "done")

    def test_last_end_time_counts(self):
        self.ends(self.quick("a", "--tend", "0.01"), 0)
        self.assertAlmostEqual(runs.summary(self.here / "a")["time_s"], 0.01)
        self.ends(self.quick("b", "--tend", "0.01", "-P", "end_time=0.015"), 0)
        self.assertAlmostEqual(runs.summary(self.here / "b")["time_s"], 0.015)

    def test_not_empty(self):
        (self.here / "out").mkdir()
        (self.here / "out" / "thesis.txt").write_text("my only copy")
        before = contents(self.here)
        self.ends(self.quick(), 2, r"\bout\b.*not empty.*-o.*--force")
        self.assertEqual(contents(self.here), before)
        self.ends(self.quick("out", "--force"), 0)
        self.assertEqual(runs.summary(self.here / "out")["status"], "done")
        self.assertEqual((self.here / "out" / "thesis.txt").read_text(), "my only copy")

    def test_empty_one_is_taken(self):
        (self.here / "out").mkdir()
        self.ends(self.quick(), 0)

    def test_file_in_its_place(self):
        (self.here / "out").write_text("a file")
        for arguments in ([], ["--force"]):
            self.ends(self.quick("out", *arguments), 2, r"\bout\b.*not a folder.*-o")
        self.ends(self.quick("out/deeper"), 1, r"out/deeper.*-o")
        self.assertEqual((self.here / "out").read_text(), "a file")

    def test_written_over(self):
        """After a run into a used folder nothing of the older run passes for a result of the newer."""
        self.ends(self.quick("out", changes={"end_time": 0.01, "output.field_times": "[0.005, 0.01]"}), 0)
        self.ends(self.quick("out", "--force"), 0)
        self.ends(self.quick("fresh"), 0)
        self.assertEqual((self.here / "out" / "energy.csv").read_text(), (self.here / "fresh" / "energy.csv").read_text())
        self.assertEqual(runs.summary(self.here / "out")["time_s"], runs.summary(self.here / "fresh")["time_s"])

    def test_holds_the_new_run_only(self):
        """Histories, fields, pictures and whatever else an older run has left are gone; what is somebody else's stays."""
        self.ends(self.quick("fresh"), 0)
        self.ends(self.quick("out", changes={"output.field_times": "[0.01, 0.02]"}), 0)
        self.assertTrue((self.here / "out/fields/particles.h5part").is_file())
        for name in ("history/gone.csv", "fields/structure_00003.hdf", "checkpoint_2.h5", "profile.csv", "pictures/energy.png"):
            (self.here / "out" / name).parent.mkdir(exist_ok=True)
            (self.here / "out" / name).write_text("time [s],pressure [Pa]\n0,1\n")
        for name in ("thesis.txt", "history/notes.txt", "pictures/mine.png"):
            (self.here / "out" / name).write_text("my only copy")
        self.ends(self.quick("out", "--force"), 0)
        self.assertEqual(contents(self.here / "out").keys() - contents(self.here / "fresh").keys(),
                         {"thesis.txt", "history", "history/notes.txt", "pictures", "pictures/mine.png"})
        self.assertEqual(contents(self.here / "fresh").keys() - contents(self.here / "out").keys(), set())

    def test_a_link_is_not_followed(self):
        self.ends(self.quick("old", changes={"output.field_times": "[0.01]"}), 0)
        before = contents(self.here / "old")
        (self.here / "out").mkdir()
        for name in ("fields", "energy.csv", "summary.json"):
            (self.here / "out" / name).symlink_to(self.here / "old" / name)
        self.ends(self.quick("out", "--force", changes={"output.field_times": "[0.02]"}), 0)
        self.assertEqual(contents(self.here / "old"), before)
        self.assertFalse((self.here / "out" / "fields").is_symlink())

    def test_what_is_no_file(self):
        """A folder or a pipe with the name of one of a run's files: said before the run, and nothing waits for a writer."""
        for name in ("summary.json", "energy.csv", "evidence.h5", "resolved.toml"):
            for make in (os.mkdir, os.mkfifo):
                with self.subTest(name=name, make=make.__name__):
                    self.ends(self.quick("out", "--force"), 0)
                    (self.here / "out" / name).unlink()
                    make(self.here / "out" / name)
                    before = sorted(path.name for path in (self.here / "out").iterdir())
                    self.ends(self.quick("out", "--force", timeout=20), 2, rf"out/{name} is no file.*-o")
                    self.assertEqual(sorted(path.name for path in (self.here / "out").iterdir()), before)
                    shutil.rmtree(self.here / "out")

    def test_two_runs_at_once(self):
        """One folder, one process: the others are told which, whatever they want, and spoil nothing."""
        settings = {**LONG, "comparison.reference": f'"{CASES}/rigid_cylinder/reference/metrics.csv"'}
        arguments = ["run", CASES / "rigid_cylinder", "-o", "deep/out", *runs.overrides(settings)]
        with subprocess.Popen([PROGRAM, *arguments, "-v"], cwd=self.here, stdout=subprocess.PIPE, text=True,
                              env=runs.ENVIRONMENT) as process:
            Signals.wait_for_steps(process, 1)
            names = sorted(contents(self.here / "deep/out"))
            for other in (arguments, [*arguments, "--force"], ["run", CASES / "sjogreen", "-o", "deep/out", "--force"]):
                self.ends(self.undex(*other), 2, rf"deep/out is in use by undex run, process {process.pid}.*-o")
            self.ends(self.undex("judge", "deep/out"), 2, "deep/out.*wait for it")
            self.assertEqual(sorted(contents(self.here / "deep/out")), names)
            self.assertIsNone(process.poll())
            process.kill()
        # What a killed one leaves behind binds nobody.
        self.ends(self.undex("run", CASES / "sjogreen", "-q", "-o", "deep/out", "--force", *runs.overrides(QUICK)), 0)
        self.assertNotIn(".lock", contents(self.here / "deep/out"))

    def test_a_race_for_a_fresh_folder(self):
        """Of runs that start together one computes; what it leaves is what it leaves alone."""
        settings = {**QUICK, "end_time": 0.1, "resolution.spacing": 0.002}
        command = [PROGRAM, "run", CASES / "sjogreen", "-q", "--force", *runs.overrides(settings)]
        self.ends(self.undex(*command[1:], "-o", "alone"), 0)
        racers = [subprocess.Popen([*command, "-o", "out"], cwd=self.here, stderr=subprocess.PIPE, text=True, env=runs.ENVIRONMENT)
                  for _ in range(4)]
        said = [racer.communicate(timeout=120)[1] for racer in racers]
        codes = [racer.returncode for racer in racers]
        self.assertIn(0, codes)
        self.assertLessEqual(set(codes), {0, 2}, said)
        for code, text in zip(codes, said):
            self.assertEqual(text, "") if code == 0 else self.assertRegex(
                    text, r"out is in use by (undex run, process \d+|another undex)")
        self.assertEqual(runs.differences(self.here / "out", self.here / "alone"), [])

    def test_stale_summary(self):
        """A run over an older one that is killed must not leave the older one's 'done'."""
        self.ends(self.undex("run", CASES / "rigid_cylinder", "-o", "out", "-q", *runs.overrides({**LONG, "end_time": 2e-6})), 0)
        with subprocess.Popen([PROGRAM, "run", CASES / "rigid_cylinder", "-o", "out", "-v", "--force", *runs.overrides(LONG)],
                              cwd=self.here, stdout=subprocess.PIPE, text=True, env=runs.ENVIRONMENT) as process:
            Signals.wait_for_steps(process, 3)
            process.kill()
        try:
            self.assertNotEqual(runs.summary(self.here / "out")["status"], "done")
        except FileNotFoundError:
            pass  # no summary is as good


class Disk(Case):
    def test_read_only_folder(self):
        self.here.chmod(0o755)
        Mistakes.needs_nobody(self)
        home = self.here / "results"
        home.mkdir(mode=0o755)
        self.ends(self.quick(home / "old"), 0)
        (home / "old").chmod(0o555)
        home.chmod(0o555)
        before = contents(home)
        self.ends(self.quick(home / "new", preexec_fn=as_nobody), 1, r"results/new.*-o")
        self.ends(self.quick(home / "old", "--force", preexec_fn=as_nobody), 1, r"results/old.*-o")
        self.assertEqual(contents(home), before)
        home.chmod(0o755)
        (home / "old").chmod(0o755)

    def limited(self, bytes_per_file, field_times="[0.01, 0.02]", **more):
        """A run that may write so many bytes into a file; each further one fails as on a full disk."""
        return self.quick("out", "--force", changes={"output.field_times": field_times, "end_time": 0.1, "resolution.spacing": 0.001},
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (bytes_per_file, bytes_per_file)), **more)

    def test_no_byte_can_be_written(self):
        self.ends(self.quick(), 0)
        before = contents(self.here)
        self.ends(self.limited(0), 1, r"cannot write out/scene\.toml: .*-o")
        self.assertEqual(contents(self.here), before)

    def test_full_while_running(self):
        for bytes_per_file, field_times, victim in ((4096, "[]", r"energy\.csv"), (4096, "[0.01]", r"particles\.h5part")):
            with self.subTest(victim=victim):
                self.ends(self.quick("out", "--force"), 0)
                self.ends(self.limited(bytes_per_file, field_times), 1, rf"cannot write out/\S*{victim}: .*-o")
                if field_times == "[]":  # a step has been taken
                    record = runs.summary(self.here / "out")
                    self.assertEqual(record["status"], "failed")
                    self.assertRegex(record["message"], rf"cannot write out/\S*{victim}")
                self.assertFalse((self.here / "out/summary.json").exists() and runs.summary(self.here / "out")["status"] == "done")
                for name, table in runs.histories(self.here / "out").items():
                    self.assertTrue(table.ends_whole, name)
                self.assertFalse([p for p in contents(self.here) if p.endswith(".part")], "a temporary file was left")

    def test_a_folder_that_goes_away(self):
        """What becomes of the files of a run that has ended does not cost its record: evidence.h5 cannot be written here."""
        with subprocess.Popen([PROGRAM, "run", CASES / "sjogreen", "-o", "out", "-v", *runs.overrides({**QUICK, "resolution.spacing": 0.002})],
                              cwd=self.here, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=runs.ENVIRONMENT) as process:
            Signals.wait_for_steps(process, 1)
            (self.here / "out/evidence.h5").mkdir()
            _, said = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 1, said)
        self.assertRegex(said, r"cannot write out/evidence\.h5: .*-o")
        self.assertEqual(runs.summary(self.here / "out")["status"], "done")

    def test_full_file_system(self):
        """The real thing, where the kernel lets us mount a small file system."""
        if os.geteuid() != 0 or not shutil.which("unshare"):
            self.skipTest("only root may mount")
        for folder in ("small", "copy"):
            (self.here / folder).mkdir()
        script = """mount -t tmpfs -o size=1m tmpfs small || exit 77
            "$@" -o small/first || exit 78
            dd if=/dev/zero of=small/filling bs=1k count=1100 2>/dev/null; cp -a small copy/before
            "$@" -o small/first --force; code=$?
            cp -a small copy/after; exit $code"""
        finished = subprocess.run(["unshare", "-m", "sh", "-c", script, "sh", PROGRAM, "run", CASES / "sjogreen", "-q",
                                   *runs.overrides(QUICK)], cwd=self.here, env=runs.ENVIRONMENT, text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        if finished.returncode == 77 or "unshare" in finished.stderr:
            self.skipTest(finished.stderr.strip())
        self.ends(finished, 1, r"cannot write small/first/\S+: No space left on device; free some space")
        self.assertEqual(contents(self.here / "copy" / "after"), contents(self.here / "copy" / "before"))


class Signals(Case):
    @staticmethod
    def wait_for_steps(process, count):
        for line in process.stdout:
            count -= bool(re.match(r"\s*\d+ ", line))
            if count <= 0:
                return
        raise AssertionError(f"the run ended by itself: {process.wait()}")

    def signalled(self, number, scene="rigid_cylinder", settings=LONG):
        with subprocess.Popen([PROGRAM, "run", CASES / scene, "-o", "out", "-v", *runs.overrides(settings)], cwd=self.here,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=runs.ENVIRONMENT) as process:
            self.wait_for_steps(process, 5)
            process.send_signal(number)
            process.stdout.read()
            self.said = process.stderr.read()
            return process.wait(timeout=120)

    def test_interrupt(self):
        self.assertEqual(self.signalled(signal.SIGINT), 130)
        record = self.interrupted_record(self.here / "out", "interrupted", "SIGINT")
        self.assertGreaterEqual(record["steps"], 5)

    def test_terminate(self):
        self.assertEqual(self.signalled(signal.SIGTERM), 143)
        self.assertIn("interrupted by SIGTERM; to go on: undex resume out", self.said)
        self.interrupted_record(self.here / "out", "interrupted", "SIGTERM")

    def test_every_signal_that_asks_for_an_end(self):
        """From a terminal that goes away, a batch system, a limit: the present step is finished and everything is recorded."""
        for name in ("SIGHUP", "SIGQUIT", "SIGUSR1", "SIGUSR2", "SIGALRM", "SIGXCPU"):
            with self.subTest(signal=name):
                number = getattr(signal, name)
                self.assertEqual(self.signalled(number), 128 + number)
                self.interrupted_record(self.here / "out", "interrupted", name)
                shutil.rmtree(self.here / "out")

    def test_a_limit_of_cpu_time(self):
        """The kernel repeats SIGXCPU every second: the run ends by the first all the same."""
        settings = {**LONG, "resolution.spacing": 0.004}
        finished = self.undex("run", CASES / "rigid_cylinder", "-o", "out", "-q", *runs.overrides(settings),
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (8 if SANITIZED else 2, 60)))
        self.assertEqual(finished.returncode, 128 + signal.SIGXCPU, finished.stderr)
        self.interrupted_record(self.here / "out", "interrupted", "SIGXCPU")

    def test_nohup(self):
        """A run that was started to outlive its terminal does."""
        command = [PROGRAM, "run", CASES / "sjogreen", "-o", "out", "-v", *runs.overrides({**QUICK, "resolution.spacing": 0.002})]
        with subprocess.Popen(command, cwd=self.here, stdout=subprocess.PIPE, text=True, env=runs.ENVIRONMENT,
                              preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN)) as process:
            self.wait_for_steps(process, 3)
            process.send_signal(signal.SIGHUP)
            process.stdout.read()
            self.assertEqual(process.wait(timeout=120), 0)
        self.assertEqual(runs.summary(self.here / "out")["status"], "done")

    def test_kill(self):
        """Whenever a run is killed: whole rows, all files as far as each other, and what was computed a second ago is there."""
        for steps, spacing in ((1, 0.003), (2, 0.004), (4, 0.006)):
            with self.subTest(steps=steps):
                settings = {**LONG, "resolution.spacing": spacing}
                with subprocess.Popen([PROGRAM, "run", CASES / "rigid_cylinder", "-o", "out", "-v", "--force", *runs.overrides(settings)],
                                      cwd=self.here, stdout=subprocess.PIPE, text=True, env=runs.ENVIRONMENT) as process:
                    self.wait_for_steps(process, steps)
                    time.sleep(1)
                    process.kill()
                tables = runs.histories(self.here / "out")
                self.assertGreater(len(tables), 1)
                self.assertEqual({len(table.rows) for table in tables.values()}, {len(tables["energy.csv"].rows)})
                for name, table in tables.items():
                    self.assertTrue(table.ends_whole, name)
                    self.assertTrue(all(len(row) == len(table.names) for row in table.rows), name)
                    self.assertGreaterEqual(len(table.rows), 1 + steps, name)

    def test_interrupt_of_a_coupled_run(self):
        settings = {**LONG, "structure.cells": "{through = 2, around = 24, along = 12}"}
        self.assertEqual(self.signalled(signal.SIGINT, "al_tube_fem", settings), 130)
        self.interrupted_record(self.here / "out", "interrupted", "SIGINT")

    def test_reader_that_leaves(self):
        """`undex run | head`: a reader of the progress that goes away does not take the run with it."""
        with subprocess.Popen([PROGRAM, "run", CASES / "sjogreen", "-o", "out", "-v", *runs.overrides(QUICK)], cwd=self.here,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, env=runs.ENVIRONMENT) as process:
            process.stdout.readline()
            process.stdout.close()
            process.wait(timeout=120)
        self.assertEqual(runs.summary(self.here / "out")["status"], "done")


class Resume(Case):
    """Runs that are cut go on, or say why they cannot. That they go on to the same bits at any moment is torture.py's."""

    OFTEN = {"output.checkpoint_interval": 1e-3}

    def cut(self, settings=()):
        """A run that SIGTERM has ended; and the settings, with which it is run uncut."""
        settings = {**LONG, "end_time": 2e-4, "output.field_interval": 5e-5, **dict(settings)}
        with subprocess.Popen([PROGRAM, "run", CASES / "rigid_cylinder", "-o", "cut", "-v", *runs.overrides(settings)], cwd=self.here,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=runs.ENVIRONMENT) as process:
            Signals.wait_for_steps(process, 5)
            process.send_signal(signal.SIGTERM)
            process.stdout.read()
            self.assertEqual(process.wait(timeout=120), 143, process.stderr.read())
        return settings

    def test_to_the_same_bits(self):
        settings = self.cut()
        self.ends(self.undex("resume", "cut", "-q", "-j", "1"), 0)
        self.ends(self.undex("run", CASES / "rigid_cylinder", "-o", "whole", "-q", *runs.overrides(settings)), 0)
        self.assertEqual(runs.differences(self.here / "whole", self.here / "cut"), [])

    def test_to_a_later_end(self):
        self.ends(self.quick("out"), 0)
        again = self.undex("resume", "out")
        self.ends(again, 0)
        self.assertIn("--tend", again.stdout)
        self.ends(self.undex("resume", "out", "-q", "--tend", 0.03), 0)
        self.assertAlmostEqual(runs.summary(self.here / "out")["time_s"], 0.03, places=12)
        times = runs.Table(self.here / "out/energy.csv").column("time")
        self.assertEqual(times, sorted(set(times)))

    def test_an_unfinished_run_is_not_run_over(self):
        self.cut()
        self.ends(self.undex("run", CASES / "rigid_cylinder", "-o", "cut", "-q"), 2, "unfinished run: undex resume cut")

    def test_before_the_first_checkpoint(self):
        settings = self.cut({"output.checkpoint_interval": 0})
        self.assertEqual(list((self.here / "cut").glob("checkpoint*")), [])
        self.ends(self.undex("resume", "cut", "-q"), 0)
        self.ends(self.undex("run", CASES / "rigid_cylinder", "-o", "whole", "-q", *runs.overrides(settings)), 0)
        self.assertEqual(runs.differences(self.here / "whole", self.here / "cut"), [])

    def test_what_may_change(self):
        self.cut()
        reached = runs.summary(self.here / "cut")["time_s"]
        resolved = self.here / "cut/resolved.toml"
        resolved.write_text(resolved.read_text() + '\n[[probes]]\nname = "added"\nkind = "fluid"\npoint = [0.03, 0, 0]\n')
        self.ends(self.undex("resume", "cut", "-q", "-P", "output.history_interval=1e-5", "-P", "output.field_interval=0"), 0)
        times = runs.Table(self.here / "cut/history/added.csv").column("time")
        self.assertGreater(times[0], reached)

    def test_half_written_files_go(self):
        self.cut()
        left = [self.here / "cut" / name for name in (".summary.json.123.part", "fields/.structure_00001.hdf.123.part")]
        for path in left:
            path.write_bytes(b"half")
        self.ends(self.undex("resume", "cut", "-q"), 0)
        self.assertEqual([path for path in left if path.exists()], [])

    def test_what_may_not_change(self):
        self.cut()
        for change in ("scheme.courant=0.2", "resolution.spacing=0.005", "bodies.water.pressure=2e5", "start.kind=spherical"):
            with self.subTest(change=change):
                before = contents(self.here / "cut")
                self.ends(self.undex("resume", "cut", "-q", "-P", change), 4, re.escape(change.split("=")[0]))
                self.assertEqual(contents(self.here / "cut"), before)

    def test_other_machine(self):
        self.cut()
        self.ends(self.undex("resume", "cut", "-q", env={**runs.ENVIRONMENT, "UNDEX_CPU_LEVEL": "x86-64-v2"}), 4, "x86-64-v2")

    def test_damaged_ones(self):
        self.quick("whole", changes=self.OFTEN)
        shutil.copytree(self.here / "whole", self.here / "out")
        (self.here / "out/summary.json").unlink()
        for name in ("checkpoint.h5", "checkpoint_before.h5"):
            path = self.here / "out" / name
            data = bytearray(path.read_bytes())
            data[len(data) // 2] ^= 16
            path.write_bytes(data)
            finished = self.undex("resume", "out", "-q", "-P", "output.checkpoint_interval=1e9")  # one more, at the end
            if name == "checkpoint.h5":
                self.ends(finished, 0)
                self.assertRegex(finished.stderr, "checkpoint.h5: the file is damaged")
                self.assertEqual(runs.differences(self.here / "whole", self.here / "out"), [])
                (self.here / "out/summary.json").unlink()
                for other in (self.here / "out").glob("checkpoint*.h5"):  # no damaged one has taken a good one's place
                    self.assertTrue(other.read_bytes() != bytes(data), other)
                path.write_bytes(data)
            else:
                self.ends(finished, 4, "damaged", "--force")

    def test_a_stopped_run_stops_again(self):
        settings = {**LONG, "scheme.courant": 1.0, "resolution.spacing": 0.006}
        self.ends(self.undex("run", CASES / "rigid_cylinder", "-o", "out", "-q", *runs.overrides(settings)), 3, "energy balance")
        first = runs.summary(self.here / "out")
        self.ends(self.undex("resume", "out", "-q"), 3, "energy balance")
        again = runs.summary(self.here / "out")
        self.assertEqual(again["status"], "stopped")
        self.assertGreater(again["steps"], first["steps"])  # the checkpoint holds the stop's whole step

    def test_what_is_no_run(self):
        (self.here / "empty").mkdir()
        self.ends(self.undex("resume", "empty"), 2, "no run to go on with")
        self.ends(self.undex("resume", "absent"), 2, "no such folder")


class Pictures(Case):
    def test_of_a_run_that_was_killed(self):
        """A last row that is cut anywhere is left out, and its file is not."""
        if runs.call(sys.executable, "-c", "import numpy, matplotlib").returncode != 0:
            self.skipTest("no Matplotlib")
        self.ends(self.undex("run", CASES / "water_shock_tube", "-o", "out", "-q", "-P", "output.field_times=[]", "--tend", "2e-5",
                             "-P", 'probes=[{name="p", kind="fluid", point=[0.1]}]'), 0)
        (self.here / "out/summary.json").unlink()
        names = ("energy.csv", "history/p.csv")
        texts = {name: (self.here / "out" / name).read_text() for name in names}
        cuts = {name: (text.rstrip("\n").rfind("\n") + 2, text.rfind(",") + 2, len(text) - 2, text.rfind(",") + 1)
                for name, text in texts.items()}
        for k in range(4):
            ends = {name: texts[name][cuts[name][0] - 1:cuts[name][k]] for name in names}
            with self.subTest(ends=ends):
                for name in names:
                    (self.here / "out" / name).write_text(texts[name][:cuts[name][k]])
                finished = self.undex("plot", "out")
                self.assertNotIn("Left out", finished.stdout)
                for picture in ("histories.png", "energy.png"):
                    self.assertIn(picture, finished.stdout)


class Numerics(Case):
    def stopped(self, scene, changes, *patterns):
        finished = self.undex("run", CASES / scene, "-o", "out", "-q", *runs.overrides(changes))
        self.ends(finished, 3, *patterns)
        record = self.interrupted_record(self.here / "out", "stopped", patterns[0])
        self.assertIn(record["message"], finished.stderr)

    def test_fluid(self):
        finished = self.undex("run", CASES / "rigid_cylinder", "-o", "out", "-q",
                              *runs.overrides({**LONG, "bodies.bubble.radial_velocity": 1e8}))
        self.ends(finished, 3, r"step \d+, time [\d.e-]+ s: .*particle \d+ \(body '(water|bubble)'\).*"
                               r"\([-\d.e+]+, [-\d.e+]+, [-\d.e+]+\) m")

    def test_structure(self):
        self.stopped("tube_pulse", CRUSHED, r"step \d+, time [\d.e-]+ s: cell \d+.*step of [\d.e-]+ s was set by")

    def test_energy_out_of_balance(self):
        """Too large a step for a scheme that dissipates little: every value stays finite, and the result means nothing."""
        self.stopped("rigid_cylinder", {**LONG, "scheme.courant": 1.0, "resolution.spacing": 0.006},
                     r"time [\d.e-]+ s: the energy balance is off by \d+ %.*scheme.courant")

    def test_the_last_step_is_looked_at(self):
        """However few steps a run has: one whose last step has put the energy off does not end as done."""
        plain = {"resolution.spacing": 0.006, "start.kind": "plain", "output.field_times": "[]"}
        for step, steps in ((4e-5, 1), (1e-5, 1), (1e-4, 1), (6e-6, 2), (4e-6, 3)):
            with self.subTest(step=step, steps=steps):
                finished = self.undex("run", CASES / "rigid_cylinder", "-o", "out", "-q", "--force",
                                      *runs.overrides({**plain, "scheme.fixed_step": step, "end_time": step * steps}))
                self.ends(finished, 3, "fixed_step")
                self.assertEqual(runs.summary(self.here / "out")["status"], "stopped")
                self.assertEqual(len(runs.histories(self.here / "out")["energy.csv"].rows), steps + 1)

    def test_a_sound_short_run(self):
        """One step, in which the work of a load that sets in is behind the energy by all of it: nothing is wrong with that."""
        settings = {"structure.cells": "{through = 2, around = 16, along = 8}", "output.history_interval": 0,
                    "output.field_interval": 0, "end_time": 1e-9}
        self.ends(self.undex("run", CASES / "tube_pulse", "-o", "out", "-q", *runs.overrides(settings)), 0)
        record = runs.summary(self.here / "out")
        self.assertEqual((record["status"], record["steps"]), ("done", 1))
        self.assertAlmostEqual(record["time_s"], 1e-9)
        self.assertGreater(abs(record["energy_error"]), 0.5)

    @unittest.skipUnless(runs.h5py, "no h5py")
    def test_last_state_is_on_disk(self):
        """A step far too long: the last state before it went wrong is a snapshot, though the scene asks for none, and no value
        that is not finite is in any file."""
        coarse = {"resolution.spacing": 0.006, "start.kind": "plain", "output.field_times": "[]", "scheme.fixed_step": 1e-4}
        for scene, changes in (("rigid_cylinder", {}), ("al_tube_fem", {"structure.cells": "{through = 2, around = 24, along = 12}"}),
                               ("al_tube_sph", {"solids.tube.spacing": 0.003175}),
                               ("rigid_cylinder", {"scheme.name": "monaghan", "scheme.kernel": "gaussian", "scheme.fixed_step": 1e-5})):
            with self.subTest(scene=scene, **changes):
                folder = self.here / "out"
                finished = self.undex("run", CASES / scene, "-o", folder, "-q", "--force", *runs.overrides({**coarse, **changes}))
                self.ends(finished, 3, r"time [\d.e-]+ s: .*(particle|cell) \d+.*\([-\d.e+]+, [-\d.e+]+, [-\d.e+]+\) m.*fields/ ends with")
                record = runs.summary(folder)
                for name, table in runs.histories(folder).items():
                    self.assertTrue(all(math.isfinite(value) for row in table.rows for value in row), name)
                for kind in ["particles"] + ["solids"] * (scene == "al_tube_sph"):
                    (time, fields), = runs.particle_steps(folder, kind)
                    self.assertLessEqual(abs(time - record["time_s"]), 0.5001e-4)
                    self.assertEqual(fields["not_finite"].max(), 0)
                    for name, values in fields.items():
                        self.assertTrue(all(math.isfinite(value) for value in values.tolist()), name)
                if scene == "al_tube_fem":
                    (time, path), = runs.structure_steps(folder)
                    for name, values in runs.datasets(path).items():
                        self.assertTrue(all(math.isfinite(value) for value in values.ravel().tolist()), name)

    @unittest.skipUnless(runs.h5py, "no h5py")
    def test_structure_is_left_as_the_step_found_it(self):
        self.stopped("tube_pulse", CRUSHED, r"cell \d+.*fields/ ends with the last sound state")
        table = runs.histories(self.here / "out")["history/midline_outer.csv"]
        (time, path), = runs.structure_steps(self.here / "out")
        self.assertAlmostEqual(time / table.column("time")[-1], 1.0, places=7)
        moved = runs.datasets(path)["VTKHDF/PointData/displacement"]
        self.assertTrue(math.isfinite(float(abs(moved).max())))
        nearest = abs(moved[:, 0] - table.column("displacement_x")[-1]).min()
        self.assertLess(nearest, 1e-6 * abs(table.column("displacement_x")[-1]) + 1e-12)

    def test_remedy_for_a_fixed_step(self):
        finished = self.undex("run", CASES / "rigid_cylinder", "-o", "out", "-q",
                              *runs.overrides({**LONG, "scheme.fixed_step": 1e-5}))
        self.ends(finished, 3, r"fixed_step")


class Compare(Case):
    """undex compare, on runs of a tenth of a second."""

    TUBE = {"structure.cells.around": 16, "structure.cells.along": 8, "end_time": 10e-6, "output.field_interval": 0}

    def tube(self, output, **changes):
        settings = {**self.TUBE, **{key.replace("__", "."): value for key, value in changes.items()}}
        self.ends(self.undex("run", CASES / "tube_pulse", "-o", output, "-q", *runs.overrides(settings)), 0)

    def table(self, folder="out/compare"):
        """Rows of comparison.csv by (quantity, at): {column: text}."""
        with open(self.here / folder / "comparison.csv", newline="") as file:
            return {(row["quantity"], row["at"]): row for row in csv.DictReader(file)}

    def test_meshes(self):
        self.tube("coarse")
        self.tube("fine", structure__cells__along=12)
        before = contents(self.here)
        finished = self.undex("compare", "coarse", "fine", "--at", "10,4")
        self.ends(finished, 0)
        self.assertRegex(finished.stdout, r"(?m)^2x16x8 cells +coarse +tube_pulse, done at 10 us$")
        self.assertRegex(finished.stdout, r"(?m)^midline_outer: radial displacement \[mm\] +2x16x8 cells +2x16x12 cells$")
        self.assertEqual({name: data for name, data in contents(self.here).items() if not name.startswith("out")}, before)

        rows = self.table()
        self.assertEqual(rows["setting", "structure.cells"]["2x16x12 cells"], "2x16x12")
        histories = [runs.histories(folder)["history/midline_outer.csv"] for folder in (self.here / "coarse", self.here / "fine")]
        values = [table.column("displacement_x")[-1] for table in histories]  # the probe lies on the x axis
        row = rows["midline_outer: radial displacement", "10 us"]
        self.assertAlmostEqual(float(row["2x16x8 cells"]), 1e3 * values[0], delta=1e-6 * abs(values[0] * 1e3))
        self.assertAlmostEqual(float(row["2x16x12 cells from 2x16x8 cells [%]"]), 100 * (values[1] / values[0] - 1), places=4)
        self.assertEqual(list(at for name, at in rows if name == "midline_outer: radial velocity"), ["4 us", "10 us", "largest to 10 us"])
        summary = runs.summary(self.here / "fine")
        self.assertEqual(float(rows["cost", "steps"]["2x16x12 cells"]), summary["steps"])
        with open(self.here / "out/compare/curves.csv", newline="") as file:
            curve = [row for row in csv.DictReader(file) if row["quantity"] == "radial velocity" and row["run"] == "2x16x8 cells"]
        self.assertEqual([float(row["value"]) for row in curve], histories[0].column("velocity_x"))

        # A comparison is not written over, unless asked for.
        self.ends(self.undex("compare", "coarse", "fine"), 2, "not empty.*--force")
        self.ends(self.undex("compare", "coarse", "fine", "--force", "--label", "a,b"), 0)
        self.assertIn("b from a [%]", self.table()["cost", "steps"])

    def test_reference_history(self):
        self.tube("coarse")
        self.tube("fine", structure__cells__along=12)
        # Of a run's own history what has no direction is used: which way is outward is not said there.
        finished = self.undex("compare", "fine", "coarse", "--reference", "coarse/history/midline_outer.csv", "--label", "f,c", "-o", "own")
        self.ends(finished, 0)
        self.assertRegex(finished.stdout, r"(?m)^note: of the reference not used: displacement_x \[m\],")
        self.assertEqual(self.table("own")["midline_outer: plastic strain", "10 us"]["c from reference [%]"], "0")
        self.assertEqual(self.table("own")["midline_outer: radial velocity", "10 us"]["reference"], "")
        rows = [line.split(",") for line in (self.here / "coarse/history/midline_outer.csv").read_text().splitlines()]
        (self.here / "ref.csv").write_text("# made\ntime [s],displacement [m]\n" + "".join(f"{r[0]},{r[1]}\n" for r in rows[1:]))
        finished = self.undex("compare", "fine", "coarse", "--reference", "ref.csv", "--label", "f,c")
        self.ends(finished, 0)
        rows = self.table()
        row = rows["midline_outer: radial displacement", "10 us"]
        self.assertLess(abs(float(row["c from reference [%]"])), 1e-6)
        self.assertAlmostEqual(float(row["f from reference [%]"]), 100 * (float(row["f"]) / float(row["c"]) - 1), places=4)
        norms = rows["difference over the common time, of the peak", "midline_outer: radial displacement from the reference, L2"]
        self.assertLess(float(norms["c"]), 1e-6)
        self.assertGreater(float(norms["f"]), 1e-3)

    def test_fluids(self):
        self.ends(self.quick("a"), 0)
        self.ends(self.quick("b", changes={"resolution.spacing": 0.005}), 0)
        finished = self.undex("compare", "a", "b", "-o", "ab")
        self.ends(finished, 0)
        self.assertIn("energy: kinetic [J]", finished.stdout)
        self.assertNotIn("structure", finished.stdout)
        self.assertIn("5 mm from 10 mm [%]", self.table("ab")["energy: kinetic", "20000 us"])
        self.ends(self.undex("compare", "a", "b", "-o", "ab", "--force", "--reference", CASES / "al_tube_fem/reference/displacement.csv"),
                  2, "none of its metrics is a result")

    def test_every_mistake_at_once(self):
        self.ends(self.quick("a"), 0)
        shutil.copytree(self.here / "a", self.here / "unfinished")
        (self.here / "unfinished" / "summary.json").unlink()
        (self.here / "empty").mkdir()
        shutil.copytree(self.here / "a", self.here / "cut")
        (self.here / "cut" / "energy.csv").write_text("time [s],kinetic [J]\n0,1\n1\n")
        (self.here / "words.csv").write_text("hello\n")
        before = contents(self.here)
        self.ends(self.undex("compare", "a", "unfinished", "empty", "cut", "none", "a", "--at", "1,x", "--label", "p,q",
                             "--reference", "words.csv"),
                  2, r"unfinished: the run is not finished \(no summary.json\); wait", "empty: not the folder of a run",
                  r"cut/energy.csv:3", "none: no such folder; give", "a is given twice", "--at 1,x: 'x' is no time",
                  "--label p,q: give one name for each of the 6 runs", "words.csv: neither a table of metrics")
        self.ends(self.undex("compare", "a"), 2, "At least 2 required")
        self.ends(self.undex("compare", "a", "cut", "--reference", "none.csv"), 2, "none.csv: cannot be read", "energy.csv:3")
        self.assertEqual(contents(self.here), before)

    def test_nothing_in_common(self):
        self.tube("tube")
        self.ends(self.quick("gas"), 0)
        self.ends(self.undex("compare", "tube", "gas"), 2, "gas is 1D, tube is 3D.*compare runs of one dimension")
        # The same gas, said to be in 3D: its energies are the fluid's, the tube's are the structure's.
        resolved = self.here / "gas" / "resolved.toml"
        resolved.write_text(resolved.read_text().replace("dimension = 1", "dimension = 3"))
        self.ends(self.undex("compare", "tube", "gas"), 2, "no quantity in common.*give them probes of one name")
        self.assertFalse((self.here / "out").exists())

    def test_stopped_run(self):
        self.tube("whole")
        shutil.copytree(self.here / "whole", self.here / "short")
        record = runs.summary(self.here / "short")
        record.update(status="stopped", message="a cell inside out", time_s=6e-6)
        (self.here / "short" / "summary.json").write_text(json.dumps(record))
        for name in ("energy.csv", "history/midline_outer.csv"):
            lines = (self.here / "short" / name).read_text().splitlines(keepends=True)
            (self.here / "short" / name).write_text("".join(line for line in lines if line[0] == "t" or float(line.split(",")[0]) <= 6e-6))
        finished = self.undex("compare", "whole", "short", "--at", "5,9")
        self.ends(finished, 0)
        self.assertIn("note: short was stopped: a cell inside out", finished.stdout)
        rows = self.table()
        row = rows["midline_outer: plastic strain", "9 us"]
        self.assertEqual((row["short"], row["short from whole [%]"]), ("", ""))
        row = rows["midline_outer: plastic strain", "5 us"]
        self.assertEqual(row["short"], row["whole"])
        self.ends(self.undex("compare", "whole", "short", "--at", "20", "--force"), 2, "no run reaches these times.*10 us")

    def test_pictures(self):
        self.tube("coarse")
        self.tube("fine", structure__cells__along=12)
        self.ends(self.undex("compare", "coarse", "fine", "-o", "both"), 0)
        if runs.call(sys.executable, "-c", "import numpy, matplotlib").returncode != 0:
            self.skipTest("no Matplotlib")
        self.ends(self.undex("plot", "both"), 0)
        self.assertEqual({path.stem for path in (self.here / "both/pictures").iterdir()}, {"motion", "energy", "other", "cost"})


class Judge(Case):
    """undex judge: a verdict from what is on disk."""

    RIGID = {"resolution.spacing": 0.008, "start.kind": "plain", "end_time": 2e-6, "output.field_times": "[]"}

    def rigid(self, *arguments, **more):
        """A short run of a comparison with a table and a history, from files of our own."""
        shutil.copytree(CASES / "rigid_cylinder", self.here / "rigid", dirs_exist_ok=True)
        more.get("damage", lambda: None)()
        return self.undex("run", "rigid", "-o", "out", "-q", *runs.overrides(self.RIGID), *arguments)

    def forget(self, folder="out"):
        """The summary as it was; on disk its metrics are gone."""
        path = self.here / folder / "summary.json"
        before = path.read_text()
        path.write_text(json.dumps({**json.loads(before), "metrics": {"l1_pressure": 1e9}}, indent=2))
        return before

    def test_the_same_verdict(self):
        self.ends(self.quick(), 0)
        summary, before = self.forget(), contents(self.here)
        finished = self.undex("judge", "out")
        self.ends(finished, 0)
        self.assertRegex(finished.stdout, r"(?m)^sjogreen: .*exact solution")
        self.assertRegex(finished.stdout, r"(?m)^l1_pressure +0\.\d+$")
        self.assertEqual((self.here / "out/summary.json").read_text(), summary)
        after = contents(self.here)
        self.assertEqual({**after, "out/summary.json": None}, {**before, "out/summary.json": None})
        self.assertEqual(self.undex("judge", "out", "-q").stdout, "")

    def test_of_a_run_that_the_numerics_stopped(self):
        settings = {"resolution.spacing": 0.006, "start.kind": "plain", "output.field_times": "[]", "scheme.fixed_step": 1e-4}
        self.ends(self.undex("run", CASES / "rigid_cylinder", "-o", "out", "-q", *runs.overrides(settings)), 3)
        summary = self.forget()
        self.ends(self.undex("judge", "out", "-q"), 0)
        self.assertEqual((self.here / "out/summary.json").read_text(), summary)

    def test_other_references(self):
        self.ends(self.rigid(), 0)
        first = runs.summary(self.here / "out")
        table = self.here / "rigid/reference/metrics.csv"
        mine = self.here / "mine.csv"
        mine.write_text("metric,label,unit,scale,my own source\narrival_s,arrival,us,1e6,1\n")
        finished = self.undex("judge", "out", "--reference", mine)
        self.ends(finished, 0)
        self.assertIn("my own source", finished.stdout)
        self.assertEqual(runs.summary(self.here / "out"), first, "another table takes nothing from the run's results")
        self.ends(self.undex("judge", "out", "--reference", table.with_name("midline_wall_pressure.csv"), "-q"), 0)
        self.assertEqual(runs.summary(self.here / "out"), first)
        table.unlink()
        self.ends(self.undex("judge", "out", "-q"), 2, r"comparison\.reference: no file")
        self.ends(self.undex("judge", "out", "--reference", mine, "-q"), 0)

    def test_a_damaged_reference_is_found_before_the_first_step(self):
        def damage(name, text):
            return lambda: (self.here / "rigid/reference" / name).write_text(text)
        for name, text, says in (("metrics.csv", "metric,label\n", r"metrics\.csv:1: the header must be"),
                                 ("metrics.csv", "", r"metrics\.csv"),
                                 ("metrics.csv", "metric,label,unit,scale,a\nfirst_peak_pa,p,MPa,1e-6,nan\n", r"metrics\.csv:2: 'nan' is neither"),
                                 ("midline_wall_pressure.csv", "", r"pressure\.csv: the file is empty"),
                                 ("midline_wall_pressure.csv", "\0" * 300, r"pressure\.csv:1: a header such as"),
                                 ("midline_wall_pressure.csv", "time [s],pressure [Pa]\n0,1\n", r"pressure\.csv: fewer than two"),
                                 ("midline_wall_pressure.csv", "time [s],pressure [Pa]\n0,1\n1,nan\n", r"column 'pressure': .*not finite"),
                                 ("midline_wall_pressure.csv", "time [s],pressure [Pa]\n0,1\n1,2x\n", r"pressure\.csv:3: expected numbers"),
                                 ("midline_wall_pressure.csv", "time [s],pressure [Pa]\n0,1\n1,x\n", r"pressure\.csv:3: expected numbers"),
                                 ("midline_wall_pressure.csv", "time [s],pressure [Pa]\n1,1\n0,1\n", r"column 'pressure': .*mend")):
            with self.subTest(name=name):
                self.ends(self.rigid(damage=damage(name, text)), 1, says)
                self.assertFalse((self.here / "out").exists())
                self.ends(self.undex("check", "rigid", *runs.overrides(self.RIGID)), 1, says)

    def test_a_damaged_reference_of_other_commands(self):
        """judge and compare find it before they write anything, and do not wait for a pipe."""
        self.ends(self.rigid(), 0)
        shutil.copytree(self.here / "out", self.here / "other")
        history, table = self.here / "rigid/reference/midline_wall_pressure.csv", self.here / "rigid/reference/metrics.csv"
        before = {name: data for name, data in contents(self.here).items() if not name.startswith("rigid/reference")}
        for path, damaged in ((history, history.read_bytes()[:5010]), (table, b""), (history, None), (table, None)):
            sound = path.read_bytes()
            path.unlink()
            path.write_bytes(damaged) if damaged is not None else os.mkfifo(path)
            for command in (["judge", "out"], ["judge", "out", "--reference", path],
                            ["compare", "out", "other", "--label", "a,b", "-o", "both", "--reference", path]):
                if damaged is None and path == history and command == ["judge", "out"]:
                    continue  # a table with no history beside it is a reference too
                with self.subTest(command=command, path=path.name, pipe=damaged is None):
                    self.ends(self.undex(*command, timeout=30), 2, path.name)
                    self.assertEqual({name: data for name, data in contents(self.here).items()
                                      if not name.startswith("rigid/reference")}, before)
            path.unlink()
            path.write_bytes(sound)

    def test_what_cannot_be_judged(self):
        self.ends(self.quick(), 0)
        self.ends(self.quick("none", changes={"comparison.kind": "none", "comparison.solution": "riemann"}), 2, "belongs to kind")
        (self.here / "empty").mkdir()
        (self.here / "words.csv").write_text("some words\n")
        before = contents(self.here)
        for arguments, says in ((["missing"], "missing: no such folder"), (["empty"], "not the folder of a run"),
                                (["out", "--reference", "none.csv"], "none.csv: cannot be read as a reference"),
                                (["out", "--reference", "words.csv"], "neither a table of metrics"),
                                (["out", "--reference", CASES / "rigid_cylinder/reference/metrics.csv"], "has no use for a reference"),
                                ([], "run is required")):
            with self.subTest(arguments=arguments):
                finished = self.undex("judge", *arguments)
                self.ends(finished, 2, says)
                self.assertEqual(contents(self.here), before)
        evidence = self.here / "out/evidence.h5"
        sound = evidence.read_bytes()
        for bytes_left, says in ((sound[:-100], r"evidence\.h5: .*damaged.*run the scene again"), (None, r"evidence\.h5: no such file")):
            evidence.write_bytes(bytes_left) if bytes_left is not None else evidence.unlink()
            self.ends(self.undex("judge", "out"), 2, says)
        evidence.write_bytes(sound)
        (self.here / "out/resolved.toml").unlink()
        self.ends(self.undex("judge", "out"), 2, r"resolved\.toml")
        (self.here / "out/summary.json").unlink()
        self.ends(self.undex("judge", "out"), 2, "not the folder of a run")

    @unittest.skipUnless(runs.h5py, "no h5py")
    def test_evidence_can_be_read_by_others(self):
        self.ends(self.quick(), 0)
        with runs.h5py.File(self.here / "out/evidence.h5", "r") as file:
            self.assertEqual(file.attrs["time"], runs.summary(self.here / "out")["time_s"])
            self.assertEqual(file["energy/time"].attrs["unit"], b"s")
            for name, table in runs.histories(self.here / "out").items():
                group = file[name.removesuffix(".csv")]
                self.assertEqual(set(group), set(table.names))
                for column in table.names:
                    self.assertEqual([f"{value:.9g}" for value in group[column][()]], [f"{value:.9g}" for value in table.column(column)])
            self.assertEqual(file["fields/fluid.position"].shape, (100, 3))


class Study(Case):
    """undex study, on runs of a tenth of a second."""

    TEXT = """title = "Gas"
scene = "SCENE"
errors = ["energy_error"]
[settings]
end_time = 0.02
output.field_times = []
[[axes]]
name = "spacing"
key = "resolution.spacing"
values = [0.02, 0.01]
[[axes]]
name = "scheme"
[axes.variants.riemann]
[axes.variants.monaghan]
scheme.name = "monaghan"
"""
    NAMES = ["spacing_0.02__riemann", "spacing_0.02__monaghan", "spacing_0.01__riemann", "spacing_0.01__monaghan"]

    def study(self, text=TEXT, scene="sjogreen", name="gas.toml"):
        return self.scene(text.replace("SCENE", str(CASES / scene)), name)

    def rows(self, folder="out/study_gas"):
        with open(self.here / folder / "study.csv", newline="") as file:
            return {row["run"]: row for row in csv.DictReader(file)}

    def written(self):
        """When each run's summary was written."""
        return {path.parent.name: path.stat().st_mtime_ns for path in (self.here / "out/study_gas/runs").glob("*/summary.json")}

    def runs_only(self, *expected):
        """The study runs; what it computes is just these runs."""
        before = self.written()
        finished = self.undex("study", "gas.toml")
        self.ends(finished, 0)
        after = self.written()
        self.assertEqual({name for name in after if after[name] != before.get(name)}, set(expected), finished.stdout)
        return finished

    def test_grid(self):
        self.study()
        before = contents(self.here)
        finished = self.undex("study", "gas.toml", "--list")
        self.ends(finished, 0)
        self.assertIn("0 there, 4 to run (4 not there)", finished.stdout)
        self.assertEqual(contents(self.here), before)
        finished = self.runs_only(*self.NAMES)
        self.assertRegex(finished.stdout, r"(?m)^\[4/4\] spacing_0.01__monaghan: done, [\d.]+ s CPU, energy_error [\d.e-]+$")
        self.assertRegex(finished.stdout, r"(?m)^0.01 +riemann +done +[\d.e-]+[* ] ")
        rows = self.rows()
        self.assertEqual(list(rows), self.NAMES)
        for name, row in rows.items():
            record = runs.summary(self.here / "out/study_gas/runs" / name)
            self.assertEqual((row["status"], row["particles"], row["steps"]), ("done", str(record["particles"]), str(record["steps"])))
            self.assertAlmostEqual(float(row["error: energy_error"]) / abs(record["energy_error"]), 1, places=7)
            self.assertAlmostEqual(float(row["cpu_time_s"]) / record["cpu_time_s"], 1, places=7)
            self.assertEqual(row["scheme"], name.split("__")[1])
            self.assertEqual(record["threads"], 1)
        self.assertEqual(rows["spacing_0.01__riemann"]["particles"], "100")
        with open(self.here / "out/study_gas/order.csv", newline="") as file:
            orders = list(csv.DictReader(file))
        self.assertEqual([(row["curve"], row["kind"]) for row in orders],
                         [(curve, kind) for curve in ("riemann", "monaghan") for kind in ("between", "least squares")])
        self.assertIn("1", {row["pareto: energy_error"] for row in rows.values()})
        # The command in a run's log does the same by hand.
        command = (self.here / "out/study_gas/runs/spacing_0.01__monaghan/log.txt").read_text().splitlines()[0]
        self.assertTrue(command.startswith("undex run "))
        again = command.replace("undex", str(PROGRAM), 1).replace("-o out/study_gas/runs/spacing_0.01__monaghan", "-o by_hand")
        self.assertEqual(subprocess.run(["sh", "-c", again], cwd=self.here).returncode, 0)
        self.assertEqual(runs.differences(self.here / "by_hand", self.here / "out/study_gas/runs/spacing_0.01__monaghan"), [])

    def test_judged_again(self):
        """A run's new metrics come into the tables; nothing is computed again."""
        self.study()
        self.runs_only(*self.NAMES)
        first, folder = self.rows(), self.here / "out/study_gas/runs" / self.NAMES[0]
        record = runs.summary(folder)
        for metrics, expected in (({"l1_pressure": 7}, "7"), (None, first[self.NAMES[0]]["l1_pressure"])):
            if metrics:
                (folder / "summary.json").write_text(json.dumps({**record, "metrics": metrics}))
            else:
                self.ends(self.undex("judge", folder, "-q"), 0)
            self.runs_only()
            self.assertEqual(self.rows()[self.NAMES[0]]["l1_pressure"], expected)
        self.assertEqual(self.rows(), first)

    def test_going_on(self):
        self.study()
        self.runs_only(*self.NAMES)
        finished = self.runs_only()
        self.assertIn("4 there, 0 to run", finished.stdout)
        self.study(self.TEXT.replace('"Gas"', '"Better title"'))
        self.runs_only()
        folder = self.here / "out/study_gas/runs"
        (folder / self.NAMES[0] / "summary.json").unlink()                       # killed
        (folder / self.NAMES[1] / "summary.json").write_text('{"status": "do')   # damaged
        (folder / self.NAMES[2] / "resolved.toml").unlink()                      # killed before it began
        finished = self.undex("study", "gas.toml", "--list")
        self.assertRegex(finished.stdout, rf"(?m)^  {self.NAMES[0]} +to run +half-finished$")
        self.assertRegex(finished.stdout, rf"(?m)^  {self.NAMES[1]} +to run +damaged: ")
        self.runs_only(*self.NAMES[:3])
        # Another value: only its runs; the old one's stay and are named.
        self.study(self.TEXT.replace("0.02, 0.01]", "0.02, 0.008]"))
        finished = self.runs_only("spacing_0.008__riemann", "spacing_0.008__monaghan")
        self.assertIn("2 folders of runs that the study no longer has: out/study_gas/runs/spacing_0.01__monaghan", finished.stdout)
        self.study()
        self.runs_only()
        # Another setting of one variant.
        self.study(self.TEXT + "scheme.beta = 3\n")
        finished = self.undex("study", "gas.toml", "--list")
        self.assertRegex(finished.stdout, r"(?m)^  spacing_0.01__monaghan +to run +changed: scheme.beta$")
        self.runs_only(self.NAMES[1], self.NAMES[3])
        # An axis more and another label: the same runs under other names.
        text = (self.TEXT + 'scheme.beta = 3\n[[axes]]\nname = "kernel"\nkey = "scheme.kernel"\nvalues = ["wendland_c2"]\n')
        self.study(text.replace("riemann", "default"))
        finished = self.undex("study", "gas.toml")
        self.assertIn("4 there, 0 to run", finished.stdout)
        self.assertEqual(self.rows()["spacing_0.01__default__wendland_c2"]["status"], "done")
        self.assertTrue((folder / "spacing_0.01__default__wendland_c2/summary.json").exists())
        self.assertFalse((folder / "spacing_0.01__riemann").exists())
        # All again.
        before = self.written()
        self.ends(self.undex("study", "gas.toml", "--again", "--only", "default"), 0)
        after = self.written()
        self.assertEqual({name for name in after if after[name] != before[name]}, {name for name in after if "default" in name})

    def test_only(self):
        self.study()
        finished = self.undex("study", "gas.toml", "--only", "*monaghan", "--only", "0.02__r")
        self.ends(finished, 0)
        self.assertEqual({name: row["status"] for name, row in self.rows().items()},
                         dict(zip(self.NAMES, ("done", "done", "not run", "done"))))
        self.assertIn("1 more not run yet", finished.stdout)
        self.ends(self.undex("study", "gas.toml", "--only", "monaghan", "--only", "gaussian", "-o", "other"), 2,
                  "--only gaussian: no run of the study matches; names are such as spacing_0.02")
        self.assertFalse((self.here / "other").exists())

    def test_repetitions(self):
        self.study("repeats = 3\n" + self.TEXT)
        self.ends(self.undex("study", "gas.toml", "--only", self.NAMES[0]), 0)
        row = self.rows()[self.NAMES[0]]
        self.assertEqual(row["timings"], "3")
        self.assertLessEqual(float(row["cpu_time_s"]), float(row["cpu_time_largest_s"]))
        folder = self.here / "out/study_gas/runs" / self.NAMES[0]
        times = json.loads((folder / "outcome.json").read_text())["cpu_times_s"]
        self.assertEqual((len(times), f"{min(times):.9g}"), (3, row["cpu_time_s"]))
        self.assertFalse((folder / "repetition").exists())
        first = self.written()[self.NAMES[0]]
        self.study("repeats = 4\n" + self.TEXT)
        self.ends(self.undex("study", "gas.toml", "--only", self.NAMES[0]), 0)
        self.assertEqual((self.rows()[self.NAMES[0]]["timings"], self.written()[self.NAMES[0]]), ("4", first))

    def test_run_that_the_numerics_stop(self):
        # Without a comparison: no exact solution has such a shock.
        text = re.sub(r"(?ms)^\[comparison\].*?(?=^\[|\Z)", "", (CASES / "sjogreen/case.toml").read_text())
        self.study(self.TEXT.replace("SCENE", str(self.scene(text))) + "bodies.left.velocity = 1e9\n")
        finished = self.undex("study", "gas.toml")
        self.ends(finished, 0)
        rows = self.rows()
        self.assertEqual([row["status"] for row in rows.values()], ["done", "stopped", "done", "stopped"])
        self.assertRegex(rows[self.NAMES[1]]["message"], r"step \d+, time")
        self.assertEqual(rows[self.NAMES[1]]["error: energy_error"], "")
        self.assertEqual(rows[self.NAMES[1]]["pareto: energy_error"], "")
        self.assertRegex(finished.stdout, rf"(?m)^{self.NAMES[1]}, stopped: step")
        self.runs_only()

    def test_run_that_is_refused(self):
        """What only the set-up finds does not end the study, and is tried again."""
        text = """scene = "SCENE"
[settings]
end_time = 1e-6
resolution.spacing = 0.01
output.field_times = []
[[axes]]
name = "start"
[axes.variants.plain]
start.kind = "plain"
[axes.variants.late]
start = {kind = "spherical"}
"""
        self.study(text, "rigid_cylinder")
        finished = self.undex("study", "gas.toml")
        self.ends_with_failure(finished, "late, refused: .*start.kind")
        self.assertEqual([row["status"] for row in self.rows().values()], ["done", "refused"])
        self.assertIn("1 there, 1 to run (1 refused before)", self.undex("study", "gas.toml", "--list").stdout)

    def ends_with_failure(self, finished, pattern):
        self.assertEqual(finished.returncode, 1, finished.stdout + finished.stderr)
        self.assertRegex(finished.stdout, pattern)

    @unittest.skipIf(SANITIZED, "SIGSEGV is the sanitizer's")
    def test_run_that_is_killed(self):
        """A crash is a row too; what the machine did is tried again."""
        self.study(self.LONG)
        with self.started() as process:
            pid = self.child_of(process)
            os.kill(pid, signal.SIGSEGV)
            process.stdout.read()
            self.assertEqual(process.wait(timeout=60), 1)
        self.assertRegex(self.rows()["long"]["message"], "killed by signal 11")
        self.assertEqual((self.rows()["short"]["status"], self.rows()["long"]["status"]), ("done", "failed"))

    # A short run and one of many seconds.
    LONG = """scene = "SCENE"
[settings]
output.field_times = []
[[axes]]
name = "length"
[axes.variants.short]
end_time = 0.001
[axes.variants.long]
resolution.spacing = 0.0002
"""

    def started(self, *arguments):
        """The study, as far as the long run."""
        process = subprocess.Popen([PROGRAM, "study", "gas.toml", *arguments], cwd=self.here, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True, env=runs.ENVIRONMENT)
        for _ in range(1200):
            if (self.here / "out/study_gas/runs/long/energy.csv").exists():
                return process
            time.sleep(0.05)
        raise AssertionError("the long run did not start")

    @staticmethod
    def child_of(process):
        children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
        assert len(children) == 1, children
        return int(children[0])

    def signalled(self, number, code):
        self.study(self.LONG)
        with self.started() as process:
            self.ends(self.undex("study", "gas.toml"), 2, r"out/study_gas is in use by undex study, process \d+")
            process.send_signal(number)
            said = process.stdout.read()
            self.assertEqual(process.wait(timeout=60), code)
        self.assertIn("the same command goes on where this one ended", said)
        self.assertEqual([row["status"] for row in self.rows().values()], ["done", "interrupted"])
        self.assertEqual(runs.summary(self.here / "out/study_gas/runs/long")["status"], "interrupted")
        self.assertIn("1 there, 1 to run (1 half-finished)", self.undex("study", "gas.toml", "--list").stdout)

    def test_shards(self):
        """Three at the same time compute each run once; the tables are those of one study."""
        self.study()
        self.ends(self.undex("study", "gas.toml", "-o", "whole"), 0)
        shards = [subprocess.Popen([PROGRAM, "study", "gas.toml", "--shard", f"{k}/3"], cwd=self.here, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, env=runs.ENVIRONMENT) for k in (1, 2, 3)]
        mine = []
        for shard in shards:
            said, wrong = shard.communicate(timeout=60)
            self.assertEqual(shard.returncode, 0, said + wrong)
            mine.append(int(re.search(r"shard \d of 3: (\d) of them", said)[1]))
            self.assertIn("undex study gas.toml -o out/study_gas --table", said)
        self.assertEqual(mine, [2, 1, 1])
        self.assertFalse((self.here / "out/study_gas/study.csv").exists())
        before = self.written()
        self.assertEqual(set(before), set(self.NAMES))
        self.ends(self.undex("study", "gas.toml", "--table"), 0)
        self.assertEqual(self.written(), before)
        whole, merged = self.rows("whole"), self.rows()
        self.assertEqual(list(merged), list(whole))
        for name, row in whole.items():
            for key in ("status", "curve", "error: energy_error", "steps", "mass_error", "particles"):
                self.assertEqual(merged[name][key], row[key], (name, key))
        self.assertIn("4 there, 0 to run", self.undex("study", "gas.toml", "--list").stdout)

    def test_table_of_a_study_in_part(self):
        self.study()
        self.ends(self.undex("study", "gas.toml", "--shard", "2/2"), 0)
        self.ends(self.undex("study", "gas.toml", "--table"), 0)
        self.assertEqual(sorted(row["status"] for row in self.rows().values()), ["done", "done", "not run", "not run"])

    def test_shards_that_are_none(self):
        self.study()
        for word in ("0/2", "3/2", "1", "1/0", "a/b", "1/2x", "-1/2", "1/2/3"):
            self.ends(self.undex("study", "gas.toml", f"--shard={word}"), 2, "such as 2/8")
        self.ends(self.undex("study", "gas.toml", "--shard", "1/2", "--table"), 2)
        self.assertFalse((self.here / "out").exists())

    def test_a_shard_beside_the_whole_study(self):
        self.study(self.LONG)
        with self.started() as process:
            self.ends(self.undex("study", "gas.toml", "--shard", "1/2"), 2, "out/study_gas is in use by undex study, process")
            process.send_signal(signal.SIGTERM)
            process.communicate(timeout=60)

    def test_slurm(self):
        """The script is one that a shell understands, and a task of it is a shard."""
        self.study()
        self.ends(self.undex("study", "gas.toml", "--slurm", "2"), 0)
        script = self.here / "out/study_gas/study.slurm"
        self.assertIn("#SBATCH --array=1-2\n", script.read_text())
        for task in ("1", "2"):
            finished = subprocess.run(["bash", script], cwd="/", env={**runs.ENVIRONMENT, "SLURM_ARRAY_TASK_ID": task},
                                      capture_output=True, text=True, timeout=60)
            self.assertEqual(finished.returncode, 0, finished.stdout + finished.stderr)
        self.assertEqual(set(self.written()), set(self.NAMES))

    def test_interrupt(self):
        self.signalled(signal.SIGINT, 130)

    def test_terminate(self):
        self.signalled(signal.SIGTERM, 143)

    def test_study_that_is_killed(self):
        """Its run does not stay behind, and what had ended counts."""
        self.study(self.LONG)
        with self.started() as process:
            pid = self.child_of(process)
            process.kill()
            process.wait(timeout=60)
        for _ in range(600):
            if not pathlib.Path(f"/proc/{pid}").exists() or "(zombie)" in pathlib.Path(f"/proc/{pid}/status").read_text():
                break
            time.sleep(0.05)
        else:
            self.fail("the run goes on without its study")
        self.assertIn("1 there, 1 to run (1 half-finished)", self.undex("study", "gas.toml", "--list").stdout)

    def test_limit(self):
        self.study("cpu_limit = 0.7\n" + self.LONG)
        self.ends(self.undex("study", "gas.toml"), 0)
        row = self.rows()["long"]
        self.assertEqual((row["status"], row["message"]), ("limit", "ended at cpu_limit = 0.7 s"))
        self.assertGreater(float(row["cpu_time_s"]), 0.1)
        self.assertIn("2 there, 0 to run", self.undex("study", "gas.toml", "--list").stdout)
        self.study("cpu_limit = 0.9\n" + self.LONG)
        self.assertIn("the limit that ended it has been raised", self.undex("study", "gas.toml", "--list").stdout)

    def test_missing_metric(self):
        self.study(self.TEXT.replace('["energy_error"]', '["first_peak_pa", "energy_eror"]'))
        finished = self.undex("study", "gas.toml", "--only", self.NAMES[0])
        self.ends(finished, 0)
        self.assertEqual(len(re.findall("(?m)^note: ", finished.stdout)), 1, finished.stdout)
        self.assertRegex(finished.stdout, "note: no run has the metric first_peak_pa; known: .*, energy_eror; did you mean 'energy_error'")

    def test_mistakes(self):
        self.study("repeat = 3\n" + self.TEXT.replace("resolution.spacing", "resolution.spacng"))
        before = contents(self.here)
        for arguments in ([], ["--list"]):
            self.ends(self.undex("study", "gas.toml", *arguments), 2, r"gas.toml:1:1: unknown key 'repeat'.*did you mean 'repeats'",
                      r"gas.toml:10:7: resolution.spacng: unknown key 'spacng'.*did you mean 'spacing'")
        self.study(self.TEXT.replace('["energy_error"]', '[{metric = "first_peak_pa", source = "converged"}]'))
        self.ends(self.undex("study", "gas.toml"), 2, "gas.toml:3:11: errors: .* needs the scene's comparison.reference")
        self.study('errors = [{metric = "first_peak", source = "converged"}, {metric = "collapse_s", source = "convergd"}]\nscene = "SCENE"\n',
                   "rigid_cylinder")
        self.ends(self.undex("study", "gas.toml"), 2, r"gas.toml:1:11: .*no metric 'first_peak'; did you mean 'first_peak_pa'",
                  r"gas.toml:1:58: .*no source 'convergd'; did you mean 'converged'")
        self.ends(self.undex("study", "none.toml"), 1, "none.toml: no such study")
        self.ends(self.undex("study", "gas.toml", "-j", "0"), 2)
        self.study()
        self.assertEqual(contents(self.here).keys(), before.keys())
        (self.here / "thesis").mkdir()
        (self.here / "thesis/chapter.txt").write_text("my only copy")
        self.ends(self.undex("study", "gas.toml", "-o", "thesis"), 2, "thesis holds something that is no study")
        self.assertEqual([path.name for path in (self.here / "thesis").iterdir()], ["chapter.txt"])
        (self.here / "out/study_gas/runs" / self.NAMES[0]).mkdir(parents=True)
        (self.here / "out/study_gas/study.toml").write_text("")
        (self.here / "out/study_gas/runs" / self.NAMES[0] / "chapter.txt").write_text("my only copy")
        self.ends(self.undex("study", "gas.toml"), 2, "is in the way")
        self.assertEqual((self.here / "out/study_gas/runs" / self.NAMES[0] / "chapter.txt").read_text(), "my only copy")

    def test_pictures(self):
        if runs.call(sys.executable, "-c", "import numpy, matplotlib").returncode != 0:
            self.skipTest("no Matplotlib")
        self.study()
        self.ends(self.undex("study", "gas.toml", "-j", "2"), 0)
        self.ends(self.undex("plot", "out/study_gas"), 0)
        self.assertEqual({path.stem for path in (self.here / "out/study_gas/pictures").iterdir()},
                         {"cost_energy_error", "order_energy_error", "conservation", "overview"})
        self.ends(self.undex("plot", "."), 2, "give the output folder of a run")


class Help(Case):
    """undex help, undex new, and what shells and man are told."""

    def test_topics(self):
        topics = self.undex("help")
        self.ends(topics, 0)
        names = re.findall(r"(?m)^  ([a-z-]+) +\S", topics.stdout)
        for name in ("run", "study", "help", "tutorial", "plate", "outputs"):
            self.assertIn(name, names)
        for name in names:
            finished = self.undex("help", name)
            self.ends(finished, 0)
            self.assertGreater(len(finished.stdout), 50, name)

    def test_tables_and_keys(self):
        finished = self.undex("help", "resolution")
        self.ends(finished, 0)
        self.assertIn("spacing", finished.stdout)
        finished = self.undex("help", "scheme.kernel")
        self.ends(finished, 0)
        self.assertRegex(finished.stdout, r"(?m)^  kernel   default .*wendland_c2")
        self.assertNotIn("courant", finished.stdout.split("\n")[2])
        self.ends(self.undex("help", "end_time"), 0)
        for markdown in ("](", "`", "<!--"):
            self.assertNotIn(markdown, self.undex("help", "scheme").stdout)

    def test_no_topic(self):
        self.ends(self.undex("help", "scheem"), 2, "no help on 'scheem'; did you mean 'scheme'")
        self.ends(self.undex("help", "../secret"), 2, "no help on")

    def test_new(self):
        """What it copies runs where it lies, whatever it was taken from."""
        listed = self.undex("new")
        self.ends(listed, 0)
        names = re.findall(r"(?m)^  (\S+) +\S", listed.stdout)
        self.assertGreater(len(names), 30)
        for name in ("plate", "tube", "petn_slab", "taylor_bar_sph", "al_tube_sph"):
            self.assertIn(name, names)
            self.ends(self.undex("new", name, f"mine/{name}"), 0)
            self.ends(self.undex("check", f"mine/{name}"), 0)

    def test_shipped_scenes_by_name(self):
        """A bare name means the shipped scene, unless something of that name is here."""
        self.ends(self.undex("check", "petn_slab"), 0)
        self.ends(self.undex("study", "petn_slab", "--list"), 0)
        self.ends(self.undex("check", "petn_slap"), 1, "no such scene")
        (self.here / "petn_slab").mkdir()
        self.ends(self.undex("check", "petn_slab"), 1, "the folder holds no case.toml")

    def test_new_spoils_nothing(self):
        kept = self.scene("mine")
        self.ends(self.undex("new", "plate", "."), 2, "is not empty")
        self.assertEqual(kept.read_text(), "mine")
        self.ends(self.undex("new", "plaet", "other"), 2, "no template 'plaet'; did you mean 'plate'")
        self.assertFalse((self.here / "other").exists())

    def test_completion(self):
        script = self.undex("completion", "bash")
        self.ends(script, 0)
        (self.here / "undex.bash").write_text(script.stdout)
        for words, answers in ((["undex", "stu"], ["study"]), (["undex", "study", "--sh"], ["--shard"]),
                               (["undex", "run", "--fo"], ["--force"])):
            finished = subprocess.run(["bash", "-c", "source ./undex.bash; COMP_WORDS=(" + " ".join(words) + "); COMP_CWORD=" +
                                       str(len(words) - 1) + "; _undex; echo ${COMPREPLY[@]}"], cwd=self.here, capture_output=True, text=True)
            self.assertEqual(finished.stdout.split(), answers, finished.stderr)
        for shell in ("zsh", "fish"):
            self.ends(self.undex("completion", shell), 0)
        self.ends(self.undex("completion", "csh"), 2, "no completion for the shell 'csh'")

    def test_manual(self):
        finished = self.undex("manual")
        self.ends(finished, 0)
        for command in ("run", "resume", "check", "judge", "compare", "study", "materials", "help", "new"):
            self.assertIn(f".SS undex {command}", finished.stdout)
        self.assertIn(".B \\-\\-output \\-o", finished.stdout)

    def test_examples(self):
        for command in ("run", "resume", "check", "help", "new", "completion"):
            self.assertIn("Example", self.undex(command, "--help").stdout)


class Telling(Case):
    """Commands that only say something."""

    def test_check_writes_nothing(self):
        for scene in sorted(p.parent for p in CASES.glob("*/case.toml")):
            with self.subTest(scene=scene.name):
                changes = {"resolution.spacing": 0.006} if re.match("al_tube|rigid_cylinder", scene.name) else {}
                finished = self.undex("check", scene, *runs.overrides(changes))
                self.ends(finished, 0)
                self.assertEqual(finished.stderr, "")
                for word in (scene.name, "expected step", "steps", "memory", "run time"):
                    self.assertIn(word, finished.stdout)
                for body in re.findall(r'^\[\[bodies\]\]\nname = "(.*?)"', (scene / "case.toml").read_text(), re.M):
                    self.assertRegex(finished.stdout, rf"{body} +\d+ particles")
                if re.search(r"^\[structure\]|^\[\[structures\]\]", (scene / "case.toml").read_text(), re.M):
                    self.assertRegex(finished.stdout, r"\d+ cells")
                self.assertEqual(contents(self.here), {})

    def test_list(self):
        finished = self.undex("list")
        self.ends(finished, 0)
        for scene in CASES.glob("*/case.toml"):
            title = re.search(r'^title = "(.*)"', scene.read_text(), re.M).group(1)
            self.assertRegex(finished.stdout, rf"(?m)^{scene.parent.name} +{re.escape(title)}$")
        self.assertEqual(contents(self.here), {})

    def test_list_of_ones_own(self):
        (self.here / "mine" / "gas").mkdir(parents=True)
        (self.here / "mine" / "gas" / "case.toml").write_text('title = "Gas alone"\n' + Mistakes.GAS)
        (self.here / "mine" / "bad").mkdir()
        (self.here / "mine" / "bad" / "case.toml").write_text("end_time = ")
        finished = self.undex("list", env={**runs.ENVIRONMENT, "UNDEX_CASES": str(self.here / "mine")})
        self.ends(finished, 0)
        self.assertRegex(finished.stdout, r"(?m)^gas +Gas alone$")
        self.assertRegex(finished.stdout, r"(?m)^bad +\(cannot be read")

    def test_materials(self):
        finished = self.undex("materials")
        self.ends(finished, 0)
        # A set is a name, a line with its source, and lines of values.
        sets = re.findall(r"(?m)^([\w.-]+)\n  (\S.*)\n((?:  .+\n?)+)", finished.stdout)
        names = [name for name, _, _ in sets]
        self.assertEqual(len(names), len(set(names)))
        for name, _, values in sets:
            self.assertRegex(values, r"rho0( \[kg/m\^3\])? = [\d.e+-]+", name)
        for scene in CASES.glob("*/case.toml"):
            text = scene.read_text()
            own = re.findall(r"^\[materials\.(.*?)\]", text, re.M)
            for used in re.findall(r'^material = "(.*?)"', text, re.M):
                self.assertIn(used, names + own)
        self.assertGreaterEqual({"water-tait", "water-steinberg", "petn", "al-5083-h116"} & set(names),
                                {"water-tait", "water-steinberg", "petn", "al-5083-h116"})
        finished = self.undex("materials", "--json")
        self.ends(finished, 0)
        described = json.loads(finished.stdout)
        self.assertEqual([each["name"] for each in described], names)
        for each in described:
            self.assertGreaterEqual(each.keys(), {"name", "kind", "source", "grade", "checked", "valid", "constants"})
            self.assertEqual(each["kind"] == "explosive", "chapman_jouguet" in each)

    def test_materials_of_a_name_and_of_a_kind(self):
        finished = self.undex("materials", "c-4")
        self.ends(finished, 0)
        self.assertRegex(finished.stdout, r"\Ac-4\n")
        self.assertIn("UNVERIFIED: D is 4 % off", finished.stdout)
        finished = self.undex("materials", "--kind", "gas", "--json")
        self.ends(finished, 0)
        self.assertEqual({each["kind"] for each in json.loads(finished.stdout)}, {"gas"})
        self.ends(self.undex("materials", "pten"), 2, "no material 'pten'; did you mean 'petn'?")
        self.ends(self.undex("materials", "--kind", "metals"), 2, "no kind 'metals'; did you mean 'metal'?")
        self.ends(self.undex("materials", "petn", "--kind", "gas"), 2, "'petn' is of the kind explosive")

    def test_version(self):
        finished = self.undex("version", "--json")
        self.ends(finished, 0)
        version = json.loads(finished.stdout)
        self.assertGreaterEqual(version.keys(), {"version", "git", "compiler", "build_type", "cpu_level"})
        self.assertTrue(self.undex("version").stdout.startswith(f"undex {version['version']}"))

    def test_cpu_level(self):
        """A level that there is not is no reason to take another in silence."""
        for level in ("v9", "avx512", "x86-64-v5", "X86-64-V2"):
            for arguments in (["version"], ["check", CASES / "sjogreen"], ["run", CASES / "sjogreen"]):
                finished = self.undex(*arguments, env={**runs.ENVIRONMENT, "UNDEX_CPU_LEVEL": level})
                self.ends(finished, 2, f"UNDEX_CPU_LEVEL={level}: no such level; known: x86-64-v2, x86-64-v3, x86-64-v4")
        self.assertEqual(contents(self.here), {})
        finished = self.undex("version", env={**runs.ENVIRONMENT, "UNDEX_CPU_LEVEL": "x86-64-v2"})
        self.ends(finished, 0)
        self.assertIn("x86-64-v2", finished.stdout)

    def test_the_library_of_meshes_is_gone(self):
        """A program without it does all that needs no mesh, and says what it lacks for the rest."""
        alone = pathlib.Path(shutil.copy2(PROGRAM, self.here))
        case = self.scene(Mistakes.GAS)
        self.ends(runs.call(alone, "run", case, "-o", "gas", "-q", cwd=self.here), 0)
        for command in ("check", "run"):
            finished = runs.call(alone, command, CASES / "taylor_bar_fem", cwd=self.here)
            self.ends(finished, 1, r"libundex_meshes\.so.*built with the program and must stay beside it")
        self.assertEqual(sorted(path.name for path in self.here.iterdir()), sorted(["case.toml", "gas", alone.name]))

    def test_help(self):
        for arguments in (["--help"], ["run", "--help"], ["check", "--help"], ["compare", "--help"], ["study", "--help"]):
            finished = self.undex(*arguments)
            self.ends(finished, 0)
            self.assertIn("Usage", finished.stdout)

    def test_progress(self):
        finished = self.undex("run", CASES / "sjogreen", "-o", "out", "-v", *runs.overrides(QUICK))
        self.ends(finished, 0)
        steps = runs.summary(self.here / "out")["steps"]
        self.assertRegex(finished.stdout, r"(?m)^ *step +time +step size +set by +energy error +largest p +steps/s +left$")
        self.assertEqual(len(re.findall(r"(?m)^ *\d+ +[\d.]+ .*\((?:left|right)", finished.stdout)), steps)
        self.assertNotIn("\r", finished.stdout)  # no bar but on a terminal

    def test_bar_on_a_terminal(self):
        ours, theirs = pty.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 40, 160, 0, 0))  # 160 columns: nothing is cut
        try:
            with subprocess.Popen([PROGRAM, "run", CASES / "rigid_cylinder", "-o", "out", *runs.overrides(LONG)], cwd=self.here,
                                  stdout=theirs, stderr=subprocess.DEVNULL, env=runs.ENVIRONMENT) as process:
                shown, end = b"", time.monotonic() + 60
                while not re.search(rb"dt .* by ", shown) and time.monotonic() < end:
                    if select.select([ours], [], [], 1)[0]:
                        shown += os.read(ours, 4096)
                process.kill()
        finally:
            os.close(ours)
            os.close(theirs)
        self.assertRegex(shown.decode(), r"\r\x1b\[K\[#*\.*\] +\d+ %  .* left  energy .*/s  step [\d,]+ at .*s  dt .*s by ")


def names():
    return [test.id().removeprefix("__main__.") for suite in unittest.defaultTestLoader.loadTestsFromModule(
        sys.modules["__main__"]) for test in suite]


if __name__ == "__main__":
    if sys.argv[1:] == ["--names"]:
        print("\n".join(names()))
    elif len(sys.argv) < 3:
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    else:
        PROGRAM, CASES = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
        unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
