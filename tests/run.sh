#!/bin/sh
# Sets the machine up, builds everything and runs the tests:
#     sh tests/run.sh [ARGUMENT…]         the quick ones; arguments go to ctest: `sh tests/run.sh -R tst_Axis`
#     sh tests/run.sh long [ARGUMENT…]    those whose subject is an error rate, in full
#     sh tests/run.sh walks [ARGUMENT…]   those with mouse and keys, each on an X display of its own
set -eu

cd "$(dirname "$0")/.."

fail() {
    echo "error: tests/run.sh: $1 failed" >&2
    exit 1
}

lane=quick
labels='-LE long|walks'
case ${1:-} in
long | walks)
    lane=$1
    labels="-L $1"
    shift
    ;;
esac

sh cmake/setup.sh ccache parallel slurm-wlm python3-h5py bitshuffle xvfb openbox xdotool || exit 1 # campaigns, readers and walks are tried with them
[ -f build/build.ninja ] || cmake --preset release >build/configure.log || fail "configuring"
NINJA_STATUS='Building, %p, %e s: ' cmake --build build || fail "the build"

# What tests can depend on: every file of the tree, how it was configured and what is installed.
state() {
    {
        find . \( -path ./build -o -path ./.git \) -prune -o -type f -print0 | sort -z | xargs -0 sha256sum
        sha256sum build/CMakeCache.txt
        dpkg-query --show
    } | sha256sum
}

before=$(state)
passed=build/tests/passed-$lane
if [ $# -eq 0 ] && [ "$before" = "$(cat "$passed" 2>/dev/null)" ]; then
    echo "Nothing has changed since all of these tests passed, $(date -r "$passed" '+%F %R'). To run them again: rm $passed"
    exit 0
fi
# shellcheck disable=SC2086 # two words
ctest --test-dir build --output-on-failure -j2 $labels "$@"
[ $# -gt 0 ] || echo "$before" >"$passed"
