#include "sim/run/prescribed.h"

#include <algorithm>
#include <cmath>

#include "pipeline/cable/cable_bending.h"
#include "pipeline/files/check_names.h"
#include "sim/run/cures.h"
#include "sim/run/deformation_file.h"
#include "sim/run/motion_file.h"
#include "sim/run/rig_deformation.h"

namespace dresslife::sim {
namespace {

using pipeline::InputError;
using pipeline::WarningKind;
namespace check_name = pipeline::check_name;

using State = PrescribedDeformation::State;

State between(const State& a, const State& b, double share) {
  return {a.rate + share * (b.rate - a.rate), a.elongation + share * (b.elongation - a.elongation)};
}

/// Returns the rotation over [from, to] in steps of at most `step` (D1). With rates w1, w2 at the Gauss points of a step h it is
/// exp(h/2 (w1 + w2) + sqrt(3)/12 h^2 w1 x w2); the commutator has the sign for frames that are rotated from the right.
Quaternion turn(const PrescribedDeformation& deformation, std::size_t sample, double from, double to, double step) {
  const int steps = std::max(1, static_cast<int>(std::ceil((to - from) / step - 1e-9)));
  const double h = (to - from) / steps, off = h / (2 * std::sqrt(3.0));
  Quaternion whole = Quaternion::Identity();
  for (int k = 0; k < steps; ++k) {
    const double middle = from + (k + 0.5) * h;
    const Vector3 first = deformation.at(sample, middle - off).rate, second = deformation.at(sample, middle + off).rate;
    whole = whole * rotation(h / 2 * (first + second) + std::sqrt(3.0) / 12 * h * h * Vector3(first.cross(second)));
  }
  return whole.normalized();
}

/// Extremes along the dresspack and their table, as for a simulated motion.
class Extremes {
 public:
  Extremes(const PrescribedDeformation& deformation, const pipeline::Dresspack& dresspack, int n, double length)
      : deformation_(deformation),
        limits_(limits_of(dresspack)),
        stiffness_(axial_stiffness(dresspack)),
        step_(length / n),
        curvature(n + 1),
        twist(n + 1),
        tension(n + 1) {}

  void see(std::size_t sample) {
    const double time = deformation_.times[sample];
    for (int link = 0; link < static_cast<int>(curvature.size()); ++link) {
      const State state = deformation_.at(sample, link * step_);
      const double bend = state.rate.head<2>().norm(), turn = state.rate.z(), pull = stiffness_ * state.elongation;
      curvature[link].see(bend, bend > curvature[link].value, time, link);
      twist[link].see(turn, std::abs(turn) > std::abs(twist[link].value), time, link);
      tension[link].see(pull, pull > tension[link].value, time, link);
    }
  }

  std::vector<Check> table() const {
    const auto of = [](const std::vector<Extreme>& all) {
      return *std::ranges::max_element(
          all, [](const Extreme& a, const Extreme& b) { return std::abs(a.value) < std::abs(b.value); });
    };
    const Extreme bend = of(curvature), turn = of(twist), pull = of(tension);
    const double radius = bend.value > 0 ? 1 / bend.value : std::numeric_limits<double>::infinity();
    return {{WarningKind::bend_radius, check_name::bend_radius, "m", radius, limits_.least_bend_radius,
             radius < limits_.least_bend_radius, bend.time, bend.place * step_},
            {WarningKind::twist, check_name::twist, "rad/m", turn.value, limits_.most_twist,
             std::abs(turn.value) > limits_.most_twist, turn.time, turn.place * step_},
            {WarningKind::tension, check_name::tension, "N", pull.value, limits_.most_tension,
             pull.value > limits_.most_tension, pull.time, pull.place * step_}};
  }

 private:
  const PrescribedDeformation& deformation_;
  MotionLimits limits_;
  double stiffness_, step_;

