// SPDX-License-Identifier: MIT
#pragma once

// The stages of a run, in order. Each is one function on the run, defined in a source of its name; it records its time in the audit. If
// it returns a failure, the run ends.

#include <optional>

#include <radiosity/result/outcome.hpp>
#include <radiosity/run/run.hpp>

namespace radiosity {

namespace stage {

// Makes one BRep per object, cuts it at walls and across long faces, and makes the hierarchy of input faces or clusters of them.
[[nodiscard]] std::optional<Failure> build(detail::Run& run);
// Splits patches and chooses the links between them (f_refine.hpp, bf_refine.hpp). BF-refinement evaluates its links as it goes.
[[nodiscard]] std::optional<Failure> refine(detail::Run& run);
// Measures which part of each patch is not buried under other objects.
[[nodiscard]] std::optional<Failure> expose(detail::Run& run);
// Computes form factors and visibility of the links.
[[nodiscard]] std::optional<Failure> link(detail::Run& run);
// Closes the row sums of a closed scene and solves for the radiosity of all leaves. From here on there is a solution.
[[nodiscard]] std::optional<Failure> solve(detail::Run& run);
// If a comparison is requested: a solution with all pairs of leaves instead of links.
[[nodiscard]] std::optional<Failure> compare_matrix(detail::Run& run);
// Makes the mesh with radiosities at its corners.
[[nodiscard]] std::optional<Failure> reconstruct(detail::Run& run);
// If a comparison is requested: the mesh of the other reconstruction.
[[nodiscard]] std::optional<Failure> compare_picture(detail::Run& run);
// If requested: a mesh in gathered light, split where the mesh of the leaves is not accurate enough.
[[nodiscard]] std::optional<Failure> refine_mesh(detail::Run& run);
// Reports what the run did, what it held in memory, and which shortcuts it took.
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
