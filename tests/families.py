#!/usr/bin/env python3
"""Gain of families over a line, and of channels over one channel: the SNR at which half of the lines are detected, at one measured false alarm an hour, path unknown:
    python3 tests/families.py CLI [LINES] [HOURS] [WHAT ...]
WHAT: 1, 4, 8, 16 members; 8-1: eight, one of which is missing, a different one for each line; 2c, 4c: one line in two or four channels. The threshold is
the one that HOURS hours of white noise exceed once an hour. LINES lines of 50 s for each SNR, one after the other in different noise, anywhere in 1000 Hz,
slowly drifting. In brackets 90 % of bootstrap samples of the lines. 8-1 uses the noise and lines of 8 without one member. Ghosts are events at another
multiple of the fundamental; other events are at none. The last column is processor time per second of recording. Needs numpy."""
import csv
import os
import subprocess
import sys
import tempfile
import wave

import numpy

RATE = 2000
WINDOW = 1.0
LENGTH = 50.0
APART = 100.0
DRIFT = 0.05  # Hz/s at most, of the highest member
KINDS = {  # multiples, missing teeth, channels, SNRs to try (dB)
    "1": (1, False, 1, [0, 1, 2]),
    "2c": (1, False, 2, [-2, -1, 0]),
    "4c": (1, False, 4, [-4, -3, -2]),
    "4": (4, False, 1, [-4, -3, -2]),
    "8": (8, False, 1, [-6, -5, -4, -3]),
    "8-1": (8, True, 1, [-6, -5, -4, -3]),
    "16": (16, False, 1, [-7.5, -6.5, -5.5]),
}
SOME = "decide.falseAlarmsPerHour=4"
GHOSTS = [1 / 2, 1 / 3, 2 / 3, 3 / 2, 2, 3]


def write(path, samples):
    with wave.open(path, "wb") as file:
        file.setnchannels(samples.shape[1])
        file.setsampwidth(2)
        file.setframerate(RATE)
        file.writeframes(numpy.clip(numpy.round(3000 * samples), -32768, 32767).astype("<i2").tobytes())


def recording(path, teeth, missing, channels, decibels, lines, seed):
    """Writes lines and returns of each its time, frequency and drift (of the fundamental)."""
    random = numpy.random.default_rng([seed, teeth, channels])
    samples = random.standard_normal((int(RATE * (APART * lines + LENGTH)), channels))
    amplitude = numpy.sqrt(4 * 10 ** (decibels / 10) / (RATE * WINDOW))
    t = numpy.arange(int(RATE * LENGTH)) / RATE
    truth = []
    for line in range(lines):
        start = APART * line + random.uniform(20, 45)
        hz, drift = random.uniform(100, 900) / teeth if teeth == 1 else random.uniform(20, 950 / teeth), random.uniform(-DRIFT, DRIFT) / teeth
        first = int(RATE * start)
        left_out = 2 + random.integers(teeth - 1) if teeth > 1 else 0
        for tooth in range(1, teeth + 1):
            for channel in range(channels):
                phase = 2 * numpy.pi * (tooth * (hz * t + drift * t**2 / 2) + random.uniform())
                if not missing or tooth != left_out:
                    samples[first : first + t.size, channel] += amplitude * numpy.sin(phase)
        truth.append((start, hz, drift))
    write(path, samples)
    return truth


def detect(cli, path, teeth, channels, threshold):
    """Events of a recording, and the processor's time it took."""
    command = [cli, "detect", path, "--events", path + ".csv", "--set", f"spectrogram.windowSeconds={WINDOW}", "--set", threshold]
    if teeth > 1:
        command += ["--set", "family.relation=harmonics", "--set", "family.members=" + ",".join(str(k) for k in range(1, teeth + 1))]
    if channels > 1:
        command += ["--set", "selection.channels=all"]
    before = os.times()
    subprocess.run(command, check=True, capture_output=True)
    after = os.times()
    with open(path + ".csv", newline="") as file:
        rows = [{name: float(value) for name, value in row.items() if value} for row in csv.DictReader(file)]
    return rows, after.children_user + after.children_system - before.children_user - before.children_system


