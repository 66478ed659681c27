// SPDX-License-Identifier: MIT
#pragma once

// The options about files of other programs, for every command that takes a scene. They change nothing of a .scene file.

#include <string>
#include <vector>

#include "apps/commands/command.hpp"
#include "apps/intake/to_scene.hpp"

namespace apps {

[[nodiscard]] inline Argument lamp_argument(std::vector<Lamp>& lamps) {
  const auto take = [&lamps](const std::string& text) {
    const auto lamp = parse_lamp(text);
    if (lamp) { lamps.push_back(*lamp); }
    return lamp ? std::string() : "expected MATERIAL or MATERIAL=W/m2, the name of a material and a number from 0 on, found '" + text + "'";
  };
  return {"--lamp", "MATERIAL[=W/m2]",
          "of a file of another program: a material that shines, with its exitance (default: 100 W/m2); repeat for more", take,
          Argument::Values::repeated};
}

// The arguments of a command, and these behind them.
[[nodiscard]] inline std::vector<Argument> with_model_arguments(std::vector<Argument> arguments, ModelOptions& options) {
  arguments.push_back(lamp_argument(options.lamps));
  arguments.push_back(flag("--two-sided", options.two_sided, "of such a file: surfaces that enclose nothing reflect on both sides"));
  arguments.push_back(
      above_zero("--reflectance", options.reflectance, most_reflectance,
                 "of such a file: reflectance of materials that have none (default: " + formatted("%g", options.reflectance) + ")"));
  arguments.push_back(parsed("--units", "UNIT", options.metres, parse_unit, "mm, cm, m, km, in, ft or a number above 0 (metres)",
                             "of such a file: length of one unit, mm, cm, m, km, in, ft or a number of metres (default: m)"));
  arguments.push_back(
      one_of<std::optional<UpAxis>, UpAxis>("--up", options.up, {{"x", UpAxis::x}, {"y", UpAxis::y}, {"z", UpAxis::z}},
                                            "of such a file: axis that points up, x, y or z (default: z for .ply, .off and .mgf, else y)"));
  arguments.push_back(flag("--as-given", options.merge, "of such a file: coplanar polygons are not merged into faces", false));
  return arguments;
}

}  // namespace apps
