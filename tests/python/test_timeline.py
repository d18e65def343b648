"""Many files as one recording, opened in every way."""

import json
import unittest
import wave

import numpy as np

import faintline as fl
from support import InFolder

RATE = 1000


class Timeline(InFolder):
    def setUp(self):
        super().setUp()
        rng = np.random.default_rng(4)
        t = np.arange(120 * RATE) / RATE
        self.x = (3000 * (rng.normal(size=len(t)) + 0.2 * np.cos(2 * np.pi * (210 * t + 0.05 * t * t)))).astype("<i2")
        self.write("whole.wav", self.x)
        (self.folder / "parts").mkdir()
        for i in range(4):
            self.write(f"parts/site_20260101_00{i // 2:02}{i % 2 * 30:02}.wav", self.x[30 * RATE * i : 30 * RATE * (i + 1)])

    def write(self, name, samples):
        with wave.open(str(self.folder / name), "wb") as out:
            out.setparams((1, 2, RATE, 0, "NONE", ""))
            out.writeframes(samples.tobytes())

    def events(self, *arguments):
        self.command_line("detect", *arguments, "--events", "e.csv")
        return (self.folder / "e.csv").read_bytes()

    def test_the_same_bytes_as_of_one_file(self):
        expected = self.events("whole.wav")
        self.assertGreater(expected.count(b"\n"), 1)
        names = sorted(path.relative_to(self.folder) for path in (self.folder / "parts").iterdir())
        (self.folder / "list.timeline").write_text("# in no order\n" + "".join(f"{name}\n" for name in reversed(names)))
        self.assertEqual(self.events("parts"), expected)
        self.assertEqual(self.events("list.timeline"), expected)
        self.assertEqual(self.events(names[2], names[0], names[3], names[1], "--timeline"), expected)
        for opened in (fl.open(self.folder / "parts"), fl.open([self.folder / name for name in reversed(names)])):
            self.assertEqual((opened.rate, opened.start), (RATE, 1767225600.0))
            self.assertTrue(np.array_equal(opened.read(), fl.open(self.folder / "whole.wav").read()))
            fl.detect(opened).save(events=self.folder / "p.csv")
            self.assertEqual((self.folder / "p.csv").read_bytes(), expected)

    def test_its_provenance_replays(self):
        self.command_line("detect", "parts", "--events", "e.csv")
        inputs = json.loads((self.folder / "e.csv.provenance.json").read_text())["inputs"]
        self.assertEqual(len(inputs), 4)
        self.assertIn("the same bytes", self.command_line("replay", "e.csv"))

    def test_a_file_that_is_missing_is_not_observed(self):
        (self.folder / "parts/site_20260101_000030.wav").unlink()
        result = fl.detect(self.folder / "parts", window_seconds=1)
        unseen = np.isnan(result.input).all(axis=1)
        self.assertTrue(60 <= unseen.sum() <= 63)
        self.assertEqual(len(result.events), 1)
        self.assertLess(result.events[0]["t_onset"], 10)
        self.assertGreater(result.events[0]["t_end"], 110)

    def test_refusals(self):
        self.assertIn("empty list", self.refusal(fl.open, []).what)
        self.write("parts/site_20260101_000010.wav", self.x[:100])
        self.assertIn("lies within the time of", self.refusal(fl.open, self.folder / "parts").what)
        self.write("parts/no time.wav", self.x)
        self.assertIn("has no time stamp", self.refusal(fl.open, self.folder / "parts").what)


if __name__ == "__main__":
    unittest.main()
