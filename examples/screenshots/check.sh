#!/bin/sh
# Draws the sessions and scenarios of a folder and compares the pictures with those that are expected.
#
#   check.sh SESSIONS EXPECTED [OUT]     exit code 1 where a pixel differs; OUT/index.html shows where
#   check.sh --accept SESSIONS EXPECTED  what is drawn now is expected from now on
#
# FAINTLINE is the program, "faintline" if not told otherwise; VIEWS what is drawn, "window,events".
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
$accept || "$program" check-pictures "$expected" "$actual" --out "$out/report"
