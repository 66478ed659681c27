// SPDX-License-Identifier: MIT
// The halflight program: reads the command line, runs one command, and returns its exit code.
#include <exception>
#include <new>

#include "apps/commands/command.hpp"
#include "apps/commands/common.hpp"
#include "apps/process.hpp"

int main(int argc, char** argv) {
  apps::guard_process();
  try {
    apps::claim_stack();
    const std::vector<apps::Command> commands = {apps::render_command(),   apps::info_command(),    apps::mesh_command(),
                                                 apps::check_command(),    apps::factors_command(), apps::stress_command(),
                                                 apps::euler_command(),    apps::study_command(),   apps::explain_command(),
                                                 apps::exercise_command(), apps::figures_command()};
    return static_cast<int>(apps::run_program(commands, argc, argv));
  } catch (const std::bad_alloc&) {
    apps::complain("out of memory; a smaller scene needs less, and so does render with a larger --epsilon or --min-area");
  } catch (const std::exception& error) { apps::complain(std::string("failed: ") + error.what()); }
  return static_cast<int>(apps::ExitCode::failure);
}
