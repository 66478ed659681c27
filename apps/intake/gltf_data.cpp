// SPDX-License-Identifier: MIT
#include "apps/intake/gltf_data.hpp"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <utility>

#include "apps/bytes.hpp"
#include "apps/intake/meshopt.hpp"
#include "apps/mesh_file/reading.hpp"

namespace apps::intake {
namespace {

constexpr std::size_t most_zeros = 1'000'000;         // of an accessor without data
constexpr std::size_t most_unpacked = 2'000'000'000;  // bytes of all compressed views

// Decodes "data:image/png;base64,AAAA"; nothing if the URI has another form.
std::optional<std::string> data_of(std::string_view uri) {
  const std::size_t comma = uri.find(";base64,");
  return comma == uri.npos ? std::nullopt : from_base64(uri.substr(comma + 8));
}

struct ComponentType {
  std::size_t size = 0;
  bool is_signed = false, is_float = false;
  [[nodiscard]] double largest() const { return std::ldexp(1.0, static_cast<int>(8 * size) - (is_signed ? 1 : 0)) - 1.0; }  // integer
};

std::optional<ComponentType> component_type(const JsonValue& value) {
  static constexpr std::array<ComponentType, 7> types{
      // Index 0 is the type 5120.
      {{1, true, false}, {1, false, false}, {2, true, false}, {2, false, false}, {}, {4, false, false}, {4, true, true}}};
  constexpr std::size_t first = 5120;
  const std::size_t given = value.index().value_or(0);
  return given >= first && given - first < types.size() && types[given - first].size > 0 ? std::optional(types[given - first])
                                                                                         : std::nullopt;
}

double number_at(std::string_view bytes, std::size_t at, const ComponentType& type, bool normalized) {
  const auto bits = static_cast<std::uint32_t>(bits_at(bytes, at, type.size));
  if (type.is_float) { return static_cast<double>(std::bit_cast<float>(bits)); }
  const unsigned width = static_cast<unsigned>(8 * type.size);
  double value = bits;
  if (type.is_signed && (bits >> (width - 1) & 1U) != 0) { value -= std::ldexp(1.0, static_cast<int>(width)); }
  return normalized ? value / type.largest() : value;
}

}  // namespace

std::optional<std::string> file_of_uri(std::string_view uri) {
  if (uri.empty() || uri.find(':') != std::string_view::npos) { return std::nullopt; }
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned code = 0;
    const std::string_view digits = uri.substr(i + 1 < uri.size() ? i + 1 : uri.size(), 2);
    if (uri[i] == '%' && digits.size() == 2 && std::from_chars(digits.data(), digits.data() + 2, code, 16).ptr == digits.data() + 2 &&
        code != 0) {
      name += static_cast<char>(static_cast<unsigned char>(code));
      i += 2;
    } else {
      name += uri[i];
    }
  }
  return name;
}

std::optional<std::string_view> GltfData::buffer(std::size_t index, std::string& fault) {
  const JsonValue& buffers = root_["buffers"];
  const std::string who = "buffer " + std::to_string(index);
  const JsonValue& uri = buffers[index]["uri"];
  if (!uri) {
    if (index == 0 && binary_ && !buffers.items().empty()) { return binary_; }
    fault = index < buffers.items().size() ? who + " has no 'uri', and there is no binary chunk" : "there is no " + who;
    return std::nullopt;
  }
  loaded_.resize(buffers.items().size());
  if (!loaded_[index]) {
    const std::string_view text = uri.string();
    if (text.starts_with("data:")) {
      loaded_[index] = data_of(text);
      fault = "the data of " + who + " are not base64";
    } else if (const auto name = file_of_uri(text)) {
      std::string reason;
      loaded_[index] = there_or_beside(*name, side_file_, reason);
      fault = "the file '" + *name + "' " + reason;
    } else {
      fault = who + " is not in this file nor beside it";
    }
  }
  if (!loaded_[index]) { return std::nullopt; }
  fault.clear();
  return std::string_view(*loaded_[index]);
}

