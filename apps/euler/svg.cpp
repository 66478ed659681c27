// SPDX-License-Identifier: MIT
#include "apps/euler/outputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include <brep/euler_script_run.hpp>
#include <brep/handles.hpp>
#include <brep/validate_explain.hpp>

#include "apps/euler/layout.hpp"
#include "apps/html_document.hpp"
#include "apps/text.hpp"

namespace apps::euler {

std::string tint(std::uint32_t face) {
  const double hue = std::fmod(0.13 + 0.381966 * face, 1.0);
  const auto channel = [&](double shift) {
    const double k = std::fmod(hue + shift, 1.0) * 6.0;
    const double ramp = std::clamp(std::abs(k - 3.0) - 1.0, 0.0, 1.0);
    return static_cast<unsigned>(std::lround(255.0 * (0.83 + 0.15 * ramp)));
  };
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", channel(0.0), channel(2.0 / 3.0), channel(1.0 / 3.0));
  return text.data();
}

namespace {

using Point = glm::dvec2;

std::string number(double x) { return trimmed(x, 1); }

std::string name(char letter, std::uint32_t index) { return letter + std::to_string(index); }

// Draws one panel; all lengths in px, y down.
class Pen {
 public:
  Pen(const Story& story, std::size_t frame, const Panel& panel, double half)
      : frame_(story.frames[frame]),
        before_(frame == 0 ? nullptr : &story.frames[frame - 1].drawn),
        panel_(panel),
        half_(half),
        text_(panel.text * half) {}

  std::string draw() {
    const double box = 1.26 * half_;
    out_ += "<rect x='" + number(-box) + "' y='" + number(-box) + "' width='" + number(2 * box) + "' height='" + number(2 * box) +
            "' rx='" + number(0.12 * half_) + "' class='outside' fill='" +
            (panel_.outer_whole ? tint(panel_.outer_face) : std::string("#f4f4f2")) + "'/>\n";
    if (panel_.strands.empty()) { out_ += "<text font-size='" + number(0.08 * half_) + "'>nested too deeply to be drawn</text>\n"; }
    for (const FaceArea& area : panel_.areas) { draw_area(area); }
    for (const Strand& s : panel_.strands) { draw_edge(s); }
    for (const Strand& s : panel_.strands) { draw_halves(s); }
    for (const VertexMark& v : panel_.vertices) { draw_vertex(v); }
    std::map<std::uint32_t, int> copies;
    for (const FaceLabel& l : panel_.labels) { draw_label(l, copies[l.face]++); }
    return std::move(out_);
  }

 private:
  [[nodiscard]] std::string at(const Point& p) const { return number(half_ * p.x) + " " + number(-half_ * p.y); }
  [[nodiscard]] bool is_argument(char letter, std::uint32_t index) const {
    return std::any_of(frame_.arguments.begin(), frame_.arguments.end(),
                       [&](brep::Element e) { return e.letter == letter && e.index == index; });
  }
  [[nodiscard]] std::string mark(char letter, std::uint32_t index) const {
    if (frame_.edited.letter == letter && frame_.edited.index == index) { return " hurt"; }
    if (!before_) { return {}; }
    const auto& anchors = letter == 'v' ? before_->vertices : before_->faces;
    const bool old =
        letter == 'h' ? before_->alive(brep::HalfedgeId{index}) : index < anchors.size() && anchors[index] != brep::invalid_index;
    return !old ? " new" : is_argument(letter, index) ? " argument" : "";
  }

