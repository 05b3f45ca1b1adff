"""The report and the pictures as files: of whole runs, of parts of runs, of hostile ones, and by the program's own commands."""
import base64
import json
import re
import shutil
import unittest
import zlib
from pathlib import Path

import numpy as np
from sample_run import CASES, changed_tube, temporary_folder, tube, undex

from undex_post import MidPlane, Missing, Run
from undex_post.report.movie import png, quantised
from undex_post.report.results import result_rows
from undex_post.report.run_page import DAMAGED, RunReport
from undex_post.units import number, quantity

HOSTILE = '</script><script>window.owned = 1</script><img src=x onerror="window.owned = 1">'


def data_of(text: str) -> dict:
    """The data that the page's script reads; NaN and Infinity, which JSON does not know, are refused."""

    def refused(word: str):
        raise ValueError(f"{word} in the data")

    return json.loads(
        re.search(r'<script type="application/json" id="report-data">(.*?)</script>', text, re.S)[1], parse_constant=refused
    )


def report_of(folder: Path) -> str:
    return RunReport([Run(folder)]).text()


class Page(unittest.TestCase):
    """Says what a page lacks without printing the page."""

    def says(self, text: str, *words: str) -> None:
        lacking = [each for each in words if each not in text]
        self.assertEqual(lacking, [], "not in the page")

    def lacks(self, text: str, *words: str) -> None:
        found = [each for each in words if each in text]
        self.assertEqual(found, [], "in the page")


class Encoding(unittest.TestCase):
    def test_png_holds_the_pixels(self):
        pixels = np.random.default_rng(1).integers(0, 256, (13, 7)).astype(np.uint8)
        data = png(pixels)
        body = zlib.decompress(data[data.index(b"IDAT") + 4 : data.index(b"IEND") - 8])
        rows = np.frombuffer(body, dtype=np.uint8).reshape(13, 8)
        self.assertTrue((rows[:, 0] == 2).all())
        np.testing.assert_array_equal(np.cumsum(rows[:, 1:], axis=0, dtype=np.uint8), pixels)

    def test_levels_give_values_back(self):
        values = np.array([[0.0, 1.0, 4.0, 100.0, np.nan]])
        for fine in (True, False):
            levels, least, largest, power = quantised(values, fine)
            back = least + (largest - least) * ((levels.astype(float) - 1) / 254) ** power
            self.assertEqual(levels[0, 4], 0)
            np.testing.assert_allclose(back[0, :4], values[0, :4], atol=0.5)
        levels, least, *_ = quantised(np.array([[-5.0, 5.0]]), True)
        self.assertEqual((least, levels.tolist()), (-5.0, [[1, 255]]))

    def test_numbers_are_written_as_people_do(self):
        self.assertEqual(quantity(5.7e8, "Pa"), "570 MPa")
        self.assertEqual(quantity(1.5e-4, "s"), "150 µs")
        self.assertEqual(quantity(float("nan"), "m"), "–")
        self.assertEqual(number(1.5e-7, 2), "1.5·10⁻⁷")


