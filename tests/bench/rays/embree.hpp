// SPDX-License-Identifier: MIT
#pragma once

// Debian's Embree 3 behind plain functions: single rays and packets of 8 and 16, built-in spheres or spheres of user geometry (the better
// of the two differs by row). Rays run from 1e-5 to 1 - 1e-5, as their users avoid the surfaces at the ends.

#include "sets.hpp"

namespace bench {

class Embree {
 public:
  Embree(const World& world, bool user_spheres);
  ~Embree();
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
  [[nodiscard]] double build_seconds() const { return build_seconds_; }

  // Writes 1 for every occluded ray (of a closest set: for every ray that meets something), `width` 1, 8 or 16 rays at a time.
  void run(const Set& set, int width, std::vector<std::uint8_t>& verdicts) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
  double build_seconds_ = 0.0;
};

[[nodiscard]] double cpu_seconds();  // of this thread

}  // namespace bench