  // A strand as an SVG path, optionally backwards.
  [[nodiscard]] std::string path(const Strand& s, bool backwards, bool move) const {
    Curve curve = s.curve;
    if (backwards) { std::reverse(curve.points.begin(), curve.points.end()); }
    std::string d = move ? "M" + at(curve.points.front()) : "";
    for (std::size_t k = 1; k + 1 < curve.points.size(); ++k) {
      const auto [from, control, to] = curve.arc(k);
      if (curve.rounding < 1.0) { d += "L" + at(from); }
      d += "Q" + at(control) + " " + at(to);
    }
    return d + (curve.rounding < 1.0 ? "L" + at(curve.points.back()) : "");
  }
  void draw_area(const FaceArea& area) {
    std::string d;
    for (std::size_t s : area.strands) {
      const bool backwards = s >= panel_.strands.size();
      d += path(panel_.strands[backwards ? ~s : s], backwards, d.empty());
    }
    out_ += "<path class='area' data-k='f" + std::to_string(area.face) + "' fill='" + tint(area.face) + "' d='" + d + "Z'/>\n";
  }
  void draw_edge(const Strand& s) {
    const std::string key = s.stub ? "s" + std::to_string(s.halfedge) : "e" + std::to_string(s.halfedge / 2);
    out_ += "<path class='edge" + std::string(s.stub ? " stub" : "") + (mark('h', s.halfedge) == " new" ? " new" : "") + "' data-k='" +
            key + "' d='" + path(s, false, true) + "'/>\n";
    if (!s.stub) { return; }
    const std::string tip = name('e', s.halfedge / 2);
    out_ += "<g class='tip' data-k='tip" + std::to_string(s.halfedge) + "' transform='translate(" + at(s.curve.points.back()) +
            ")'><rect x='" + number(-0.9 * text_) + "' y='" + number(-0.65 * text_) + "' width='" + number(1.8 * text_) + "' height='" +
            number(1.3 * text_) + "' rx='" + number(0.3 * text_) + "'/><text font-size='" + number(0.85 * text_) + "' y='.35em'>" + tip +
            "</text></g>\n";
  }

  // Draws a half-edge beside the curve, shortened at both ends, with half an arrow head on its left, and its name.
  void draw_half(const std::vector<Point>& line, const Strand& s, std::uint32_t side) {
    const std::uint32_t h = s.halfedge ^ side;
    const double all = length_of(line), end = std::min(0.32 * all, 1.9 * panel_.text);
    std::string d;
    Spot spot;
    constexpr int steps = 20;
    for (int i = 0; i <= steps; ++i) {
      spot = spot_on(line, end + (all - 2 * end) * i / steps);
      d += (i == 0 ? "M" : "L") + at(spot.at + panel_.gap * spot.left());
    }
    d += "L" + at(spot.at + (panel_.gap + 0.36 * panel_.text) * spot.left() - 0.6 * panel_.text * spot.along);
    const std::string kind = mark('h', h);
    const std::string key = name('h', h) + (s.stub ? "s" + std::to_string(s.halfedge) : "");
    out_ += "<path class='half" + kind + "' data-k='" + key + "' d='" + d + "'/>\n";
    out_ += "<text class='name" + kind + "' data-k='n" + key + "' font-size='" + number(half_ * s.sizes[side]) + "' transform='translate(" +
            at(s.names[side]) + ")' y='.35em'>" + name('h', h) + "</text>\n";
  }
  void draw_halves(const Strand& s) {
    std::vector<Point> line = s.curve.flat(8);
    draw_half(line, s, 0);
    std::reverse(line.begin(), line.end());
    draw_half(line, s, 1);
  }
  void draw_vertex(const VertexMark& v) {
    const std::string label = name('v', v.vertex);
    out_ += "<g class='vertex" + mark('v', v.vertex) + "' data-k='" + label + "' transform='translate(" + at(v.at) + ")'><circle r='" +
            number(vertex_radius * text_) + "'/><text font-size='" + number((label.size() > 2 ? 0.8 : 0.95) * text_) + "' y='.35em'>" +
            label + "</text></g>\n";
  }
  void draw_label(const FaceLabel& l, int copy) {
    out_ += "<text class='face" + mark('f', l.face) + "' data-k='l" + std::to_string(l.face) +
            (copy > 0 ? "c" + std::to_string(copy) : "") + "' font-size='" + number(half_ * l.size) + "' transform='translate(" + at(l.at) +
            ")' y='.35em'>" + name('f', l.face) + "</text>\n";
  }

  const Frame& frame_;
  const Records* before_;
  const Panel& panel_;
  double half_, text_;
  std::string out_;
};

// Breaks text into lines of at most `width` characters; empty lines separate paragraphs and are kept.
std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  std::vector<std::string> lines;
  std::string line;
  const auto length = [](const std::string& s) {
    return static_cast<std::size_t>(
        std::count_if(s.begin(), s.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80; }));
  };
  std::string word;
  const auto end_word = [&] {
    if (word.empty()) { return; }
    if (!line.empty() && length(line) + 1 + length(word) > width) { lines.push_back(std::exchange(line, {})); }
    line += (line.empty() ? "" : " ") + std::exchange(word, {});
  };
  for (std::size_t i = 0; i <= text.size(); ++i) {
    const char c = i < text.size() ? text[i] : ' ';
    if (c != ' ' && c != '\n' && c != '\t') {
      word += c;
      continue;
    }
    end_word();
    if (c == '\n' && i + 1 < text.size() && text[i + 1] == '\n') {
      if (!line.empty()) { lines.push_back(std::exchange(line, {})); }
      lines.emplace_back();
    }
  }
  if (!line.empty()) { lines.push_back(line); }
  return lines;
}

