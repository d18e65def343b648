#!/bin/sh
# False alarms found and ordered on simulated white noise: falseAlarms.sh FAINTLINE-CLI FOLDER [LENGTH] [CASE...]
# 48 hours at 1 an hour and 8 hours at 10 an hour, times LENGTH (1), of I/Q at 400 Hz in windows of 1 s, for each case: three presets, four frames a window,
# nine slopes, a band of 30 Hz, and the six detectors ("default" is the sequential Markov one). It needs 0.7 GB in FOLDER, and exits with 1 if a ratio
# lies outside 0.7 to 1.4. Other noise with SEED=number in the environment.
#
# ratio     found/ordered, and the 95 % interval of a count (Wilson and Hilferty's)
# printed   the program's own 95 % interval of the rate, over the order
# judgement whether the ratio lies in 0.7 to 1.4, and whether 1 lies in the joint interval of count and program
set -eu

cli=$1
folder=$2
length=${3:-1}
[ $# -gt 3 ] && shift 3 || set --
cases=${*:-default billon steady whistles k_t=4 nine-slopes band-30-Hz pOfN integrator energy blockViterbi shiryaevRoberts}
mkdir -p "$folder"
seed=${SEED:-77}
middle=$(awk "BEGIN { print 172800 * $length }")
end=$(awk "BEGIN { print 201600 * $length }")
noise=$folder/white-$seed-$length.wav
if [ ! -f "$noise" ]; then
    echo "{\"kind\": \"lines\", \"sampleRateHz\": 400, \"durationSeconds\": $end, \"seed\": $seed, \"complex\": true, \"lines\": []}" >"$folder/white.json"
    "$cli" simulate "$folder/white.json" --out "$noise"
fi

options() {
    case $1 in
    default) ;;
    billon | steady | whistles) echo "--preset $1" ;;
    k_t=*) echo "--set spectrogram.stepsPerWindow=${1#k_t=}" ;;
    nine-slopes) echo "--set model.slopesPerBin=4" ;;
    band-30-Hz) echo "--low 100 --high 130" ;;
    *) echo "--set detector.kind=$1" ;;
    esac
}

printf '%-16s %9s %6s %6s   %-13s   %-13s   %s\n' case ordered/h found ratio '95 %' printed judgement
outside=0
for case in $cases; do
    for order in 1 10; do
        if [ $order = 1 ]; then from=0 to=$middle; else from=$middle to=$end; fi
        # shellcheck disable=SC2046
        set -- "$noise" --iq $(options "$case") --set spectrogram.windowSeconds=1 --set decide.falseAlarmsPerHour=$order
        "$cli" detect "$@" --from "$from" --to "$to" --events "$folder/e.csv"
        found=$(($(wc -l <"$folder/e.csv") - 1))
        printed=$("$cli" calibrate "$@" --json | tr -d ' \n' | sed 's/.*"falseAlarmsPerHourInterval":\[\([^,]*\),\([^]]*\)\].*/\1 \2/')
        awk -v name="$case" -v order=$order -v n=$found -v expected="$(awk "BEGIN { print $order * ($to - $from) / 3600 }")" -v printed="$printed" 'BEGIN {
            m = n + 1
            low = n > 0 ? n * (1 - 1 / (9 * n) - 1.96 / (3 * sqrt(n))) ^ 3 : 0
            high = m * (1 - 1 / (9 * m) + 1.96 / (3 * sqrt(m))) ^ 3
            split(printed, own, " ")
            program = log(own[2] / own[1]) / 2
            below = n > 0 ? log(n / low) : 99
            above = n > 0 ? log(high / n) : 99
            off = n > 0 ? log(n / expected) : -99
            isKept = n >= 0.7 * expected && n <= 1.4 * expected
            isExplained = off > 0 ? off < sqrt(below ^ 2 + program ^ 2) : -off < sqrt(above ^ 2 + program ^ 2)
            printf "%-16s %9g %6d %6.2f   %.2f ... %.2f   %.2f ... %.2f   %s, %s\n", name, order, n, n / expected, low / expected, high / expected,
                own[1] / order, own[2] / order, isKept ? "kept" : "NOT KEPT", isExplained ? "1 inside" : "1 outside"
            exit !isKept }' || outside=1
    done
done
exit $outside
