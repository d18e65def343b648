#!/bin/sh
# Checks layout and documentation as described in CONTRIBUTING: sh tests/style.sh
# Fails if clang-format would change a file, or if doxygen reports a warning for a public header or a page of docs.
set -eu

cd "$(dirname "$0")/.."
for tool in clang-format doxygen; do
    command -v "$tool" >/dev/null || {
        echo "error: tests/style.sh: needs $tool (on Debian: apt-get install $tool)" >&2
        exit 1
    }
done
git ls-files '*.h' '*.cpp' | xargs clang-format --dry-run --Werror
mkdir -p build
doxygen docs/Doxyfile
