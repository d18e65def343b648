#!/bin/sh
# Growth of processor time and peak memory of a detection with states, frames and hours: growth.sh FAINTLINE-CLI FOLDER
# Needs Debian's "time". Every size is run twice and the second run is used, because the first may have to calibrate. Prints a table with exponents.
set -eu

cli=$1
folder=$2
mkdir -p "$folder"

recording() { # HOURS
    [ -s "$folder/$1.wav" ] || {
        seconds=$(awk "BEGIN { print 3600 * $1 }")
        echo "{\"kind\": \"lines\", \"sampleRateHz\": 48000, \"durationSeconds\": $seconds, \"lines\": []}" >"$folder/$1.json"
        "$cli" simulate "$folder/$1.json" --out "$folder/$1.wav"
    }
}

measure() { # AXIS SIZE HOURS, then settings
    axis=$1 size=$2 hours=$3
    shift 3
    recording "$hours"
    for _ in 1 2; do
        /usr/bin/time -f "%U %S %M" -o "$folder/time" "$cli" detect "$folder/$hours.wav" --threads 1 --set spectrogram.windowSeconds=2 "$@" --events "$folder/e.csv"
    done
    awk -v axis="$axis" -v size="$size" '{ printf "%s %g %.2f %.0f\n", axis, size, $1 + $2, $3 / 1024 }' "$folder/time"
}

{
    for hours in 0.5 1 2; do measure hours $hours $hours; done
    for slopes in 2 10 40; do measure slopes $((2 * slopes + 1)) 0.5 --preset billon --set model.lowestSlope=-$slopes --set model.highestSlope=$slopes; done
    for steps in 1 2 4; do measure frames-a-window $steps 0.5 --set spectrogram.stepsPerWindow=$steps; done
} | awk '
    { printf "%-16s %6g  %7.2f s  %5d MiB", $1, $2, $3, $4 }
    $1 == axis { printf "   time ~ size^%.2f, memory ~ size^%.2f", log($3 / time) / log($2 / size), log($4 / memory) / log($2 / size) }
    { print ""; axis = $1; size = $2; time = $3; memory = $4 }'
