#!/bin/sh
# The paper's figures 6 to 8 as one command: a cylinder under a superquadric that shadows itself, reconstructed with weights by normals
# (fig. 5), simply, and not at all. Usage: reconstructions.sh [FOLDER], where the pictures go; by default build/reconstructions.
set -eu
cd "$(dirname "$0")/.."
folder=${1:-build/reconstructions}
halflight=build/release/apps/halflight
if [ ! -x "$halflight" ]; then
    sh .ci/install g++ cmake ninja-build libglm-dev libstb-dev libcli11-dev catch2
    cmake --preset release >/dev/null
    cmake --build --preset release --target halflight
fi
mkdir -p "$folder"
for kind in weighted simple constant; do
    "$halflight" render examples/scenes/paper_figure.scene -o "$folder/$kind.png" --epsilon 0.02 --min-area 2e-4 --reconstruction "$kind" \
        --audit 0 --quiet | sed -n '/^written/p'
done
