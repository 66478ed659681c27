#!/bin/sh
# An interior as other programs write it, one OBJ file of triangles with its MTL: a room whose walls are grids, tables with chairs, shelves
# of books, bowls and fruit that are round by many small triangles, lamps in the ceiling or bulbs (of 960 triangles, or 7920). Prints what
# a run at default settings takes, as a report alone and with a picture.
#
#   sh tests/bench/interior.sh [TRIANGLES [LAMPS [PROGRAM]]]      100000, flat (or bulbs, fine_bulbs), build/release/apps/halflight
set -eu
triangles=${1:-100000} lamps=${2:-flat}
program=$(realpath "${3:-$(dirname "$0")/../../build/release/apps/halflight}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cat > interior.mtl <<'END'
newmtl wall
Kd .7 .7 .65
newmtl wood
Kd .4 .25 .12
newmtl lamp
Kd .1 .1 .1
Ke 60 60 60
newmtl clay
Kd .5 .25 .2
newmtl fruit
Kd .6 .5 .1
newmtl red
Kd .6 .1 .1
newmtl blue
Kd .1 .2 .6
END
# y is up, as in most OBJ files. Every piece has vertices of its own.
awk -v most="$triangles" -v lamps="$lamps" '
function random(lo, hi) { seed = (seed * 16807) % 2147483647; return lo + (hi - lo) * seed / 2147483647 }  # Park and Miller 1988
function vertex(x, y, z) { printf "v %.6g %.6g %.6g\n", x, y, z; return ++vertices }
function face(a, b, c) { print "f", a, b, c; ++faces }
function material(name) { if (name != current) print "usemtl " name; current = name }
# A grid of n by n quadrilaterals, each in two triangles; its sides are u and v, and it is seen from where u turns to v counter-clockwise.
function grid(n, x, y, z, ux, uy, uz, vx, vy, vz,    first, i, j, a) {
  first = vertices + 1
  for (j = 0; j <= n; ++j)
    for (i = 0; i <= n; ++i) vertex(x + (ux * i + vx * j) / n, y + (uy * i + vy * j) / n, z + (uz * i + vz * j) / n)
  for (j = 0; j < n; ++j)
    for (i = 0; i < n; ++i) {
      a = first + j * (n + 1) + i
      face(a, a + 1, a + n + 2)
      face(a, a + n + 2, a + n + 1)
    }
}
# From one corner to the other; with in_side 1 seen from within.
function box(n, x, y, z, X, Y, Z, in_side,    w, h, d) {
  w = X - x; h = Y - y; d = Z - z
  side(n, in_side, x, y, z, w, 0, 0, 0, 0, d);  side(n, in_side, x, Y, z, 0, 0, d, w, 0, 0)
  side(n, in_side, x, y, z, 0, h, 0, w, 0, 0);  side(n, in_side, x, y, Z, w, 0, 0, 0, h, 0)
  side(n, in_side, x, y, z, 0, 0, d, 0, h, 0);  side(n, in_side, X, y, z, 0, h, 0, 0, 0, d)
}
function side(n, turned, x, y, z, ux, uy, uz, vx, vy, vz) {
  if (turned) grid(n, x, y, z, vx, vy, vz, ux, uy, uz); else grid(n, x, y, z, ux, uy, uz, vx, vy, vz)
}
# The profile radius[], height[] of rings, turned about y.
function turned(x, y, z, rings, sides,    first, i, k, a, b) {
  first = vertices + 1
  for (i = 0; i <= rings; ++i)
    for (k = 0; k < sides; ++k) vertex(x + radius[i] * sin(2 * pi * k / sides), y + height[i], z + radius[i] * cos(2 * pi * k / sides))
  for (i = 0; i < rings; ++i)
    for (k = 0; k < sides; ++k) {
      a = first + i * sides + k; b = first + i * sides + (k + 1) % sides
      if (radius[i] > 1e-9) face(a, b, b + sides)
      if (radius[i + 1] > 1e-9) face(a, b + sides, a + sides)
    }
}
function ball(x, y, z, r, n,    i) {
  for (i = 0; i <= n; ++i) { radius[i] = r * sin(pi * i / n); height[i] = -r * cos(pi * i / n) }
  turned(x, y, z, n, 2 * n)
}
function bowl(x, y, z,    i) {
  for (i = 0; i <= 12; ++i) { radius[i] = .1 * sin(pi / 2 * i / 12); height[i] = .1 - .1 * cos(pi / 2 * i / 12) }
  turned(x, y, z, 12, 32)
}
function chair(x, z,    i, k) {
  material("wood")
  box(4, x, .42, z, x + .45, .46, z + .45)
  for (i = 0; i < 2; ++i) for (k = 0; k < 2; ++k) box(2, x + .4 * i, 0, z + .4 * k, x + .4 * i + .05, .42, z + .4 * k + .05)
  box(4, x, .46, z, x + .45, 1, z + .04)
}
function table(x, z,    i, k) {
  material("wood")
  box(10, x, .72, z, x + 1.6, .76, z + .8)
  for (i = 0; i < 2; ++i) for (k = 0; k < 2; ++k) box(3, x + .05 + 1.4 * i, 0, z + .05 + .6 * k, x + .13 + 1.4 * i, .72, z + .13 + .6 * k)
  chair(x + .2, z - .5); chair(x + .9, z - .5)
}
BEGIN {
  pi = atan2(0, -1); seed = 1
  print "mtllib interior.mtl"
  material("wall"); box(20, 0, 0, 0, 8, 2.8, 6, 1)
  material("lamp")
  for (i = 0; i < 4; ++i) {
    x = 2 + 4 * (i % 2); z = 1.5 + 3 * int(i / 2)
    if (lamps != "flat") ball(x, 2.3, z, .1, lamps == "bulbs" ? 16 : 45); else grid(4, x - .3, 2.79, z - .3, .6, 0, 0, 0, 0, .6)
  }
  for (i = 0; i < 6; ++i) table(1 + 2.3 * (i % 3), 1.2 + 2.2 * int(i / 3))
  for (i = 0; i < 6; ++i) {
    material("wood"); box(6, .02, .35 * i, .5, .35, .35 * i + .03, 5.5)
    for (z = .52; z < 5.4 && i < 5; z += w + .002) {
      w = random(.02, .06)
      material(random(0, 1) < .5 ? "red" : "blue"); box(1, .06, .35 * i + .03, z, random(.2, .3), .35 * i + random(.2, .33), z + w)
    }
  }
  while (faces < most) {  # on tables, floor and shelves
    i = int(random(0, 7)); x = random(.1, 1.5); z = random(.1, .7)
    if (i < 6) { x += 1 + 2.3 * (i % 3); z += 1.2 + 2.2 * int(i / 3); y = .76 } else { x = random(.6, 7.8); z = random(.2, 5.8); y = 0 }
    if (random(0, 1) < .5) { material("fruit"); r = random(.03, .06); ball(x, y + r, z, r, 16) } else { material("clay"); bowl(x, y, z) }
  }
}' > interior.obj

echo "| $(grep -c '^f ' interior.obj) triangles, lamps $lamps | CPU s | measured error |"
echo '| --- | ---: | --- |'
for output in 'report' 'picture'; do
  [ $output = report ] && set -- || set -- -o interior.png
  "$program" render interior.obj --threads 1 --quiet "$@" > report.txt
  awk -v output=$output '
    /^  total / { cpu = $3 } /^  picture \(apart\)/ { drawn = $4 }
    /^  (leaf constants|picture [^ (]+) .*%/ && !/apart/ && error == "" { error = $0; sub(/^ *(leaf constants|picture [^ ]+) */, "", error) }
    END { printf "| %s | %.1f | %s |\n", output, cpu + drawn, error }' report.txt
done
grep -A8 '^taken in' report.txt | sed '/^error/,$d' >&2
[ -z "${KEEP:-}" ] || cp interior.* "$KEEP"