def noise(cli, path, teeth, channels, hours):
    """The statistics of all events in noise, some of them an hour, and the processor's time for a second."""
    statistics, spent = [], 0.0
    for hour in range(hours):
        random = numpy.random.default_rng([1000 + hour, teeth, channels])
        write(path, random.standard_normal((3600 * RATE, channels)))
        if hour == 0:
            detect(cli, path, teeth, channels, SOME)  # the calibration is kept
        events, cpu = detect(cli, path, teeth, channels, SOME)
        statistics += [event["statistic"] for event in events]
        spent += cpu
    return sorted(statistics, reverse=True), spent / (3600 * hours)


def outcome(events, truth, teeth):
    """Whether each line was found, how many came with or as a ghost, and how many events are neither."""
    found, ghosts = [], 0
    explained = set()
    for start, hz, drift in truth:
        here = [(i, e) for i, e in enumerate(events) if e["t_onset"] < start + LENGTH and e["t_end"] > start]
        at = lambda e: hz + drift * (min(max(e["t_detect"], start), start + LENGTH) - start)
        hits = [i for i, e in here if abs(e["f"] - at(e)) < 2.5 / WINDOW / teeth]
        wrong = [i for i, e in here if any(abs(e["f"] - r * at(e)) < 2.5 / WINDOW / teeth for r in GHOSTS)] if teeth > 1 else []
        found.append(bool(hits))
        ghosts += bool(wrong)
        explained.update(hits + wrong)
    return found, ghosts, len(events) - len(explained)


def half(decibels, found):
    """SNR at which half are found: the most likely logistic curve through the shares found."""
    at, per = numpy.meshgrid(numpy.linspace(decibels[0] - 1, decibels[-1] + 1, 201), numpy.linspace(0.3, 1.5, 25))
    likelihood = 0.0
    for db, share in zip(decibels, found):
        p = 1 / (1 + numpy.exp(-(db - at) / per))
        likelihood = likelihood + share * numpy.log(p + 1e-12) + (1 - share) * numpy.log(1 - p + 1e-12)
    return at.flat[numpy.argmax(likelihood)]


def spread(decibels, found):
    """The same of 300 bootstrap samples of the lines, the same lines for all that have as many."""
    random = numpy.random.default_rng(1)
    return numpy.array([half(decibels, [f[random.integers(len(f), size=len(f))].mean() for f in found]) for _ in range(300)])


def interval(values):
    return "{:5.2f} … {:5.2f}".format(*numpy.quantile(values, [0.05, 0.95]))


def measure(cli, kind, lines, hours, folder):
    """Prints a kind's row but for its gain; returns its SNR and how that spreads."""
    teeth, missing, channels, tried = KINDS[kind]
    path = os.path.join(folder, "lines.wav")
    statistics, cpu = noise(cli, path, teeth, channels, hours)
    threshold = (statistics[hours - 1] + statistics[hours]) / 2
    found, ghosts, others = [], 0, 0
    for number, decibels in enumerate(tried):
        truth = recording(path, teeth, missing, channels, decibels, lines, number + 1)
        events, _ = detect(cli, path, teeth, channels, f"decide.thresholdNats={threshold}")
        hits, wrong, rest = outcome(events, truth, teeth)
        found.append(numpy.array(hits))
        ghosts, others = ghosts + wrong, others + rest
    told = "  ".join(f"{db:+.1f}: {hits.sum():3d}" for db, hits in zip(tried, found))
    elsewhere = others / (len(tried) * (APART * lines + LENGTH)) * 3600
    at, sample = half(tried, [f.mean() for f in found]), spread(tried, found)
    print(f"{kind:4} {threshold:6.2f} nat, ordered 4: {len(statistics) / hours:4.1f}/h  {told}  {at:6.2f} ({interval(sample)})", end="  ")
    print(f"{ghosts:3} ghosts of {sum(f.sum() for f in found):4}, {elsewhere:4.1f} others/h  {cpu:.5f} s/s", end="  ")
    return at, sample


def main():
    cli = sys.argv[1]
    lines = int(sys.argv[2]) if len(sys.argv) > 2 else 40
    hours = int(sys.argv[3]) if len(sys.argv) > 3 else 20
    results = {}
    with tempfile.TemporaryDirectory() as folder:
        for kind in sys.argv[4:] or KINDS:
            results[kind] = at, sample = measure(cli, kind, lines, hours, folder)
            over = "8" if kind == "8-1" else "1"
            if over in results and over != kind:
                print(f"{results[over][0] - at:+.2f} dB ({interval(results[over][1] - sample)}) over {over}", end="")
            print(flush=True)


if __name__ == "__main__":
    main()
