#!/bin/sh
# sh examples/exercises/check.sh 7 MINE.hpp: compiles and tests a programming exercise; without a file, as it stands here.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
test=$(ls "$here/0$1"_*_test.cpp)
mine=${2:-${test%_test.cpp}.hpp}
mine=$(cd "$(dirname "$mine")" && pwd)/$(basename "$mine")
program=$(mktemp)
trap 'rm -f "$program"' EXIT
${CXX:-c++} -std=c++20 -O1 -DHALFLIGHT_HEADER_ONLY -DEXERCISE="\"$mine\"" -I "$here/../.." "$test" -pthread -o "$program"
"$program"
