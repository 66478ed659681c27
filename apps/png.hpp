// SPDX-License-Identifier: MIT
#pragma once

// PNG, by stb_image_write.

#include <string>

#include "apps/picture.hpp"

namespace apps {

// The bytes of an 8-bit RGB PNG file; empty when memory ran out.
[[nodiscard]] std::string to_png(const Picture& picture);

}  // namespace apps
