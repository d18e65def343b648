#!/bin/sh
# What the programs make of some forty inputs, as one line of hash and name each, to be compared before and after a change
# that must change nothing:
#     sh tests/baseline.sh build/app > before
#     sh tests/baseline.sh build/app | diff before -
# Recordings of ../shared are among the inputs where they are present. The files stay in the folder BASELINE_OUT, if it is given.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
programs=$(cd "${1:?usage: baseline.sh FOLDER_OF_PROGRAMS}" && pwd)
cli=$programs/faintline-cli
export QT_QPA_PLATFORM=offscreen

out=${BASELINE_OUT:-$(mktemp -d)}
[ -n "${BASELINE_OUT:-}" ] || trap 'rm -rf "$out"' EXIT
mkdir -p "$out"
cd "$out"

# made NAME FILE COMMAND…: the hash of the file, or that it was not made.
made() {
    name=$1
    file=$2
    shift 2
    "$@" >/dev/null 2>"$name.said" || true
    if [ -f "$file" ]; then sha256sum "$file" | sed "s|  .*|  $name $(basename "$file")|"; else echo "none  $name: $(tail -n 1 "$name.said")"; fi
}

# detected NAME INPUT OPTION…: events and tracks
detected() {
    name=$1
    shift
    made "$name" "$name.events.csv" "$cli" detect "$@" --events "$name.events.csv" --tracks "$name.tracks.csv"
    [ ! -f "$name.tracks.csv" ] || sha256sum "$name.tracks.csv"
}

for scene in faint-drifting-line lines-on-coloured-noise wandering-fading-line; do
    made "$scene" $scene.wav "$cli" simulate "$root/resources/scenarios/$scene.json" --out $scene.wav --truth $scene.truth.json
    detected $scene-default $scene.wav
done
line=faint-drifting-line.wav
made statistic D.npy "$cli" detect $line --set spectrogram.windowSeconds=0.25 --statistic D.npy
for kind in pOfN integrator energy blockViterbi shiryaevRoberts; do
    detected $kind $line --set spectrogram.windowSeconds=0.25 --set detector.kind=$kind
done
for preset in $("$cli" describe | sed -n 's/^preset //p'); do
    detected "preset-$preset" $line --preset "$preset" --set spectrogram.windowSeconds=0.25
done
detected causal $line --set spectrogram.windowSeconds=0.5 --set noise.causal=true
detected family lines-on-coloured-noise.wav --set spectrogram.windowSeconds=0.5 --set family.relation=harmonics --set family.members=1,2,3
detected subtraction lines-on-coloured-noise.wav --set spectrogram.windowSeconds=0.5 --set decide.falseAlarmsPerHour=10
made listen listen.csv sh -c "'$cli' listen - --set spectrogram.windowSeconds=0.5 --events listen.csv <$line"
made explain explain.json sh -c "'$cli' explain $line --set spectrogram.windowSeconds=0.25 --time 100 --frequency 100 --json >explain.json"
made straighten straight.wav "$cli" straighten $line --event 1 --out straight.wav
for scene in sonar-crossing-targets open-sea radar-surveillance; do
    detected $scene "$root/resources/scenarios/$scene.json"
done
mkdir -p folder && cp ./*.wav folder && rm -f folder/straight.wav
made survey survey.csv sh -c "'$cli' survey folder --out survey.sqlite --set spectrogram.windowSeconds=0.5 && '$cli' survey export survey.sqlite --events survey.csv"
recordings=$root/../shared/recordings
if [ -d "$recordings" ]; then
    for file in "$recordings"/*.wav "$recordings"/*.flac "$recordings"/*.ogg "$recordings"/s5*.sigmf-meta; do
        case $file in *_iq.wav) iq=--iq ;; *) iq= ;; esac
        # shellcheck disable=SC2086 # a word or none
        detected "$(basename "$file" | cut -d_ -f1)" "$file" $iq
    done
fi
if [ -x "$programs/faintline" ]; then
    made window window.png "$programs/faintline" render $line --out window.png
    for view in input output threshold events noise why spectrum slice; do
        made $view $view.png "$programs/faintline" render $line --set spectrogram.windowSeconds=0.25 --view $view --time 100 --frequency 100 --out $view.png
    done
    for theme in light dark contrast; do
        made sonar-$theme sonar-$theme.png "$programs/faintline" render "$root/resources/scenarios/sonar-crossing-targets.json" --theme $theme --out sonar-$theme.png
    done
    made radar radar.png "$programs/faintline" render "$root/resources/scenarios/radar-surveillance.json" --out radar.png
    made lesson lesson.png "$programs/faintline" render "$root/resources/lessons/cell.json" --out lesson.png
fi
