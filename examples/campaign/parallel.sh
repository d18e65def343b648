#!/bin/sh
# A campaign on all processors of this machine, or of several with GNU parallel's --sshlogin: parallel.sh EXPERIMENT N FOLDER
set -eu

[ $# -eq 3 ] || { echo "error: parallel.sh: needs EXPERIMENT N FOLDER" >&2; exit 2; }
here=$(dirname "$0")
command -v parallel >/dev/null || { echo "error: parallel.sh: GNU parallel is not installed" >&2; exit 1; }
seq "$2" | parallel --halt soon,fail=20% --retries 2 sh "$here/shard.sh" "$1" {} "$2" "$3"
sh "$here/merge.sh" "$2" "$3"
