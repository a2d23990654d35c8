#include "tests/strain/strand_bending.h"

#include <cmath>

#include "pipeline/base/constants.h"
#include "pipeline/cable/shares.h"

namespace dresslife::strain {
namespace {

constexpr int angles_per_quarter = 90;

double area(const StrandLayer& layer) { return pi * layer.wire_radius * layer.wire_radius; }

}  // namespace

StrandBending::StrandBending(const Strand& strand) {
  double stiffness = 0;
  for (const StrandLayer& layer : strand.layers) {
    const double cosine = std::cos(layer.lay_angle), EA = layer.youngs_modulus * area(layer);
    stiffness += layer.count * EA * std::pow(cosine, 3);
    own_stiffness_ += layer.count * EA * layer.wire_radius * layer.wire_radius / 4 * cosine;
  }
  double pressed_inward = 0;  // pressure of all wires of the layers outside, per length [N/m]
  for (auto layer = strand.layers.rbegin(); layer != strand.layers.rend(); ++layer) {
    if (layer->helix_radius == 0) continue;
    const double R = layer->helix_radius, EA = layer->youngs_modulus * area(*layer);
    const double sine = std::abs(std::sin(layer->lay_angle)), cosine = std::cos(layer->lay_angle);
    const double own = strand.tension * EA * cosine * cosine / stiffness * sine * sine / R;
    double line_load = own + layer->line_load;
    if (strand.outer_layers_press) line_load += 2 * pressed_inward / layer->count;
    pressed_inward += layer->count * (own + layer->line_load);
    const double elastic = helices::elastic_share(layer->jacket_stiffness, EA, 2 * pi * R / sine);
    const double largest = pi / 2 * strand.friction * line_load * R / (EA * sine);  // (W16)
    for (int k = 0; k < angles_per_quarter; ++k) {
      const double share = (k + 0.5) / angles_per_quarter, lever = R * std::sin(pi / 2 * share);
      fibres_.push_back({cosine * cosine * lever,
                         layer->count * EA * cosine * lever / angles_per_quarter,
                         largest * share,
                         elastic,
                         {}});
    }
  }
}

double StrandBending::stuck_stiffness() const {
  double sum = own_stiffness_;
  for (const Fibre& fibre : fibres_) sum += fibre.strain_per_curvature * fibre.moment_per_strain;
  return sum;
}

double StrandBending::moment(double curvature) {
  double sum = own_stiffness_ * curvature;
  for (Fibre& fibre : fibres_) {
    const double away = fibre.strain_per_curvature * curvature;
    sum += fibre.moment_per_strain * (fibre.elastic * away + fibre.slider.next((1 - fibre.elastic) * away, fibre.cap));
  }
  return sum;
}

}  // namespace dresslife::strain
