"""Properties of the module besides numbers: settings, errors, arrays without copies, interruption, types, help."""

import _thread
import ast
import gc
import inspect
import json
import os
import pathlib
import pickle
import tempfile
import threading
import time
import unittest

import numpy as np

import faintline as fl
from support import SCENE, InFolder


class Settings(InFolder):
    def test_both_ways_to_name_a_setting(self):
        x = fl.simulate(SCENE)
        one = fl.detect(x, window_seconds=0.5, slope_change=(0.8, 0.1), snr=1).settings
        other = fl.detect(
            x, settings={"spectrogram.windowSeconds": 0.5, "model.slopeChange": np.array([0.8, 0.1]), "model.snr": 1.0}
        ).settings
        self.assertEqual(one, other)

    def test_a_detectors_own_settings_may_come_before_its_kind(self):
        result = fl.detect(fl.simulate(SCENE), window_seconds=0.5, settings={"pOfN.p": 2, "detector.kind": "pOfN"})
        self.assertEqual(result.settings["pOfN.p"], 2)

    def test_refusals_say_what_where_why(self):
        x = fl.simulate(SCENE)
        for keywords, where, why in (
            ({"window_secs": 1}, "window_secs", "unknown setting"),
            ({"kind": "smd", "false_alarms_per_hour": -1}, "decide.falseAlarmsPerHour", "must"),
            ({"settings": {"model.sn": 1}}, "model.sn", "model.snr"),
            ({"window_seconds": "long"}, "spectrogram.windowSeconds", "must"),
            ({"preset": "billons"}, "billons", ""),
            ({"threads": -1}, "threads", "must lie"),
        ):
            with self.subTest(keywords):
                error = self.refusal(fl.detect, x, **keywords)
                self.assertIn(where, error.where)
                self.assertIn(why, error.why)
        self.assertIn("several settings", self.refusal(fl.detect, x, ln_k=0.1).why)
        self.assertEqual(self.refusal(fl.detect, x, window_seconds="long").field, "spectrogram.windowSeconds")
        self.assertEqual(self.refusal(fl.open, "nothing.wav").field, "")

    def test_other_refusals(self):
        self.assertIn("rate", self.refusal(fl.detect, np.zeros(100)).where)
        self.assertIn("nothing.wav", self.refusal(fl.open, self.folder / "nothing.wav").where)
        self.assertIn("holds no samples", self.refusal(fl.Recording, [], 1000).why)
        self.assertIn("must be a sample rate", self.refusal(fl.Recording, [0.0], np.nan).why)
        self.assertIn("lines[0].snrDb", self.refusal(fl.simulate, SCENE | {"lines": [{"snrDb": "loud"}]}).where)
        self.assertIn("not negative", self.refusal(fl.Frames, [[-1.0]]).why)
        self.assertIn("cells there", self.refusal(fl.Frames, [[1.0]], [fl.Axis("f", 2)]).why)
        self.assertIn("kind", self.refusal(fl.evaluate, {"kind": "dreams"}).what)

    def test_an_error_can_be_pickled(self):
        error = self.refusal(fl.open, self.folder / "nothing.wav")
        again = pickle.loads(pickle.dumps(error))
        self.assertEqual((again.where, again.why, again.is_mistake), (error.where, error.why, error.is_mistake))

    def test_describe_and_presets(self):
        rows = {row["name"]: row for row in fl.describe()}
        self.assertEqual(rows["spectrogram.windowSeconds"]["keyword"], "window_seconds")
        self.assertIsNone(rows["smd.lnK"]["keyword"])
        self.assertIn("smd", rows["detector.kind"]["choices"])
        self.assertEqual(rows["spectrogram.windowSeconds"]["label"], "Window length")
        self.assertIn("3 dB", rows["spectrogram.windowSeconds"]["advice"])
        self.assertIn("billon", fl.presets())


