// SPDX-License-Identifier: MIT
#include "apps/commands/common.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "apps/files.hpp"
#include "apps/intake/added_light.hpp"
#include "apps/mesh_file.hpp"
#include "apps/text.hpp"
#include "apps/words.hpp"

namespace apps {

void complain(const std::string& sentence) { std::fprintf(stderr, "halflight: %s\n", sentence.c_str()); }
ExitCode complain(const std::string& sentence, ExitCode code) {
  complain(sentence);
  return code;
}

void complain_of(const std::string& name, const std::vector<std::string>& sentences) {
  const std::size_t shown = std::min(max_errors, sentences.size());
  for (std::size_t i = 0; i < shown; ++i) { std::fprintf(stderr, "%s: error: %s\n", name.c_str(), sentences[i].c_str()); }
  if (shown < sentences.size()) { std::fprintf(stderr, "%s: ... and %zu more\n", name.c_str(), sentences.size() - shown); }
}

std::string shown(const std::string& input) { return input.empty() ? "''" : input == "-" ? "standard input" : input; }

std::optional<std::string> load_text(const std::string& path, ExitCode& code) {
  std::string fault;
  auto text = read_text(path, fault);
  if (!text) { code = complain(shown(path) + " " + fault, ExitCode::failure); }
  return text;
}

namespace {

// The path; or, if there is no such file, that of the only file in its folder whose name differs only in upper and lower case, because many
// files come from systems on which this makes no difference.
std::string existing(const std::filesystem::path& path) {
  std::error_code unknown;
  if (std::filesystem::exists(path, unknown)) { return path.string(); }
  std::vector<std::string> alike;
  std::string small = path.filename().string();
  std::transform(small.begin(), small.end(), small.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  for (std::filesystem::directory_iterator entry(folder, unknown), end; !unknown && entry != end; entry.increment(unknown)) {
    if (same_letters(entry->path().filename().string(), small)) { alike.push_back(entry->path().string()); }
  }
  return alike.size() == 1 ? alike.front() : path.string();
}

// Reads files named by another one, from its folder or by their absolute path. Files that were read are appended to `read`.
SideFile beside(const std::string& path, std::vector<FileBeside>& read) {
  return [folder = std::filesystem::path(path).parent_path(), &read](const std::string& name,
                                                                     std::string& fault) -> std::optional<std::string> {
    const std::string whole = existing(folder / name);
    std::error_code unknown;
    const std::filesystem::file_status status = std::filesystem::status(whole, unknown);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {  // a pipe, for example, might never be written to
      fault = "is no file";
      return std::nullopt;
    }
    auto bytes = read_text(whole, fault);
    if (bytes) { read.push_back({name, whole, *bytes}); }
    return bytes;
  };
}

std::optional<SceneFile> load_model(const std::string& path, const std::string& bytes, const ModelFormat& format, const SideFile& side_file,
                                    const ModelOptions& options, ExitCode& code) {
  ModelResult result = format.read(bytes, side_file);
  if (!result.model) {
    code = ExitCode::invalid_input;
    const FileGuess guess = guess_kind(bytes);
    auto sentence = guess.kind == FileKind::empty ? wrong_kind(shown(path), bytes, FileKind::scene) : std::nullopt;
    if (guess.kind == FileKind::scene) { sentence = shown(path) + " is a scene of halflight; give it a name that ends with .scene"; }
    sentence ? complain(*sentence) : static_cast<void>(std::fputs(to_text(result, shown(path)).c_str(), stderr));
    return std::nullopt;
  }
  std::vector<std::string> faults;
  auto file = to_scene(std::move(*result.model), format.up, options, faults);
  if (!file) {
    code = ExitCode::invalid_input;
    complain_of(shown(path), faults);
  }
  return file;
}

std::optional<SceneFile> load_own(const std::string& path, const std::string& text, const SideFile& side_file, const ModelOptions& options,
                                  ExitCode& code) {
  if (!options.lamps.empty()) {
    code = complain("--lamp is about files of other programs; in a .scene the material says it: material " + options.lamps[0].material +
                        " reflectance 0.5 emission " + shortest(options.lamps[0].exitance),
                    ExitCode::usage);
    return std::nullopt;
  }
  SceneResult result = parse_scene(text, side_file, options.camera);
  if (!result.file) {
    const auto sentence = wrong_kind(shown(path), text, FileKind::scene);
    sentence ? complain(*sentence) : static_cast<void>(std::fputs(to_text(result, shown(path)).c_str(), stderr));
    code = ExitCode::invalid_input;
    return std::nullopt;
  }
  if (result.file->cameras.empty()) {
    const std::vector<radiosity::Room> no_rooms;
    AddedLight(*result.file, no_rooms, {}, {false, true}).look_for_light();
  }
  return std::move(result.file);
}

std::optional<SceneFile> load(const std::string& path, const std::string& text, const SideFile& side_file, const ModelOptions& options,
                              ExitCode& code) {
  const ModelFormat* const format = model_format(path, text);
  return format ? load_model(path, text, *format, side_file, options, code) : load_own(path, text, side_file, options, code);
}

}  // namespace

std::optional<SceneFile> load_scene(const std::string& path, const std::vector<std::string>& outputs, ExitCode& code,
                                    const ModelOptions& options) {
  const auto text = load_text(path, code);
  return text ? load_scene(path, *text, outputs, code, options) : std::nullopt;
}

std::optional<SceneFile> load_scene(const std::string& path, const std::string& text, const std::vector<std::string>& outputs,
                                    ExitCode& code, const ModelOptions& options) {
  std::vector<FileBeside> read;
  auto file = load(path, text, beside(path, read), options, code);
  if (!file) { return std::nullopt; }
  std::vector<std::string> inputs;
  for (const FileBeside& side : read) { inputs.push_back(side.path); }
  file->beside = std::move(read);
  const ExitCode fault = check_outputs(outputs, inputs);
  if (fault == ExitCode::ok) { return file; }
  code = fault;
  return std::nullopt;
}

std::optional<SceneFile> load_scene(const SceneSource& source, ExitCode& code) {
  return load(source.path, source.text, files_of(source), source.options, code);
}

ExitCode check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
  const auto fault = check_output_paths(outputs, inputs);
  return fault ? complain(fault->sentence, fault->usage ? ExitCode::usage : ExitCode::failure) : ExitCode::ok;
}

ExitCode check_mesh_output(const std::string& output, std::vector<std::string> others, const std::string& input) {
  if (!output.empty() && !mesh_format(output)) {
    return complain("--output " + output + ": expected a name that ends with " + mesh_endings(), ExitCode::usage);
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
