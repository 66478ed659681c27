// SPDX-License-Identifier: MIT
#include "apps/figures/figures.hpp"

#include <algorithm>
#include <numeric>

#include <glm/geometric.hpp>

#include <brep/circulators.hpp>
#include <brep/euler_script_parse.hpp>

#include <radiosity/camera/mesh_picture.hpp>
#include <radiosity/picture/reconstruct.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/run/run.hpp>
#include <radiosity/run/stages.hpp>

#include "apps/euler/outputs.hpp"
#include "apps/explain/recording.hpp"
#include "apps/html_document.hpp"
#include "apps/picture_file.hpp"
#include "apps/scene_file.hpp"
#include "apps/study/drawing.hpp"
#include "apps/text.hpp"
#include "embedded/examples.hpp"
#include "embedded/figures.hpp"

namespace apps::figures {
namespace {

// --- figures 1 and 2: from scripts

std::string svg(double width, double height, const std::string& body) {
  const std::string size = std::to_string(static_cast<int>(width)) + "' height='" + std::to_string(static_cast<int>(height));
  return "<svg xmlns='http://www.w3.org/2000/svg' width='" + size + "' viewBox='0 0 " + std::to_string(static_cast<int>(width)) + " " +
         std::to_string(static_cast<int>(height)) + "'><style>" + euler::drawing_style() +
         "text{font-family:'DejaVu Sans',Verdana,sans-serif}</style>\n<rect width='100%' height='100%' fill='#fff'/>\n" + body + "</svg>\n";
}

// "h12: origin v0, face f2, next h6, prev h1, twin h13"
std::string record(const euler::Records& records, std::uint32_t h) {
  const euler::Records::Halfedge& r = records.halfedges[h];
  const auto n = [](std::uint32_t i) { return std::to_string(i); };
  return "h" + n(h) + ": origin v" + n(r.vertex) + ", face f" + n(r.face) + ", next h" + n(r.next) + ", prev h" + n(r.prev) + ", twin h" +
         n(h ^ 1U);
}

// The last step of a script: its solid in space, if it has coordinates, and its plane map; with `records`, also the records of the
// half-edges of the new edge.
std::string last_step(std::string text, bool records = false) {
  const euler::Coordinates coordinates = euler::take_coordinates(text);
  const euler::Story story = euler::tell(*brep::parse_script(text).script, "");
  const std::vector<euler::Layout> layouts = euler::lay_out(story, 0.034);
  const std::size_t last = story.frames.size() - 1;
  std::string body;
  double left = 0.0;
  if (!coordinates.empty()) {
    body += "<g transform='translate(170 200)'>" + euler::solid_view(story.frames[last], coordinates, 340.0) + "</g>\n";
    left = 340.0;
  }
  body +=
      "<g transform='translate(" + std::to_string(left + 200.0) + " 200)'>" + euler::drawing(story, last, layouts[last], 400.0) + "</g>\n";
  for (std::uint32_t half = 0; records && half < 2; ++half) {
    const std::uint32_t h = story.frames[last].outcome.result.index + half;
    body += "<text x='" + std::to_string(left + 200.0) + "' y='" + std::to_string(420 + 22 * half) +
            "' font-size='14' text-anchor='middle'>" + record(story.frames[last].drawn, h) + "</text>\n";
  }
  return svg(left + 400.0, records ? 460.0 : 400.0, body);
}

// Runs the stages up to the reconstruction; false if there is no solution.
bool solve(radiosity::detail::Run& run) {
  for (const auto next : {radiosity::stage::build, radiosity::stage::refine, radiosity::stage::expose, radiosity::stage::link,
                          radiosity::stage::solve, radiosity::stage::reconstruct}) {
    if (next(run)) { return false; }
  }
  return true;
}

// --- figures 3 to 5: diagrams of what the solver has made of a scene

using study::Drawing;

constexpr study::Srgb blue = 0x0b5bd3, red = 0xc8310f, pale = 0xeef3fb, lit = 0xfff3d6;

study::Shape polygon(std::vector<glm::dvec2> points, study::Srgb fill) {
  return {.points = std::move(points), .closed = true, .filled = true, .fill = fill, .stroke_width = 1.0};
}

void label(Drawing& drawing, const glm::dvec2& at, std::string text, double size = 13.0, study::Srgb color = study::ink,
           study::Anchor anchor = study::Anchor::middle) {
  drawing.add(study::Label{at, std::move(text), size, anchor, color, false, true});
}

void arrow(Drawing& drawing, const glm::dvec2& from, const glm::dvec2& to, study::Srgb color, bool dashed) {
  study::Shape line = study::line(from, to, 1.2, color);
  if (dashed) { line.dashes = {4.0, 3.0}; }
  drawing.add(line);
  const glm::dvec2 d = glm::normalize(to - from), n{-d.y, d.x};
  study::Shape tip = polygon({to, to - 8.0 * d + 3.0 * n, to - 8.0 * d - 3.0 * n}, color);
  tip.stroke_width = 0.0;
  drawing.add(tip);
}

explain::Recording recorded(const std::string& scene, double epsilon) {
  explain::Wanted wanted;
  wanted.epsilon = epsilon;
  wanted.min_area = 0.008;
  wanted.light_epsilon = 1e9;  // so high that only the form factor decides
  return std::move(explain::record(parse_scene(scene).file->scene, "figure", wanted).recording.value());
}

Drawing hierarchy_over_faces(const std::string& scene) {
  const explain::Recording r = recorded(scene, 0.12);
  Drawing drawing{640.0, 460.0, {}};
  const auto mesh_point = [](const glm::dvec3& p) { return glm::dvec2{60.0 + 200.0 * p.x + 60.0 * p.y, 420.0 - 75.0 * p.y}; };
  const auto in_plate = [&](std::uint32_t i) { return r.nodes[i].surface == r.nodes[0].surface; };
  // Leaves are side by side, parents above the middle of their children. Siblings are sorted from left to right like their faces, so that
  // few arrows cross.
  std::vector<glm::dvec2> at(r.nodes.size(), glm::dvec2{0.0});
  std::size_t leaves = 0;
  for (std::uint32_t i = 0; i < r.nodes.size(); ++i) { leaves += in_plate(i) && r.nodes[i].leaf() ? 1 : 0; }
  double x = 30.0;
  const double step = 580.0 / std::max<double>(1.0, static_cast<double>(leaves - 1));
  const auto place = [&](const auto& self, std::uint32_t i, int depth) -> void {
    at[i].y = 40.0 + 62.0 * depth;
    if (r.nodes[i].leaf()) {
      at[i].x = x;
      x += step;
      return;
    }
    const std::uint32_t first = r.nodes[i].first_child, last = first + r.nodes[i].child_count;
    std::vector<std::uint32_t> children(last - first);
    std::iota(children.begin(), children.end(), first);
    std::stable_sort(children.begin(), children.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return mesh_point(r.nodes[a].centre).x < mesh_point(r.nodes[b].centre).x; });
    for (const std::uint32_t c : children) { self(self, c, depth + 1); }
    at[i].x = 0.5 * (at[children.front()].x + at[children.back()].x);
  };
  place(place, 0, 0);
  for (const explain::LeafLoop& leaf : r.leaves) {
    if (!in_plate(leaf.node)) { continue; }
    std::vector<glm::dvec2> corners;
    for (const glm::dvec3& p : leaf.corners) { corners.push_back(mesh_point(p)); }
    drawing.add(polygon(corners, pale));
  }
  for (std::uint32_t i = 0; i < r.nodes.size(); ++i) {
    if (!in_plate(i)) { continue; }
    if (i > 0) { drawing.add(study::line(at[r.nodes[i].parent], at[i], 1.4)); }
    if (r.nodes[i].leaf()) { arrow(drawing, at[i], mesh_point(r.nodes[i].centre), blue, true); }
  }
  for (std::uint32_t i = 0; i < r.nodes.size(); ++i) {
    if (!in_plate(i)) { continue; }
    const glm::dvec2 half{7.0, 7.0};
    study::Shape box = study::rectangle(at[i] - half, at[i] + half, r.nodes[i].leaf() ? lit : study::paper);
    box.stroke_width = 1.4;
    drawing.add(box);
  }
  label(drawing, {20.0, 22.0}, "nodes: centre, normal, area, children", 13.0, study::ink, study::Anchor::start);
  label(drawing, {620.0, 448.0}, "faces of the BRep: corners, neighbours, tags", 13.0, study::ink, study::Anchor::end);
  return drawing;
}

Drawing level_tags(const std::string& scene) {
  const explain::Recording r = recorded(scene, 0.12);
  Drawing drawing{480.0, 480.0, {}};
  const auto place = [](const glm::dvec3& p) { return glm::dvec2{40.0 + 200.0 * p.x, 440.0 - 200.0 * p.y}; };
  for (const explain::LeafLoop& leaf : r.leaves) {
    if (r.nodes[leaf.node].surface != r.nodes[0].surface) { continue; }
    std::vector<glm::dvec2> corners;
    for (const glm::dvec3& p : leaf.corners) { corners.push_back(place(p)); }
    drawing.add(polygon(corners, pale));
    label(drawing, place(r.nodes[leaf.node].centre) + glm::dvec2{0.0, 5.0}, std::to_string(r.levels[leaf.node]), 14.0, blue);
  }
  for (const explain::LeafLoop& leaf : r.leaves) {
    if (r.nodes[leaf.node].surface != r.nodes[0].surface) { continue; }
    for (std::size_t k = 0; k < leaf.corners.size(); ++k) {
      const glm::dvec2 p = place(leaf.corners[k]);
      drawing.add(study::rectangle(p - glm::dvec2{7.0, 8.0}, p + glm::dvec2{7.0, 8.0}, study::paper));
    }
  }
  for (const explain::LeafLoop& leaf : r.leaves) {
    if (r.nodes[leaf.node].surface != r.nodes[0].surface) { continue; }
    for (std::size_t k = 0; k < leaf.corners.size(); ++k) {
      const bool t = leaf.t_vertex[k];
      const glm::dvec2 p = place(leaf.corners[k]);
      if (t) {  // beside the T-vertex, within the leaf for which it is one
        const glm::dvec2 in = glm::normalize(place(r.nodes[leaf.node].centre) - p);
        label(drawing, p + 16.0 * in + glm::dvec2{0.0, 4.0}, "T", 12.0, red);
      }
      label(drawing, p + glm::dvec2{0.0, 5.0}, std::to_string(leaf.levels[k]), 13.0);
    }
  }
  label(drawing, {240.0, 470.0}, "black: levels of vertices; blue: of faces; red: T-vertices of the face beside", 12.0);
  return drawing;
}

Drawing weights_at_a_rim(const std::string& scene) {
  const SceneFile file = std::move(*parse_scene(scene).file);
  const radiosity::Options options{.epsilon = 1.0, .light_epsilon = 1e9, .audit_points = 0, .threads = 1};
  radiosity::detail::Run run{file.scene, options, {}, {}};
  if (!solve(run)) { return {}; }
  // Finds the rim's vertex nearest to the eye, then the half-edges that leave it, one per face.
  const radiosity::SurfaceBRep& brep = run.scene.surfaces[0].brep;
  const auto nearness = [&](brep::VertexId v) {
    const glm::dvec3 p = run.scene.frame.to_scene(brep.data(v).position);
    return p.z - 0.4 * p.y - 0.1 * p.x;
  };
  brep::VertexId best{0};
  for (const brep::VertexId v : brep::vertices(brep)) {
    if (nearness(v) > nearness(best)) { best = v; }
  }
  Drawing drawing{640.0, 420.0, {}};
  const glm::dvec2 v_at{250.0, 200.0};
  const glm::dvec3 middle = run.scene.frame.to_scene(brep.data(best).position);
  const auto place = [&](const glm::dvec3& q) {
    const glm::dvec3 d = run.scene.frame.to_scene(q) - middle;
    return v_at + glm::dvec2{620.0 * (d.x + 0.25 * d.y), -620.0 * (0.55 * d.y + 0.6 * d.z)};
  };
  brep::HalfedgeId of = brep.halfedge(best);  // a half-edge on the top
  for (const brep::HalfedgeId h : brep::halfedges_from(brep, best)) {
    if (brep.data(h).normal.z > brep.data(of).normal.z) { of = h; }
  }
  for (const brep::HalfedgeId h : brep::halfedges_from(brep, best)) {
    std::vector<glm::dvec2> corners;
    glm::dvec2 towards{0.0};
    for (const brep::HalfedgeId k : brep::halfedges_of(brep, brep.face(h))) {
      corners.push_back(place(brep.data(brep.vertex(k)).position));
    }
    const double weight = std::max(0.0, glm::dot(brep.data(of).normal, brep.data(h).normal));
    for (const glm::dvec2& p : corners) { towards += p / static_cast<double>(corners.size()); }
    drawing.add(polygon(corners, weight > 0.5 ? lit : pale));
    const glm::dvec2 text = glm::mix(v_at, towards, std::min(1.0, 110.0 / glm::length(towards - v_at)));
    label(drawing, text, "weight " + formatted("%.2f", weight), 14.0, weight > 0.5 ? study::ink : blue);
  }
  for (const brep::HalfedgeId h : brep::halfedges_from(brep, best)) {
    arrow(drawing, v_at, place(brep.data(best).position + 0.16 * brep.data(h).normal), red, false);
  }
  label(drawing, v_at + glm::dvec2{8.0, 14.0}, "v", 15.0, study::ink, study::Anchor::start);
  label(drawing, {320.0, 408.0}, "red: the normals that the half-edges leaving v carry; weights are those of a half-edge on the top", 13.0);
  return drawing;
}

// --- figures 6 to 8

// One solution, reconstructed simply and with weights, as the bytes of two PNGs of this size.
struct Pictures {
  std::string simple, weighted;
};
Pictures both_reconstructions(const std::string& scene, unsigned width, unsigned height, double epsilon) {
  const SceneFile file = std::move(*parse_scene(scene).file);
  const radiosity::Options options{.epsilon = epsilon, .min_area = 2e-4, .audit_points = 0, .threads = 1};
  radiosity::detail::Run run{file.scene, options, {}, {}};
  if (!solve(run)) { return {}; }
  radiosity::Mesh weighted = run.picture(run.solution.radiosity, radiosity::Reconstruction::weighted);
  radiosity::Mesh simple = run.picture(run.solution.radiosity, radiosity::Reconstruction::simple);
  radiosity::detail::to_scene(weighted, run.scene.frame);
  radiosity::detail::to_scene(simple, run.scene.frame);
  const radiosity::View view =
      radiosity::make_view(file.cameras.empty() ? radiosity::automatic_camera(file.scene) : file.cameras.front(), {width, height});
  const radiosity::Tone tone{radiosity::automatic_exposure(weighted, file.scene, view), radiosity::ToneCurve::linear};
  return {to_png(*draw(simple, view, tone), tone), to_png(*draw(weighted, view, tone), tone)};
}

std::string pictures(const std::vector<std::string>& pngs, unsigned width, unsigned height) {
  study::Drawing drawing{static_cast<double>(width) * static_cast<double>(pngs.size()) + 8.0 * static_cast<double>(pngs.size() - 1),
                         static_cast<double>(height),
                         {}};
  double x = 0.0;
  for (const std::string& png : pngs) {
    drawing.add(study::Image{{x, 0.0}, static_cast<double>(width), static_cast<double>(height), png});
    x += width + 8.0;
  }
  return study::to_svg_file(drawing, "a picture of a solution");
}

}  // namespace

