// SPDX-License-Identifier: MIT
// MGF (Materials and Geometry Format, Ward 1995), as far as diffuse scenes use it: the entities o, xf, i here, colours and materials in
// mgf_looks.cpp, shapes in mgf_shapes.cpp. Everything else is noted and ignored.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "apps/intake/mgf.hpp"
#include "apps/intake/model.hpp"
#include "apps/mesh_file/reading.hpp"

namespace apps::intake {
namespace mgf {
namespace {

glm::dmat4 power(glm::dmat4 matrix, std::size_t exponent) {
  glm::dmat4 result(1.0);
  for (; exponent > 0; exponent /= 2) {
    if (exponent % 2 == 1) { result = matrix * result; }
    matrix = matrix * matrix;
  }
  return result;
}

std::string found(const Line& line, std::size_t word) {
  return word < line.words.size() ? "found " + mesh_file::shown(line.words[word]) : "found the end of the line";
}

}  // namespace

double number(const Line& line, std::size_t word, Errors& errors) {
  const auto value = mesh_file::to_number(line.word(word));
  if (value && std::abs(*value) <= max_number) { return *value; }
  errors.add(line.place(word), "expected a number, " + found(line, word));
  return 0.0;
}

Transforms::Transforms(const Line& line, std::size_t first, Errors& errors) {
  for (std::size_t i = first; i < line.words.size();) {
    const std::string_view word = line.words[i];
    glm::dmat4& matrix = parts_.back().matrix;
    const auto axis = [&](std::size_t at) {
      glm::dvec3 along(0.0);
      along[word[at] - 'x'] = 1.0;
      return along;
    };
    if (word == "-t") {
      const glm::dvec3 by(number(line, i + 1, errors), number(line, i + 2, errors), number(line, i + 3, errors));
      matrix = glm::translate(glm::dmat4(1.0), by) * matrix;
      i += 4;
    } else if (word == "-rx" || word == "-ry" || word == "-rz") {
      matrix = glm::rotate(glm::dmat4(1.0), number(line, i + 1, errors) * std::numbers::pi / 180.0, axis(2)) * matrix;
      i += 2;
    } else if (word == "-s") {
      matrix = glm::scale(glm::dmat4(1.0), glm::dvec3(number(line, i + 1, errors))) * matrix;
      i += 2;
    } else if (word == "-mx" || word == "-my" || word == "-mz") {
      matrix = glm::scale(glm::dmat4(1.0), 1.0 - 2.0 * axis(2)) * matrix;
      i += 1;
    } else if (word == "-i" || word == "-a") {
      const auto count = mesh_file::to_integer(line.word(i + 1));
      const bool good = count && *count >= 0 && *count <= static_cast<std::int64_t>(most_copies);
      if (!good) {
        errors.add(line.place(i + 1), "expected a number from 0 to " + std::to_string(most_copies) + ", " + found(line, i + 1));
      }
      parts_.push_back({glm::dmat4(1.0), good ? static_cast<std::size_t>(*count) : 1, word == "-a"});
      if (parts_.back().array) { copies_ *= parts_.back().count; }
      if (copies_ > most_copies) {
        errors.add(line.place(i), "expected at most " + std::to_string(most_copies) + " copies by one xf");
        copies_ = 1;
      }
      i += 2;
    } else {
      errors.add(line.place(i), "expected -t, -rx, -ry, -rz, -s, -mx, -my, -mz, -i or -a, " + found(line, i));
      break;
    }
  }
}

glm::dmat4 Transforms::copy(std::size_t i) const {
  std::size_t left = i;
  glm::dmat4 result(1.0);
  for (const Part& part : parts_) {
    std::size_t times = part.count;
    if (part.array) {
      times = part.count > 0 ? left % part.count : 0;
      left /= std::max<std::size_t>(part.count, 1);
    }
    result = power(part.matrix, times) * result;
  }
  return result;
}

namespace {

constexpr std::size_t most_lines = 5'000'000;  // that are executed, because nested copies multiply
constexpr std::size_t most_corners = 10'000'000;
constexpr std::size_t most_files = 1000, deepest = 32;

class Reader {
 public:
  explicit Reader(const SideFile& side_file) : side_file_(side_file) { model.groups.emplace_back("mgf"); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  Model model;
  Notes notes;

  // Executes a text; its errors are added to `errors`.
  void read(std::string_view text, const glm::dmat4& placed, std::size_t depth, Errors& errors) {
    std::vector<Line> lines;
    mesh_file::Lines source(text, true, true);
    while (source.next()) {
      Line& line = lines.emplace_back();
      line.words = source.words();
      for (std::size_t i = 0; i <= line.words.size(); ++i) { line.places.push_back(source.place(i)); }
    }
    struct Frame {
      Transforms transforms;
      std::size_t begin = 0, copy = 0;
      glm::dmat4 outer{1.0};
    };
    std::vector<Frame> open;
    shapes_.transform = placed;
    for (std::size_t i = 0; i < lines.size() && !errors.full(); ++i) {
      const Line& line = lines[i];
      if (++lines_ > most_lines || model.corners.size() > most_corners) {
        return errors.add(line.place(0), "copies make more than " + std::to_string(most_lines) + " lines, or " +
                                             std::to_string(most_corners) + " corners of polygons");
      }
      if (line.words[0] != "xf") {
        entity(line, depth, errors);
        continue;
      }
      if (line.words.size() > 1) {
        Frame frame{Transforms(line, 1, errors), i, 0, shapes_.transform};
        if (frame.transforms.copies() == 0) {  // no copies: skips to the end of its block
          std::size_t inner = 1;
          while (inner > 0 && ++i < lines.size()) {
            if (lines[i].words[0] == "xf") { inner += lines[i].words.size() > 1 ? 1 : static_cast<std::size_t>(-1); }
          }
          continue;
        }
        shapes_.transform = frame.outer * frame.transforms.copy(0);
        open.push_back(std::move(frame));
      } else if (open.empty()) {
        errors.add(line.place(0), "this xf ends nothing");
      } else if (Frame& frame = open.back(); ++frame.copy < frame.transforms.copies()) {
        shapes_.transform = frame.outer * frame.transforms.copy(frame.copy);
        i = frame.begin;
      } else {
        shapes_.transform = frame.outer;
        open.pop_back();
      }
    }
    if (!open.empty() && !errors.full()) { errors.add(lines[open.back().begin].place(0), "this xf is not ended by one without arguments"); }
  }

 private:
  void entity(const Line& line, std::size_t depth, Errors& errors) {
    const std::string_view word = line.words[0];
    if (word == "o") {
      open_object(line);
    } else if (word == "i") {
      include(line, depth, errors);
    } else if (looks_.take(line, errors) || shapes_.take(line, errors)) {
      return;
    } else if (word == "ies") {
      notes.add("the entity 'ies' is not read: lamps shine evenly", at(line));
    } else if (word != "ir") {
      notes.add("the entity " + mesh_file::shown(word) + " is not read: passed over", at(line));
    }
  }

  void open_object(const Line& line) {
    if (line.words.size() > 1) {
      objects_.emplace_back(line.words[1]);
    } else if (!objects_.empty()) {
      objects_.pop_back();
    }
    std::string name;
    for (std::size_t i = 0; i < objects_.size() && i < deepest; ++i) { name += (i == 0 ? "" : ".") + objects_[i].substr(0, 100); }
    shapes_.name = name;
    model.groups.push_back(objects_.empty() ? "mgf" : std::move(name));
  }

  void include(const Line& line, std::size_t depth, Errors& errors) {
    const std::string name(line.word(1));
    const Transforms transforms(line, 2, errors);
    std::string fault;
    if (refused_.contains(name)) { return; }  // already reported
    if (depth >= deepest || ++files_ > most_files) {
      return errors.add(line.place(0), depth >= deepest ? "files that include others are nested deeper than " + std::to_string(deepest)
                                                        : "more than " + std::to_string(most_files) + " files are included");
    }
    const auto text = side_file_ && !name.empty() ? side_file_(name, fault) : std::nullopt;
    if (!text) {
      return notes.add("the file " + mesh_file::shown(name) + " " + (fault.empty() ? "is not there" : fault) + ": left out", at(line));
    }
    const glm::dmat4 outer = shapes_.transform;
    const std::string outer_file = std::exchange(file_, name);
    model.begin_part(file_);
    for (std::size_t i = 0; i < transforms.copies() && !errors.full() && lines_ <= most_lines; ++i) {
      Errors inner;
      read(*text, outer * transforms.copy(i), depth + 1, inner);
      if (inner.count() > 0) {
        errors.add(line.place(1), "in " + first_error(inner.take(), name));
        refused_.insert(name);
        break;
      }
    }
    shapes_.transform = outer;
    file_ = outer_file;
    model.begin_part(file_);
  }

  const SideFile& side_file_;
  Looks looks_{model, notes};
  Shapes shapes_{model, notes, looks_};
  std::vector<std::string> objects_;  // open objects, from the outermost
  std::string file_;                  // the file being included; empty: none
  std::set<std::string> refused_;     // included files with errors
  std::size_t lines_ = 0, files_ = 0;
};

ModelResult read_mgf(std::string_view bytes, const SideFile& side_file) {
  Errors errors;
  Reader reader(side_file);
  reader.read(bytes, glm::dmat4(1.0), 0, errors);
  reader.model.notes = reader.notes.take();
  return read_result(std::move(reader.model), errors);
}

}  // namespace
}  // namespace mgf

constinit const ModelFormat mgf_format{".mgf", "MGF", UpAxis::z, [](std::string_view) { return false; }, mgf::read_mgf};

}  // namespace apps::intake
