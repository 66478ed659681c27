// SPDX-License-Identifier: MIT
// Plots of a study: fits, fronts and axes by their laws.
#include "catch.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include <glm/geometric.hpp>

#include "apps/study/log_axis.hpp"
#include "apps/study/numbers.hpp"
#include "apps/study/plot.hpp"
#include "apps/study/verdicts.hpp"
#include "markup.hpp"

namespace {

using namespace study;
constexpr double unmeasured = std::numeric_limits<double>::quiet_NaN();

std::vector<CostPoint> power_law(double factor, double exponent, int count) {
  std::vector<CostPoint> points;
  for (int i = 0; i < count; ++i) {
    const double cost = 0.01 * std::pow(3.0, i);
    points.push_back({cost, factor * std::pow(cost, exponent), false});
  }
  return points;
}

std::vector<Curve> two_curves() {
  std::vector<Curve> curves = {{"coarse & cheap", curve_style(0), power_law(0.01, -0.5, 5), {}},
                               {"fine", curve_style(1), power_law(0.003, -0.7, 5), {}}};
  curves[1].points[4] = {curves[1].points[4].cost, 0.002, true};
  curves[0].titles = {"first <b>", "", "", "", ""};
  return curves;
}

}  // namespace

TEST_CASE("least squares find the exponent of a power law, whatever its size, and leave out what noise limits") {
  // Rounding of log and sums: a few ulp of the logarithms, whose size is below 60 here.
  for (const double exponent : {-1.0, -0.5, 0.0, 0.3}) {
    for (const double factor : {1e-12, 0.01, 1e9}) {
      std::vector<CostPoint> points = power_law(factor, exponent, 6);
      points.push_back({100.0, factor, true});
      points.push_back({unmeasured, 1.0, false});
      points.push_back({1.0, 0.0, false});
      const auto law = fit_power_law(points);
      REQUIRE(law);
      CHECK(law->exponent == test::Approx(exponent).margin(1e-12));
      CHECK(law->factor == test::Approx(factor).epsilon(1e-12));
      CHECK(law->deviation < 1e-12);
      CHECK(law->points == 6);
    }
  }
}

TEST_CASE("a slope needs three points of different cost") {
  CHECK_FALSE(fit_power_law({}));
  CHECK_FALSE(fit_power_law(power_law(1.0, -1.0, 2)));
  CHECK(fit_power_law(power_law(1.0, -1.0, 3)));
  CHECK_FALSE(fit_power_law({{1.0, 1.0, false}, {1.0, 2.0, false}, {1.0, 3.0, false}}));
  CHECK_FALSE(fit_power_law({{1.0, 1.0, false}, {2.0, 0.5, false}, {4.0, 0.2, true}}));
}

TEST_CASE("the fit's standard error covers the true exponent as often as it should") {
  std::mt19937 random(11);
  INFO("seed 11");
  std::normal_distribution<double> noise(0.0, 0.2);
  int covered = 0;
  constexpr int runs = 400;
  for (int run = 0; run < runs; ++run) {
    std::vector<CostPoint> points = power_law(0.01, -0.5, 12);
    for (CostPoint& p : points) { p.error *= std::exp(noise(random)); }
    const auto law = fit_power_law(points);
    covered += std::abs(law->exponent + 0.5) <= 2.228 * law->deviation ? 1 : 0;  // Student's t, 10 degrees of freedom, 95 %
  }
  // Binomial: 380 expected, standard deviation 4.4; 5 of them.
  CHECK(covered > 358);
  CHECK(covered < 400);
}