struct TextLine {
  std::string text, kind;
};

// The text around the drawing of a cell: the operator above; notes and captions below the counts.
std::vector<TextLine> notes(const Frame& frame, std::size_t width) {
  std::vector<TextLine> lines;
  const auto add = [&](const std::string& text, const char* kind) {
    for (std::string& line : wrapped(text, width)) { lines.push_back({std::move(line), kind}); }
  };
  if (!frame.outcome.sentence.empty()) {
    const bool refused = frame.outcome.kind == brep::Outcome::Kind::refused;
    add((refused ? "refused: " : "") + frame.outcome.sentence, "bad");
  }
  for (const brep::Fault& fault : frame.outcome.faults) { add(fault.sentence, "bad"); }
  for (const Check& check : frame.checks) {
    add((check.met ? "\xe2\x9c\x93 " : "\xe2\x9c\x97 ") + check.text + (check.met ? "" : ": " + check.sentence),
        check.met ? "good" : "bad");
  }
  add(frame.caption.empty() ? frame.told : frame.caption, "caption");
  return lines;
}

std::string text_element(double x, double y, const std::string& kind, const std::string& text) {
  return "<text class='" + kind + "' x='" + number(x) + "' y='" + number(y) + "'>" + escaped(text) + "</text>\n";
}

constexpr const char* open_svg = "<?xml version='1.0' encoding='UTF-8'?>\n<svg xmlns='http://www.w3.org/2000/svg' ";

std::string sized(double width, double height) {
  return "width='" + number(width) + "' height='" + number(height) + "' viewBox='0 0 " + number(width) + " " + number(height) + "'>\n";
}

}  // namespace

std::vector<Layout> lay_out(const Story& story, double smallest) {
  std::vector<Layout> layouts;
  for (const Frame& frame : story.frames) {
    layouts.push_back(lay_out(frame.drawn, layouts.empty() ? Layout{} : layouts.back(), smallest));
  }
  return layouts;
}

std::string drawing_style() {
  return ".drawing text{font-family:'DejaVu Sans',Verdana,'Segoe UI',sans-serif;text-anchor:middle;fill:#333}"
         ".outside{stroke:#c9c9c4;stroke-width:1}.area{stroke:none}"
         ".edge{fill:none;stroke:#2b2b2b;stroke-width:1.6;stroke-linecap:round}.edge.stub{stroke-dasharray:4 3}"
         ".edge.new{stroke:#d6280f;stroke-width:3}"
         ".half{fill:none;stroke:#6d7682;stroke-width:1;stroke-linejoin:round;stroke-linecap:round}.half.new{stroke:#d6280f}"
         ".half.argument{stroke:#0b5bd3;stroke-width:2}.half.hurt{stroke:#a3008f;stroke-width:2.4}"
         ".drawing .name{fill:#49515c}.drawing .name.new{fill:#b81f08}.drawing .name.argument{fill:#0b5bd3;font-weight:bold}"
         ".drawing .name.hurt{fill:#a3008f;font-weight:bold}"
         ".vertex circle{fill:#fff;stroke:#2b2b2b;stroke-width:1.3}.vertex.new circle{stroke:#d6280f;stroke-width:2.2}"
         ".drawing .vertex.new text{fill:#b81f08}.vertex.hurt circle{stroke:#a3008f;stroke-width:2.6}"
         ".tip rect{fill:#fff;stroke:#2b2b2b;stroke-width:1;stroke-dasharray:3 2}"
         ".drawing .face{fill:#5b4b1f;font-style:italic;font-family:'DejaVu Serif',Georgia,serif}.drawing "
         ".face.new{fill:#b81f08;font-weight:bold}"
         ".drawing .face.argument{fill:#0b5bd3;font-weight:bold}.drawing .face.hurt{fill:#a3008f;font-weight:bold}";
}

