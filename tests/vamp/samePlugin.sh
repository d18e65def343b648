#!/bin/sh
# samePlugin.sh FAINTLINE-CLI FOLDER-OF-THE-PLUG-IN: the events of a host of the Vamp plug-in are those of the command line, byte for byte, its
# tracks have as many points, and its statistic as many frames.
set -eu

cli=$1
export VAMP_PATH=$2
command -v vamp-simple-host >/dev/null || exit 77
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT

cat >"$folder/scene.json" <<'SCENE'
{"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 120.5, "seed": 3, "noise": {"deviation": 0.1}, "lines": [
    {"frequencyHz": 200, "driftHzPerSecond": 0.2, "snrDb": 3, "referenceSeconds": 0.5, "startSeconds": 10, "durationSeconds": 100},
    {"frequencyHz": 350, "snrDb": 3, "referenceSeconds": 0.5, "startSeconds": 40, "durationSeconds": 50}]}
SCENE
"$cli" --progress none simulate "$folder/scene.json" --out "$folder/x.wav"
"$cli" --progress none detect "$folder/x.wav" --events "$folder/events.csv" --tracks "$folder/tracks.csv" --statistic "$folder/statistic.npy"

host() {
    vamp-simple-host "faintline:detector:$1" "$folder/x.wav" -o "$folder/$1.txt" 2>"$folder/$1.log"
}
host events
host tracks
host statistic

tail -n +2 "$folder/events.csv" >"$folder/wanted"
[ "$(wc -l <"$folder/wanted")" -ge 2 ] || { echo "the command line found fewer than two events" >&2; exit 1; }
# TIME, DURATION: HZ LINE-OF-THE-TABLE
sed 's/^[^:]*: *[^ ]* *//' "$folder/events.txt" >"$folder/found"
diff "$folder/wanted" "$folder/found"
[ "$(tail -n +2 "$folder/tracks.csv" | wc -l)" -eq "$(wc -l <"$folder/tracks.txt")" ]
"${PYTHON:-/usr/bin/python3}" - "$folder" <<'CHECK'
import sys
import numpy as np

folder = sys.argv[1]
statistic = np.load(folder + "/statistic.npy")
rows = [line.split(":", 1)[1].split() for line in open(folder + "/statistic.txt")]
found = np.array(rows, dtype=float)
assert found.shape == statistic.shape, (found.shape, statistic.shape)
assert np.allclose(found, statistic, rtol=1e-5, atol=1e-5)
CHECK
