"""Kernel sums onto a grid: what they must reproduce exactly, and the mid-plane made of them."""
import unittest

import numpy as np
from sample_run import tube

from undex_post import KERNELS, Cloud, Grid, MidPlane, Run, kernel_sum, linear, shepard
from undex_post.histories import Curve, thinned
from undex_post.kernels import kernel_named
from undex_post.mid_plane import simplified

SPACING = 0.05


def lattice(dimension: int, eta: float, jitter: float = 0.0) -> Cloud:
    """A unit square (cube about the plane) of particles on a square lattice."""
    side = (np.arange(20) + 0.5) * SPACING
    through = (np.arange(-6, 6) + 0.5) * SPACING if dimension == 3 else np.zeros(1)
    x, y, z = (each.ravel() for each in np.meshgrid(side, side, through, indexing="ij"))
    random = np.random.default_rng(7)
    points = np.stack([x, y], axis=1) + jitter * SPACING * random.uniform(-1, 1, (len(x), 2))
    return Cloud(points, z, np.full(len(x), eta * SPACING), np.full(len(x), SPACING**dimension))


class Kernels(unittest.TestCase):
    def test_integral_is_one(self):
        for kernel in KERNELS.values():
            q = (np.arange(20000) + 0.5) * kernel.support / 20000
            width = kernel.support / 20000
            for dimension, area in ((1, 2.0), (2, 2 * np.pi * q), (3, 4 * np.pi * q**2)):
                self.assertAlmostEqual(float(np.sum(area * kernel(q, 1.0, dimension)) * width), 1.0, 6, (kernel.name, dimension))

    def test_support_ends(self):
        for kernel in KERNELS.values():
            self.assertEqual(float(kernel(np.array(kernel.support * 1.01), 1.0, 3)), 0.0)
            self.assertGreater(float(kernel(np.array(kernel.support * 0.98), 1.0, 3)), 0.0)

    def test_an_unknown_name_is_wendlands(self):
        self.assertEqual(kernel_named("none such").name, "wendland_c2")


class Sums(unittest.TestCase):
    grid = Grid.covering((0.0, 0.0), (1.0, 1.0), 0.02)

    def test_one_particle_is_the_kernel_itself(self):
        kernel = KERNELS["wendland_c2"]
        cloud = Cloud(np.array([[0.31, 0.52]]), np.array([0.03]), np.array([0.1]), np.array([1.0]))
        found = kernel_sum(cloud, np.array([2.0]), self.grid, kernel, 3)
        u, v = self.grid.middles()
        distance = np.sqrt((u[None, :] - 0.31) ** 2 + (v[:, None] - 0.52) ** 2 + 0.03**2)
        np.testing.assert_allclose(found, 2.0 * kernel(distance, 0.1, 3), atol=1e-12)

    def test_mass_is_conserved(self):
        """In the plane the integral of the density over a grid that holds all supports is the mass."""
        cloud = lattice(2, 1.5, jitter=0.3)
        grid = Grid.covering((-0.3, -0.3), (1.3, 1.3), 0.01)
        mass = np.linspace(1.0, 2.0, len(cloud.h))
        for kernel in KERNELS.values():
            density = kernel_sum(cloud, mass, grid, kernel, 2)
            self.assertAlmostEqual(density.sum() * grid.pixel**2 / mass.sum(), 1.0, 4, kernel.name)

    def test_filling_of_a_lattice_is_one_inside_and_half_on_its_surface(self):
        for kernel in KERNELS.values():
            for dimension in (2, 3):
                cloud = lattice(dimension, kernel.usual_eta)
                grid = Grid.covering((-0.005, -0.005), (1.005, 1.005), 0.01)  # middles at 0, 0.01, ...
                filling = kernel_sum(cloud, cloud.volume, grid, kernel, dimension)
                self.assertAlmostEqual(filling[50, 50], 1.0, 2, (kernel.name, dimension))
                self.assertAlmostEqual(filling[50, 0], 0.5, 1, (kernel.name, dimension))

    def test_constant_fields_are_reproduced(self):
        cloud = lattice(2, 1.5, jitter=0.4)
        found, filling = shepard(cloud, {"one": np.full(len(cloud.h), 3.5)}, self.grid, KERNELS["wendland_c2"], 2)
        np.testing.assert_allclose(found["one"], 3.5, rtol=1e-12)
        self.assertTrue((filling > 0.2).all())

    def test_linear_fields_are_reproduced_up_to_the_surface(self):
        for dimension in (2, 3):
            cloud = lattice(dimension, 1.5, jitter=0.3)
            value = 1.0 + 2.0 * cloud.points[:, 0] - 3.0 * cloud.points[:, 1] + (0.7 * cloud.offset if dimension == 3 else 0.0)
            found, _ = linear(cloud, {"value": value}, self.grid, KERNELS["wendland_c2"], dimension)
            u, v = self.grid.middles()
            np.testing.assert_allclose(found["value"], 1.0 + 2.0 * u[None, :] - 3.0 * v[:, None], atol=1e-9)

    def test_shepard_keeps_linear_fields_inside_a_lattice(self):
        cloud = lattice(2, 1.5)
        found, _ = shepard(cloud, {"x": cloud.points[:, 0]}, self.grid, KERNELS["wendland_c2"], 2)
        u, _ = self.grid.middles()
        np.testing.assert_allclose(found["x"][10:-10, 10:-10], np.broadcast_to(u, found["x"].shape)[10:-10, 10:-10], atol=1e-4)

    def test_nothing_is_nan(self):
        cloud = Cloud(np.array([[0.5, 0.5]]), np.zeros(1), np.array([0.05]), np.ones(1))
        found, filling = shepard(cloud, {"a": np.ones(1)}, self.grid, KERNELS["wendland_c2"], 2)
        self.assertTrue(np.isnan(found["a"][0, 0]))
        self.assertEqual(filling[0, 0], 0.0)

    def test_smoothing_lengths_of_all_sizes(self):
        """Windows of different sizes give what a plain double loop gives."""
        random = np.random.default_rng(3)
        cloud = Cloud(
            random.uniform(-0.2, 1.2, (60, 2)), random.uniform(-0.05, 0.05, 60), random.uniform(0.004, 0.3, 60), np.ones(60)
        )
        kernel, u, v = KERNELS["cubic_spline"], *self.grid.middles()
        expected = np.zeros((self.grid.rows, self.grid.columns))
        for (x, y), offset, h in zip(cloud.points, cloud.offset, cloud.h):
            expected += kernel(np.sqrt((u[None, :] - x) ** 2 + (v[:, None] - y) ** 2 + offset**2), h, 3)
        np.testing.assert_allclose(kernel_sum(cloud, np.ones(60), self.grid, kernel, 3), expected, atol=1e-8 * expected.max())


