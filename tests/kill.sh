#!/bin/sh
# Kills the command line with SIGKILL at random moments, COUNT times in all, while it runs detect, simulate, a campaign and a survey:
#     sh tests/kill.sh CLI [COUNT]
# No half-written file and no result without its provenance may remain, and a resumed campaign or survey must give the same bytes as one that was not
# killed. ctest kills a few times; the full test is `sh tests/kill.sh build/app/faintline-cli 200`.
set -eu

cli=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
count=${2:-6}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir cache
export FAINTLINE_CACHE=$folder/cache

fail() {
    echo "error: tests/kill.sh: $1" >&2
    ls -la >&2
    exit 1
}

cat > scene.json <<'EOF'
{"kind": "lines", "sampleRateHz": 2000, "durationSeconds": 200, "seed": 3,
 "lines": [{"snrDb": 9, "referenceSeconds": 0.5, "startSeconds": 8, "durationSeconds": 150, "frequencyHz": 210, "driftHzPerSecond": 0.2}]}
EOF
cat > experiment.json <<'EOF'
{"kind": "lines", "runs": 60, "frames": 400, "blockFrames": 100, "blockBins": 60, "durationWindows": 20, "snrDb": [0, 3],
 "detectors": [{"name": "P", "settings": {"detector.kind": "pOfN"}}, {"name": "SMD", "settings": {"detector.kind": "smd", "smd.reset": "fixed"}}]}
EOF
# Replaces the calling shell by the program, so that the signal reaches the program itself.
become() {
    case $1 in
    detect) exec "$cli" detect line.wav --set spectrogram.windowSeconds=0.5 --events e.csv --tracks t.csv --statistic s.npy ;;
    simulate) exec "$cli" simulate scene.json --out made.sigmf-meta --truth made.json ;;
    evaluate) exec "$cli" evaluate experiment.json --threads 1 --out curve.csv ;;
    survey) exec "$cli" survey night --set spectrogram.windowSeconds=0.5 --out survey.sqlite ;;
    esac
}

"$cli" simulate scene.json --out line.wav
mkdir whole night
for i in 1 2 3 4 5 6 7 8; do
    cp line.wav night/$i.wav
done
now() { date +%s%N; }
for job in detect simulate evaluate survey; do
    (become $job)
    rm -f survey.sqlite
    begin=$(now)
    (become $job)
    eval "${job}Nanoseconds=$(($(now) - begin))"
done
for file in e.csv t.csv s.npy made.sigmf-meta made.sigmf-data made.json curve.csv survey.sqlite; do
    mv "$file" whole/
done
rm -f -- *.provenance.json

# Existing files are complete and have their provenance.
check() {
    for file in "$@"; do
        [ -f "$file" ] || continue
        cmp -s "$file" "whole/$file" || fail "$file is half-written"
        case $file in *.sigmf-data | curve.csv) continue ;; esac
        [ -f "$file.provenance.json" ] || fail "$file is without its provenance"
    done
}

killed=0
resumed=0
i=0
while [ "$killed" -lt "$count" ]; do # some runs end before they are killed
    i=$((i + 1))
    case $((i % 4)) in
    0) job=detect ;;
    1) job=simulate ;;
    2) job=evaluate ;;
    3) job=survey ;;
    esac
    [ "$job" = evaluate ] || [ "$job" = survey ] || rm -f e.csv t.csv s.npy made.sigmf-meta made.sigmf-data made.json ./*.provenance.json
    eval "nanoseconds=\$${job}Nanoseconds"
    random=$(od -An -N4 -tu4 /dev/urandom | tr -d ' ')
    (become $job) 2> said &
    pid=$!
    sleep "$(awk "BEGIN { printf \"%.3f\", $nanoseconds / 1e9 * 1.1 * $random / 4294967296 }")"
    if kill -9 $pid 2>/dev/null; then
        killed=$((killed + 1))
    fi
    wait $pid 2>/dev/null || true
    case $job in
    detect) check e.csv t.csv s.npy ;;
    simulate) check made.sigmf-meta made.sigmf-data made.json ;;
    evaluate)
        check curve.csv
        if [ -f curve.csv ]; then
            rm -f curve.csv
        else
            resumed=$((resumed + 1))
        fi
        ;;
    survey)
        if cmp -s survey.sqlite whole/survey.sqlite; then
            rm -f survey.sqlite
        else
            resumed=$((resumed + 1))
        fi
        ;;
    esac
done

# The next runs resume or remove what the killed ones left.
for job in detect simulate evaluate survey; do
    (become $job)
done
check e.csv t.csv s.npy made.sigmf-meta made.sigmf-data made.json
cmp curve.csv whole/curve.csv || fail "the campaign was resumed to other bytes"
cmp survey.sqlite whole/survey.sqlite || fail "the survey was resumed to other bytes"
for left in ./*.part ./*-journal; do
    [ -e "$left" ] && fail "$left was left"
done
echo "killed $killed times, $resumed of them in a campaign or survey that was resumed: no half-written file, the same bytes"
