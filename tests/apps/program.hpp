// SPDX-License-Identifier: MIT
#pragma once

// The program as its user meets it: run in a folder of the test's own, with its exit code, its streams and the files it leaves.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <sys/wait.h>

#include "catch.hpp"

namespace program {

namespace fs = std::filesystem;

struct Run {
  int code = -1;
  std::string out;
  std::string err;
};

inline std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// One of the example scenes, as an argument.
inline std::string scene(const std::string& name) { return "'" HALFLIGHT_SCENES "/" + name + ".scene'"; }

// A folder of the test's own; the program runs in it.
class Place {
 public:
  Place() {
    std::string name = (fs::temp_directory_path() / "halflight-run-XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  ~Place() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

  Run run(const std::string& arguments, const std::string& prefix = "") const {
    const std::string command =
        "cd '" + path_.string() + "' && " + prefix + "'" HALFLIGHT_PROGRAM "' " + arguments + " >stdout.log 2>stderr.log";
    const int status = std::system(command.c_str());
    Run result{WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(path_ / "stdout.log"), content(path_ / "stderr.log")};
    fs::remove(path_ / "stdout.log");
    fs::remove(path_ / "stderr.log");
    return result;
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path_ / name) << text; }
  [[nodiscard]] const fs::path& path() const { return path_; }
  [[nodiscard]] bool has(const std::string& name) const { return fs::exists(path_ / name); }
  [[nodiscard]] std::string read(const std::string& name) const { return content(path_ / name); }
  [[nodiscard]] std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(path_), fs::directory_iterator()));
  }

 private:
  fs::path path_;
};

}  // namespace program
