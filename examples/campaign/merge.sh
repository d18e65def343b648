#!/bin/sh
# Merges the N shards in a folder: merge.sh N FOLDER writes FOLDER/curve.csv, the same bytes as without shards.
set -eu

[ $# -eq 2 ] || { echo "error: merge.sh: needs N FOLDER" >&2; exit 2; }
n=$1 folder=$2 i=1 missing=
set --
while [ "$i" -le "$n" ]; do
    [ -s "$folder/shard-$i.jsonl" ] || missing="$missing $i"
    set -- "$@" "$folder/shard-$i.jsonl"
    i=$((i + 1))
done
if [ -n "$missing" ]; then
    echo "error: merge.sh: missing in $folder; run them again: shards$missing of $n" >&2
    exit 2
fi
exec "${FAINTLINE_CLI:-faintline-cli}" evaluate merge "$@" --out "$folder/curve.csv"
