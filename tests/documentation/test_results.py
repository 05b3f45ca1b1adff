#!/usr/bin/env python3
"""Tests of scripts/results.py and of the audit, on a small project of their own: what is right passes, and each mistake is found."""
import contextlib, io, pathlib, sys, tempfile, unittest

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(FOLDER), str(FOLDER.parent.parent / "scripts")]
import audit, check_pages, results

DESCRIPTION = """
figures = ["figures.csv"]

[table.errors]
file = "tube.csv"
kind = "across"
head = "scheme"
rows = ["scheme"]
across = {column = "spacing", scale = 1000, format = "%g mm"}
cell = [{column = "error: l1", scale = 100, format = "%.2f %%"}, {column = "cpu_time_s", format = "2 digits"}]
star = "pareto: l1"
order = true

[table.beside]
kind = "metrics"
file = "tube.csv"
reference = "cases/tube/reference.csv"
sources = ["converged"]
runs = [{head = "1 mm", where = {spacing = 0.001, scheme = "riemann"}}]

[value.late]
file = "tube.csv"
where = {spacing = 0.001, scheme = "riemann"}
column = "late_m"
format = "%+.1f %%"
reference = {file = "cases/tube/reference.csv", where = {metric = "late_m"}, column = "converged", scale = 1e-3}

[table.texts]
kind = "texts"
head = ["case", "error"]
lines = [["tube", "{late} late"]]

[[declared]]
page = "README.md"
text = "a duct of 5 %"
reason = "an input"
"""
TUBE = """# undex study cases/tube; undex 1.0; a machine; 2026-01-01
spacing,scheme,status,error: l1,pareto: l1,cpu_time_s,late_m
0.002,riemann,done,0.02,1,1.234,0.0042
0.001,riemann,done,0.01,1,12.34,0.00441
0.002,paper,done,0.04,0,0.5,0.004
0.001,paper,stopped,,0,,
"""
REFERENCE = "# by hand\nmetric,label,unit,scale,converged\nlate_m,late,mm,1e3,4.40+-0.05\n"
FIGURES = "# a bench; a machine; 2026-01-01\nname,figure\nbench.rate,1.5 M\n"
PAGE = """# Tube
<!-- table errors -->

| scheme | 2 mm | 1 mm | order |
| --- | --- | --- | --- |
| riemann | 2.00 %* / 1.2 | 1.00 %* / 12 | 1.0 |
| paper | 4.00 % / 0.50 | stopped | |

<!-- end -->
The tube bulges <!-- value late -->+0.2 %<!-- end --> too far in a duct of 5 %, at <!-- value bench.rate -->1.5 M<!-- end -->.
```
<!-- value unknown -->in code nothing is marked<!-- end --> 7 %
```
<!-- table beside -->

| | 1 mm | converged |
| --- | --- | --- |
| late (mm) | 4.41 | 4.40 ± 0.05 |

<!-- end -->
<!-- table texts -->

| case | error |
| --- | --- |
| tube | +0.2 % late |

<!-- end -->
"""


class Project(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name).resolve()
        for name, text in {"docs/results/results.toml": DESCRIPTION, "docs/results/tube.csv": TUBE, "docs/results/figures.csv": FIGURES,
                           "cases/tube/reference.csv": REFERENCE, "README.md": PAGE}.items():
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            (self.root / name).write_text(text)

    def change(self, name, old, new):
        text = (self.root / name).read_text()
        self.assertIn(old, text)
        (self.root / name).write_text(text.replace(old, new))

    def said(self, call):
        """Whether it found no mistake, and what it said."""
        out = io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
            good = not call()
        return good, out.getvalue()

    def check(self):
        return self.said(lambda: results.main(["--root", str(self.root), "check"]))

    def audit(self):
        return self.said(lambda: audit.audit(self.root))

    def expect(self, said, *words):
        self.assertFalse(said[0], said[1])
        for word in words:
            self.assertIn(word, said[1])


