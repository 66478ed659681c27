// SPDX-License-Identifier: MIT
// halflight study SCENE... -o DIR: measures error against time, memory and links for every method on each scene.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include <radiosity/camera/view.hpp>
#include <radiosity/scene/options.hpp>

#include "apps/commands/command.hpp"
#include "apps/commands/common.hpp"
#include "apps/files.hpp"
#include "apps/memory.hpp"
#include "apps/process.hpp"
#include "apps/scene_file.hpp"
#include "apps/study/folder.hpp"
#include "apps/study/measure.hpp"
#include "apps/study/parts.hpp"
#include "apps/study/reference.hpp"
#include "apps/text.hpp"

namespace apps {
namespace {

struct StudyOptions {
  ModelOptions model;
  std::vector<std::string> scenes, merge;
  std::string folder;
  std::optional<study::PartNumber> part;
  double seconds = 12.0;       // CPU time of one run
  std::uint64_t paths = 8192;  // per point of the reference
  std::uint32_t dense = 3000;  // up to this number of leaves, the parts of an error are computed separately
  bool quick = false;
  bool quiet = false;
  unsigned threads = 0;
  std::optional<std::uint64_t> memory;  // bytes that a run may use
};

namespace fs = std::filesystem;

// "AMD EPYC 7763, 2 cores"
std::string machine() {
  std::string name = "unknown processor";
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) {
      name = line.substr(colon + 2);
      break;
    }
  }
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  return name + ", " + counted(cores, "core");
}

std::string compiler() {
#if defined(__clang__)
  return "clang " __clang_version__;
#elif defined(__GNUC__)
  return "gcc " __VERSION__;
#else
  return "unknown compiler";
#endif
}

// The first comment of the text, without its mark: the scene's description of itself.
std::string title_of(const std::string& text) {
  const std::size_t mark = text.find_first_not_of(" \t\r\n");
  if (mark == std::string::npos || text[mark] != '#') { return {}; }
  const std::size_t end = std::min(text.size(), text.find('\n', mark));
  const std::size_t first = text.find_first_not_of("# \t\r", mark);
  return first < end ? text.substr(first, text.find_last_not_of(" \t\r", end - 1) + 1 - first) : std::string();
}

// The files that every study writes. The names of its pictures are known only at the end.
std::vector<std::string> known_files(const StudyOptions& options) {
  std::vector<std::string> names{"index.html", "results.csv", "results.json"};
  if (options.part) { names = {study::part_file(*options.part)}; }
  for (const std::string& scene : options.scenes) { names.push_back(fs::path(scene).stem().string() + ".reference.json"); }
  for (std::string& name : names) { name = (fs::path(options.folder) / name).string(); }
  return names;
}

// Studies one scene; nothing if there is no result. `code` gives the reason.
std::optional<study::SceneStudy> study_scene(const std::string& path, const StudyOptions& options,
                                             const std::vector<study::MethodPlan>& methods, const radiosity::Control& control,
                                             Progress& progress, ExitCode& code) {
  const auto text = load_text(path, code);
  const auto file = text ? load_scene(path, *text, known_files(options), code, options.model) : std::nullopt;
  if (!file) { return std::nullopt; }
  study::SceneStudy result;
  result.scene = fs::path(path).stem().string();
  result.title = title_of(*text);
  result.camera = file->cameras.empty() ? radiosity::automatic_camera(file->scene) : file->cameras.front();

  study::ReferenceOptions reference;
  reference.paths = options.paths;
  reference.threads = options.threads;
  const std::string name = result.scene + ".reference.json";
  const std::vector<std::string> caches{(fs::path(path).parent_path() / name).string(), (fs::path(options.folder) / name).string()};
  // For a file of another program, the scene also depends on the files beside it and on the options of the command line.
  std::string known = *text;
  if (!file->notes.empty()) {
    known += options.model.key();
    for (const FileBeside& side : file->beside) { known += side.bytes; }
  }
  std::string fault;
  const auto truth = study::make_reference(file->scene, known, caches, reference, control, fault);
  if (!truth) {
    code = complain(path + ": " + fault, control.cancelled() ? ExitCode::failure : ExitCode::invalid_input);
    return std::nullopt;
  }
  const study::Reference about = study::describe(*truth);
  progress.say(result.scene + ": reference " + about.kind + (about.cached ? " (kept from before), " : ", ") + std::to_string(about.points) +
               " points in " + std::to_string(about.cells) + " cells, noise " + percent(about.noise));
  for (const std::string& taken : truth->taken) { progress.say(taken + " is left as it is: it is no reference of this scene"); }

  study::MeasureOptions measuring;
  measuring.cpu_seconds_per_run = options.seconds;
  measuring.dense_leaves = options.dense;
  measuring.finished = [&](const study::Method& method, const study::Run& run) {
    char line[160] = "";
    const std::string outcome = !run.refused.empty() ? run.refused
                                                     : "L2 of cell means " + percent(run.leaves_error.cells.l2) +
                                                           (run.cut_off.empty() ? "" : ", " + run.cut_off + ": not credited");
    std::snprintf(line, sizeof line, "  %-20s %-26s %8.3f s  %s", method.name.c_str(), run.setting.c_str(), run.cpu_seconds,
                  outcome.c_str());
    progress.say(line);
  };
  study::measure(file->scene, *truth, methods, measuring, control, result);
  return result.methods.empty() ? std::nullopt : std::optional(std::move(result));
}

