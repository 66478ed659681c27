// SPDX-License-Identifier: MIT
// halflight figures -o DIR: the paper's figures 1 to 8.
#include <filesystem>
#include <memory>

#include "apps/commands/command.hpp"
#include "apps/commands/common.hpp"
#include "apps/figures/figures.hpp"
#include "apps/files.hpp"

namespace apps {
namespace {

ExitCode run(const std::string& folder) {
  const auto path = [&](const std::string& file) { return (std::filesystem::path(folder) / file).string(); };
  {
    const NewFolder only_to_check(folder);
    if (const auto fault = only_to_check.fault()) { return complain(*fault, ExitCode::failure); }
    if (const ExitCode code = check_outputs({path("index.html")}, {}); code != ExitCode::ok) { return code; }
  }
  const std::vector<figures::Figure> all = figures::make();
  const NewFolder made(folder);
  for (const figures::Figure& figure : all) {
    if (!save(path(figure.file), figure.svg)) { return ExitCode::failure; }
  }
  if (!save(path("index.html"), figures::page(all))) { return ExitCode::failure; }
  return print("written: " + path("index.html") + " with figures 1 to 8\n") ? ExitCode::ok : ExitCode::failure;
}

}  // namespace

Command figures_command() {
  const auto folder = std::make_shared<std::string>();
  return {"figures",
          "draw the paper's figures 1 to 8 from scenes and scripts",
          {text("-o,--output", "DIR", *folder, "the folder for figure1.svg to figure8.svg and index.html").must()},
          [folder] { return run(*folder); }};
}

}  // namespace apps
