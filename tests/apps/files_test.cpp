// SPDX-License-Identifier: MIT
#include "catch.hpp"

#include <filesystem>
#include <string>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <csignal>

#include "apps/files.hpp"
#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using program::content;

struct Folder : program::Place {
  [[nodiscard]] std::string operator/(const std::string& name) const { return (path() / name).string(); }
};

}  // namespace

TEST_CASE("a file is written whole and replaces the old one, whose permissions stay") {
  const Folder folder;
  const std::string path = folder / "a.txt";
  CHECK_FALSE(apps::write_file(path, "one"));
  REQUIRE(::chmod(path.c_str(), 0640) == 0);
  const std::string bytes("two\0three", 9);
  CHECK_FALSE(apps::write_file(path, bytes));
  CHECK(content(path) == bytes);
  struct ::stat status {};
  REQUIRE(::stat(path.c_str(), &status) == 0);
  CHECK((status.st_mode & 0777U) == 0640U);
  CHECK(folder.entries() == 1);
}

TEST_CASE("when writing fails the old file stays and nothing else is left") {
  const Folder folder;
  const std::string path = folder / "a.txt";
  REQUIRE_FALSE(apps::write_file(path, "old"));
  // A limit on the size of files makes write() fail half-way, as a full disk does.
  struct ::rlimit old {};
  REQUIRE(::getrlimit(RLIMIT_FSIZE, &old) == 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  struct ::rlimit small = old;
  small.rlim_cur = 1000;
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
  const auto fault = apps::write_file(path, std::string(100'000, 'x'));
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &old) == 0);
  std::signal(SIGXFSZ, handler);
  REQUIRE(fault);
  CHECK(fault->find("cannot write " + path) == 0);
  CHECK(content(path) == "old");
  CHECK(folder.entries() == 1);
}

TEST_CASE("a folder in the place of the file is refused and stays") {
  const Folder folder;
  REQUIRE(fs::create_directory(folder / "a.png"));
  CHECK(apps::check_writable(folder / "a.png"));
  CHECK(apps::write_file(folder / "a.png", "x"));
  CHECK(fs::is_directory(folder / "a.png"));
  CHECK(folder.entries() == 1);
}

TEST_CASE("what cannot be written is known before") {
  const Folder folder;
  CHECK_FALSE(apps::check_writable(folder / "new.png"));
  CHECK_FALSE(apps::check_writable("new.png"));
  CHECK(apps::check_writable(folder / "none/new.png"));
  CHECK(apps::write_file(folder / "none/new.png", "x"));
}

TEST_CASE("a symbolic link is followed") {
  const Folder folder;
  REQUIRE_FALSE(apps::write_file(folder / "real.txt", "old"));
  fs::create_symlink("real.txt", folder / "link.txt");
  CHECK_FALSE(apps::write_file(folder / "link.txt", "new"));
  CHECK(content(folder / "real.txt") == "new");
  CHECK(fs::is_symlink(folder / "link.txt"));
}

TEST_CASE("a symbolic link to nothing is followed: the file is made where it points") {
  const Folder folder;
  REQUIRE(fs::create_directory(folder / "inner"));
  fs::create_symlink("inner/two.txt", folder / "one.txt");
  fs::create_symlink("real.txt", folder / "inner/two.txt");
  CHECK_FALSE(apps::check_writable(folder / "one.txt"));
  CHECK_FALSE(apps::write_file(folder / "one.txt", "new"));
  CHECK(content(folder / "inner/real.txt") == "new");
  CHECK(fs::is_symlink(folder / "one.txt"));
  CHECK(fs::is_symlink(folder / "inner/two.txt"));
  fs::create_symlink("none/a.txt", folder / "nowhere.txt");
  CHECK(apps::check_writable(folder / "nowhere.txt"));
  fs::create_symlink("loop.txt", folder / "loop.txt");
  CHECK(apps::check_writable(folder / "loop.txt"));
  CHECK(apps::write_file(folder / "loop.txt", "x"));
}

TEST_CASE("a new file does not run as the owner of the old one, a protected file is refused") {
  const Folder folder;
  const std::string path = folder / "a.txt";
  REQUIRE_FALSE(apps::write_file(path, "old"));
  REQUIRE(::chmod(path.c_str(), 06755) == 0);
  REQUIRE_FALSE(apps::write_file(path, "new"));
  struct ::stat status {};
  REQUIRE(::stat(path.c_str(), &status) == 0);
  CHECK((status.st_mode & 07777U) == 0755U);
  REQUIRE(::chmod(path.c_str(), 0444) == 0);
  if (::geteuid() != 0) { CHECK(apps::check_writable(path)); }  // root may write to anything
}
