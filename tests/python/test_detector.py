"""The recursion alone: streams, custom likelihoods."""

import json
import unittest

import numpy as np

import faintline as fl
from support import InFolder

GRID = fl.Axis("frequency", 64, unit="Hz", step=0.5)
LAW = {"rates": [-1, 0, 1], "rateChange": [0.5, 0.25]}


class StreamDetector(InFolder):
    def power(self, frames=50):
        return np.random.default_rng(1).exponential(size=(frames, 64)).astype("f4")

    def test_the_same_as_the_command_line(self):
        y = self.power()
        model = {"axes": [LAW | {"cells": 64}], "likelihood": {"kind": "rice", "r0": 0.5}, "reset": {"lnK": -0.2}}
        np.save(self.folder / "y.npy", y)
        (self.folder / "model.json").write_text(json.dumps(model))
        self.command_line("statistic", "--frames", "y.npy", "--model", "model.json", "--out", "s.npy", "--projected", "d.npy")
        detector = fl.Detector(GRID, model)
        statistic = np.stack([detector.update(frame) for frame in y])
        self.assertTrue(np.array_equal(statistic, np.load(self.folder / "d.npy")))
        self.assertTrue(np.array_equal(detector.scores, np.load(self.folder / "s.npy")[-1]))
        self.assertEqual(detector.frames, 50)

    def test_one_by_one_or_many_at_once(self):
        y = self.power(5000)
        model = {"axes": [LAW], "likelihood": {"kind": "rice", "r0": 0.5}, "reset": {"lnK": -0.2}}
        one, many = fl.Detector(GRID, model), fl.Detector([GRID], model)
        self.assertTrue(np.array_equal(np.stack([one.update(frame) for frame in y]), many.update(y, threads=2)))

    def test_a_likelihood_of_ones_own(self):
        y = self.power()
        r0 = 0.5
        own = {"axes": [LAW], "reset": {"lnK": -0.2}}
        exponential = own | {"likelihood": {"kind": "exponential", "snr": r0}}
        llr = y * r0 / (1 + r0) - np.log1p(r0)
        mine, theirs = fl.Detector(GRID, own).update(llr), fl.Detector(GRID, exponential).update(y)
        self.assertLess(np.abs(mine - theirs).max(), 1e-4)
        self.assertLess(mine.min(), 0)  # evidence against is evidence
        summed = own | {"semiring": "sum"}
        self.assertTrue((fl.Detector(GRID, summed).update(llr) >= mine - 1e-4).all())

    def test_refusals(self):
        detector = fl.Detector(GRID, {"axes": [LAW]})
        self.assertIn("(64,)", self.refusal(detector.update, np.zeros(63)).why)
        self.assertIn("infinity", self.refusal(detector.update, np.full(64, np.inf)).why)
        self.assertIn("one law for each", self.refusal(fl.Detector, [GRID, GRID], {"axes": [LAW]}).why)
        self.assertIn("rateChanges", self.refusal(fl.Detector, GRID, {"axes": [{"rateChanges": [1]}]}).what)
        power = fl.Detector(GRID, {"axes": [LAW], "likelihood": {"kind": "linear"}})
        self.assertIn("not negative", self.refusal(power.update, np.full(64, -1.0)).why)


if __name__ == "__main__":
    unittest.main()
