#!/usr/bin/env python3
"""WSPR messages whose frequency drifts or swings, decoded by wsprd before and after faintline-cli straighten:
    python3 tests/wspr.py CLI [TRIALS] [NOISE-SLOTS]
Needs numpy, and wsprsim and wsprd of Debian's wsjtx: an independent modulator and decoder. SNR in 2500 Hz; neither
program is given the position of the message within 200 Hz."""
import os
import subprocess
import sys
import tempfile
import time
import wave

import numpy

RATE = 12000
SYMBOL = 8192  # samples
SPACING = RATE / SYMBOL  # of the four tones, Hz
MESSAGE = "K1ABC FN42 33"
SETTINGS = ["--low", "1390", "--high", "1610"] + [
    part
    for setting in (
        "spectrogram.windowSeconds=1.02",
        "spectrogram.binsPerCell=4",
        "spectrogram.stepsPerWindow=4",
        "family.relation=offsets",
        "family.members=0,1.4648,2.9297,4.3945",
        "family.present=inTurn",
    )
    for part in ("--set", setting)
]
CELLS = [  # kind, Hz, dB
    ("drift", 8, -24),
    ("drift", 20, -24),
    ("swing", 2, -24),
    ("drift", 8, -27),
    ("drift", 20, -27),
    ("swing", 2, -27),
    ("steady", 0, -27),
    ("steady", 0, -29),
]


def symbols():
    told = subprocess.run(["wsprsim", "-c", MESSAGE], capture_output=True, text=True).stdout
    return numpy.array([int(word) for word in told.split("symbols:")[1].split()])


def slot(random, tones, kind, hertz, decibels):
    samples = random.standard_normal(120 * RATE)
    if tones is None:
        return samples
    tone = numpy.repeat(tones, SYMBOL)
    t = numpy.arange(tone.size) / RATE
    moved = {
        "steady": lambda: 0.0 * t,
        "drift": lambda: random.choice([-1, 1]) * hertz * (t / t[-1] - 0.5),
        "swing": lambda: hertz * numpy.sin(2 * numpy.pi * (t / 40 + random.uniform())),
    }[kind]()
    frequency = 1500 + random.uniform(-80, 80) + (tone - 1.5) * SPACING + moved
    amplitude = numpy.sqrt(2 * 10 ** (decibels / 10) * 2500 / (RATE / 2))
    start = int(RATE * random.uniform(0.7, 1.3))
    samples[start : start + tone.size] += amplitude * numpy.sin(2 * numpy.pi * numpy.cumsum(frequency) / RATE)
    return samples


def write(samples, path):
    with wave.open(path, "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(RATE)
        file.writeframes(numpy.clip(numpy.round(1500 * samples), -32768, 32767).astype("<i2").tobytes())


def decoded(path):
    """What wsprd makes of a slot: its messages."""
    told = subprocess.run(["wsprd", "-a", os.path.dirname(path), "-H", path], capture_output=True, text=True).stdout
    return [" ".join(line.split()[5:]) for line in told.splitlines() if not line.startswith("<")]


def main():
    cli = sys.argv[1]
    trials = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    noise = int(sys.argv[3]) if len(sys.argv) > 3 else 0
    with tempfile.TemporaryDirectory() as folder:
        before, after = (os.path.join(folder, name) for name in ("200101_0000.wav", "200101_0002.wav"))

        def both(samples):
            write(samples, before)
            if os.path.exists(after):
                os.remove(after)
            command = [cli, "straighten", before, *SETTINGS, "--smooth", "8", "--out", after, "--type", "int16"]
            subprocess.run(command, capture_output=True)
            return decoded(before), decoded(after) if os.path.exists(after) else []

        both(numpy.random.default_rng(0).standard_normal(120 * RATE))  # the calibration is kept
        tones = symbols()
        print("kind        Hz   dB   before  after  either   wrong   CPU-s a slot")
        for number, (kind, hertz, decibels) in enumerate(CELLS):
            counts = [0, 0, 0, 0]
            spent = os.times()
            for trial in range(trials):
                random = numpy.random.default_rng([number, trial])
                first, second = both(slot(random, tones, kind, hertz, decibels))
                counts[0] += MESSAGE in first
                counts[1] += MESSAGE in second
                counts[2] += MESSAGE in first + second
                counts[3] += any(message != MESSAGE for message in first + second)
            now = os.times()
            cpu = now.children_user + now.children_system - spent.children_user - spent.children_system
            print(f"{kind:8} {hertz:5} {decibels:4}   {counts[0]:6} {counts[1]:6} {counts[2]:7} {counts[3]:7}   {cpu / trials:.2f}", flush=True)
        wrong = 0
        for trial in range(noise):
            first, second = both(slot(numpy.random.default_rng([99, trial]), None, "", 0, 0))
            wrong += bool(first + second)
        if noise:
            print(f"noise: a message in {wrong} of {noise} slots")


if __name__ == "__main__":
    main()
