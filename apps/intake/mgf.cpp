// SPDX-License-Identifier: MIT
// MGF (Materials and Geometry Format, Ward 1995), as far as diffuse scenes have it: the entities o, xf, i; c with cxy, cspec, cct, cmix; m
// with sides, rd, ed; v with p and n; f, sph, cyl, cone, ring, torus, prism. All else is told and passed over. Spheres and tori stay
// analytic; what is open, cylinders and cones without their ends, becomes polygons, of as many sides as rings, so that both fit together.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <raycast/objects/sphere.hpp>
#include <raycast/objects/torus.hpp>
#include <raycast/transform.hpp>

#include "apps/intake/mgf_color.hpp"
#include "apps/intake/mgf_contexts.hpp"
#include "apps/intake/mgf_transform.hpp"
#include "apps/intake/model.hpp"
#include "apps/mesh_file/reading.hpp"

namespace apps::intake {
namespace mgf {
namespace {

constexpr std::size_t most_lines = 5'000'000;  // that are carried out: copies of copies multiply
constexpr std::size_t most_corners = 10'000'000;
constexpr std::size_t most_files = 1000, deepest = 32;
constexpr int sides_of_circle = 32;

class Reader {
 public:
  explicit Reader(const SideFile& side_file) : side_file_(side_file) { model.groups.emplace_back("mgf"); }

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
    transform_ = placed;
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
        Frame frame{Transforms(line, 1, errors), i, 0, transform_};
        if (frame.transforms.copies() == 0) {  // to its end
          std::size_t inner = 1;
          while (inner > 0 && ++i < lines.size()) {
            if (lines[i].words[0] == "xf") { inner += lines[i].words.size() > 1 ? 1 : static_cast<std::size_t>(-1); }
          }
          continue;
        }
        transform_ = frame.outer * frame.transforms.copy(0);
        open.push_back(std::move(frame));
      } else if (open.empty()) {
        errors.add(line.place(0), "this xf ends nothing");
      } else if (Frame& frame = open.back(); ++frame.copy < frame.transforms.copies()) {
        transform_ = frame.outer * frame.transforms.copy(frame.copy);
        i = frame.begin;
      } else {
        transform_ = frame.outer;
        open.pop_back();
      }
    }
    if (!open.empty() && !errors.full()) { errors.add(lines[open.back().begin].place(0), "this xf is not ended by one without arguments"); }
  }

