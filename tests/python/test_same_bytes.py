"""The same bytes from the module as from the command line."""

import json
import unittest

import numpy as np

import faintline as fl
from support import SCENE, InFolder

WINDOW = ("--set", "spectrogram.windowSeconds=0.5", "--set", "decide.falseAlarmsPerHour=2")


class SameBytes(InFolder):
    def setUp(self):
        super().setUp()
        (self.folder / "scene.json").write_text(json.dumps(SCENE))
        self.command_line("simulate", "scene.json", "--out", "line.wav")
        self.wav = self.folder / "line.wav"

    def events_of_command_line(self, *arguments):
        self.command_line(
            "detect", "line.wav", *arguments, "--events", "c.csv", "--tracks", "ct.csv", "--statistic", "c.npy"
        )

    def assert_same_files(self, result):
        result.save(
            events=self.folder / "p.csv", tracks=self.folder / "pt.csv", statistic=self.folder / "p.npy"
        )
        for one, other in (("c.csv", "p.csv"), ("ct.csv", "pt.csv"), ("c.npy", "p.npy")):
            self.assertEqual((self.folder / one).read_bytes(), (self.folder / other).read_bytes(), one)
        self.assertGreater(len(result.events), 0)

    def test_a_given_window(self):
        self.events_of_command_line(*WINDOW)
        self.assert_same_files(fl.detect(self.wav, window_seconds=0.5, false_alarms_per_hour=2))

    def test_the_window_that_the_recording_chooses(self):
        self.events_of_command_line()
        result = fl.detect(fl.open(self.wav))
        self.assertIsInstance(result.window_choice, str)
        self.assert_same_files(result)

    def test_what_is_saved_can_be_replayed(self):
        for number, keywords in enumerate(
            ({}, {"window_seconds": 0.5, "false_alarms_per_hour": 2}, {"preset": "whistles"}, {"settings": {"detector.kind": "pOfN", "pOfN.n": 5}})
        ):
            name = f"r{number}.csv"
            fl.detect(self.wav, **keywords).save(events=self.folder / name)
            self.assertIn("the same bytes", self.command_line("replay", name), keywords)
        fl.detect(fl.open(self.wav).read(), 1000).save(events=self.folder / "memory.csv")
        self.assertFalse((self.folder / "memory.csv.provenance.json").exists())

    def test_samples_in_memory(self):
        self.events_of_command_line(*WINDOW)
        x = fl.open(self.wav).read()
        self.assert_same_files(fl.detect(x, 1000, window_seconds=0.5, false_alarms_per_hour=2, threads=1))

    def test_a_preset(self):
        self.events_of_command_line("--preset", "billon", *WINDOW)
        settings = {"spectrogram.windowSeconds": 0.5, "decide.falseAlarmsPerHour": 2}
        self.assert_same_files(fl.detect(self.wav, preset="billon", settings=settings))

    def test_a_preset_of_a_slow_recording(self):
        """Once in two seconds for 20 hours: one false alarm in that time, not twenty."""
        x = np.random.default_rng(3).standard_normal(36000) + np.cos(2 * np.pi * 0.2 * np.arange(36000))
        x.astype("<f4").tofile(self.folder / "slow.sigmf-data")
        meta = {"core:datatype": "rf32_le", "core:sample_rate": 0.5, "core:version": "1.0.0"}
        (self.folder / "slow.sigmf-meta").write_text(
            json.dumps({"global": meta, "captures": [{"core:sample_start": 0}], "annotations": []})
        )
        options = ("--preset", "steady", "--set", "spectrogram.windowSeconds=200")
        files = ("--events", "c.csv", "--tracks", "ct.csv", "--statistic", "c.npy")
        self.command_line("detect", "slow.sigmf-meta", *options, *files)
        result = fl.detect(self.folder / "slow.sigmf-meta", preset="steady", window_seconds=200)
        self.assert_same_files(result)
        self.assertAlmostEqual(result.false_alarms_per_hour, 0.05, delta=0.005)

    def test_a_simulated_recording_is_what_the_command_line_simulates(self):
        recording = fl.simulate(SCENE)
        recording.save(self.folder / "python.wav")
        self.assertEqual((self.folder / "python.wav").read_bytes(), self.wav.read_bytes())

    def test_arrays_are_what_is_written(self):
        self.events_of_command_line(*WINDOW)
        result = fl.detect(self.wav, window_seconds=0.5, false_alarms_per_hour=2)
        self.assertTrue(np.array_equal(result.statistic, np.load(self.folder / "c.npy")))
        table = np.genfromtxt(self.folder / "c.csv", delimiter=",", names=True, ndmin=1)
        self.assertEqual(result.events.dtype.names, table.dtype.names)
        for name in table.dtype.names:
            self.assertTrue(np.array_equal(result.events[name].astype(float), table[name]), name)

    def test_models_of_a_bank(self):
        scene = {"kind": "pings", "pings": 20, "targets": [{"snrDb": 12, "rangeMetres": 5000, "bearingDegrees": 10}]}
        (self.folder / "pings.json").write_text(json.dumps(scene))
        self.command_line("detect", "pings.json", "--preset", "sonarBank", "--events", "c.csv")
        lines = [line.split(",") for line in (self.folder / "c.csv").read_text().splitlines()]
        events = fl.detect(fl.simulate(scene), preset="sonarBank").events
        self.assertEqual(list(events.dtype.names), lines[0])
        self.assertGreater(len(events), 0)
        for name in ("model", "model_changes"):
            self.assertEqual(list(events[name]), [line[lines[0].index(name)] for line in lines[1:]])

    def test_pings_and_stacks(self):
        scene = {"kind": "pings", "pings": 20, "targets": [{"snrDb": 12, "rangeMetres": 5000, "bearingDegrees": 10}]}
        (self.folder / "pings.json").write_text(json.dumps(scene))
        self.command_line("simulate", "pings.json", "--out", "pings.npy")
        self.command_line("detect", "pings.json", "--events", "c.csv")
        fl.detect(fl.simulate(scene)).save(events=self.folder / "p.csv")
        self.assertEqual((self.folder / "c.csv").read_bytes(), (self.folder / "p.csv").read_bytes())
        frames = fl.open(self.folder / "pings.npy")
        self.assertEqual([axis.name for axis in frames.axes], [axis.name for axis in fl.simulate(scene).axes])
        self.assertTrue(np.array_equal(frames.read(), fl.simulate(scene).read()))

    def test_an_experiment(self):
        experiment = {"kind": "lines", "seed": 1, "runs": 4, "frames": 200, "blockFrames": 50, "durationWindows": 20,
                      "snrDb": [0, 6], "detectors": [{"name": "3 of 4", "settings": {"detector.kind": "pOfN"}}]}
        (self.folder / "experiment.json").write_text(json.dumps(experiment))
        self.command_line("evaluate", "experiment.json", "--out", "c.csv")
        table = fl.evaluate(experiment, out=self.folder / "p.csv")
        self.assertEqual((self.folder / "c.csv").read_bytes(), (self.folder / "p.csv").read_bytes())
        self.assertEqual(list(table["snr_db"]), [0.0, 6.0])
        np.testing.assert_equal(fl.evaluate(experiment).tolist(), table.tolist())


if __name__ == "__main__":
    unittest.main()
