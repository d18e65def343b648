#!/bin/sh
# Runs everything under the sanitizers; fails if a test fails or a sanitizer reports an error:
#     sh tests/strict.sh [asan|tsan|all] [CTEST-ARGUMENT...]
# asan: AddressSanitizer and UndefinedBehaviorSanitizer over core, command line, widgets and window, and every test, including hostile
# files. tsan: ThreadSanitizer over multi-threaded code: recursion, thread pool, streaming, previews, calibrations, campaigns, the window's
# jobs. Qt and the other system libraries are not instrumented, so data that passes between threads through Qt's event queue is checked by asan only.
# `sh tests/strict.sh asan -R tst_Axis` builds everything, and runs one test. False positives are listed in leaks.supp and races.supp.
set -eu

cd "$(dirname "$0")/.."
threaded="parallel Recursion advance Smd Fft AudioRecording analyse previewStatistic outputLayers StateReplay closeup bandCalibration Campaign
    SweepExperiment simulate JobRunner durability killed cliStreams listen LiveHistory networkSources SoundSource SourceClock"

usage() {
    sed -n '2,/^set -eu/s/^# //p' "$0"
}

programs="tests-base tests-signal tests-frames tests-track tests-analyse tests-inspect tests-evaluate tests-cli tests-jobs" # that hold them

configure() { # an existing folder may have other flags or time limits
    cmake --preset "$1" > /dev/null
}

# Calibrations depend only on the core's sources and take most of the time of many tests, so asan uses those of an ordinary build. tsan computes
# its own.
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
    # shellcheck disable=SC2086 # one word per program, and per test
    configure tsan && cmake --build build-tsan --target faintline-cli $programs && run tsan -R "^tst_($(echo $threaded | tr ' ' '|'))\$" "$@"
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

# Some tests request too much memory. The C library's allocator then returns an error; sanitizers would end the program.
export ASAN_OPTIONS="allocator_may_return_null=1:detect_leaks=1:${ASAN_OPTIONS:-}"
export LSAN_OPTIONS="suppressions=$PWD/tests/leaks.supp:print_suppressions=0:${LSAN_OPTIONS:-}"
export UBSAN_OPTIONS="print_stacktrace=1:${UBSAN_OPTIONS:-}"
# The sound source's test starts a sound server while its own threads run.
export TSAN_OPTIONS="halt_on_error=1:die_after_fork=0:second_deadlock_stack=1:suppressions=$PWD/tests/races.supp:${TSAN_OPTIONS:-}"

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
