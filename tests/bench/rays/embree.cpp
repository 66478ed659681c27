// SPDX-License-Identifier: MIT
#include "embree.hpp"

#include <embree3/rtcore.h>

#include <cmath>
#include <limits>

namespace bench {

struct Embree::Data {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<std::array<float, 4>> balls;  // of user geometry
};

namespace {

using Balls = const std::vector<std::array<float, 4>>*;

void bounds(const RTCBoundsFunctionArguments* args) {
  const auto& b = (*static_cast<Balls>(args->geometryUserPtr))[args->primID];
  *args->bounds_o = {b[0] - b[3], b[1] - b[3], b[2] - b[3], 0, b[0] + b[3], b[1] + b[3], b[2] + b[3], 0};
}

// One ball against n rays in arrays; the loop vectorises.
template <bool any>
inline void ball(const std::array<float, 4>& b, RTCRayN* rays, RTCHitN* hits, const int* valid, unsigned n, unsigned geometry,
                 unsigned id) {
  for (unsigned i = 0; i < n; ++i) {
    const float dx = RTCRayN_dir_x(rays, n, i), dy = RTCRayN_dir_y(rays, n, i), dz = RTCRayN_dir_z(rays, n, i);
    const float fx = RTCRayN_org_x(rays, n, i) - b[0], fy = RTCRayN_org_y(rays, n, i) - b[1], fz = RTCRayN_org_z(rays, n, i) - b[2];
    const float dd = dx * dx + dy * dy + dz * dz, k = -(fx * dx + fy * dy + fz * dz) / dd;
    const float lx = fx + k * dx, ly = fy + k * dy, lz = fz + k * dz;
    const float disc = b[3] * b[3] - (lx * lx + ly * ly + lz * lz);
    const float half = std::sqrt(std::max(disc, 0.0f) / dd), t0 = k - half, t1 = k + half;
    const float near = RTCRayN_tnear(rays, n, i), far = RTCRayN_tfar(rays, n, i);
    const bool first = t0 >= near && t0 <= far, second = t1 >= near && t1 <= far;
    const bool hit = valid[i] && disc > 0.0f && (first || second);
    if constexpr (any) {
      RTCRayN_tfar(rays, n, i) = hit ? -std::numeric_limits<float>::infinity() : far;
    } else if (hit) {
      RTCRayN_tfar(rays, n, i) = first ? t0 : t1;
      RTCHitN_geomID(hits, n, i) = geometry;
      RTCHitN_primID(hits, n, i) = id;
    }
  }
}
template <bool any, class Arguments>
void dispatch(const Arguments* args, RTCRayN* rays, RTCHitN* hits, unsigned geometry) {
  const auto& b = (*static_cast<Balls>(args->geometryUserPtr))[args->primID];
  switch (args->N) {  // constant counts let the compiler unroll
    case 1:
      return ball<any>(b, rays, hits, args->valid, 1, geometry, args->primID);
    case 8:
      return ball<any>(b, rays, hits, args->valid, 8, geometry, args->primID);
    case 16:
      return ball<any>(b, rays, hits, args->valid, 16, geometry, args->primID);
    default:
      return ball<any>(b, rays, hits, args->valid, args->N, geometry, args->primID);
  }
}
void occluded(const RTCOccludedFunctionNArguments* args) { dispatch<true>(args, args->ray, nullptr, args->geomID); }
void intersect(const RTCIntersectFunctionNArguments* args) {
  dispatch<false>(args, RTCRayHitN_RayN(args->rayhit, args->N), RTCRayHitN_HitN(args->rayhit, args->N), args->geomID);
}

template <class R>
void set_ray(R& ray, const raycast::Segment& s, bool closest) {
  ray.org_x = static_cast<float>(s.origin.x), ray.org_y = static_cast<float>(s.origin.y), ray.org_z = static_cast<float>(s.origin.z);
  ray.dir_x = static_cast<float>(s.direction.x), ray.dir_y = static_cast<float>(s.direction.y),
  ray.dir_z = static_cast<float>(s.direction.z);
  ray.tnear = 1e-5f, ray.tfar = closest ? std::numeric_limits<float>::infinity() : 1.0f - 1e-5f;
  ray.mask = 0xffffffff, ray.flags = 0, ray.time = 0, ray.id = 0;
}
template <class Packet>
void set_lane(Packet& p, unsigned i, const raycast::Segment& s, bool closest) {
  p.org_x[i] = static_cast<float>(s.origin.x), p.org_y[i] = static_cast<float>(s.origin.y), p.org_z[i] = static_cast<float>(s.origin.z);
  p.dir_x[i] = static_cast<float>(s.direction.x), p.dir_y[i] = static_cast<float>(s.direction.y),
  p.dir_z[i] = static_cast<float>(s.direction.z);
  p.tnear[i] = 1e-5f, p.tfar[i] = closest ? std::numeric_limits<float>::infinity() : 1.0f - 1e-5f;
  p.mask[i] = 0xffffffff, p.flags[i] = 0, p.time[i] = 0, p.id[i] = 0;
}

}  // namespace

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Embree::Embree(const World& world, bool user_spheres) : data_(new Data) {
  data_->device = rtcNewDevice("threads=1,set_affinity=0");
  const double start = cpu_seconds();
  data_->scene = rtcNewScene(data_->device);
  if (!world.triangles.empty()) {
    RTCGeometry mesh = rtcNewGeometry(data_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* v =
        static_cast<float*>(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3 * world.triangles.size()));
    auto* x = static_cast<unsigned*>(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, world.triangles.size()));
    unsigned next = 0;
    for (const auto& t : world.triangles) {
      for (const glm::dvec3& p : t) {
        for (int k = 0; k < 3; ++k) { *v++ = static_cast<float>(p[k]); }
        *x++ = next++;
      }
    }
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(data_->scene, mesh);
    rtcReleaseGeometry(mesh);
  }
  if (!world.balls.empty()) {
    for (const auto& b : world.balls) {
      data_->balls.push_back(
          {static_cast<float>(b.centre.x), static_cast<float>(b.centre.y), static_cast<float>(b.centre.z), static_cast<float>(b.radius)});
    }
    RTCGeometry balls = rtcNewGeometry(data_->device, user_spheres ? RTC_GEOMETRY_TYPE_USER : RTC_GEOMETRY_TYPE_SPHERE_POINT);
    if (user_spheres) {
      rtcSetGeometryUserPrimitiveCount(balls, static_cast<unsigned>(data_->balls.size()));
      rtcSetGeometryUserData(balls, &data_->balls);
      rtcSetGeometryBoundsFunction(balls, bounds, nullptr);
      rtcSetGeometryOccludedFunction(balls, occluded);
      rtcSetGeometryIntersectFunction(balls, intersect);
    } else {
      auto* v = static_cast<std::array<float, 4>*>(
          rtcSetNewGeometryBuffer(balls, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, data_->balls.size()));
      std::copy(data_->balls.begin(), data_->balls.end(), v);
    }
    rtcCommitGeometry(balls);
    rtcAttachGeometry(data_->scene, balls);
    rtcReleaseGeometry(balls);
  }
  rtcCommitScene(data_->scene);
  build_seconds_ = cpu_seconds() - start;
}

