#!/bin/sh
# Checks layout, documentation and common mistakes as described in CONTRIBUTING:
#     sh tests/style.sh                  fails if clang-format would change a file, if doxygen reports a warning for a public header or a
#                                        page of docs, or if a header of the core does not compile alone
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

# By syntax only, one process for each processor.
loneHeaders() {
    git ls-files 'core/*.h' 'reproduce/*.h' | xargs -P "$(nproc)" -I HEADER sh -c 'echo "#include \"HEADER\"" |
        g++ -std=c++20 -fsyntax-only -Wall -Wextra -Werror -I . -I core -isystem /usr/include/eigen3 -x c++ -'
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
'')
    layout
    loneHeaders
    ;;
tidy)
    shift
    tidy "$@"
    ;;
*)
    sed -n '2,/^set -eu/s/^# //p' "$0" >&2
    exit 2
    ;;
esac