TEST_CASE("no point beats a point of the Pareto front, and every other point is beaten or equalled by one") {
  std::mt19937 random(5);
  INFO("seed 5");
  for (int run = 0; run < 100; ++run) {
    std::vector<CostPoint> points;
    for (int i = 0; i < 30; ++i) {
      points.push_back({1.0 + static_cast<double>(random() % 12), 1.0 + static_cast<double>(random() % 12), false});
    }
    points.push_back({unmeasured, 0.1, false});
    points.push_back({0.5, unmeasured, false});
    const std::vector<std::size_t> front = pareto_front(points);
    const auto beats = [&](const CostPoint& a, const CostPoint& b) {
      return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
    };
    for (std::size_t i = 0; i < 30; ++i) {
      const bool on_front = std::find(front.begin(), front.end(), i) != front.end();
      bool beaten = false;
      bool met = false;
      for (std::size_t j = 0; j < 30; ++j) { beaten = beaten || beats(points[j], points[i]); }
      for (const std::size_t j : front) { met = met || (points[j].cost <= points[i].cost && points[j].error <= points[i].error); }
      CHECK(met);
      CHECK_FALSE((on_front && beaten));
    }
    for (std::size_t k = 1; k < front.size(); ++k) {
      CHECK(points[front[k]].cost > points[front[k - 1]].cost);
      CHECK(points[front[k]].error < points[front[k - 1]].error);
    }
    CHECK(std::find(front.begin(), front.end(), 30U) == front.end());
  }
  CHECK(pareto_front({}).empty());
  CHECK(pareto_front({{1.0, 2.0, false}, {1.0, 2.0, false}}) == std::vector<std::size_t>{0});
}

TEST_CASE("an axis holds its values, and has at least two labels over any range") {
  std::mt19937 random(3);
  INFO("seed 3");
  for (int run = 0; run < 300; ++run) {
    const double low = std::pow(10.0, -9.0 + 0.06 * run);
    const double high = low * std::pow(10.0, 12.0 * static_cast<double>(random()) / 4294967296.0 * (run % 4 == 0 ? 0.01 : 1.0));
    CAPTURE(low, high);
    const LogAxis axis(low, high);
    CHECK(axis.place(low) >= 0.0);
    CHECK(axis.place(high) <= 1.0);
    CHECK(axis.place(std::sqrt(low * high)) == test::Approx(0.5));
    int labels = 0;
    const double room = 0.15;  // 1 2 5 of two decades need .301 / 2
    double last = -1.0;
    for (const Tick& tick : axis.ticks(room)) {
      CHECK(axis.place(tick.value) >= 0.0);
      CHECK(axis.place(tick.value) <= 1.0);
      if (!tick.labelled) { continue; }
      ++labels;
      CHECK(axis.place(tick.value) - last >= room * (1.0 - 1e-9));
      last = axis.place(tick.value);
    }
    CHECK(labels >= 2);
    CHECK(labels <= 7);
  }
}

TEST_CASE("numbers say no more digits than they have, and what was not measured is a dash") {
  CHECK(percent(0.0123) == "1.23 %");
  CHECK(percent(0.1) == "10 %");
  CHECK(percent(0.000002) == "0.0002 %");
  CHECK(percent(12.0) == "1200 %");
  CHECK(percent(unmeasured) == "–");
  CHECK(figure(0.012345) == "0.0123");
  CHECK(figure(0.9996) == "1.000");
  CHECK(figure(12.345) == "12.3");
  CHECK(figure(98765.0) == "98765");
  CHECK(figure(unmeasured) == "–");
  CHECK(signed_number(-0.5) == "−0.50");
  CHECK(signed_number(-0.001) == "0.00");
  CHECK(fixed(-0.001, 2) == "0.00");
  CHECK(bytes_text(999) == "999 B");
  CHECK(bytes_text(12300000) == "12.3 MB");
  CHECK(count_text(9876) == "9\u202f876");
  CHECK(count_text(1234567) == "1.23 M");
  CHECK(short_number(0.01) == "0.01");
  CHECK(short_number(10000.0) == "10 k");
}

TEST_CASE("styles: any two of 63 differ in colour or mark, the first seven in both") {
  std::set<std::pair<Srgb, Mark>> seen;
  for (std::size_t i = 0; i < 63; ++i) { CHECK(seen.emplace(curve_style(i).color, curve_style(i).mark).second); }
  for (std::size_t i = 0; i < 7; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      CHECK((curve_style(i).color != curve_style(j).color && curve_style(i).mark != curve_style(j).mark));
    }
  }
}

