#!/bin/sh
# Each room used alone: which headers of the project a program of it takes in, and how large its object file is.
# Usage: rooms_alone.sh [COMPILER [FLAGS]]. Fails when a room takes in a header of a later one. FLAGS 'headers': counts these alone, and
# compiles nothing.
set -eu
cd "$(dirname "$0")/.."
compiler=${1:-c++}
flags=${2:--O2 -DNDEBUG}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
printf '%-10s %-28s %8s %8s %10s %10s  %s\n' room program brep/ raycast/ radiosity/ 'code (B)' "with $flags"
measure() { # ROOM PROGRAM FORBIDDEN
    source=examples/$2.cpp
    "$compiler" -std=c++20 -DHALFLIGHT_HEADER_ONLY -I. -MM "$source" | tr ' ' '\n' >"$folder/headers"
    code=-
    if [ "$flags" != headers ]; then
        "$compiler" -std=c++20 -DHALFLIGHT_HEADER_ONLY -I. $flags -c "$source" -o "$folder/object"
        code=$(size "$folder/object" | awk 'NR == 2 { print $1 }')
    fi
    of() { grep -c "^$1/" "$folder/headers" || true; }
    printf '%-10s %-28s %8s %8s %10s %10s\n' "$1" "$source" "$(of brep)" "$(of raycast)" "$(of radiosity)" "$code"
    if [ -n "$3" ] && grep -E "^($3)/" "$folder/headers"; then
        echo "$source takes in headers of a later room" >&2
        exit 1
    fi
}
measure brep 010_first_cube 'raycast|radiosity|apps'
measure raycast 105_one_ray 'radiosity|apps'
measure radiosity 110_two_plates apps
