#!/usr/bin/env python3
"""What a family gains over a line, and channels over a channel: SNR of half of the detections at one false alarm an hour, path unknown:
    python3 tests/families.py CLI [LINES] [WHAT ...]
WHAT: 1, 4, 8, 16 teeth; 8-1: eight of which one is missing, another for every line; 2c: one line in two channels; 4c. Needs numpy. LINES lines of
50 s, one after the other in white noise, anywhere in 1000 Hz, slowly drifting. Ghosts are events at another multiple of the fundamental. The last column is
the time of a processor for a second of recording."""
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
    "1": (1, False, 1, [-1, 0, 1, 2, 3]),
    "2c": (1, False, 2, [-3, -2, -1, 0, 1]),
    "4c": (1, False, 4, [-5, -4, -3, -2, -1]),
    "4": (4, False, 1, [-5, -4, -3, -2, -1]),
    "8": (8, False, 1, [-7, -6, -5, -4, -3]),
    "8-1": (8, True, 1, [-7, -6, -5, -4, -3]),
    "16": (16, False, 1, [-8, -7, -6, -5, -4]),
}
GHOSTS = [1 / 2, 1 / 3, 2 / 3, 3 / 2, 2, 3]


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
        left_out = 2 + random.integers(teeth - 1) if missing else 0
        for tooth in range(1, teeth + 1):
            if tooth == left_out:
                continue
            for channel in range(channels):
                phase = 2 * numpy.pi * (tooth * (hz * t + drift * t**2 / 2) + random.uniform())
                samples[first : first + t.size, channel] += amplitude * numpy.sin(phase)
        truth.append((start, hz, drift))
    with wave.open(path, "wb") as file:
        file.setnchannels(channels)
        file.setsampwidth(2)
        file.setframerate(RATE)
        file.writeframes(numpy.clip(numpy.round(3000 * samples), -32768, 32767).astype("<i2").tobytes())
    return truth


def detect(cli, path, teeth, channels, order):
    """Events of a recording, and the processor's time it took."""
    command = [cli, "detect", path, "--events", path + ".csv", "--set", f"spectrogram.windowSeconds={WINDOW}"]
    command += ["--set", f"decide.falseAlarmsPerHour={order}"]
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


def outcome(events, truth, teeth):
    """How many lines were found, how many came with or as a ghost, and how many events are neither."""
    found = ghosts = 0
    explained = set()
    for start, hz, drift in truth:
        here = [(i, e) for i, e in enumerate(events) if e["t_onset"] < start + LENGTH and e["t_end"] > start]
        at = lambda e: hz + drift * (min(max(e["t_detect"], start), start + LENGTH) - start)
        hits = [i for i, e in here if abs(e["f"] - at(e)) < 2.5 / WINDOW / teeth]
        wrong = [i for i, e in here if any(abs(e["f"] - r * at(e)) < 2.5 / WINDOW / teeth for r in GHOSTS)] if teeth > 1 else []
        found += bool(hits)
        ghosts += bool(wrong)
        explained.update(hits + wrong)
    return found, ghosts, len(events) - len(explained)


def half(points):
    """SNR at which half are found, between the tried ones."""
    for (low, below), (high, above) in zip(points, points[1:]):
        if below < 0.5 <= above:
            return low + (0.5 - below) / (above - below) * (high - low)
    return float("nan")


def main():
    cli = sys.argv[1]
    lines = int(sys.argv[2]) if len(sys.argv) > 2 else 40
    reference = None
    print("teeth    found of", lines, "at dB" + " " * 36 + "half at   gain   ghosts of found  others/h ordered 1/h  CPU s/s")
    with tempfile.TemporaryDirectory() as folder:
        for kind in sys.argv[3:] or KINDS:
            teeth, missing, channels, tried = KINDS[kind]
            path = os.path.join(folder, "lines.wav")
            recording(path, teeth, False, channels, -60, 1, 0)
            detect(cli, path, teeth, channels, 1)  # the calibration is kept
            points, ghosts, others, spent, hits = [], 0, 0, 0.0, 0
            for number, decibels in enumerate(tried):
                truth = recording(path, teeth, missing, channels, decibels, lines, number + 1)
                events, cpu = detect(cli, path, teeth, channels, 1)
                found, wrong, rest = outcome(events, truth, teeth)
                points.append((decibels, found / lines))
                hits, ghosts, others, spent = hits + found, ghosts + wrong, others + rest, spent + cpu
            seconds = len(tried) * (APART * lines + LENGTH)
            at = half(points)
            reference = at if kind == "1" else reference
            gain = f"{reference - at:5.2f}" if reference is not None else "     "
            told = "  ".join(f"{db:+d}: {round(lines * share):3d}" for db, share in points)
            print(f"{kind:4}  {told}  {at:7.2f}  {gain}  {ghosts:4} of {hits:4}  {others / seconds * 3600:10.2f}  {spent / seconds:18.5f}", flush=True)


if __name__ == "__main__":
    main()
