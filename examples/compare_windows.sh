#!/bin/sh
# The room with windows cut out of one block, and the same room from separate polygons, solved to the same measured error: what each
# needs. Prints a table; pictures and reports go to the folder OUT.
#
#     sh examples/compare_windows.sh [ERROR [OUT]]        (default 0.03 and .)
set -eu
here=$(cd "$(dirname "$0")" && pwd)
program=${HALFLIGHT:-$here/../build/release/apps/halflight}
error=${1:-0.03}
out=${2:-.}

value() { sed -n "s/^ *\"$2\": \([^,]*\),*\$/\1/p" "$1" | sed -n "${3:-1}p"; }  # of the first key of this name, or of the $3rd

printf '%-18s %8s %9s %7s %9s %8s %9s\n' scene objects polygons lines links leaves 'CPU s'
for scene in windows windows_pieced; do
  "$program" mesh "$here/scenes/$scene.scene" --json >"$out/$scene.mesh.json"
  "$program" render "$here/scenes/$scene.scene" -o "$out/$scene.png" --json "$out/$scene.json" --error "$error" --quiet >"$out/$scene.txt"
  # Lines of the scene file without comments; polygons with which the solver starts, faces with holes cut into convex parts.
  printf '%-18s %8s %9s %7s %9s %8s %9.2f   error %.4f +- %.4f\n' "$scene" \
    "$(grep -c '"kind"' "$out/$scene.mesh.json")" "$(value "$out/$scene.mesh.json" faces '$')" \
    "$(grep -cv '^ *\(#.*\)\{0,1\}$' "$here/scenes/$scene.scene")" \
    "$(value "$out/$scene.json" links)" "$(value "$out/$scene.json" leaves)" "$(value "$out/$scene.json" total)" \
    "$(value "$out/$scene.json" relative_l2)" "$(value "$out/$scene.json" standard_error)"
done
