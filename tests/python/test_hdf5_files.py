"""HDF5 files: filterbanks packed in every way, strain, and hostile files."""

import importlib.util
import os
import sys

MISSING = [name for name in ("h5py",) if importlib.util.find_spec(name) is None]
if MISSING:
    print("skipped: not installed:", *MISSING, "(Debian: python3-h5py bitshuffle)")
    sys.exit(77)

import subprocess
import unittest

import h5py
import numpy as np

import faintline as fl
from support import InFolder
from test_power_files import drifting_line, header

BITSHUFFLE = 32008
AXES = {"fch1": 1420.0, "foff": -1e-5, "tsamp": 1.0, "tstart": 60000.0}


def has_bitshuffle():
    try:
        import bitshuffle.h5  # which registers the filter with h5py's library

        return bitshuffle is not None
    except ImportError:
        return False


class RecordedPings(InFolder):
    """A dataset "pings", as in a .npy file of the same numbers."""

    def noisy_iq(self):
        rng = np.random.default_rng(5)
        fall = 3e3 * 10 ** (-2 * np.arange(60) / 60)
        iq = rng.normal(size=(48, 60, 8, 2)) * fall[:, None, None]
        for ping in range(8, 48):
            iq[ping, ping, 3] += 4 * fall[ping]
        return np.round(iq).astype("i2")

    def test_the_same_as_from_a_npy_file(self):
        iq = self.noisy_iq()
        asked = {"preset": "sonar", "threshold_nats": 20}
        np.save(self.folder / "a.npy", iq[..., 0].astype("f4") + 1j * iq[..., 1].astype("f4"))
        expected = fl.detect(self.folder / "a.npy", **asked)
        self.assertGreater(len(expected.events), 0)
        pair = np.dtype([("r", "f4"), ("i", "f4")])
        values = np.zeros(iq.shape[:3], pair)
        values["r"], values["i"] = iq[..., 0], iq[..., 1]
        for name, how in {"a": {}, "b": {"chunks": (1, 60, 8), "compression": "gzip"}}.items():
            with h5py.File(self.folder / f"{name}.h5", "w") as file:
                file.create_dataset("pings", data=values, **how)
            result = fl.detect(self.folder / f"{name}.h5", **asked)
            np.testing.assert_equal(result.events.tolist(), expected.events.tolist())

    def test_integers_and_their_grid(self):
        iq = self.noisy_iq()
        magnitude = np.round(np.hypot(iq[..., 0].astype("f8"), iq[..., 1])).astype("u2")
        grid = """{"axes": [{"name": "range", "unit": "m", "step": 2}, {"name": "bearing"}],
                   "time": {"step": 5}, "values": "magnitude"}"""
        np.save(self.folder / "m.npy", magnitude)
        with h5py.File(self.folder / "n.h5", "w") as file:
            file.create_dataset("pings", data=magnitude)
        for name in "mn":
            (self.folder / f"{name}.grid.json").write_text(grid)
        frames = [fl.open(self.folder / name) for name in ("m.npy", "n.h5")]
        self.assertEqual(frames[1].axes[0].step, 2)
        np.testing.assert_array_equal(frames[0].read(), frames[1].read())
        self.assertAlmostEqual(float(np.median(frames[1].read())) / np.log(2), 1.0, delta=0.05)
        asked = {"preset": "sonar", "threshold_nats": 20}
        as_stated = fl.detect(self.folder / "n.h5", **asked)
        as_power = fl.detect(self.folder / "n.h5", values="power", **asked)
        self.assertNotEqual(as_stated.events.tolist(), as_power.events.tolist())


