// SPDX-License-Identifier: MIT
#include "apps/figures/figures.hpp"

#include <brep/euler_script_parse.hpp>

#include <radiosity/camera/mesh_picture.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/run/stages.hpp>

#include "apps/euler/outputs.hpp"
#include "apps/euler/solid_view.hpp"
#include "apps/html_document.hpp"
#include "apps/picture_file.hpp"
#include "apps/scene_file.hpp"
#include "apps/study/svg.hpp"
#include "embedded/examples.hpp"
#include "embedded/figures.hpp"

namespace apps::figures {
namespace {

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

// The last step of a script: its solid in space, where it has coordinates, and its plane map; below, when asked for, what the halves of the
// new edge know.
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

std::string diagram(const study::Drawing& drawing, const char* what) { return study::to_svg_file(drawing, what); }

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

bool solve(radiosity::detail::Run& run) {
  for (const auto next : {radiosity::stage::build, radiosity::stage::refine, radiosity::stage::expose, radiosity::stage::link,
                          radiosity::stage::solve, radiosity::stage::reconstruct}) {
    if (next(run)) { return false; }
  }
  return true;
}

Pictures both_reconstructions(const std::string& scene, unsigned width, unsigned height, double epsilon) {
  const SceneFile file = std::move(*parse_scene(scene).file);
  radiosity::Options options;
  options.epsilon = epsilon;
  options.min_area = 2e-4;
  options.audit_points = 0;
  options.threads = 1;
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
       diagram(hierarchy_over_faces(embedded::example("figures/3_hierarchy.scene")), "a tree over the faces of a mesh")},
      {"figure4.svg", "figures/3_hierarchy.scene",
       "Level tags. A vertex has the level of the split that made it; a face of level l has corners of level l or less. A vertex of higher "
       "level on its border is a T-vertex and serves as the anchor of the next split.",
       diagram(level_tags(embedded::example("figures/3_hierarchy.scene")), "a mesh with the levels of its vertices and faces")},
      {"figure5.svg", "figures/5_weights.scene",
       "Weighted reconstruction at a vertex on the rim of a cylinder: for the colour of one half-edge every face around the vertex counts "
       "by max(0, N_e . N_l). On the top all normals agree, the side counts nothing, and the edge stays sharp.",
       diagram(weights_at_a_rim(embedded::example("figures/5_weights.scene")), "weights of the faces around a vertex on a rim")},
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
