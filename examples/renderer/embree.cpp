// SPDX-License-Identifier: MIT
// A renderer's own ray caster bakes: Embree knows the triangles anyhow, and answers the rays of the solver (radiosity/bake/own_rays.hpp).
// Built where Embree 3 is found. `example_embree 40` has 40 balls in its room, and tells the times of both casters.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <vector>

#include <embree3/rtcore.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/bake/bake.hpp>

namespace {

// All that the solver asks of a ray caster.
struct Embree {
  RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
  RTCScene scene = rtcNewScene(device);

  Embree(const std::vector<float>& positions, const std::vector<std::uint32_t>& indices) {
    const RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const v = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, positions.size() / 3);
    auto* const t = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, indices.size() / 3);
    std::copy(positions.begin(), positions.end(), static_cast<float*>(v));
    std::copy(indices.begin(), indices.end(), static_cast<std::uint32_t*>(t));
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene, mesh);
    rtcReleaseGeometry(mesh);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);  // no ray slips through between two triangles
    rtcCommitScene(scene);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
  ~Embree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  [[nodiscard]] std::uint32_t blocked16(const radiosity::RayPacket& packet) const {
    RTCRay16 rays;
    alignas(64) int valid[16];
    for (unsigned i = 0; i < 16; ++i) {
      valid[i] = (packet.lanes >> i & 1U) != 0 ? -1 : 0;
      rays.org_x[i] = static_cast<float>(packet.origin[0][i]);
      rays.org_y[i] = static_cast<float>(packet.origin[1][i]);
      rays.org_z[i] = static_cast<float>(packet.origin[2][i]);
      rays.dir_x[i] = static_cast<float>(packet.direction[0][i]);
      rays.dir_y[i] = static_cast<float>(packet.direction[1][i]);
      rays.dir_z[i] = static_cast<float>(packet.direction[2][i]);
      rays.tnear[i] = static_cast<float>(packet.near[i]);
      rays.tfar[i] = static_cast<float>(packet.far[i]);
      rays.time[i] = 0.0F;
      rays.mask[i] = ~0U;
      rays.flags[i] = rays.id[i] = 0;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded16(valid, scene, &context, &rays);
    std::uint32_t blocked = 0;
    for (unsigned i = 0; i < 16; ++i) { blocked |= static_cast<std::uint32_t>(valid[i] != 0 && rays.tfar[i] < 0.0F) << i; }
    return blocked;
  }

  [[nodiscard]] std::optional<radiosity::TriangleHit> closest(const radiosity::CasterRay& ray) const {
    RTCRayHit r{};
    const glm::vec3 origin(ray.origin), direction(ray.direction);
    r.ray.org_x = origin.x, r.ray.org_y = origin.y, r.ray.org_z = origin.z, r.ray.tnear = static_cast<float>(ray.near);
    r.ray.dir_x = direction.x, r.ray.dir_y = direction.y, r.ray.dir_z = direction.z, r.ray.tfar = static_cast<float>(ray.far);
    r.ray.mask = ~0U;
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) { return std::nullopt; }
    return radiosity::TriangleHit{r.ray.tfar, r.hit.primID};
  }
};
static_assert(radiosity::RayCaster<Embree>);

struct Mesh {
  std::vector<float> positions;
  std::vector<std::uint32_t> indices, material;

  void quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d, std::uint32_t m) {
    const auto first = static_cast<std::uint32_t>(positions.size() / 3);
    for (const glm::dvec3& p : {a, b, c, d}) {
      for (int k = 0; k < 3; ++k) { positions.push_back(static_cast<float>(p[k])); }
    }
    for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) { indices.push_back(first + k); }
    material.insert(material.end(), 2, m);
  }
  // `around` by half as many quadrilaterals, those at the poles without one of their sides.
  void ball(const glm::dvec3& centre, double radius, int around) {
    const auto at = [&](int i, int j) {
      const double a = 2.0 * std::numbers::pi * (i % around) / around, b = 2.0 * std::numbers::pi * j / around;
      return centre + radius * glm::dvec3(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), -std::cos(b));
    };
    for (int j = 0; 2 * j < around; ++j) {
      for (int i = 0; i < around; ++i) { quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), 0); }
    }
  }
};

double seconds_of(const radiosity::Audit& audit) {
  double sum = 0.0;
  for (const radiosity::StageTime& stage : audit.stages) { sum += stage.cpu_seconds; }
  return sum;
}

}  // namespace

int main(int count, char** arguments) {
  const int balls = count > 1 ? std::atoi(arguments[1]) : 4;
  const std::vector<radiosity::Material> materials{{"white", radiosity::Color(0.7), radiosity::Color(0.0)},
                                                   {"lamp", radiosity::Color(0.0), radiosity::Color(30.0)}};
  Mesh mesh;
  const glm::dvec3 x{4, 0, 0}, y{0, 3, 0}, z{0, 0, 2.5}, o{0.0};
  mesh.quad(o, x, x + y, y, 0);  // all of them seen from inside
  mesh.quad(z, z + y, x + y + z, x + z, 0);
  mesh.quad(o, z, x + z, x, 0);
  mesh.quad(y, x + y, x + y + z, y + z, 0);
  mesh.quad(o, y, y + z, z, 0);
  mesh.quad(x, x + z, x + y + z, x + y, 0);
  mesh.quad({1.5, 1, 2.4}, {1.5, 2, 2.4}, {2.5, 2, 2.4}, {2.5, 1, 2.4}, 1);
  for (int i = 0; i < balls; ++i) {  // in a spiral
    const double turn = 2.4 * i, far = std::sqrt((i + 0.5) / balls);
    mesh.ball({2.0 + 1.7 * far * std::cos(turn), 1.5 + 1.2 * far * std::sin(turn), 0.4 + 0.2 * (i % 6)}, 0.6 / std::sqrt(balls + 4.0), 12);
  }

  const radiosity::MeshView view{mesh.positions, mesh.indices, materials, mesh.material};
  radiosity::BakeOptions options;
  options.solve.epsilon = 0.02;
  options.solve.threads = 1;
  const radiosity::BakeOutcome ours = radiosity::bake(view, options);
  const Embree embree(mesh.positions, mesh.indices);
  options.rays = embree;
  const radiosity::BakeOutcome theirs = radiosity::bake(view, options);
  if (!ours.baked || !theirs.baked) { return 1; }

  double apart = 0.0, all = 0.0;
  for (std::size_t c = 0; c < mesh.indices.size(); ++c) {
    const radiosity::Color a = ours.baked->colors.corner[c], d = theirs.baked->colors.corner[c] - a;
    apart += glm::dot(d, d);
    all += glm::dot(a, a);
  }
  std::printf("%zu triangles, the colours of both casters are within 1 %%: %s\n", mesh.indices.size() / 3,
              apart < 1e-4 * all ? "yes" : "no");
  if (count > 1) {
    std::printf("relative L2 %.2e, CPU s %.2f and %.2f with Embree\n", std::sqrt(apart / all), seconds_of(ours.baked->audit),
                seconds_of(theirs.baked->audit));
  }
}