class Arrays(InFolder):
    def test_whole_arrays_are_views_of_what_the_result_keeps(self):
        result = fl.detect(fl.simulate(SCENE), window_seconds=0.5)
        statistic = result.statistic
        self.assertTrue(np.shares_memory(statistic, result.statistic))
        self.assertTrue(np.shares_memory(result.input, result.input))
        self.assertFalse(statistic.flags.writeable)
        self.assertEqual(statistic.shape, (result.time.count, result.frequency.count))
        self.assertEqual(result.input.shape, statistic.shape)
        expected = statistic.copy()
        del result
        gc.collect()
        self.assertTrue(np.array_equal(statistic, expected))  # the view keeps its buffer

    def test_tracks(self):
        result = fl.detect(fl.simulate(SCENE), window_seconds=0.5)
        track = max(result.tracks, key=len)
        del result
        gc.collect()
        self.assertEqual(len(track.t), len(track.f))
        self.assertTrue((track.f05 <= track.f95).all())
        self.assertTrue((abs(track.f - (track.f05 + track.f95) / 2) < 2.0).all())
        self.assertTrue((track.p_present >= 0).all() and (track.p_present <= 1).all())
        self.assertEqual(track.position.shape, (len(track), 1))
        middle = track.f[np.searchsorted(track.t, 15.0)]
        self.assertAlmostEqual(middle, 210 + 0.2 * 7, delta=1.0)

    def test_subtracted_events_are_told(self):
        line = SCENE["lines"][0] | {"durationSeconds": 20, "driftHzPerSecond": 0.0}
        strong, weak = line | {"snrDb": 30, "startSeconds": 5}, line | {"frequencyHz": 230}
        x = fl.simulate(SCENE | {"lines": [strong, weak]})
        events = fl.detect(x, window_seconds=0.5, settings={"subtract.lines": True}).events
        self.assertEqual(
            [(round(float(event["f"])), bool(event["subtracted"])) for event in sorted(events, key=lambda e: e["f"])],
            [(210, True), (230, False)],
        )
        self.assertNotIn("subtracted", fl.detect(x, window_seconds=0.5).events.dtype.names)

    def test_explain(self):
        result = fl.detect(fl.simulate(SCENE), window_seconds=0.5)
        event = result.events[np.argmax(result.events["statistic"])]
        explanation = result.explain(event["t_detect"], event["f"])
        steps = explanation.steps
        self.assertAlmostEqual(steps["sum"][-1] + explanation.offset, explanation.statistic, delta=1e-6)
        self.assertAlmostEqual((steps["llr"] + steps["ln_transition"] + steps["ln_k"]).sum(), steps["sum"][-1], delta=1e-6)
        self.refusal(result.explain, 1e6, 100.0)
        self.refusal(result.explain, 1.0)

    def test_explain_tells_what_the_noise_explains(self):
        # A tone of one window a second, anywhere, and one line that lasts.
        rng = np.random.default_rng(8)
        rate, seconds, length = 400, 600, 80
        x = rng.normal(0, 0.1, rate * seconds)
        starts = rate * np.arange(seconds) + rng.integers(0, 300, seconds)
        pitches = rng.uniform(0, 200, seconds)
        for start, hz in zip(starts, pitches):
            x[start : start + length] += 0.1 * np.sin(2 * np.pi * hz * np.arange(length) / rate)
        lasting = np.arange(100 * rate, 200 * rate)
        x[lasting] += 0.05 * np.sin(2 * np.pi * 60 * lasting / rate)
        result = fl.detect(x, rate, window_seconds=0.25, false_alarms_per_hour=60)
        line = result.events[np.argmax(result.events["statistic"])]
        self.assertLess(abs(line["f"] - 60), 3)
        self.assertIs(result.explain(line["t_detect"], line["f"]).is_explained_by_noise, False)
        explained = [
            (start / rate, hz)
            for start, hz in zip(starts[:80], pitches[:80])
            if result.explain((start + length / 2) / rate, hz).is_explained_by_noise
        ]
        self.assertGreater(len(explained), 3)
        for t, hz in explained:  # and what is explained is not reported
            near = (abs(result.events["t_detect"] - t) < 0.5) & (abs(result.events["f"] - hz) < 4)
            self.assertFalse(near.any())

    def test_areas_are_those_of_the_json(self):
        rng = np.random.default_rng(5)
        t = np.arange(120 * 400) / 400
        x = rng.normal(size=len(t))
        burst = (t >= 50) & (t < 60)
        for hz, phase in zip(rng.uniform(80, 120, 400), rng.uniform(0, 2 * np.pi, 400)):
            x[burst] += 0.1 * np.cos(2 * np.pi * hz * t[burst] + phase)
        result = fl.detect(x, 400, window_seconds=0.25)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "e.json")
            result.save(events=path)
            with open(path) as file:
                areas = json.load(file)["areas"]
        self.assertGreater(len(areas), 0)
        names = result.areas.dtype.names
        self.assertEqual([tuple(area[name] for name in names) for area in areas], result.areas.tolist())

    def test_samples_of_any_kind(self):
        x = fl.simulate(SCENE).read()
        single = fl.Recording(x, 1000)
        self.assertTrue(np.array_equal(single.read(10, 20), x[10:30]))
        self.assertTrue(np.array_equal(fl.Recording(x.astype("f8"), 1000).read(), x))
        whole = np.round(x * 32767).astype("i2")
        self.assertTrue(np.array_equal(fl.Recording(whole, 1000).read(), whole.astype("f4") / 32768))
        both = fl.Recording(np.stack([x, -x], axis=1), 1000)
        self.assertEqual((both.channels, len(both)), (2, len(x)))
        self.assertTrue(np.array_equal(both.read(channel=1), -x))
        iq = fl.Recording(x + 1j * x, 1000, centre_hz=1e6)
        self.assertTrue(iq.is_complex and iq.read(5, 1)[0] == np.complex64(x[5] + 1j * x[5]))
        self.refusal(both.read, channel=2)


