// SPDX-License-Identifier: MIT
#pragma once

// Every tolerance of raycast/, with its derivation. eps_...: bounds of rounding errors, derived from the operations named. tol_...:
// chosen; smaller values count as zero, and any other choice within some powers of ten would do as well. All are relative, to what stands
// after "to", unless a unit is named.

#include <limits>

namespace raycast {

// --- Double precision: rounding. ---

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double unit_roundoff = 0.5 * std::numeric_limits<double>::epsilon();  // u = 2^-53: fl(a op b) = (a op b)(1 + d), |d| <= u

// The relative error of n successive roundings: gamma(n) = n u / (1 - n u) in Higham 2002 (3.1) and in Pharr et al., 6.8.1. The
// denominator is omitted, because each n below is a power of two above the number of roundings that it represents; for the same reason a
// product with it is exact.
[[nodiscard]] constexpr double gamma(int n) { return n * unit_roundoff; }

// Error of a slab parameter: a difference, a reciprocal and a product, gamma(3) for each end of an interval (Ize 2013).
inline constexpr double eps_slab = gamma(8);
// Error of a height above a plane with Newell's normal, to the largest coordinate: a difference, three products, two sums, and as much
// again in the normal. Corners within it count as planar.
inline constexpr double eps_plane = gamma(16);
// Error of a determinant of two differences each, to the sum of its two products: two differences and a product in either.
inline constexpr double eps_orientation = gamma(4);
// Error of bounds that are computed by a root, to the largest coordinate.
inline constexpr double eps_bounds = gamma(4);
// Error of a point under an affine map, to the sum of the magnitudes of its terms: three products, three sums.
inline constexpr double eps_map = gamma(8);
// Error of the component of a direction perpendicular to an axis, to the length of the direction: a line with a smaller component counts as
// parallel to the axis. Also the error of the distance of a point from the axis.
inline constexpr double eps_parallel = gamma(16);
// Error of a point on a surface, to the largest coordinate of the scene. An interpolated point is off its surface by at most 8 u; an affine
// map adds 12 u, a plane distance 12 u, a crossing of sphere or cylinder 32 u (measured with binary128). The skin of scene.hpp starts with
// this.
inline constexpr double eps_surface = gamma(64);
// Error of a corner projected along a ray (planar.hpp), to the distances within its mesh: 8 u, in either of two coordinates.
inline constexpr double eps_projection = gamma(16);
// Error of a vertex of a CSG solid that is moved from the grid to the intersection of three planes, to the largest coordinate: if a vertex
// is farther off its faces, its grid position is used.
inline constexpr double eps_vertex = gamma(32);
// Error of a zero between a and b, to the larger |end|: bracketed_root() stops at this width, and sign_changes() divides no interval
// shorter than twice that.
inline constexpr double eps_root = gamma(2), eps_interval = gamma(4);
// The sphere and the slab around a torus are enlarged by this, to their sizes, so that no line is clipped too short.
inline constexpr double eps_tube = gamma(16);
// Errors for superquadrics, in units of the radii: of the last Newton step onto the surface, to 1; of a distance from the ring, to the
// ring's radius; of the norm along a line, to (1 + ring) (1 + 1/p + 1/q), because the powers 1/p and 1/q amplify errors.
inline constexpr double eps_gauge = gamma(4), eps_ring = gamma(8), eps_norm = gamma(16);
// Distance of the planes around a pinched superquadric, to its size, so that rounding cannot cut its tips.
inline constexpr double tol_hull = 1e-6;

// --- Double precision: ranges. ---

// Larger lengths and coordinates are refused, because their cubes and squares must stay finite. The smallest length also keeps 13 bits
// beside the coordinates to which it is added (2^-40 of these).
inline constexpr double largest_length = 1e60, smallest_length = 1e-60, tol_vanishing = 0x1p-40;
// Squared lengths of directions outside this range overflow or underflow in a dot product: there is no line.
inline constexpr double largest_square = 1e300, smallest_square = 1e-300;

// --- Input: what is refused, or treated as something simpler. ---

// Distance of corners from their mean plane, to the polygon's extent; its area, to the square of that.
inline constexpr double tol_planar = 1e-6, tol_area = 1e-12;
// Upper limit of what rounded coordinates add to the former: a polygon that is less planar was not meant to be planar.
inline constexpr double tol_rounded = 1e-4;
// The determinant of a placement, to the product of its columns' lengths: a smaller one flattens space. Lower limit of that product,
// absolute.
inline constexpr double tol_singular = 1e-12, smallest_volume = 1e-180;
// Deviation of L^T L from that of a similarity, to the square of its scale. Under such a map shapes keep their form in the fast code.
inline constexpr double tol_similar = 1e-9;
// The same for the frame of a CSG operand, which is passed on: one digit above rounding. And the difference of two such frames.
inline constexpr double tol_rotation = 1e-12, tol_frame = 1e-9;
// Height of vertices in front of a face's plane, to the mesh's diameter, up to which it counts as convex.
inline constexpr double tol_convex = 1e-12;
// 1 - cosine of two normals (10 u, the rounding of both) and the distance of their planes, to the mesh's diameter, up to which they are
// one plane.
inline constexpr double tol_same_normal = 2e-15, tol_same_plane = 1e-9;
// Radii of a torus and of a superquadric, to the largest: thinner shapes are lost in rounding of their quartic or their powers.
inline constexpr double thinnest_torus = 1e-4, thinnest_superquadric = 1e-6;

// How far faces of an embedded mesh may overlap near shared corners, to their size: as far as tol_planar allows.
inline constexpr double tol_between = 1e-6;

// --- Scenes. ---

// Length of an edge, to the coordinates of its ends. If it is shorter, and its ends are off by u each, its direction is off by more than
// a thousandth, and so is the plane through it and a point. The same for the angle at which it is seen.
inline constexpr double tol_edge = 2e3 * unit_roundoff;

// Largest gap between a lamp and a ceiling on which it counts as lying, to the smaller one's diameter.
inline constexpr double tol_contact = 1e-9;
// Cosine between the normals of two surfaces in contact; above it they face the same way (2.5 degrees).
inline constexpr double tol_same_way = 0.999;
// Ties are recognised within this many skins along the ray, that is, down to grazing angles of a thousandth of a right angle.
inline constexpr double tie_reach = 1000;
// Crossings of an open mesh within this distance of the segment's ends, in its parameter, are tested: far more than their rounding,
// eps_surface.
inline constexpr double tol_beyond_ends = 1e-6;

// --- CSG. ---

// The film, to a leaf's diameter: surfaces nearer to each other are merged. It is the cell size of the exact booleans' grid (26 bits).
inline constexpr double tol_film = 0x1p-26;
// Limit of the ratio of a film's depth along a ray to its thickness, reached at a millionth of a right angle.
inline constexpr double film_reach = 1e6;
// Diameter of the remaining part of a solid, to that of its original bounds: parts that merely touch have no solid in common.
inline constexpr double tol_touching = 0x1p-24;
// Enlargement of cells of space, to their size, so that neighbours have no gap between them; and to the largest coordinate.
inline constexpr double tol_cell = 1e-9, tol_cell_place = 0x1p-40;
// Area of a face, to the square of its diameter: a smaller face that is not convex counts as thin.
inline constexpr double tol_thin_face = 1e-9;
// Sine between two planes; below it the position of their intersection along the planes is not accurate.
inline constexpr double tol_plane_angle = 1e-3;

// --- Chords: distance of a mesh from a curved surface, to the diameter of the solid. ---

inline constexpr double tol_chord = 0.01, tol_coarse_chord = 0.002;

// --- Iterations. ---

// Newton's step on a root of the torus's cubic, to the root: a longer one comes from a double root and is ignored.
inline constexpr double tol_newton = 1e-3;
// The last step of project() of a superquadric, to its largest radius: its square, the error of the distance, is below u. Points in the
// middle of a blade, where it has no tangent, are moved off it by the second value, to its radii.
inline constexpr double tol_project = 1e-8, off_blade = 1e-30;
// Distance from a plane of symmetry of a superquadric, to its size and position: a nearer point counts as lying in it. 2^10 u, for a
// point that was rotated and moved from a scene a thousand times as large into the object's coordinates.
inline constexpr double tol_symmetry = 0x1p-43;

// --- Single precision: the fast lanes (compiled.hpp), where the scene lies in [-1,1]^3. ---

inline constexpr float unit_roundoff_single = 0x1p-24f;
// Ends of segments lie within `lane_reach`; longer segments are clipped to `lane_cube` if their ends are within `farthest_cut`, where the
// position of the cut is accurate to 1e-10.
inline constexpr float lane_reach = 1.5f;
inline constexpr double lane_cube = 1.25, farthest_cut = 1e6;
// Error of a height above a plane of unit normal. A coordinate is rounded by 2^-24, a direction by 2^-23; the plane's own rounding adds
// 2^-24 (sqrt(3) 2.6), and at most 4 roundings of terms below 2.6 sqrt(3) follow: together less than 20 * 2^-24. The same holds for a
// distance from a centre or an axis. The `margin` of a scene adds its skins.
inline constexpr double eps_height = 0x1p-19;
// Error of half the size of a box: the roundings of its ends and of their difference. Error, divided by 1 + |slope|, of a linear form in
// two coordinates of at most 2 with this slope: three roundings of terms up to 2 (1 + |slope|).
inline constexpr float eps_half_size = 2 * unit_roundoff_single, eps_side = 8 * unit_roundoff_single;
// Error of the heights of both ends of a segment above a plane through a bundle, together.
inline constexpr float eps_section = 2 * static_cast<float>(eps_height);
// Lengths, roots and limits are rounded up by these factors, so that they are upper bounds; to a limit near 0 the last value is added, in
// the ray's parameter.
inline constexpr float length_up = 1.0001f, limit_up = 1.00001f, eps_limit = 1e-6f;
// With heights `from` and `to` of a segment's ends, each accurate to `margin`, the crossing is accurate to
// crossing_error margin length / (|from| + |to|) if |from| + |to| > crossing_apart margin: the error of the quotient
// |from| / (|from| + |to|) is at most 8/7 margin / (|from| + |to|), and the rounding of quotient and direction is smaller than this.
inline constexpr float crossing_error = 3.0f, crossing_apart = 16.0f;
// Error of the function of a cone, and of the gauge of a superquadric with powers p, q and of its slopes. The latter is multiplied by
// 1 + 1/2p + 1/2q + (p + q) / 128, because the relative error of a power is p times that of the ratio, 2^-24, and that of the slopes is
// 1.5e-7 (p + q) (forms.inc).
inline constexpr double eps_cone = 0x1p-20, eps_power = 0x1p-15;
// Double precision in a shape's coordinates must be more accurate than the margin there, and the margin small compared with the shape.
inline constexpr double largest_condition = 1e4;
inline constexpr float largest_slop = 0.02f;
// Edges of a face, to the squared extent: below this its normal is not accurate, and double precision decides.
inline constexpr double tol_sliver = 1e-6;
// Change of a gauge along a segment, to its largest step: with a smaller one the segment may graze, and double precision decides.
inline constexpr float tol_graze = 1e-4f;

// Supertoroids with a larger ring are left to double precision.
inline constexpr double largest_ring = 64.0;

// Replace 0 in a divisor if the quotient then decides nothing: for a length; for a square or a direction; and for a ratio whose power
// would underflow.
inline constexpr float least_divisor = 1e-20f, least_square = 1e-30f, least_ratio = 1e-10f;
// Larger than every coordinate; than every meaningful slope; than all slopes.
inline constexpr float no_bound = 1e30f, steepest = 1e15f, beyond_slopes = 1e38f;

}  // namespace raycast