Embree::~Embree() {
  rtcReleaseScene(data_->scene);
  rtcReleaseDevice(data_->device);
}

void Embree::run(const Set& set, int width, std::vector<std::uint8_t>& verdicts) const {
  verdicts.resize(set.rays.size());
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (!set.pairs.empty()) { context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT; }
  alignas(64) int valid[16];
  std::fill(valid, valid + 16, -1);
  const auto none = RTC_INVALID_GEOMETRY_ID;
  for (std::size_t at = 0; at < set.rays.size(); at += static_cast<std::size_t>(width)) {
    const auto n = static_cast<unsigned>(width);
    if (set.closest) {
      if (n == 1) {
        RTCRayHit r;
        set_ray(r.ray, set.rays[at].segment, true);
        r.hit.geomID = none, r.hit.instID[0] = none;
        rtcIntersect1(data_->scene, &context, &r);
        verdicts[at] = r.hit.geomID != none;
      } else if (n == 8) {
        RTCRayHit8 r;
        for (unsigned i = 0; i < n; ++i) {
          set_lane(r.ray, i, set.rays[at + i].segment, true), r.hit.geomID[i] = none, r.hit.instID[0][i] = none;
        }
        rtcIntersect8(valid, data_->scene, &context, &r);
        for (unsigned i = 0; i < n; ++i) { verdicts[at + i] = r.hit.geomID[i] != none; }
      } else {
        RTCRayHit16 r;
        for (unsigned i = 0; i < n; ++i) {
          set_lane(r.ray, i, set.rays[at + i].segment, true), r.hit.geomID[i] = none, r.hit.instID[0][i] = none;
        }
        rtcIntersect16(valid, data_->scene, &context, &r);
        for (unsigned i = 0; i < n; ++i) { verdicts[at + i] = r.hit.geomID[i] != none; }
      }
    } else if (n == 1) {
      RTCRay r;
      set_ray(r, set.rays[at].segment, false);
      rtcOccluded1(data_->scene, &context, &r);
      verdicts[at] = r.tfar < 0.0f;
    } else if (n == 8) {
      RTCRay8 r;
      for (unsigned i = 0; i < n; ++i) { set_lane(r, i, set.rays[at + i].segment, false); }
      rtcOccluded8(valid, data_->scene, &context, &r);
      for (unsigned i = 0; i < n; ++i) { verdicts[at + i] = r.tfar[i] < 0.0f; }
    } else {
      RTCRay16 r;
      for (unsigned i = 0; i < n; ++i) { set_lane(r, i, set.rays[at + i].segment, false); }
      rtcOccluded16(valid, data_->scene, &context, &r);
      for (unsigned i = 0; i < n; ++i) { verdicts[at + i] = r.tfar[i] < 0.0f; }
    }
  }
}

}  // namespace bench
