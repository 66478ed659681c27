#!/bin/sh
# Installs what is missing, builds the program, solves the Cornell box and says where the results are.
# Usage: sh examples/quickstart.sh [FOLDER]      (default: build/quickstart)
set -eu
cd "$(dirname "$0")/.."
out=${1:-build/quickstart}
sh .ci/install g++ cmake ninja-build libglm-dev libstb-dev libcli11-dev
cmake --preset release
cmake --build --preset release --target halflight
mkdir -p "$out"
build/release/apps/halflight render examples/scenes/cornell.scene \
    -o "$out/cornell.png" -o "$out/cornell.ply" --json "$out/cornell.json"
echo "results: $out/cornell.png $out/cornell.ply $out/cornell.json"
