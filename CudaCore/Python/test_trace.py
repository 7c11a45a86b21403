# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The tracer from Python against closed forms: python3 CudaCore/Python/test_trace.py, where the wheel is
installed."""

import unittest

import numpy as np
import schlieren_core

A, S = 2.7e-4, 0.3  # of a column A exp(-r^2 / S^2) around x, in the cube from -1 to 1


def column(points=96):
    x = np.linspace(-1, 1, points)
    z, y, _ = np.meshgrid(x, x, x[:8], indexing="ij")
    return A * np.exp(-(y**2 + z**2) / S**2), (2 / (points - 1),) * 3


def trace(**settings):
    samples, spacing = column()
    settings = {"origin": (0, -1, -1), "ambient": 0, "parallel_scale": 0.9, "size": (8, 90), **settings}
    return schlieren_core.trace(settings.pop("samples", samples), settings.pop("spacing", spacing), **settings)


class Column(unittest.TestCase):
    def setUp(self):
        self.image = trace()
        self.y = self.image["origin"][1] + self.image["pixel_size"] * np.arange(90)

    def test_deflection(self):
        exact = -2 * np.sqrt(np.pi) * A * (self.y / S) * np.exp(-(self.y / S)**2)
        u, v = np.moveaxis(self.image["deflection"], 2, 0)
        self.assertLess(np.abs(v[:, 4] - exact).max(), 1e-3 * np.abs(exact).max())
        self.assertLess(np.abs(u[:, 4]).max(), 1e-3 * np.abs(exact).max())

    def test_path(self):
        exact = np.sqrt(np.pi) * A * S * np.exp(-(self.y / S)**2)
        path = self.image["optical_path_difference"][:, 4]
        self.assertLess(np.abs(path - exact).max(), 1e-3 * exact.max())
        scaled = trace(length_scale=1e-3)["optical_path_difference"][:, 4]
        self.assertLess(np.abs(scaled - 1e-3 * path).max(), 1e-8 * exact.max())

    def test_formulas(self):
        k = 500.0
        edge = trace(k=k, knife_edge_angle=90, samples_per_pixel=1, precision="double")
        bent = edge["deflection"][..., 1]
        self.assertEqual(edge["k"], k)
        inner = np.s_[3:-3, 2:-2]
        self.assertLess(np.abs(edge["intensity"] - np.clip(0.5 + k * bent, 0, 1))[inner].max(), 5e-3)
        fringes = trace(cutoff="interferogram", length_scale=0.01, size=(8, 270), samples_per_pixel=1, precision="double")
        phase = 2 * np.pi * fringes["optical_path_difference"] / 632.8e-9
        self.assertLess(np.abs(fringes["intensity"] - (1 + np.cos(phase)) / 2)[inner].max(), 0.01)
        self.assertEqual(trace(cutoff="color filter")["color"].shape, (90, 8, 3))

    def test_arrays(self):
        samples, _ = column()
        for name, shape in (("intensity", (90, 8)), ("deflection", (90, 8, 2)), ("blocked_fraction", (90, 8))):
            self.assertEqual((self.image[name].shape, self.image[name].dtype), (shape, np.float32), name)
        single = trace(samples=samples.astype(np.float32))["deflection"]
        reversed_twice = trace(samples=samples[::-1][::-1])["deflection"]
        np.testing.assert_array_equal(reversed_twice, self.image["deflection"])
        self.assertLess(np.abs(single - self.image["deflection"]).max(), 1e-6)
        # Along y the column looks the same; its axis is still x.
        turned = trace(samples=np.swapaxes(samples, 0, 1).copy(), view_direction=(0, 1, 0), view_up=(0, 0, 1))
        self.assertLess(np.abs(turned["deflection"][..., 1] - self.image["deflection"][..., 1]).max(), 1e-6)

    def test_solids(self):
        samples, _ = column()
        samples[:, 60:70] = np.nan
        blocked = trace(samples=samples)["blocked_fraction"][:, 4]
        inside = (self.y > -1 + 2 * 61 / 95) & (self.y < -1 + 2 * 68 / 95)
        self.assertTrue(inside.any() and blocked[inside].min() == 1 and blocked[:40].max() == 0)

    def test_mistakes(self):
        for word, settings in (("z, y, x", {"samples": np.zeros((4, 4))}), ("complex", {"samples": np.zeros((4, 4, 4), complex)}),
                               ("spacing", {"spacing": (1, 1)}), ("'knife edge'", {"cutoff": "knife"}),
                               ("columns, rows", {"size": 512}), ("'refracted'", {"path": "bent"}), ("spacing", {"spacing": (1, 1, 0)})):
            with self.assertRaisesRegex(schlieren_core.Error, word) as caught:
                trace(**settings)
            self.assertIsInstance(caught.exception, ValueError)


if __name__ == "__main__":
    unittest.main()
