// The conductor CARDINAL 54/7 at 40 kN against the published curve (Foti and Martinelli 2016).
#include "tests/strain/strand_bending.h"

#include <Eigen/LU>
#include <cmath>
#include <utility>

#include "pipeline/base/constants.h"
#include "tests/catch.h"
#include "tests/strain/strand_contact.h"

using namespace dresslife;
using namespace dresslife::strain;

namespace {

constexpr double tension = 40e3, friction = 0.7;

const std::vector<std::pair<double, double>> published{
    {.003472, 5.495}, {.008331, 13.05}, {.013206, 22.81}, {.016678, 28.30}, {.049113, 50.84}, {.060827, 56.47},
    {.071149, 59.36}, {.084908, 62.66}, {.102789, 66.10}, {.122727, 69.13}, {.142665, 72.15}, {.168093, 74.50},
    {.196953, 76.43}, {.238861, 78.36}, {.304804, 79.62}, {.368003, 81.42}, {.428452, 82.81}, {.500581, 84.89}};

/// 1 + 6 steel wires of 3.34 mm, 12, 18, 24 aluminium wires of 3.32 mm, lay length 0.5 m.
Strand cardinal(double lay_length = 0.5) {
  Strand strand;
  strand.tension = tension;
  strand.friction = friction;
  const double steel = 3.34e-3, aluminium = 3.32e-3;
  double radius = 0;
  const int counts[] = {1, 6, 12, 18, 24};
  for (int k = 0; k < 5; ++k) {
    if (k > 0) radius += k == 1 ? steel : k == 2 ? (steel + aluminium) / 2 : aluminium;
    strand.layers.push_back({counts[k], (k < 2 ? steel : aluminium) / 2, k < 2 ? 207e9 : 68e9, radius,
                             std::atan(2 * pi * radius / lay_length)});
  }
  return strand;
}

/// Returns the largest relative difference from the published curve, from its point `first` on.
template <class Bending>
double largest_error(Bending bending, std::size_t first) {
  double worst = 0;
  for (std::size_t k = 0; k < published.size(); ++k) {
    const double moment = bending.moment(published[k].first);
    if (k >= first) worst = std::max(worst, std::abs(moment / published[k].second - 1));
  }
  return worst;
}

}  // namespace

TEST_CASE("CARDINAL: slipped and stuck bending stiffness as published") {
  const StrandBending bending(cardinal());
  constexpr double printed = 2e-3;  // of numbers with three and four digits
  CHECK(bending.slipped_stiffness() == Approx(30.5).epsilon(printed));
  CHECK(bending.stuck_stiffness() == Approx(1964).epsilon(printed));
}

TEST_CASE("CARDINAL: the published moment over curvature") {
  // The first two points have a slope of 1570 N m2, below the published stuck stiffness of 1964: a model whose wires stick
  // rigidly cannot reproduce them. From the third point on the largest difference is 12 %, at the fourth point, where layers
  // change from sticking to sliding.
  constexpr double changing = 0.13, sliding = 0.035;
  CHECK(largest_error(StrandBending(cardinal()), 2) < changing);
  CHECK(largest_error(StrandBending(cardinal()), 12) < sliding);
  CHECK(largest_error(StrandBending(cardinal()), 0) > 0.24);
}

TEST_CASE("CARDINAL: with contacts that give, every point of the published curve") {
  using enum StrandContact::Contacts;
  // The largest difference is 12 %, at the fourth point. The first two points differ by 9 and 10 %; with rigid sticking by 24
  // and 25 %.
  constexpr double everywhere = 0.12, first_points = 0.105;
  CHECK(largest_error(StrandContact(cardinal(), elastic), 0) < everywhere);
  StrandContact bending(cardinal(), elastic);
  for (int k = 0; k < 2; ++k)
    CHECK(std::abs(bending.moment(published[k].first) / published[k].second - 1) < first_points);
  // The lay length is published as "about 0.5 m". With 0.47 m all points are within 10 % and the stuck stiffness is 1956.
  CHECK(largest_error(StrandContact(cardinal(0.47), elastic), 0) < 0.1);
  CHECK(StrandBending(cardinal(0.47)).stuck_stiffness() == Approx(1964).epsilon(5e-3));
}

TEST_CASE("published CARDINAL points are themselves not those of a curve that only softens") {
  // Sliders that yield one after another give a concave curve. The second point lies below the chord of its neighbours by this
  // share of its value, so the uncertainty of single points at the begin of the curve is at least as large.
  const auto [x0, y0] = published[0];
  const auto [x1, y1] = published[1];
  const auto [x2, y2] = published[2];
  const double chord = y0 + (y2 - y0) * (x1 - x0) / (x2 - x0);
  CHECK(chord / y1 - 1 > 0.08);
}

