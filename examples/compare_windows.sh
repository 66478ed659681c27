#!/bin/sh
# The room with windows cut out of one block, and the same room from separate polygons, solved ever finer: what each needs for its measured
# error. Prints a table; pictures and reports go to the folder OUT. Takes two minutes of CPU time.
#
#     sh examples/compare_windows.sh [OUT [EPSILON...]]        (default . 0.04 0.02 0.01)
set -eu
here=$(cd "$(dirname "$0")" && pwd)
program=${HALFLIGHT:-$here/../build/release/apps/halflight}
out=${1:-.}
[ $# -gt 0 ] && shift
[ $# -gt 0 ] || set -- 0.04 0.02 0.01

value() { sed -n "s/^ *\"$2\": \([^,]*\),*\$/\1/p" "$1" | sed -n "${3:-1}p"; }  # of the first key of this name, or of the $3rd

echo "polygons: with which the solver starts, a wall with windows is one; lines: of the scene file; error: over all surfaces, by path tracing"
printf '%-15s %7s %8s %5s %8s %7s %9s %7s  %s\n' scene epsilon polygons lines links leaves rays 'CPU s' error
for epsilon; do
  for scene in windows windows_pieced; do
    "$program" render "$here/scenes/$scene.scene" -o "$out/$scene.png" --json "$out/$scene.json" --epsilon "$epsilon" --min-area 1e-4 \
      --audit 20000 --quiet >"$out/$scene.txt"
    printf '%-15s %7s %8s %5s %8s %7s %9s %7.2f  %.4f +- %.4f\n' "$scene" "$epsilon" "$(value "$out/$scene.json" polygons)" \
      "$(grep -cv '^ *\(#.*\)\{0,1\}$' "$here/scenes/$scene.scene")" "$(value "$out/$scene.json" links)" \
      "$(value "$out/$scene.json" leaves)" "$(value "$out/$scene.json" rays 3)" "$(value "$out/$scene.json" total)" \
      "$(value "$out/$scene.json" relative_l2)" "$(value "$out/$scene.json" standard_error)"
  done
done
