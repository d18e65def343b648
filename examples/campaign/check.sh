#!/bin/sh
# Test of the README's commands: two shards give the curve of a single run, and a missing shard is reported and computed again.
# check.sh FAINTLINE-CLI FOLDER [sequential, parallel or slurm]. Exit code 77: cannot be run here.
set -eu

export FAINTLINE_CLI=$1
folder=$(realpath -m "$2")
here=$(cd "$(dirname "$0")" && pwd)
experiment=$here/experiment.json
rm -rf "$folder"
mkdir -p "$folder"
"$FAINTLINE_CLI" evaluate "$experiment" --threads 1 --out "$folder/whole.csv"

mergeMissesTheSecond() {
    if sh "$here/merge.sh" 2 "$folder" 2>"$folder/message"; then
        echo "a missing shard was not reported" >&2
        exit 1
    fi
    grep -q 'shards 2 of 2' "$folder/message"
}

case ${3:-sequential} in
parallel)
    command -v parallel >/dev/null || { echo "skipped: GNU parallel is not installed"; exit 77; }
    sh "$here/parallel.sh" "$experiment" 2 "$folder"
    ;;
slurm)
    sh "$here/node.sh" start "$folder/node"
    trap 'sh "$here/node.sh" stop "$folder/node"' EXIT
    export SLURM_CONF="$folder/node/slurm.conf"
    cd "$here"
    submit() { # ARRAY
        EXPERIMENT=$PWD/experiment.json FOLDER=$folder SHARDS=2 timeout 200 sbatch --wait --export=ALL --mem=0 --array="$1" \
            --output="$folder/%A_%a.out" slurm.sh || { cat "$folder"/*.out >&2; exit 1; }
    }
    submit 1
    mergeMissesTheSecond
    submit 2
    sh merge.sh 2 "$folder"
    ;;
*)
    sh "$here/shard.sh" "$experiment" 1 2 "$folder"
    mergeMissesTheSecond
    SLURM_SUBMIT_DIR=$here SLURM_ARRAY_TASK_ID=2 SLURM_ARRAY_TASK_COUNT=2 EXPERIMENT=$experiment FOLDER=$folder sh "$here/slurm.sh"
    sh "$here/merge.sh" 2 "$folder"
    ;;
esac
cmp "$folder/whole.csv" "$folder/curve.csv"