class LongCalls(InFolder):
    LONG = SCENE | {"durationSeconds": 7200, "sampleRateHz": 8000}

    def test_progress(self):
        seen = []
        fl.detect(fl.simulate(SCENE | {"durationSeconds": 300}), progress=lambda fraction, what: seen.append((fraction, what)))
        self.assertTrue(all(0 <= fraction <= 1 and what for fraction, what in seen))

    def test_what_progress_raises_stops_the_call(self):
        def refuse(fraction, what):
            raise RuntimeError("enough")

        began = time.monotonic()
        with self.assertRaisesRegex(RuntimeError, "enough"):
            fl.detect(fl.simulate(self.LONG), progress=refuse)
        self.assertLess(time.monotonic() - began, 30)

    def test_ctrl_c(self):
        latencies = []
        for after in (0.3, 1.5, 4.0):
            pressed = []

            def press():
                pressed.append(time.monotonic())
                _thread.interrupt_main()

            timer = threading.Timer(after, press)
            timer.start()
            with self.assertRaises(KeyboardInterrupt):
                fl.detect(fl.simulate(self.LONG))
            latencies.append(time.monotonic() - pressed[0])
            timer.join()
        print("seconds from Ctrl+C to KeyboardInterrupt:", *(f"{each:.2f}" for each in latencies))
        self.assertLess(max(latencies), 5)  # below 1 on a machine that does nothing else

    def test_other_threads_run_meanwhile(self):
        count, over = [0], threading.Event()

        def tick():
            while not over.is_set():
                count[0] += 1
                time.sleep(0.01)

        ticking = threading.Thread(target=tick)
        ticking.start()
        began = time.monotonic()
        fl.viterbi(np.random.default_rng(1).normal(size=(20000, 500)), {"rates": [-1, 0, 1], "rateChange": [0.8, 0.1]})
        seconds = time.monotonic() - began
        over.set()
        ticking.join()
        self.assertGreater(count[0], 10 * seconds)


class Types(unittest.TestCase):
    STUB = pathlib.Path(fl.__file__).with_suffix(".pyi")

    def setUp(self):
        tree = ast.parse(self.STUB.read_text())
        self.functions = {n.name: n for n in tree.body if isinstance(n, ast.FunctionDef)}
        self.classes = {n.name: n for n in tree.body if isinstance(n, ast.ClassDef)}

    def test_all_names_are_typed(self):
        self.assertEqual({*self.functions, *self.classes, "Error"}, set(fl.__all__))
        self.assertTrue(self.STUB.with_name("py.typed").exists())

    def test_members_are_those_of_the_classes(self):
        for name, node in self.classes.items():
            typed = {n.name for n in node.body} - {"__init__"}
            real = {n for n in vars(getattr(fl, name)) if not n.startswith("_") or n == "__len__"}
            self.assertEqual(typed, real, name)

    def test_arguments_are_those_of_the_functions(self):
        for name, node in self.functions.items():
            line = inspect.getdoc(getattr(fl, name)).splitlines()[0]
            arguments = [a.arg for a in [*node.args.args, *node.args.kwonlyargs]]
            for argument in arguments if name != "open" else ["path"]:
                self.assertIn(f"{argument}:", line, name)

    def test_everything_has_help(self):
        for name in fl.__all__:
            self.assertTrue(inspect.getdoc(getattr(fl, name)), name)


if __name__ == "__main__":
    unittest.main()