class WholeRun(Page):
    @classmethod
    def setUpClass(cls):
        cls.text = report_of(tube())
        cls.data = data_of(cls.text)

    def test_every_part_is_there(self):
        self.says(
            self.text,
            "What was computed",
            "Can it be trusted?",
            "spacings in its radius",
            "sphere of radius 7.396 mm",
            "cylinder of radius 44.45 mm, 228.6 mm long along z",
            "37.05 mm",
            "converged Tait",
            "Annealed 5086",
            "through &#x27;tube&#x27;",
            "Energy and conservation",
            "Wall time by part",
            "al-5086-o",
            "is of grade D",
            "undex run experiment.toml",
            "smoothing length at its bound",
        )
        self.lacks(self.text, DAMAGED)

    def test_it_is_small_and_asks_for_nothing(self):
        self.assertLess(len(self.text), 2_000_000)
        self.says(self.text, "default-src 'none'")
        outside = re.sub(r"<script.*?</script>", "", self.text, flags=re.S)
        self.assertNotRegex(outside, r"""(src|href)=["'](https?:)?//""")

    def test_movie_frames_are_those_of_the_run(self):
        (movie,) = self.data["movies"]
        with Run(tube()).particles() as snapshots:
            np.testing.assert_allclose([frame["time"] for frame in movie["frames"]], snapshots.times)
        frame = movie["frames"][-1]
        self.assertEqual(set(frame["fluid"]["scales"]), {"pressure", "void_fraction", "speed"})
        with MidPlane(Run(tube())) as plane:
            self.assertAlmostEqual(
                frame["fluid"]["scales"]["pressure"][2] / np.nanmax(plane.frame(len(plane) - 1).fluid.fields["pressure"]), 1.0
            )
        counts = np.frombuffer(base64.b64decode(frame["structures"][0]["counts"]), dtype=np.uint8)
        self.assertEqual((len(counts), set(counts.tolist())), (Run(tube()).summary["cells"], {4}))

    def test_charts_hold_the_histories(self):
        (chart,) = (chart for chart in self.data["charts"] if chart["title"] == "Pressure")
        y = np.frombuffer(base64.b64decode(chart["numbers"][chart["series"][0]["y"]]), dtype="<f4")
        history = Run(tube()).histories["midline_wall"]["pressure"]
        self.assertEqual(chart["y"], "pressure [MPa]")
        self.assertAlmostEqual(float(y.max()) / (1e-6 * history.max()), 1.0, 5)

    def test_results_differ_from_the_references_by_what_is_said(self):
        run = Run(tube())
        rows, sources = result_rows([run])
        row = next(row for row in rows if row.label.startswith("displacement 40"))
        metric = run.summary["metrics"]["displacement_40us_m"]
        self.assertEqual(row.values, [number(1e3 * metric)])
        self.assertEqual(row.sources["experiment"].differences, [f"{100 * (metric / 2.03e-3 - 1):+.1f} %"])
        self.assertIn("hydrocode", sources)

    def test_several_runs_are_overlaid(self):
        other = changed_tube()
        scene = (other / "resolved.toml").read_text().replace("al-5086-o", "another")
        (other / "resolved.toml").write_text(scene)
        text = RunReport([Run(tube()), Run(other)]).text()
        data = data_of(text)
        chart = next(chart for chart in data["charts"] if chart["title"].startswith("Outward displacement"))
        self.assertEqual([series["colour"] for series in chart["series"][:2]], [0, 1])
        self.assertEqual(len(data["movies"]), 2)