TEST_CASE("a strand on rigid contacts is that of sliders whose cap gathers from the neutral axis") {
  // Equilibrium along every wire against a cap by angle: two derivations of one curve. They differ where a layer sticks beyond
  // its sliding part. There one model counts the load of the layers outside per length of the strand, the other per length of
  // the wire (1 / cos of 10 degrees, 1.5 %).
  constexpr double lengths = 0.01;
  StrandContact contact(cardinal(), StrandContact::Contacts::rigid);
  StrandBending sliders(cardinal());
  for (const auto& [curvature, moment] : published)
    CHECK(contact.moment(curvature) == Approx(sliders.moment(curvature)).epsilon(lengths));
}

TEST_CASE("a strand on contacts that give: stiffness before anything slides in closed form") {
  // If all crossings stick, eps = A sin, u = B cos, and (W24) is one linear equation per layer.
  const Strand strand = cardinal();
  const int count = 4;
  const double nu = 0.33, curvature = 1e-4;
  Eigen::MatrixXd left = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd right(count), amplitude(count), gradient(count), lever(count);
  double stretch = 0, own = 0;
  for (const StrandLayer& l : strand.layers) {
    const double EA = l.youngs_modulus * pi * l.wire_radius * l.wire_radius;
    stretch += l.count * EA * std::pow(std::cos(l.lay_angle), 3);
    own += l.count * EA * l.wire_radius * l.wire_radius / 4 * std::cos(l.lay_angle);
  }
  std::vector<double> load(count + 1, 0.0), face(count + 1, 0.0);
  for (int i = count - 1; i >= 0; --i) {
    const StrandLayer& l = strand.layers[i + 1];
    const double EA = l.youngs_modulus * pi * l.wire_radius * l.wire_radius, c = std::cos(l.lay_angle),
                 s = std::sin(l.lay_angle);
    load[i] = load[i + 1] + l.count / (2 * pi) * strand.tension * EA * c * s * s / (stretch * l.helix_radius);
    if (i == 0) continue;
    const StrandLayer& k = strand.layers[i];
    const double crossings = l.count * k.count * (2 / 0.5) / (2 * pi);
    const double E = 1 / ((1 - nu * nu) * (1 / l.youngs_modulus + 1 / k.youngs_modulus));
    const double G = 1 / (2 * (2 - nu) * (1 + nu) * (1 / l.youngs_modulus + 1 / k.youngs_modulus));
    const double R = std::sqrt(l.wire_radius * k.wire_radius) / std::sin(l.lay_angle + k.lay_angle);
    face[i] = crossings * 8 * G * std::cbrt(0.75 * load[i] / crossings * R / E);
  }
  for (int i = 0; i < count; ++i) {
    const StrandLayer& l = strand.layers[i + 1];
    const double EA = l.youngs_modulus * pi * l.wire_radius * l.wire_radius, c = std::cos(l.lay_angle);
    const double turn = 2 * pi / 0.5, force = l.count * EA * turn / (2 * pi);
    amplitude[i] = c * c * l.helix_radius * curvature;
    gradient[i] = turn * c;
    lever[i] = l.count * EA * c * l.helix_radius / 2;
    right[i] = force * amplitude[i];
    left(i, i) += force * gradient[i] + face[i] + face[i + 1];
    if (i > 0) left(i, i - 1) += face[i];
    if (i + 1 < count) left(i, i + 1) += face[i + 1];
  }
  left.row(0).setZero();  // the innermost layer has contact lines with the core: u = 0
  left(0, 0) = 1;
  right[0] = 0;
  const Eigen::VectorXd B = left.partialPivLu().solve(right);
  double moment = own * curvature;
  for (int i = 0; i < count; ++i) moment += lever[i] * (amplitude[i] - gradient[i] * B[i]);
  constexpr double grid = 1e-3;  // 45 cells over a quarter of a sine
  StrandContact contact(strand, StrandContact::Contacts::elastic);
  CHECK(contact.moment(curvature) == Approx(moment).epsilon(grid));
  CHECK(moment / curvature == Approx(1720).epsilon(0.01));
}

