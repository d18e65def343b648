#!/bin/sh
# One shard of a campaign: shard.sh EXPERIMENT I N FOLDER, I = 1 … N. Complete shards are skipped, and a shard that was killed continues
# where it stopped, so an interrupted campaign can simply be started again.
set -eu

[ $# -eq 4 ] || { echo "error: shard.sh: needs EXPERIMENT I N FOLDER" >&2; exit 2; }
experiment=$1 i=$2 n=$3 folder=$4
mkdir -p "$folder"
[ -s "$folder/shard-$i.jsonl" ] && exit 0
# One thread per shard, because as many shards run at a time as the machine has processors.
exec "${FAINTLINE_CLI:-faintline-cli}" evaluate "$experiment" --shard "$i/$n" --threads 1 --out "$folder/shard-$i.jsonl"
