#!/bin/sh
# Installs the core's library and headers, then builds and runs an example with them: try.sh CMAKE BUILD FOLDER
set -eu
cmake=$1 build=$2 folder=$3
here=$(cd "$(dirname "$0")" && pwd)

rm -rf "$folder"
"$cmake" --install "$build" --component development --prefix "$folder/prefix" >/dev/null
"$cmake" -S "$here" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$folder/prefix"
"$cmake" --build "$folder/build"
"$folder/build/example"
