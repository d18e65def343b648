#!/bin/sh
# Feeds generated input to every parser, for MINUTES of processor time in all, with clang's libFuzzer, AddressSanitizer and UndefinedBehaviorSanitizer:
#     sh tests/fuzz.sh [MINUTES] [PARSER...]
# Input that breaks a parser is stored in build-fuzz/found; move it to tests/fuzz/files, which a test feeds to all parsers. Corpora grow in
# build-fuzz/corpus from run to run. MINUTES are processor time, not elapsed time: a busy machine takes longer for the same work.
set -eu

cd "$(dirname "$0")/.."
minutes=${1:-10}
[ $# -gt 0 ] && shift
case $minutes in
'' | *[!0-9]*)
    sed -n '2,/^set -eu/s/^# //p' "$0" >&2
    exit 2
    ;;
esac
command -v clang++ >/dev/null || {
    echo "error: tests/fuzz.sh: needs clang++ (on Debian: apt-get install clang)" >&2
    exit 1
}

sh cmake/setup.sh
if [ ! -f build-fuzz/build.ninja ]; then
    cmake --preset fuzz >/dev/null
fi
cmake --build build-fuzz --target faintline-fuzz faintline-fuzz-window faintline-cli

core=$PWD/build-fuzz/tests/faintline-fuzz
window=$PWD/build-fuzz/tests/faintline-fuzz-window
ofWindow=" $(FAINTLINE_FUZZ=LIST "$window" | tr '\n' ' ')"
parsers=${*:-$(FAINTLINE_FUZZ=LIST "$core")$ofWindow}
export QT_QPA_PLATFORM=offscreen
# As in strict.sh: a failed allocation must be handled by the parser.
export ASAN_OPTIONS="allocator_may_return_null=1:${ASAN_OPTIONS:-}"
export LSAN_OPTIONS="suppressions=$PWD/tests/leaks.supp:print_suppressions=0:${LSAN_OPTIONS:-}"
export UBSAN_OPTIONS="print_stacktrace=1:${UBSAN_OPTIONS:-}"
count=$(echo $parsers | wc -w)
FAINTLINE_FUZZ_SECONDS=$((minutes * 60 / count))
[ "$FAINTLINE_FUZZ_SECONDS" -gt 0 ] || FAINTLINE_FUZZ_SECONDS=1
export FAINTLINE_FUZZ_SECONDS

# Initial corpora: files of the repository, and files that the program writes from them.
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
        mv line.wav.provenance.json provenance.json
        rm -f ./*.wav.provenance.json ./*.npy.provenance.json ./line.*.provenance.json ./truth-*.provenance.json
        cat > session.json <<'EOF'
{"faintline": 1, "recording": {"path": "line.wav", "sha256": "", "iq": true, "rawType": "ci16_le", "rawRateHz": 1000, "rawChannels": 1,
 "rawHeaderBytes": 0, "injected": [{"line": {"snrDb": 3, "frequencyHz": 99}, "amplitude": 0.1, "channel": 0, "seed": 1}]},
 "settings": {"decide": {"falseAlarmsPerHour": 1}}, "view": {"seconds": [0, 1], "hz": [0, 9], "cursor": [1, 2], "orientation": "", "colourMap": "",
 "bearing": [0, 1], "cursorBearing": 3, "polar": true},
 "annotations": {"reviews": [{"verdict": "accepted", "note": "a", "paths": []}],
 "boxes": [{"seconds": [1, 2], "hz": [3, 4], "label": "a", "note": "b", "verdict": "rejected"}]}}
EOF
        echo '{"faintline": 1, "recording": {"name": "s", "scenario": {"kind": "lines", "lines": []}}, "settings": {}, "render":
 {"view": "output", "size": [4, 3], "theme": "light", "scale": 1, "time": 1, "set": ["a=b"], "layer": "age", "overlay": true, "focused": false}}' > origin.txt
        echo '{"faintline": 1, "version": "0.1.0", "recording": {"name": "s", "scenario": {"kind": "lines", "sampleRateHz": 1000,
 "durationSeconds": 2, "lines": []}, "injected": [{"line": {"frequencyHz": 99}, "amplitude": 0.1, "channel": 0, "seed": 1}]},
 "settings": {}, "annotations": {"boxes": []}, "shownThreshold": 3}' > export.json
        few='{"kind": "lines", "runs": 2, "frames": 60, "blockFrames": 30, "blockBins": 30, "durationWindows": 10, "snrDb": [3],
 "detectors": [{"name": "P", "settings": {"detector.kind": "pOfN"}}]}'
        echo "$few" > few.json
        echo '{"version": "0.1.0", "experiment": '"$few"', "runs": [0, 1]}' > curve.json
        "$cli" evaluate few.json --shard 1/2 --out shard.json
        FAINTLINE_CACHE=$PWD "$cli" detect line.wav --set spectrogram.windowSeconds=0.5 --set model.lowestSlope=0 --set model.highestSlope=0
        # A picture of four by three pixels with a scale in its metadata.
        echo iVBORw0KGgoAAAANSUhEUgAAAAQAAAADCAAAAACRn/EaAAAAI3RFWHRwcm92ZW5hbmNlAHsicmVuZGVyIjogeyJzY2FsZSI6IDF9feS0IvUAAAAPSURBVHicY2BkYmZhgB\
MAAOEAH40//+EAAAAASUVORK5CYII= | base64 -d > picture.png
    )
fi
cp tests/fuzz/files/* "$seeds"

mkdir -p build-fuzz/found
TMPDIR=$(mktemp -d -p /dev/shm 2>/dev/null || mktemp -d) # in memory, because a disk would be the slowest part for most parsers
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT
seconds() { # processor time of all children so far, from `times`
    sed -n 2p "$TMPDIR/times" | awk '{ gsub(/[ms]/, " "); print int(60 * $1 + $2 + 60 * $3 + $4) }'
}

status=0
for parser in $parsers; do
    corpus=build-fuzz/corpus/$parser
    mkdir -p "$corpus"
    log=build-fuzz/$parser.log
    case $ofWindow in *" $parser "*) fuzz=$window ;; *) fuzz=$core ;; esac
    times > "$TMPDIR/times"
    before=$(seconds)
    # A minute on the clock: feeding (feed.cpp) ends what takes long of a processor. What is used of memory counts: HDF5 asks for as much as a
    # file says, then reads nothing.
    FAINTLINE_FUZZ=$parser "$fuzz" "$corpus" "$seeds" -dict=tests/fuzz/words.dict -timeout=60 -rss_limit_mb=1024 -malloc_limit_mb=16384 \
        -max_len=65536 -artifact_prefix="build-fuzz/found/$parser-" -print_final_stats=1 > "$log" 2>&1 || status=1
    times > "$TMPDIR/times"
    took=$(($(seconds) - before))
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
    cover=$(grep -o 'cov: [0-9]*' "$log" | tail -1)
    echo "$parser: ${runs:-0} inputs, ${cover:-cov: ?} edges, $took s$(ls build-fuzz/found | grep -q "^$parser-" && echo ', FOUND SOMETHING: see build-fuzz/found')"
done
exit $status
