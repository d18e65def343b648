#!/bin/sh
# Sets the machine up, builds everything and runs every test. Arguments go to ctest: `sh tests/run.sh -R tst_Axis`.
set -eu

cd "$(dirname "$0")/.."

fail() {
    echo "error: tests/run.sh: $1 failed" >&2
    exit 1
}

sh cmake/setup.sh parallel slurm-wlm python3-h5py bitshuffle xvfb openbox xdotool || exit 1 # campaigns, readers and walks are tried with them
[ -f build/build.ninja ] || cmake --preset release || fail "configuring"
cmake --build build || fail "the build"
ctest --test-dir build --output-on-failure -j2 "$@"
