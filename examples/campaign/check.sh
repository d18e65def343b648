#!/bin/sh
# What the README says, with two shards: they give the curve of one run, and one that was lost is found missing and made again.
# check.sh FAINTLINE-CLI FOLDER [parallel]: with GNU parallel, or one shard after the other. 77: cannot be tried here.
set -eu

export FAINTLINE_CLI=$1
folder=$2
here=$(dirname "$0")
experiment=$here/experiment.json
rm -rf "$folder"
mkdir -p "$folder"
"$FAINTLINE_CLI" evaluate "$experiment" --threads 1 --out "$folder/whole.csv"

if [ "${3:-}" = parallel ]; then
    command -v parallel >/dev/null || { echo "skipped: GNU parallel is not installed"; exit 77; }
    sh "$here/parallel.sh" "$experiment" 2 "$folder"
else
    sh "$here/shard.sh" "$experiment" 1 2 "$folder"
    if sh "$here/merge.sh" 2 "$folder" 2>"$folder/message"; then
        echo "a lost shard went unnoticed" >&2
        exit 1
    fi
    grep -q 'shards 2 of 2' "$folder/message"
    SLURM_SUBMIT_DIR=$here SLURM_ARRAY_TASK_ID=2 SLURM_ARRAY_TASK_COUNT=2 EXPERIMENT=$experiment FOLDER=$folder sh "$here/slurm.sh"
    sh "$here/merge.sh" 2 "$folder"
fi
cmp "$folder/whole.csv" "$folder/curve.csv"
