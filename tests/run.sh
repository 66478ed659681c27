#!/bin/sh
# Installs what is missing, builds a release with all tests and examples, and runs them. To run none is a failure.
set -eu
cd "$(dirname "$0")/.."
sh .ci/install g++ cmake ninja-build libglm-dev libstb-dev libcli11-dev catch2
cmake --preset release
cmake --build --preset release
ctest --preset release -j "$(nproc)" --no-tests=error
