// SPDX-License-Identifier: MIT
// MGF (Materials and Geometry Format, Ward 1995), as far as diffuse scenes have it: the entities o, xf, i here, colours and materials in
// mgf_looks.hpp, shapes in mgf_shapes.hpp. All else is told and passed over.
#include <set>
#include <string>
#include <utility>

#include "apps/intake/mgf_looks.hpp"
#include "apps/intake/mgf_shapes.hpp"
#include "apps/intake/mgf_transform.hpp"
#include "apps/intake/model.hpp"
#include "apps/mesh_file/reading.hpp"

namespace apps::intake {
namespace mgf {
namespace {

constexpr std::size_t most_lines = 5'000'000;  // that are carried out: copies of copies multiply
constexpr std::size_t most_corners = 10'000'000;
constexpr std::size_t most_files = 1000, deepest = 32;

class Reader {
 public:
  explicit Reader(const SideFile& side_file) : side_file_(side_file) { model.groups.emplace_back("mgf"); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  Model model;
  Notes notes;

  // Carries a text out; errors of it into `errors`.
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
        if (frame.transforms.copies() == 0) {  // to its end
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
    if (refused_.contains(name)) { return; }  // that has been told
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
        const std::string first = to_text(inner.take(), name);
        errors.add(line.place(1), "in " + first.substr(0, first.find('\n')));
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
  std::vector<std::string> objects_;  // that are open
  std::string file_;                  // that is included; empty: none
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

extern const ModelFormat mgf_format;
constinit const ModelFormat mgf_format{".mgf", "MGF", UpAxis::z, [](std::string_view) { return false; }, mgf::read_mgf};

}  // namespace apps::intake