std::optional<std::string_view> GltfData::view(const JsonValue& index, std::string& fault) {
  const JsonValue& view = root_["bufferViews"][index.index().value_or(nowhere)];
  const auto part = [&](const JsonValue& place) -> std::optional<std::string_view> {
    const auto bytes = buffer(place["buffer"].index().value_or(nowhere), fault);
    const std::size_t begin = place["byteOffset"].index().value_or(0), length = place["byteLength"].index().value_or(0);
    if (!bytes) { return std::nullopt; }
    if (begin <= bytes->size() && length <= bytes->size() - begin) { return bytes->substr(begin, length); }
    fault = "its view reaches beyond its buffer";
    return std::nullopt;
  };
  const JsonValue& extensions = view["extensions"];
  const JsonValue& packed = extensions[extensions["EXT_meshopt_compression"] ? "EXT_meshopt_compression" : "KHR_meshopt_compression"];
  if (!packed) { return part(view); }
  const auto [found, is_new] = views_.try_emplace(*index.index());
  if (is_new) {
    const auto bytes = part(packed);
    const auto number = [&](std::string_view name) { return packed[name].index().value_or(0); };
    const MeshoptView described{packed["mode"].string(), packed["filter"].string(), number("count"), number("byteStride")};
    unpacked_bytes_ += described.count * described.stride;  // each below 2^32
    const bool fits = unpacked_bytes_ <= most_unpacked;
    if (!fits) { fault = "the compressed views have more than " + std::to_string(most_unpacked) + " bytes"; }
    auto unpacked = bytes && fits ? unpack_meshopt(*bytes, described, fault) : std::nullopt;
    if (!unpacked) {
      unpacked_bytes_ -= described.count * described.stride;
      views_.erase(found);
      return std::nullopt;
    }
    found->second = std::move(*unpacked);
  }
  return found->second;
}

std::optional<bool> GltfData::unpack(const JsonValue& primitive, std::string& fault) {
  unpacked_.clear();
  const JsonValue& packed = primitive["extensions"]["KHR_draco_mesh_compression"];
  if (!packed) { return false; }
  const auto accessor = [&](const JsonValue& index) -> const JsonValue& { return root_["accessors"][index.index().value_or(nowhere)]; };
  std::string missing;
  const JsonValue& positions = accessor(primitive["attributes"]["POSITION"]);
  if (positions["bufferView"] && view(positions["bufferView"], missing)) { return false; }  // for readers without the extension
  const auto [found, is_new] = meshes_.try_emplace(packed["bufferView"].index().value_or(nowhere));
  if (is_new) {
    const auto bytes = view(packed["bufferView"], fault);
    auto mesh = bytes ? draco::read_mesh(*bytes, fault) : std::nullopt;
    if (!mesh) {
      meshes_.erase(found);
      return std::nullopt;
    }
    found->second = std::move(*mesh);
  }
  const draco::Mesh& mesh = found->second;
  const auto give = [&](const JsonValue& index, std::size_t components, std::vector<double> numbers) {
    if (const auto i = index.index()) { unpacked_[*i] = {components, std::move(numbers)}; }
  };
  give(primitive["indices"], 1, {mesh.corners.begin(), mesh.corners.end()});
  const JsonValue& ids = packed["attributes"];
  for (std::size_t i = 0; i < ids.keys().size(); ++i) {
    const JsonValue& index = primitive["attributes"][ids.keys()[i]];
    for (const draco::Attribute& attribute : mesh.attributes) {
      if (ids.items()[i].index() != attribute.unique_id) { continue; }
      std::vector<double> numbers = attribute.values;
      const auto type = component_type(accessor(index)["componentType"]);
      if (attribute.integers && accessor(index)["normalized"].boolean() && type) {
        for (double& number : numbers) { number /= type->largest(); }
      }
      give(index, attribute.components, std::move(numbers));
    }
  }
  if (unpacked_.contains(primitive["attributes"]["POSITION"].index().value_or(nowhere))) { return true; }
  fault = "the compressed mesh has no positions";
  return std::nullopt;
}

std::optional<std::string> GltfData::picture(std::size_t image) {
  const JsonValue& given = root_["images"][image];
  std::string fault;
  if (given["bufferView"]) {
    const auto bytes = view(given["bufferView"], fault);
    return bytes ? std::optional<std::string>(*bytes) : std::nullopt;
  }
  const std::string_view uri = given["uri"].string();
  if (uri.starts_with("data:")) { return data_of(uri); }
  const auto name = file_of_uri(uri);
  return name && side_file_ ? there_or_beside(*name, side_file_, fault) : std::nullopt;
}

