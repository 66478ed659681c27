#!/bin/sh
# Light between surfaces that do not shine: links against stored rays, on scenes of 19 to 10 000 input faces, each at two or three settings.
# Prints a row a run: CPU seconds (without the audit), links, measured errors of the surfaces and of the leaves.
#
#   sh tests/bench/indirect.sh [PROGRAM]      default: build/release/apps/halflight
set -eu
cd "$(dirname "$0")/../.."
program=$(realpath "${1:-build/release/apps/halflight}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for quads in 108 990 10006; do sh examples/scenes/make_scenes.sh office $quads > "$work/office_$quads.scene"; done
echo '| scene | epsilon | by | CPU s | links | surfaces | leaves |'
echo '| --- | ---: | --- | ---: | ---: | ---: | ---: |'
for scene in examples/scenes/cornell examples/scenes/room examples/scenes/boxes examples/scenes/primitives examples/scenes/nested_rooms \
  "$work/office_108" "$work/office_990" "$work/office_10006"; do
  for epsilon in 0.02 0.005; do
    case $scene in *10006) [ $epsilon = 0.02 ] || continue ;; esac
    for by in links rays; do
      "$program" render "$scene.scene" --indirect $by --epsilon $epsilon --threads 1 --audit 4000 --quiet -o "$work/out.ply" | awk -v scene="$(basename "$scene")" \
        -v epsilon=$epsilon -v by=$by '
        function after(name) { sub("^ *" name " +", ""); sub(/ %.*/, " %"); return $0 }
        /^  surfaces  / { surfaces = after("surfaces") }
        /^  leaf constants/ { leaves = after("leaf constants") }
        /^  total / { cpu = $3 }
        /^  links  / { sub(/^ *links +/, ""); sub(/[;,].*/, ""); links = $0 }
        END { printf "| %s | %s | %s | %.2f | %s | %s | %s |\n", scene, epsilon, by, cpu, links, surfaces, leaves }'
    done
  done
done
