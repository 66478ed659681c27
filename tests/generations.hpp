// SPDX-License-Identifier: MIT
#pragma once

// An observer of refinement that asks of every BRep after every generation what has to hold.

#include <vector>

#include <brep/circulators.hpp>
#include <brep/validate.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/radiosity.hpp>

#include "catch.hpp"

// Counts the generations; each BRep is valid and has v - e + f = 2 (s - h).
inline radiosity::Control watch_generations(int& generations) {
  radiosity::Control control;
  control.after_generation = [&generations](const std::vector<radiosity::Surface>& surfaces) {
    ++generations;
    for (const radiosity::Surface& surface : surfaces) {
      const auto faults = brep::validate(surface.brep);
      for (const auto& fault : faults) { UNSCOPED_INFO(fault.sentence); }
      REQUIRE(faults.empty());
      const auto euler = static_cast<long>(surface.brep.vertex_count()) - static_cast<long>(surface.brep.edge_count()) +
                         static_cast<long>(surface.brep.face_count());
      REQUIRE(euler == 2 * (static_cast<long>(brep::shell_count(surface.brep)) - brep::genus(surface.brep)));
    }
  };
  return control;
}
