"""Reading of what a run leaves: tables, fields, and folders of which part is missing."""
import json
import shutil
import unittest

import numpy as np
from sample_run import CASES, changed_tube, temporary_folder, tube

from undex_post import Missing, Run
from undex_post.particles import FluidParticles
from undex_post.run import component_axis
from undex_post.tables import read_columns, read_reference_table


class Tables(unittest.TestCase):
    def write(self, text: str):
        path = temporary_folder() / "table.csv"
        path.write_text(text)
        return path

    def test_columns_have_names_and_units(self):
        columns = read_columns(self.write("time [s],pressure [Pa],count\n0,1e5,2\n1e-6,nan,3\n"))
        self.assertEqual(list(columns), ["time", "pressure", "count"])
        self.assertEqual(columns.units, {"time": "s", "pressure": "Pa", "count": ""})
        self.assertTrue(np.isnan(columns["pressure"][1]))

    def test_part_of_a_row_at_the_end_is_left_out(self):
        columns = read_columns(self.write("time [s],x [m]\n0,1\n1,2\n2,3.4"))
        np.testing.assert_array_equal(columns["time"], [0, 1])

    def test_what_is_no_table_is_said(self):
        for text, words in (
            ("", "no rows"),
            ("a,b\n", "no rows"),
            ("a,b\n1,x\n", "not a table of numbers"),
            ("a,b\n1\n", "columns"),
            ("a,b\n1,2\n3\n", "not a table of numbers"),
        ):
            with self.assertRaisesRegex(Missing, words):
                read_columns(self.write(text))

    def test_reference_table_is_in_si(self):
        table = read_reference_table(CASES / "al_tube_fem" / "reference" / "displacement.csv")
        self.assertAlmostEqual(table.rows["displacement_150us_m"].sources["converged Tait"].value, 4.40e-3)
        self.assertAlmostEqual(table.rows["displacement_150us_m"].sources["converged Tait"].spread, 0.05e-3)
        self.assertNotIn("paper MG", table.rows["displacement_200us_m"].sources)

    def test_components(self):
        self.assertEqual(component_axis("velocity_x"), ("velocity", "x"))
        self.assertEqual(component_axis("void_fraction"), ("void_fraction", ""))


class RunFolder(unittest.TestCase):
    def test_all_parts_are_read(self):
        run = Run(tube())
        self.assertEqual(run.dimension, "axisymmetric")
        self.assertEqual(set(run.histories), {"midline_wall", "midline_outer", "mid_wall"})
        self.assertEqual(run.setting("resolution.spacing"), 0.002)
        self.assertEqual(run.notes, [])
        self.assertAlmostEqual(run.energy["time"][-1], run.summary["time_s"])
        with run.particles() as snapshots:
            self.assertGreater(len(snapshots), 10)
            snapshot = snapshots.read(0)
            self.assertEqual(len(snapshot["position"]), run.summary["particles"])
            np.testing.assert_array_equal(snapshot["id"], np.arange(run.summary["particles"]))
        (structure,) = run.structures()
        mesh = structure.read(0)
        self.assertEqual(len(mesh.cells), run.summary["cells"])
        self.assertTrue(all(len(cell) == 4 for cell in mesh.cells))

    def test_bodies_without_the_field_material_are_told_apart_by_density(self):
        run = Run(tube())
        with run.particles() as snapshots:
            known = snapshots.read(0)["material"].astype(int)
            without = _Without(snapshots, {"material", "mass"})
            found = FluidParticles(run, without)
        np.testing.assert_array_equal(found.bodies, known)

    def test_masses_come_from_the_checkpoint_where_snapshots_have_none(self):
        run = Run(tube())
        with run.particles() as snapshots:
            exact, derived = FluidParticles(run, snapshots), FluidParticles(run, _Without(snapshots, {"material", "mass"}))
            snapshot = snapshots.read(3)
            expected = exact.volume(snapshot)
            del snapshot["mass"]
            np.testing.assert_allclose(derived.volume(snapshot), expected, rtol=1e-5)

    def test_a_folder_that_is_no_runs_is_refused(self):
        empty = temporary_folder()
        with self.assertRaisesRegex(Missing, "no summary.json"):
            Run(empty)
        with self.assertRaisesRegex(Missing, "no such folder"):
            Run(empty / "nowhere")

    def test_damage_is_noted_and_the_rest_is_read(self):
        folder = changed_tube()
        (folder / "summary.json").write_text('{"scene": "half')
        (folder / "resolved.toml").write_text("title = ")
        (folder / "history" / "mid_wall.csv").write_text("time [s],a\n")
        run = Run(folder)
        self.assertEqual(set(run.histories), {"midline_wall", "midline_outer"})
        self.assertIsNotNone(run.energy)
        notes = " ".join(run.notes)
        for word in ("summary.json", "resolved.toml", "mid_wall.csv"):
            self.assertIn(word, notes)

    def test_damaged_fields_are_said(self):
        folder = changed_tube()
        path = folder / "fields" / "particles.h5part"
        path.write_bytes(path.read_bytes()[:1000])
        with self.assertRaisesRegex(Missing, "cannot be read"):
            Run(folder).particles()

    def test_an_index_leads_to_no_file_outside(self):
        folder = changed_tube()
        shutil.copy(folder / "fields" / "structure_00000.hdf", folder / "outside.hdf")
        (folder / "fields" / "structure.hdf.series").write_text(json.dumps({"files": [{"name": "../outside.hdf", "time": 0}]}))
        (structure,) = Run(folder).structures()
        self.assertEqual(structure.times, [])


class _Without:
    """Snapshots that lack some fields."""

    def __init__(self, snapshots, fields):
        self._snapshots, self._fields = snapshots, fields

    def __len__(self):
        return len(self._snapshots)

    def read(self, index):
        return {name: values for name, values in self._snapshots.read(index).items() if name not in self._fields}


if __name__ == "__main__":
    unittest.main()
