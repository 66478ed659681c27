// SPDX-License-Identifier: MIT
#include "apps/explain/recording.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <utility>

#include <brep/circulators.hpp>
#include <brep/t_vertices.hpp>

#include <radiosity/exchange/exchange.hpp>
#include <radiosity/oracle/bf_oracle.hpp>
#include <radiosity/oracle/f_oracle.hpp>
#include <radiosity/picture/reconstruct.hpp>
#include <radiosity/refinement/link_error.hpp>
#include <radiosity/run/run.hpp>
#include <radiosity/run/stages.hpp>
#include <radiosity/scene/options.hpp>

namespace apps::explain {
namespace {

using radiosity::Decision;
using radiosity::detail::Run;

// "lower" for a root, "lower.2.0" for one of its descendants: the child numbers on the path to it.
std::vector<std::string> names_of(const radiosity::Hierarchy& nodes, const std::vector<radiosity::InputSurface>& surfaces) {
  std::map<std::uint32_t, int> faces, seen;
  for (const radiosity::Node& node : nodes) { faces[node.surface] += node.parent == radiosity::no_node ? 1 : 0; }
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    const radiosity::Node& node = nodes[i];
    if (node.parent != radiosity::no_node) {
      names.push_back(names[node.parent] + "." + std::to_string(i - nodes[node.parent].first_child));
    } else {
      const std::string number = faces[node.surface] > 1 ? "[" + std::to_string(seen[node.surface]++) + "]" : "";
      names.push_back(surfaces[node.surface].name + number);
    }
  }
  return names;
}

radiosity::Hierarchy in_scene(radiosity::Hierarchy nodes, const radiosity::Frame& frame) {
  for (radiosity::Node& node : nodes) {
    node.centre = frame.to_scene(node.centre);
    node.area = frame.to_scene_area(node.area);
    node.radius /= frame.scale;
  }
  return nodes;
}

radiosity::Polygon in_scene(radiosity::Polygon polygon, const radiosity::Frame& frame) {
  for (glm::dvec3& p : polygon) { p = frame.to_scene(p); }
  return polygon;
}

std::vector<radiosity::Polygon> contours_of(const Run& run) {
  std::vector<radiosity::Polygon> contours;
  for (std::size_t i = 0; i < run.scene.hierarchy.size(); ++i) {
    contours.push_back(in_scene(run.scene.patches[i].contour, run.scene.frame));
  }
  return contours;
}

radiosity::Options options_of(const Wanted& wanted) {
  return {.epsilon = wanted.epsilon,
          .min_area = wanted.min_area,
          .light_epsilon = wanted.light_epsilon.value_or(wanted.epsilon),
          .indirect = radiosity::Indirect::links,
          .cluster_from = 0xffffffff,
          .audit_points = 0,
          .threads = 1};
}

// Records the decisions reported by Control::decided.
class Watch {
 public:
  Watch(Recording& recording, std::atomic<bool>& too_many) : recording_{recording}, too_many_{too_many} {}

  void take(const radiosity::Question& question, Decision decision) {
    if (const auto known = by_ends_.find(key(question.p, question.q)); known != by_ends_.end()) {
      Pair& pair = recording_.pairs[known->second];
      if (pair.decision == Decision::link && decision > Decision::link) {  // because of the light that it carries
        pair.decision = decision;
        pair.by_light = true;
      }
      return;
    }
    Pair pair{question.p, question.q, {}, 0, 0.0, decision, decision, false, {}};
    pair.estimate = radiosity::form_factor_estimate(question.node_p(), question.node_q());
    if (decision >= radiosity::first_seeing) { pair.by_form_factor = radiosity::FOracle{}(question); }
    for (const auto& [a, b] : {std::pair{question.node_p().parent, question.q}, std::pair{question.p, question.node_q().parent}}) {
      const auto found = by_ends_.find(key(a, b));
      if (a != radiosity::no_node && b != radiosity::no_node && found != by_ends_.end()) { pair.parent = found->second; }
    }
    if (pair.parent) { pair.generation = recording_.pairs[*pair.parent].generation + 1; }
    if (question.hierarchy.size() > recording_.born.size()) { recording_.born.resize(question.hierarchy.size(), pair.generation); }
    by_ends_.emplace(key(pair.p, pair.q), static_cast<std::uint32_t>(recording_.pairs.size()));
    recording_.pairs.push_back(std::move(pair));
    if (recording_.pairs.size() > most_pairs || question.hierarchy.size() > most_nodes) { too_many_ = true; }
  }

