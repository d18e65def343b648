#!/bin/sh
# A Slurm cluster of one node, for testing job arrays: node.sh start FOLDER, then SLURM_CONF=FOLDER/slurm.conf; node.sh stop FOLDER.
# Exit code 77: Slurm is not installed or cannot be started.
set -eu

folder=$(realpath -m "$2")
give() { echo "skipped: $1"; sh "$0" stop "$folder" || true; exit 77; }

stop() {
    for name in slurmd slurmctld munged; do
        [ -s "$folder/$name.pid" ] && kill "$(cat "$folder/$name.pid")" 2>/dev/null || true
    done
}

start() {
    for program in slurmctld slurmd munged sbatch; do
        command -v $program >/dev/null || [ -x /usr/sbin/$program ] || give "$program is not installed"
    done
    rm -rf "$folder"
    mkdir -p "$folder/state" "$folder/spool"
    chmod 755 "$folder"
    PATH=$PATH:/usr/sbin
    host=$(hostname -s)
    cpus=$(nproc)
    head -c 1024 /dev/urandom >"$folder/munge.key"
    chmod 600 "$folder/munge.key"
    munged --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" --pid-file="$folder/munged.pid" \
        --log-file="$folder/munged.log" --seed-file="$folder/munge.seed" >/dev/null 2>&1 || give "munged does not start"
    port=$((20000 + $$ % 20000))
    cat >"$folder/slurm.conf" <<END
ClusterName=one
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CryptoType=crypto/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
MpiDefault=none
SchedulerParameters=sched_interval=1
NodeName=$host NodeAddr=127.0.0.1 CPUs=$cpus State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
END
    export SLURM_CONF="$folder/slurm.conf"
    slurmctld >/dev/null 2>&1 || give "slurmctld does not start"
    slurmd >/dev/null 2>&1 || give "slurmd does not start"
    tries=0
    until sinfo -h -o %t 2>/dev/null | grep -q '^idle$'; do
        tries=$((tries + 1))
        [ $tries -lt 60 ] || give "the node does not come up: $(tail -n 1 "$folder/slurmd.log" "$folder/slurmctld.log" 2>&1 | tr '\n' ' ')"
        sleep 0.5
    done
}
$1
