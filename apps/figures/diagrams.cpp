// SPDX-License-Identifier: MIT
// Figures 3 to 5: diagrams of what the solver has made of a scene.
#include <algorithm>
#include <numeric>

#include <glm/geometric.hpp>

#include <brep/circulators.hpp>

#include <radiosity/picture/reconstruct.hpp>

#include "apps/explain/recording.hpp"
#include "apps/figures/figures.hpp"
#include "apps/scene_file.hpp"
#include "apps/text.hpp"

namespace apps::figures {
namespace {

using study::Drawing;

constexpr study::Srgb blue = 0x0b5bd3, red = 0xc8310f, pale = 0xeef3fb, lit = 0xfff3d6;

study::Shape polygon(std::vector<glm::dvec2> points, study::Srgb fill) {
  study::Shape shape;
  shape.points = std::move(points);
  shape.closed = shape.filled = true;
  shape.fill = fill;
  shape.stroke_width = 1.0;
  return shape;
}

void label(Drawing& drawing, const glm::dvec2& at, std::string text, double size = 13.0, study::Srgb color = study::ink,
           study::Anchor anchor = study::Anchor::middle) {
  drawing.add(study::Label{at, std::move(text), size, anchor, color, false, true});
}

void arrow(Drawing& drawing, const glm::dvec2& from, const glm::dvec2& to, study::Srgb color, bool dashed) {
  study::Shape line = study::line(from, to, 1.2, color);
  if (dashed) { line.dashes = {4.0, 3.0}; }
  drawing.add(line);
  const glm::dvec2 d = glm::normalize(to - from), n{-d.y, d.x};
  study::Shape tip = polygon({to, to - 8.0 * d + 3.0 * n, to - 8.0 * d - 3.0 * n}, color);
  tip.stroke_width = 0.0;
  drawing.add(tip);
}

explain::Recording recorded(const std::string& scene, double epsilon) {
  explain::Wanted wanted;
  wanted.epsilon = epsilon;
  wanted.min_area = 0.008;
  wanted.light_epsilon = 1e9;  // the form factor alone
  return std::move(explain::record(parse_scene(scene).file->scene, "figure", wanted).recording.value());
}

}  // namespace

Drawing hierarchy_over_faces(const std::string& scene) {
  const explain::Recording r = recorded(scene, 0.12);
  Drawing drawing{640.0, 460.0, {}};
  const auto mesh_point = [](const glm::dvec3& p) { return glm::dvec2{60.0 + 200.0 * p.x + 60.0 * p.y, 420.0 - 75.0 * p.y}; };
  const auto in_plate = [&](std::uint32_t i) { return r.nodes[i].surface == r.nodes[0].surface; };
  // Leaves side by side, parents above the middle of their children; these stand from left to right as their faces do, so that few arrows
  // cross.
  std::vector<glm::dvec2> at(r.nodes.size(), glm::dvec2{0.0});
  std::size_t leaves = 0;
  for (std::uint32_t i = 0; i < r.nodes.size(); ++i) { leaves += in_plate(i) && r.nodes[i].leaf() ? 1 : 0; }
  double x = 30.0;
  const double step = 580.0 / std::max<double>(1.0, static_cast<double>(leaves - 1));
  const auto place = [&](const auto& self, std::uint32_t i, int depth) -> void {
    at[i].y = 40.0 + 62.0 * depth;
    if (r.nodes[i].leaf()) {
      at[i].x = x;
      x += step;
      return;
    }
    const std::uint32_t first = r.nodes[i].first_child, last = first + r.nodes[i].child_count;
    std::vector<std::uint32_t> children(last - first);
    std::iota(children.begin(), children.end(), first);
    std::stable_sort(children.begin(), children.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return mesh_point(r.nodes[a].centre).x < mesh_point(r.nodes[b].centre).x; });
    for (const std::uint32_t c : children) { self(self, c, depth + 1); }
    at[i].x = 0.5 * (at[children.front()].x + at[children.back()].x);
  };
  place(place, 0, 0);
  for (const explain::LeafLoop& leaf : r.leaves) {
    if (!in_plate(leaf.node)) { continue; }
    std::vector<glm::dvec2> corners;
    for (const glm::dvec3& p : leaf.corners) { corners.push_back(mesh_point(p)); }
    drawing.add(polygon(corners, pale));
  }
  for (std::uint32_t i = 0; i < r.nodes.size(); ++i) {
    if (!in_plate(i)) { continue; }
    if (i > 0) { drawing.add(study::line(at[r.nodes[i].parent], at[i], 1.4)); }
    if (r.nodes[i].leaf()) { arrow(drawing, at[i], mesh_point(r.nodes[i].centre), blue, true); }
  }
  for (std::uint32_t i = 0; i < r.nodes.size(); ++i) {
    if (!in_plate(i)) { continue; }
    const glm::dvec2 half{7.0, 7.0};
    study::Shape box = study::rectangle(at[i] - half, at[i] + half, r.nodes[i].leaf() ? lit : study::paper);
    box.stroke_width = 1.4;
    drawing.add(box);
  }
  label(drawing, {20.0, 22.0}, "nodes: centre, normal, area, children", 13.0, study::ink, study::Anchor::start);
  label(drawing, {620.0, 448.0}, "faces of the BRep: corners, neighbours, tags", 13.0, study::ink, study::Anchor::end);
  return drawing;
}