bool GltfData::elements(const Elements& at, std::vector<double>& out, std::string& fault) {
  const auto fail = [&](std::string sentence) {
    fault = std::move(sentence);
    return false;
  };
  const auto or_zero = [](const JsonValue& value) { return value.index().value_or(0); };
  const auto type = component_type(at.component_type);
  if (!type) { return fail(at.who + ": the type of numbers is missing"); }
  const JsonValue& described = root_["bufferViews"][at.place["bufferView"].index().value_or(nowhere)];
  if (!described) { return fail(at.who + " names a view that does not exist"); }
  const auto bytes = view(at.place["bufferView"], fault);
  if (!bytes) { return fail(at.who + ": " + fault); }
  const std::size_t element = type->size * at.components, first = or_zero(at.place["byteOffset"]);
  const std::size_t stride = described["byteStride"] ? or_zero(described["byteStride"]) : element;
  // All numbers are below 2^32, so nothing overflows.
  if (at.count > 0 && (stride < element || first + (at.count - 1) * stride + element > bytes->size())) {
    return fail(at.who + " reaches beyond its view");
  }
  out.reserve(at.count * at.components);
  for (std::size_t i = 0; i < at.count; ++i) {
    const std::size_t number = first + i * stride;
    for (std::size_t k = 0; k < at.components; ++k) { out.push_back(number_at(*bytes, number + k * type->size, *type, at.normalized)); }
  }
  return true;
}

bool GltfData::substitute(const JsonValue& sparse, Elements at, std::vector<double>& numbers, std::string& fault) {
  const std::string who = at.who;
  const JsonValue &indices = sparse["indices"], &values = sparse["values"];
  const std::size_t elements_before = at.count;
  at.count = sparse["count"].index().value_or(0);
  if (at.count > elements_before) {
    fault = who + " substitutes more elements than it has";
    return false;
  }
  std::vector<double> index, value;
  if (!elements({who + ", its indices", indices, indices["componentType"], at.count, 1, false}, index, fault) ||
      !elements({who + ", its values", values, at.component_type, at.count, at.components, at.normalized}, value, fault)) {
    return false;
  }
  for (std::size_t i = 0; i < at.count; ++i) {
    if (!(index[i] >= 0.0 && index[i] < static_cast<double>(elements_before))) {
      fault = who + " substitutes an element that it does not have";
      return false;
    }
    for (std::size_t k = 0; k < at.components; ++k) {
      numbers[static_cast<std::size_t>(index[i]) * at.components + k] = value[i * at.components + k];
    }
  }
  return true;
}

std::optional<std::vector<double>> GltfData::numbers(const JsonValue& accessor_index, std::size_t components, std::string& fault) {
  const auto fail = [&](std::string sentence) {
    fault = std::move(sentence);
    return std::nullopt;
  };
  const auto index = accessor_index.index();
  const JsonValue& accessor = root_["accessors"][index.value_or(nowhere)];
  if (!accessor) { return fail("there is no such accessor"); }
  const std::string who = "accessor " + std::to_string(*index);
  constexpr std::array<std::string_view, 4> names{"SCALAR", "VEC2", "VEC3", "VEC4"};
  const std::string_view name = components == 16 ? "MAT4" : names[components - 1];
  if (!component_type(accessor["componentType"]) || accessor["type"].string() != name) {
    return fail(who + " is not of the type " + std::string(name) + " that stands here");
  }
  if (const auto unpacked = unpacked_.find(*index); unpacked != unpacked_.end()) {
    if (unpacked->second.components != components) { return fail(who + " has another type than its compressed numbers"); }
    return unpacked->second.numbers;
  }
  const auto count = accessor["count"].index();
  if (!count) { return fail(who + " has no count"); }
  const Elements all{who, accessor, accessor["componentType"], *count, components, accessor["normalized"].boolean()};
  std::vector<double> result;
  if (accessor["bufferView"]) {
    if (!elements(all, result, fault)) { return std::nullopt; }
  } else if (*count > most_zeros) {
    return fail(who + " has no bytes");
  } else {
    result.resize(*count * components, 0.0);
  }
  if (accessor["sparse"] && !substitute(accessor["sparse"], all, result, fault)) { return std::nullopt; }
  return result;
}

}  // namespace apps::intake
