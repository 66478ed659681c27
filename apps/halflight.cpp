// SPDX-License-Identifier: MIT
// The halflight program: reads the command line, runs one command, ends with its exit code.
#include <cstdio>
#include <exception>
#include <new>
#include <span>
#include <sstream>

#include <CLI/CLI.hpp>

#include "apps/commands/check.hpp"
#include "apps/commands/common.hpp"
#include "apps/commands/euler.hpp"
#include "apps/commands/factors.hpp"
#include "apps/commands/info.hpp"
#include "apps/commands/mesh.hpp"
#include "apps/commands/render.hpp"
#include "apps/commands/stress.hpp"
#include "apps/commands/study.hpp"
#include "apps/commands/usage.hpp"
#include "apps/interrupt.hpp"
#include "apps/version.hpp"

namespace {

int run(int argc, char** argv) {
  CLI::App app("Radiosity for scenes of diffuse surfaces: every run says how wrong it is and how long it took.", "halflight");
  app.set_version_flag("--version", std::string("halflight ") + apps::version);
  app.footer(
      "Exit codes: 0 done, 1 failure, 2 wrong usage, 3 invalid scene, mesh or script, 4 not converged.\n"
      "'-' as a scene is the standard input; an output '-' is the standard output, and what is told goes to stderr then.");
  app.require_subcommand(1);
  apps::RenderOptions render;
  apps::InfoOptions info;
  apps::MeshOptions mesh;
  apps::CheckOptions check;
  apps::EulerOptions euler;
  apps::FactorsOptions factors;
  apps::StressOptions stress;
  apps::StudyOptions study;
  CLI::App* const render_command = app.add_subcommand("render", "solve a scene; write a picture or a mesh and the report");
  CLI::App* const info_command = app.add_subcommand("info", "say what is in a scene without solving it");
  CLI::App* const mesh_command = app.add_subcommand("mesh", "the polygons of each object: counts, genus, area, volume, and a mesh file");
  CLI::App* const check_command = app.add_subcommand("check", "say what a polygon mesh is and everything that is wrong with it");
  CLI::App* const factors_command = app.add_subcommand("factors", "the form factors between the surfaces of a scene, each with its error");
  CLI::App* const stress_command = app.add_subcommand("stress", "solve stiff and extreme scenes, each figure against its bound");
  CLI::App* const euler_command = app.add_subcommand("euler", "play a script of Euler operators; draw each step");
  CLI::App* const study_command = app.add_subcommand("study", "error against time, memory and links for every method on each scene");
  apps::describe(*study_command, study);
  apps::describe(*render_command, render);
  apps::describe(*info_command, info);
  apps::describe(*mesh_command, mesh);
  apps::describe(*check_command, check);
  apps::describe(*euler_command, euler);
  apps::describe(*factors_command, factors);
  apps::describe(*stress_command, stress);
  const std::span<const char* const> arguments(argv + 1, argv + argc);
  if (const auto fault = apps::empty_argument(arguments)) {
    apps::complain(*fault);
    return static_cast<int>(apps::ExitCode::usage);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) {
      apps::complain(apps::explain(app, error, arguments));
      return static_cast<int>(apps::ExitCode::usage);
    }
    std::ostringstream help;
    app.exit(error, help);
    return static_cast<int>(apps::print(help.str()) ? apps::ExitCode::ok : apps::ExitCode::failure);
  }
  if (render_command->parsed()) { return static_cast<int>(apps::run(render)); }
  if (mesh_command->parsed()) { return static_cast<int>(apps::run(mesh)); }
  if (check_command->parsed()) { return static_cast<int>(apps::run(check)); }
  if (study_command->parsed()) { return static_cast<int>(apps::run(study)); }
  if (factors_command->parsed()) { return static_cast<int>(apps::run(factors)); }
  if (stress_command->parsed()) { return static_cast<int>(apps::run(stress)); }
  return static_cast<int>(euler_command->parsed() ? apps::run(euler) : apps::run(info));
}

}  // namespace

int main(int argc, char** argv) {
  apps::guard_process();
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    apps::complain("out of memory; a larger --epsilon or --min-area needs less");
  } catch (const std::exception& error) { apps::complain(std::string("failed: ") + error.what()); }
  return static_cast<int>(apps::ExitCode::failure);
}