TEST_CASE("a strand on contacts that give loses energy in every loop and slides freely without friction") {
  StrandContact bending(cardinal(), StrandContact::Contacts::elastic);
  constexpr int steps = 20;
  const double amplitude = 0.1;
  double moment = 0, loss = 0, top = 0;
  for (int k = 1; k <= steps; ++k) top = moment = bending.moment(amplitude * k / steps);
  for (int loop = 0; loop < 2; ++loop) {
    double lost = 0;
    for (int half = 0; half < 2; ++half)
      for (int k = 1; k <= steps; ++k) {
        const double direction = half == 0 ? -1 : 1;
        const double now = bending.moment(direction * amplitude * (2.0 * k / steps - 1));
        lost += (now + moment) / 2 * direction * 2 * amplitude / steps;
        moment = now;
      }
    CHECK(lost > 0);
    if (loop > 0) CHECK(lost == Approx(loss).epsilon(1e-6));  // the loop has settled
    loss = lost;
    CHECK(moment == Approx(top).epsilon(1e-6));
  }
  // Tape around the strand presses like tension. If tape causes all of the radial load, layer by layer, the moment is the same.
  // A jacket that holds wires elastically is refused.
  Strand taped = cardinal();
  double stretch = 0;
  for (const StrandLayer& layer : taped.layers)
    stretch += layer.count * layer.youngs_modulus * layer.wire_radius * layer.wire_radius * pi *
               std::pow(std::cos(layer.lay_angle), 3);
  for (StrandLayer& layer : taped.layers)
    if (layer.helix_radius > 0)
      layer.line_load = taped.tension * layer.youngs_modulus * pi * layer.wire_radius * layer.wire_radius *
                        std::pow(std::cos(layer.lay_angle) * std::sin(layer.lay_angle), 2) / stretch /
                        layer.helix_radius;
  taped.tension = 0;
  CHECK(StrandContact(taped, StrandContact::Contacts::elastic).moment(0.1) ==
        Approx(StrandContact(cardinal(), StrandContact::Contacts::elastic).moment(0.1)));
  taped.layers.back().jacket_stiffness = 1e6;
  CHECK_THROWS_AS(StrandContact(taped, StrandContact::Contacts::elastic), dresslife::pipeline::InputError);
  Strand smooth = cardinal();
  smooth.friction = 0;
  StrandContact free(smooth, StrandContact::Contacts::elastic);
  CHECK(free.moment(0.3) == Approx(0.3 * StrandBending(smooth).slipped_stiffness()));
}

TEST_CASE("a strand bent to and fro follows Masing's doubled curve and loses energy in every loop") {
  StrandBending bending(cardinal()), virgin(cardinal());
  const double amplitude = 0.2;
  constexpr int steps = 400;
  double moment = 0, loss = 0;
  for (int k = 1; k <= steps; ++k) moment = bending.moment(amplitude * k / steps);
  const double top = moment;
  for (int half = 0; half < 2; ++half)
    for (int k = 1; k <= steps; ++k) {
      const double direction = half == 0 ? -1 : 1, from = -direction * amplitude;
      const double now = bending.moment(from + direction * 2 * amplitude * k / steps);
      loss += (now + moment) / 2 * direction * 2 * amplitude / steps;
      moment = now;
      if (half == 0)  // the branch is the virgin curve doubled
        REQUIRE(now == Approx(top - 2 * virgin.moment(amplitude * k / steps)).margin(1e-9));
    }
  CHECK(moment == Approx(top));
  CHECK(loss > 0.5 * 4 * amplitude * top * 0.5);
  // Without friction the strand is elastic with the slipped stiffness.
  Strand smooth = cardinal();
  smooth.friction = 0;
  StrandBending free(smooth);
  CHECK(free.moment(0.3) == Approx(0.3 * free.slipped_stiffness()));
}

TEST_CASE("sliding everywhere: each layer holds (2/pi)^2 of its cap, the mean of (angle over pi/2) sin") {
  Strand strand = cardinal();
  constexpr double far = 5;  // [1/m]: all wires slide except the last degrees before the outermost fibre
  StrandBending alone([&] {
    Strand same = strand;
    same.outer_layers_press = false;
    return same;
  }());
  double stiffness = 0, held = 0;
  for (const StrandLayer& layer : strand.layers)
    stiffness += layer.count * layer.youngs_modulus * pi * layer.wire_radius * layer.wire_radius *
                 std::pow(std::cos(layer.lay_angle), 3);
  for (const StrandLayer& layer : strand.layers) {
    if (layer.helix_radius == 0) continue;
    const double EA = layer.youngs_modulus * pi * layer.wire_radius * layer.wire_radius;
    const double sine = std::sin(layer.lay_angle), cosine = std::cos(layer.lay_angle);
    const double pressed = strand.tension * EA * cosine * cosine / stiffness * sine * sine;  // line load x R
    held += layer.count * cosine * layer.helix_radius * pi / 2 * strand.friction * pressed / sine * 4 / (pi * pi);
  }
  const double own = alone.slipped_stiffness() * far;
  constexpr double last_degrees = 2e-3;
  CHECK(alone.moment(far) - own == Approx(held).epsilon(last_degrees));
  // Without the pressure of the outer layers the inner layers hold less.
  CHECK(alone.moment(far) < 0.9 * StrandBending(strand).moment(far));
}
