"""turbo_seti's regression cases, generated from their description: 2²⁰ channels of 1 Hz, 60 frames of 1 s, Gaussian noise; lines of 1 and 2 Hz width at 1.3
and 2.6 Hz/s, of an SNR of 100 and 300, and broad ones at 3.9 Hz/s, too weak, and at ±100 Hz/s, too fast. Frequencies ascend or descend, drifts go up or
down. Then a cadence of six files, of which three are on target.

    python3 tests/bench/narrowband.py build/app/faintline-cli [CHANNELS]
"""

import os
import resource
import struct
import subprocess
import sys
import tempfile
import time

import numpy as np

FRAMES, FIRST, DEVIATION = 60, 8421e6, 0.05


def write(path, channels, lines, descends=False, begins=60000.0, seed=42):
    """lines: (Hz from the lowest channel, Hz/s, width at half the height, SNR over all frames)."""
    def key(name, value=None, code=None):
        out.write(struct.pack("<i", len(name)) + name.encode())
        if code:
            out.write(struct.pack("<" + code, value))

    rng = np.random.default_rng(seed)
    index = np.arange(channels)
    with open(path, "wb") as out:
        key("HEADER_START")
        for name, value in (("nchans", channels), ("nbits", 32), ("nifs", 1), ("data_type", 1)):
            key(name, value, "i")
        first = FIRST + (channels - 1 if descends else 0)
        for name, value in (("fch1", first / 1e6), ("foff", -1e-6 if descends else 1e-6), ("tsamp", 1.0), ("tstart", begins)):
            key(name, value, "d")
        key("HEADER_END")
        for frame in range(FRAMES):
            row = 1.0 + DEVIATION * rng.normal(size=channels)
            for hz, drift, width, snr in lines:
                centre = hz + drift * frame
                near = slice(max(0, int(centre - 4 * width) - 2), max(0, int(centre + 4 * width) + 3))
                sigma = width / (2 * np.sqrt(2 * np.log(2)))
                row[near] += snr * DEVIATION / np.sqrt(FRAMES) * np.exp(-0.5 * ((index[near] - centre) / sigma) ** 2)
            if descends:
                row = row[::-1].copy()
            row[channels // 2] += 3.0  # the receiver's constant
            out.write(row.astype("<f4").tobytes())


def search(cli, path):
    table = path.replace(".fil", ".dat")
    begin = time.monotonic()
    subprocess.run([cli, "--progress", "none", "detect", path, "--preset", "narrowband", "--hits", table, "--least-snr", "50"], check=True)
    with open(table) as lines:
        hits = [[float(word) for word in line.split()] for line in lines if not line.startswith("#")]
    return sorted((hit[3] * 1e6 - FIRST, hit[1], hit[2]) for hit in hits), time.monotonic() - begin


def main():
    cli = os.path.abspath(sys.argv[1])
    channels = int(sys.argv[2]) if len(sys.argv) > 2 else 1 << 20
    step = 1.0 / FRAMES
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for descends in (False, True):
            for sign in (1, -1):
                wanted = [(channels / 5, sign * 1.3, 1.0, 100), (4 * channels / 5, sign * 2.6, 2.0, 300)]
                others = [(channels / 3, sign * 3.9, 40.0, 30), (9 * channels / 16, sign * 100.0, 40.0, 70), (7 * channels / 16, -sign * 100.0, 40.0, 70)]
                write("case.fil", channels, wanted + others, descends)
                hits, seconds = search(cli, "case.fil")
                print(f"descending {descends}, sign {sign:+}: {seconds:.0f} s,", "; ".join(f"{d:+.4f} Hz/s at {hz:.1f} Hz, SNR {snr:.0f}" for hz, d, snr in hits))
                assert len(hits) == 2, hits
                for (hz, drift, snr), (at, injected, width, strength) in zip(hits, wanted):
                    assert abs(drift - injected) <= step and abs(hz - at) <= 1.5, (hz, drift)
        peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss // 1024
        small = min(channels, 1 << 16)
        tables = []
        for i in range(6):
            lines = [(small / 3 + 0.5 * 120 * i, 0.5, 1.0, 100)]  # interference, always there
            if i % 2 == 0:
                lines.append((2 * small / 3 - 0.3 * 120 * i, -0.3, 1.0, 100))
            write(f"{i}.fil", small, lines, begins=60000.0 + 120.0 * i / 86400.0, seed=i)
            search(cli, f"{i}.fil")
            tables.append(f"{i}.dat")
        events = subprocess.run([cli, "cadence", *tables], check=True, capture_output=True, text=True).stdout
        rows = [line.split(",") for line in events.splitlines()[1:]]
        assert len(rows) == 3 and all(abs(float(row[3]) + 0.3) <= step for row in rows), events
        print(f"cadence: the one signal that is on target only, in {len(rows)} observations; at most {peak} MiB")


if __name__ == "__main__":
    main()
