#!/bin/sh
# Asks every scene for an audited relative L2 error over all surfaces (default 0.02): what the audit measured, links, and CPU seconds of all rounds
# and audits.
#     sh examples/accuracy_targets.sh [ERROR [SCENE ...]]
set -eu
cd "$(dirname "$0")/.."
halflight=build/release/apps/halflight
if [ ! -x "$halflight" ]; then
    echo "$halflight is not built; sh examples/quickstart.sh builds it" >&2
    exit 1
fi
error=${1:-0.02}
[ $# -gt 0 ] && shift
[ $# -gt 0 ] || set -- examples/scenes/*.scene
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
printf '%-24s %-34s %12s %10s  %s\n' scene "error of the surfaces" links "CPU s" verdict
for scene in "$@"; do
    verdict=met
    "$halflight" render "$scene" --error "$error" --threads 1 --quiet -o "$place/a.ply" > "$place/report" 2> "$place/fault" || verdict="not met"
    measured=$(sed -n 's/^  surfaces   *\(.*[^ ]\) *$/\1/p' "$place/report" | head -1)
    links=$(sed -n 's/^  links   *\([0-9 ]*[0-9]\).*/\1/p' "$place/report" | head -1)
    seconds=$(awk '$1 == "total" { a = $3 } $1 == "audit" { a += $4 } END { print a }' "$place/report")
    printf '%-24s %-34s %12s %10s  %s\n' "$(basename "$scene" .scene)" "${measured:--}" "${links:--}" "$seconds" "$verdict"
done
