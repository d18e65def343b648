#!/bin/sh
# survey.sh FAINTLINE-CLI [COUNT [SECONDS]]: a survey of COUNT short recordings (10000 of 10 s) by two workers, killed three times and resumed, must give the
# bytes of an uninterrupted one. Also compares its processor time with that of `detect` on one recording of the same total length. Uses $TMPDIR.
set -eu

cli=$(realpath "$1")
count=${2:-10000}
seconds=${3:-10}
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cd "$folder"
export FAINTLINE_CACHE=$folder/cache
mkdir night

cat >scene.json <<SCENE
{"kind": "lines", "sampleRateHz": 1000, "durationSeconds": $((count * seconds)), "seed": 4, "noise": {"deviation": 0.1},
 "lines": [{"frequencyHz": 200, "snrDb": -3, "referenceSeconds": 0.5, "wanderHz": 1, "wanderSeconds": 100}]}
SCENE
"$cli" --progress none simulate scene.json --type int16 --out long.wav
python3 - "$count" "$seconds" <<'CUT'
import sys, wave

count, seconds = int(sys.argv[1]), int(sys.argv[2])
with wave.open("long.wav") as whole:
    for i in range(count):
        with wave.open(f"night/{i:06}.wav", "wb") as part:
            part.setparams(whole.getparams())
            part.writeframes(whole.readframes(seconds * whole.getframerate()))
CUT

# processor NAME COMMAND…: runs it, and says what it took.
processor() {
    name=$1
    shift
    python3 - "$name" "$@" <<'TIME'
import resource, subprocess, sys, time

begin = time.monotonic()
subprocess.run(sys.argv[2:], check=True, stdout=subprocess.DEVNULL)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(f"{sys.argv[1]}: {used.ru_utime + used.ru_stime:.1f} s of a processor, {time.monotonic() - begin:.1f} s on the clock")
TIME
}

survey() {
    exec "$cli" --progress none survey night --set spectrogram.windowSeconds=0.5 --jobs 2 --out "$1" >/dev/null
}

# What both calibrate for once.
"$cli" --progress none detect long.wav --set spectrogram.windowSeconds=0.5 --events long.csv
(survey warm.sqlite)
processor "one recording" "$cli" --progress none detect long.wav --set spectrogram.windowSeconds=0.5 --events long.csv
processor "$count recordings" "$cli" --progress none survey night --set spectrogram.windowSeconds=0.5 --jobs 2 --out whole.sqlite

kills=0
while [ "$kills" -lt 3 ]; do
    survey killed.sqlite &
    job=$!
    before=$(stat -c %s killed.sqlite 2>/dev/null || echo 0)
    # Somewhere between the start and a third of the work.
    sleep "$(awk -v n="$count" -v s="$kills" 'BEGIN { srand(s + 1); print 0.5 + rand() * n / 1500 }')"
    if kill -9 "$job" 2>/dev/null; then
        kills=$((kills + 1))
    fi
    wait "$job" 2>/dev/null || true
    echo "killed after $(stat -c %s killed.sqlite 2>/dev/null || echo 0) bytes ($before before)"
done
(survey killed.sqlite)
cmp whole.sqlite killed.sqlite
echo "the same bytes after three kills"
