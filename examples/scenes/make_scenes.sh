#!/bin/sh
# SPDX-License-Identifier: MIT
# Scenes with parameters, each of which isolates one difficulty (after Willmott and Heckbert 1997). Writes the scene to standard output:
#
#   sh make_scenes.sh perpendicular_plates [DEGREES]      angle between two plates that share an edge     90
#   sh make_scenes.sh penumbra [HEIGHT]                   of the blocker, above 0 and below 2             0.5
#   sh make_scenes.sh corridor [LENGTH [REFLECTANCE]]     of a corridor 2 m wide, lit at one end          16 0.8
#   sh make_scenes.sh nested_rooms [DOOR [ROOMS]]         width of the doors, rooms inside the hall       0.6 1
#   sh make_scenes.sh boxes [NUMBER [SEED]]               of boxes that stand about at random             25 1
#   sh make_scenes.sh office [QUADS]                      about so many: desks and chairs, four lamps     990
#   sh make_scenes.sh sphere [RADIUS]                     of a sphere under a square lamp                 0.5
#   sh make_scenes.sh cylinder [RADIUS]                   of a cylinder 1 m high, under the same lamp     0.5
#
# The files beside this one, none of them an office, are made with the values at the right:  sh make_scenes.sh corridor > corridor.scene
# A sweep:  for rho in 0.5 0.8 0.9 0.95 0.99; do sh make_scenes.sh corridor 16 $rho > corridor_$rho.scene; done
set -eu

perpendicular_plates() {
  awk -v degrees="${1:-90}" 'BEGIN {
    angle = degrees * atan2(0, -1) / 180
    x = sprintf("%.9g", cos(angle)); if (x < 1e-9 && x > -1e-9) x = 0
    z = sprintf("%.9g", sin(angle))
    print "# Singularity: two unit plates share an edge at " degrees " degrees, where the kernel of the form factor is unbounded."
    print "# The lamp reflects nothing, so the radiosity of the plate is 0.5 times the form factor from each point to the lamp."
    print ""
    print "material lamp   reflectance 0  emission 1"
    print "material plate  reflectance 0.5"
    print ""
    print "camera side  eye 2.7 -1.7 1.9  target 0.35 0.5 0.38  fov 38"
    print ""
    print "polygon lower material lamp {"
    print "    vertex 0 0 0\n    vertex 1 0 0\n    vertex 1 1 0\n    vertex 0 1 0\n}"
    print "polygon upper material plate {"
    print "    vertex 0 0 0\n    vertex 0 1 0\n    vertex " x " 1 " z "\n    vertex " x " 0 " z "\n}"
  }'
}

penumbra() {
  awk -v height="${1:-0.5}" 'BEGIN {
    print "# Penumbra: a blocker " height " m above the floor, under a lamp of its size at 2 m; the higher it hangs, the wider its half-shadow."
    print "# Lamp and blocker reflect nothing, so the radiosity of the floor is 0.5 times the form factor from each point to what it sees of the lamp."
    print ""
    print "material lamp     reflectance 0  emission 10"
    print "material floor    reflectance 0.5"
    print "material blocker  reflectance 0"
    print ""
    print "camera above  eye 0 -3.4 2.9  target 0 0 0.2  fov 48"
    print ""
    print "polygon floor material floor {"
    print "    vertex -1.5 -1.5 0\n    vertex 1.5 -1.5 0\n    vertex 1.5 1.5 0\n    vertex -1.5 1.5 0\n}"
    print "polygon blocker material blocker {"
    print "    vertex -0.4 -0.4 " height "\n    vertex 0.4 -0.4 " height "\n    vertex 0.4 0.4 " height "\n    vertex -0.4 0.4 " height "\n}"
    print "polygon light material lamp {"
    print "    vertex -0.4 -0.4 2\n    vertex -0.4 0.4 2\n    vertex 0.4 0.4 2\n    vertex 0.4 -0.4 2\n}"
  }'
}