class PartsOfARun(Page):
    """What is not there is said, and the rest is shown."""

    def test_killed(self):
        folder = changed_tube()
        for name in ("summary.json", "evidence.h5", "checkpoint.h5"):
            (folder / name).unlink(missing_ok=True)
        energy = folder / "energy.csv"
        energy.write_text(energy.read_text()[:-7])
        text = report_of(folder)
        self.says(text, "it was killed or is still going")
        self.assertTrue(data_of(text)["movies"])

    def test_without_fields(self):
        folder = changed_tube()
        shutil.rmtree(folder / "fields")
        text = report_of(folder)
        self.says(text, "There is no picture of the mid-plane")
        self.assertEqual(data_of(text)["movies"], [])

    def test_without_fluid_fields_the_structure_is_shown(self):
        folder = changed_tube()
        (folder / "fields" / "particles.h5part").unlink()
        (movie,) = data_of(report_of(folder))["movies"]
        self.assertTrue(all("fluid" not in frame and frame["structures"] for frame in movie["frames"]))

    def test_without_reference(self):
        folder = changed_tube()
        scene = folder / "resolved.toml"
        scene.write_text(re.sub(r'reference = ".*"', 'reference = "/nowhere/table.csv"', scene.read_text()))
        text = report_of(folder)
        self.says(text, "/nowhere/table.csv")
        self.says(text, "displacement at 40 µs")

    def test_without_histories_and_scene(self):
        folder = changed_tube()
        shutil.rmtree(folder / "history")
        for name in ("resolved.toml", "bodies.csv", "energy.csv"):
            (folder / name).unlink()
        text = report_of(folder)
        self.says(text, "The scene is not known", "The run has no histories", "energy.csv is missing")

    def test_damaged_fields(self):
        folder = changed_tube()
        path = folder / "fields" / "structure_00002.hdf"
        path.write_bytes(path.read_bytes()[:100])
        self.says(report_of(folder), "structure_00002.hdf: cannot be read")

    def test_few_snapshots_name_the_setting_that_gives_more(self):
        self.says(report_of(tube()), "-P output.field_interval=")

    def test_stopped_run_gives_its_message(self):
        folder = changed_tube()
        summary = json.loads((folder / "summary.json").read_text())
        summary.update(status="stopped", message="particle 7 at (0, 0, 1) is too fast")
        (folder / "summary.json").write_text(json.dumps(summary))
        text = report_of(folder)
        self.says(text, "stopped by the numerics")
        self.says(text, "particle 7 at (0, 0, 1) is too fast")

    def test_nan_breaks_nothing(self):
        folder = changed_tube()
        path = folder / "history" / "midline_wall.csv"
        lines = path.read_text().splitlines()
        lines[5] = "nan,nan,nan"
        lines[6] = re.sub(r",.*", ",inf,nan", lines[6])
        path.write_text("\n".join(lines) + "\n")
        (folder / "summary.json").write_text(
            re.sub(r'"energy_error": [^,]*', '"energy_error": NaN', (folder / "summary.json").read_text())
        )
        data_of(report_of(folder))

    def test_values_of_other_kinds_break_nothing(self):
        """What another program, or a mistake, has written into the record."""
        folder = changed_tube()
        shutil.rmtree(folder / "fields")
        good = json.loads((folder / "summary.json").read_text())
        for value in (None, "text", [], {}, -1, [1, "a"], {"a": None}, {"a": [1]}, True):
            (folder / "summary.json").write_text(json.dumps({key: value for key in good}))
            with self.subTest(value=value):
                self.lacks(report_of(folder), DAMAGED)
        for key in good:
            (folder / "summary.json").write_text(json.dumps({**good, key: ["a"] if isinstance(good[key], dict) else {"a": 1}}))
            with self.subTest(key=key):
                self.says(" ".join(Run(folder).notes), key)

    def test_a_damaged_part_costs_no_other(self):
        folder = changed_tube()
        (folder / "resolved.toml").write_text((folder / "resolved.toml").read_text().replace('type = "tube"', 'type = ["tube"]'))
        text = report_of(folder)
        self.says(text, "Wall time by part")
        self.assertTrue(data_of(text)["movies"])


class HostileNames(Page):
    def test_titles_names_and_messages_are_text(self):
        folder = changed_tube()
        scene = folder / "resolved.toml"
        scene.write_text(re.sub(r'title = ".*"', lambda _: f"title = '{HOSTILE}'", scene.read_text(), count=1))
        summary = json.loads((folder / "summary.json").read_text())
        summary.update(
            warnings=[HOSTILE],
            trust=[{"about": HOSTILE, "level": HOSTILE, "text": HOSTILE}],
            program=HOSTILE,
            status=HOSTILE,
            message=HOSTILE,
            metrics={**summary["metrics"], HOSTILE: 1.0},
            missing={"x": HOSTILE},
            clamps={HOSTILE: 3},
            passes={HOSTILE: 1.0},
        )
        (folder / "summary.json").write_text(json.dumps(summary))
        (folder / "history" / "a<b>.csv").write_text(f"time [s],{HOSTILE.replace(',', '')} [<i>]\n0,1\n1e-5,2\n")
        text = report_of(folder)
        self.lacks(text, "<script>window.owned")
        self.lacks(text, "<img")
        self.assertEqual(len(re.findall(r"<script", text)), 3)  # the data, the library, the page's own
        data_of(text)