class Hdf5Filterbanks(InFolder):
    written = 0

    def write(self, values, attributes=AXES, **how):
        self.written += 1
        path = self.folder / f"x{self.written}.h5"
        with h5py.File(path, "w") as file:
            data = file.create_dataset("data", data=values, **how)
            data.attrs.update(attributes)
        return path

    def values(self):
        return drifting_line()[:, None, ::-1].astype("f4")

    def test_the_same_as_from_a_fil_file(self):
        values = self.values()
        fil = self.folder / "x.fil"
        fil.write_bytes(header() + values.tobytes())
        expected = fl.detect(fil)
        self.assertGreater(len(expected.events), 0)
        packings = {
            "as it is": {},
            "chunks": {"chunks": (16, 1, 40)},
            "deflate": {"chunks": (16, 1, 64), "compression": "gzip", "shuffle": True},
        }
        for name, how in packings.items():
            with self.subTest(name):
                path = self.write(values, **how)
                result = fl.detect(path)
                np.testing.assert_equal(result.events.tolist(), expected.events.tolist())
        self.command_line("detect", path, "--events", "c.csv")
        expected.save(events=self.folder / "p.csv")
        self.assertEqual((self.folder / "c.csv").read_bytes(), (self.folder / "p.csv").read_bytes())

    @unittest.skipUnless(has_bitshuffle(), "Debian: bitshuffle")
    def test_bitshuffle(self):
        rng = np.random.default_rng(1)
        for kind in ("f4", "u1", "<u2", "f8"):
            for lz4 in (0, 2):
                for chunk in ((16, 1, 64), (7, 1, 61), (300, 1, 1)):
                    with self.subTest(kind=kind, lz4=lz4, chunk=chunk):
                        values = (rng.gamma(10, size=(300, 1, 64)) * 10).astype(kind)
                        path = self.write(values, chunks=chunk, compression=BITSHUFFLE, compression_opts=(0, lz4))
                        plain = self.write(values)
                        self.assertTrue(np.array_equal(fl.open(path).read(), fl.open(plain).read()))

    def test_hostile_files(self):
        other = self.folder / "other.h5"
        with h5py.File(other, "w") as file:
            file.create_dataset("data", data=self.values()).attrs.update(AXES)
        (self.folder / "raw").write_bytes(bytes(64 * 64 * 4))

        def linked(file):
            file["data"] = h5py.ExternalLink(str(other), "/data")

        def soft(file):
            file.create_dataset("real", data=self.values()).attrs.update(AXES)
            file["data"] = h5py.SoftLink("/real")

        def outside(file):
            data = file.create_dataset("data", (64, 1, 64), "f4", external=[(str(self.folder / "raw"), 0, h5py.h5f.UNLIMITED)])
            data.attrs.update(AXES)

        def virtual(file):
            layout = h5py.VirtualLayout((300, 1, 64), "f4")
            layout[:] = h5py.VirtualSource(str(other), "data", (300, 1, 64))
            file.create_virtual_dataset("data", layout).attrs.update(AXES)

        def bomb(file):
            data = file.create_dataset("data", (2**20, 1, 2**14), "f4", chunks=(2**14, 1, 2**14), compression="gzip")
            data.attrs.update(AXES)

        def enormous(file):
            file.create_dataset("data", (2**40, 1, 2**20), "f4", chunks=(1, 1, 2**20)).attrs.update(AXES)

        def texts(file):
            file.create_dataset("data", data=np.array([["a"]], "S5")).attrs.update(AXES)

        def flat(file):
            file.create_dataset("data", data=np.ones((10, 10), "f4")).attrs.update(AXES)

        def group(file):
            file.create_group("data").attrs.update(AXES)

        def empty(file):
            file.create_dataset("data", (0, 1, 64), "f4").attrs.update(AXES)

        def attributes(**changed):
            def make(file):
                file.create_dataset("data", data=self.values()).attrs.update(AXES | changed)

            return make

        hostile = {
            linked: "soft or external link",
            soft: "soft or external link",
            outside: "other files",
            virtual: "virtual dataset",
            bomb: "64 MiB",
            enormous: "almost none of them",
            texts: "not hold numbers",
            flat: "frames, polarisations and channels",
            group: "not a dataset",
            empty: "no values",
            attributes(fch1=np.nan): "fch1",
            attributes(foff=np.inf): "foff",
            attributes(foff=0.0): "foff",
            attributes(tsamp=-1.0): "tsamp",
            attributes(tsamp="soon"): "tsamp",
            attributes(fch1=[1.0, 2.0]): "unsupported kind",
            (lambda file: None): "unsupported kind",
        }
        for number, (make, part) in enumerate(hostile.items()):
            with self.subTest(part):
                path = self.folder / f"hostile{number}.h5"
                with h5py.File(path, "w") as file:
                    make(file)
                self.assertIn(part, self.refusal(fl.open, path).what)

    def test_chunks_that_lie_across(self):
        """A frame is in all chunks: they are kept where they fit, or it is said that each would take them all."""
        path = self.folder / "across.h5"
        for frames in (2**16, 2**18):
            with h5py.File(path, "w") as file:
                data = file.create_dataset("data", (frames, 1, 256), "f4", chunks=(frames, 1, 32), compression="gzip")
                for channel in range(0, 256 if frames == 2**16 else 0, 32):  # a chunk at a time
                    data[:, :, channel : channel + 32] = 1.0
                data.attrs.update(AXES)
            if frames == 2**16:
                self.assertEqual(fl.open(path).shape, (frames, 256))
            else:
                self.assertLess(path.stat().st_size, 1_000_000)
                self.assertIn("narrower band", self.refusal(fl.open, path).what)

    def test_damaged_files(self):
        made = self.write(self.values(), chunks=(16, 1, 64), compression="gzip")
        path = self.folder / "broken.h5"
        whole = made.read_bytes()
        path.write_bytes(whole[:3000])
        self.assertIn("truncated", self.refusal(fl.open, path).why)
        rng = np.random.default_rng(4)
        for _ in range(200):  # one line each, whatever it is, or it was no harm
            broken = bytearray(whole)
            for at in rng.integers(8, len(whole), size=6):
                broken[at] = rng.integers(256)
            path.write_bytes(broken)
            try:
                fl.open(path).read(0, 10)
            except fl.Error as error:
                self.assertNotIn("\n", str(error))

    def test_no_plug_in_is_loaded(self):
        folder = self.folder / "plugins"
        folder.mkdir()
        (folder / "evil.c").write_text(
            '#include <stdio.h>\n__attribute__((constructor)) static void run(void) { fopen("%s/loaded", "w"); }\n' % self.folder
        )
        subprocess.run(["cc", "-shared", "-fPIC", "-o", folder / "libevil.so", folder / "evil.c"], check=True)
        path = self.folder / "x.h5"
        with h5py.File(path, "w") as file:  # a filter that nobody has, so that the library would look for one
            plan = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
            plan.set_chunk((16, 1, 64))
            plan.set_filter(31999, h5py.h5z.FLAG_OPTIONAL, ())
            space = h5py.h5s.create_simple((64, 1, 64))
            data = h5py.Dataset(h5py.h5d.create(file.id, b"data", h5py.h5t.NATIVE_FLOAT, space, plan))
            data.attrs.update(AXES)
        done = subprocess.run(
            [os.environ["FAINTLINE_CLI"], "info", path],
            env=os.environ | {"HDF5_PLUGIN_PATH": str(folder)},
            capture_output=True,
            text=True,
        )
        self.assertIn("filter 31999", done.stderr)
        self.assertEqual(done.returncode, 2)
        self.assertFalse((self.folder / "loaded").exists())