Drawing level_tags(const std::string& scene) {
  const explain::Recording r = recorded(scene, 0.12);
  Drawing drawing{480.0, 480.0, {}};
  const auto place = [](const glm::dvec3& p) { return glm::dvec2{40.0 + 200.0 * p.x, 440.0 - 200.0 * p.y}; };
  for (const explain::LeafLoop& leaf : r.leaves) {
    if (r.nodes[leaf.node].surface != r.nodes[0].surface) { continue; }
    std::vector<glm::dvec2> corners;
    for (const glm::dvec3& p : leaf.corners) { corners.push_back(place(p)); }
    drawing.add(polygon(corners, pale));
    label(drawing, place(r.nodes[leaf.node].centre) + glm::dvec2{0.0, 5.0}, std::to_string(r.levels[leaf.node]), 14.0, blue);
  }
  for (const explain::LeafLoop& leaf : r.leaves) {
    if (r.nodes[leaf.node].surface != r.nodes[0].surface) { continue; }
    for (std::size_t k = 0; k < leaf.corners.size(); ++k) {
      const glm::dvec2 p = place(leaf.corners[k]);
      drawing.add(study::rectangle(p - glm::dvec2{7.0, 8.0}, p + glm::dvec2{7.0, 8.0}, study::paper));
    }
  }
  for (const explain::LeafLoop& leaf : r.leaves) {
    if (r.nodes[leaf.node].surface != r.nodes[0].surface) { continue; }
    for (std::size_t k = 0; k < leaf.corners.size(); ++k) {
      const bool t = leaf.t_vertex[k];
      const glm::dvec2 p = place(leaf.corners[k]);
      if (t) {  // beside the T-vertex, within the leaf that sees it as one
        const glm::dvec2 in = glm::normalize(place(r.nodes[leaf.node].centre) - p);
        label(drawing, p + 16.0 * in + glm::dvec2{0.0, 4.0}, "T", 12.0, red);
      }
      label(drawing, p + glm::dvec2{0.0, 5.0}, std::to_string(leaf.levels[k]), 13.0);
    }
  }
  label(drawing, {240.0, 470.0}, "black: levels of vertices; blue: of faces; red: T-vertices of the face beside", 12.0);
  return drawing;
}

Drawing weights_at_a_rim(const std::string& scene) {
  const SceneFile file = std::move(*parse_scene(scene).file);
  radiosity::Options options;
  options.epsilon = 1.0;
  options.light_epsilon = 1e9;
  options.audit_points = 0;
  options.threads = 1;
  radiosity::detail::Run run{file.scene, options, {}, {}};
  if (!solve(run)) { return {}; }
  // The rim's vertex nearest to the eye; the half-edges that leave it, one a face.
  const radiosity::SurfaceBRep& brep = run.scene.surfaces[0].brep;
  const auto nearness = [&](brep::VertexId v) {
    const glm::dvec3 p = run.scene.frame.to_scene(brep.data(v).position);
    return p.z - 0.4 * p.y - 0.1 * p.x;
  };
  brep::VertexId best{0};
  for (const brep::VertexId v : brep::vertices(brep)) {
    if (nearness(v) > nearness(best)) { best = v; }
  }
  Drawing drawing{640.0, 420.0, {}};
  const glm::dvec2 v_at{250.0, 200.0};
  const glm::dvec3 middle = run.scene.frame.to_scene(brep.data(best).position);
  const auto place = [&](const glm::dvec3& q) {
    const glm::dvec3 d = run.scene.frame.to_scene(q) - middle;
    return v_at + glm::dvec2{620.0 * (d.x + 0.25 * d.y), -620.0 * (0.55 * d.y + 0.6 * d.z)};
  };
  brep::HalfedgeId of = brep.halfedge(best);  // one on the top
  for (const brep::HalfedgeId h : brep::halfedges_from(brep, best)) {
    if (brep.data(h).normal.z > brep.data(of).normal.z) { of = h; }
  }
  for (const brep::HalfedgeId h : brep::halfedges_from(brep, best)) {
    std::vector<glm::dvec2> corners;
    glm::dvec2 towards{0.0};
    for (const brep::HalfedgeId k : brep::halfedges_of(brep, brep.face(h))) {
      corners.push_back(place(brep.data(brep.vertex(k)).position));
    }
    const double weight = std::max(0.0, glm::dot(brep.data(of).normal, brep.data(h).normal));
    for (const glm::dvec2& p : corners) { towards += p / static_cast<double>(corners.size()); }
    drawing.add(polygon(corners, weight > 0.5 ? lit : pale));
    const glm::dvec2 text = glm::mix(v_at, towards, std::min(1.0, 110.0 / glm::length(towards - v_at)));
    label(drawing, text, "weight " + formatted("%.2f", weight), 14.0, weight > 0.5 ? study::ink : blue);
  }
  for (const brep::HalfedgeId h : brep::halfedges_from(brep, best)) {
    arrow(drawing, v_at, place(brep.data(best).position + 0.16 * brep.data(h).normal), red, false);
  }
  label(drawing, v_at + glm::dvec2{8.0, 14.0}, "v", 15.0, study::ink, study::Anchor::start);
  label(drawing, {320.0, 408.0}, "red: the normals that the half-edges leaving v carry; weights are those of a half-edge on the top", 13.0);
  return drawing;
}

}  // namespace apps::figures
