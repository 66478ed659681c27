#!/bin/sh
# Installs what is missing, builds a release with all tests and examples, and runs them. To run none is a failure.
# Random tests have the same numbers in each run, so that a failure is what a change brought; `HALFLIGHT_TEST_SEED= sh tests/run.sh`, as
# ctest alone, draws new ones.
set -eu
export HALFLIGHT_TEST_SEED="${HALFLIGHT_TEST_SEED-20240607}"
cd "$(dirname "$0")/.."
sh .ci/install g++ cmake ninja-build libglm-dev libstb-dev libcli11-dev catch2
cmake --preset release
cmake --build --preset release
ctest --preset release -j "$(nproc)" --no-tests=error
