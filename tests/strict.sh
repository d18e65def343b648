#!/bin/sh
# Everything under the sanitizers; fails where a test does, or where a sanitizer has something to say:
#     sh tests/strict.sh [asan|tsan|all] [CTEST-ARGUMENT...]
# asan: AddressSanitizer and UndefinedBehaviorSanitizer over core, command line, widgets and window, and every test, the hostile files among
# them. tsan: ThreadSanitizer over what computes on threads: recursion, thread pool, streaming, previews, calibrations, campaigns, the window's
# jobs. Qt and the other libraries of the system are not instrumented: what goes through Qt's queue from thread to thread is seen by asan only.
# `sh tests/strict.sh asan -R tst_Axis` builds everything, and runs one test. What is no finding stands in leaks.supp and races.supp.
set -eu

cd "$(dirname "$0")/.."
threaded="parallel Recursion advance Smd Fft AudioRecording analyse previewStatistic outputLayers StateReplay closeup bandCalibration Campaign
    SweepExperiment simulate JobRunner durability killed cliStreams listen LiveHistory networkSources SoundSource SourceClock"

usage() {
    sed -n '2,/^set -eu/s/^# //p' "$0"
}

words() { # PREFIX SEPARATOR: of the threaded tests
    echo $threaded | sed "s/^/$1/; s/ /$2$1/g"
}

configure() { # a folder of an earlier run may have been made with other flags or time limits
    cmake --preset "$1" > /dev/null
}

# A calibration depends on the core's sources alone, and takes most of the time of many tests: those of an ordinary build are taken over where
# memory is looked at. Where threads are, each is made anew.
takeCalibrations() { # PRESET
    mkdir -p "build-$1/tests/cache"
    cp -n build/tests/cache/calibration-* "build-$1/tests/cache" 2> /dev/null || true
}

run() { # PRESET, ctest's arguments
    preset=$1
    shift
    ctest --test-dir "build-$preset" --output-on-failure -j2 "$@"
}

asan() {
    configure asan && cmake --build build-asan && takeCalibrations asan && run asan "$@"
}

tsan() {
    configure tsan && cmake --build build-tsan --target faintline-cli $(words tst_ ' ') && run tsan -R "^($(words tst_ '|'))\$" "$@"
}

which=${1:-all}
[ $# -gt 0 ] && shift
case $which in
asan | tsan | all) ;;
-h | --help)
    usage
    exit
    ;;
*)
    usage >&2
    exit 2
    ;;
esac

# The C library's own allocator lets a large request fail, which tests ask for; sanitizers would end the program.
export ASAN_OPTIONS="allocator_may_return_null=1:detect_leaks=1:${ASAN_OPTIONS:-}"
export LSAN_OPTIONS="suppressions=$PWD/tests/leaks.supp:print_suppressions=0:${LSAN_OPTIONS:-}"
export UBSAN_OPTIONS="print_stacktrace=1:${UBSAN_OPTIONS:-}"
export TSAN_OPTIONS="halt_on_error=1:second_deadlock_stack=1:suppressions=$PWD/tests/races.supp:${TSAN_OPTIONS:-}"

sh cmake/setup.sh
failed=
case $which in
asan | all) asan "$@" || failed=asan ;;
esac
case $which in
tsan | all) tsan "$@" || failed="$failed tsan" ;;
esac
[ -z "$failed" ] || {
    echo "error: tests/strict.sh: failed under" $failed >&2
    exit 1
}
