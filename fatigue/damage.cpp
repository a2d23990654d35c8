#include "fatigue/damage.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <type_traits>

#include "fatigue/log_table.h"
#include "fatigue/relaxation.h"
#include "fatigue/stress_path.h"

namespace dresslife::fatigue {
namespace {

using pipeline::Counting;
using pipeline::MeanStress;
using pipeline::Stress;

/// Returns the path with positions instead of samples, so that cycles counted from the result point into `path`.
std::vector<Reversal> numbered(std::span<const Reversal> path) {
  std::vector<Reversal> result(path.begin(), path.end());
  for (std::size_t i = 0; i < result.size(); ++i) result[i].sample = static_cast<std::int64_t>(i);
  return result;
}

/// Returns the stress that a history loses when `share` of its offset remains (F22). The whole offset is the middle of its
/// outermost loop, whose tips are its largest and its smallest strain.
double relaxed_by(std::span<const Reversal> path, std::span<const double> stress, double share) {
  const auto [low, high] = std::ranges::minmax_element(path, {}, &Reversal::strain);
  return (1 - share) * (stress[low - path.begin()] / 2 + stress[high - path.begin()] / 2);
}

/// Returns the cycles, with the stress from curve(strain >= 0) under Masing's rule and damage(eps_a, s_max, s_m).
template <class Curve, class Damage>
std::vector<DamagingCycle> list_cycles(std::span<const Reversal> reversals, Counting counting, double share,
                                       const Curve& curve, const Damage& damage) {
  if (reversals.empty()) return {};
  const bool repeating = is_repeated(counting);
  const std::vector<Reversal> path =
      repeating ? rotate_to_largest(reversals) : std::vector<Reversal>(reversals.begin(), reversals.end());
  MemoryPath memory(curve);
  std::vector<double> stress;
  for (const Reversal& r : path) stress.push_back(memory.go_to(r.strain));
  if (repeating && share != 1)
    for (const double gone = relaxed_by(path, stress, share); double& s : stress) s -= gone;
  const std::vector<Reversal> positions = numbered(path);

  std::vector<DamagingCycle> result;
  for (const Cycle& cycle : repeating ? count_repeating(positions) : count_half_cycles(positions)) {
    const double at_begin = stress[cycle.begin.sample], at_end = stress[cycle.end.sample];
    DamagingCycle& out = result.emplace_back();
    out.cycle = {path[cycle.begin.sample], path[cycle.end.sample], cycle.count};
    out.stress_max = std::max(at_begin, at_end);
    out.stress_mean = at_begin / 2 + at_end / 2;
    out.damage = cycle.count * damage(cycle.range() / 2, out.stress_max, out.stress_mean);
  }
  return result;
}

}  // namespace

std::vector<DamagingCycle> evaluate_cycles(std::span<const Reversal> reversals, const pipeline::Material& material,
                                           const pipeline::Fatigue& settings, double share) {
  if (!material.strain_life_table.empty()) {
    const StrainLifeTable table(material.strain_life_table);
    return list_cycles(
        reversals, settings.counting, 1, [&](double strain) { return material.youngs_modulus * strain; },
        [&](double amplitude, double, double) {
          return amplitude <= settings.endurance_strain ? 0 : table.damage(amplitude);
        });
  }
  const CyclicCurve cyclic(material);
  const StrainLife life(material, settings.mean_stress, settings.endurance_strain);
  const auto curve = [&](double strain) {
    return yields(settings.stress) ? cyclic.stress(strain) : material.youngs_modulus * strain;
  };
  return list_cycles(reversals, settings.counting, share, curve,
                     [&](double amplitude, double stress_max, double stress_mean) {
                       return life.damage({amplitude, stress_max, stress_mean});
                     });
}

std::vector<double> stress_along(std::span<const double> strain, const pipeline::Material& material,
                                 const pipeline::Fatigue& settings, double share) {
  if (strain.empty()) return {};
  const bool table = !material.strain_life_table.empty(), repeating = is_repeated(settings.counting);
  std::optional<CyclicCurve> cyclic;
  if (yields(settings.stress) && !table) cyclic.emplace(material);
  MemoryPath memory([&](double at) { return cyclic ? cyclic->stress(at) : material.youngs_modulus * at; });
  const auto smaller = [](double a, double b) { return std::fabs(a) < std::fabs(b); };
  const std::size_t samples = strain.size();
  const std::size_t first =
      repeating ? static_cast<std::size_t>(std::ranges::max_element(strain, smaller) - strain.begin()) : 0;
  std::vector<double> stress(samples);
  std::vector<Reversal> path(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    const std::size_t k = (first + i) % samples;
    stress[k] = memory.go_to(strain[k]);
    path[k].strain = strain[k];
  }
  if (repeating && share != 1 && !table)
    for (const double gone = relaxed_by(path, stress, share); double& s : stress) s -= gone;
  return stress;
}

double sum_of_damage(std::span<const DamagingCycle> cycles) {
  double sum = 0;
  for (const DamagingCycle& c : cycles) sum += c.damage;
  return sum;
}

std::vector<double> damage_over_time(std::span<const DamagingCycle> cycles, std::size_t samples, Moment moment) {
  std::vector<double> damage(samples, 0.0);
  for (const DamagingCycle& c : cycles)
    damage.at((moment == Moment::opens ? c.cycle.begin : c.cycle.end).sample) += c.damage;
  return damage;
}

std::vector<double> damage_by_step(std::span<const double> damage, std::span<const std::int32_t> step,
                                   std::size_t steps) {
  assert(damage.size() == step.size());
  std::vector<double> sums(steps, 0.0);
  for (std::size_t t = 0; t < damage.size(); ++t) {
    if (step[t] >= 0) sums.at(step[t]) += damage[t];
  }
  return sums;
}

// ---- tables -----------------------------------------------------------------------------------------------

namespace {

/// Stress range of a Masing branch of the cyclic curve (F3).
class BranchTable {
 public:
  explicit BranchTable(const CyclicCurve& curve)
      : curve_(curve),
        table_(elastic_limit(curve), largest_range,
               [&](double range) {
                 const double stress_range = curve.stress_range(range);
                 return LogTable::Point{stress_range, slope(curve, stress_range / 2)};
               }),
        elastic_(curve.stress_range(table_.low()) / table_.low()) {}

