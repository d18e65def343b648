"""WAV files as receivers and recorders write them: KiwiSDR's chunks of samples behind time stamps, XWAV's times of its stretches."""

import struct
import unittest

import numpy as np

import faintline as fl
from support import InFolder

RATE = 12000


def chunk(name, content):
    return name + struct.pack("<I", len(content)) + content + b"\0" * (len(content) % 2)


def form(channels=2, rate=RATE, bits=16, kind=1):
    return chunk(b"fmt ", struct.pack("<HHIIHH", kind, channels, rate, rate * channels * bits // 8, channels * bits // 8, bits))


def riff(*chunks):
    content = b"WAVE" + b"".join(chunks)
    return b"RIFF" + struct.pack("<I", len(content) & 0xFFFFFFFF) + content


def stamp(seconds, age=1):
    return chunk(b"kiwi", struct.pack("<BBII", age, 0, int(seconds), int(round(seconds % 1 * 1e9))))


class KiwiFiles(InFolder):
    def write(self, content):
        path = self.folder / "kiwi.wav"
        path.write_bytes(content)
        return path

    def samples(self, count=512 * 400):
        rng = np.random.default_rng(1)
        return rng.integers(-3000, 3000, size=(count, 2)).astype("<i2")

    def chunks(self, x, true_rate=12001.25, begins=1000.5, per_chunk=512, gap_at=None, age=1):
        for first in range(0, len(x), per_chunk):
            at = begins + first / true_rate + (2.5 if gap_at is not None and first >= gap_at else 0)
            yield stamp(at % 604800, age)
            yield chunk(b"data", x[first : first + per_chunk].tobytes())

    def test_chunks_are_one_recording(self):
        x = self.samples()
        recording = fl.open(self.write(riff(form(), *self.chunks(x))))
        self.assertTrue(recording.is_complex)
        self.assertEqual(len(recording), len(x))
        expected = (x[:, 0] + 1j * x[:, 1]).astype("c8") / 32768
        self.assertTrue(np.array_equal(recording.read(), expected))
        self.assertTrue(np.array_equal(recording.read(500, 2000), expected[500:2500]))
        self.assertAlmostEqual(recording.rate, 12001.25, delta=1e-3)
        self.assertIn("1000.5 of the GPS week", " ".join(recording.notes))

    def test_chunks_of_many_sizes(self):
        x = self.samples(20000)
        rng = np.random.default_rng(2)
        parts, first = [], 0
        while first < len(x):
            size = int(rng.integers(1, 700))
            parts += [stamp(5 + first / RATE), chunk(b"data", x[first : first + size].tobytes()), chunk(b"LIST", b"odd")]
            first += size
        recording = fl.open(self.write(riff(form(), *parts)))
        self.assertTrue(np.array_equal(recording.read(), (x[:, 0] + 1j * x[:, 1]).astype("c8") / 32768))

    def test_gaps_and_missing_fixes_are_told(self):
        x = self.samples()
        gappy = fl.open(self.write(riff(form(), *self.chunks(x, gap_at=512 * 100))))
        self.assertIn("1 gap(s), 2.5", " ".join(gappy.notes))
        gap = round(2.5 * gappy.rate)
        self.assertEqual(len(gappy), len(x) + gap)
        y = gappy.read()
        self.assertTrue((y[512 * 100 : 512 * 100 + gap] == 0).all())
        expected = (x[:, 0] + 1j * x[:, 1]).astype("c8") / 32768
        self.assertTrue(np.array_equal(np.delete(y, slice(512 * 100, 512 * 100 + gap)), expected))
        seen = fl.detect(gappy, window_seconds=0.25).input
        unseen = np.isnan(seen).all(axis=1)
        self.assertEqual(np.isnan(seen).any(axis=1).tolist(), unseen.tolist())
        self.assertTrue(19 <= unseen.sum() <= 22, unseen.sum())  # 2.5 s, and what reaches into them
        self.assertAlmostEqual(gappy.rate, 12001.25, delta=1e-2)
        blind = fl.open(self.write(riff(form(), *self.chunks(x, age=255))))
        self.assertEqual((blind.rate, blind.notes), (12000.0, []))

    def test_the_end_of_the_week(self):
        recording = fl.open(self.write(riff(form(), *self.chunks(self.samples(), begins=604795.0))))
        self.assertAlmostEqual(recording.rate, 12001.25, delta=1e-3)
        self.assertNotIn("gap", " ".join(recording.notes))

    def test_stamps_that_go_back(self):
        x = self.samples(2048)
        parts = [part for at in (500, 100, 300000, 5) for part in (stamp(at), chunk(b"data", x[:512].tobytes()))]
        self.assertGreaterEqual(len(fl.open(self.write(riff(form(), *parts)))), 2048)

    def test_the_week_from_the_name(self):
        path = self.folder / "20260123T235958Z_7050000_iq.wav"
        path.write_bytes(riff(form(), *self.chunks(self.samples(), begins=518418.25)))  # 2026-01-24T00:00:00Z less GPS - UTC
        self.assertAlmostEqual(fl.open(path).start, 1769212800.25, delta=1e-3)

    def test_a_signal_in_one(self):
        n = np.arange(512 * 600)
        rng = np.random.default_rng(3)
        noise = rng.normal(size=(2, len(n)))
        tone = 0.2 * np.exp(2j * np.pi * 1500 * n / RATE)
        x = np.stack([noise[0] + tone.real, noise[1] + tone.imag], axis=1)
        path = self.write(riff(form(), *self.chunks((2000 * x).astype("<i2"), true_rate=RATE)))
        result = fl.detect(path)
        self.assertTrue(any(abs(event["f"] - 1500) < 5 for event in result.events))
        self.command_line("detect", path, "--events", "c.csv")
        result.save(events=self.folder / "p.csv")
        self.assertEqual((self.folder / "c.csv").read_bytes(), (self.folder / "p.csv").read_bytes())

    def test_hostile_files(self):
        data = chunk(b"data", bytes(2048))
        for name, content, part in (
            ("no rate", riff(form(rate=0), stamp(1), data), "0 Hz"),
            ("three channels", riff(form(channels=3), stamp(1), data), "3 channel(s)"),
            ("float", riff(form(bits=32, kind=3), stamp(1), data), "32 bits"),
            ("no samples", riff(form(), stamp(1)), "without samples"),
            ("nothing but stamps", riff(form(), stamp(1) * 1000), "without samples"),
            ("empty chunks", riff(form(), (stamp(1) + chunk(b"data", b"")) * 1000), "without samples"),
        ):
            with self.subTest(name):
                self.assertIn(part, self.refusal(fl.open, self.write(content)).what)

    def test_lying_lengths_are_read_as_far_as_they_go(self):
        content = riff(form(), stamp(1), chunk(b"data", bytes(2048)), stamp(1 + 512 / RATE)) + b"data" + struct.pack("<I", 2**32 - 2) + bytes(100)
        recording = fl.open(self.write(content))
        self.assertEqual(len(recording), 512 + 25)
        self.assertIn("ends within", " ".join(recording.notes))
        short = fl.open(self.write(riff(form(), chunk(b"kiwi", b"\1"), chunk(b"data", bytes(2048)))))
        self.assertEqual(len(short), 512)


class XwavFiles(InFolder):
    def harp(self, *starts, count=None, length=2 * 1000 * 10):
        head = struct.pack("<B10s4s4s8sB8sHiih8x", 1, b"firmware", b"id", b"site", b"exp", 1, b"disk", len(starts) if count is None else count, 0, 0, 0)
        entries = b"".join(
            struct.pack("<6BHIIIIB7x", *when, ms, 0, length, 0, 1000, 1) for *when, ms in starts
        )
        return chunk(b"harp", head + entries)

    def write(self, harp):
        path = self.folder / "x.wav"
        path.write_bytes(riff(form(channels=1, rate=1000), harp, chunk(b"data", bytes(4 * 1000 * 10))))
        return path

    def test_the_start_and_the_gaps(self):
        recording = fl.open(self.write(self.harp((24, 7, 26, 1, 2, 3, 500), (24, 7, 26, 1, 2, 43, 500))))
        self.assertEqual(recording.start, 1721955723.5)
        self.assertIn("1 gap(s), 30 s", " ".join(recording.notes))
        self.assertEqual(len(recording), 50000)
        self.assertTrue((recording.read(10000, 30000) == 0).all())

    def test_lies(self):
        for harp in (self.harp((24, 13, 40, 1, 2, 3, 0)), self.harp((24, 7, 26, 1, 2, 3, 0), count=65535), chunk(b"harp", b"x" * 50)):
            recording = fl.open(self.write(harp))
            self.assertEqual(len(recording), 20000)


if __name__ == "__main__":
    unittest.main()
