// SPDX-License-Identifier: MIT
// The clauses of statements: what may follow each keyword, and the checks that concern one clause only.
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <raycast/transform.hpp>

#include <radiosity/scene/material.hpp>

#include "apps/scene_file/parser.hpp"
#include "apps/text.hpp"

namespace apps::scene_file {
namespace {

// Appends the linear map `after` to the placement.
void append(raycast::Placement& placement, const glm::dmat3& after) {
  placement.linear = after * placement.linear;
  placement.translation = after * placement.translation;
}

// Rodrigues' rotation about a unit axis, counter-clockwise seen from the tip of the axis. Quarter turns are exact.
glm::dmat3 rotation(const glm::dvec3& axis, double degrees) {
  const double turn = std::remainder(degrees, 360.0);
  const double angle = turn * std::numbers::pi / 180.0;
  double c = std::cos(angle);
  double s = std::sin(angle);
  if (std::fmod(turn, 90.0) == 0.0) {
    c = std::round(c);
    s = std::round(s);
  }
  glm::dmat3 result(0.0);
  for (int column = 0; column < 3; ++column) {
    glm::dvec3 unit(0.0);
    unit[column] = 1.0;
    result[column] = c * unit + s * glm::cross(axis, unit) + (1.0 - c) * glm::dot(axis, unit) * axis;
  }
  return result;
}

}  // namespace

// Parses one number, which counts for all three, or three; `read` reads each. False after an error about their number.
template <class Read>
bool Parser::one_or_three(const Token& keyword, const char* names, glm::dvec3& out, const Read& read) {
  int count = 0;
  for (; at(Token::Kind::number) && count < 3; ++count) { out[count] = read(token_); }
  if (count == 1) { out = glm::dvec3(out[0]); }
  const std::string takes = std::string("one number or three (") + names + ")";
  if (count != 0 && count != 2) { return no_more_numbers(keyword.text, takes); }
  error(token_.place, "'" + std::string(keyword.text) + "' takes " + takes + "; expected number " + std::to_string(count + 1) + ", found " +
                          describe(token_));
  return false;
}

void Parser::color_clause(const Token& keyword, radiosity::Color& out, double most, std::string_view law) {
  one_or_three(keyword, "red green blue", out, [&](const Token found) {
    double value = 0.0;
    if (number(keyword.text, value, std::numeric_limits<double>::max()) && (value < 0.0 || value > most)) {
      error(found.place, std::string(keyword.text) + " " + in_quotes(found.text) + " " + std::string(law));
    }
    return value;
  });
}

void Parser::material_clause(const Token& keyword, MaterialSyntax& out) {
  if (keyword.text == "reflectance") {
    color_clause(keyword, out.reflectance, 1.0, "lies outside 0 to 1; a surface reflects at most what it receives");
  } else {
    color_clause(keyword, out.emission, std::numeric_limits<double>::max(), "is negative; expected an exitance in W/m2");
  }
}

void Parser::camera_clause(const Token& keyword, CameraSyntax& out) {
  radiosity::Camera& camera = out.camera;
  const Place place = token_.place;
  if (keyword.text == "eye") {
    vector(keyword, camera.eye);
  } else if (keyword.text == "target" || keyword.text == "look") {
    vector(keyword, camera.forward);
  } else if (keyword.text == "up") {
    if (vector(keyword, camera.up) && camera.up == glm::dvec3(0.0)) { error(place, "'up' has no direction"); }
  } else if (keyword.text == "fov") {
    double& fov = camera.field_of_view;
    if (numbers(keyword, std::span(&fov, 1)) && !(fov >= 0.001 && fov <= 179.0)) {
      error(place, "expected a horizontal field of view from 0.001 to 179 degrees, found " + shortest(fov));
    }
  } else {
    radiosity::PictureSize size;
    const bool read = whole_number("size", max_picture_side, size.width) && whole_number("size", max_picture_side, size.height);
    if (read && (size.width == 0 || size.height == 0)) { error(place, "'size' needs at least 1 pixel each way"); }
    camera.size = size;
  }
}

bool Parser::placement_clause(const Token& keyword, raycast::Placement& out) {
  if (keyword.text == "move") {
    glm::dvec3 by{0.0};
    if (vector(keyword, by)) { out.translation += by; }
  } else if (keyword.text == "rotate") {
    rotate_clause(keyword, out);
  } else if (keyword.text == "scale") {
    scale_clause(keyword, out);
  } else {
    return false;
  }
  return true;
}

void Parser::rotate_clause(const Token& keyword, raycast::Placement& out) {
  const Place place = token_.place;
  double values[4] = {0.0, 0.0, 0.0, 0.0};
  if (!numbers(keyword, values)) { return; }
  const glm::dvec3 axis(values[0], values[1], values[2]);
  const double length = glm::length(axis);
  if (!(length > 0.0)) { return error(place, "'rotate' needs an axis that is not 0 0 0 (expected: rotate X Y Z DEGREES)"); }
  append(out, rotation(axis / length, values[3]));
}

void Parser::scale_clause(const Token& keyword, raycast::Placement& out) {
  glm::dvec3 by(1.0);
  one_or_three(keyword, "x y z", by, [&](const Token found) {
    double factor = 1.0;
    if (!number(keyword.text, factor)) { return 1.0; }
    if (std::abs(factor) >= 1.0 / max_number) { return factor; }
    error(found.place, "'scale' by " + in_quotes(found.text) + " leaves nothing of the object");
    return 1.0;
  });
  append(out, glm::dmat3(by.x, 0, 0, 0, by.y, 0, 0, 0, by.z));
}

void Parser::sheet_clause(ObjectSyntax& out) {
  SheetSyntax syntax;
  if (at(Token::Kind::number)) {
    syntax.sheet = {std::string(token_.text), token_.place};
    next();
  } else if (!name("sheet", syntax.sheet)) {
    return skip_rest();
  }
  if (!at_word("material")) {
    error(token_.place,
          "expected 'material' and its name after 'sheet " + syntax.sheet.text.substr(0, 40) + "', found " + describe(token_));
    return skip_rest();
  }
  next();
  if (name("material", syntax.material)) { out.sheets.push_back(std::move(syntax)); }
}

void Parser::file_clause(ObjectSyntax& out) {
  std::string_view name = token_.text;
  if (!at(Token::Kind::word) && !at(Token::Kind::number)) {
    return error(token_.place, "expected the name of a file, found " + describe(token_));
  }
  if (name[0] == '"') {
    if (name.size() < 3 || name.back() != '"') {
      error(token_.place, "expected the name of a file in double quotes, found " + describe(token_));
    }
    name = name.substr(1, name.rfind('"') - 1);
  }
  out.file = {std::string(name), token_.place};
  next();
}

void Parser::face_clause(const Token& keyword, ObjectSyntax& out) {
  FaceSyntax face{static_cast<std::uint32_t>(out.corners.size()), 0, keyword.place};
  while (at(Token::Kind::number)) {
    std::uint32_t index = 0;
    if (!whole_number("face", 0xfffffffe, index)) { continue; }
    out.corners.push_back(index);
    ++face.count;
  }
  if (face.count < 3) { return error(token_.place, "'face' takes at least 3 vertex numbers, found " + std::to_string(face.count)); }
  out.faces.push_back(face);
}

// Parses a clause that the grammar table gives to this kind of object.
void Parser::own_clause(const Token& keyword, Form form, ObjectSyntax& out) {
  Given given{keyword.text, form == Form::vector ? keyword.place : token_.place, {}};
  if (form == Form::face) { return face_clause(keyword, out); }
  if (form == Form::vertex) {
    glm::dvec3 position{0.0};
    digits_ = 0;
    if (vector(keyword, position)) { out.vertices.push_back({position, keyword.place, digits_}); }
    return;
  }
  const std::size_t count = form == Form::vector ? 3 : form == Form::pair ? 2 : 1;
  if (!numbers(keyword, std::span(given.numbers).first(count))) { return; }
  if (form == Form::length && !(given.numbers[0] >= 1.0 / max_number)) {
    return error(given.place, "expected a " + std::string(keyword.text) + " above 0, at least " + formatted("%g", 1.0 / max_number) +
                                  ", found " + shortest(given.numbers[0]));
  }
  out.given.push_back(given);
}

void Parser::object_clause(const Token& keyword, ObjectSyntax& out) {
  const std::string_view word = keyword.text;
  if (placement_clause(keyword, out.placement)) { return; }
  for (const Clause& clause : out.kind->clauses) {
    if (clause.word == word) { return own_clause(keyword, clause.form, out); }
  }
  if (word == "file") {
    file_clause(out);
  } else if (word == "two-sided") {
    out.two_sided = keyword.place;
  } else if (word == "sheet") {
    sheet_clause(out);
  } else if (word == "inside") {
    out.inside = keyword.place;
  } else {
    Name material;
    if (!name("material", material)) { return skip_rest(); }
    out.material = std::move(material);
  }
}

}  // namespace apps::scene_file
