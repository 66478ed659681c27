// SPDX-License-Identifier: MIT
#include "apps/euler/html.hpp"

#include <brep/euler_script_run.hpp>
#include <brep/handles.hpp>
#include <brep/validate_explain.hpp>

#include "apps/euler/html_page.hpp"
#include "apps/euler/svg.hpp"
#include "apps/json.hpp"
#include "apps/markup.hpp"

namespace apps::euler {
namespace {

// "0 2 1 0 0;1 ...": a row for each living element.
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
  json.open_object();
  json.key("statement").string(frame.statement);
  json.key("headline").string(headline(frame));
  json.key("caption").string(frame.caption);
  json.key("refused").boolean(refused);
  json.key("expected").boolean(frame.outcome.as_written);
  json.key("sentence").string(frame.outcome.sentence);
  json.key("faults").open_array();
  for (const brep::Fault& fault : frame.outcome.faults) { json.string(fault.sentence); }
  json.close();
  json.key("checks").open_array();
  for (const Check& check : frame.checks) {
    json.open_object();
    json.key("text").string(check.text).key("met").boolean(check.met).key("sentence").string(check.sentence);
    json.close();
  }
  json.close();
  json.key("damaged").boolean(frame.damaged);
  json.key("counts").open_array();
  for (const long n : {frame.drawn.v, frame.drawn.e, frame.drawn.f, frame.shells, frame.handles}) { json.number(static_cast<double>(n)); }
  json.close();
  json.key("equation").string(equation(frame));
  json.key("lit").open_array();
  for (const brep::Element e : frame.arguments) {
    if (e.letter != 0) { json.string(to_string(e)); }
  }
  json.close();
  json.key("halfedges").string(halfedge_rows(frame.records));
  json.key("vertices").string(anchor_rows(frame.records.vertices));
  json.key("faces").string(anchor_rows(frame.records.faces));
  json.key("panels").count(layout.panels.size());
  json.key("picture").string(drawing(story, i, layout, 790.0));
  json.close();
}

}  // namespace

std::string page(const Story& story) {
  const std::vector<Layout> layouts = lay_out(story, 0.026);
  JsonWriter json;
  json.open_object();
  json.key("title").string(story.title);
  json.key("introduction").string(story.introduction);
  json.key("frames").open_array();
  for (std::size_t i = 0; i < story.frames.size(); ++i) { write(json, story, i, layouts[i]); }
  json.close().close();
  std::string data;  // no '<' in the data can end the script element
  for (const char c : json.text()) {
    if (c == '<') {
      data += "\\u003c";
    } else {
      data += c;
    }
  }
  return "<!DOCTYPE html>\n<html lang='en'>\n<head>\n<meta charset='utf-8'>\n<meta name='viewport' content='width=device-width'>\n<title>" +
         escaped(story.title) + "</title>\n<style>" + page_style + drawing_style() + "\n</style>\n</head>\n<body>" + page_body +
         "<script>\n'use strict';\nconst story = " + data + ";" + page_script + "</script>\n</body>\n</html>\n";
}

}  // namespace apps::euler
