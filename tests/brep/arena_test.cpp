// SPDX-License-Identifier: MIT
// A BRep in the user's memory: the same records as on the heap, all memory from the given allocator, copies and moves between arenas.

#include <brep/builder.hpp>
#include <brep/euler_log.hpp>

#include <cstdio>
#include <memory>
#include <memory_resource>
#include <vector>

#include "calls.hpp"

using namespace brep;

std::size_t allocation_count();  // allocation_count.cpp

namespace {

using Allocator = std::pmr::polymorphic_allocator<std::byte>;

struct Listed {  // data that own memory: it comes from the arena as well, since the pool hands its allocator on
  using allocator_type = Allocator;
  std::pmr::vector<int> list;
  Listed() = default;
  explicit Listed(const Allocator& a) : list(a) {}
  Listed(const Listed& other, const Allocator& a) : list(other.list, a) {}
  Listed(Listed&& other, const Allocator& a) : list(std::move(other.list), a) {}
  Listed(const Listed&) = default;
  Listed(Listed&&) = default;
  Listed& operator=(const Listed&) = default;
  Listed& operator=(Listed&&) = default;
  ~Listed() = default;
};
using InArena = BRep<Listed, Listed, Listed, EulerLog, Allocator>;
using OnHeap = BRep<NoData, NoData, NoData, EulerLog>;

// Memory from a buffer alone: what does not fit, or goes elsewhere, throws. Counts what is asked for and given back.
class Arena : public std::pmr::memory_resource {
 public:
  explicit Arena(std::size_t bytes)
      : buffer_(std::make_unique<std::byte[]>(bytes)), bytes_(bytes), blocks_(buffer_.get(), bytes, std::pmr::null_memory_resource()) {}
  [[nodiscard]] bool holds(const void* p) const {
    return std::less_equal<>()(static_cast<const void*>(buffer_.get()), p) &&
           std::less<>()(p, static_cast<const void*>(buffer_.get() + bytes_));
  }
  [[nodiscard]] std::size_t in_use() const { return in_use_; }

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    in_use_ += bytes;
    return blocks_.allocate(bytes, alignment);
  }
  void do_deallocate(void* p, std::size_t bytes, std::size_t) override {
    REQUIRE(holds(p));
    in_use_ -= bytes;
  }
  [[nodiscard]] bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

  std::unique_ptr<std::byte[]> buffer_;
  std::size_t bytes_, in_use_ = 0;
  std::pmr::monotonic_buffer_resource blocks_;
};

// Everything that the BRep and its data own.
bool lies_in(const InArena& m, const Arena& arena) {
  bool all = true;
  const auto look = [&](const auto& id) {
    all = all && arena.holds(&detail::Raw::at(m, id)) && arena.holds(&m.data(id));
    const auto& list = m.data(id).list;
    all = all && (list.empty() || arena.holds(list.data()));
  };
  for (VertexId v : vertices(m)) { look(v); }
  for (HalfedgeId h : halfedges(m)) { look(h); }
  for (FaceId f : faces(m)) { look(f); }
  const auto& log = detail::Raw::log(m);
  return all && (log.past.empty() || arena.holds(log.past.data())) && (log.future.empty() || arena.holds(log.future.data()));
}

std::vector<int> all_data(const InArena& m) {
  std::vector<int> all;
  const auto add = [&](const auto& id) { all.insert(all.end(), m.data(id).list.begin(), m.data(id).list.end()); };
  for (VertexId v : vertices(m)) { add(v); }
  for (HalfedgeId h : halfedges(m)) { add(h); }
  for (FaceId f : faces(m)) { add(f); }
  return all;
}

// The same calls on both; new elements get some data.
void grow(InArena& m, OnHeap& twin_on_heap, std::uint32_t seed, int calls) {
  shapes::Random random(seed);
  for (int i = 0; i < calls; ++i) {
    const calls::Call call = calls::random_call(m, random, 60);
    const bool done = calls::apply(m, call).done;
    REQUIRE(done == calls::apply(twin_on_heap, call).done);
    for (VertexId v : vertices(m)) {
      if (m.data(v).list.empty()) { m.data(v).list = {i, static_cast<int>(v.index)}; }
    }
  }
}

}  // namespace

