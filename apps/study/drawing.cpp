// SPDX-License-Identifier: MIT
#include "apps/study/drawing.hpp"

#include <array>
#include <cstdio>

#include "apps/bytes.hpp"
#include "apps/html_document.hpp"
#include "apps/text.hpp"

namespace study {
namespace {

std::string number(double x) { return apps::trimmed(x, 2); }

std::string hex(Srgb color) {
  char text[16] = "";
  std::snprintf(text, sizeof text, "#%06x", static_cast<unsigned>(color & 0xffffffU));
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
                       "\" fill=\"" + hex(label.color) + "\"";
  if (label.anchor != Anchor::start) { result += std::string(" text-anchor=\"") + anchors[static_cast<int>(label.anchor)] + "\""; }
  if (label.bold) { result += " font-weight=\"bold\""; }
  if (!label.upright) { result += " transform=\"rotate(-90 " + number(label.at.x) + " " + number(label.at.y) + ")\""; }
  return result + ">" + apps::escaped(label.text) + "</text>\n";
}

std::string element(const Image& image) {
  return "<image x=\"" + number(image.low.x) + "\" y=\"" + number(image.low.y) + "\" width=\"" + number(image.width) + "\" height=\"" +
         number(image.height) + "\" href=\"data:image/png;base64," + apps::base64(image.png) + "\"/>\n";
}

}  // namespace

double text_width(std::string_view text, double size) {
  // The larger advance of Helvetica (whose metrics Arial and Liberation Sans share) and DejaVu Sans, in thousandths of the size, from the
  // space to '~'. It is not known which of them the reader has.
  static constexpr std::array<int, 95> advance = {
      318, 401, 460, 838, 636, 950, 780, 275, 390,  390, 500, 838, 318, 361, 318, 337, 636, 636, 636, 636, 636, 636, 636, 636,
      636, 636, 337, 337, 838, 838, 838, 556, 1015, 684, 686, 722, 770, 667, 611, 778, 752, 295, 500, 667, 557, 863, 748, 787,
      667, 787, 722, 667, 611, 732, 684, 989, 685,  667, 685, 390, 337, 390, 838, 556, 500, 613, 635, 550, 635, 615, 352, 635,
      634, 278, 278, 579, 278, 974, 634, 612, 635,  635, 411, 521, 392, 634, 592, 818, 592, 592, 525, 636, 337, 636, 838};
  double width = 0.0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= ' ' && byte <= '~') {
      width += advance[byte - std::size_t{' '}];
    } else if (byte < 0x80 || byte >= 0xc0) {
      width += 838;  // any other character counts as wide as an arithmetic sign
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
