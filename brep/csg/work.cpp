// SPDX-License-Identifier: MIT
#include <brep/csg/work.hpp>

#include <cstdint>

#include <brep/csg/boundary.hpp>
#include <brep/csg/plane.hpp>
#include <brep/inline.hpp>

namespace brep::csg::detail {

HALFLIGHT_INLINE void Work::add(const Boundary& b, bool of_b, bool reversed, std::uint32_t attributes) {
  const auto p0 = static_cast<std::uint32_t>(points.size()), h0 = static_cast<std::uint32_t>(halves.size());
  const auto f0 = static_cast<std::uint32_t>(faces.size());
  points.insert(points.end(), b.points.begin(), b.points.end());
  halves.resize(h0 + b.halves.size());
  WorkHalf* const added = halves.data() + h0;
  for (std::uint32_t h = 0; h < b.halves.size(); ++h) {
    const Half& given = b.halves[h];
    WorkHalf& half = added[h];
    half.twin = h0 + given.twin, half.face = f0 + given.face, half.across = given.across;
    if (reversed) {
      half.point = p0 + b.halves[given.next].point;
      half.prev = h0 + given.next;
      added[given.next].next = h0 + h;
    } else {
      half.point = p0 + given.point;
      half.next = h0 + given.next;
      added[given.next].prev = h0 + h;
    }
  }
  for (const Face& f : b.faces) {
    faces.push_back({reversed ? f.plane.flipped() : f.plane, h0 + f.first, f.count, attributes + f.attribute, of_b, false, f.box});
  }
  if (!of_b) { faces_a = static_cast<std::uint32_t>(faces.size()); }
  halves_given = static_cast<std::uint32_t>(halves.size());
}

}  // namespace brep::csg::detail
