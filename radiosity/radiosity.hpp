// SPDX-License-Identifier: MIT
#pragma once

// The facade: a scene goes in, a mesh with radiosities and the audit of the run come out.
//
//   objects -> one BRep an object -> roots -> refine (oracle) -> expose -> evaluate links -> solve -> reconstruct -> audit
//
// Data flows one way; the objects stay untouched. The library prints nothing, opens no file and throws nothing.

#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

namespace radiosity {

// Solves the scene. With an error target the run starts coarse and refines until the audit confirms the target, that is, until the upper
// end of the 95 % interval of the error is at most the target. The times reported are sums over all rounds. If the target is not reached,
// audit.converged is false; accuracy_target.hpp says when a run gives up.
//
// Running out of memory is an outcome, too: either the best solution that fits, with audit.shortage set, or Failure::Kind::out_of_memory.
// A thread that cannot be started is done without. In a program compiled without exceptions the platform ends the process when an
// allocation fails; to end the run before that, set Options::memory.
[[nodiscard]] Outcome solve(const Scene& scene, const Options& options = {}, const Control& control = {});

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/radiosity.cpp>
#endif