class Section(unittest.TestCase):
    def test_the_mid_plane_of_a_run(self):
        run = Run(tube())
        with MidPlane(run) as plane:
            self.assertEqual((plane.section.axes, plane.section.mirrors(), plane.section.dimension), ((2, 0), (True, True), 2))
            self.assertEqual(plane.grid.low, (0.0, 0.0))
            frame = plane.frame(len(plane) - 1)
            self.assertEqual(len(frame.structures), 1)
            self.assertEqual(len(frame.structures[0].polygons), run.summary["cells"])
            pressure = frame.fluid.fields["pressure"]
            snapshot = plane._fluid.read(len(plane) - 1)
            self.assertLessEqual(
                np.nanmax(pressure), snapshot["pressure"].max() * (1 + 1e-6)
            )  # means cannot exceed what they are of
            self.assertGreater(np.nanmax(pressure), 0.3 * snapshot["pressure"].max())
            # The bubble of bodies.csv: the interface meets the axis and the mid-height near its radius.
            radius = np.interp(frame.time, run.bodies["time"], run.bodies["charge.radius"])
            self.assertEqual(len(frame.fluid.interfaces), 1)
            distance = np.hypot(*frame.fluid.interfaces[0].T)
            self.assertAlmostEqual(float(np.median(distance)) / radius, 1.0, delta=0.08)

    def test_fields_step_where_bodies_meet(self):
        """Gas and water are summed apart: the density between them is that of one or of the other."""
        with MidPlane(Run(tube())) as plane:
            frame = plane.frame(len(plane) - 1)
            snapshot = plane._fluid.read(len(plane) - 1)
            gas, water = (snapshot["density"][snapshot["material"] == body] for body in (0, 1))
            density = frame.fluid.fields["density"][np.isfinite(frame.fluid.fields["density"])]
            between = (density > gas.max() * 1.001) & (density < water.min() * 0.999)
            self.assertLess(gas.max(), 0.5 * water.min())
            self.assertFalse(between.any())

    def test_simplified_lines_stay_near(self):
        angle = np.linspace(0, 2 * np.pi, 500)
        line = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        short = simplified(line, 1e-4)
        self.assertLess(len(short), 260)
        self.assertTrue(np.array_equal(short[0], line[0]) and np.array_equal(short[-1], line[-1]))
        middles = (short[1:] + short[:-1]) / 2
        self.assertLess(np.abs(np.hypot(*middles.T) - 1).max(), 1e-3)

    def test_thinned_curves_keep_peaks(self):
        y = np.zeros(100_000)
        y[54_321], y[77_777] = 5.0, -3.0
        curve = thinned(Curve("a", np.arange(100_000.0), y))
        self.assertLessEqual(len(curve.x), 1502)
        self.assertEqual((curve.y.max(), curve.y.min()), (5.0, -3.0))


if __name__ == "__main__":
    unittest.main()
