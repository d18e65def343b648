"""Digital RF: a channel's folder as one recording."""

import importlib.util
import sys

if importlib.util.find_spec("h5py") is None:
    print("skipped: not installed: h5py (Debian: python3-h5py)")
    sys.exit(77)

import unittest

import h5py
import numpy as np

import faintline as fl
from support import InFolder


class DigitalRf(InFolder):
    RATE = 200_000
    SECONDS = 1769212800

    def write(self, first, x, index=None, name=None, **attributes):
        """Files of a channel as the library writes them: pairs of numbers, and where their stretches begin."""
        name = name or f"rf@{first / self.RATE:.3f}.h5"
        path = self.folder / "ch0" / "2026-01-24T00-00-00" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        with h5py.File(path, "w") as file:
            data = file.create_dataset("rf_data", data=x, chunks=True, compression="gzip")
            data.attrs.update({"sample_rate_numerator": np.uint64(self.RATE), "sample_rate_denominator": np.uint64(1)} | attributes)
            file["rf_data_index"] = np.array([[first, 0]] if index is None else index, "u8")
        return path

    def pairs(self, samples):
        x = np.zeros((len(samples), 1), [("r", "<i2"), ("i", "<i2")])
        x["r"][:, 0], x["i"][:, 0] = samples.real, samples.imag
        return x

    def noise(self, count):
        rng = np.random.default_rng(6)
        return np.round(1000 * (rng.normal(size=count) + 1j * rng.normal(size=count)))

    def test_a_channel_is_one_recording(self):
        z = self.noise(5 * self.RATE)
        z += np.round(300 * np.exp(2j * np.pi * 20_000 * np.arange(len(z)) / self.RATE))
        begin = self.SECONDS * self.RATE
        for i in (0, 1, 2, 4):
            self.write(begin + i * self.RATE, self.pairs(z[i * self.RATE : (i + 1) * self.RATE]))
        with h5py.File(self.folder / "ch0" / "drf_properties.h5", "w") as file:
            file.attrs["is_complex"] = 1
        recording = fl.open(self.folder / "ch0")
        self.assertEqual((recording.rate, recording.start, recording.is_complex), (self.RATE, self.SECONDS, True))
        expected = (z / 32768).astype("c8")
        expected[3 * self.RATE : 4 * self.RATE] = 0
        self.assertTrue(np.array_equal(recording.read(), expected))
        result = fl.detect(recording, window_seconds=0.05)
        self.assertTrue(any(abs(event["f"] - 20_000) < 50 for event in result.events))
        unseen = np.isnan(result.input).all(axis=1).sum() * 0.025
        self.assertTrue(1.0 <= unseen <= 1.1, unseen)

    def test_types_and_gaps_within(self):
        begin = self.SECONDS * self.RATE
        x = np.arange(12, dtype="f4").reshape(6, 2)
        path = self.write(begin, x, index=[[begin, 0], [begin + 10, 4]])
        recording = fl.open(path)
        self.assertEqual((recording.channels, len(recording), recording.is_complex), (2, 12, False))
        for channel in (0, 1):
            expected = np.zeros(12, "f4")
            expected[:4], expected[10:] = x[:4, channel], x[4:, channel]
            self.assertTrue(np.array_equal(recording.read(channel=channel), expected))
        for kind, full in (("i1", 128), ("<i2", 32768), ("<i4", 2**31)):
            flat = fl.open(self.write(begin, np.array([-full, 0, full // 2], kind)))
            self.assertEqual(flat.read().tolist(), [-1.0, 0.0, 0.5])

    def test_hostile_files(self):
        begin = self.SECONDS * self.RATE
        x = np.ones((10, 1), "f4")
        hostile = {
            "no rate": (dict(sample_rate_numerator=0), "sample rate"),
            "rate of 0/0": (dict(sample_rate_numerator=0, sample_rate_denominator=0), "sample rate"),
            "rows that are not there": (dict(index=[[begin, 0], [begin + 99, 10]]), "contradicts"),
            "rows backwards": (dict(index=[[begin, 0], [begin + 99, 5], [begin + 200, 3]]), "contradicts"),
            "time backwards": (dict(index=[[begin, 0], [begin - 9, 5]]), "contradicts"),
            "time that overlaps": (dict(index=[[begin, 0], [begin + 2, 5]]), "contradicts"),
            "in a thousand years": (dict(index=[[begin, 0], [2**62, 5]]), "contradicts"),
            "beyond 63 bits": (dict(index=[[2**64 - 1, 0], [5, 5]]), "contradicts"),
            "a flat index": (dict(index=[begin, 0]), "first sample and a row"),
        }
        for name, (how, part) in hostile.items():
            with self.subTest(name):
                self.assertIn(part, self.refusal(fl.open, self.write(begin, x, **how)).what)
        wide = np.ones((2, 3, 2), "f4")
        self.assertIn("no rf_data", self.refusal(fl.open, self.write(begin, wide)).what)
        texts = np.array([[b"a"]], "S5")
        self.assertIn("not hold numbers", self.refusal(fl.open, self.write(begin, texts)).what)


if __name__ == "__main__":
    unittest.main()