  double operator()(double range) const {
    if (range < table_.low()) return elastic_ * range;
    return range <= table_.high() ? table_(range) : curve_.stress_range(range);
  }
  double elastic() const { return elastic_; }  ///< stress over strain below the table
  LogTable::View view() const { return table_.view(); }

 private:
  static constexpr double largest_range = 8;     // strain; the exact curve is used beyond it
  static constexpr double plastic_share = 1e-9;  // plastic share of the strain below which a branch counts as straight
  static constexpr double smallest_range = 0x1p-40;  // lower end of the table if even tiny strains are plastic

  /// Returns d stress / d strain at this stress.
  static double slope(const CyclicCurve& curve, double stress) {
    const double elastic = stress / curve.youngs_modulus(), plastic = curve.strain(stress) - elastic;
    return stress / (elastic + std::max(plastic, 0.0) / curve.hardening_exponent());
  }
  /// Returns the range at which the plastic strain is `plastic_share` of the elastic: (s/K')^(1/n') = share s/E.
  static double elastic_limit(const CyclicCurve& curve) {
    const double n = curve.hardening_exponent();
    if (n == 1) return largest_range / 2;
    const double ratio = plastic_share * curve.strength() / curve.youngs_modulus();
    const double stress = curve.strength() * std::pow(ratio, n / (1 - n));
    return std::clamp(2 * stress / curve.youngs_modulus(), smallest_range, largest_range / 2);
  }

