// SPDX-License-Identifier: MIT
// Reads the formats of polygon meshes (mesh_file.hpp) as scenes: PLY and OFF contain geometry only, OBJ has groups, and its materials are
// in separate files.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include <brep/builder_input.hpp>

#include <radiosity/camera/tone.hpp>

#include "apps/file_kind.hpp"
#include "apps/intake/model.hpp"
#include "apps/intake/polygon_colors.hpp"
#include "apps/intake/texture.hpp"
#include "apps/mesh_file.hpp"
#include "apps/mesh_file/reading.hpp"
#include "apps/words.hpp"

namespace apps::intake {
namespace {

using mesh_file::Lines;

// Parses the three numbers of "Kd r g b"; a single one counts for all three, what follows the third not at all. Nothing for a spectral
// curve, CIE XYZ or text.
std::optional<radiosity::Color> color(const Lines& lines) {
  radiosity::Color c{0.0};
  const std::size_t given = lines.words().size() - 1;
  if (given != 1 && given < 3) { return std::nullopt; }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto value = mesh_file::to_number(lines.words()[given == 1 ? 1 : i + 1]);
    if (!value || *value < 0.0) { return std::nullopt; }
    c[static_cast<int>(i)] = *value;
  }
  return c;
}

// The name of the picture after map_Kd, which may contain blanks and be preceded by options: -o, -s and -t with up to three numbers, -mm
// with two, others with one word each.
std::string picture_of(const Lines& lines) {
  const auto& words = lines.words();
  std::size_t first = 1;
  while (first + 1 < words.size() && words[first].starts_with('-')) {
    const std::string_view option = words[first++];
    const bool vector = option == "-o" || option == "-s" || option == "-t";
    const std::size_t most = vector ? 3 : option == "-mm" ? 2 : 1;
    for (std::size_t i = 0; i < most && first + 1 < words.size() && (!vector || mesh_file::to_number(words[first])); ++i) { ++first; }
  }
  std::string name;
  for (std::size_t i = first; i < words.size(); ++i) { name.append(i > first ? " " : "").append(words[i]); }
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

// Reads MTL, the materials of OBJ files, into the materials with the same names: Kd is the reflectance, Ks that as by a mirror; Ke, the
// emitted radiance, becomes the exitance pi Ke. Nothing in such a file is an error: whatever cannot be read is noted, and the material
// remains as it is.
class ObjMaterials {
 public:
  ObjMaterials(std::vector<ModelMaterial>& materials, PolygonColors& colors, Notes& notes, const SideFile& side_file)
      : materials_(materials), colors_(colors), notes_(notes), side_file_(side_file), defined_(materials.size(), false) {
    for (std::size_t i = 0; i < materials.size(); ++i) { index_.emplace(materials[i].name, i); }
  }

  void read(const std::string& library) {
    std::string fault;
    const auto text = there_or_beside(library, side_file_, fault);
    if (!text) { return notes_.add("the materials in " + mesh_file::shown(library) + " are not known: it " + fault); }
    ModelMaterial* material = nullptr;  // null: one that no face has
    Pictured pictured;
    std::map<ModelMaterial*, Opacity> opacities;
    std::map<ModelMaterial*, Glow> glows;
    ++read_;
    Lines lines(*text, true, true);
    while (lines.next()) {
      const std::string_view word = lines.words()[0];
      const std::string place = "at " + library + ":" + std::to_string(lines.line());
      const bool bare = lines.words().size() < 2;
      if (same_letters(word, "newmtl")) {
        const auto found = bare ? index_.end() : index_.find(lines.rest());
        material = found == index_.end() ? nullptr : &materials_[found->second];
        if (material != nullptr) { defined_[found->second] = true; }
      } else if (bare || material == nullptr) {
        continue;
      } else if (same_letters(word, "kd") || same_letters(word, "ks") || same_letters(word, "ke") || same_letters(word, "ka")) {
        set_color(*material, lines, place, glows[material]);
      } else if (same_letters(word, "map_kd") || same_letters(word, "map_ke")) {
        set_picture(*material, lines, place, pictured);
      } else if (same_letters(word, "d") || same_letters(word, "tr") || same_letters(word, "map_d")) {
        opacities[material].add(lines, place);
      }
    }
    leave_to_pictures(pictured);
    for (const auto& [of, opacity] : opacities) { set_opacity(*of, opacity); }
    for (const auto& [of, glow] : glows) { set_glow(*of, glow); }
  }

  // To be called after all libraries.
  void note_undefined() {
    for (std::size_t m = 0; read_ > 0 && m < materials_.size(); ++m) {
      if (!defined_[m] && materials_[m].name != "default") {
        notes_.add("materials are not defined in the libraries of the file", mesh_file::shown(materials_[m].name));
      }
    }
  }

 private:
  // Materials with a picture for Kd that can be read, or that cannot, and likewise for Ke. They are looked at in the end, because map_Kd
  // and Kd may come in either order.
  struct Pictured {
    Pictures<std::string> pictures;
    std::vector<ModelMaterial*> painted, unseen, glowing, dark;
  };

  // What a library says about the light that passes through a material. d is the opacity; Tr is one minus the opacity but, where both are
  // given, for some programs the opacity itself.
  struct Opacity {
    std::optional<double> d, tr;
    bool picture = false;  // map_d: says where the material is opaque
    std::string place;     // of the first word

    void add(const Lines& lines, const std::string& at) {
      if (place.empty()) { place = at; }
      const std::string_view word = lines.words()[0];
      if (same_letters(word, "map_d")) {
        picture = true;
      } else if (const auto value = mesh_file::to_number(lines.words().back())) {  // after options such as -halo
        (same_letters(word, "d") ? d : tr) = std::clamp(*value, 0.0, 1.0);
      }
    }
  };

  // What a library says about the light of a material. Files from before Ke write it as Ka, which otherwise is a share of light, at most 1.
  struct Glow {
    bool told = false;  // by Ke
    radiosity::Color ambient{0.0};
    std::string place;  // of Ka
  };

  void set_glow(ModelMaterial& material, const Glow& given) {
    const bool shares = radiosity::brightest(material.reflectance.value_or(radiosity::Color(0.0))) <= 1.0;
    if (given.told || !shares || !(radiosity::brightest(given.ambient) > 1.0)) { return; }
    material.emission = std::numbers::pi * given.ambient;
    notes_.add("Ka above 1 is no share of light: taken as Ke, as what shines", given.place);
  }

  void set_opacity(ModelMaterial& material, const Opacity& given) {
    material.opacity = given.picture ? 1.0 : given.d.value_or(1.0 - given.tr.value_or(0.0));
    if (given.picture || (material.opacity < 1.0 && material.opacity >= least_opacity)) {
      notes_.add("materials that let light through are taken as opaque", given.place);
    }
  }

  void set_color(ModelMaterial& material, const Lines& lines, const std::string& place, Glow& glow) {
    const std::string_view word = lines.words()[0];
    const auto value = color(lines);
    if (!value) {
      notes_.add("expected one or three numbers from 0 on after " + std::string(word) + ": passed over", place);
    } else if (same_letters(word, "kd")) {
      material.reflectance = *value;
    } else if (same_letters(word, "ks")) {
      material.mirror = mirror_of_highlight(*value);
    } else if (same_letters(word, "ka")) {
      glow.ambient = *value;
      glow.place = place;
    } else {
      material.emission = std::numbers::pi * *value;
      glow.told = true;
    }
  }

  void set_picture(ModelMaterial& material, const Lines& lines, const std::string& place, Pictured& pictured) {
    const std::string name = picture_of(lines);
    const bool reflects = same_letters(lines.words()[0], "map_kd");
    const std::shared_ptr<const Picture>& picture = pictured.pictures.of(name, [&] {
      std::string fault;
      const auto bytes = there_or_beside(name, side_file_, fault);
      if (!bytes) { notes_.add("a picture on surfaces is not there: " + mesh_file::shown(name) + " " + fault, place); }
      return bytes ? Picture::read(*bytes) : nullptr;
    });
    if (picture) {
      (reflects ? pictured.painted : pictured.glowing).push_back(&material);
      return colors_.picture(static_cast<std::uint32_t>(&material - materials_.data()),
                             reflects ? PolygonColors::Of::reflectance : PolygonColors::Of::emission, picture, place);
    }
    (reflects ? pictured.unseen : pictured.dark).push_back(&material);
    notes_.add(reflects ? "textures are not read: Kd stands for the picture"
                        : "surfaces whose emissive picture is not read do not shine (--lamp MATERIAL)",
               place);
  }

  // Programs that have no factor write a colour of 0 beside a picture.
  static void leave_to_pictures(const Pictured& pictured) {
    for (ModelMaterial* const of : pictured.unseen) {
      if (of->reflectance && radiosity::is_black(*of->reflectance)) { of->reflectance.reset(); }
    }
    for (ModelMaterial* const of : pictured.painted) {
      if (radiosity::is_black(of->reflectance.value_or(radiosity::Color(0.0)))) { of->reflectance = radiosity::Color(1.0); }
    }
    // Most of such a picture is usually black.
    for (ModelMaterial* const of : pictured.dark) { of->emission = radiosity::Color(0.0); }
    for (ModelMaterial* const of : pictured.glowing) {
      if (radiosity::is_black(of->emission)) { of->emission = radiosity::Color(std::numbers::pi); }
    }
  }

  std::vector<ModelMaterial>& materials_;
  PolygonColors& colors_;
  Notes& notes_;
  const SideFile& side_file_;
  std::unordered_map<std::string, std::size_t> index_;
  std::vector<bool> defined_;  // by material
  std::size_t read_ = 0;       // libraries
};

// The face's own colour, or the mean of its vertex colours, in linear light; nothing if one of these is unknown.
std::optional<radiosity::Color> color_of(const Mesh& mesh, std::uint32_t face) {
  radiosity::Color sum(0.0);
  const auto add = [&](const std::vector<glm::vec3>& list, std::size_t i) {
    if (i >= list.size() || std::isnan(list[i].x)) { return false; }
    for (int k = 0; k < 3; ++k) { sum[k] += radiosity::srgb_decode(static_cast<double>(list[i][k])); }
    return true;
  };
  if (add(mesh.face_color, face)) { return sum; }
  const auto corners = mesh.builder.corners(face);
  for (const std::uint32_t v : corners) {
    if (!add(mesh.vertex_color, v)) { return std::nullopt; }
  }
  return sum / static_cast<double>(corners.size());
}

ModelResult read(std::string_view bytes, const MeshFormat& format, const SideFile& side_file) {
  MeshResult result = read_mesh(bytes, format);
  if (!result.mesh) { return {std::move(result), std::nullopt}; }
  Mesh& mesh = *result.mesh;
  Model model;
  model.tells_sides = false;
  Notes notes;
  const brep::Builder& builder = mesh.builder;
  for (std::uint32_t v = 0; v < builder.vertex_count(); ++v) { model.positions.push_back(builder.position(v)); }
  for (const std::string& name : mesh.materials) { model.materials.push_back({name, {}, radiosity::Color(0.0), false}); }
  if (model.materials.empty()) { model.materials.push_back({"default", {}, radiosity::Color(0.0), false}); }
  model.groups = mesh.groups;
  if (model.groups.empty()) { model.groups.emplace_back("mesh"); }
  const auto of = [](const std::vector<std::uint32_t>& list, std::uint32_t f) { return f < list.size() ? list[f] : 0; };
  PolygonColors colors;
  std::vector<glm::dvec2> places;
  for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
    model.polygon(builder.corners(f), of(mesh.face_material, f), of(mesh.face_group, f), of(mesh.face_line, f));
    if (const auto color = color_of(mesh, f)) { colors.tint(model, *color); }
    if (model.corners.size() > mesh.corner_place.size()) { continue; }
    places.clear();
    for (std::size_t c = model.first_corner[f]; c < model.corners.size(); ++c) {
      places.emplace_back(mesh.corner_place[c].x, 1.0F - mesh.corner_place[c].y);
    }
    colors.lies_at(model, places);
  }
  ObjMaterials materials(model.materials, colors, notes, side_file);
  for (const std::string& library : mesh.libraries) { materials.read(library); }
  materials.note_undefined();
  colors.apply(model, notes);
  model.notes = std::move(mesh.notes);
  for (std::string& note : notes.take()) { model.notes.push_back(std::move(note)); }
  return {std::move(result), std::move(model)};
}

template <const MeshFormat* format>
ModelResult read_format(std::string_view bytes, const SideFile& side_file) {
  return read(bytes, *format, side_file);
}

template <const MeshFormat* format>
bool begins_format(std::string_view bytes) {
  return guess_kind(bytes).format == format;
}

}  // namespace

constinit const ModelFormat obj{".obj", "OBJ", UpAxis::y, begins_format<&mesh_file::obj_format>, read_format<&mesh_file::obj_format>};
constinit const ModelFormat ply{".ply", "PLY", UpAxis::z, begins_format<&mesh_file::ply_format>, read_format<&mesh_file::ply_format>};
constinit const ModelFormat off{".off", "OFF", UpAxis::z, begins_format<&mesh_file::off_format>, read_format<&mesh_file::off_format>};

}  // namespace apps::intake
