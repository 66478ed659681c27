#!/usr/bin/env bash
# CPU seconds (user and system) to compile from an empty folder, without a compiler cache: the program, then the tests and examples on top; the
# front end of the facade; a small program of a user. Figures of another state: run that one's checkout with this file.
#     bash tests/bench/build_time.sh [CHECKOUT]
set -euo pipefail
cd "${1:-$(dirname "$0")/../..}"
export CCACHE_DISABLE=1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
TIMEFORMAT='%U %S'
seconds() { # WHAT COMMAND...
    local what=$1
    shift
    local used
    used=$({ time "$@" > "$folder/log" 2>&1; } 2>&1) || { cat "$folder/log" >&2; exit 1; }
    awk -v what="$what" '{ printf "%-44s %8.1f s\n", what, $1 + $2 }' <<< "$used"
}
cmake -S . -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release > "$folder/log"
seconds "the program" cmake --build "$folder/build" --target halflight
seconds "tests and examples on top of it" cmake --build "$folder/build"
echo '#include <radiosity/radiosity.hpp>' > "$folder/facade.cpp"
seconds "front end of radiosity/radiosity.hpp" c++ -std=c++20 -I. -fsyntax-only "$folder/facade.cpp"
seconds "examples/110_two_plates.cpp, to be linked" c++ -std=c++20 -O2 -I. -c examples/110_two_plates.cpp -o "$folder/two_plates.o"