class Commands(Page):
    def test_report_of_a_run(self):
        folder = changed_tube()
        done = undex("report", folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("<td>D</td>", (folder / "report.html").read_text())  # grades come from the program
        other = temporary_folder() / "-x.html"
        self.assertEqual(undex("report", folder, "-o", other).returncode, 0)
        self.assertTrue(other.is_file())

    def test_a_file_that_is_no_report_stays(self):
        other = temporary_folder() / "notes.html"
        other.write_text("my only copy")
        done = undex("report", tube(), "-o", other)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(other.read_text(), "my only copy")
        report = temporary_folder() / "report.html"
        for _ in range(2):  # a report takes the place of an older one
            self.assertEqual(undex("report", tube(), "-o", report).returncode, 0)

    def test_plots_of_a_run(self):
        folder = changed_tube()
        (folder / "pictures").mkdir()
        (folder / "pictures" / "mid_plane.png").write_text("stale")
        done = undex("plot", folder, "--times", "20,40", "--dpi", "50")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for name in ("histories", "references", "energy", "bodies", "mid_plane"):
            self.assertEqual((folder / "pictures" / f"{name}.png").read_bytes()[:4], b"\x89PNG", name)

    def test_a_study_and_its_runs(self):
        folder = temporary_folder()
        study = folder / "study.toml"
        study.write_text(
            f'title = "{HOSTILE.replace(chr(34), chr(39))}"\nscene = "{CASES / "water_shock_tube" / "case.toml"}"\nerrors = ["l1_pressure", "energy_error"]\n'
            '[[axes]]\nname = "spacing"\nkey = "resolution.spacing"\nvalues = [0.004, 0.002]\n'
            '[[axes]]\nname = "scheme"\nkey = "scheme.name"\nvalues = ["riemann", "monaghan"]\n'
        )
        output = folder / "out"
        self.assertEqual(undex("study", study, "-q", "-o", output).returncode, 0)
        first = sorted((output / "runs").iterdir())[0]
        self.assertEqual(undex("report", first).returncode, 0)
        done = undex("report", output)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        text = (output / "report.html").read_text()
        self.lacks(text, "<script>window.owned")
        self.says(text, f'href="runs/{first.name}/report.html"')  # a run with a report of its own
        links = set(re.findall(r'href="#(run-[^"]*)"', text))
        self.assertEqual(len(links), 3)  # the others' rows
        for link in links:
            self.says(text, f'id="{link}"')
        self.says(text, "Observed orders")
        plots = undex("plot", output)
        self.assertEqual(plots.returncode, 0, plots.stderr)
        self.assertTrue((output / "pictures" / "cost_l1_pressure.png").is_file())

    def test_a_comparison_is_drawn(self):
        output = temporary_folder() / "compare"
        self.assertEqual(undex("compare", tube(), changed_tube(), "-o", output).returncode, 0)
        done = undex("plot", output, "--dpi", "50")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("motion", "pressure", "energy", "cost"):
            self.assertTrue((output / "pictures" / f"{name}.png").is_file(), name)

    def test_mistakes_end_with_exit_code_2(self):
        empty = temporary_folder()
        for arguments in (
            ("report", empty),
            ("report", empty / "nowhere"),
            ("plot", empty),
            ("report",),
            ("report", tube(), "-o", empty),
        ):
            done = undex(*arguments)
            self.assertEqual(done.returncode, 2, (arguments, done.stderr))
            self.assertNotIn("Traceback", done.stderr)

    def test_what_is_missing_is_named_with_its_package(self):
        fake = temporary_folder()
        (fake / "h5py.py").write_text("raise ImportError(\"No module named 'h5py'\")")
        done = undex("report", tube(), environment={"PYTHONPATH": str(fake)})
        self.assertEqual(done.returncode, 1)
        self.assertIn("apt-get install python3-numpy python3-h5py python3-matplotlib", done.stderr)
        data = temporary_folder()
        (data / "cases").mkdir()
        done = undex("report", tube(), environment={"UNDEX_DATA": str(data)})
        self.assertEqual(done.returncode, 1)
        self.assertIn("undex_post", done.stderr)

    def test_modules_of_the_present_folder_do_not_count(self):
        import os
        import subprocess

        from sample_run import UNDEX

        trap = temporary_folder()
        (trap / "numpy.py").write_text("raise SystemExit('trapped')")
        done = subprocess.run(
            [UNDEX, "report", changed_tube()], cwd=trap, capture_output=True, text=True, env=os.environ, timeout=120, check=False
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))


class Charts(unittest.TestCase):
    def test_the_library_of_charts_is_named_where_it_is_missing(self):
        from undex_post.report import page

        known = page.DYGRAPHS
        page.DYGRAPHS = Path("/nowhere")
        try:
            with self.assertRaisesRegex(Missing, "apt-get install libjs-dygraphs"):
                report_of(tube())
        finally:
            page.DYGRAPHS = known


if __name__ == "__main__":
    unittest.main()
