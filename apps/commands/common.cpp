// SPDX-License-Identifier: MIT
#include "apps/commands/common.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "apps/files.hpp"
#include "apps/mesh_file.hpp"
#include "apps/output_paths.hpp"
#include "apps/text.hpp"

namespace apps {

void complain(const std::string& sentence) { std::fprintf(stderr, "halflight: %s\n", sentence.c_str()); }

void complain_of(const std::string& name, const std::vector<std::string>& sentences) {
  const std::size_t shown = std::min(max_errors, sentences.size());
  for (std::size_t i = 0; i < shown; ++i) { std::fprintf(stderr, "%s: error: %s\n", name.c_str(), sentences[i].c_str()); }
  if (shown < sentences.size()) { std::fprintf(stderr, "%s: ... and %zu more\n", name.c_str(), sentences.size() - shown); }
}

std::string shown(const std::string& input) { return input.empty() ? "''" : input == "-" ? "standard input" : input; }

std::optional<std::string> load_text(const std::string& path, ExitCode& code) {
  std::string fault;
  auto text = read_text(path, fault);
  if (!text) {
    complain(shown(path) + " " + fault);
    code = ExitCode::failure;
  }
  return text;
}

namespace {

// Files that another one names lie beside it, or where their whole path says. All their bytes are collected in `read`.
SideFile beside(const std::string& path, std::string& read) {
  return [folder = std::filesystem::path(path).parent_path(), &read](const std::string& name, std::string& fault) {
    auto bytes = read_text((folder / name).string(), fault);
    if (bytes) { read += *bytes; }
    return bytes;
  };
}

std::optional<SceneFile> load_model(const std::string& path, const std::string& bytes, const ModelFormat& format,
                                    const ModelOptions& options, ExitCode& code) {
  std::string read;
  ModelResult result = format.read(bytes, beside(path, read));
  code = ExitCode::invalid_input;
  if (!result.model) {
    const FileGuess guess = guess_kind(bytes);
    const auto sentence = guess.kind == FileKind::empty ? wrong_kind(shown(path), bytes, FileKind::scene) : std::nullopt;
    sentence ? complain(*sentence) : static_cast<void>(std::fputs(to_text(result, shown(path)).c_str(), stderr));
    return std::nullopt;
  }
  std::vector<std::string> faults;
  auto file = to_scene(std::move(*result.model), format.up, options, faults);
  if (file) {
    file->beside = std::move(read);
    code = ExitCode::ok;
  } else {
    complain_of(shown(path), faults);
  }
  return file;
}

}  // namespace

std::optional<SceneFile> load_scene(const std::string& path, ExitCode& code, const ModelOptions& options) {
  const auto text = load_text(path, code);
  return text ? load_scene(path, *text, code, options) : std::nullopt;
}

std::optional<SceneFile> load_scene(const std::string& path, const std::string& text, ExitCode& code, const ModelOptions& options) {
  if (const ModelFormat* const format = model_format(path, text)) { return load_model(path, text, *format, options, code); }
  if (!options.lamps.empty()) {
    complain("--lamp is about files of other programs; in a .scene the material says it: material " + options.lamps[0].material +
             " reflectance 0.5 emission " + shortest(options.lamps[0].exitance));
    code = ExitCode::usage;
    return std::nullopt;
  }
  std::string read;
  SceneResult result = parse_scene(text, beside(path, read));
  if (!result.file) {
    const auto sentence = wrong_kind(shown(path), text, FileKind::scene);
    sentence ? complain(*sentence) : static_cast<void>(std::fputs(to_text(result, shown(path)).c_str(), stderr));
    code = ExitCode::invalid_input;
    return std::nullopt;
  }
  result.file->beside = std::move(read);
  return std::move(result.file);
}

ExitCode check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
  const auto fault = check_output_paths(outputs, inputs);
  if (!fault) { return ExitCode::ok; }
  complain(fault->sentence);
  return fault->usage ? ExitCode::usage : ExitCode::failure;
}

ExitCode check_mesh_output(const std::string& output, std::vector<std::string> others, const std::string& input) {
  if (!output.empty() && !mesh_format(output)) {
    complain("--output " + output + ": expected a name that ends with " + mesh_endings());
    return ExitCode::usage;
  }
  others.insert(others.begin(), output);
  return check_outputs(others, {input});
}

bool save(const std::string& path, const std::string& bytes) {
  const auto fault = write_file(path, bytes);
  if (fault) { complain(*fault); }
  return !fault;
}

bool print(const std::string& text, const std::vector<std::string>& outputs) {
  const bool taken = std::any_of(outputs.begin(), outputs.end(), is_standard_output);
  std::FILE* const stream = taken ? stderr : stdout;
  errno = 0;
  if (std::fputs(text.c_str(), stream) >= 0 && std::fflush(stream) == 0 && std::ferror(stream) == 0) { return true; }
  if (errno == EPIPE) { return true; }
  complain(std::string("cannot write to standard output: ") + std::strerror(errno));
  return false;
}

}  // namespace apps
