// SPDX-License-Identifier: MIT
#include "apps/study/svg.hpp"

#include <array>
#include <cstdio>

#include "apps/markup.hpp"
#include "apps/study/base64.hpp"
#include "apps/text.hpp"

namespace study {
namespace {

std::string number(double x) { return apps::trimmed(x, 2); }

std::string hex(Tone tone) {
  char text[16] = "";
  std::snprintf(text, sizeof text, "#%06x", static_cast<unsigned>(tone & 0xffffffU));
  return text;
}

std::string element(const Shape& shape) {
  std::string path;
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    path += (i == 0 ? "M" : "L") + number(shape.points[i].x) + " " + number(shape.points[i].y);
  }
  std::string result = "<path d=\"" + path + (shape.closed ? "Z\"" : "\"");
  result += " fill=\"" + (shape.filled ? hex(shape.fill) : "none") + "\"";
  if (shape.stroke_width > 0.0) { result += " stroke=\"" + hex(shape.stroke) + "\" stroke-width=\"" + number(shape.stroke_width) + "\""; }
  if (!shape.dashes.empty()) {
    std::string dashes;
    for (const double d : shape.dashes) { dashes += (dashes.empty() ? "" : " ") + number(d); }
    result += " stroke-dasharray=\"" + dashes + "\"";
  }
  if (shape.opacity < 1.0) { result += " opacity=\"" + number(shape.opacity) + "\""; }
  return result + (shape.title.empty() ? "/>\n" : "><title>" + apps::escaped(shape.title) + "</title></path>\n");
}

std::string element(const Label& label) {
  static constexpr const char* anchors[] = {"start", "middle", "end"};
  std::string result = "<text x=\"" + number(label.at.x) + "\" y=\"" + number(label.at.y) + "\" font-size=\"" + number(label.size) +
                       "\" fill=\"" + hex(label.tone) + "\"";
  if (label.anchor != Anchor::start) { result += std::string(" text-anchor=\"") + anchors[static_cast<int>(label.anchor)] + "\""; }
  if (label.bold) { result += " font-weight=\"bold\""; }
  if (!label.upright) { result += " transform=\"rotate(-90 " + number(label.at.x) + " " + number(label.at.y) + ")\""; }
  return result + ">" + apps::escaped(label.text) + "</text>\n";
}

std::string element(const Image& image) {
  return "<image x=\"" + number(image.low.x) + "\" y=\"" + number(image.low.y) + "\" width=\"" + number(image.width) + "\" height=\"" +
         number(image.height) + "\" href=\"data:image/png;base64," + base64(image.png) + "\"/>\n";
}

}  // namespace

double text_width(std::string_view text, double size) {
  // Of Helvetica, whose metrics Arial and Liberation Sans share, in thousandths of the size; from the space to '~'.
  static constexpr std::array<int, 95> advance = {
      278, 278, 355, 556, 556, 889, 667, 191, 333,  333, 389, 584, 278, 333, 278, 278, 556, 556, 556, 556, 556, 556, 556, 556,
      556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778,
      667, 778, 722, 667, 611, 722, 667, 944, 667,  667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278, 556,
      556, 222, 222, 500, 222, 833, 556, 556, 556,  556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584};
  double width = 0.0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= ' ' && byte <= '~') {
      width += advance[byte - std::size_t{' '}];
    } else if (byte < 0x80 || byte >= 0xc0) {
      width += 584;  // any other character is as wide as a sign of arithmetic
    }
  }
  return 1e-3 * size * width;
}

std::string to_svg(const Drawing& drawing, const std::string& description) {
  const std::string width = number(drawing.width);
  const std::string height = number(drawing.height);
  std::string result = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + height + "\" viewBox=\"0 0 " +
                       width + " " + height + "\" role=\"img\" aria-label=\"" + apps::escaped(description) +
                       "\" font-family=\"Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif\" stroke-linecap=\"round\" "
                       "stroke-linejoin=\"round\">\n";
  result += "<rect width=\"" + width + "\" height=\"" + height + "\" fill=\"" + hex(paper) + "\"/>\n";
  for (const auto& item : drawing.items) {
    result += std::visit([](const auto& shape) { return element(shape); }, item);
  }
  return result + "</svg>\n";
}

std::string to_svg_file(const Drawing& drawing, const std::string& description) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + to_svg(drawing, description);
}

}  // namespace study