std::string drawing(const Story& story, std::size_t i, const Layout& layout, double width) {
  if (layout.panels.empty()) {
    return "<g class='drawing'><text font-size='" + number(0.06 * width) + "' fill='#888'>nothing</text></g>\n";
  }
  const std::size_t columns = columns_of(layout);
  const std::size_t rows = (layout.panels.size() + columns - 1) / columns;
  const double cell = width / static_cast<double>(columns);
  std::string out = "<g class='drawing'>\n";
  for (std::size_t k = 0; k < layout.panels.size(); ++k) {
    const double x = (static_cast<double>(k % columns) + 0.5) * cell - 0.5 * width;
    const double y = (static_cast<double>(k / columns) + 0.5 - 0.5 * static_cast<double>(rows)) * cell;
    out += "<g transform='translate(" + number(x) + " " + number(y) + ")'>\n";
    out += Pen(story, i, layout.panels[k], 0.5 * cell * 0.96 / 1.26).draw() + "</g>\n";
  }
  return out + "</g>\n";
}

std::string strip(const Story& story) {
  constexpr double width = 1290.0, gap = 18.0, line = 13.0, head = 26.0;
  long edges = 0;
  for (const Frame& frame : story.frames) { edges = std::max(edges, frame.drawn.e); }
  const std::size_t columns = edges <= 14 ? 4 : edges <= 40 ? 3 : 2;  // large maps need large cells
  const double cell = (width - gap) / static_cast<double>(columns) - gap;
  const auto letters = static_cast<std::size_t>((cell - 10.0) / 5.7);  // letters per line of a caption
  const std::vector<Layout> layouts = lay_out(story, 7.4 / (0.5 * cell * 0.96 / 1.26));
  std::string body;
  double y = 56.0;
  for (const std::string& text : wrapped(story.introduction, 190)) {
    body += text_element(gap, y, "caption", text);
    y += line + 2;
  }
  y += 10.0;
  for (std::size_t first = 1; first < story.frames.size(); first += columns) {
    const std::size_t last = std::min(first + columns, story.frames.size());
    std::size_t most = 0;
    for (std::size_t i = first; i < last; ++i) {
      const Frame& frame = story.frames[i];
      const double x = gap + static_cast<double>(i - first) * (cell + gap);
      const bool bad = frame.outcome.kind != brep::Outcome::Kind::done;
      body += text_element(x, y + 14, "step", std::to_string(i));
      body += text_element(x + 26, y + 14, bad ? "operator bad" : "operator", headline(frame));
      body += "<g transform='translate(" + number(x + 0.5 * cell) + " " + number(y + head + 0.5 * cell) + ")'>" +
              drawing(story, i, layouts[i], cell) + "</g>\n";
      double below = y + head + cell + 16;
      body += text_element(x, below, "counts", counts(frame) + (frame.damaged ? "  (before)" : ""));
      body += text_element(x, below + 15, "counts", equation(frame));
      below += 32;
      const std::vector<TextLine> lines = notes(frame, letters);
      for (const TextLine& t : lines) {
        body += text_element(x, below, t.kind, t.text);
        below += line;
      }
      most = std::max(most, lines.size());
    }
    y += head + cell + 16 + 32 + line * static_cast<double>(most) + 14;
  }
  return std::string(open_svg) + sized(width, y) +
         "<style>text{font-family:'DejaVu Sans',Verdana,'Segoe UI',sans-serif;fill:#222}.title{font-size:22px;font-weight:bold}"
         ".step{font-size:13px;fill:#888}.operator{font:bold 12px 'DejaVu Sans Mono',Consolas,monospace}"
         ".counts{font:11px 'DejaVu Sans Mono',Consolas,monospace;white-space:pre}.caption{font-size:10px}"
         ".bad{font-size:10px;fill:#a8200a}.operator.bad{font-size:12px}.good{font-size:10px;fill:#14702d}" +
         drawing_style() + "</style>\n<rect width='100%' height='100%' fill='#fff'/>\n" + text_element(gap, 34, "title", story.title) +
         body + "</svg>\n";
}

std::string picture(const Story& story, const Layout& layout) {
  constexpr double side = 640.0;
  return std::string(open_svg) + sized(side, side + 44) +
         "<style>.counts{font:15px 'DejaVu Sans Mono',Consolas,monospace;white-space:pre}" + drawing_style() +
         "</style>\n<rect width='100%' height='100%' fill='#fff'/>\n<g transform='translate(320 320)'>" +
         drawing(story, story.frames.size() - 1, layout, side) + "</g>\n" +
         text_element(20, side + 24, "counts", counts(story.frames.back()) + "      " + equation(story.frames.back())) + "</svg>\n";
}

}  // namespace apps::euler
