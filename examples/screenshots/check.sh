#!/bin/sh
# Renders the sessions and scenarios of a folder and compares the pictures with the expected ones.
#
#   check.sh SESSIONS EXPECTED [OUT]     exit code 1 if a pixel differs; OUT/report/index.html shows where
#   check.sh --accept SESSIONS EXPECTED  accepts the current pictures as the expected ones
#
# Environment: FAINTLINE is the program (default "faintline"), VIEWS the views to render (default "window,events").
set -eu

accept=false
if [ "${1:-}" = --accept ]; then
    accept=true
    shift
fi
if [ $# -lt 2 ]; then
    sed -n '2,7s/^# \{0,1\}//p' "$0" >&2
    exit 2
fi
sessions=$1
expected=$2
out=${3:-screenshots}
program=${FAINTLINE:-faintline}
if $accept; then
    actual=$expected
else
    actual=$out/now
    rm -rf "$actual"
fi
mkdir -p "$actual"

for session in "$sessions"/*.faintline "$sessions"/*.json; do
    [ -e "$session" ] || continue
    name=$(basename "$session")
    "$program" render "$session" --view "${VIEWS:-window,events}" --size 1280x800 --out "$actual/${name%.*}.png"
done
$accept || "$program" check-pictures "$expected" "$actual" --out "$out/report" --junit "$out/report/results.xml"
