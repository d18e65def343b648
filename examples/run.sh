#!/bin/sh
# From a fresh checkout to a detection: sets the machine up, builds, simulates a recording with a faint drifting line,
# finds the line and draws the window. With --gui, or on a terminal with a screen, the window opens at the end.
set -eu

cd "$(dirname "$0")/.."

fail() {
    echo "error: examples/run.sh: $1 failed" >&2
    exit 1
}

sh cmake/setup.sh || exit 1
[ -f build/build.ninja ] || cmake --preset release || fail "configuring"
echo "Building (the first time takes some minutes)"
cmake --build build --target faintline faintline-cli || fail "the build"

out=build/example
recording=$out/drifting-line.wav
mkdir -p "$out"

build/app/faintline-cli simulate examples/drifting-line.json --out "$recording" --truth "$out/drifting-line.truth.json" ||
    fail "the simulation"
# Billon's detector with rectangular windows of 0.25 s, for a line that seldom changes its slope; one false alarm an hour.
settings="--preset billon --set spectrogram.windowSeconds=0.25 --set model.lowestSlope=-1 --set model.highestSlope=1
    --set model.slopeChange=0.98,0.01 --set decide.falseAlarmsPerHour=1"
build/app/faintline-cli detect "$recording" $settings --events "$out/events.csv" --tracks "$out/tracks.csv" --summary ||
    fail "the detection"
QT_QPA_PLATFORM=offscreen build/app/faintline render "$recording" $settings --out "$out/window.png" || fail "the picture"

cat <<END

Written, in $PWD/$out:
  drifting-line.wav         the recording, simulated from examples/drifting-line.json
  drifting-line.truth.json  where the line really is
  events.csv, tracks.csv    where it was found
  window.png                what the window shows

Next:
  build/app/faintline $recording
  build/app/faintline-cli detect --help
END

screen=${DISPLAY:-}${WAYLAND_DISPLAY:-}
if [ "${1:-}" = --gui ] || { [ -n "$screen" ] && [ -t 1 ]; }; then
    exec build/app/faintline "$recording"
fi