  CyclicCurve curve_;
  LogTable table_;
  double elastic_;
};

/// Damage 2/(2N) as a function of the value of the falling curve y(2N).
class CurveTable {
 public:
  CurveTable(const PowerSum& curve, double fewest, double most)
      : low_(curve(most)), high_(curve(fewest)), at_high_(2 / fewest), table_(low_, high_, [&](double y) {
          const double x = curve.inverse(y);
          return LogTable::Point{2 / x, -2 / (x * x * curve.slope(x))};
        }) {}
  double operator()(double y) const { return y < low_ ? 0 : y >= high_ ? at_high_ : table_(y); }
  double at_high() const { return at_high_; }
  LogTable::View view() const { return table_.view(); }

 private:
  double low_, high_, at_high_;
  LogTable table_;
};

// ---- rules of mean stress ---------------------------------------------------------------------------------

struct MetalTables;

// A rule has three members. life_room: factor by which its lives may differ from those of the curve (8) that it reads. read():
// gives a table to the side-by-side loop and returns true, if damage is a function of amplitude or of amplitude times the largest
// stress; else returns false. damage(): damage of one load.

struct WithoutMeanStress {  // (8)
  static constexpr double life_room = 1;
  static bool read(const MetalTables& metal, LockstepTables& to);
  static double damage(const MetalTables& metal, double amplitude, double, double);
};

struct SmithWatsonTopper {  // (9)
  static constexpr double life_room = 1;
  static bool read(const MetalTables& metal, LockstepTables& to);
  static double damage(const MetalTables& metal, double amplitude, double stress_max, double);
};

struct Morrow {  // (F7): the axis is scaled by u^(1/(c-b)); the room allows s_m from -2 sf to 0.999 sf
  static constexpr double life_room = 1e7;
  static bool read(const MetalTables&, LockstepTables&) { return false; }
  static double damage(const MetalTables& metal, double amplitude, double, double stress_mean);
};

struct Walker {  // (F12): by (s_a/s_max)^(-(1-gamma)/b); for copper the room allows s_a down to 0.03 s_max
  static constexpr double life_room = 1e7;
  static bool read(const MetalTables&, LockstepTables&) { return false; }
  static double damage(const MetalTables& metal, double amplitude, double stress_max, double stress_mean);
};

template <class Rule>
struct WithoutCompression {  // (F38)
  static constexpr double life_room = Rule::life_room;
  static bool read(const MetalTables& metal, LockstepTables& to);
  static double damage(const MetalTables& metal, double amplitude, double stress_max, double stress_mean);
};

/// Calls use(rule). Each value of MeanStress in pipeline/job/fatigue.h must have a case, else this does not compile.
template <class Use>
auto with_rule(MeanStress rule, const Use& use) {
  switch (rule) {
    case MeanStress::none:
      return use(WithoutMeanStress{});
    case MeanStress::swt:
      return use(SmithWatsonTopper{});
    case MeanStress::morrow:
      return use(Morrow{});
    case MeanStress::walker:
      return use(Walker{});
  }
  throw std::logic_error("no such rule of mean stress");
}

template <class Use>
auto with_rule(MeanStress rule, Compression compression, const Use& use) {
  return with_rule(rule, [&](auto of) {
    return compression == Compression::by_rule ? use(of) : use(WithoutCompression<decltype(of)>{});
  });
}

/// Tables of the loop for a metal.
struct MetalTables {
  MetalTables(const pipeline::Material& m, const pipeline::Fatigue& f, double longest)
      : life(m, f.mean_stress, f.endurance_strain, longest),
        branch(CyclicCurve(m)),
        damage(f.mean_stress == MeanStress::swt ? life.swt() : life.coffin_manson(), fewest_reversals / room(f),
               longest * room(f)) {}
  static double room(const pipeline::Fatigue& f) {
    return with_rule(f.mean_stress, [](auto rule) { return rule.life_room; });
  }

