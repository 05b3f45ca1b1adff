"""The report in a browser: headless Chromium opens it from its file and uses its controls."""
import unittest
from pathlib import Path

from browser import Browser, BrowserMissing
from sample_run import changed_tube, temporary_folder, tube, undex

TAB, SPACE, RIGHT = ("Tab", 9), (" ", 32), ("ArrowRight", 39)


def reported(*folders: Path) -> Path:
    path = temporary_folder() / "report.html"
    done = undex("report", *folders, "-o", path)
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    return path


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        try:
            cls.browser = Browser()
        except BrowserMissing as error:
            raise AssertionError(str(error)) from error
        cls.addClassCleanup(cls.browser.__exit__)
        cls.path = reported(tube())

    def setUp(self):
        self.browser.size(1280, 900)
        self.browser.scheme("light")
        self.open()

    def open(self, path: Path | None = None) -> None:
        self.browser.open(path or self.path)
        if self.browser.evaluate("window.report.movies.length") > 0:
            self.browser.wait("document.querySelector('.movie').dataset.drawn")

    def number(self, expression: str):
        return self.browser.evaluate(expression)

    def drawn(self, frame: int) -> None:
        self.browser.wait(f"document.querySelector('.movie').dataset.drawn.startsWith('{frame} ')")

    # What the canvas shows: a sum over its pixels, which any change of the picture changes.
    PICTURE = (
        "(() => { const c = document.querySelector('.movie .stage canvas'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;"
        " let s = 0; for (let i = 0; i < d.length; ++i) s = (31 * s + d[i]) % 1000003; return s; })()"
    )

    def test_it_opens_without_network_or_error(self):
        self.number("new Promise((done) => setTimeout(done, 500))")
        asked = [url for url in self.browser.requests if not url.startswith(("data:", "blob:"))]
        self.assertEqual(asked, [self.path.resolve().as_uri()])
        self.assertEqual(self.browser.console, [])
        self.assertEqual(self.number("window.reportProblems"), [])
        self.assertGreater(self.number("document.querySelectorAll('.chart canvas').length"), 10)

    def test_the_movie_plays_and_pauses(self):
        first = self.number(self.PICTURE)
        self.number("document.querySelector('.play').click()")
        self.assertEqual(self.number("document.querySelector('.play').textContent"), "Pause")
        self.browser.wait("window.report.movies[0].index >= 2")
        self.number("document.querySelector('.play').click()")
        self.assertEqual(self.number("document.querySelector('.play').textContent"), "Play")
        index = self.number("window.report.movies[0].index")
        self.drawn(index)
        self.assertNotEqual(self.number(self.PICTURE), first)
        self.number("new Promise((done) => setTimeout(done, 900))")
        self.assertEqual(self.number("window.report.movies[0].index"), index)

    def test_the_movie_ends_and_begins_again(self):
        last = self.number("window.report.movies[0].data.frames.length") - 1
        self.number(f"window.report.movies[0].go({last - 1}); document.querySelector('.play').click()")
        self.browser.wait("document.querySelector('.play').textContent === 'Play'")
        self.assertEqual(self.number("window.report.movies[0].index"), last)
        self.number("document.querySelector('.play').click()")
        self.browser.wait("window.report.movies[0].index >= 1")
        self.assertLess(self.number("window.report.movies[0].index"), last)

    def test_time_is_scrubbed_by_keys(self):
        self.number("document.querySelector('.timeline input').focus()")
        for _ in range(3):
            self.browser.press(*RIGHT)
        self.drawn(3)
        time = self.number("window.report.movies[0].data.frames[3].time")
        self.assertAlmostEqual(
            float(self.number("document.querySelector('.timeline output').textContent").split()[0]), 1e6 * time, 1
        )

    def test_buttons_are_reached_and_pressed_by_keys(self):
        self.number("document.querySelector('.play').focus()")
        self.browser.press(*SPACE)
        self.browser.wait("window.report.movies[0].index >= 1")
        self.number("window.report.movies[0].stop()")
        self.browser.press(*TAB)
        self.assertEqual(self.number("document.activeElement.getAttribute('aria-label')"), "One picture back")
        unlabelled = self.number(
            "[...document.querySelectorAll('button, input, select')].filter((each) => each.offsetHeight && "
            "!(each.getAttribute('aria-label') || each.closest('label') || each.textContent.trim())).length"
        )
        self.assertEqual(unlabelled, 0)

    def test_every_field_has_a_picture_of_its_own(self):
        frame = 6
        self.number(f"window.report.movies[0].go({frame})")
        self.drawn(frame)
        pictures = set()
        for key in ("fluid.pressure", "fluid.void_fraction", "fluid.speed"):
            self.number(
                f"(() => {{ const s = document.querySelector('.movie select'); s.value = '{key}'; s.dispatchEvent(new Event('change')); }})()"
            )
            self.browser.wait(f"document.querySelector('.movie').dataset.drawn === '{frame} {key}'")
            pictures.add(self.number(self.PICTURE))
        self.assertEqual(len(pictures), 3)

    def test_the_range_of_colours_changes_the_picture(self):
        self.number("window.report.movies[0].go(4)")
        self.drawn(4)
        before = self.number(self.PICTURE)
        self.number(
            "(() => { const m = window.report.movies[0]; m.high.value = String(Number(m.high.value) / 3); m.high.dispatchEvent(new Event('change')); })()"
        )
        self.number("new Promise((done) => setTimeout(done, 300))")
        self.assertNotEqual(self.number(self.PICTURE), before)

    def test_values_under_the_pointer(self):
        """What is read at a place is the run's own pressure there, to the steps of 8 bits."""
        self.number("window.report.movies[0].go(3)")
        self.drawn(3)
        x, y = self.number(
            "(() => { const m = window.report.movies[0], b = m.canvas.getBoundingClientRect(); m.canvas.scrollIntoView({block: 'center', behavior: 'instant'});"
            " const c = m.canvas.getBoundingClientRect(); return [c.left + m.last.x(-0.03), c.top + m.last.y(0.02)]; })()"
        )
        self.browser.call("Input.dispatchMouseEvent", {"type": "mouseMoved", "x": x, "y": y})
        self.browser.wait("document.querySelector('.readout').textContent")
        said = self.number("document.querySelector('.readout').textContent")
        from undex_post import MidPlane, Run

        with MidPlane(Run(tube())) as plane:
            frame = plane.frame(3)
            pressure = frame.fluid.fields["pressure"][int(0.02 / plane.grid.pixel), int(0.03 / plane.grid.pixel)]
        self.assertRegex(said, r"^z -(30|29\.\d|30\.\d) mm, x (20|19\.\d|20\.\d) mm: pressure [\d.]+ MPa")
        self.assertAlmostEqual(float(said.split("pressure ")[1].split()[0]), 1e-6 * pressure, delta=0.1e-6 * pressure + 1)

    def test_charts_zoom_by_buttons_and_follow_one_another(self):
        ranges = "window.report.charts.filter((each) => each.data.time && each.data.x === window.report.charts.at(-1).data.x).map((each) => each.graph.xAxisRange())"
        before = self.number(ranges)
        self.number("document.querySelectorAll('.charts .chart')[1].querySelector('.tools button').click()")
        after = self.number(ranges)
        width = after[-1][1] - after[-1][0]
        self.assertLess(width, 0.6 * max(high - low for low, high in before))
        for low, high in after:
            self.assertAlmostEqual(high - low, width, 3)
        self.number("document.querySelectorAll('.charts .chart')[1].querySelector('.tools button:last-child').click()")
        for (low, high), (old_low, old_high) in zip(self.number(ranges), before):
            self.assertAlmostEqual(low, old_low, 3)
            self.assertAlmostEqual(high, old_high, 3)

    def test_charts_zoom_by_dragging(self):
        chart = "window.report.charts[0]"
        left, top, width, height = self.number(
            f"(() => {{ {chart}.plot.scrollIntoView({{block: 'center', behavior: 'instant'}}); const r = {chart}.plot.getBoundingClientRect();"
            " return [r.left, r.top, r.width, r.height]; })()"
        )
        before = self.number(f"{chart}.graph.xAxisRange()")
        self.browser.drag((left + 0.3 * width, top + 0.5 * height), (left + 0.6 * width, top + 0.5 * height))
        low, high = self.number(f"{chart}.graph.xAxisRange()")
        self.assertLess(high - low, 0.5 * (before[1] - before[0]))
        self.assertGreater(low, before[0])

    def test_hovering_reads_the_curves(self):
        self.number("window.report.charts[0].read(40)")
        said = float(self.number("window.report.charts[0].outputs[0].textContent"))
        from undex_post import Run

        self.assertAlmostEqual(said, 1e3 * Run(tube()).summary["metrics"]["displacement_40us_m"], 2)

    def test_curves_are_hidden_by_their_boxes(self):
        self.number("document.querySelector('.legend input').click()")
        self.assertEqual(self.number("window.report.charts[0].graph.visibility()[0]"), False)

    def test_narrow_screens_do_not_scroll_sideways(self):
        for width in (360, 768):
            self.browser.size(width, 740, phone=True)
            self.open()
            self.assertLessEqual(self.number("document.documentElement.scrollWidth"), width)
            small = self.number(
                "[...document.querySelectorAll('main button, main select')].filter((each) => each.offsetHeight > 0 && each.offsetHeight < 30).length"
            )
            self.assertEqual(small, 0)

    def test_dark_screens_have_light_text(self):
        self.browser.scheme("dark")
        self.open()
        ink, paper = (
            self.number(f"getComputedStyle(document.body).{name}.match(/\\d+/g).slice(0, 3).reduce((a, b) => a + Number(b), 0)")
            for name in ("color", "backgroundColor")
        )
        self.assertGreater(ink, paper + 300)
        self.assertEqual(self.browser.console, [])

    def test_it_prints(self):
        data = self.browser.pdf()
        self.assertEqual(data[:5], b"%PDF-")
        self.assertGreater(data.count(b"/Type /Page"), 2)

    def test_the_scene_can_be_saved(self):
        self.number(
            "window.saved = null; URL.createObjectURL = (blob) => { blob.text().then((text) => { window.saved = text; }); return 'data:,'; };"
            "document.querySelector('[data-save]').click()"
        )
        self.browser.wait("window.saved !== null")
        self.assertEqual(self.number("window.saved").strip(), (tube() / "resolved.toml").read_text().strip())

    def test_hostile_names_do_not_run(self):
        folder = changed_tube()
        evil = "</script><script>window.owned = 1</script><img src=x onerror=window.owned=1>"
        scene = folder / "resolved.toml"
        lines = [f"title = '{evil}'" if line.startswith("title") else line for line in scene.read_text().splitlines()]
        scene.write_text("\n".join(lines).replace('name = "tube"', f"name = '{evil}'") + "\n")
        wall = folder / "history" / "midline_wall.csv"
        wall.write_text(wall.read_text().replace("void_fraction [-]", f"{evil} [{evil}]"))
        self.open(reported(folder))
        self.assertIsNone(self.number("window.owned ?? null"))
        self.assertEqual(self.number("document.querySelector('h1').textContent"), evil)
        self.assertEqual(self.number("document.querySelectorAll('img').length"), 0)
        self.assertEqual(self.browser.console, [])

    def test_a_page_of_several_runs(self):
        self.open(reported(tube(), changed_tube()))
        self.assertEqual(self.number("window.report.movies.length"), 2)
        self.assertEqual(self.browser.console, [])

    def test_nan_in_a_history_leaves_a_gap(self):
        folder = changed_tube()
        wall = folder / "history" / "midline_wall.csv"
        lines = wall.read_text().splitlines()
        for i in range(20, 40):
            lines[i] = lines[i].split(",")[0] + ",nan,nan"
        wall.write_text("\n".join(lines) + "\n")
        self.open(reported(folder))
        self.assertEqual(self.browser.console, [])
        self.assertEqual(self.number("window.reportProblems"), [])


if __name__ == "__main__":
    unittest.main()
