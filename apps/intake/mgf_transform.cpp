// SPDX-License-Identifier: MIT
#include "apps/intake/mgf_transform.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "apps/mesh_file/reading.hpp"
#include "apps/scene_file.hpp"

namespace apps::intake::mgf {
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

}  // namespace apps::intake::mgf