corridor() {
  awk -v length_="${1:-16}" -v rho="${2:-0.8}" 'BEGIN {
    print "# Many bounces: a closed corridor of " length_ " m and reflectance " rho ", lit at one end; the other end lives on light that was reflected many times."
    print ""
    print "material wall  reflectance " rho
    print "material lamp  reflectance 0  emission 20"
    print ""
    print "camera along  eye " sprintf("%g", length_ - 0.3) " 1 1.5  look -1 0 -0.05  fov 70"
    print ""
    print "box corridor  from 0 0 0  to " length_ " 2 2.5  inside  material wall"
    print "polygon light material lamp {"
    print "    vertex 0.5 0.6 2.5\n    vertex 0.5 1.4 2.5\n    vertex 1.3 1.4 2.5\n    vertex 1.3 0.6 2.5\n}"
  }'
}

nested_rooms() {
  awk -v door="${1:-0.6}" -v rooms="${2:-1}" 'BEGIN {
    print "# Narrow passages: a lamp in the innermost of " rooms + 1 " rooms, each inside the next, with doors " door " m wide on alternating sides."
    print ""
    print "material wall   reflectance 0.75"
    print "material stone  reflectance 0.6 0.5 0.4"
    print "material lamp   reflectance 0  emission 60 55 45"
    print ""
    size = 1.4 * (rooms + 1)
    printf "camera inside  eye %g %g 1.9  target %g 0.3 0.9  fov 75\n\n", size - 0.2, 0.2 - size, size - 1.1
    printf "box hall  from %g %g 0  to %g %g 3.2  inside  material wall\n", -size, -size, size, size
    for (i = 1; i <= rooms; ++i) {
      size = 1.4 * (rooms + 1 - i)
      high = 3.2 - 0.6 * i / rooms
      side = i % 2 == 1 ? 1 : -1
      from = side > 0 ? size - 0.5 : -size - 0.5
      printf "difference room%d material stone {\n", i
      printf "    box shell   from %g %g 0  to %g %g %g\n", -size, -size, size, size, high
      printf "    box hollow  from %g %g -1  to %g %g %g\n", 0.15 - size, 0.15 - size, size - 0.15, size - 0.15, high - 0.15
      printf "    box door    from %g %g -1  to %g %g 2\n}\n", from, -door / 2, from + 1, door / 2
    }
    z = sprintf("%g", high - 0.15)
    print "polygon light material lamp {"
    print "    vertex -0.3 -0.3 " z "\n    vertex -0.3 0.3 " z "\n    vertex 0.3 0.3 " z "\n    vertex 0.3 -0.3 " z "\n}"
  }'
}

boxes() {
  awk -v number="${1:-25}" -v seed="${2:-1}" '
  function random() { state = (state * 16807) % 2147483647; return state / 2147483647 }
  BEGIN {
    state = (seed + 1) * 7919 % 2147483647
    for (i = 0; i < 10; ++i) random()
    print "# Complexity: " number " boxes stand about in a room at random (seed " seed "); every pair of faces may exchange light, most are hidden."
    print ""
    print "material white  reflectance 0.75"
    print "material red    reflectance 0.6 0.15 0.1"
    print "material blue   reflectance 0.15 0.25 0.6"
    print "material lamp   reflectance 0  emission 25 24 22"
    print ""
    print "camera above  eye 0.2 0.2 2.8  target 3.4 3.4 0.4  fov 80"
    print ""
    print "box room  from 0 0 0  to 6 6 3  inside  material white"
    print "polygon light material lamp {\n    vertex 2.4 2.4 3\n    vertex 2.4 3.6 3\n    vertex 3.6 3.6 3\n    vertex 3.6 2.4 3\n}"
    n = 1
    while (n * n < number) ++n
    cell = 6 / n
    split("white red blue", material, " ")
    for (i = 0; i < number; ++i) {
      reach = 0.3 * cell + 0.15 * cell * random()           # half a diagonal: boxes stay in their cells, however they turn
      angle = 0.4 + 0.8 * random()
      a = reach * cos(angle); b = reach * sin(angle)
      x = cell * (i % n + 0.5) + (0.48 * cell - reach) * (2 * random() - 1)
      y = cell * (int(i / n) + 0.5) + (0.48 * cell - reach) * (2 * random() - 1)
      z = 0.3 + 1.3 * random() * random() + 0.1 * cell
      printf "box box%d  from %.4f %.4f 0  to %.4f %.4f %.4f  material %s  rotate 0 0 1 %.1f  move %.4f %.4f 0\n", i + 1, -a, -b, a, b, z, \
        material[1 + int(3 * random())], 90 * random(), x, y
    }
  }'
}

