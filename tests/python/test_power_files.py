"""Files of power over time and frequency: sigproc filterbanks, whole, large and hostile."""

import json
import os
import resource
import struct
import subprocess
import unittest

import numpy as np

import faintline as fl
from support import InFolder


def keyword(name, value=None):
    word = struct.pack("<i", len(name)) + name.encode()
    if value is None:
        return word
    if isinstance(value, str):
        return word + struct.pack("<i", len(value)) + value.encode()
    return word + struct.pack("<d" if isinstance(value, float) else "<i", value)


def header(nchans=64, nbits=32, tsamp=1.0, fch1=1420.0, foff=-1e-5, nifs=1, **more):
    text = keyword("HEADER_START") + keyword("source_name", "test")
    for name, value in dict(nchans=nchans, nbits=nbits, tsamp=tsamp, fch1=fch1, foff=foff, nifs=nifs, **more).items():
        text += keyword(name, value)
    return text + keyword("HEADER_END")


def packed(values, nbits):
    """frames x channels, whole numbers of few bits, the lowest bits first."""
    per_byte = 8 // nbits
    flat = values.astype("u1").reshape(-1, per_byte)
    return sum(flat[:, i] << (i * nbits) for i in range(per_byte)).astype("u1").tobytes()


def drifting_line(frames=300, channels=64, looks=1, amplitude=3.0, seed=1):
    """Power of noise with a passband, and a line that goes from channel 20 to channel 40 in frames 50 to 250; ascending frequencies."""
    rng = np.random.default_rng(seed)
    power = rng.gamma(looks, 1 / looks, size=(frames, channels))
    for frame in range(50, 250):
        cell = round(20 + 20 * (frame - 50) / 200)
        power[frame, cell] = rng.noncentral_chisquare(2 * looks, 2 * looks * amplitude) / (2 * looks)
    return power * (1 + 0.5 * np.sin(np.linspace(0, 2, channels)))


