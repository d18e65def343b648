#!/bin/sh
# Test of check.sh, run by ctest: try.sh PROGRAM FOLDER
set -eu
FAINTLINE=$1
export FAINTLINE
here=$(dirname "$0")
rm -rf "$2"
mkdir -p "$2/sessions"
cp "$here/../../resources/scenarios/faint-drifting-line.json" "$2/sessions"
sh "$here/check.sh" --accept "$2/sessions" "$2/expected"
sh "$here/check.sh" "$2/sessions" "$2/expected" "$2/out"
mv "$2/expected/faint-drifting-line-events.png" "$2/expected/faint-drifting-line-window.png"
if sh "$here/check.sh" "$2/sessions" "$2/expected" "$2/out" 2>"$2/error"; then
    echo "a changed picture was not reported" >&2
    exit 1
fi
grep -q "2 of 2 picture(s) differ" "$2/error"
test -s "$2/out/report/index.html"
