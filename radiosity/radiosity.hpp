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

// Solves the scene. With an error target the run starts coarse and refines until the audit confirms the target: the upper end of its 95 %
// interval is at most that. Times are those of all rounds together. A run whose error stays above says so by audit.converged;
// accuracy_target.hpp says when it gives up.
//
// Memory that runs out is an outcome, too: the best solution that fits, with audit.shortage, or Failure::Kind::out_of_memory. A run does
// without a thread that cannot be started. A program that is compiled without exceptions is ended by the platform where memory runs out, as
// anywhere; Options::memory ends a run before that.
[[nodiscard]] Outcome solve(const Scene& scene, const Options& options = {}, const Control& control = {});

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/radiosity.cpp>
#endif
