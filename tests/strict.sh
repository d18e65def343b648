#!/bin/sh
# Everything under the sanitizers: sh tests/strict.sh [asan|tsan|all] [CTEST-ARGUMENT...]
# asan: AddressSanitizer and UndefinedBehaviorSanitizer over core, command line, widgets and window, and every test, the hostile files among
# them. tsan: ThreadSanitizer over what computes on threads: recursion, thread pool, streaming, previews, campaigns. Qt and the other libraries
# of the system are not instrumented, so the window's own threads (JobRunner) are covered by asan only.
set -eu

cd "$(dirname "$0")/.."
which=${1:-all}
[ $# -gt 0 ] && shift
threads='^tst_(parallel|Recursion|advance|Smd|AudioRecording|analyse|previewStatistic|outputLayers|StateReplay|Campaign|SequentialStudy|durability|killed)$'

run() { # PRESET, ctest's arguments
    preset=$1
    shift
    [ -f "build-$preset/build.ninja" ] || cmake --preset "$preset"
    cmake --build "build-$preset"
    ctest --test-dir "build-$preset" --output-on-failure -j2 "$@"
}

# The C library's own allocator lets a large request fail, which tests ask for; sanitizers would end the program.
export ASAN_OPTIONS="allocator_may_return_null=1:detect_leaks=1:${ASAN_OPTIONS:-}"
export LSAN_OPTIONS="suppressions=$PWD/tests/leaks.supp:print_suppressions=0:${LSAN_OPTIONS:-}"
export UBSAN_OPTIONS="print_stacktrace=1:${UBSAN_OPTIONS:-}"
export TSAN_OPTIONS="halt_on_error=1:second_deadlock_stack=1:${TSAN_OPTIONS:-}"
case $which in
asan) run asan "$@" ;;
tsan) run tsan -R "$threads" "$@" ;;
all)
    run asan "$@"
    run tsan -R "$threads" "$@"
    ;;
*)
    echo "error: tests/strict.sh: asan, tsan or all" >&2
    exit 2
    ;;
esac
