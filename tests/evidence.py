#!/usr/bin/python3
"""Do tracks report what was measured, and one signal each? On recordings with known lines, with default settings:
    /usr/bin/python3 tests/evidence.py CLI [FOLDER] [CASE ...]
FOLDER: a benchmark with truth/*.json beside ../recordings (default ../shared/realbench; without it nothing is measured). For each recording:
measured: share of the tracks' points with an SNR above 3 dB in the samples: power at the point over that of its surroundings, 3 to 12 cells beside it,
in the track's own window, mean over nine points. along: true lines that a track runs along, of the tracks that are on any: on the line and nearest to it
for a tenth of the track or more. Needs numpy."""
import csv
import glob
import json
import os
import subprocess
import sys
import tempfile

import numpy

SIDES = numpy.concatenate([-numpy.arange(3.0, 12.5, 0.5), numpy.arange(3.0, 12.5, 0.5)])  # cells
MEAN = 9
LEAST_SHARE = 0.1


def rows_of(path):
    with open(path) as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def samples_of(cli, path, truth, folder):
    """Of any format, through a copy with a line of no power."""
    out = os.path.join(folder, "copy.sigmf-meta")
    about = subprocess.run([cli, "info", path, *truth["flags"], "--json"], check=True, capture_output=True, text=True)
    rate = truth["recording"]["sample_rate"]
    line = (json.loads(about.stdout).get("centreHz") or 0) + 0.01 * rate
    subprocess.run([cli, "inject", path, *truth["flags"], "--snr", "-60", "--frequency", str(line), "--out", out, "--truth",
                    os.path.join(folder, "truth.json")], check=True, capture_output=True)
    with open(out) as file:
        kind = json.load(file)["global"]["core:datatype"]
    values = numpy.fromfile(out.replace("-meta", "-data"), "<f4" if kind == "rf32_le" else "<c8")
    return values.astype(complex if numpy.iscomplexobj(values) else float), float(rate)


def measured_snr(samples, rate, window, points):
    """SNR at each (t, f) of a track."""
    n = max(8, int(round(window * rate)))
    shape = numpy.hanning(n + 1)[:-1]
    padded = 4 * n
    ratios = []
    for t, f in points:
        first = min(max(0, int(round(t * rate - n / 2))), max(0, len(samples) - n))
        part = samples[first:first + n]
        power = numpy.abs(numpy.fft.fft(part * shape[:len(part)], padded)) ** 2
        at = lambda hz: power[numpy.round(numpy.asarray(hz) * padded / rate).astype(int) % padded]
        beside = f + SIDES / window
        if not numpy.iscomplexobj(samples):
            beside = beside[(beside > 1 / window) & (beside < rate / 2 - 1 / window)]
        ratios.append((at(f), numpy.median(at(beside)) / numpy.log(2) if len(beside) else numpy.inf))
    ratios = numpy.array(ratios)
    kernel = numpy.ones(min(MEAN, len(ratios)))
    smooth = lambda x: numpy.convolve(x, kernel, "same") / numpy.convolve(numpy.ones(len(x)), kernel, "same")
    return smooth(ratios[:, 0]) / numpy.maximum(smooth(ratios[:, 1]), 1e-300) - 1  # nothing in digital silence


def lines_along(points, step, lines):
    """Number of true lines that a track runs along."""
    t, f = points[:, 0], points[:, 1]
    away = []
    for line in lines:
        true = numpy.array(line["points"])
        d = numpy.abs(f - numpy.interp(t, true[:, 0], true[:, 1])) / max(line["tol_hz"], 0.5 / step)
        away.append(numpy.where((t >= true[0, 0] - step) & (t <= true[-1, 0] + step), d, numpy.inf))
    if not away:
        return 0
    away = numpy.array(away)
    nearest = (away <= 1) & (away == away.min(axis=0))
    return int((nearest.mean(axis=1) >= LEAST_SHARE).sum())


def measure(cli, truth, recording):
    with tempfile.TemporaryDirectory() as folder:
        tracks, events = (os.path.join(folder, name) for name in ("t.csv", "e.csv"))
        subprocess.run([cli, "detect", recording, *truth["flags"], "--tracks", tracks, "--events", events], check=True, capture_output=True)
        windows = {row["event"]: float(row["window_s"]) for row in rows_of(events)}
        found = {}
        for row in rows_of(tracks):
            found.setdefault(row["track"], []).append((float(row["t"]), float(row["f"])))
        samples, rate = samples_of(cli, recording, truth, folder)
    above = count = 0
    along = []
    for number, points in found.items():
        points = numpy.array(points)
        above += (measured_snr(samples, rate, windows[number], points) > 10 ** 0.3).sum()
        count += len(points)
        along.append(lines_along(points, windows[number] / 2, truth["lines"]))
    return len(found), int(above), count, [n for n in along if n > 0]


def main(cli, folder="../shared/realbench", *cases):
    paths = sorted(glob.glob(os.path.join(folder, "truth", "*.json")))
    if not paths:
        return print("skipped: no", folder)
    print("%-26s %7s %9s %6s %5s" % ("recording", "tracks", "measured", "along", "most"))
    shares, all_along = [], []
    for path in paths:
        with open(path) as file:
            truth = json.load(file)
        if cases and not any(truth["case"].startswith(case) for case in cases):
            continue
        tracks, above, count, along = measure(cli, truth, os.path.join(folder, "..", "recordings", truth["recording"]["file"]))
        shares += [above / count] if count else []
        all_along += along
        print("%-26s %7d %9s %6s %5d" % (truth["case"], tracks, "%.3f" % (above / count) if count else "-", "%.2f" % numpy.mean(along) if along else "-",
                                         max(along, default=0)), flush=True)
    print("%-26s %7s %9.3f %6.2f %5d" % ("mean, mean of tracks, most", "", numpy.mean(shares), numpy.mean(all_along), max(all_along)))


if __name__ == "__main__":
    main(*sys.argv[1:])