 private:
  [[nodiscard]] static std::uint64_t key(std::uint32_t p, std::uint32_t q) {
    return (std::uint64_t{std::min(p, q)} << 32) | std::max(p, q);
  }
  Recording& recording_;
  std::atomic<bool>& too_many_;
  std::map<std::uint64_t, std::uint32_t> by_ends_;
};

// Records the nodes with their names and contours, and the emission and reflectance of every surface in the channel with the
// largest emission.
void record_nodes(const Run& run, Recording& recording) {
  recording.nodes = in_scene(run.scene.hierarchy, run.scene.frame);
  recording.born.resize(recording.nodes.size(), recording.born.empty() ? 0 : recording.pairs.back().generation + 1);
  recording.names = names_of(recording.nodes, run.scene.inputs);
  recording.contours = contours_of(run);
  recording.levels.assign(recording.nodes.size(), 0);
  glm::dvec3 emitted{0.0};
  for (const radiosity::Color& e : run.scene.emission) { emitted += e; }
  recording.channel = emitted.y >= emitted.x && emitted.y >= emitted.z ? 1 : emitted.x >= emitted.z ? 0 : 2;
  const auto of = [&](const std::vector<radiosity::Color>& surfaces) {
    std::vector<double> values;
    for (const radiosity::Node& node : recording.nodes) { values.push_back(surfaces[node.surface][recording.channel]); }
    return values;
  };
  recording.emission = of(run.scene.emission);
  recording.reflectance = of(run.scene.reflectance);
}

void record_links(Run& run, Recording& recording) {
  const radiosity::Frame& frame = run.scene.frame;
  for (const radiosity::Link& link : run.solution.links) {
    LinkRecord record{link.p, link.q, frame.to_scene_area(static_cast<double>(link.exchange)), 0.0, 1.0, false, {}, {}};
    record.unoccluded = frame.to_scene_area(radiosity::exchange(run.scene.patches[link.p], run.scene.patches[link.q]));
    const raycast::OccluderList list = run.refined.occluders.of(link.p, link.q, radiosity::OccluderLists::none, run.scene.view());
    std::vector<radiosity::CastSegment> seen;
    record.visibility = run.scene.evaluator.segments(link, &seen).fraction;
    record.proven = list.clear();
    for (const auto& [segment, arrives] : seen) {
      record.rays.push_back({frame.to_scene(segment.origin), frame.to_scene(segment.origin + segment.direction), arrives});
    }
    record.sentence = sentence_of(recording, record);
    recording.links.push_back(std::move(record));
  }
}

// Performs gather, push and pull as Transport::apply does, and records the result of each.
void record_iterations(Run& run, Recording& recording) {
  using Moments = radiosity::Transport::Moments;
  radiosity::Transport& transport = *run.transport;
  const radiosity::Hierarchy& nodes = run.scene.hierarchy;
  const std::vector<double>& area = run.scene.exposure.area;
  std::vector<double> b = recording.emission;
  double start = 0.0;
  for (int n = 0; n < 12; ++n) {
    Iteration step;
    std::vector<double> power(nodes.size(), 0.0);
    step.gathered.resize(nodes.size(), 0.0);
    step.arrived.resize(nodes.size(), 0.0);
    for (std::size_t part = 0; part < transport.parts(); ++part) {
      std::vector<Moments> sent(nodes.size()), arrived(nodes.size());
      for (std::size_t i = nodes.size(); i-- > 0;) { transport.pull(part, i, b, sent); }
      for (const radiosity::Link& link : transport.links(part)) {
        radiosity::Transport::carry(link, sent[link.p], arrived[link.q], link.shape_p.gradient(), link.shape_q.gradient());
        radiosity::Transport::carry(link, sent[link.q], arrived[link.p], link.shape_q.gradient(), link.shape_p.gradient());
      }
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (part == 0) { step.sent.push_back(sent[i].value); }
        step.gathered[i] += area[i] > 0.0 ? arrived[i].value / area[i] : 0.0;
      }
      for (std::size_t i = 0; i < nodes.size(); ++i) { transport.push(part, i, arrived, power); }
      for (std::size_t i = 0; i < nodes.size(); ++i) { step.arrived[i] += arrived[i].value; }
    }
    double change = 0.0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!nodes[i].leaf() || !(area[i] > 0.0)) { continue; }
      const double next = recording.emission[i] + recording.reflectance[i] * power[i] / area[i];
      change += area[i] * (next - b[i]) * (next - b[i]);
      start += n == 0 ? area[i] * b[i] * b[i] : 0.0;
      b[i] = next;
    }
    for (std::size_t i = nodes.size(); i-- > 0;) {
      step.mean.insert(step.mean.begin(), area[i] > 0.0 ? power[i] / area[i] : 0.0);
      if (nodes[i].parent != radiosity::no_node) { power[nodes[i].parent] += power[i]; }
    }
    step.residual = start > 0.0 ? std::sqrt(change / start) : 0.0;
    recording.iterations.push_back(std::move(step));
    if (recording.iterations.back().residual < 1e-4) { break; }
  }
}

