#!/bin/sh
# From a fresh checkout to a detection: sets the machine up, builds, simulates a recording with a faint drifting line,
# finds the line and draws the window. With --gui, or on a terminal with a screen, the window opens at the end.
set -eu

cd "$(dirname "$0")/.."

fail() {
    echo "error: examples/run.sh: $1 failed" >&2
    exit 1
}

sh cmake/setup.sh ccache || exit 1 # a second build takes less with it
[ -f build/build.ninja ] || cmake --preset release >build/configure.log || fail "configuring"
NINJA_STATUS='Building, %p, %e s: ' cmake --build build --target faintline faintline-cli || fail "the build"

out=build/example
recording=$out/drifting-line.wav
mkdir -p "$out"

build/app/faintline-cli simulate examples/drifting-line.json --out "$recording" --truth "$out/drifting-line.truth.json" ||
    fail "the simulation"
found=$(build/app/faintline-cli detect "$recording" --events "$out/events.csv" --tracks "$out/tracks.csv" --summary) ||
    fail "the detection"
QT_QPA_PLATFORM=offscreen build/app/faintline render "$recording" --out "$out/window.png" || fail "the picture"

echo
echo "Found:$(echo "$found" | tail -n 1). The line is there from 40 to 200 s, 1 dB below the noise in a window of 0.25 s."
echo "See $out/window.png, events.csv, tracks.csv; or the window: build/app/faintline $recording"
echo "Your own recording: build/app/faintline-cli detect FILE --summary --events events.csv"

screen=${DISPLAY:-}${WAYLAND_DISPLAY:-}
if [ "${1:-}" = --gui ] || { [ -n "$screen" ] && [ -t 1 ]; }; then
    exec build/app/faintline "$recording"
fi
