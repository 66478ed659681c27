// SPDX-License-Identifier: MIT
#pragma once

// Small scenes with known answers: those of `halflight stress`.

#include <radiosity/radiosity.hpp>

#include "apps/stress/scenes.hpp"

namespace scenes {

using namespace apps::stress;

}  // namespace scenes
