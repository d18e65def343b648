#!/bin/sh
# Checks layout, documentation and common mistakes as described in CONTRIBUTING:
#     sh tests/style.sh                  fails if clang-format would change a file, or if doxygen reports a warning for a public header or a
#                                        page of docs
#     sh tests/style.sh tidy [PATH...]   fails if clang-tidy reports anything in these folders or files; by default core/base, core/model and
#                                        core/track
set -eu

cd "$(dirname "$0")/.."

need() {
    command -v "$1" > /dev/null || {
        echo "error: tests/style.sh: needs $1 (on Debian: apt-get install $1)" >&2
        exit 1
    }
}

layout() {
    need clang-format
    need doxygen
    git ls-files '*.h' '*.cpp' | xargs clang-format --dry-run --Werror
    mkdir -p build
    doxygen docs/Doxyfile
}

# One process for each processor; clang does not know GCC's own warnings.
tidy() {
    need clang-tidy
    [ $# -gt 0 ] || set -- core/base core/model core/track
    cmake --preset tidy > /dev/null
    find "$@" -name '*.cpp' | sort | xargs -P "$(nproc)" -n 1 \
        clang-tidy -p build-tidy --quiet --warnings-as-errors='*' --extra-arg=-Wno-unknown-warning-option
}

case ${1:-} in
'') layout ;;
tidy)
    shift
    tidy "$@"
    ;;
*)
    sed -n '2,/^set -eu/s/^# //p' "$0" >&2
    exit 2
    ;;
esac