std::vector<Figure> make() {
  const Pictures close = both_reconstructions(embedded::example("scenes/paper_figure.scene"), 240, 210, 0.02);
  const Pictures room = both_reconstructions(embedded::example("scenes/room.scene"), 360, 270, 0.05);
  return {
      {"figure1.svg", "euler/010_cube.euler",
       "A cube, and the same cube in the plane: the bottom face is pulled wide open and everything else is spread within it. Vertices, "
       "edges and faces keep their names, and no two edges cross.",
       last_step(embedded::example("euler/010_cube.euler"))},
      {"figure2.svg", "figures/2_winged_edge.euler",
       "The halves of one edge, red. Each runs on the side of its own face and knows its origin, its face, its twin, and the half-edges "
       "before and behind it along the face; so all neighbours are one step away.",
       last_step(embedded::example("figures/2_winged_edge.euler"), true)},
      {"figure3.svg", "figures/3_hierarchy.scene",
       "The hierarchy stands on the BRep. Nodes hold centre, normal and area; a leaf knows its face (dashed), and the faces know corners "
       "and neighbours. When a leaf is split, its face is split by Euler operators and the leaf becomes an inner node.",
       study::to_svg_file(hierarchy_over_faces(embedded::example("figures/3_hierarchy.scene")), "a tree over the faces of a mesh")},
      {"figure4.svg", "figures/3_hierarchy.scene",
       "Level tags. A vertex has the level of the split that made it; a face of level l has corners of level l or less. A vertex of higher "
       "level on its border is a T-vertex and serves as the anchor of the next split.",
       study::to_svg_file(level_tags(embedded::example("figures/3_hierarchy.scene")), "a mesh with the levels of its vertices and faces")},
      {"figure5.svg", "figures/5_weights.scene",
       "Weighted reconstruction at a vertex on the rim of a cylinder: for the colour of one half-edge every face around the vertex counts "
       "by max(0, N_e . N_l). On the top all normals agree, the side counts nothing, and the edge stays sharp.",
       study::to_svg_file(weights_at_a_rim(embedded::example("figures/5_weights.scene")), "weights of the faces around a vertex on a rim")},
      {"figure6.svg", "scenes/paper_figure.scene",
       "A cylinder under a superquadric that shadows itself, reconstructed simply (left) and with weights (right): left the side's "
       "darkness bleeds over the rim into the top.",
       pictures({close.simple, close.weighted}, 240, 210)},
      {"figure7.svg", "scenes/room.scene",
       "A room reconstructed simply: colours bleed across every edge of an object, and foot and rim of the cylinder wear wrong shades.",
       pictures({room.simple}, 360, 270)},
      {"figure8.svg", "scenes/room.scene",
       "The same solution with weights: smooth over the sphere and around the cylinder, sharp at edges.",
       pictures({room.weighted}, 360, 270)},
  };
}

std::string page(const std::vector<Figure>& figures) {
  std::string out =
      "\n<h1>The figures of the paper</h1>\n<p>After Bendels, Fellner, Sch\xc3\xa4"
      "fer: Hierarchical Radiosity on Topological Data Structures, 1996. Each is made by this program from the file that is named.</p>\n";
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const Figure& figure = figures[i];
    const std::string number = std::to_string(i + 1);
    out += "<figure><img src='" + figure.file + "' alt='figure " + number + "'><figcaption><b>Figure " + number + ".</b> " +
           escaped(figure.caption) + " <code>examples/" + figure.source + "</code></figcaption></figure>\n";
  }
  return html_document("The figures of the paper", embedded::figures_page_css, out);
}

}  // namespace apps::figures
