// SPDX-License-Identifier: MIT
#pragma once

// The stages of a run, in their order. Each is one function over the run, in a source of its name, that leaves its time in the audit; one
// that gives back a failure ends the run.

#include <optional>

#include <radiosity/result/outcome.hpp>
#include <radiosity/run/run.hpp>

namespace radiosity {

namespace stage {

// One BRep an object, cut where walls meet and where faces are long; the input faces, or clusters of them, are the hierarchy.
[[nodiscard]] std::optional<Failure> build(detail::Run& run);
// Splits patches and chooses the links between them (f_refine.hpp, bf_refine.hpp). BF-refinement evaluates its links as it goes.
[[nodiscard]] std::optional<Failure> refine(detail::Run& run);
// Measures what of each patch is not buried under other objects.
[[nodiscard]] std::optional<Failure> expose(detail::Run& run);
// Puts form factors and visibility into the links.
[[nodiscard]] std::optional<Failure> link(detail::Run& run);
// Closes the row sums of a closed scene and solves for the radiosity of all leaves. From here on there is a solution.
[[nodiscard]] std::optional<Failure> solve(detail::Run& run);
// When a comparison is asked for: a solution with all pairs of leaves instead of links.
[[nodiscard]] std::optional<Failure> compare_matrix(detail::Run& run);
// The mesh with radiosities at its corners.
[[nodiscard]] std::optional<Failure> reconstruct(detail::Run& run);
// When a comparison is asked for: the mesh of the other reconstruction.
[[nodiscard]] std::optional<Failure> compare_picture(detail::Run& run);
// When asked for: a mesh in gathered light, split where that was not met by the mesh of the leaves.
[[nodiscard]] std::optional<Failure> refine_mesh(detail::Run& run);
// What the run did, what it held, and what it left out.
[[nodiscard]] std::optional<Failure> summarise(detail::Run& run);
// Measures the error of the solution by path tracing.
[[nodiscard]] std::optional<Failure> audit(detail::Run& run);

}  // namespace stage

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/run/audit.cpp>
#include <radiosity/run/build.cpp>
#include <radiosity/run/compare.cpp>
#include <radiosity/run/expose.cpp>
#include <radiosity/run/link.cpp>
#include <radiosity/run/reconstruct.cpp>
#include <radiosity/run/refine.cpp>
#include <radiosity/run/refine_mesh.cpp>
#include <radiosity/run/solve.cpp>
#include <radiosity/run/summarise.cpp>
#endif
