// SPDX-License-Identifier: MIT
#include "apps/explain/recording.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/oracle/f_oracle.hpp>

#include "apps/text.hpp"

namespace apps::explain {

using radiosity::Decision;

std::string number(double x) { return formatted("%.3g", x); }

namespace {

// The numbers in the paper's formula (4.3), F = cos cos A / (pi r^2 + A), that give the estimate. form_factor_estimate evaluates it
// between the centres with the larger area, or at the nearest point of a disk of this area, or, if one patch reaches below the other's
// horizon, at the highest points.
std::string estimate_of(const Recording& recording, const Pair& pair) {
  const radiosity::Node &p = recording.nodes[pair.p], &q = recording.nodes[pair.q];
  const double area = std::max(p.area, q.area);
  const auto same = [&](double estimate) { return std::abs(estimate - pair.estimate) <= 1e-6 * pair.estimate; };
  const auto cosines = [&](const glm::dvec3& x, const glm::dvec3& y) {
    const glm::dvec3 way = glm::normalize(y - x);
    return "cosines " + number(glm::dot(p.normal, way)) + " and " + number(-glm::dot(q.normal, way));
  };
  const double r = glm::length(q.centre - p.centre);
  const std::string head = "disk estimate F = " + number(pair.estimate) + " (" + number(p.area) + " and " + number(q.area) + " m2, ";
  if (same(radiosity::disk_estimate(p.centre, p.normal, q.centre, q.normal, area))) {
    return head + "centres " + number(r) + " m apart, " + cosines(p.centre, q.centre) + ")";
  }
  const glm::dvec3 near_p = radiosity::nearest_point(p, q.centre), near_q = radiosity::nearest_point(q, p.centre);
  for (const bool of_p : {true, false}) {
    const glm::dvec3 &x = of_p ? near_p : p.centre, &y = of_p ? q.centre : near_q;
    if (same(radiosity::disk_estimate(x, p.normal, y, q.normal, of_p ? p.area : q.area))) {
      return head + number(glm::length(y - x)) + " m from the nearest point of the disk of " + recording.names[of_p ? pair.p : pair.q] +
             ", " + cosines(x, y) + ")";
    }
  }
  const double product = pair.estimate * (std::numbers::pi * r * r + area) / area;
  return head + "centres " + number(r) + " m apart, cosines multiply to " + number(product) +
         ": where a patch crosses the other's horizon, at its highest point)";
}

}  // namespace

std::string sentence_of(const Recording& recording, const Pair& pair) {
  const radiosity::Node &p = recording.nodes[pair.p], &q = recording.nodes[pair.q];
  const std::string of_p = recording.names[pair.p], of_q = recording.names[pair.q];
  switch (pair.decision) {
    case Decision::drop:
      return radiosity::face_away(p, q) ? "face away from each other: no link"
                                        : "neither shines, and no light that is reflected reaches one of them: no link";
    case Decision::convex:
      return "lie in one plane or on one convex solid and cannot see each other: no link";
    case Decision::hide:
      return "one object hides each from the other, or one is buried: no link";
    default:
      break;
  }
  const double epsilon = recording.wanted.epsilon;
  const bool above = pair.estimate > epsilon;
  const std::string compared = estimate_of(recording, pair) + (above ? " > " : " <= ") + number(epsilon);
  if (pair.decision == Decision::link) { return compared + (above ? ", but neither is larger than the least area: link" : ": link"); }
  const std::string split = pair.decision == Decision::split_p ? of_p : of_q;
  if (pair.by_light) { return compared + ": link, but the light that it brings varies too much over " + split + ": split " + split; }
  if (pair.by_form_factor == Decision::link) {
    return compared + ", but the light of the lamp varies too much over " + split + ": split " + split;
  }
  const bool equal = std::abs(p.area - q.area) <= 1e-6 * std::max(p.area, q.area);
  return compared + ": split " + split + (equal ? "" : ", the larger");
}

std::string sentence_of(const Recording& recording, const LinkRecord& link) {
  const double area_p = recording.nodes[link.p].area, area_q = recording.nodes[link.q].area;
  const auto arrived = std::count_if(link.rays.begin(), link.rays.end(), [](const Ray& ray) { return ray.arrives; });
  const std::string rays = link.proven         ? "nothing can stand between, so no ray was needed"
                           : link.rays.empty() ? "no point that was tried is above the other's horizon, so one ray was cast, between the "
                                                 "highest corners, and arrives"
                                               : std::to_string(arrived) + " of " + std::to_string(link.rays.size()) +
                                                     " rays arrive, visibility " + number(link.visibility);
  return "F = " + number(link.exchange / area_p) + " from the first to the second, " + number(link.exchange / area_q) + " back; " + rays;
}

std::string sentence_of(const Recording& recording, const BfChoice& choice) {
  const auto& names = recording.bf_names;
  const std::string sum = number(static_cast<double>(choice.error_p) + static_cast<double>(choice.error_q));
  const std::string split = choice.decision == Decision::split_p ? names[choice.p] : names[choice.q];
  if (choice.p == choice.q) {
    return names[choice.p] + ": squared error " + sum + " within the leaf, its links will do" +
           (choice.decision == Decision::link ? "; it cannot be split any more" : ": split it");
  }
  return names[choice.p] + " - " + names[choice.q] + ": squared error " + sum + ", of which splitting the first mends " +
         number(static_cast<double>(choice.error_p)) + ", the second " + number(static_cast<double>(choice.error_q)) +
         (choice.decision == Decision::link ? "; neither can be split any more" : ": split " + split);
}

namespace {

std::string refinement(const Recording& r) {
  std::string out = "\nRefinement by form factor (paper 4.4), threshold " + number(r.wanted.epsilon) + "\n";
  std::size_t links = 0;
  std::uint32_t last = 0;
  for (const Pair& pair : r.pairs) { last = std::max(last, pair.generation); }
  // Pairs may also be created late, when links are split.
  for (std::uint32_t generation = 0; generation <= last && !r.pairs.empty(); ++generation) {
    out += "generation " + std::to_string(generation) + ":\n";
    for (const Pair& pair : r.pairs) {
      if (pair.generation != generation) { continue; }
      links += pair.decision == Decision::link ? 1 : 0;
      out += "  " + r.names[pair.p] + " - " + r.names[pair.q] + ": " + pair.sentence + "\n";
    }
  }
  const auto leaves =
      static_cast<std::size_t>(std::count_if(r.nodes.begin(), r.nodes.end(), [](const radiosity::Node& node) { return node.leaf(); }));
  return out + std::to_string(r.pairs.size()) + " questions, " + std::to_string(links) + " links among n = " + std::to_string(leaves) +
         " leaves, where a matrix has n^2 = " + std::to_string(leaves * leaves) + " entries\n";
}

std::string light(const Recording& r) {
  std::string out = "\nGather, push, pull: mean radiosity that each input face sends, W/m2, and the mean irradiance that arrives\n";
  for (std::size_t n = 0; n < r.iterations.size(); ++n) {
    const Iteration& step = r.iterations[n];
    out += "iteration " + std::to_string(n) + ":";
    for (std::size_t i = 0; i < r.nodes.size() && r.nodes[i].parent == radiosity::no_node; ++i) {
      out += "  " + r.names[i] + " " + number(step.sent[i]) + " <- " + number(step.mean[i]);
    }
    out += "  (change " + number(step.residual) + ")\n";
  }
  if (r.closure) {
    out += "What leaves send and take is scaled so that form factors sum to 1 where no light is lost; they were off by " +
           number(100.0 * *r.closure) + " %\n";
  }
  return out;
}

std::string t_vertices(const Recording& r) {
  std::size_t found = 0, faces = 0;
  std::string first;
  for (const LeafLoop& leaf : r.leaves) {
    const auto here = static_cast<std::size_t>(std::count(leaf.t_vertex.begin(), leaf.t_vertex.end(), true));
    if (here > 0 && faces++ == 0) { first = r.names[leaf.node]; }
    found += here;
  }
  const std::string head = "\nT-vertices: ";
  if (found == 0) { return head + "none, neighbours are of one level\n"; }
  return head + std::to_string(found) + " on " + std::to_string(faces) + " leaves, first on " + first +
         "; each has a level above that of the leaf and is connected to the nearest corner: " + std::to_string(r.leaves.size()) +
         " leaves become " + std::to_string(r.mesh.size()) + " faces\n";
}

std::string by_light(const Recording& r) {
  std::string out = "\nRefinement by the light that links carry (BF), target " + number(r.wanted.target) + "\n";
  for (std::size_t g = 0; g < r.bf.size(); ++g) {
    const BfGeneration& of = r.bf[g];
    out += "generation " + std::to_string(g) + ": " + std::to_string(of.leaves) + " leaves, " + std::to_string(of.links) +
           " links, estimated error " + formatted("%.3g %%", 100.0 * of.estimate) + "\n";
    const std::size_t told = std::min<std::size_t>(of.choices.size() == 4 ? 4 : 3, of.choices.size());
    for (std::size_t k = 0; k < told; ++k) { out += "  " + of.choices[k].sentence + "\n"; }
    if (told < of.choices.size()) { out += "  and " + std::to_string(of.choices.size() - told) + " with smaller errors\n"; }
  }
  return out;
}

std::string solvers(const char* title, const Comparison& comparison) {
  std::string out = std::string("\n") + title + ": residual after 1, 2, 4, 8, 16 passes over the links\n";
  for (const Method& method : comparison.methods) {
    out += "  " + method.name + std::string(24 - method.name.size(), ' ');
    for (std::size_t n = 1; n <= 16 && n < method.residual.size(); n *= 2) { out += " " + formatted("%-9.2g", method.residual[n]); }
    out.erase(out.find_last_not_of(' ') + 1);
    out += '\n';
  }
  return out;
}

}  // namespace

std::string story(const Recording& r) {
  std::string out = r.scene + ": " + std::to_string(r.nodes.size()) + " patches";
  out += std::string(", told in the ") + (r.channel == 0 ? "red" : r.channel == 1 ? "green" : "blue") + " channel\n" + refinement(r);
  out += "\nLinks: " + std::to_string(r.links.size()) + ", and " + std::to_string(r.too_faint) + " pairs between which nothing arrives\n";
  for (const LinkRecord& link : r.links) { out += "  " + r.names[link.p] + " - " + r.names[link.q] + ": " + link.sentence + "\n"; }
  return out + light(r) + t_vertices(r) + by_light(r) + solvers("Solvers", r.as_is) + solvers("Solvers, all that reflects at .99", r.at_99);
}

}  // namespace apps::explain