TEST_CASE("a BRep in an arena has the records of one on the heap, and no memory comes from elsewhere") {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    INFO("seed " << seed);
    Arena arena(std::size_t{1} << 23);
    OnHeap twin_on_heap;
    {
      InArena m{Allocator(&arena)};
      CHECK(m.get_allocator().resource() == &arena);
      grow(m, twin_on_heap, seed, 300);
      CHECK(shapes::records(m) == shapes::records(twin_on_heap));
      CHECK(lies_in(m, arena));
      CHECK(arena.in_use() >= m.bytes());
      while (undo(m)) { REQUIRE(undo(twin_on_heap)); }
      while (redo(m)) { REQUIRE(redo(twin_on_heap)); }
      CHECK(shapes::records(m) == shapes::records(twin_on_heap));
      CHECK(lies_in(m, arena));
    }
    CHECK(arena.in_use() == 0);  // all was given back
  }
}

TEST_CASE("operators on a BRep in an arena call neither operator new nor the default resource") {
  Arena arena(std::size_t{1} << 20);
  struct Back {  // no default resource while this lives
    std::pmr::memory_resource* before = std::pmr::set_default_resource(std::pmr::null_memory_resource());
    ~Back() { std::pmr::set_default_resource(before); }
  } no_default;
  BRep<NoData, NoData, shapes::Face, EulerLog, Allocator> m{Allocator(&arena)};
  const std::size_t before = allocation_count();
  const HalfedgeId first = *make_segment(m);
  bool good = true;
  for (int i = 0; i < 1000; ++i) {
    const auto n = split_edge(m, first);
    good = good && n && split_face(m, *n, m.next(m.next(*n)));
  }
  while (m.face_count() > 500 && undo(m)) {}
  while (redo(m)) {}
  const std::size_t after = allocation_count();
  CHECK(good);
  CHECK(after == before);
  CHECK(m.face_count() == 1001);
}

TEST_CASE("copies and moves between arenas keep every record and datum, and each BRep stays in its own arena") {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    INFO("seed " << seed);
    Arena second(std::size_t{1} << 23);
    InArena kept{Allocator(&second)};
    std::vector<std::uint32_t> records;
    std::vector<int> data;
    {
      Arena first(std::size_t{1} << 23);
      OnHeap twin_on_heap;
      InArena m{Allocator(&first)};
      grow(m, twin_on_heap, seed, 200);
      records = shapes::records(m);
      data = all_data(m);
      const auto is_whole = [&](const InArena& x) { return shapes::records(x) == records && all_data(x) == data; };
      InArena copy(m, Allocator(&second));  // into a given arena
      CHECK((is_whole(copy) && lies_in(copy, second)));
      InArena assigned{Allocator(&second)};
      assigned = m;  // the allocator stays
      CHECK((is_whole(assigned) && lies_in(assigned, second)));
      InArena moved(std::move(m));  // hands the memory over
      CHECK((is_whole(moved) && lies_in(moved, first)));
      CHECK((m.edge_count() == 0 && make_segment(m)));  // NOLINT: empty and usable
      kept = std::move(moved);                          // element by element
      CHECK((is_whole(kept) && lies_in(kept, second)));
      CHECK((moved.edge_count() == 0 && mark(moved) == 0));  // NOLINT
      const InArena on_default = kept;                       // a copy alone: the allocator says where, here the default resource
      CHECK((is_whole(on_default) && on_default.get_allocator().resource() == std::pmr::get_default_resource()));
      std::swap(copy, kept);
      CHECK((is_whole(copy) && is_whole(kept)));
    }
    CHECK((shapes::records(kept) == records && all_data(kept) == data && lies_in(kept, second)));  // the first arena is gone
    while (undo(kept)) { REQUIRE(shapes::faults(kept) == ""); }
    CHECK(kept.edge_count() == 0);
  }
}

TEST_CASE("close() builds into a given arena") {
  Arena arena(std::size_t{1} << 20);
  using Solid = BRep<shapes::Vertex, NoData, shapes::Face, NoLog, Allocator>;
  const auto result = close<Solid>(shapes::torus_builder(5, 7), Allocator(&arena));
  REQUIRE(result.brep);
  CHECK(shapes::records(*result.brep) == shapes::records(*close<shapes::Mesh>(shapes::torus_builder(5, 7)).brep));
  CHECK(arena.holds(&result.brep->data(VertexId{0})));
  CHECK(arena.in_use() == result.brep->bytes());
}
