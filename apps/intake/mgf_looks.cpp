// SPDX-License-Identifier: MIT
#include "apps/intake/mgf.hpp"

#include <algorithm>
#include <vector>

#include "apps/intake/mgf_color.hpp"

namespace apps::intake::mgf {
namespace {

// The word as a number from 0 on; otherwise reports an error.
double amount(const Line& line, std::size_t word, Errors& errors) {
  const double value = number(line, word, errors);
  if (value < 0.0) { errors.add(line.place(word), "expected a number from 0 on, found " + mesh_file::shown(line.word(word))); }
  return value;
}

}  // namespace

bool Looks::take(const Line& line, Errors& errors) {
  static const std::map<std::string_view, void (Looks::*)(const Line&, Errors&)> entities{
      {"c", &Looks::choose_color}, {"cxy", &Looks::chromaticity},  {"cct", &Looks::temperature}, {"cspec", &Looks::spectrum},
      {"cmix", &Looks::mixture},   {"m", &Looks::choose_material}, {"sides", &Looks::sides},     {"rd", &Looks::reflectance},
      {"ed", &Looks::emission},    {"td", &Looks::transmittance},  {"rs", &Looks::mirror},       {"ts", &Looks::transmittance}};
  const auto found = entities.find(line.words[0]);
  if (found == entities.end()) { return false; }
  (this->*found->second)(line, errors);
  return true;
}

std::uint32_t Looks::material() {
  Material& current = materials_.current();
  if (!current.number) {
    current.number = static_cast<std::uint32_t>(model_.materials.size());
    const double opacity = 1.0 - std::min(1.0, current.diffused + current.transmitted);
    if (!radiosity::is_black(current.mirror) && !radiosity::is_black(current.reflectance)) {
      notes_.add("what materials reflect as mirrors is left out", "in " + mesh_file::shown(current.name));
    }
    model_.materials.push_back({current.name, current.reflectance, current.emission, current.two_sided, opacity, current.mirror});
  }
  return *current.number;
}

void Looks::chromaticity(const Line& line, Errors& errors) {
  constexpr double least_y = 0.004;  // the smallest y of spectral colours is 0.0048, at 410 nm
  Chroma given{number(line, 1, errors), number(line, 2, errors)};
  if (!(given.x >= 0.0 && given.y >= 0.0 && given.x + given.y <= 1.0)) {
    return errors.add(line.place(1), "expected a chromaticity, x and y from 0 on with a sum of at most 1");
  }
  if (given.y < least_y) { notes_.add("a chromaticity with y below .004 is none that light has: taken with y = .004", at(line)); }
  given.y = std::max(given.y, least_y);
  colors_.current() = given;
}

void Looks::temperature(const Line& line, Errors& errors) {
  const double kelvin = number(line, 1, errors);
  if (!(kelvin >= 100.0 && kelvin <= 1e6)) { return errors.add(line.place(1), "expected a temperature from 100 to 1000000 K"); }
  set_color(xyz_of_temperature(kelvin));
}

void Looks::spectrum(const Line& line, Errors& errors) {
  const double first = number(line, 1, errors), last = number(line, 2, errors);
  if (!(first < last)) { return errors.add(line.place(1), "expected two wavelengths in nm, the shorter one first"); }
  std::vector<double> values;
  for (std::size_t i = 3; i < line.words.size(); ++i) { values.push_back(number(line, i, errors)); }
  if (values.size() < 2) { return errors.add(line.place(line.words.size()), "a spectrum has at least two values"); }
  const glm::dvec3 xyz = xyz_of_samples(values, first, last);
  const double sum = xyz.x + xyz.y + xyz.z;  // values may be negative: a spectrum may be a component of others
  if (!(sum > 0.0 && xyz.y > 1e-6 * sum)) { return errors.add(line.place(3), "nothing of this spectrum is seen"); }
  set_color(xyz);
}

// Mixes colours by their weights, which are shares of the luminance.
void Looks::mixture(const Line& line, Errors& errors) {
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

void Looks::choose_material(const Line& line, Errors& errors) {
  materials_.choose(line, errors);
  if (line.words.size() != 2) { materials_.current().number.reset(); }
  if (line.word(2) == "=") { materials_.current().name = line.words[1]; }
}

void Looks::reflectance(const Line& line, Errors& errors) {
  const double share = amount(line, 1, errors);
  if (share >= 0.0) { changed().reflectance = share * color_of(colors_.current().x, colors_.current().y); }
}

void Looks::emission(const Line& line, Errors& errors) {
  const double exitance = amount(line, 1, errors);
  if (exitance < 0.0) { return; }
  changed().emission = exitance / white_efficacy * color_of(colors_.current().x, colors_.current().y);
  if (exitance > 0.0) { notes_.add("ed is in lm/m2: 179 lm are 1 W of white light", at(line)); }
}

void Looks::mirror(const Line& line, Errors& errors) {
  const double share = amount(line, 1, errors);
  if (share >= 0.0) { changed().mirror = share * color_of(colors_.current().x, colors_.current().y); }
}

void Looks::transmittance(const Line& line, Errors& errors) {
  const double share = amount(line, 1, errors);
  if (share < 0.0) { return; }
  (line.words[0] == "td" ? changed().diffused : changed().transmitted) = share;
  if (share > 0.0 && share <= 1.0 - least_opacity) { notes_.add("materials that let light through are taken as opaque", at(line)); }
}

void Looks::set_color(const glm::dvec3& xyz) {
  const double sum = xyz.x + xyz.y + xyz.z;
  colors_.current() = {xyz.x / sum, xyz.y / sum};
}

Material& Looks::changed() {
  materials_.current().number.reset();  // surfaces that already use it keep its previous state
  return materials_.current();
}

}  // namespace apps::intake::mgf
