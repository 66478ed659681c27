// SPDX-License-Identifier: MIT
#include "apps/explain/recording.hpp"

#include <vector>

#include "apps/html_document.hpp"
#include "apps/json.hpp"
#include "apps/text.hpp"
#include "embedded/explain.hpp"

namespace apps::explain {
namespace {

// The numbers of a list in one string, with four digits each, to save space because the page contains many.
template <class List>
std::string packed(const List& values) {
  std::string out;
  for (const auto value : values) { out += (out.empty() ? "" : " ") + formatted("%.4g", static_cast<double>(value)); }
  return out;
}
std::string packed(const radiosity::Polygon& polygon) {
  std::string out;
  for (const glm::dvec3& p : polygon) {
    for (int c = 0; c < 3; ++c) { out += (out.empty() ? "" : " ") + formatted("%.5g", p[c]); }
  }
  return out;
}

const char* word(radiosity::Decision decision) {
  constexpr const char* words[] = {"drop", "convex", "hide", "link", "split_p", "split_q"};
  return words[static_cast<int>(decision)];
}

void write_nodes(JsonWriter& json, const radiosity::Hierarchy& nodes, const std::vector<std::string>& names,
                 const std::vector<radiosity::Polygon>& contours) {
  json.open_array();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const long parent = nodes[i].parent == radiosity::no_node ? -1 : static_cast<long>(nodes[i].parent);
    json.object("name", names[i], "parent", parent, "area", nodes[i].area, "contour", packed(contours[i]));
  }
  json.close();
}

void write_comparison(JsonWriter& json, const Comparison& comparison) {
  json.open_object().fields("reflectance", comparison.reflectance, "solution", packed(comparison.solution)).key("methods");
  json.list(comparison.methods, [&](const Method& method) {
    std::vector<std::string> radiosity;
    for (const auto& values : method.radiosity) { radiosity.push_back(packed(values)); }
    json.object("name", method.name, "residual", packed(method.residual), "radiosity", radiosity);
  });
  json.close();
}

}  // namespace

std::string page(const Recording& r) {
  JsonWriter json;
  json.open_object().fields("scene", r.scene, "epsilon", r.wanted.epsilon, "target", r.wanted.target, "closure", r.closure, "faint",
                            r.too_faint, "born", packed(r.born), "levels", packed(r.levels), "emission", packed(r.emission), "reflectance",
                            packed(r.reflectance), "radiosity", packed(r.radiosity));
  json.key("nodes");
  write_nodes(json, r.nodes, r.names, r.contours);
  json.key("pairs").list(r.pairs, [&](const Pair& pair) {
    const long parent = pair.parent ? static_cast<long>(*pair.parent) : -1;
    json.object("p", pair.p, "q", pair.q, "parent", parent, "generation", pair.generation, "estimate", pair.estimate, "f",
                word(pair.by_form_factor), "is", word(pair.decision), "why", pair.sentence);
  });
  json.key("links").list(r.links, [&](const LinkRecord& link) {
    radiosity::Polygon ends;
    std::vector<bool> arrives;
    for (const Ray& ray : link.rays) {
      ends.push_back(ray.from);
      ends.push_back(ray.to);
      arrives.push_back(ray.arrives);
    }
    json.object("p", link.p, "q", link.q, "exchange", link.exchange, "unoccluded", link.unoccluded, "rays", packed(ends), "arrives",
                packed(arrives), "why", link.sentence);
  });
  json.key("iterations").list(r.iterations, [&](const Iteration& step) {
    json.object("sent", packed(step.sent), "gathered", packed(step.gathered), "arrived", packed(step.arrived), "mean", packed(step.mean),
                "residual", step.residual);
  });
  json.key("leaves").list(r.leaves, [&](const LeafLoop& leaf) {
    json.object("node", leaf.node, "corners", packed(leaf.corners), "levels", packed(leaf.levels), "t", packed(leaf.t_vertex));
  });
  json.key("mesh").list(r.mesh, [&](const Triangulated& part) {
    json.object("node", part.node, "corners", packed(part.corners), "simple", packed(part.simple), "weighted", packed(part.weighted));
  });
  json.key("bfNodes");
  write_nodes(json, r.bf_nodes, r.bf_names, r.bf_contours);
  json.key("bf").list(r.bf, [&](const BfGeneration& of) {
    json.open_object().fields("nodes", of.nodes, "leaves", of.leaves, "links", of.links, "estimate", of.estimate, "radiosity",
                              packed(of.radiosity));
    json.key("choices").list(of.choices, [&](const BfChoice& choice) {
      json.object("p", choice.p, "q", choice.q, "is", word(choice.decision), "why", choice.sentence);
    });
    json.close();
  });
  json.key("solvers").open_array();
  write_comparison(json, r.as_is);
  write_comparison(json, r.at_99);
  json.close().close();
  return stepped_document("explain " + r.scene, embedded::explain_page_css, embedded::explain_page_html, json.text(),
                          std::string(embedded::explain_scene_js) + embedded::explain_page_js);
}

}  // namespace apps::explain