  StrainLife life;
  BranchTable branch;
  CurveTable damage;  ///< by the curve that the rule of mean stress reads
};

/// Limits the damage of a curve with a scaled axis to the same lives as other curves.
double within_lives(double damage, double longest) {
  return damage < 2 / longest ? 0 : std::min(damage, 2 / fewest_reversals);
}

void hand_over(const CurveTable& table, LockstepTables& to) {
  to.damage = table.view();
  to.damage_at_high = table.at_high();
}

bool WithoutMeanStress::read(const MetalTables& metal, LockstepTables& to) {
  hand_over(metal.damage, to);
  return true;
}
double WithoutMeanStress::damage(const MetalTables& metal, double amplitude, double, double) {
  return metal.damage(amplitude);
}

bool SmithWatsonTopper::read(const MetalTables& metal, LockstepTables& to) {
  hand_over(metal.damage, to);
  to.times_stress_max = true;
  return true;
}
double SmithWatsonTopper::damage(const MetalTables& metal, double amplitude, double stress_max, double) {
  return metal.damage(stress_max * amplitude);
}

double Walker::damage(const MetalTables& metal, double amplitude, double stress_max, double stress_mean) {
  if (stress_max <= 0) return 0;
  const double stretch = metal.life.walker_stretch(stress_max, stress_mean);
  if (stretch < 1 / life_room || stretch > life_room)  // outside the table: solved
    return metal.life.damage({amplitude, stress_max, stress_mean});
  return within_lives(metal.damage(amplitude) / stretch, metal.life.longest());
}

double Morrow::damage(const MetalTables& metal, double amplitude, double, double stress_mean) {
  if (stress_mean >= metal.life.fatigue_strength()) return 2 / fewest_reversals;
  const StrainLife::MorrowScale scale = metal.life.morrow_scale(stress_mean);  // (F8)
  return within_lives(metal.damage(amplitude / scale.strain) / scale.life, metal.life.longest());
}

template <class Rule>
bool WithoutCompression<Rule>::read(const MetalTables& metal, LockstepTables& to) {
  return std::is_same_v<Rule, WithoutMeanStress> && Rule::read(metal, to);
}
template <class Rule>
double WithoutCompression<Rule>::damage(const MetalTables& metal, double amplitude, double stress_max,
                                        double stress_mean) {
  const double compressive = std::min(stress_mean, 0.0);
  return Rule::damage(metal, amplitude, stress_max - compressive, stress_mean - compressive);
}

/// Returns whether rises and falls alternate strictly, as dresslife-strain writes them. Uses integers and no branch, so that the
/// compiler vectorises it.
bool alternates(std::span<const float> strains) {
  const float* const at = strains.data();
  int strict = 1;
  for (std::size_t i = 1; i + 1 < strains.size(); ++i) {
    const int rise = at[i] > at[i - 1], fall = at[i] < at[i - 1];
    const int falls_next = at[i] > at[i + 1], rises_next = at[i] < at[i + 1];
    strict &= (rise & falls_next) | (fall & rises_next);
  }
  return strict != 0;
}

/// Returns the reversals of one period of a repeated history with any sequence of strains: rises and falls alternate, also across
/// the joint of its end and its begin. Empty for a constant history.
std::vector<float> alternating_period(std::span<const float> strains) {
  const auto is_smaller = [](float a, float b) { return std::fabs(a) < std::fabs(b); };
  const std::size_t largest = std::ranges::max_element(strains, is_smaller) - strains.begin();
  std::vector<float> period;
  for (std::size_t i = 0; i <= strains.size(); ++i) {
    const float strain = strains[(largest + i) % strains.size()];
    const std::size_t n = period.size();
    if (n > 0 && strain == period[n - 1]) continue;
    const bool continues = n > 1 && (period[n - 1] > period[n - 2]) == (strain > period[n - 1]);
    continues ? period[n - 1] = strain : period.emplace_back(strain);
  }
  period.pop_back();  // the second copy of the largest
  return period;
}

/// Computes the stress at every reversal of a history that starts at rest, like MemoryPath but without its calls. The case of a
/// continued direction is left out, because the reversals must alternate.
template <class Range>
void follow_stress(std::span<const float> strains, const Range& stress_range, std::vector<double>& stress,
                   std::vector<double>& open, std::vector<double>& response) {
  stress.resize(strains.size());
  open.resize(strains.size() + 1);
  response.resize(strains.size() + 1);
  std::size_t top = 0;
  double largest = 0;
  open[0] = response[0] = 0;
  for (std::size_t i = 0; i < strains.size(); ++i) {
    const double strain = strains[i];
    if (std::fabs(strain) >= largest) {
      largest = std::fabs(strain);
      top = 0;
      open[0] = strain;
      response[0] = std::copysign(stress_range(2 * largest) / 2, strain);
    } else {
      while (top >= 2 && (strain > open[top] ? strain >= open[top - 1] : strain <= open[top - 1])) top -= 2;
      const double way = strain - open[top];
      response[top + 1] = response[top] + std::copysign(stress_range(std::fabs(way)), way);
      open[++top] = strain;
    }
    stress[i] = response[top];
  }
}

/// Returns the damage of count_half_cycles() for alternating reversals.
template <class Range, class Damage>
double sum_half_cycles(std::span<const float> strains, const Range& stress_range, const Damage& damage,
                       DamageCounter::Workspace& w) {
  follow_stress(strains, stress_range, w.stress, w.strain, w.period);
  w.open.resize(strains.size());
  std::uint32_t* const open = w.open.data();
  std::size_t first = 0, size = 0;  // of the open reversals
  double sum = 0;
  const auto add = [&](double count, std::uint32_t a, std::uint32_t b) {
    const double amplitude = std::fabs(double(strains[a]) - double(strains[b])) / 2;
    sum += count * damage(amplitude, std::max(w.stress[a], w.stress[b]), w.stress[a] / 2 + w.stress[b] / 2);
  };
  for (std::uint32_t next = 0; next < strains.size(); ++next) {
    while (size - first >= 2) {
      const std::uint32_t below = open[size - 2], top = open[size - 1];
      const float strain = strains[next];
      if (strain > strains[top] ? strain < strains[below] : strain > strains[below]) break;
      const bool holds_start = size - first == 2;
      add(holds_start ? 0.5 : 1, below, top);
      holds_start ? ++first : size -= 2;
    }
    open[size++] = next;
  }
  for (std::size_t i = first; i + 1 < size; ++i) add(0.5, open[i], open[i + 1]);
  return sum;
}

/// Offset and half the stress range of the outermost loop, with the sign for a largest strain in tension.
struct OuterLoop {
  double offset, half_range;
};

}  // namespace

struct DamageCounter::Tables {
  Tables(const pipeline::Material& m, const pipeline::Fatigue& f, pipeline::InstructionSet set, double longest,
         Compression of_compression)
      : material(m), settings(f), compression(of_compression), relaxation(m, f), lockstep(lockstep_for(set)) {
    if (m.strain_life_table.empty()) {
      metal.emplace(m, f, longest);
    } else {
      measured.emplace(m.strain_life_table, longest);
    }
    fill_side_by_side();
  }
  template <class Use>
  auto with_functions(const Use& use) const;
  void fill_side_by_side();
  double stress_range(double range) const {
    return metal && yields(settings.stress) ? metal->branch(range) : material.youngs_modulus * range;
  }
  template <class Rule>
  double first_stress(double largest, double range, double share) const;
  template <class Rule>
  double expected_share(double largest, double range, const OuterLoop& loop) const;

