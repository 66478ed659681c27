// SPDX-License-Identifier: MIT
#pragma once

// Every tolerance of the room, with its derivation. eps_... are bounds of rounding errors, derived from the operations that are named.
// tol_... are chosen: what is smaller counts as nothing, and every other choice within some powers of ten would do as well. All are
// relative unless a unit is named; beside each stands what it is relative to.

#include <limits>

namespace raycast {

// --- Double precision: rounding. ---

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double unit_roundoff = 0.5 * std::numeric_limits<double>::epsilon();  // u = 2^-53: fl(a op b) = (a op b)(1 + d), |d| <= u

// The relative error of n roundings in succession: gamma(n) = n u / (1 - n u) in Higham 2002 (3.1) and in Pharr et al., 6.8.1. The
// denominator is left out: each n below is a power of two above the number of roundings that it stands for, and so a product by it is
// exact.
[[nodiscard]] constexpr double gamma(int n) { return n * unit_roundoff; }

// Of a slab parameter: a difference, a reciprocal and a product, gamma(3) for either end of an interval (Ize 2013).
inline constexpr double eps_slab = gamma(8);
// Of a height above a plane through Newell's normal, to the largest coordinate: a difference, three products, two sums, and as much again
// in the normal. What is within it counts as planar.
inline constexpr double eps_plane = gamma(16);
// Of a determinant of two differences each, to the sum of its two products: two differences and a product in either.
inline constexpr double eps_orientation = gamma(4);
// Of bounds that are computed by a root, to the largest coordinate.
inline constexpr double eps_bounds = gamma(4);
// Of a point under an affine map, to the sum of the magnitudes of its terms: three products, three sums.
inline constexpr double eps_map = gamma(8);
// Of the direction across an axis, to the length of the whole: a line that is nearer to the axis's direction has none, it is parallel. Also
// of a point that near the axis.
inline constexpr double eps_parallel = gamma(16);
// Of a point on a surface, to the largest coordinate of the scene. An interpolated point is off its surface by at most 8 u, an affine map
// adds 12 u, a plane distance 12 u, a crossing of sphere or cylinder 32 u (measured with binary128). The skin of scene.hpp begins with it.
inline constexpr double eps_surface = gamma(64);
// Of a corner projected along a ray (planar.hpp), to the distances within its mesh: 8 u, in either of two coordinates.
inline constexpr double eps_projection = gamma(16);
// Of a vertex of a CSG solid that is put back from the grid to where three planes meet, to the largest coordinate: one that is farther off
// its faces is known to the grid alone.
inline constexpr double eps_vertex = gamma(32);
// Of a zero between a and b, to the larger |end|: bracketed_root() stops there, and sign_changes() divides no further than twice that.
inline constexpr double eps_root = gamma(2), eps_interval = gamma(4);
// By which the sphere and the slab around a torus are grown, to their sizes, so that no line is clipped too short.
inline constexpr double eps_tube = gamma(16);
// Of superquadrics, in units of the radii: where Newton's steps onto the surface end, to 1; of a distance from the ring, to the ring's
// radius; of the norm along a line, to (1 + ring) (1 + 1/p + 1/q), because the powers 1/p and 1/q magnify.
inline constexpr double eps_gauge = gamma(4), eps_ring = gamma(8), eps_norm = gamma(16);
// Planes around a pinched superquadric stand off from it by this part of its size, so that rounding cannot cut its tips.
inline constexpr double tol_hull = 1e-6;

// --- Double precision: ranges. ---

// Lengths and coordinates beyond are refused: cubes and squares of them must stay finite. The smallest length also keeps 13 bits beside the
// coordinates that it is added to (2^-40 of these).
inline constexpr double largest_length = 1e60, smallest_length = 1e-60, tol_vanishing = 0x1p-40;
// Squares of directions beyond overflow, or underflow, in a dot product: there is no line.
inline constexpr double largest_square = 1e300, smallest_square = 1e-300;

// --- Input: what is refused, or taken for something simpler. ---

// Corners off their mean plane, to the polygon's extent; its area, to the square of that.
inline constexpr double tol_planar = 1e-6, tol_area = 1e-12;
// What rounded coordinates may add to the former, at most: farther off than this, a polygon was not meant to be planar.
inline constexpr double tol_rounded = 1e-4;
// The determinant of a placement, to the product of its columns' lengths: below, it flattens space. That product, in its own unit.
inline constexpr double tol_singular = 1e-12, smallest_volume = 1e-180;
// Entries of L^T L off those of a similarity, to the square of its scale. Shapes of the fast lanes keep their form under such a map.
inline constexpr double tol_similar = 1e-9;
// The same for the frame of a CSG operand, which is handed on: a digit away from rounding. And the difference of two such frames.
inline constexpr double tol_rotation = 1e-12, tol_frame = 1e-9;
// Vertices before a face's plane, to the mesh's diameter: it is convex all the same.
inline constexpr double tol_convex = 1e-12;
// 1 - cosine of two normals (10 u, the rounding of both) and the distance of their planes, to the mesh's diameter: one plane.
inline constexpr double tol_same_normal = 2e-15, tol_same_plane = 1e-9;
// Radii of a torus and of a superquadric, to the largest: what is thinner is lost in its own quartic, or in its own power.
inline constexpr double thinnest_torus = 1e-4, thinnest_superquadric = 1e-6;

// How far faces of an embedded mesh may reach into each other at the corners that they share, to their size: as far as tol_planar lets
// them.
inline constexpr double tol_between = 1e-6;

// --- Scenes. ---

// Length of an edge, to the coordinates of its ends: a shorter one, whose ends are off by u each, has a direction that is off by more than
// a thousandth, and so has the plane through it and a point. And the same of the angle at which it is seen.
inline constexpr double tol_edge = 2e3 * unit_roundoff;

// How closely a lamp must fit the ceiling to count as lying on it, to the smaller one's diameter.
inline constexpr double tol_contact = 1e-9;
// Cosine between the normals of two surfaces in contact: above, they face the same way (2.5 degrees).
inline constexpr double tol_same_way = 0.999;
// Ties are looked for within so many skins along the ray: beyond that it grazes at less than a thousandth of a right angle.
inline constexpr double tie_reach = 1000;
// Crossings of an open mesh within this of the segment's ends, in its parameter, are looked at: far beyond their rounding, eps_surface.
inline constexpr double tol_beyond_ends = 1e-6;

// --- CSG. ---

// The film, to a leaf's diameter: surfaces that are nearer are one. A cell of the exact booleans' grid (26 bits).
inline constexpr double tol_film = 0x1p-26;
// A film seen along a ray at less than a millionth of a right angle is as deep as it looks.
inline constexpr double film_reach = 1e6;
// Diameter of what is left of a solid, to that of the bounds it began with: parts that only touch have no solid in common.
inline constexpr double tol_touching = 0x1p-24;
// By how much cells of space are grown, to their size, so that neighbours have no gap between them; and to the largest coordinate.
inline constexpr double tol_cell = 1e-9, tol_cell_place = 0x1p-40;
// Area of a face, to the square of its diameter: a face below is taken for thin, if it is not convex.
inline constexpr double tol_thin_face = 1e-9;
// Sine between two planes: below, where they meet is not known along them.
inline constexpr double tol_plane_angle = 1e-3;

// --- Chords: how far a mesh may be off a curved surface, to the diameter of the solid. ---

inline constexpr double tol_chord = 0.01, tol_coarse_chord = 0.002;

// --- Iterations. ---

// Newton's step on a root of the torus's cubic, to the root: a longer one comes from a double root and is not taken.
inline constexpr double tol_newton = 1e-3;
// The step of project() of a superquadric, to its largest radius: its square, by which the distance is off, is below u. Points of a blade's
// middle, where it has no tangent, are moved off it by the second, to its radii.
inline constexpr double tol_project = 1e-8, off_blade = 1e-30;
// From a plane of symmetry of a superquadric, to its size and place: a point nearer by lies in it. 2^10 u, for a point that was turned and
// moved from the scene, a thousand times as large, into the coordinates of its object.
inline constexpr double tol_symmetry = 0x1p-43;

// --- Single precision: the fast lanes (compiled.hpp), where the scene lies in [-1,1]^3. ---

inline constexpr float unit_roundoff_single = 0x1p-24f;
// Ends of segments lie within `lane_reach`; longer ones are cut to `lane_cube`, if their ends are within `farthest_cut`: then the place
// of the cut is known to 1e-10.
inline constexpr float lane_reach = 1.5f;
inline constexpr double lane_cube = 1.25, farthest_cut = 1e6;
// Of a height above a plane of unit normal. A coordinate is rounded by 2^-24, a direction by 2^-23; the plane's own rounding adds
// 2^-24 (sqrt(3) 2.6), and at most 4 roundings of terms below 2.6 sqrt(3) follow: less than 20 * 2^-24. The same holds for a distance from
// a centre or an axis. `margin` of a scene adds its skins.
inline constexpr double eps_height = 0x1p-19;
// Of half the size of a box: a difference and its ends. Of a linear form in two coordinates of at most 2, with a slope: three roundings of
// terms up to 2 (1 + slope), by which it is to be multiplied.
inline constexpr float eps_half_size = 2 * unit_roundoff_single, eps_side = 8 * unit_roundoff_single;
// Of the heights of two ends above a plane across a bundle.
inline constexpr float eps_section = 2 * static_cast<float>(eps_height);
// Lengths, roots and limits are rounded up by these factors, so that they are bounds; a limit near 0 by the last, in the ray's parameter.
inline constexpr float length_up = 1.0001f, limit_up = 1.00001f, eps_limit = 1e-6f;
// With heights `from` and `to` of a segment's ends, each known to `margin`, the crossing is known to crossing_error margin length /
// (|from| + |to|) once |from| + |to| > crossing_apart margin. For the quotient |from| / (|from| + |to|) is off by 8/7 margin / (|from| +
// |to|) at most, and its own rounding and that of the direction are below this.
inline constexpr float crossing_error = 3.0f, crossing_apart = 16.0f;
// Of the function of a cone, and of the gauge of a superquadric with powers p, q, and of its slopes: eps_power (1 + 1/2p + 1/2q + (p + q) /
// 128). For the power of a ratio is off by p times the rounding of that, 2^-24, and so are the slopes: by 1.5e-7 (p + q) (forms.inc).
inline constexpr double eps_cone = 0x1p-20, eps_power = 0x1p-15;
// What double precision computes in a shape's coordinates must be better than the margin there, and the margin small beside the shape.
inline constexpr double largest_condition = 1e4;
inline constexpr float largest_slop = 0.02f;
// Edges of a face, to the squared extent: below, its normal is not known and double precision decides.
inline constexpr double tol_sliver = 1e-6;
// Change of a gauge along a segment, to its largest step: what is less steep may be a graze, and double precision decides.
inline constexpr float tol_graze = 1e-4f;

// Of supertoroids with a larger ring double precision is asked.
inline constexpr double largest_ring = 64.0;

// In place of 0 in a divisor, where the quotient then decides nothing: a length, and a square or a direction; and of a ratio whose power
// would underflow.
inline constexpr float least_divisor = 1e-20f, least_square = 1e-30f, least_ratio = 1e-10f;
// Beyond every coordinate, beyond every slope that still says something, beyond all slopes.
inline constexpr float no_bound = 1e30f, steepest = 1e15f, beyond_slopes = 1e38f;

}  // namespace raycast
