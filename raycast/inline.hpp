// SPDX-License-Identifier: MIT
#pragma once

#include <brep/inline.hpp>