  pipeline::Material material;
  pipeline::Fatigue settings;
  Compression compression;
  Relaxation relaxation;
  std::optional<MetalTables> metal;  // one of the two has a value
  std::optional<StrainLifeTable> measured;
  const Lockstep& lockstep;
  LockstepTables side_by_side;
};

DamageCounter::DamageCounter(const pipeline::Material& material, const pipeline::Fatigue& settings,
                             pipeline::InstructionSet set, double longest, Compression compression)
    : tables_(std::make_unique<Tables>(material, settings, set, longest, compression)) {}
DamageCounter::~DamageCounter() = default;
DamageCounter::DamageCounter(DamageCounter&&) noexcept = default;

/// Calls use(stress_range, damage) with the functions of the settings.
template <class Use>
auto DamageCounter::Tables::with_functions(const Use& use) const {
  const auto with_damage = [&](const auto& stress_range) {
    const auto lasting = [&](const auto& damage) {
      return use(stress_range, [&, endurance = settings.endurance_strain](double amplitude, double max, double mean) {
        return amplitude <= endurance ? 0.0 : damage(amplitude, max, mean);
      });
    };
    if (measured) return lasting([&](double amplitude, double, double) { return measured->damage(amplitude); });
    return with_rule(settings.mean_stress, compression, [&](auto rule) {
      return lasting(
          [&](double amplitude, double max, double mean) { return rule.damage(*metal, amplitude, max, mean); });
    });
  };
  if (metal && yields(settings.stress)) return with_damage([&](double range) { return metal->branch(range); });
  return with_damage([modulus = material.youngs_modulus](double range) { return modulus * range; });
}

/// Returns the stress at the largest strain (F22).
template <class Rule>
double DamageCounter::Tables::first_stress(double largest, double range, double share) const {
  const double kept = stress_range(2 * std::fabs(largest)) / 2;
  if (share == 1) return kept;
  const double relaxed = stress_range(range) / 2;
  if (share < 0) share = expected_share<Rule>(largest, range, {kept - relaxed, relaxed});
  return relaxed + share * (kept - relaxed);
}

/// Returns the mean share for the life that the outermost loop alone would have, once in every repeat. Other loops shorten this
/// life, by a tenth or by a factor of ten; the share changes by this factor to the power r.
template <class Rule>
double DamageCounter::Tables::expected_share(double largest, double range, const OuterLoop& loop) const {
  if (relaxation.complete()) return 0;
  const double exponent = relaxation.exponent(range / 2);
  if (exponent == 0) return 1;
  if (range / 2 <= settings.endurance_strain) return 0;
  const double offset = std::copysign(loop.offset, largest);
  const double life = rough_relaxing_life(
      std::exp(exponent * std::log(10)), std::exp(exponent * std::log(5.5)),
      [&](double share) { return Rule::damage(*metal, range / 2, loop.half_range + share * offset, share * offset); });
  return mean_share(life, exponent);
}

/// Fills the tables of the side-by-side loop. Functions without a table are called for one load at a time.
void DamageCounter::Tables::fill_side_by_side() {
  LockstepTables& to = side_by_side;
  to.material = this;
  to.endurance = settings.endurance_strain;
  to.elastic = material.youngs_modulus;
  if (metal && yields(settings.stress)) {
    to.elastic = metal->branch.elastic();
    to.branch = metal->branch.view();
    to.far_branch = [](const void* self, double range) {
      return static_cast<const Tables*>(self)->metal->branch(range);
    };
  }
  if (measured) {
    to.damage_of = [](const void* self, double amplitude, double, double) {
      return static_cast<const Tables*>(self)->measured->damage(amplitude);
    };
    return;
  }
  with_rule(settings.mean_stress, compression, [&](auto rule) {
    if (!relaxation.never())
      to.first_stress = [](const void* self, double largest, double range, double share) {
        return static_cast<const Tables*>(self)->first_stress<decltype(rule)>(largest, range, share);
      };
    if (rule.read(*metal, to)) return;
    to.damage_of = [](const void* self, double amplitude, double max, double mean) {
      return decltype(rule)::damage(*static_cast<const Tables*>(self)->metal, amplitude, max, mean);
    };
  });
}

void DamageCounter::operator()(std::span<const StrainList> histories, std::span<double> damage,
                               Workspace& workspace) const {
  assert(histories.size() == damage.size());
  if (!is_repeated(tables_->settings.counting)) {
    for (std::size_t k = 0; k < histories.size(); ++k) damage[k] = damage_once(histories[k], workspace);
    return;
  }
  const Lockstep& lockstep = tables_->lockstep;
  for (std::size_t first = 0; first < histories.size(); first += lockstep.lanes) {
    const auto group = histories.subspan(first, std::min(lockstep.lanes, histories.size() - first));
    std::size_t longest = 0;
    for (const StrainList& history : group) longest = std::max(longest, history.size);
    const std::size_t lines = lockstep.lines(longest);
    if (workspace.lines.size() < lines) workspace.lines.resize(lines);
    const unsigned amiss =
        lockstep.sum(tables_->side_by_side, group.data(), group.size(), workspace.lines.data(), &damage[first]);
    for (std::size_t k = 0; amiss >> k != 0; ++k)
      if (amiss >> k & 1) {
        const std::vector<float> period = alternating_period({group[k].strain, group[k].size});
        damage[first + k] = (*this)(period, workspace, group[k].share);
      }
  }
}

double DamageCounter::operator()(std::span<const float> strains, Workspace& workspace, double share) const {
  const StrainList list{strains.data(), strains.size(), share};
  double damage = 0;
  (*this)(std::span(&list, 1), std::span(&damage, 1), workspace);
  return damage;
}

double DamageCounter::damage_once(const StrainList& list, Workspace& workspace) const {
  const std::span<const float> strains(list.strain, list.size);
  if (strains.size() < 2) return 0;
  if (alternates(strains)) {
    return tables_->with_functions([&](const auto& stress_range, const auto& damage) {
      return sum_half_cycles(strains, stress_range, damage, workspace);
    });
  }
  std::vector<Reversal> reversals;
  for (const float strain : strains) reversals.push_back({strain, static_cast<std::int64_t>(reversals.size())});
  return sum_of_damage(cycles(reversals, 1));
}

bool DamageCounter::settles() const {
  return tables_->side_by_side.first_stress != nullptr && !tables_->relaxation.complete();
}

namespace {

double amplitude_of(std::span<const float> strains) {
  if (strains.empty()) return 0;
  const auto [low, high] = std::ranges::minmax_element(strains);
  return (double{*high} - double{*low}) / 2;
}

}  // namespace

double DamageCounter::settled_damage(std::span<const float> strains, Workspace& workspace) const {
  if (!settles()) return (*this)(strains, workspace);
  std::vector<StrainList> lists;
  const double life = relaxing_life(tables_->relaxation.exponent(amplitude_of(strains)),
                                    [&](std::span<const double> share, std::span<double> damage) {
                                      lists.clear();
                                      for (const double left : share)
                                        lists.push_back({strains.data(), strains.size(), left});
                                      (*this)(lists, damage, workspace);
                                    });
  return 1 / life;
}

double DamageCounter::share_over(double repeats, std::span<const float> strains) const {
  if (tables_->relaxation.never()) return 1;
  return settles() ? mean_share(repeats, tables_->relaxation.exponent(amplitude_of(strains))) : 0;
}

std::vector<DamagingCycle> DamageCounter::cycles(std::span<const Reversal> reversals, double share) const {
  return tables_->with_functions([&](const auto& stress_range, const auto& damage) {
    const auto curve = [&](double strain) { return stress_range(2 * strain) / 2; };
    return list_cycles(reversals, tables_->settings.counting, share, curve, damage);
  });
}

bool DamageCounter::must_alternate() const { return !is_repeated(tables_->settings.counting); }

double life_in_repeats(double damage) { return damage > 0 ? 1 / damage : std::numeric_limits<double>::infinity(); }

double hours(double repeats, double motion_duration) { return repeats * motion_duration / 3600; }

}  // namespace dresslife::fatigue
