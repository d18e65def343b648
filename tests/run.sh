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

lane='-LE long|walks'
case ${1:-} in
long | walks)
    lane="-L $1"
    shift
    ;;
esac

sh cmake/setup.sh ccache parallel slurm-wlm python3-h5py bitshuffle xvfb openbox xdotool || exit 1 # campaigns, readers and walks are tried with them
[ -f build/build.ninja ] || cmake --preset release >build/configure.log || fail "configuring"
NINJA_STATUS='Building, %p, %e s: ' cmake --build build || fail "the build"
# shellcheck disable=SC2086 # two words
ctest --test-dir build --output-on-failure -j2 $lane "$@"