class Filterbanks(InFolder):
    def write(self, data, **fields):
        path = self.folder / "x.fil"
        path.write_bytes(header(**fields) + data)
        return path

    def assert_line_found(self, path, first=1420e6 - 63 * 10.0, step=10.0):
        result = fl.detect(path, false_alarms_per_hour=1)
        self.assertGreater(len(result.events), 0)
        track = max(result.tracks, key=len)
        at = track.f[np.searchsorted(track.t, 150.5)]
        self.assertAlmostEqual((at - first) / step, 30, delta=2.5)
        return result

    def test_all_sample_types(self):
        power = drifting_line(looks=8, amplitude=2.0)[:, ::-1]  # foff is negative: the highest channel first
        scaled = {
            1: power > 1.4,
            2: np.clip(power, 0, 3),
            4: np.clip(power * 4, 0, 15),
            8: np.clip(power * 40, 0, 255),
            16: np.clip(power * 8000, 0, 65535),
            32: power,
        }
        for nbits, values in scaled.items():
            with self.subTest(nbits):
                kind = {8: "u1", 16: "<u2", 32: "<f4"}.get(nbits)
                data = values.astype(kind).tobytes() if kind else packed(values, nbits)
                path = self.write(data, nbits=nbits)
                frames = fl.open(path)
                self.assertEqual(frames.shape, (300, 64))
                self.assertAlmostEqual(frames.axes[0].first, 1420e6 - 630, delta=1e-3)
                y = frames.read()
                self.assertTrue(0.7 < y[:50].mean() < 1.3, y[:50].mean())
                if nbits > 1:
                    self.assert_line_found(path)

    def test_noise_becomes_exponential_whatever_was_averaged(self):
        for looks in (1, 4, 50, 1000):
            with self.subTest(looks):
                power = np.random.default_rng(2).gamma(looks, 1 / looks, size=(400, 128)) * np.linspace(1, 3, 128)
                y = fl.open(self.write(power.astype("f4").tobytes(), nchans=128)).read()
                for p in (0.1, 0.5, 0.9, 0.99):
                    self.assertAlmostEqual((y > -np.log(p)).mean(), p, delta=0.02)

    def test_polarisations_are_channels(self):
        power = drifting_line()[:, ::-1]
        both = np.stack([np.random.default_rng(5).exponential(size=power.shape), power], axis=1)
        path = self.write(both.astype("<f4").tobytes(), nifs=2)
        self.assertGreater(len(fl.detect(path, channel=1).events), 0)
        self.assertIn("2 channel(s)", self.refusal(fl.detect, path, channel=2).why)

    def test_a_part(self):
        path = self.write(drifting_line().astype("<f4").tobytes(), foff=1e-5)
        result = fl.detect(path, low_hz=1420e6 + 100, high_hz=1420e6 + 505, from_seconds=40.0, to_seconds=260.0)
        self.assertEqual(result.input.shape, (220, 41))
        self.assertEqual(result.frequency.first, 1420e6 + 100)
        self.assertGreater(len(result.events), 0)
        self.assertIn("selects nothing", self.refusal(fl.detect, path, low_hz=1.0, high_hz=2.0).why)

    def test_unobserved_values_are_no_evidence(self):
        power = drifting_line()[:, ::-1]
        power[100:110, 5] = np.nan
        power[120, :] = np.inf
        y = fl.open(self.write(power.astype("<f4").tobytes())).read()[:, ::-1]
        self.assertTrue(np.isnan(y[100:110, 5]).all() and np.isnan(y[120]).all())
        self.assertEqual(np.isnan(y).sum(), 10 + 64)

    def test_the_same_from_the_command_line(self):
        path = self.write(drifting_line()[:, ::-1].astype("<f4").tobytes())
        self.command_line("detect", path, "--events", "c.csv", "--statistic", "c.npy")
        result = self.assert_line_found(path)
        result.save(events=self.folder / "p.csv")
        self.assertEqual((self.folder / "c.csv").read_bytes(), (self.folder / "p.csv").read_bytes())
        self.assertTrue(np.array_equal(np.load(self.folder / "c.npy"), result.statistic))
        info = json.loads(self.command_line("info", path, "--json"))
        self.assertEqual(info["frequency"], {"unit": "Hz", "first": 1420e6 - 630, "step": 10.0, "count": 64} | info["frequency"])
        event = result.events[0]
        told = self.command_line("explain", path, "--time", event["t_detect"], "--frequency", event["f"])
        self.assertIn("statistic", told)

    def test_slopes_in_hertz_a_second(self):
        path = self.write(drifting_line()[:, ::-1].astype("<f4").tobytes())
        settings = {"model.slopeUnit": "hzPerSecond", "model.lowestSlope": -5.0, "model.highestSlope": 5.0}
        result = fl.detect(path, settings=settings)  # channels of 10 Hz, frames of 1 s
        self.assertEqual((result.settings["model.lowestSlope"], result.settings["model.highestSlope"]), (-0.5, 0.5))
        self.assertGreater(len(result.events), 0)

    def test_hostile_headers(self):
        good = header()
        data = bytes(64 * 4 * 4)
        hostile = {
            "cut in its header": (good[:40], "truncated or longer"),
            "a word of no length": (keyword("HEADER_START") + struct.pack("<i", 0) + data, "characters"),
            "a word of two billion": (keyword("HEADER_START") + struct.pack("<i", 2**31 - 1) + data, "characters"),
            "an unknown word": (keyword("HEADER_START") + keyword("evil\x1b[2J", 3) + data, "unknown"),
            "no end": (keyword("HEADER_START") + keyword("nbits", 8) * 9000, "truncated or longer"),
            "no channels": (header(nchans=0) + data, "nchans"),
            "too many channels": (header(nchans=2**31 - 1) + data, "nchans"),
            "negative channels": (header(nchans=-5) + data, "nchans"),
            "odd bits": (header(nbits=7) + data, "nbits"),
            "NaN frequencies": (header(fch1=float("nan")) + data, "fch1"),
            "infinite distance": (header(foff=float("inf")) + data, "foff"),
            "no distance": (header(foff=0.0) + data, "foff"),
            "NaN time": (header(tsamp=float("nan")) + data, "tsamp"),
            "no time": (header(tsamp=0.0) + data, "tsamp"),
            "many polarisations": (header(nifs=2**30) + data, "nifs"),
            "half a byte": (header(nchans=3, nbits=1) + data, "whole bytes"),
            "no spectrum": (header(nchans=4096) + data[:100], "no complete spectrum"),
            "only zeros": (good + data, "holds no power"),
            "only NaN": (good + np.full((100, 64), np.nan, "<f4").tobytes(), "holds no power"),
            "only negative": (good + np.full((100, 64), -1, "<f4").tobytes(), "holds no power"),
            "a frequency table": (keyword("HEADER_START") + keyword("FREQUENCY_START") + data, "evenly spaced"),
        }
        for name, (content, part) in hostile.items():
            with self.subTest(name):
                path = self.folder / "x.fil"
                path.write_bytes(content)
                self.assertIn(part, self.refusal(fl.open, path).what)

    def test_what_ends_too_soon_is_read_as_far_as_it_goes(self):
        data = drifting_line().astype("<f4").tobytes()
        path = self.write(data[:-100], nsamples=1_000_000)
        self.assertEqual(len(fl.open(path)), 299)
        self.assertIn("claims 1000000", self.command_line("info", path))

    def test_a_sparse_file_of_100_gb_takes_little_memory(self):
        path = self.write(b"", nchans=1024, nbits=8)
        rng = np.random.default_rng(1)
        with open(path, "r+b") as file:
            begins = file.seek(0, 2)
            file.write(rng.integers(90, 110, size=(4000, 1024), dtype="u1").tobytes())
            file.truncate(begins + 100 * 2**30)
        if os.stat(path).st_blocks * 512 > 2**30:
            self.skipTest("the file system knows no sparse files")
        program = os.environ["FAINTLINE_CLI"]
        for words in (["info"], ["detect", "--set", "selection.toSeconds=4000", "--events", self.folder / "e.csv"]):
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
            done = subprocess.run([program, words[0], path, *words[1:]], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
            print(f"{words[0]}: {peak:.0f} MiB at most")
            self.assertLess(peak, 500, before)


class Spectrograms(InFolder):
    """NumPy files with the axes beside them."""

    GRID = {
        "values": "power",
        "time": {"first": 0.5, "step": 1.0},
        "axes": [{"name": "frequency", "unit": "Hz", "first": 1420e6 - 630, "step": 10.0}],
    }

    def write(self, values, grid=None):
        path = self.folder / "p.npy"
        np.save(path, values)
        (self.folder / "p.grid.json").write_text(json.dumps(self.GRID if grid is None else grid))
        return path

    def test_the_same_as_a_filterbank(self):
        power = drifting_line().astype("f4")
        fil = self.folder / "x.fil"
        fil.write_bytes(header() + power[:, ::-1].tobytes())
        expected = fl.detect(fil).events
        self.assertGreater(len(expected), 0)
        for values in (power, power.astype("f8")):
            np.testing.assert_equal(fl.detect(self.write(values)).events.tolist(), expected.tolist())

    def test_any_unit(self):
        power = drifting_line()
        a = fl.detect(self.write((power * 1e-12).astype("f8"))).events
        b = fl.detect(self.write((power * 1e9).astype("f4"))).events
        self.assertEqual(a["t_detect"].tolist(), b["t_detect"].tolist())

    def test_without_the_word_it_is_normalised_power(self):
        y = np.random.default_rng(1).exponential(size=(50, 20)).astype("f4")
        grid = {key: value for key, value in self.GRID.items() if key != "values"}
        self.assertTrue(np.array_equal(fl.open(self.write(y, grid)).read(), y))

    def test_hostile_axes(self):
        power = drifting_line().astype("f4")
        axis = self.GRID["axes"][0]
        for grid, part in (
            (self.GRID | {"values": "loudness"}, "values"),
            (self.GRID | {"axes": [axis | {"step": 0}]}, "step"),
            (self.GRID | {"axes": [axis | {"count": 63}]}, "count"),
            (self.GRID | {"axes": [axis, axis]}, "axes"),
            (self.GRID | {"time": {"step": -1}}, "step"),
            (self.GRID | {"time": {"step": float("nan")}}, "line"),
        ):
            with self.subTest(grid):
                self.assertIn(part, self.refusal(fl.open, self.write(power, grid)).what)
        path = self.write(power)
        path.write_bytes(path.read_bytes()[:-8])
        self.assertIn("is truncated", self.refusal(fl.open, path).why)


if __name__ == "__main__":
    unittest.main()
