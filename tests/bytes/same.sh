#!/bin/sh
# same.sh A B: fails unless both programs print the same, A with every vector width of this processor.
set -eu

expected=$("$2")
for bytes in 16 32 64; do
    found=$(FAINTLINE_VECTOR_BYTES=$bytes "$1")
    [ "$found" = "$expected" ] && continue
    echo "$found"
    echo "with vectors of $bytes bytes differs from"
    echo "$expected"
    exit 1
done
