#!/bin/sh
#SBATCH --job-name=faintline
#SBATCH --array=1-100
#SBATCH --cpus-per-task=1
#SBATCH --mem=1G
#SBATCH --time=04:00:00
#SBATCH --requeue
# A campaign as a job array, one shard a task: EXPERIMENT=… FOLDER=… sbatch --export=ALL slurm.sh, from this folder. Afterwards merge.sh
# lists missing shards; sbatch --array=7,23 slurm.sh runs those again. SHARDS must then contain the total number of shards.
set -eu

exec sh "${SLURM_SUBMIT_DIR:?is set by Slurm: start this with sbatch}/shard.sh" "${EXPERIMENT:?names no experiment}" \
    "$SLURM_ARRAY_TASK_ID" "${SHARDS:-$SLURM_ARRAY_TASK_COUNT}" "${FOLDER:?names no folder for the shards}"