// Writes the page and all tables, but refuses to overwrite `inputs`.
ExitCode write(const study::Study& study, const std::string& folder, const std::vector<std::string>& inputs) {
  std::vector<std::string> files = study::page_files(study);
  for (std::string& name : files) { name = (fs::path(folder) / name).string(); }
  if (const ExitCode fault = check_outputs(files, inputs); fault != ExitCode::ok) { return fault; }
  if (const auto fault = study::write_pages(study, folder)) { return complain(*fault, ExitCode::failure); }
  std::string text;
  for (const std::string& file : files) { text += "written: " + file + "\n"; }
  return print(text) ? ExitCode::ok : ExitCode::failure;
}

// Combines the parts of a study that are in the folders.
ExitCode merge(const StudyOptions& options) {
  std::vector<std::string> paths;
  for (const std::string& folder : options.merge) {
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(folder, failed)) {
      if (entry.path().extension() == ".study") { paths.push_back(entry.path().string()); }
    }
    if (failed) { return complain(folder + ": " + failed.message(), ExitCode::failure); }
  }
  std::sort(paths.begin(), paths.end());
  std::vector<study::Part> parts;
  for (const std::string& path : paths) {
    ExitCode code = ExitCode::ok;
    const auto bytes = load_text(path, code);
    if (!bytes) { return code; }
    auto part = study::read_part(*bytes);
    if (!part) { return complain(path + " is damaged, or no part of a study", ExitCode::invalid_input); }
    parts.push_back(std::move(*part));
  }
  const study::Merged merged = study::merge(std::move(parts));
  if (!merged.study) { return complain(merged.fault, ExitCode::invalid_input); }
  return write(*merged.study, options.folder, {});
}

// The settings in which all parts of one study must agree.
std::string asked(const StudyOptions& options) {
  std::string text = version;
  for (const std::string& scene : options.scenes) { text += "\n" + fs::path(scene).stem().string(); }
  return text + "\n" + formatted("%.17g", options.seconds) + " " + std::to_string(options.paths) + " " + std::to_string(options.dense) +
         " " + std::to_string(options.memory.value_or(0));
}

// Refuses scenes of the same name, which would write the same files.
ExitCode check_names(const std::vector<std::string>& scenes) {
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (fs::path(scenes[i]).stem() == fs::path(scenes[k]).stem()) {
        return complain(scenes[i] + " and " + scenes[k] + " would write the same files; study them into two folders", ExitCode::usage);
      }
    }
  }
  return ExitCode::ok;
}

// Measures this part's share of every scene, until it is interrupted or a scene has read a file that the study would write.
study::Part measure(const StudyOptions& options, const radiosity::Control& control, Progress& progress, ExitCode& code) {
  const std::vector<study::MethodPlan> methods = study::methods({options.threads, 1, options.memory});
  study::Part part{options.part.value_or(study::PartNumber{}), asked(options), options.scenes.size(), methods.size(), {}, {}, {}};
  part.study.machine = machine();
  part.study.compiler = compiler();
  part.study.version = version;
  for (std::size_t i = 0; i < options.scenes.size() && !control.cancelled() && code != ExitCode::usage; ++i) {
    std::vector<study::MethodPlan> plans;
    std::vector<std::size_t> which;
    for (std::size_t m = 0; m < methods.size(); ++m) {
      if (!part.number.has(i * methods.size() + m)) { continue; }
      plans.push_back(methods[m]);
      which.push_back(m);
    }
    auto scene = plans.empty() ? std::nullopt : study_scene(options.scenes[i], options, plans, control, progress, code);
    if (!scene) { continue; }
    part.study.scenes.push_back(std::move(*scene));
    part.scenes.push_back(i);
    part.methods.push_back(std::move(which));
  }
  return part;
}

