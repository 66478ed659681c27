// SPDX-License-Identifier: MIT
#include <radiosity/rays/view_importance.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/bundle.hpp>
#include <raycast/scene.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/rays/senders.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

namespace detail {

// One call of view_importance(). Casters are identified by their index in `views`.
class ViewedCasters {
 public:
  ViewedCasters(const DiscreteScene& scene, const std::vector<CasterView>& views, const std::vector<double>& direct)
      : scene_{scene}, views_{views}, direct_{direct}, at_(scene.hierarchy.size(), no_node) {
    for (std::uint32_t k = 0; k < views.size(); ++k) { at_[views[k].node] = k; }
    for (std::size_t i = 0; i < at_.size(); ++i) {  // parents before children
      const std::uint32_t parent = scene.hierarchy[i].parent;
      if (at_[i] == no_node && parent != no_node) { at_[i] = at_[parent]; }
    }
  }

  [[nodiscard]] ViewImportance operator()(const Viewpoint& from) {
    std::vector<double> seen = seen_shares(from);
    const double in_view = sum_over_area(seen);
    if (in_view > 0.0) {
      for (double& of_caster : seen) { of_caster /= in_view; }
    }
    reflect(seen);
    ViewImportance result;
    result.brightness = brightness_of_nodes();
    double area = 0.0;
    double square = 0.0;
    for (std::size_t k = 0; k < views_.size(); ++k) {
      const double reflected = reflected_of(k);
      area += area_of(k);
      square += area_of(k) * reflected * reflected;
    }
    result.reflected = area > 0.0 ? std::sqrt(square / area) : 0.0;
    result.weight.assign(scene_.hierarchy.size(), 1.0);
    double taken = 0.0;
    double picture = 0.0;  // squared norm of the reflected light in the picture
    for (std::size_t k = 0; k < views_.size(); ++k) {
      if (!(views_[k].reflectance > 0.0)) { continue; }
      taken += area_of(k) * seen[k];
      picture += area_of(k) * seen[k] * reflected_of(k) * reflected_of(k);
    }
    if (!(picture > 0.0)) { return result; }
    result.pictured = std::sqrt(picture / taken);
    const std::vector<double> sent = sent_shares(seen);
    for (std::size_t i = 0; i < at_.size(); ++i) {
      const std::uint32_t k = at_[i];
      if (k != no_node) { result.weight[i] = std::clamp(share * 0.5 * (seen[k] + sent[k]) * square / picture, 1.0, most_weight); }
    }
    // A node above casters gets the largest weight of its children.
    for (std::size_t i = at_.size(); i-- > 0;) {
      const std::uint32_t parent = scene_.hierarchy[i].parent;
      if (parent != no_node && at_[parent] == no_node) { result.weight[parent] = std::max(result.weight[parent], result.weight[i]); }
    }
    return result;
  }

 private:
  // A picture averages over what its points see, which removes most of the errors of single casters. With 1 instead of this value,
  // pictures of rooms behind windows have an error of 4.2 instead of 4.7 % and take twice the time.
  static constexpr double share = 0.4;
  // Under a roof of six metres on a plain of four kilometres weights reach 1e6. A keyhole needs no lower limit, because it takes little
  // of the picture.
  static constexpr double most_weight = 1e8;
  // Share of the squared error of a caster that is the same all over its input face, found by measurement. With ten times this value,
  // labyrinths take twice the time, and their last cells get the same light within some 4 %.
  static constexpr double errors_alike = 0.0075;
  static constexpr int least_reflections = 8, most_reflections = 512;
  static constexpr double little_added = 0.02, least_added = 1e-6;  // by one reflection: to the picture; to all while the picture is dark

  [[nodiscard]] double area_of(std::size_t k) const { return scene_.exposure.area[views_[k].node]; }
  [[nodiscard]] double reflected_of(std::size_t k) const {
    const std::uint32_t node = views_[k].node;
    return direct_[node] - brightest(scene_.emission[scene_.hierarchy[node].surface]) + indirect_[k];
  }

  // The light that is reflected more than once, by Jacobi iterations over the views, until one reflection more adds little to what the
  // camera sees: behind corners of white walls that takes hundreds. For weights that is good enough, though at a reflectance of .97 a third
  // of it may be missing. `seen`: share of what the camera sees, by unit of area.
  void reflect(const std::vector<double>& seen) {
    indirect_.assign(views_.size(), 0.0);
    std::vector<double> next(views_.size(), 0.0);
    const double in_view = sum_over_area(seen);
    for (int k = 0; k < most_reflections; ++k) {
      double in_picture = 0.0, added_in_picture = 0.0, in_all = 0.0, added_in_all = 0.0;
      for (std::size_t c = 0; c < views_.size(); ++c) {
        double sum = 0.0;
        for (const CasterView::Seen& ray : views_[c].rays) {
          if (ray.leaf == no_node) { continue; }
          sum += direct_[ray.leaf] + (at_[ray.leaf] != no_node ? indirect_[at_[ray.leaf]] : 0.0);
        }
        next[c] = views_[c].reflectance * sum / static_cast<double>(views_[c].rays.size());
        const double added = area_of(c) * (next[c] - indirect_[c]), all = area_of(c) * reflected_of(c);
        in_picture += seen[c] * all;
        added_in_picture += seen[c] * added;
        in_all += all;
        added_in_all += added;
      }
      indirect_.swap(next);
      const bool reached = in_picture > 0.0 || !(in_view > 0.0) || added_in_all <= least_added * in_all;
      if (k + 1 >= least_reflections && reached && added_in_picture <= little_added * in_picture) { return; }
    }
  }

