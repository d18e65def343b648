#!/bin/sh
# False alarms found and ordered, for every detector on simulated white noise: falseAlarms.sh FAINTLINE-CLI FOLDER [HOURS]
# 48 hours by default, at 100 Hz, windows of 4 s, 1 and 10 an hour. The correct ratio is 1; beside it is the 95 % interval of a count
# (Wilson and Hilferty's).
set -eu

cli=$1
folder=$2
hours=${3:-48}
mkdir -p "$folder"
seconds=$(awk "BEGIN { print 3600 * $hours }")
echo "{\"kind\": \"lines\", \"sampleRateHz\": 100, \"durationSeconds\": $seconds, \"seed\": 77, \"complex\": true, \"lines\": []}" >"$folder/white.json"
"$cli" simulate "$folder/white.json" --out "$folder/white.wav"

printf '%-16s %9s %8s %7s   %s\n' detector ordered/h found ratio '95 % interval'
for kind in smd pOfN integrator energy blockViterbi shiryaevRoberts; do
    for order in 10 1; do
        "$cli" detect "$folder/white.wav" --iq --set spectrogram.windowSeconds=4 --set detector.kind=$kind --set decide.falseAlarmsPerHour=$order \
            --events "$folder/e.csv"
        found=$(($(wc -l <"$folder/e.csv") - 1))
        awk -v kind=$kind -v order="$order" -v n=$found -v hours="$hours" 'BEGIN {
            m = n + 1
            low = n > 0 ? n * (1 - 1 / (9 * n) - 1.96 / (3 * sqrt(n))) ^ 3 : 0
            high = m * (1 - 1 / (9 * m) + 1.96 / (3 * sqrt(m))) ^ 3
            e = order * hours
            printf "%-16s %9g %8d %7.2f   %.2f ... %.2f\n", kind, order, n, n / e, low / e, high / e }'
    done
done