ExitCode run(const StudyOptions& given) {
  StudyOptions options = given;
  if (options.quick) {
    options.seconds = 1.5;
    options.paths = 256;
    options.dense = 300;
  }
  const NewFolder folder(options.folder);
  if (const auto fault = folder.fault()) { return complain(*fault, ExitCode::failure); }
  if (!options.merge.empty()) { return merge(options); }
  if (const ExitCode fault = check_names(options.scenes); fault != ExitCode::ok) { return fault; }
  if (const ExitCode fault = check_outputs(known_files(options), options.scenes); fault != ExitCode::ok) { return fault; }
  Progress progress(options.quiet);
  radiosity::Control control;
  control.cancel = &watch_interrupts();
  control.progress = [&](std::string_view stage, double fraction) { progress.report(stage, fraction); };
  ExitCode code = ExitCode::ok;
  const study::Part part = measure(options, control, progress, code);
  progress.done();
  if (code == ExitCode::usage) { return code; }
  if (control.cancelled()) {
    const bool nothing = options.part || part.study.scenes.empty();  // half a part must not be mistaken for a whole one
    complain(nothing ? "interrupted; nothing was written" : "interrupted; what was finished is written");
    code = nothing ? ExitCode::failure : ExitCode::not_converged;
  }
  if (options.part) {
    if (code != ExitCode::ok) { return code; }
    const std::string path = (fs::path(options.folder) / study::part_file(part.number)).string();
    return save(path, study::to_bytes(part)) && print("written: " + path + "\n") ? ExitCode::ok : ExitCode::failure;
  }
  if (part.study.scenes.empty()) { return code; }
  const ExitCode written = write(part.study, options.folder, options.scenes);
  return written == ExitCode::ok ? code : written;
}

}  // namespace

Command study_command() {
  const auto options = std::make_shared<StudyOptions>();
  return {
      "study",
      "error against time, memory and links for every method on each scene",
      with_model_arguments(
          {texts("scenes", "SCENE", options->scenes, "the scenes: .scene files, or " + model_endings()),
           text("-o,--output", "DIR", options->folder, "folder for tables, plots, pictures and the page; made when there is none").must(),
           above_zero("--time-per-run", options->seconds, 1e6, "CPU seconds after which a run is stopped")
               .by_default(formatted("%g", options->seconds)),
           whole_number("--paths", options->paths, 8, 100'000'000, "paths at each point of a path-traced reference")
               .by_default(std::to_string(options->paths)),
           whole_number("--dense", options->dense, 0, 20'000, "leaves up to which a dense solution tells the parts of an error apart")
               .by_default(std::to_string(options->dense)),
           parsed("--part", "I/N", options->part, study::parse_part, "I/N with I from 1 to N, such as 3/8",
                  "measures the Ith of N parts of the work and writes part-I-of-N.study; N machines do so, then one merges")
               .without({"--merge"}),
           texts("--merge", "DIR", options->merge, "puts the parts in these folders together into one study").without({"scenes"}),
           flag("--quick", options->quick, "a first look: short runs, a noisy reference").without({"--time-per-run", "--paths"}),
           parsed("--memory", "BYTES", options->memory, parse_memory, memory_form,
                  "most memory that one run may take, such as 500M or 2G; one that would need more is refused, or ends with the best that "
                  "fits"),
           whole_number("--threads", options->threads, 0, most_threads, "0: as many as the machine has; results do not depend on it"),
           flag("-q,--quiet", options->quiet, "no narration on stderr")},
          options->model),
      [options] { return run(*options); },
      [options] { return std::string(options->scenes.empty() && options->merge.empty() ? "SCENE, the scenes" : ""); },
      "Spread over machines, each pair of a scene and a method goes to one part; a part is one process, by GNU parallel:\n"
      "  parallel -j 4 halflight study *.scene -o parts --threads 1 -q --part {}/16 ::: $(seq 16)\n"
      "or by a Slurm array, its folder on a disk that all machines share:\n"
      "  sbatch --array=1-16 --wrap 'halflight study *.scene -o parts --threads 1 -q --part $SLURM_ARRAY_TASK_ID/16'\n"
      "and when all are done, one merges:\n"
      "  halflight study --merge parts -o study\n"
      "Figures are those of one machine, but for times: measure on machines of one kind, one part a core.\n"};
}

}  // namespace apps