TEST_CASE("a plot's SVG is well-formed, whatever the names, and its marks stand where their values fall") {
  const std::vector<Curve> curves = two_curves();
  constexpr double noise = 0.002;
  const Drawing drawing = plot({"title <&> \"quoted\"", "cost", "error"}, curves, noise);
  const std::string svg = to_svg_file(drawing, "a plot's \"description\" <b>");
  CHECK(markup::fault(svg).empty());
  CHECK(svg.find("first &lt;b&gt;") != std::string::npos);
  CHECK(svg.find("coarse &amp; cheap") != std::string::npos);
  CHECK(svg.find("slope −0.50 ± 0.00") != std::string::npos);
  CHECK(svg.find("slope −0.70 ± 0.00") != std::string::npos);

  // Known places: the frame's corners are the ends of the axes, and logarithms are linear between them.
  const PlotFrame frame(curves, noise);
  CHECK(glm::distance(frame.at(frame.cost_low, frame.error_low), {frame.left, frame.bottom()}) < 1e-9);
  CHECK(glm::distance(frame.at(frame.cost_high, frame.error_high), {frame.right(), frame.top}) < 1e-9);
  const glm::dvec2 a = frame.at(0.1, 0.01);
  const glm::dvec2 b = frame.at(0.2, 0.01);
  const glm::dvec2 c = frame.at(0.4, 0.005);
  CHECK(c.x - b.x == test::Approx(b.x - a.x));
  CHECK(c.y > b.y);

  // Marks are the closed shapes in a curve's colour (hollow ones: with a line in it): one centre for each point.
  for (const Curve& curve : curves) {
    for (const CostPoint& p : curve.points) {
      int full = 0;
      int hollow = 0;
      for (const auto& item : drawing.items) {
        const auto* shape = std::get_if<Shape>(&item);
        if (shape == nullptr || !shape->closed || shape->points.size() != mark_outline(curve.style.mark, {}, 1.0).size()) { continue; }
        glm::dvec2 centre(0.0);
        for (const glm::dvec2& q : shape->points) { centre += q / static_cast<double>(shape->points.size()); }
        if (glm::distance(centre, frame.at(p.cost, p.error)) > 1e-6) { continue; }
        full += shape->fill == curve.style.color ? 1 : 0;
        hollow += shape->fill == paper && shape->stroke == curve.style.color ? 1 : 0;
      }
      CHECK(full == (p.limited ? 0 : 1));
      CHECK(hollow == (p.limited ? 1 : 0));
    }
  }
}

TEST_CASE("the width of a text is that of its characters, however many bytes they have, what is broken has a width, too") {
  CHECK(text_width("", 10.0) == 0.0);
  CHECK(text_width("ab", 10.0) == test::Approx(text_width("a", 10.0) + text_width("b", 10.0)));
  CHECK(text_width("ab", 20.0) == test::Approx(2.0 * text_width("ab", 10.0)));
  CHECK(text_width("−×", 10.0) == test::Approx(2.0 * text_width("+", 10.0)));
  for (char c = ' '; c <= '~'; ++c) { CHECK(text_width(std::string(1, c), 10.0) > 1.9); }  // the least is the apostrophe's, .191
  for (const char* broken : {"\xff", "\xe2\x82"}) { CHECK(text_width(broken, 10.0) > 0.0); }
}

TEST_CASE("plots of nothing and of one point are drawn, too") {
  const Curve none{"none", curve_style(0), {}, {}};
  const Curve one{"one", curve_style(1), {{2.0, 0.5, false}}, {}};
  for (const auto& curves : {std::vector<Curve>{}, {none}, {none, one}}) {
    CHECK(markup::fault(to_svg(plot({"t", "c", "e"}, curves, 0.0), "")).empty());
    CHECK(markup::fault(to_svg(panels({"t", "c", "e"}, {{"p", curves}}, 0.0), "")).empty());
  }
  CHECK(to_svg(plot({"t", "c", "e"}, {none, one}, 0.0), "").find("no result") != std::string::npos);
  CHECK(markup::fault(to_svg(panels({"t", "c", "e"}, {}, 0.01), "")).empty());
}