# A desk and a chair are 11 boxes, 66 quads; room and lamps are 10.
office() {
  awk -v quads="${1:-990}" '
  function random() { state = (state * 16807) % 2147483647; return state / 2147483647 }
  function part(x0, y0, z0, x1, y1, z1) {
    printf "box part%d  from %g %g %g  to %g %g %g  material %s  rotate 0 0 1 %.1f  move %.3f %.3f 0\n", ++parts, x0, y0, z0, x1, y1, z1, \
      material, angle, x, y
  }
  BEGIN {
    state = 7919
    sets = int((quads - 10) / 66 + 0.5)
    if (sets < 1) sets = 1
    n = 1
    while (n * n < sets) ++n
    size = 2.4 * n
    print "# Many faces: an office of " sets " desks with chairs, " 66 * sets + 10 " quads, under four lamps."
    print ""
    print "material wall   reflectance 0.7"
    print "material desk   reflectance 0.5 0.4 0.3"
    print "material chair  reflectance 0.2 0.3 0.5"
    print "material lamp   reflectance 0  emission 20"
    print ""
    printf "camera door  eye 0.3 0.3 2.3  target %g %g 0.5  fov 75\n\n", 0.6 * size, 0.6 * size
    printf "box room  from 0 0 0  to %g %g 3  inside  material wall\n", size, size
    for (i = 1; i <= 4; ++i) {
      x0 = size * (i % 2 ? 0.25 : 0.75) - 0.08 * size; x1 = x0 + 0.16 * size
      y0 = size * (i > 2 ? 0.25 : 0.75) - 0.08 * size; y1 = y0 + 0.16 * size
      printf "polygon light%d material lamp {\n    vertex %g %g 3\n    vertex %g %g 3\n    vertex %g %g 3\n    vertex %g %g 3\n}\n", \
        i, x0, y0, x0, y1, x1, y1, x1, y0
    }
    for (i = 0; i < sets; ++i) {
      x = 2.4 * (i % n + 0.5); y = 2.4 * (int(i / n) + 0.5); angle = 360 * random()
      material = "desk"
      part(-0.7, -0.1, 0.72, 0.7, 0.6, 0.76)
      for (k = 0; k < 4; ++k) part(k % 2 ? 0.6 : -0.66, k > 1 ? 0.5 : -0.06, 0, k % 2 ? 0.66 : -0.6, k > 1 ? 0.56 : 0, 0.72)
      material = "chair"
      part(-0.22, -0.7, 0.44, 0.22, -0.26, 0.48)
      for (k = 0; k < 4; ++k) part(k % 2 ? 0.17 : -0.21, k > 1 ? -0.31 : -0.69, 0, k % 2 ? 0.21 : -0.17, k > 1 ? -0.27 : -0.65, 0.44)
      part(-0.22, -0.74, 0.48, 0.22, -0.7, 0.95)
    }
  }'
}

# What the scenes of one curved object have in common: its name, its radius, its line.
curved() {
  awk -v shape="$1" -v radius="$2" -v line="$3" 'BEGIN {
    print "# Curvature: a " shape " of radius " radius " m under a square lamp; the polygons of its approximation come nearer to it only by refinement."
    print "# The lamp reflects nothing, so the radiosity is 0.7 times the irradiance from the lamp."
    print ""
    print "material lamp  reflectance 0  emission 10"
    print "material clay  reflectance 0.7"
    print ""
    print "camera side  eye 2.6 -2.2 1.4  target 0 0 0.5  fov 40"
    print ""
    print line "  radius " radius "  material clay"
    z = shape == "sphere" ? 1 + radius : 1.5  # 1 m above the top
    print "polygon light material lamp {"
    print "    vertex -0.5 -0.5 " z "\n    vertex -0.5 0.5 " z "\n    vertex 0.5 0.5 " z "\n    vertex 0.5 -0.5 " z "\n}"
  }'
}

sphere() { curved sphere "${1:-0.5}" "sphere ball  center 0 0 0"; }

cylinder() { curved cylinder "${1:-0.5}" "cylinder post  base 0 0 -0.5  axis 0 0 1"; }

case "${1:-}" in
  perpendicular_plates | penumbra | corridor | nested_rooms | boxes | office | sphere | cylinder) "$@" ;;
  *)
    sed -n '3,16s/^# \{0,1\}//p' "$0" >&2
    exit 2
    ;;
esac
