// SPDX-License-Identifier: MIT
#pragma once

// The searches over compiled.hpp in single precision, for every instruction set (lanes.hpp), and what they are asked with.
//
// Lanes. A bundle is sixteen segments as a structure of arrays: Rays16::ox are the x of sixteen origins. Segment i is lane i, on every
// machine; a set of lanes is an unsigned number with bit i for lane i, and so is the result of every comparison. The vector F holds
// lane_count lanes, 4, 8 or 16; a bundle takes `chunks` = 16 / lane_count of them. The vector B is for the other use, one segment against
// eight boxes or shapes at once, in `box_chunks` steps.
//
// Layout (compiled.hpp). A Node holds the bounds of eight children in six rows of eight floats, and their eight numbers, in four cache
// lines. A number is the index of a node or, with bit 31, a leaf: a kind, a count and the first of up to eight shapes of this kind.
// Triangles, quads and spheres lie in blocks of eight, again row by row: a face is its plane and one plane through each edge, so that to
// test it is to compute heights. Places without a shape hold what no segment meets. All other kinds lie one after the other.
//
// Two ways. A node or a block can be tested lane by lane, eight children at once (segment.inc), or child by child, all lanes at once
// (shapes.inc, slabs() of hull.inc). search.inc compares the numbers of tests, which depend on how many lanes are still alive; a bundle
// whose segments run beside each other drops children by its convex hull first.
//
// Conservative. Single precision cannot decide what is near a limit: a segment that passes an edge within rounding. So each limit is moved
// by `margin` both ways, and every test has three answers: blocked for certain (Bits::hit), free for certain, undecided (Bits::maybe).
// Boxes are grown by the margin, and hulls by their rounding, so nothing is lost on the way to a shape.
//
// What is asked in double precision, of Scene, object by object:
//   - undecided lanes; they are collected by object (Pending) and asked only if no certain blocker was found;
//   - objects that the lanes do not know (Kind::other), and what depends on the order of crossings: an end on or in a solid;
//   - where a ray meets first: here its parameter is only known between bounds (Entries), which mostly leave one candidate.
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

// Where the segments between two patches may run: as segments between their corners, each with each, and the hull of these. Both are
// wider by `bulge` all around.
struct Corners16 {
  Rays16 rays;
  Hull hull;
  float bulge = 0.0f;
  float smallest = 0.0f;         // what is smaller than this hides no section: such proofs are not tried
  std::uint32_t source, target;  // owners
  std::uint32_t source_sheet, target_sheet;
};
enum class Relevance : std::uint8_t { none, some, blocks_all };

// Where a ray crosses polygons and enters solids kept as faces, as far as single precision knows.
struct Entries {
  static constexpr unsigned capacity = 8;
  struct Entry {
    float from, to;  // bounds of the parameter
    std::uint32_t object, face;
    bool sure;   // that it is crossed
    bool timed;  // the bounds say something
  };
  Entry entry[capacity];
  unsigned count = 0;
  bool complete = true;  // false: there were more
  float exit = 1.0f;     // no solid kept as faces is left before this

  [[nodiscard]] bool full() const { return count == capacity; }
  void add(const Entry& e) {
    if (e.sure) {  // what certainly comes later does not matter
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

// Which lanes are undecided about which object; of an open surface, about which face.
struct Pending {
  static constexpr unsigned capacity = 24;
  static constexpr std::uint32_t whole = 0xffffffff;  // in place of a face: the object
  std::uint32_t object[capacity], face[capacity], lanes[capacity];
  unsigned count = 0;
};

}  // namespace raycast

#define HALFLIGHT_ISA portable
#define HALFLIGHT_LANES 4
#define HALFLIGHT_TARGET
#include "kernels/all.inc"
#undef HALFLIGHT_ISA
#undef HALFLIGHT_LANES
#undef HALFLIGHT_TARGET
#undef HALFLIGHT_OP
#undef HALFLIGHT_LAMBDA

#ifdef HALFLIGHT_X86
#define HALFLIGHT_ISA avx2
#define HALFLIGHT_LANES 8
#define HALFLIGHT_TARGET __attribute__((target("avx2,fma,bmi,popcnt")))
#include "kernels/all.inc"
#undef HALFLIGHT_ISA
#undef HALFLIGHT_LANES
#undef HALFLIGHT_TARGET
#undef HALFLIGHT_OP
#undef HALFLIGHT_LAMBDA

#define HALFLIGHT_ISA avx512
#define HALFLIGHT_LANES 16
#define HALFLIGHT_TARGET __attribute__((target("avx512f,avx512vl,avx512dq,avx512bw,avx2,fma,bmi,popcnt")))
#include "kernels/all.inc"
#undef HALFLIGHT_ISA
#undef HALFLIGHT_LANES
#undef HALFLIGHT_TARGET
#undef HALFLIGHT_OP
#undef HALFLIGHT_LAMBDA
#endif

// The call in the namespace of the instruction set: its functions have the same names in each.
#ifdef HALFLIGHT_X86
#define HALFLIGHT_DISPATCH(isa, call) ((isa) == Isa::avx512 ? avx512::call : (isa) == Isa::avx2 ? avx2::call : portable::call)
#else
#define HALFLIGHT_DISPATCH(isa, call) (static_cast<void>(isa), portable::call)
#endif
