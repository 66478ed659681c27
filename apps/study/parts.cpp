// SPDX-License-Identifier: MIT
#include "apps/study/parts.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "apps/archive.hpp"
#include "apps/bytes.hpp"
#include "apps/text.hpp"

namespace study {
namespace {

constexpr std::string_view magic = "halflight study part 2\n";

struct PartFields {
  template <class Archive, class T>
  void operator()(Archive& a, T& x) const {
    using Type = std::remove_const_t<T>;
    if constexpr (std::is_same_v<Type, Norms>) {
      a(x.l1, x.l2, x.worst);
    } else if constexpr (std::is_same_v<Type, Errors>) {
      a(x.cells, x.points);
    } else if constexpr (std::is_same_v<Type, ErrorParts>) {
      a(x.discretisation, x.links, x.solver, x.reconstruction);
    } else if constexpr (std::is_same_v<Type, radiosity::ErrorEstimate>) {
      a(x.relative_l2, x.standard_error, x.low, x.high);
    } else if constexpr (std::is_same_v<Type, Run>) {
      a(x.setting, x.cpu_seconds, x.seconds_saved, x.peak_bytes, x.bytes, x.links, x.leaves, x.rays, x.leaves_error, x.simple_error,
        x.weighted_error, x.picture_error, x.parts, x.refused, x.cut_off);
    } else if constexpr (std::is_same_v<Type, Method>) {
      a(x.name, x.summary, x.runs);
    } else if constexpr (std::is_same_v<Type, ErrorCell>) {
      a(x.corners, x.error);
    } else if constexpr (std::is_same_v<Type, ErrorPicture>) {
      a(x.method, x.setting, x.cells);
    } else if constexpr (std::is_same_v<Type, Reference>) {
      a(x.kind, x.noise, x.point_noise, x.cells, x.points, x.paths, x.cached);
    } else if constexpr (std::is_same_v<Type, radiosity::PictureSize>) {
      a(x.width, x.height);
    } else if constexpr (std::is_same_v<Type, radiosity::Camera>) {
      a(x.name, x.eye, x.forward, x.up, x.field_of_view, x.size);
    } else if constexpr (std::is_same_v<Type, radiosity::LeftOut>) {
      a(x.what, x.why, x.saved);
    } else if constexpr (std::is_same_v<Type, SceneStudy>) {
      a(x.scene, x.title, x.camera, x.reference, x.methods, x.pictures, x.left_out);
    } else if constexpr (std::is_same_v<Type, Study>) {
      a(x.scenes, x.machine, x.compiler, x.version, x.seed);
    } else if constexpr (std::is_same_v<Type, PartNumber>) {
      a(x.index, x.count);
    } else {
      static_assert(std::is_same_v<Type, Part>);
      a(x.number, x.asked, x.scene_count, x.method_count, x.methods, x.scenes, x.study);
    }
  }
};

}  // namespace

std::optional<PartNumber> parse_part(std::string_view text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const auto index = apps::number_in<std::size_t>(text.substr(0, slash));
  const auto count = apps::number_in<std::size_t>(text.substr(std::min(slash + 1, text.size())));
  const bool good = index && count && *index >= 1 && *index <= *count && *count <= 100'000;
  return good ? std::optional(PartNumber{*index, *count}) : std::nullopt;
}

std::string part_file(const PartNumber& number) {
  return "part-" + std::to_string(number.index) + "-of-" + std::to_string(number.count) + ".study";
}

std::string to_bytes(const Part& part) {
  apps::ArchiveWriter<PartFields> out;
  out(part);
  return std::string(magic) + apps::checksum_of(out.bytes) + "\n" + out.bytes;
}

std::optional<Part> read_part(std::string_view bytes) {
  if (!bytes.starts_with(magic) || bytes.size() < magic.size() + 17) { return std::nullopt; }
  const std::string_view sum = bytes.substr(magic.size(), 16), body = bytes.substr(magic.size() + 17);
  if (apps::checksum_of(body) != sum) { return std::nullopt; }
  apps::ArchiveReader<PartFields> in(body);
  Part part;
  in(part);
  const bool fits = part.methods.size() == part.study.scenes.size() && part.scenes.size() == part.study.scenes.size();
  return in.sound() && in.left() == 0 && fits ? std::optional(std::move(part)) : std::nullopt;
}

Merged merge(std::vector<Part> parts) {
  if (parts.empty()) { return {std::nullopt, "there is no part"}; }
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.number.index < b.number.index; });
  std::vector<std::string> missing, machines;
  const std::size_t count = parts.front().number.count;
  for (std::size_t i = 1, k = 0; i <= count; ++i) {
    if (k < parts.size() && parts[k].number.index == i) {
      ++k;
    } else {
      missing.push_back(std::to_string(i));
    }
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part& part = parts[i];
    if (part.number.count != count || part.asked != parts.front().asked) {
      return {std::nullopt, part_file(part.number) + " is of another study: other scenes, limits or version"};
    }
    if (i > 0 && part.number.index == parts[i - 1].number.index) {
      return {std::nullopt, "part " + std::to_string(part.number.index) + " is there twice"};
    }
  }
  if (!missing.empty()) { return {std::nullopt, "of " + std::to_string(count) + " parts these are missing: " + apps::joined(missing)}; }

  Study whole = parts.front().study;
  whole.scenes.clear();
  for (const Part& part : parts) {
    if (!apps::contains(machines, part.study.machine)) { machines.push_back(part.study.machine); }
  }
  whole.machine = apps::joined(machines, "; ");
  for (std::size_t scene = 0; scene < parts.front().scene_count; ++scene) {
    SceneStudy merged;
    bool found = false;
    for (std::size_t method = 0; method < parts.front().method_count; ++method) {
      for (Part& part : parts) {
        const auto place = std::find(part.scenes.begin(), part.scenes.end(), scene);
        if (place == part.scenes.end()) { continue; }
        const auto at = static_cast<std::size_t>(place - part.scenes.begin());
        SceneStudy& from = part.study.scenes[at];
        const auto which = std::find(part.methods[at].begin(), part.methods[at].end(), method);
        if (which == part.methods[at].end()) { continue; }
        if (!found) {  // the first method says what was left out of the scene, as on a single machine
          found = true;
          merged = {from.scene, from.title, from.camera, from.reference, {}, {}, from.left_out};
        }
        Method& of = from.methods[static_cast<std::size_t>(which - part.methods[at].begin())];
        for (ErrorPicture& picture : from.pictures) {
          if (picture.method == of.name) { merged.pictures.push_back(std::move(picture)); }
        }
        merged.methods.push_back(std::move(of));
      }
    }
    if (found) { whole.scenes.push_back(std::move(merged)); }
  }
  return {std::move(whole), {}};
}

}  // namespace study
