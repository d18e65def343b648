#!/bin/sh
# same.sh A B: both programs print the same.
set -eu

a=$("$1")
b=$("$2")
[ "$a" = "$b" ] && exit 0
echo "$a"
echo "differs from"
echo "$b"
exit 1
