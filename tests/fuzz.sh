#!/bin/sh
# Feeds made-up bytes to every parser, MINUTES in all, with clang's libFuzzer, AddressSanitizer and UndefinedBehaviorSanitizer:
#     sh tests/fuzz.sh [MINUTES] [PARSER...]
# What breaks a parser is kept in build-fuzz/found, to become a test's file. Corpora grow in build-fuzz/corpus from run to run.
set -eu

cd "$(dirname "$0")/.."
minutes=${1:-10}
[ $# -gt 0 ] && shift

if [ ! -f build-fuzz/build.ninja ]; then
    cmake --preset fuzz >/dev/null
fi
cmake --build build-fuzz --target faintline-fuzz faintline-cli

fuzz=$PWD/build-fuzz/tests/faintline-fuzz
parsers=${*:-$(FAINTLINE_FUZZ=LIST "$fuzz")}
count=$(echo $parsers | wc -w)
seconds=$((minutes * 60 / count))
[ "$seconds" -gt 0 ] || seconds=1

# What the parsers begin with: the repository's own files, and what the program writes of them.
seeds=build-fuzz/seeds
if [ ! -d "$seeds" ]; then
    mkdir -p "$seeds"
    cp examples/*.json resources/scenarios/*.json resources/lessons/*.json "$seeds"
    find examples/campaign -name '*.json' -exec cp {} "$seeds" \;
    cli=$PWD/build-fuzz/app/faintline-cli
    (
        cd "$seeds"
        echo '{"sampleRateHz": 1000, "durationSeconds": 2, "lines": [{"snrDb": 9, "frequencyHz": 210}]}' > line.json
        echo '{"kind": "pings", "pings": 3, "rangeCells": 10, "beams": 4, "targets": [{"rangeMetres": 3030, "legs": [{"pings": 1}, {}]}]}' > pings.json
        for kind in wav flac aiff w64 rf64 caf au sigmf-meta; do
            "$cli" simulate line.json --type int16 --out "line.$kind" --truth "truth-$kind.json"
        done
        "$cli" simulate pings.json --out pings.npy
        printf 'ci16_le\nabcdefghijkl' > raw.bin
        printf 'event,t_onset,t_end,f\n1,2,3,4\n' > events.csv
        printf 'Selection\tBegin Time (s)\tEnd Time (s)\n1\t2\t3\n' > raven.txt
        printf '1\t2\t[rejected] a\n\\\t3\t4\n' > labels.txt
        printf 'detector,snr_db,pd,pd_low,pd_high,trials,threshold\n"a ""b""",1,0.5,0.4,0.6,10,\n' > curve.csv
        rm -f ./*.provenance.json
    )
fi

mkdir -p build-fuzz/found
status=0
for parser in $parsers; do
    corpus=build-fuzz/corpus/$parser
    mkdir -p "$corpus"
    log=build-fuzz/$parser.log
    FAINTLINE_FUZZ=$parser "$fuzz" "$corpus" "$seeds" -dict=tests/fuzz/words.dict -max_total_time="$seconds" -timeout=10 -rss_limit_mb=1024 \
        -max_len=65536 -artifact_prefix="build-fuzz/found/$parser-" -print_final_stats=1 > "$log" 2>&1 || status=1
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
    cover=$(grep -o 'cov: [0-9]*' "$log" | tail -1)
    echo "$parser: ${runs:-0} inputs, ${cover:-cov: ?} edges$(ls build-fuzz/found | grep -q "^$parser-" && echo ', FOUND SOMETHING: see build-fuzz/found')"
done
rm -rf /dev/shm/faintline-fuzz-*
exit $status
