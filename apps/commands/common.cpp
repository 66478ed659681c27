// SPDX-License-Identifier: MIT
#include "apps/commands/common.hpp"

#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

namespace apps {

void complain(const std::string& sentence) { std::fprintf(stderr, "halflight: %s\n", sentence.c_str()); }

std::string resolved(const std::string& path) {
  std::error_code error;
  const std::filesystem::path canonical = std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
  return error ? path : canonical.string();
}

std::optional<SceneFile> load_scene(const std::string& path, ExitCode& code) {
  std::string fault;
  const std::optional<std::string> text = read_text(path, fault);
  if (!text) {
    complain(path + " " + fault);
    code = ExitCode::invalid_input;
    return std::nullopt;
  }
  SceneResult result = parse_scene(*text);
  if (!result.file) {
    std::fputs(to_text(result, path).c_str(), stderr);
    code = ExitCode::invalid_input;
    return std::nullopt;
  }
  return std::move(result.file);
}

}  // namespace apps
