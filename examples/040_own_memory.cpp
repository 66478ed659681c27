// SPDX-License-Identifier: MIT
//
// A BRep in memory of your own: the last template argument is an allocator (paper 2.2). Here it takes everything from one
// buffer, which a renderer may keep from frame to frame: nothing is asked of the heap, and nothing has to be given back piece by piece.

#include <array>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <memory_resource>

#include <brep/circulators.hpp>
#include <brep/euler_log.hpp>

namespace {

struct Vertex {
  double x = 0.0, y = 0.0;
};

using Allocator = std::pmr::polymorphic_allocator<std::byte>;
using Solid = brep::BRep<Vertex, brep::NoData, brep::NoData, brep::EulerLog, Allocator>;

std::array<std::byte, 65536> buffer;

bool in_buffer(const void* p) {
  return std::less_equal<>()(static_cast<const void*>(buffer.data()), p) &&
         std::less<>()(p, static_cast<const void*>(buffer.data() + buffer.size()));
}

}  // namespace

int main() {
  for (int corners = 3; corners <= 5; ++corners) {
    // Each solid begins at the start of the buffer. What it cannot hold is not asked of anybody else: the null resource has nothing to
    // give.
    std::pmr::monotonic_buffer_resource arena(buffer.data(), buffer.size(), std::pmr::null_memory_resource());
    Solid prism{Allocator(&arena)};
    const brep::HalfedgeId first = *brep::make_segment(prism);  // a polygon with two sides: a path, and an edge between its ends
    brep::HalfedgeId last = first;
    for (int i = 2; i < corners; ++i) { last = *brep::split_edge(prism, last); }
    const brep::FaceId bottom = prism.face(twin(*brep::split_face(prism, twin(last), first)));

    // A post at each corner of the bottom, then an edge from tip to tip.
    brep::HalfedgeId corner = prism.halfedge(bottom), rim{};
    std::array<brep::HalfedgeId, 5> post{};
    for (int i = 0; i < corners; ++i, corner = prism.next(corner)) {
      post[static_cast<std::size_t>(i)] = *brep::split_vertex(prism, corner, corner);
    }
    for (int i = 0; i < corners; ++i) {
      const brep::HalfedgeId tip = twin(post[static_cast<std::size_t>(i)]);
      const brep::HalfedgeId h = *brep::split_face(prism, tip, i + 1 < corners ? twin(post[static_cast<std::size_t>(i + 1)]) : rim);
      if (i == 0) { rim = h; }
    }

    bool inside = true;
    for (brep::VertexId v : brep::vertices(prism)) { inside = inside && in_buffer(&prism.data(v)); }
    inside = inside && in_buffer(brep::steps(prism).data());  // the log as well
    std::printf("v %zu e %zu f %zu, %zu steps in the log, all in the buffer: %s\n", prism.vertex_count(), prism.edge_count(),
                prism.face_count(), brep::mark(prism), inside ? "yes" : "no");

    Solid on_heap = prism;  // a copy gets the default resource; Solid(prism, allocator) says where
    std::printf("a copy lies elsewhere: %s, and has %zu faces\n", in_buffer(&on_heap.data(brep::VertexId{0})) ? "no" : "yes",
                on_heap.face_count());
  }
}