 public:
  std::vector<Extreme> curvature, twist, tension;  // (link)
};

/// Returns the elastic energy of the whole dresspack at one sample [J].
double elastic_energy(const PrescribedDeformation& deformation, std::size_t sample,
                      const pipeline::Dresspack& dresspack, double axial, int n, double l) {
  double energy = 0;
  for (int i = 0; i < n; ++i) {
    const State state = deformation.at(sample, (i + 0.5) * l);
    energy += l / 2 *
              (dresspack.bending_stiffness * state.rate.head<2>().squaredNorm() +
               dresspack.torsional_stiffness * std::pow(state.rate.z(), 2) + axial * std::pow(state.elongation, 2));
  }
  return energy;
}

void check_size(const pipeline::Setup& setup, std::size_t samples) {
  constexpr double most_values = 1e9;  // 140 GB of disk
  const double values = static_cast<double>(samples) * setup.simulation.segments;
  if (values > most_values)
    throw InputError(setup.motion.where,
                     fmt::format("{:.3g} samples of {} segments take {:.0f} GB", static_cast<double>(samples),
                                 setup.simulation.segments, 136e-9 * values),
                     "choose fewer simulation.segments, or split the motion");
}

RunDescription description_of(const PrescribedDeformation& deformation, const pipeline::Setup& setup) {
  const int n = setup.simulation.segments;
  RunDescription description;
  description.samples = static_cast<int>(deformation.times.size());
  describe_dresspack(description, setup.dresspacks.front());
  description.dresspack.assign(n, 0);
  description.segment_length.assign(n, setup.dresspacks.front().routing.free_length / n);
  description.clamp_segment = {0, n};
  description.links = n + 1;
  description.step_texts = deformation.step_texts;
  return description;
}

}  // namespace

State PrescribedDeformation::at(std::size_t sample, double position) const {
  const State* row = states.data() + sample * positions.size();
  const auto after = std::ranges::upper_bound(positions, position) - positions.begin();
  if (after == 0) return row[0];
  if (after == static_cast<std::ptrdiff_t>(positions.size())) return row[after - 1];
  return between(row[after - 1], row[after],
                 (position - positions[after - 1]) / (positions[after] - positions[after - 1]));
}

RodState posed(const PrescribedDeformation& deformation, std::size_t sample, int n, double length) {
  const double l = length / n;
  RodState state;
  Frame before;  // previous frame, first the base clamp
  double half_before = 0, centre_before = 0;
  for (int i = 0; i <= n; ++i) {
    const bool at_clamp = i == 0 || i == n;
    const double half = i == n ? 0 : l / 2, centre = i == n ? length : (i + 0.5) * l;
    const Quaternion next = (before.orientation * turn(deformation, sample, centre_before, centre, l / 8)).normalized();
    const Vector3 t = tangent(before.orientation), t_next = tangent(next);
    const double arm = at_clamp ? 1 : 1 + (1 - t.dot(t_next)) / 12;  // (S17)
    const double gap = deformation.at(sample, (centre_before + centre) / 2).elongation * (centre - centre_before);
    before = {before.position + arm * (half_before * t + half * t_next) + gap * (t + t_next).normalized(), next};
    half_before = half;
    centre_before = centre;
    if (i < n) {
      state.position.push_back(before.position);
      state.orientation.push_back(before.orientation);
    }
  }
  state.clamps.tool = before;
  return state;
}

PrescribedDeformation deformation_of(const pipeline::Setup& setup) {
  return setup.motion.rig ? rig_deformation(*setup.motion.rig, setup) : read_deformation(setup);
}

double axial_stiffness(const pipeline::Dresspack& dresspack) {
  if (dresspack.axial_stiffness > 0) return dresspack.axial_stiffness;
  pipeline::Component whole;
  whole.components = dresspack.components;
  return pipeline::axial_stiffness(dresspack, whole);
}

std::vector<pipeline::Warning> write_prescribed(const pipeline::Setup& setup, pipeline::FileWriter& file,
                                                const std::function<void(double)>& progress) {
  const PrescribedDeformation deformation = deformation_of(setup);
  const std::size_t samples = deformation.times.size();
  check_size(setup, samples);
  const pipeline::Dresspack& dresspack = setup.dresspacks.front().dresspack;
  const int n = setup.simulation.segments;
  const double length = setup.dresspacks.front().routing.free_length, l = length / n,
               axial = axial_stiffness(dresspack);
  const RunDescription description = description_of(deformation, setup);
  MotionFile motion(file, description);
  Extremes extremes(deformation, dresspack, n, length);
  const Touch untouched(n, {});
  std::vector<double> tension(n);
  for (std::size_t k = 0; k < samples; ++k) {
    const RodState state = posed(deformation, k, n, length);
    double net_twist = 0;
    for (int i = 0; i < n; ++i) {
      const State here = deformation.at(k, (i + 0.5) * l);
      tension[i] = axial * here.elongation;
      net_twist += l * here.rate.z();
    }
    const Energy energy{0, elastic_energy(deformation, k, dresspack, axial, n, l), 0};
    motion.add({deformation.times[k],
                deformation.steps[k],
                state,
                {state.clamps.base, state.clamps.tool},
                {},
                {},
                energy,
                tension,
                0,
                0,
                net_twist,
                untouched});
    extremes.see(k);
    if (progress) progress((k + 1.0) / static_cast<double>(samples));
  }
  RunSummary summary;
  summary.curvature = extremes.curvature;
  summary.twist = extremes.twist;
  summary.tension = extremes.tension;
  summary.checks = extremes.table();
  const auto step_at = [&](double time) {
    const auto sample = std::ranges::lower_bound(deformation.times, time);
    return deformation.steps[std::min<std::size_t>(sample - deformation.times.begin(), samples - 1)];
  };
  motion.finish(summary, step_at);
  const auto moment = [&](double time) {
    const auto step = static_cast<std::size_t>(step_at(time));
    return fmt::format("at {:.3f} s, program step {} '{}'", time, step + 1, deformation.step_texts.at(step));
  };
  std::vector<pipeline::Warning> warnings = check_warnings({setup, moment}, summary.checks);
  return setup.motion.rig ? warnings : joined(std::move(warnings), doubts_of_times(deformation, setup));
}

}  // namespace dresslife::sim
