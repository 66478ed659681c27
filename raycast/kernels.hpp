// SPDX-License-Identifier: MIT
#pragma once

// The searches over compiled.hpp in single precision, for every instruction set (lanes.hpp), and their input.
//
// Lanes. A bundle is sixteen segments as a structure of arrays: Rays16::ox holds the x of sixteen origins. Segment i is lane i on every
// machine; a set of lanes is an unsigned number with bit i for lane i, and so is the result of every comparison. The vector F holds
// lane_count lanes: 4, 8 or 16; a bundle needs `chunks` = 16 / lane_count of them. The vector B is for testing one segment against eight
// boxes or shapes at once, in `box_chunks` steps.
//
// Layout (compiled.hpp). A Node holds the bounds of eight children in six rows of eight floats, and their eight child numbers, in four
// cache lines. A child number is the index of a node or, with bit 31 set, a leaf: kind, count and first index of up to eight shapes of
// this kind. Triangles, quads and spheres are stored in blocks of eight, again row by row: a face is its plane and one plane through each
// edge, so testing it means computing heights. Unused places hold values that no segment meets. All other kinds are stored one by one.
//
// Two orders of testing. A node or a block can be tested lane by lane, eight children at once (segment.inc), or child by child, all lanes
// at once (shapes.inc, slabs() of hull.inc). search.inc chooses by the number of tests, which depends on how many lanes are still alive.
// A bundle whose segments are nearly parallel first discards children with its convex hull.
//
// Conservative. Single precision cannot decide cases near a limit, such as a segment that passes an edge within rounding. So each limit
// is moved by `margin` in both directions, and every test has three answers: certainly blocked (Bits::hit), certainly free, undecided
// (Bits::maybe). Boxes are grown by the margin and hulls by their rounding error, so no shape is missed.
//
// Evaluated in double precision by Scene, object by object:
//   - undecided lanes; they are collected by object (Pending) and evaluated only if no certain blocker was found;
//   - objects that the single-precision code does not know (Kind::other), and cases that depend on the order of crossings: an end on or
//     in a solid;
//   - the first hit of a ray: here its parameter is known only within bounds (Entries), which mostly leave one candidate.
// So the answers are those of double precision alone, whatever the order and the instruction set.
//
//   lanes.inc     the operations on vectors        convert.inc   from the world into the compiled scene
//   shapes.inc    a bundle against one shape       search.inc    which lanes are blocked
//   forms.inc     shapes with a formula, convex    pairs.inc     what can stand between two patches
//   march.inc     and not convex                   first.inc     what is met first
//   segment.inc   a segment against eight          hull.inc      the hull of a bundle against eight
//   walk.inc      the walk of walk.hpp

#include <raycast/bundle.hpp>
#include <raycast/compiled.hpp>
#include <raycast/lanes.hpp>
#include <raycast/walk.hpp>

#include <bit>
#include <cstdint>

namespace raycast {

// Sixteen segments in the coordinates of a compiled scene: o the origins, t the targets, d = t - o, i = 1 / d, k = -o i.
struct alignas(64) Rays16 {
  float ox[16], oy[16], oz[16], tx[16], ty[16], tz[16], dx[16], dy[16], dz[16], ix[16], iy[16], iz[16], kx[16], ky[16], kz[16];
  float length[16];                      // of d, from above
  float per_square[16];                  // 1 / d.d
  std::uint32_t source[16], target[16];  // owners
  std::uint32_t source_sheet[16], target_sheet[16];
  std::uint32_t back[3];  // by axis: the lanes with i < 0
  bool uniform;           // all lanes have the owners of lane 0
};

// The convex hull of a bundle from outside: its bounds, and in each coordinate plane the two lines that run beside its outline
// (Haines, Wallace 1991). A plane is pu x_u + pk x_k <= limit; `row` are the rows of Node::bound where its left side is least.
struct Hull {
  float lo[3], hi[3];
  struct Side {
    float pu, pk, limit, norm;
    std::uint8_t u, k, row_u, row_k;
  };
  Side sides[6];
  unsigned count = 0;
  float centre[2][3], half[2][3];  // the bounds of the origins, and of the targets
};

// The region of segments between two patches: as segments between each corner of one and each corner of the other, and their hull. Both
// are widened by `bulge` in all directions.
struct Corners16 {
  Rays16 rays;
  Hull hull;
  float bulge = 0.0f;
  float smallest = 0.0f;         // smaller objects cannot hide a section, so that proof is not tried for them
  std::uint32_t source, target;  // owners
  std::uint32_t source_sheet, target_sheet;
};
enum class Relevance : std::uint8_t { none, some, blocks_all };

// Candidates for the first hit of a ray: crossings of polygons and entries into solids with stored faces, as far as single precision knows.
struct Entries {
  static constexpr unsigned capacity = 8;
  struct Entry {
    float from, to;  // bounds of the parameter
    std::uint32_t object, face;
    bool sure;   // is it certainly crossed?
    bool timed;  // do the bounds say anything?
  };
  Entry entry[capacity];
  unsigned count = 0;
  bool complete = true;  // false: there were more candidates
  float exit = 1.0f;     // no solid with stored faces is left before this parameter

  [[nodiscard]] bool full() const { return count == capacity; }
  void add(const Entry& e) {
    if (e.sure) {  // later candidates cannot be the first hit
      unsigned kept = 0;
      for (unsigned i = 0; i < count; ++i) {
        if (entry[i].from <= e.to) { entry[kept++] = entry[i]; }
      }
      count = kept;
    }
    if (count == capacity) {
      complete = false;
    } else {
      entry[count++] = e;
    }
  }
};

// Undecided lanes by object, and for open surfaces by face.
struct Pending {
  static constexpr unsigned capacity = 24;
  static constexpr std::uint32_t whole = 0xffffffff;  // in place of a face: the whole object
  std::uint32_t object[capacity], face[capacity], lanes[capacity];
  unsigned count = 0;
};

}  // namespace raycast

#define HALFLIGHT_ISA portable
#define HALFLIGHT_LANES 4
#define HALFLIGHT_TARGET
#include "kernels/all.inc"

#ifdef HALFLIGHT_X86
#define HALFLIGHT_ISA avx2
#define HALFLIGHT_LANES 8
#define HALFLIGHT_TARGET __attribute__((target("avx2,fma,bmi,popcnt")))
#include "kernels/all.inc"

#define HALFLIGHT_ISA avx512
#define HALFLIGHT_LANES 16
#define HALFLIGHT_TARGET __attribute__((target("avx512f,avx512vl,avx512dq,avx512bw,avx2,fma,bmi,popcnt")))
#include "kernels/all.inc"
#endif

// Calls the function of this name in the namespace of the instruction set.
#ifdef HALFLIGHT_X86
#define HALFLIGHT_DISPATCH(isa, call) ((isa) == Isa::avx512 ? avx512::call : (isa) == Isa::avx2 ? avx2::call : portable::call)
#else
#define HALFLIGHT_DISPATCH(isa, call) (static_cast<void>(isa), portable::call)
#endif