void record_solvers(Run& run, Recording& recording) {
  System system{*run.transport, run.scene.exposure.area, {}, {}};
  for (const radiosity::Color& rho : run.scene.reflectance) { system.reflectance.push_back(rho[recording.channel]); }
  for (const radiosity::Color& e : run.scene.emission) { system.emission.push_back(e[recording.channel]); }
  recording.as_is = compare_solvers(system, false);
  for (double& rho : system.reflectance) { rho = rho > 0.0 ? 0.99 : 0.0; }
  recording.at_99 = compare_solvers(system, true);
}

void record_leaves(const Run& run, Recording& recording) {
  for (const radiosity::Surface& surface : run.scene.surfaces) {
    for (const brep::FaceId f : brep::faces(surface.brep)) {
      const std::uint32_t node = surface.brep.data(f).node;
      if (node == radiosity::no_node) { continue; }
      recording.levels[node] = surface.brep.data(f).level;
      LeafLoop loop{node, {}, {}, {}};
      for (const brep::HalfedgeId h : brep::halfedges_of(surface.brep, f)) {
        loop.corners.push_back(run.scene.frame.to_scene(surface.brep.data(surface.brep.vertex(h)).position));
        loop.levels.push_back(surface.brep.data(surface.brep.vertex(h)).level);
        loop.t_vertex.push_back(brep::is_t_vertex(surface.brep, h));
      }
      recording.leaves.push_back(std::move(loop));
    }
  }
}

void record_mesh(Run& run, Recording& recording) {
  (void)radiosity::eliminate_t_vertices(run.scene.surfaces);
  const radiosity::Mesh weighted = run.picture(run.solution.radiosity, radiosity::Reconstruction::weighted);
  const radiosity::Mesh simple = run.picture(run.solution.radiosity, radiosity::Reconstruction::simple);
  for (std::size_t i = 0; i < weighted.faces.size(); ++i) {
    const radiosity::MeshFace& face = weighted.faces[i];
    Triangulated part{face.node, {}, {}, {}};
    for (std::uint32_t k = face.first_corner; k < face.first_corner + face.corner_count; ++k) {
      part.corners.push_back(run.scene.frame.to_scene(weighted.positions[weighted.corners[k].vertex]));
      part.weighted.push_back(weighted.corners[k].radiosity[recording.channel]);
      part.simple.push_back(simple.corners[k].radiosity[recording.channel]);
    }
    recording.mesh.push_back(std::move(part));
  }
}

// Keeps, of each generation, the choices with the largest errors, and the sentences that explain them.
void keep_worst(Recording& recording) {
  for (BfGeneration& generation : recording.bf) {
    std::stable_sort(generation.choices.begin(), generation.choices.end(),
                     [](const BfChoice& a, const BfChoice& b) { return a.error_p + a.error_q > b.error_p + b.error_q; });
    if (generation.choices.size() > 60) { generation.choices.resize(60); }
    for (BfChoice& choice : generation.choices) { choice.sentence = sentence_of(recording, choice); }
  }
}