  // Above casters it is the area average.
  [[nodiscard]] std::vector<double> brightness_of_nodes() const {
    const Hierarchy& hierarchy = scene_.hierarchy;
    std::vector<double> brightness(hierarchy.size(), 0.0);
    for (std::size_t i = hierarchy.size(); i-- > 0;) {  // children before parents
      if (at_[i] != no_node) { brightness[i] = direct_[i] + indirect_[at_[i]]; }
      const std::uint32_t parent = hierarchy[i].parent;
      const double area = parent != no_node ? scene_.exposure.area[parent] : 0.0;
      if (area > 0.0 && at_[parent] == no_node) { brightness[parent] += scene_.exposure.area[i] / area * brightness[i]; }
    }
    return brightness;
  }

  // By caster: what a unit of its area takes of the picture, in the unit of Viewpoint::share; the mean over 16 points.
  [[nodiscard]] std::vector<double> seen_shares(const Viewpoint& from) const {
    const glm::dvec3 eye = (from.eye - scene_.frame.centre) * scene_.frame.scale;
    std::vector<double> shares(views_.size(), 0.0);
    parallel_for(views_.size(), scene_.threads, [&](std::size_t k) {
      const std::uint32_t node = views_[k].node;
      const Patch& patch = scene_.patches[node];
      const std::uint32_t object = scene_.hierarchy[node].object;
      raycast::Segments16 to_eye;
      std::array<double, 16> seen{};
      for (std::uint32_t i = 0; i < 16; ++i) {
        const glm::dvec3 x = sample(patch, (i % 4 + 0.5) / 4.0, (i / 4 + 0.5) / 4.0);
        seen[i] = from.share(scene_.frame.to_scene(x), patch.normal);
        if (seen[i] > 0.0) { to_eye.set(i, {x, eye - x}, object, raycast::no_object, scene_.view().sheet(node)); }
      }
      std::uint32_t hint = raycast::no_shape;
      const std::uint32_t hidden = scene_.objects.occluded16(to_eye, hint);
      for (std::uint32_t i = 0; i < 16; ++i) { shares[k] += (hidden >> i & 1u) == 0 ? seen[i] / 16.0 : 0.0; }
    });
    return shares;
  }

  // By caster: the share of the picture that comes from light sent by a unit of its area. It is the larger of two. Light reflected once:
  // the rays of casters that the camera sees tell which casters light them. Light reflected any number of times arrives everywhere in the
  // picture; there, errors that all casters of an input face have in common add up, so their square counts by the share of a caster times
  // that of its face (errors_alike).
  [[nodiscard]] std::vector<double> sent_shares(const std::vector<double>& seen) const {
    const std::vector<double> once = sent_once(seen);
    std::vector<double> all = once, last = once;
    double total = sum_over_area(once);
    for (int k = 1; k < most_reflections; ++k) {
      last = sent_once(last);
      const double added = sum_over_area(last);
      total += added;
      for (std::size_t c = 0; c < all.size(); ++c) { all[c] += last[c]; }
      if (!(added > little_added * total)) { break; }
    }
    std::vector<double> of_surface(scene_.inputs.size(), 0.0);
    for (std::size_t c = 0; c < all.size(); ++c) { of_surface[surface_of(c)] += area_of(c) * all[c]; }
    for (std::size_t c = 0; c < all.size(); ++c) { all[c] = std::max(once[c], errors_alike * all[c] * of_surface[surface_of(c)]); }
    return all;
  }

  // What arrives at casters after one reflection more, if light is followed backwards.
  [[nodiscard]] std::vector<double> sent_once(const std::vector<double>& shares) const {
    std::vector<double> sent(views_.size(), 0.0);
    for (std::size_t c = 0; c < views_.size(); ++c) {
      const double each = area_of(c) * shares[c] * views_[c].reflectance / static_cast<double>(views_[c].rays.size());
      if (!(each > 0.0)) { continue; }
      for (const CasterView::Seen& by_ray : views_[c].rays) {
        const std::uint32_t to = by_ray.leaf != no_node ? at_[by_ray.leaf] : no_node;
        if (to != no_node && area_of(to) > 0.0) { sent[to] += each / area_of(to); }
      }
    }
    return sent;
  }
  [[nodiscard]] double sum_over_area(const std::vector<double>& shares) const {
    double sum = 0.0;
    for (std::size_t c = 0; c < shares.size(); ++c) { sum += area_of(c) * shares[c]; }
    return sum;
  }
  [[nodiscard]] std::uint32_t surface_of(std::size_t k) const { return scene_.hierarchy[views_[k].node].surface; }

  const DiscreteScene& scene_;
  const std::vector<CasterView>& views_;
  const std::vector<double>& direct_;
  std::vector<std::uint32_t> at_;  // by node: the caster at or above it
  std::vector<double> indirect_;   // by caster
};

}  // namespace detail

HALFLIGHT_INLINE ViewImportance view_importance(const DiscreteScene& scene, const std::vector<CasterView>& views,
                                                const std::vector<double>& direct, const Viewpoint& from) {
  return detail::ViewedCasters{scene, views, direct}(from);
}

}  // namespace radiosity
