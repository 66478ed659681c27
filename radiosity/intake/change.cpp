// SPDX-License-Identifier: MIT
#include <radiosity/intake/change.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include <brep/inline.hpp>

namespace radiosity {
namespace intake::detail {

// "#" stands for the count, "@" for the size.
struct Wording {
  const char *one, *several;
};

inline constexpr std::array<Wording, static_cast<std::size_t>(ChangeKind::merged) + 1> wordings{{
    {"1 polygon has a corner that is not finite, or a corner or a material that does not exist: left out",
     "# polygons have corners that are not finite, or corners or materials that do not exist: left out"},
    {"1 polygon has more than 20 000 corners: left out", "# polygons have more than 20 000 corners: left out"},
    {"1 vertex lay on another one, @ beside it: made one", "# vertices lay on others, beside them by up to @: made one"},
    {"1 polygon has no area: left out", "# polygons have no area: left out"},
    {"1 polygon is only @ wide: left out", "# polygons are at most @ wide: left out"},
    {"1 polygon lies on another one: left out", "# polygons lie on others: left out"},
    {"1 polygon was given as triangles that fold back on each other, as a concave one divided like a convex one: made whole",
     "# polygons were given as triangles that fold back on each other, as concave ones divided like convex ones: made whole"},
    {"1 polygon was not planar by @: split", "# polygons were not planar by up to @: split"},
    {"1 polygon crossed itself: split", "# polygons crossed themselves: split"},
    {"1 polygon has holes or very many corners: split", "# polygons have holes or very many corners: split"},
    {"1 vertex was moved by @, so that its polygons are planar", "# vertices were moved by up to @, so that their polygons are planar"},
    {"1 vertex lay on the edge of another polygon, beside it by @: joined",
     "# vertices lay on edges of other polygons, beside them by up to @: joined"},
    {"1 edge has more than two polygons: cut", "# edges have more than two polygons: cut"},
    {"1 polygon looked another way than its neighbours: turned", "# polygons looked another way than their neighbours: turned"},
    {"across 1 edge polygons cannot look the same way, as on a Moebius strip: cut",
     "across # edges polygons cannot look the same way, as on a Moebius strip: cut"},
    {"1 polygon showed its back to the light and its front to the inside of things: turned",
     "# polygons showed their backs to the light and their fronts to the inside of things: turned"},
    {"1 polygon fits to none of its neighbours: a surface of its own", "# polygons fit to none of their neighbours: surfaces of their own"},
    {"1 closed shell looked inwards with no lamp or camera in it: turned",
     "# closed shells looked inwards with no lamp or camera in them: turned"},
    {"1 closed shell around a lamp or a camera looked outwards: turned, as a room",
     "# closed shells around lamps or cameras looked outwards: turned, as rooms"},
    {"1 vertex of a lamp lay beside a wall, by @: moved onto it", "# vertices of lamps lay beside walls, by up to @: moved onto them"},
    {"1 lamp lay on a surface, or close before it, and looked into it: turned",
     "# lamps lay on surfaces, or close before them, and looked into them: turned"},
    {"1 lamp shines on both sides, on one of them into the gap before a surface: that side is left out",
     "# lamps shine on both sides, on one of them into the gap before a surface: that side is left out"},
    {"nothing says on which side 1 open lamp shines: on the one from which its corners run counter-clockwise (--two-sided: on both)",
     "nothing says on which side # open lamps shine: on the one from which their corners run counter-clockwise (--two-sided: on both)"},
    {"1 vertex of a flat surface lay beside a larger one, by @: moved onto it",
     "# vertices of flat surfaces lay beside larger ones, by up to @: moved onto them"},
    {"1 polygon lies partly on a larger one in the same plane: seen in front of it",
     "# polygons lie partly on larger ones in the same plane: seen in front of these"},
    {"1 polygon has light on both sides, as a wall between rooms: it reflects on both",
     "# polygons have light on both sides, as walls between rooms: they reflect on both"},
    {"1 surface has polygons of both orientations: it reflects on both sides",
     "# surfaces have polygons of both orientations: they reflect on both sides"},
    {"1 open surface may be seen from either side, for nothing says which: it reflects on both",
     "# open surfaces may be seen from either side, for nothing says which: they reflect on both"},
    {"1 open surface shows its back to a room: it reflects on both sides",
     "# open surfaces show their backs to a room: they reflect on both sides"},
    {"1 polygon became part of a coplanar neighbour", "# polygons became parts of coplanar neighbours"},
}};

inline std::string replaced(std::string text, char mark, const std::string& by) {
  const std::size_t at = text.find(mark);
  return at == std::string::npos ? text : text.replace(at, 1, by);
}

}  // namespace intake::detail

HALFLIGHT_INLINE std::string length_text(double metres) {
  constexpr std::array<std::pair<double, const char*>, 5> units{{{1e3, " km"}, {1.0, " m"}, {1e-3, " mm"}, {1e-6, " um"}, {0.0, " nm"}}};
  for (const auto& [unit, name] : units) {
    if (!(metres >= unit) || metres == 0.0) { continue; }
    const double value = metres / (unit > 0.0 ? unit : 1e-9);
    const double step = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-3))) - 1.0);  // two digits
    const double rounded = std::round(value / step) * step;
    std::string text = std::to_string(rounded);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') { text.pop_back(); }
    return text + name;
  }
  return "0 mm";
}

HALFLIGHT_INLINE bool tells_size(const Change& change) {
  const std::string_view several = intake::detail::wordings[static_cast<std::size_t>(change.kind)].several;
  return several.find('@') != several.npos && !length_text(change.size).starts_with("0 ");
}

HALFLIGHT_INLINE std::string sentence(const Change& change) {
  const intake::detail::Wording& wording = intake::detail::wordings[static_cast<std::size_t>(change.kind)];
  std::string text = change.count == 1 ? wording.one : wording.several;
  if (!tells_size(change)) {  // exactly there, or within rounding
    for (const std::string_view beside : {", @ beside it", ", beside it by @", ", beside them by up to @"}) {
      const std::size_t at = text.find(beside);
      if (at != std::string::npos) { text.erase(at, beside.size()); }
    }
  }
  text = intake::detail::replaced(std::move(text), '#', std::to_string(change.count));
  return intake::detail::replaced(std::move(text), '@', length_text(change.size));
}

}  // namespace radiosity
