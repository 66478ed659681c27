// SPDX-License-Identifier: MIT
// The C interface: what is wrong comes back as a status and a sentence, whatever a program of another language hands over.

#include <radiosity/bake/halflight.h>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include "catch.hpp"

namespace {

constexpr std::array<float, 12> corners{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
constexpr std::array<std::uint32_t, 6> triangles{0, 1, 2, 0, 2, 3};
constexpr double grey[3] = {0.5, 0.5, 0.5}, shines[3] = {1, 1, 1};

using Job = std::unique_ptr<halflight_job, decltype(&halflight_destroy)>;

Job square() {
  Job job(halflight_create(), &halflight_destroy);
  REQUIRE(job);
  REQUIRE(halflight_add_material(job.get(), "lamp", grey, shines) == 0);
  REQUIRE(halflight_set_positions(job.get(), corners.data(), 4, 3) == HALFLIGHT_OK);
  REQUIRE(halflight_set_triangles(job.get(), triangles.data(), 2, nullptr) == HALFLIGHT_OK);
  return job;
}

}  // namespace

TEST_CASE("C interface: a job cannot be changed, run or destroyed from its own progress callback") {
  const Job job = square();
  struct Seen {
    halflight_job* job;
    int called = 0, refused = 0;
    std::string message;
  } seen{job.get(), 0, 0, {}};
  const auto meddle = [](void* user, const char*, double) {
    auto& s = *static_cast<Seen*>(user);
    s.called += 6;
    s.refused += halflight_run(s.job) == HALFLIGHT_INVALID;
    s.message = halflight_message(s.job);
    s.refused += halflight_set_positions(s.job, corners.data(), 4, 3) == HALFLIGHT_INVALID;
    s.refused += halflight_set_triangles(s.job, triangles.data(), 2, nullptr) == HALFLIGHT_INVALID;
    s.refused += halflight_set_number(s.job, "epsilon", 0.1) == HALFLIGHT_INVALID;
    s.refused += halflight_add_material(s.job, "m", grey, nullptr) == -HALFLIGHT_INVALID;
    s.refused += halflight_set_progress(s.job, nullptr, nullptr) == HALFLIGHT_INVALID;
    halflight_destroy(s.job);
    return 0;
  };
  REQUIRE(halflight_set_progress(job.get(), meddle, &seen) == HALFLIGHT_OK);
  REQUIRE(halflight_run(job.get()) == HALFLIGHT_OK);
  CHECK(seen.called > 0);
  CHECK(seen.refused == seen.called);
  CHECK(seen.message.find("progress callback") != std::string::npos);
  std::array<float, 12> light{};
  CHECK(halflight_read(job.get(), HALFLIGHT_VERTEX_COLORS, light.data(), 4) == HALFLIGHT_OK);
  CHECK(light[0] == 1.0f);  // alone in the world
}

TEST_CASE("C interface: a callback that throws leaves a job that can be run again") {
  const Job job = square();
  REQUIRE(halflight_set_progress(
              job.get(), [](void*, const char*, double) -> int { throw 1; }, nullptr) == HALFLIGHT_OK);
  CHECK_THROWS(halflight_run(job.get()));
  REQUIRE(halflight_set_progress(job.get(), nullptr, nullptr) == HALFLIGHT_OK);
  CHECK(halflight_run(job.get()) == HALFLIGHT_OK);
}

TEST_CASE("C interface: light is asked at points that are finite, and warnings of the run can be read") {
  const Job job = square();
  REQUIRE(halflight_run(job.get()) == HALFLIGHT_OK);
  std::array<float, 3> light{};
  const float inside[3] = {0.5f, 0.25f, 0.0f}, nowhere[3] = {std::numeric_limits<float>::quiet_NaN(), 0.0f, 0.0f};
  CHECK(halflight_at(job.get(), 0, inside, 0, light.data()) == HALFLIGHT_OK);
  CHECK(halflight_at(job.get(), 0, nowhere, 0, light.data()) == HALFLIGHT_INVALID);
  const auto says = [&](const std::string& words) {
    for (std::size_t k = 0; const char* sentence = halflight_change(job.get(), k); ++k) {
      if (std::string(sentence).find(words) != std::string::npos) { return true; }
    }
    return false;
  };
  CHECK_FALSE(says("reflected by any surface"));
  // A grey square that the lamp looks away from.
  std::array<float, 24> both{};
  std::array<std::uint32_t, 12> all{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
  for (std::size_t i = 0; i < 12; ++i) {
    both[i] = corners[i];
    both[i + 12] = corners[i] - (i % 3 == 2 ? 1.0f : 0.0f);
  }
  const std::array<std::uint32_t, 4> material{0, 0, 1, 1};
  REQUIRE(halflight_add_material(job.get(), "grey", grey, nullptr) == 1);
  REQUIRE(halflight_set_positions(job.get(), both.data(), 8, 3) == HALFLIGHT_OK);
  REQUIRE(halflight_set_triangles(job.get(), all.data(), 4, material.data()) == HALFLIGHT_OK);
  REQUIRE(halflight_run(job.get()) == HALFLIGHT_OK);
  CHECK(says("reflected by any surface"));
}

TEST_CASE("C interface: an error that was not reached is told, and none is told as 0") {
  const Job job = square();
  std::array<float, 24> both{};
  const std::array<std::uint32_t, 12> all{0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6};
  for (std::size_t i = 0; i < 12; ++i) {
    both[i] = corners[i];
    both[i + 12] = corners[i] + (i % 3 == 2 ? 1.0f : 0.0f);
  }
  const std::array<std::uint32_t, 4> material{1, 1, 0, 0};
  REQUIRE(halflight_add_material(job.get(), "grey", grey, nullptr) == 1);
  REQUIRE(halflight_set_positions(job.get(), both.data(), 8, 3) == HALFLIGHT_OK);
  REQUIRE(halflight_set_triangles(job.get(), all.data(), 4, material.data()) == HALFLIGHT_OK);
  REQUIRE(halflight_set_number(job.get(), "memory", 3e7) == HALFLIGHT_OK);
  for (const double wanted : {0.05, 1e-6}) {
    REQUIRE(halflight_set_number(job.get(), "error", wanted) == HALFLIGHT_OK);
    REQUIRE(halflight_run(job.get()) == HALFLIGHT_OK);
    bool told = false;
    for (std::size_t k = 0; const char* sentence = halflight_change(job.get(), k); ++k) {
      told = told || std::string(sentence).find("was not reached") != std::string::npos;
    }
    double error = 0.0, low = 1.0, converged = -1.0;
    REQUIRE(halflight_figure(job.get(), "error", &error) == HALFLIGHT_OK);
    REQUIRE(halflight_figure(job.get(), "error_low", &low) == HALFLIGHT_OK);
    REQUIRE(halflight_figure(job.get(), "converged", &converged) == HALFLIGHT_OK);
    CAPTURE(wanted, error, low, converged);
    CHECK(told == (wanted < 1e-3));
    CHECK((converged == 1.0) == !told);
    CHECK(error > 0.0);
    CHECK(error >= low);
  }
  CHECK(halflight_set_number(job.get(), "seed", 1e28) == HALFLIGHT_INVALID);
  CHECK(std::string(halflight_message(job.get())) == "seed cannot be 1e+28");
}

TEST_CASE("C interface: light beyond the range of float is finite") {
  const Job job(halflight_create(), &halflight_destroy);
  REQUIRE(job);
  const double bright[3] = {1e42, 1.0, 0.0};
  REQUIRE(halflight_add_material(job.get(), "lamp", grey, bright) == 0);
  REQUIRE(halflight_set_positions(job.get(), corners.data(), 4, 3) == HALFLIGHT_OK);
  REQUIRE(halflight_set_triangles(job.get(), triangles.data(), 2, nullptr) == HALFLIGHT_OK);
  REQUIRE(halflight_run(job.get()) == HALFLIGHT_OK);
  std::array<float, 12> colors{};
  REQUIRE(halflight_read(job.get(), HALFLIGHT_VERTEX_COLORS, colors.data(), 4) == HALFLIGHT_OK);
  CHECK(colors[0] == std::numeric_limits<float>::max());
  CHECK(colors[1] == 1.0f);
  CHECK(halflight_add_material(job.get(), "mirror", bright, nullptr) == -HALFLIGHT_INVALID);
  CHECK(std::string(halflight_message(job.get())).find("reflectance 1e+42 lies outside") != std::string::npos);
}