class Strain(InFolder):
    written = 0

    def write(self, strain, **attributes):
        self.written += 1
        path = self.folder / f"H-H1_GWOSC_4KHZ_R1-1126257415-32.{self.written}.hdf5"
        with h5py.File(path, "w") as file:
            data = file.create_dataset("strain/Strain", data=strain, compression="gzip")
            data.attrs.update({"Npoints": len(strain), "Xspacing": 1 / 4096, "Xstart": 1126257415, "Xunits": "second"} | attributes)
            file["meta/Detector"] = "H1"
        return path

    def strain(self, seconds=32):
        n = np.arange(4096 * seconds)
        rng = np.random.default_rng(1)
        return 1e-21 * (rng.normal(size=len(n)) + 0.2 * np.sin(2 * np.pi * 331.5 * n / 4096))

    def test_a_line_in_strain(self):
        x = self.strain()
        recording = fl.open(self.write(x))
        self.assertEqual((recording.rate, len(recording)), (4096.0, len(x)))
        self.assertEqual(recording.start, 1442222198.0)  # 2015-09-14T09:16:38Z
        self.assertTrue(np.array_equal(recording.read(1000, 50), x[1000:1050].astype("f4")))
        result = fl.detect(recording)
        self.assertTrue(any(abs(event["f"] - 331.5) < 2 for event in result.events))
        np.testing.assert_equal(fl.detect(x, 4096).events.tolist(), result.events.tolist())

    def test_seconds_without_data(self):
        x = self.strain(4)
        x[4096:8192] = np.nan
        self.assertTrue((fl.open(self.write(x)).read(4096, 4096) == 0).all())

    def test_seconds_that_were_not_taken(self):
        for mask, unseen in (([1, 0, 1, 3], 1.0), ([0, 2, 1, 1], 2.0), ([1, 1, 1, 1], 0.0)):
            path = self.write(self.strain(4))
            with h5py.File(path, "r+") as file:
                file.create_dataset("quality/simple/DQmask", data=np.array(mask, "u4"))
            recording = fl.open(path)
            self.assertEqual(any("not observed" in note for note in recording.notes), unseen > 0, mask)
            seen = fl.detect(recording, window_seconds=0.25).input
            torn = np.isnan(seen).all(axis=1).sum() * 0.125
            self.assertTrue(abs(torn - unseen) <= 0.3, (mask, torn))
        for lie in (np.ones(3, "u4"), np.ones((2, 2), "u4"), np.full(4, np.nan)):
            path = self.write(self.strain(4))
            with h5py.File(path, "r+") as file:
                file.create_dataset("quality/simple/DQmask", data=lie)
            self.assertEqual(fl.open(path).notes, [])

    def test_hostile_files(self):
        for attributes in ({"Xspacing": 0.0}, {"Xspacing": np.nan}, {"Xspacing": -1.0}, {"Xspacing": "fast"}):
            with self.subTest(attributes):
                self.assertIn("Xspacing", self.refusal(fl.open, self.write(self.strain(1), **attributes)).what)
        path = self.folder / "matrix.hdf5"
        with h5py.File(path, "w") as file:
            file.create_dataset("strain/Strain", data=np.ones((3, 3)))
        self.assertIn("one number per sample", self.refusal(fl.open, path).what)
        path = self.folder / "linked.hdf5"
        with h5py.File(path, "w") as file:
            file["strain"] = h5py.ExternalLink("/etc/passwd", "/")
        self.assertIn("soft or external link", self.refusal(fl.open, path).what)


if __name__ == "__main__":
    unittest.main()