class Check(Project):
    def test_a_page_as_its_results_say_passes(self):
        self.assertEqual((True, ""), self.check())

    def test_a_changed_number_is_found_with_page_line_and_both_texts(self):
        self.change("README.md", "+0.2 %", "+0.3 %")
        self.expect(self.check(), "README.md:10: late", "stands there: +0.3 %", "should be:    +0.2 %")

    def test_a_changed_cell_is_found(self):
        self.change("README.md", "2.00 %*", "1.99 %*")
        self.expect(self.check(), "README.md:2: errors", "1.99 %*", "2.00 %*")

    def test_a_changed_result_is_found(self):
        self.change("docs/results/tube.csv", "0.00441", "0.00442")
        self.expect(self.check(), "late", "beside")

    def test_writing_mends_what_the_check_finds(self):
        self.change("docs/results/tube.csv", "0.00441", "0.00448")
        self.said(lambda: results.main(["--root", str(self.root), "write"]))
        self.assertEqual((True, ""), self.check())
        self.assertIn("+1.8 %", (self.root / "README.md").read_text())

    def test_what_no_page_shows_is_named(self):
        self.change("docs/results/figures.csv", "bench.rate", "dead,1\nbench.rate")
        self.assertEqual((True, "no page shows figure dead\n"), self.check())

    def test_mistakes_name_their_remedy(self):
        for name, old, new, words in [
                ("README.md", "value late", "value lat", "`late` is meant?"),
                ("README.md", "+0.2 %<!-- end -->", "+0.2 %", "without its <!-- end -->"),
                ("README.md", "bulges <!--", "bulges\n<!--", "break the line elsewhere"),
                ("docs/results/results.toml", 'column = "late_m"', 'column = "late"', "no column `late`; `late_m` is meant?"),
                ("docs/results/results.toml", "spacing = 0.001, scheme", "spacing = 0.005, scheme", "no row where"),
                ("docs/results/results.toml", 'kind = "across"', 'kind = "pivot"', "not `pivot`"),
                ("docs/results/tube.csv", "# undex", "undex", "where it is from"),
                ("docs/results/tube.csv", "0.0042\n", "0.0042,1\n", "more or fewer cells")]:
            with self.subTest(words):
                before = (self.root / name).read_text()
                self.change(name, old, new)
                self.expect(self.check(), words)
                (self.root / name).write_text(before)

    def test_digits_that_count(self):
        for number, text in [(0.0083, "0.0083"), (0.996, "1.0"), (1.25, "1.2"), (43.4, "43"), (207.3, "207"), (0, "0")]:
            self.assertEqual(text, results.formatted(number, "2 digits"))


class Take(Project):
    def test_a_study_is_cut_and_says_where_it_is_from(self):
        (self.root / "app").mkdir()
        (self.root / "app/version.cpp").write_text("constexpr int numerics_version = 8;\n")
        (self.root / "out").mkdir()
        for folder in ("out", "cases/tube"):
            (self.root / folder / "study.toml").write_text("title = 'x'\n")
        (self.root / "out/study.csv").write_text(
            "run,spacing,curve,status,error: l1,cpu_time_s,program,exact_m\n"
            "a,0.002,c,done,0.0123456789,1.5,\"undex 1.0 (0a1b2c3), g++\",1\nb,0.001,c,not run,,,,\n")
        good, said = self.said(lambda: results.main(["--root", str(self.root), "take", str(self.root / "out"), "docs/results/new.csv"]))
        self.assertTrue(good, said)
        first, *rest = (self.root / "docs/results/new.csv").read_text().splitlines()
        self.assertRegex(first, r"^# undex study cases/tube/study.toml; undex 1.0, g\+\+, numerics 8; .*; \d{4}-\d\d-\d\d$")
        self.assertEqual(["spacing,status,error: l1,cpu_time_s", "0.002,done,0.0123457,1.5"], rest)


class Audit(Project):
    def test_traced_and_declared_figures_pass(self):
        good, said = self.audit()
        self.assertTrue(good, said)
        self.assertIn("1 places declared", said)

    def test_figures_that_nothing_stands_behind_are_found(self):
        for words in ("It is 3.5 % low.", "It takes 12 s.", "It takes two hours, or 2.5 h of wall time.", "| a | b | c |\n|---|---|---|\n| x | 1.5 | 2 |"):
            with self.subTest(words):
                before = (self.root / "README.md").read_text()
                (self.root / "README.md").write_text(before + words + "\n")
                self.expect(self.audit(), "README.md:", "no file of results stands behind it")
                (self.root / "README.md").write_text(before)

    def test_a_declared_place_that_is_gone_is_found(self):
        self.change("README.md", "a duct of 5 %", "a duct")
        self.expect(self.audit(), "nothing is at the declared place")

    def test_a_declared_text_covers_itself_alone(self):
        self.change("README.md", "a duct of 5 %", "a duct of 5 % and 6 % more")
        self.expect(self.audit(), "6 %")

    def test_figures_that_are_owed_may_not_become_more(self):
        (self.root / "docs/old.md").write_text("3 % and 4 %\n")
        self.change("docs/results/results.toml", "[[declared]]", '[[owed]]\npage = "docs/old.md"\ncount = 2\n\n[[declared]]')
        self.assertTrue(self.audit()[0])
        (self.root / "docs/old.md").write_text("3 % and 4 % and 5 %\n")
        self.expect(self.audit(), "owes 2")


class Pages(Project):
    def found(self, page, text):
        path = self.root / page
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return " ".join(check_pages.mistakes(self.root, path))

    def test_a_sound_page_passes(self):
        self.assertEqual("", self.found("cases/tube/README.md", "# Tube\n[up](../../README.md#tube) [here](#tube) 1e1000000\n"))

    def test_mistakes_are_found(self):
        self.assertIn("61 lines", self.found("cases/tube/README.md", "line\n" * 61))
        self.assertIn("looks like a commit", self.found("docs/a.md", "as of 0a1b2c3d\n"))
        self.assertIn("what holds", self.found("docs/a.md", "Measured on 22 November 2026.\n"))
        self.assertIn("a cell of 70", self.found("docs/results/a.md", "| " + "x" * 70 + " | b |\n"))
        self.assertIn("leads nowhere", self.found("docs/a.md", "[x](b.md)\n"))
        self.assertIn("has this anchor", self.found("docs/a.md", "[x](../README.md#nothing)\n"))


if __name__ == "__main__":
    unittest.main()
