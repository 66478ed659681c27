// SPDX-License-Identifier: MIT

// Whatever ends the program, it leaves no file behind that was not there; a pipe that nobody reads ends it quietly.

#include "catch.hpp"

#include <csignal>
#include <cstdlib>
#include <string>
#include <thread>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "apps/files.hpp"
#include "apps/process.hpp"
#include "program.hpp"

using program::Place;
using program::Run;
namespace fs = std::filesystem;

namespace {

// Writes a file in a process of its own that gets the signal as soon as the temporary is there; how it ended.
int interrupted_write(const fs::path& folder, int signal, bool watched) {
  const ::pid_t child = ::fork();
  if (child == 0) {
    apps::guard_process();
    if (watched) { static_cast<void>(apps::watch_interrupts()); }
    std::thread watcher([&] {
      while (fs::is_empty(folder)) {}
      ::kill(::getpid(), signal);
    });
    const std::string bytes(64U << 20U, 'x');
    const auto fault = apps::write_file((folder / "a.bin").string(), bytes);
    watcher.join();
    ::_exit(fault ? 1 : 0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

}  // namespace

TEST_CASE("a signal while a file is written: the file is whole or not there, and no temporary is left") {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU}) {
    for (const bool watched : {false, true}) {
      const Place place;
      const int status = interrupted_write(place.path(), signal, watched);
      INFO("signal " << signal << ", watched " << watched);
      const bool ends = !watched || signal == SIGQUIT;  // otherwise the first one is a request
      CHECK(WIFSIGNALED(status) == ends);
      if (ends) { CHECK(WTERMSIG(status) == signal); }
      CHECK(place.entries() == (ends ? 0 : 1));
      if (!ends) { CHECK(fs::file_size(place.path() / "a.bin") == 64U << 20U); }
    }
  }
}

TEST_CASE("every command under every signal leaves no file that was not there, or all outputs with the best so far") {
  // Each works far longer than it is let.
  const std::string commands[] = {"render " + program::scene("room") + " -o a.png --json a.json --epsilon 0.0005 --min-area 1e-7 --quiet",
                                  "factors " + program::scene("primitives") + " --csv a.csv --error 1e-9", "stress --json a.json",
                                  "euler --interactive -o a.svg < /dev/zero"};
  for (const std::string& command : commands) {
    for (const char* signal : {"INT", "TERM", "HUP"}) {
      const Place place;
      const Run run = place.run(command, std::string("timeout -k 20 -s ") + signal + " 0.3 ");
      INFO(command << " " << signal << "\n" << run.err);
      CHECK(run.code != 0);
      CHECK(run.code != 137);  // it did not have to be killed
      const bool best = run.err.find("interrupted: the outputs show the best solution so far") != std::string::npos;
      CHECK(place.entries() == (best ? 2 : 0));
      CHECK((!best || (place.has("a.png") && place.has("a.json"))));
    }
  }
}

TEST_CASE("a study that is interrupted writes what is finished and has not converged, or writes nothing and has failed") {
  int finished = 0;
  for (const bool part : {false, true}) {
    for (const char* seconds : {"0.2", "12"}) {  // two_plates takes two, primitives minutes
      const Place place;
      for (const char* scene : {"two_plates.scene", "primitives.scene"}) {
        fs::copy_file(fs::path(HALFLIGHT_SCENES) / scene, place.path() / scene);
      }
      const Run run =
          place.run(std::string("study two_plates.scene primitives.scene -o study --quiet --threads 1") + (part ? " --part 1/2" : ""),
                    std::string("timeout --preserve-status -k 60 -s INT ") + seconds + " ");
      INFO(seconds << " " << part << "\n" << run.err);
      const bool written = run.err.find("what was finished is written") != std::string::npos;
      CHECK(run.code == (written ? 4 : 1));
      CHECK(place.has("study/index.html") == written);
      finished += written ? 1 : 0;
    }
  }
  CHECK(finished == 1);
}

TEST_CASE("a signal ends the program at once while it reads a model: there is nothing to show yet") {
  const Place place;
  std::string obj;
  constexpr int across = 400;  // a terrain of 160 000 squares that are not planar takes seconds to take in
  for (int i = 0; i <= across; ++i) {
    for (int k = 0; k <= across; ++k) {
      obj += "v " + std::to_string(i) + " " + std::to_string((i * 7919 + k * 104729) % 13) + " " + std::to_string(k) + "\n";
    }
  }
  for (int i = 0; i < across; ++i) {
    for (int k = 0; k < across; ++k) {
      const int a = i * (across + 1) + k + 1, b = a + across + 1;
      obj += "f " + std::to_string(a) + " " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(b) + "\n";
    }
  }
  place.write("a.obj", obj);
  const Run run = place.run("render a.obj -o a.png --quiet", "timeout --preserve-status -k 60 -s TERM 0.3 ");
  INFO(run.err);
  CHECK(run.code == 128 + SIGTERM);  // ended by the signal, not by the command
  CHECK(place.entries() == 1);
}

TEST_CASE("a limit on the size of files is an error of the write in every command, old files stay, no temporary does") {
  const Place place;
  place.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n");
  place.write("a.euler", "h0 = make_segment\n");
  const std::string commands[] = {"render " + program::scene("two_plates") + " --audit 0 --quiet --size 400x400 -o out.png",
                                  "render " + program::scene("two_plates") + " --audit 0 --quiet --json out.png",
                                  "factors " + program::scene("room") + " --error 0.1 --csv out.png",
                                  "mesh " + program::scene("primitives") + " --json out.png", "euler a.euler -o out.html"};
  for (const std::string& command : commands) {
    for (const char* name : {"out.png", "out.html"}) { place.write(name, "old"); }
    const Run run = place.run(command, "ulimit -f 1; ");
    INFO(command << "\n" << run.err);
    CHECK(run.code == 1);
    CHECK(run.err.find("File too large") != std::string::npos);
    CHECK(place.read("out.png") == "old");
    CHECK(place.read("out.html") == "old");
    CHECK(place.entries() == 4);
  }
}

TEST_CASE("a pipe that nobody reads any more ends a command quietly, whether or not the signal is ignored") {
  const Place place;
  for (const std::string& command :
       {"info " + program::scene("room"), "mesh " + program::scene("room") + " --json", "factors " + program::scene("two_plates"),
        "render " + program::scene("two_plates") + " --audit 0 --quiet", std::string("stress --list"), std::string("--help")}) {
    for (const char* trap : {"", "trap '' PIPE; "}) {
      const std::string line = "cd '" + place.path().string() + "' && { " + trap + "sleep 0.1; '" HALFLIGHT_PROGRAM "' " + command +
                               " 2>err; echo $? >code; } | true";
      REQUIRE(std::system(line.c_str()) == 0);
      INFO(command << "\n" << place.read("err"));
      CHECK(place.read("err").empty());
      CHECK(place.read("code") == "0\n");
    }
  }
}

TEST_CASE("an output to a pipe that nobody reads any more is no fault") {
  const Place place;
  for (const std::string& command :
       {"render " + program::scene("two_plates") + " --audit 0 --quiet --json -", "factors " + program::scene("two_plates") + " --csv -",
        "explain " + program::scene("two_plates") + " -o -"}) {
    const std::string line =
        "cd '" + place.path().string() + "' && { sleep 0.1; '" HALFLIGHT_PROGRAM "' " + command + " 2>err; echo $? >code; } | true";
    REQUIRE(std::system(line.c_str()) == 0);
    INFO(command << "\n" << place.read("err"));
    CHECK(place.read("err").find("cannot write") == std::string::npos);
    CHECK(place.read("code") == "0\n");
  }
}

TEST_CASE("figures that are interrupted before the first leave no folder, and a folder that was there stays") {
  const Place place;
  fs::create_directory(place.path() / "old");
  for (const char* folder : {"old", "new"}) {
    const std::string line =
        "cd '" + place.path().string() + "' && timeout -s INT 0.01 '" HALFLIGHT_PROGRAM "' figures -o " + folder + " >out 2>err";
    static_cast<void>(std::system(line.c_str()));
  }
  CHECK(fs::is_directory(place.path() / "old"));
  CHECK_FALSE((fs::exists(place.path() / "new") && fs::is_empty(place.path() / "new")));
}

TEST_CASE("what cannot be said is a failure: a full device, a closed standard output") {
  const Place place;
  for (const std::string& command : {"info " + program::scene("room"), "mesh " + program::scene("room"),
                                     "factors " + program::scene("two_plates"), std::string("--help")}) {
    for (const char* where : {" >/dev/full", " >&-"}) {
      const std::string line =
          "cd '" + place.path().string() + "' && '" HALFLIGHT_PROGRAM "' " + command + " 2>err" + where + "; echo $? >code";
      REQUIRE(std::system(line.c_str()) == 0);
      INFO(command << where << "\n" << place.read("err"));
      CHECK(place.read("code") == "1\n");
      CHECK(place.read("err").find("cannot write to standard output") != std::string::npos);
    }
  }
}

TEST_CASE("interactive: what was not saved is not said to be written") {
  const Place place;
  fs::create_symlink("/dev/full", place.path() / "full");
  place.write("input", "h0 = make_segment\nsave none/steps\nsave a.svg\nsave ./a.svg\nsave full\nsave\nquit\n");
  const Run run = place.run("euler --interactive -o a.svg < input");
  INFO(run.out);
  CHECK(run.code == 1);
  CHECK(run.out.find("written") == std::string::npos);
  CHECK(run.out.find("there is no folder none") != std::string::npos);
  CHECK(run.out.find("No space left on device") != std::string::npos);
  CHECK(place.read("a.svg").find("<svg") != std::string::npos);
  place.write("input", "h0 = make_segment\nsave steps\nquit\n");
  CHECK(place.run("euler --interactive < input").out.find("written: steps") != std::string::npos);
}