// Runs BF-refinement once to the end, recording what its oracle is asked, and then once up to each generation; a generation does not
// depend on those after it.
void record_bf(const radiosity::Scene& scene, Recording& recording) {
  radiosity::Options options = options_of(recording.wanted);
  options.refinement = radiosity::Refinement::a_posteriori;
  options.target = recording.wanted.target;
  options.reconstruction = radiosity::Reconstruction::constant;
  std::atomic<bool> too_many = false;
  std::vector<std::vector<BfChoice>> choices(1);
  options.oracle = [&](const radiosity::Question& question) {
    const Decision decision = radiosity::BfOracle{}(question);
    choices.back().push_back({question.p, question.q, question.error->p, question.error->q, decision, {}});
    if (question.hierarchy.size() > most_nodes / 2) { too_many = true; }
    return decision;
  };
  radiosity::Control control;
  control.cancel = &too_many;
  control.after_generation = [&](const std::vector<radiosity::Surface>&) {
    if (!choices.back().empty()) { choices.emplace_back(); }
  };
  const auto run_to = [&](std::uint32_t generation, const auto& read) {
    radiosity::MemoryBudget budget;
    budget.last_generation = generation;
    Run run{scene, options, control, budget};
    for (const auto next :
         {radiosity::stage::build, radiosity::stage::refine, radiosity::stage::expose, radiosity::stage::link, radiosity::stage::solve}) {
      if (next(run)) { return; }
    }
    read(run);
  };
  std::uint32_t last = 0;
  run_to(16, [&](Run& run) {
    last = run.solution.audit.generations;
    recording.bf_nodes = in_scene(run.scene.hierarchy, run.scene.frame);
    recording.bf_names = names_of(recording.bf_nodes, run.scene.inputs);
    recording.bf_contours = contours_of(run);
  });
  options.oracle = nullptr;
  control = {};
  for (std::uint32_t generation = 0; generation <= last; ++generation) {
    run_to(generation, [&](Run& run) {
      BfGeneration of;
      of.nodes = run.scene.hierarchy.size();
      of.leaves = static_cast<std::size_t>(
          std::count_if(run.scene.hierarchy.begin(), run.scene.hierarchy.end(), [](const radiosity::Node& node) { return node.leaf(); }));
      of.links = run.solution.links.size();
      of.estimate = run.solution.audit.estimated_error.value_or(0.0);
      for (const radiosity::Color& b : run.solution.radiosity) { of.radiosity.push_back(b[recording.channel]); }
      if (generation < choices.size()) { of.choices = std::move(choices[generation]); }
      recording.bf.push_back(std::move(of));
    });
  }
  keep_worst(recording);
}

RecordResult refused(std::string sentence) { return {std::nullopt, false, {std::move(sentence)}}; }

}  // namespace

RecordResult record(const radiosity::Scene& scene, const std::string& name, const Wanted& wanted) {
  Recording recording;
  recording.scene = name;
  recording.wanted = wanted;
  std::atomic<bool> too_many = false;
  Watch watch{recording, too_many};
  radiosity::Control control;
  control.cancel = &too_many;
  control.decided = [&](const radiosity::Question& question, Decision decision) { watch.take(question, decision); };
  Run run{scene, options_of(wanted), control, {}};
  if (const auto failure = radiosity::stage::build(run)) { return {std::nullopt, true, failure->sentences}; }
  if (const std::size_t faces = run.scene.hierarchy.size(); faces > most_faces) {
    return refused("the scene has " + std::to_string(faces) + " input faces; at most " + std::to_string(most_faces) +
                   " can be looked at one by one, so choose a smaller scene");
  }
  if (!run.needs_links()) { return refused("there is nothing to explain: no surface shines, or none reflects, so no light is exchanged"); }
  for (const auto next : {radiosity::stage::refine, radiosity::stage::expose, radiosity::stage::link, radiosity::stage::solve}) {
    const auto failure = next(run);
    if (too_many) {
      return refused("at epsilon " + number(wanted.epsilon) + " the oracle is asked about more than " + std::to_string(most_pairs) +
                     " pairs or there are more than " + std::to_string(most_nodes) +
                     " patches, more than one can look at; a larger --epsilon or --min-area asks about fewer");
    }
    if (failure) { return {std::nullopt, true, failure->sentences}; }
  }
  record_nodes(run, recording);
  for (const radiosity::Color& b : run.solution.radiosity) { recording.radiosity.push_back(b[recording.channel]); }
  for (Pair& pair : recording.pairs) { pair.sentence = sentence_of(recording, pair); }
  record_links(run, recording);
  recording.too_faint = run.evaluated.blocked;
  record_iterations(run, recording);
  record_leaves(run, recording);
  recording.closure = run.solution.audit.closure;
  record_solvers(run, recording);
  record_mesh(run, recording);
  record_bf(scene, recording);
  return {std::move(recording), false, {}};
}

}  // namespace apps::explain