 private:
  void entity(const Line& line, std::size_t depth, Errors& errors) {
    const std::string_view word = line.words[0];
    const auto at = [&] { return "at line " + std::to_string(line.place(0).line); };
    const auto value = [&](std::size_t i) { return number(line, i, errors); };
    const auto vertex = [&](std::size_t i) { return vertices_.find(line, i, errors); };
    if (word == "o") {
      open_object(line);
    } else if (word == "i") {
      include(line, depth, errors);
    } else if (word == "c") {
      colors_.choose(line, errors);
    } else if (word == "cxy") {
      const Chroma given{value(1), value(2)};
      if (given.x >= 0.0 && given.y > 1e-6 && given.x + given.y <= 1.0) {
        colors_.current() = given;
      } else {
        errors.add(line.place(1), "expected a chromaticity, x and y above 0 with a sum of at most 1");
      }
    } else if (word == "cct") {
      const double kelvin = value(1);
      if (!(kelvin >= 100.0 && kelvin <= 1e6)) { return errors.add(line.place(1), "expected a temperature from 100 to 1000000 K"); }
      set_color(xyz_of_temperature(kelvin));
    } else if (word == "cspec") {
      spectrum(line, errors);
    } else if (word == "cmix") {
      mixture(line, errors);
    } else if (word == "m") {
      materials_.choose(line, errors);
      if (line.words.size() != 2) { materials_.current().number = Material::none; }
      if (line.word(2) == "=") { materials_.current().name = line.words[1]; }
    } else if (word == "sides") {
      changed().two_sided = value(1) != 1.0;
    } else if (word == "rd" || word == "ed") {
      const double amount = value(1);
      const Chroma chroma = colors_.current();
      if (amount < 0.0) { return errors.add(line.place(1), "expected a number from 0 on, found " + mesh_file::shown(line.word(1))); }
      if (word == "rd") { changed().reflectance = amount * color_of(chroma.x, chroma.y); }
      if (word == "ed") {
        changed().emission = amount / white_efficacy * color_of(chroma.x, chroma.y);
        if (amount > 0.0) { notes.add("ed is in lm/m2: 179 lm are 1 W of white light", at()); }
      }
    } else if (word == "td" || word == "rs" || word == "ts") {
      if (value(1) != 0.0) { notes.add("what materials reflect as mirrors or let through is left out", at()); }
    } else if (word == "v") {
      vertices_.choose(line, errors);
    } else if (word == "p" || word == "n") {
      (word == "p" ? vertices_.current().position : vertices_.current().normal) = {value(1), value(2), value(3)};
    } else if (word == "f") {
      std::vector<glm::dvec3> corners;
      for (std::size_t i = 1; i < line.words.size(); ++i) {
        if (const Vertex* const v = vertex(i)) { corners.push_back(v->position); }
      }
      if (line.words.size() < 4) { return errors.add(line.place(line.words.size()), "a face has at least three vertices"); }
      if (corners.size() + 1 == line.words.size()) { polygon(corners, line); }
    } else if (word == "prism") {
      prism(line, errors);
    } else if (word == "sph" || word == "torus") {
      round(line, errors);
    } else if (word == "cyl" || word == "cone") {
      const Vertex *const a = vertex(1), *const b = vertex(3);
      const double from = value(2), to = word == "cyl" ? from : value(4);
      if (a != nullptr && b != nullptr) { strip(a->position, b->position, b->position - a->position, from, to, line); }
    } else if (word == "ring") {
      const Vertex* const v = vertex(1);
      const double inner = value(2), outer = value(3);
      if (v != nullptr) { strip(v->position, v->position, v->normal, outer, inner, line); }
    } else if (word == "fh" || word == "ies") {
      notes.add(
          word == "fh" ? "the entity 'fh' is not read: faces with holes are left out" : "the entity 'ies' is not read: lamps shine evenly",
          at());
    } else if (word != "ir") {
      notes.add("the entity " + mesh_file::shown(word) + " is not read: passed over", at());
    }
  }

  void set_color(const glm::dvec3& xyz) {
    const double sum = xyz.x + xyz.y + xyz.z;
    colors_.current() = {xyz.x / sum, xyz.y / sum};
  }

  void spectrum(const Line& line, Errors& errors) {
    const double first = number(line, 1, errors), last = number(line, 2, errors);
    if (!(first < last)) { return errors.add(line.place(1), "expected two wavelengths in nm, the shorter one first"); }
    std::vector<double> values;
    for (std::size_t i = 3; i < line.words.size(); ++i) {
      values.push_back(number(line, i, errors));
      if (values.back() < 0.0) { return errors.add(line.place(i), "expected a number from 0 on, found " + mesh_file::shown(line.word(i))); }
    }
    if (values.size() < 2) { return errors.add(line.place(line.words.size()), "a spectrum has at least two values"); }
    const glm::dvec3 xyz = xyz_of_samples(values, first, last);
    if (!(xyz.y > 1e-6 * (xyz.x + xyz.y + xyz.z))) { return errors.add(line.place(3), "nothing of this spectrum is seen"); }
    set_color(xyz);
  }

