// SPDX-License-Identifier: MIT

#include <array>

#include <brep/euler_script_run.hpp>
#include <brep/handles.hpp>
#include <brep/validate_explain.hpp>

#include "apps/euler/outputs.hpp"
#include "apps/html_document.hpp"
#include "apps/json.hpp"
#include "embedded/euler.hpp"

namespace apps::euler {
namespace {

// "0 2 1 0 0;1 ...": a row for each living half-edge: its index, next, prev, vertex and face.
std::string halfedge_rows(const Records& records) {
  std::string rows;
  for (std::size_t i = 0; i < records.halfedges.size(); ++i) {
    const Records::Halfedge& h = records.halfedges[i];
    if (!h.alive) { continue; }
    rows += std::to_string(i);
    for (const std::uint32_t field : {h.next, h.prev, h.vertex, h.face}) { rows += " " + std::to_string(field); }
    rows += ';';
  }
  return rows;
}
std::string anchor_rows(const std::vector<std::uint32_t>& anchors) {
  std::string rows;
  for (std::size_t i = 0; i < anchors.size(); ++i) {
    if (anchors[i] != brep::invalid_index) { rows += std::to_string(i) + " " + std::to_string(anchors[i]) + ";"; }
  }
  return rows;
}

void write(JsonWriter& json, const Story& story, std::size_t i, const Layout& layout) {
  const Frame& frame = story.frames[i];
  const bool refused = frame.outcome.kind == brep::Outcome::Kind::refused;
  std::vector<std::string> faults;
  for (const brep::Fault& fault : frame.outcome.faults) { faults.push_back(fault.sentence); }
  std::vector<std::string> lit;
  for (const brep::Element e : frame.arguments) {
    if (e.letter != 0) { lit.push_back(to_string(e)); }
  }
  const std::array<long, 5> numbers{frame.drawn.v, frame.drawn.e, frame.drawn.f, frame.shells, frame.handles};
  json.open_object().fields("statement", frame.statement, "headline", headline(frame), "caption", frame.caption, "told", frame.told,
                            "refused", refused, "expected", frame.outcome.as_written, "sentence", frame.outcome.sentence, "faults", faults);
  json.key("checks").list(frame.checks,
                          [&](const Check& check) { json.object("text", check.text, "met", check.met, "sentence", check.sentence); });
  json.fields("damaged", frame.damaged, "counts", numbers, "equation", equation(frame), "lit", lit, "halfedges",
              halfedge_rows(frame.records), "vertices", anchor_rows(frame.records.vertices), "faces", anchor_rows(frame.records.faces),
              "panels", layout.panels.size(), "picture", drawing(story, i, layout, 790.0), "solid",
              solid_view(frame, story.coordinates, 240.0));
  json.close();
}

}  // namespace

std::string page(const Story& story) {
  const std::vector<Layout> layouts = lay_out(story, 0.026);
  JsonWriter json;
  json.open_object().fields("title", story.title, "introduction", story.introduction).key("frames").open_array();
  for (std::size_t i = 0; i < story.frames.size(); ++i) { write(json, story, i, layouts[i]); }
  json.close().close();
  return stepped_document(story.title, embedded::euler_page_css + drawing_style(), embedded::euler_page_html, json.text(),
                          embedded::euler_page_js);
}

}  // namespace apps::euler