  // By the weights, which are shares of the luminance.
  void mixture(const Line& line, Errors& errors) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < line.words.size() || i == 1; i += 2) {
      const double weight = number(line, i, errors);
      const Chroma* const color = colors_.find(line, i + 1, errors);
      if (color == nullptr) { return; }
      if (weight < 0.0) { return errors.add(line.place(i), "expected a number from 0 on, found " + mesh_file::shown(line.word(i))); }
      sum += weight * glm::dvec3(color->x, color->y, 1.0 - color->x - color->y) / color->y;
    }
    if (line.words.size() % 2 == 0) { return errors.add(line.place(line.words.size()), "expected pairs of a weight and a colour"); }
    if (!(sum.y > 0.0)) { return errors.add(line.place(1), "the weights are all 0"); }
    set_color(sum);
  }

  Material& changed() {
    materials_.current().number = Material::none;  // what has it already keeps it as it was
    return materials_.current();
  }

  void open_object(const Line& line) {
    if (line.words.size() > 1) {
      objects_.emplace_back(line.words[1]);
    } else if (!objects_.empty()) {
      objects_.pop_back();
    }
    std::string name;
    for (std::size_t i = 0; i < objects_.size() && i < deepest; ++i) { name += (i == 0 ? "" : ".") + objects_[i].substr(0, 100); }
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
      return notes.add("the file " + mesh_file::shown(name) + " " + (fault.empty() ? "is not there" : fault) + ": left out",
                       "at line " + std::to_string(line.place(0).line));
    }
    const glm::dmat4 outer = transform_;
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
    transform_ = outer;
  }

  std::uint32_t material() {
    Material& current = materials_.current();
    if (current.number == Material::none) {
      current.number = static_cast<std::uint32_t>(model.materials.size());
      model.materials.push_back({current.name, current.reflectance, current.emission, current.two_sided});
    }
    return current.number;
  }

  // Corners before the transform, counter-clockwise from the front.
  void polygon(std::vector<glm::dvec3> corners, const Line& line) {
    if (glm::determinant(glm::dmat3(transform_)) < 0.0) { std::reverse(corners.begin(), corners.end()); }
    std::vector<std::uint32_t> indices;
    for (const glm::dvec3& corner : corners) {
      const glm::dvec3 p(transform_ * glm::dvec4(corner, 1.0));
      const auto [known, is_new] = positions_.emplace(std::array{p.x, p.y, p.z}, static_cast<std::uint32_t>(model.positions.size()));
      if (is_new) { model.positions.push_back(p); }
      indices.push_back(known->second);
    }
    model.polygon(indices, material(), static_cast<std::uint32_t>(model.groups.size() - 1), line.place(0).line);
  }

  void prism(const Line& line, Errors& errors) {
    std::vector<glm::dvec3> base, top;
    glm::dvec3 area(0.0);
    const std::size_t last = line.words.size() - 1;
    if (last < 4) { return errors.add(line.place(last + 1), "a prism has at least three vertices and a length"); }
    for (std::size_t i = 1; i < last; ++i) {
      const Vertex* const v = vertices_.find(line, i, errors);
      if (v == nullptr) { return; }
      base.push_back(v->position);
    }
    const double length = number(line, last, errors);
    for (std::size_t i = 2; i < base.size(); ++i) { area += glm::cross(base[i - 1] - base[0], base[i] - base[0]); }
    if (!(glm::length(area) > 0.0) || length == 0.0) {
      return notes.add("shapes without size are left out", "at line " + std::to_string(line.place(0).line));
    }
    for (const glm::dvec3& p : base) { top.push_back(p - length * glm::normalize(area)); }
    for (std::size_t i = 0; i < base.size(); ++i) {
      const std::size_t next = (i + 1) % base.size();
      polygon({base[next], base[i], top[i], top[next]}, line);
    }
    polygon({top.rbegin(), top.rend()}, line);
    polygon(std::move(base), line);
  }

  // A sphere or torus; with a negative radius seen from within.
  void round(const Line& line, Errors& errors) {
    const Vertex* const v = vertices_.find(line, 1, errors);
    const bool ball = line.words[0] == "sph";
    const double inner = number(line, 2, errors), outer = ball ? inner : number(line, 3, errors);
    if (v == nullptr || model.objects.size() > max_objects) { return; }
    raycast::Placement placement{glm::dmat3(transform_), glm::dvec3(transform_[3]), inner < 0.0 || outer < 0.0};
    const double small = std::abs(inner), large = std::abs(outer);
    std::shared_ptr<const raycast::Object> object;
    if (ball) {
      object = raycast::Sphere::make(v->position, large).object;
    } else {
      object = raycast::Torus::make(v->position, v->normal, 0.5 * (small + large), 0.5 * (large - small)).object;
    }
    if (!object || raycast::check(*object, placement)) {
      return notes.add("shapes without size, or flattened by their transform, are left out",
                       "at line " + std::to_string(line.place(0).line));
    }
    const std::string name = objects_.empty() ? (ball ? "sphere" : "torus") : model.groups.back();
    model.objects.push_back({name, std::move(object), placement, {material()}});
    model.origins.push_back({ball ? "sphere" : "torus", line.place(0)});
  }

  // What lies between a circle around `a` and one around `b`, both across `axis`: seen from outside, of a ring from where its axis points;
  // with a negative radius from the other side. Radii may be 0.
  void strip(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& axis, double from, double to, const Line& line) {
    const double length = glm::length(axis), r = std::abs(from), s = std::abs(to);
    if (!(length > 0.0) || (r == 0.0 && s == 0.0) || (a == b && r == s)) {
      return notes.add("shapes without size are left out", "at line " + std::to_string(line.place(0).line));
    }
    const glm::dvec3 n = axis / length;
    glm::dvec3 other(0.0);
    other[std::abs(n.x) < 0.6 ? 0 : std::abs(n.y) < 0.6 ? 1 : 2] = 1.0;
    const glm::dvec3 u = glm::normalize(glm::cross(n, other)), v = glm::cross(n, u);
    const auto point = [&](const glm::dvec3& centre, double radius, int i) {
      const double angle = 2.0 * std::numbers::pi * (i % sides_of_circle) / sides_of_circle;
      return centre + radius * (std::cos(angle) * u + std::sin(angle) * v);
    };
    const bool inwards = (from < 0.0 || to < 0.0);
    if (s == 0.0 && a == b) {  // a disk
      std::vector<glm::dvec3> disk;
      for (int i = 0; i < sides_of_circle; ++i) { disk.push_back(point(a, r, i)); }
      return polygon(std::move(disk), line);
    }
    for (int i = 0; i < sides_of_circle; ++i) {
      std::vector<glm::dvec3> corners;
      if (r > 0.0) {
        corners = {point(a, r, i), point(a, r, i + 1)};
      } else {
        corners = {a};
      }
      if (s > 0.0) {
        corners.insert(corners.end(), {point(b, s, i + 1), point(b, s, i)});
      } else {
        corners.push_back(b);
      }
      if (inwards) { std::reverse(corners.begin(), corners.end()); }
      polygon(std::move(corners), line);
    }
  }

  const SideFile& side_file_;
  Contexts<Chroma> colors_{"colour"};
  Contexts<Material> materials_{"material"};
  Contexts<Vertex> vertices_{"vertex"};
  std::vector<std::string> objects_;  // that are open
  std::set<std::string> refused_;     // included files with errors
  glm::dmat4 transform_{1.0};
  std::map<std::array<double, 3>, std::uint32_t> positions_;
  std::size_t lines_ = 0, files_ = 0;
};

ModelResult read_mgf(std::string_view bytes, const SideFile& side_file) {
  Errors errors;
  Reader reader(side_file);
  reader.read(bytes, glm::dmat4(1.0), 0, errors);
  reader.model.notes = reader.notes.take();
  const bool sound = errors.count() == 0;
  return {errors.take(), sound ? std::optional(std::move(reader.model)) : std::nullopt};
}

}  // namespace
}  // namespace mgf

extern const ModelFormat mgf_format;
constinit const ModelFormat mgf_format{".mgf", "MGF", UpAxis::z, [](std::string_view) { return false; }, mgf::read_mgf};

}  // namespace apps::intake
