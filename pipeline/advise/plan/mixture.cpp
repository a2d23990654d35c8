#include "pipeline/advise/plan/mixture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <unordered_map>

#include "pipeline/base/constants.h"
#include "pipeline/base/digest.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/order.h"
#include "pipeline/files/files.h"
#include "pipeline/life/planning.h"

namespace dresslife::pipeline {
namespace {

constexpr std::uint32_t nothing = 0xffffffff;

/// Returns "signal cable" for "signal cable 3".
std::string_view without_number(std::string_view name) {
  const std::size_t digits = name.find_last_not_of("0123456789");
  return digits != std::string_view::npos && digits + 1 < name.size() && name[digits] == ' ' ? name.substr(0, digits)
                                                                                             : name;
}

/// Returns the mode to which the wires of a conductor with this path belong ("wires of signal cable", fatigue/failure_modes.h).
/// The number at the end of a layer's name belongs to the name, that of one of several equal cables does not.
std::uint32_t mode_with(std::string_view conductor, const std::vector<WireSites::Mode>& modes) {
  std::uint32_t found = nothing;
  for (std::uint32_t m = 0; m < modes.size(); ++m) {
    const std::string& dresspack = modes[m].dresspack;
    if (!dresspack.empty() && conductor != dresspack && !conductor.starts_with(dresspack + "/")) continue;
    std::string_view cable = conductor;
    if (!dresspack.empty()) cable.remove_prefix(std::min(cable.size(), dresspack.size() + 1));
    cable = cable.substr(0, cable.find('/'));
    const auto is_of = [&](std::string_view part) {
      const std::string name = dresspack + (dresspack.empty() || part.empty() ? "" : "/") + std::string(part);
      return modes[m].name == (name.empty() ? "wires" : "wires of " + name);
    };
    if (is_of(cable)) return m;
    if (is_of(without_number(cable))) found = m;
  }
  return found;
}

/// Returns the conductor that contains a wire: the conductor with the longest path that is a prefix of the wire's path.
std::uint32_t conductor_of(const std::string& wire, const std::unordered_map<std::string, std::uint32_t>& conductors) {
  for (std::size_t end = wire.rfind('/'); end != std::string::npos;
       end = end == 0 ? std::string::npos : wire.rfind('/', end - 1))
    if (const auto found = conductors.find(wire.substr(0, end)); found != conductors.end()) return found->second;
  const auto whole = conductors.find("");
  return whole == conductors.end() ? nothing : whole->second;
}

/// Returns the standard deviation of ln of a number with this relative standard deviation.
double log_deviation(double percent) { return std::sqrt(std::log1p(percent * percent / 1e4)); }

/// Returns R of (D1). sum, largest: sum and maximum of c r / L over the programs.
double at_least_alone(double sum, double largest, double c) { return c > 0 ? std::max(sum, largest / c) : sum; }

double log10_life(double damage) { return damage > 0 ? -std::log10(damage) : infinity; }

bool is_damaged(const LifeResponse& mode) {
  return std::ranges::any_of(mode.planned, [](const auto& lives) { return lives[1] < LifeResponse::undamaged; });
}

WireLayout layout_of(const WireSites& sites) {
  WireLayout wires;
  std::unordered_map<std::string, std::uint32_t> conductors;
  for (const std::string& path : sites.conductors)
    conductors.emplace(path, static_cast<std::uint32_t>(conductors.size()));
  std::vector<std::uint32_t> mode_of(conductors.size(), nothing);
  for (const auto& [path, index] : conductors) mode_of[index] = mode_with(path, sites.modes);

  struct Wire {
    std::uint32_t conductor = nothing, index = 0;
  };
  std::unordered_map<std::string, Wire> known;
  std::map<std::pair<std::uint32_t, std::int32_t>, std::uint32_t> places;  // (conductor, segment)
  std::unordered_map<std::uint64_t, std::uint32_t> wire_at;                // (wire, segment)
  std::vector<std::uint32_t> wires_of_place;
  wires.wire.assign(sites.segment.size(), nothing);
  for (std::size_t site = 0; site < sites.segment.size(); ++site) {
    const auto [found, is_new] = known.try_emplace(sites.component[site]);
    if (is_new)
      found->second = {conductor_of(sites.component[site], conductors), static_cast<std::uint32_t>(known.size() - 1)};
    const Wire& wire = found->second;
    if (wire.conductor == nothing || mode_of[wire.conductor] == nothing) continue;  // a site of the hose's wall
    const std::int32_t segment = sites.segment[site];
    const std::uint64_t key = std::uint64_t{wire.index} << 32 | static_cast<std::uint32_t>(segment);
    const auto [at, first_site] = wire_at.try_emplace(key, static_cast<std::uint32_t>(wires.place.size()));
    wires.wire[site] = at->second;
    if (!first_site) continue;
    const auto [place, first_wire] =
        places.try_emplace({wire.conductor, segment}, static_cast<std::uint32_t>(wires.mode.size()));
    if (first_wire) wires.mode.push_back(mode_of[wire.conductor]), wires_of_place.push_back(0);
    wires.place.push_back(place->second);
    ++wires_of_place[place->second];
  }
  for (const std::uint32_t count : wires_of_place)
    wires.failing.push_back(static_cast<std::uint32_t>(wires_of_share(sites.failed_percent, count)));
  std::string layout;
  for (const auto& [path, wire] : std::map<std::string, std::uint32_t>(conductors.begin(), conductors.end()))
    layout += path + '\n';
  for (const std::vector<std::uint32_t>* const of : {&wires.wire, &wires.place})
    layout.append(reinterpret_cast<const char*>(of->data()), of->size() * sizeof(std::uint32_t));
  wires.digest = sha256(layout);
  wires.sort_sites();
  return wires;
}

}  // namespace

WireDamage WireDamages::read(const std::filesystem::path& life_file, const FailureModes& modes, double failed_percent) {
  const FileReader file(life_file, life_format(),
                        {"/site/segment", "/site/component", "/conductor/component", "/damage"});
  WireSites sites{
      file.read<std::int32_t>("/site/segment"), {}, file.read<std::string>("/conductor/component"), {}, failed_percent};
  for (const LifeResponse& mode : modes) sites.modes.push_back({mode.mode, mode.dresspack});
  std::string names = file.stored("/site/component");
  if (!layout_ || sites != sites_ || names.empty() || names != stored_names_) {
    sites_ = sites;
    sites.component = file.read<std::string>("/site/component");
    layout_ = std::make_shared<const WireLayout>(layout_of(sites));
    stored_names_ = std::move(names);
  }
  for (std::uint32_t m = 0; m < modes.size(); ++m)
    if (is_damaged(modes[m]) && std::ranges::find(layout_->mode, m) == layout_->mode.end())
      throw InputError(file.where(), fmt::format("none of its conductors belongs to the mode '{}'", modes[m].mode),
                       "make the results again with dresslife run");
  return {layout_, file.read<double>("/damage"), modes.size()};
}

double DutyDamage::in_mode(std::size_t mode, std::size_t sample) const {
  double sum = 0, largest = 0;
  for (const auto& program : of_program)
    sum += program[mode][sample], largest = std::max(largest, program[mode][sample]);
  return at_least_alone(sum, largest, same_place[mode]);
}

void WireLayout::sort_sites() {
  std::vector<std::vector<std::uint32_t>> of_place(mode.size());
  for (std::uint32_t site = 0; site < wire.size(); ++site)
    if (wire[site] != nothing) of_place[place[wire[site]]].push_back(site);
  sites.clear(), sites_begin.assign(1, 0);
  for (std::vector<std::uint32_t>& all : of_place) {
    std::ranges::sort(all, {}, [this](std::uint32_t site) {
      return std::pair(wire[site], site);
    });  // of_place() needs wires together
    sites.insert(sites.end(), all.begin(), all.end());
    sites_begin.push_back(static_cast<std::uint32_t>(sites.size()));
  }
}

double WireDamage::of_place(const WireLayout& layout, std::size_t place, const double* damage) {
  thread_local std::vector<double> of_wire;
  of_wire.clear();
  std::uint32_t last = nothing;
  for (std::size_t at = layout.sites_begin[place]; at < layout.sites_begin[place + 1]; ++at, ++damage) {
    const std::uint32_t wire = layout.wire[layout.sites[at]];
    if (wire != last) of_wire.push_back(0), last = wire;
    of_wire.back() = std::max(of_wire.back(), *damage);
  }
  const auto failing = of_wire.begin() + static_cast<std::ptrdiff_t>(layout.failing[place] - 1);
  std::nth_element(of_wire.begin(), failing, of_wire.end(), std::greater<>());
  return *failing;
}

WireDamage::WireDamage(std::shared_ptr<const WireLayout> of, const std::vector<double>& damage, std::size_t modes)
    : layout(std::move(of)), in_order(layout->sites.size()), worst(modes, 0.0), largest(layout->mode.size(), 0.0) {
  std::ranges::transform(layout->sites, in_order.begin(), [&](std::uint32_t site) { return damage[site]; });
  for (std::size_t place = 0; place < largest.size(); ++place) {
    const double* const begin = in_order.data() + layout->sites_begin[place];
    for (const double* one = begin; one < in_order.data() + layout->sites_begin[place + 1]; ++one)
      largest[place] = std::max(largest[place], *one);
    if (double& of_mode = worst[layout->mode[place]]; largest[place] > of_mode)
      of_mode = std::max(of_mode, of_place(*layout, place, begin));
  }
}

SamePlace::SamePlace(const std::vector<EvaluatedProgram>& programs, const WireDamage* round)
    : modes_(programs.front().modes->size()), program_count_(programs.size()) {
  for (const EvaluatedProgram& program : programs) programs_.push_back(program.wires.get());
  if (round) programs_.push_back(round);
}

/// Returns the damage of the wire whose break makes a place fail, per hour.
double SamePlace::at_place(std::uint32_t place, const std::vector<double>& in_rounds) const {
  const WireLayout& layout = *programs_.front()->layout;
  const std::size_t begin = layout.sites_begin[place], count = layout.sites_begin[place + 1] - begin;
  std::vector<double> sums(count, 0.0);
  for (std::size_t p = 0; p < programs_.size(); ++p) {
    const double* const damage = programs_[p]->in_order.data() + begin;
    for (std::size_t k = 0; k < count; ++k) sums[k] += in_rounds[p] * damage[k];
  }
  return WireDamage::of_place(layout, place, sums.data());
}

std::vector<double> SamePlace::at(const std::vector<double>& repeats_per_hour,
                                  const std::vector<double>& in_rounds) const {
  const WireLayout& layout = *programs_.front()->layout;
  std::vector<double> apart(modes_, 0.0), share(modes_, 0.0), rounds = in_rounds;
  rounds.resize(programs_.size());  // a duty whose round is not counted has no rate of it
  for (std::size_t k = 0; k < program_count_; ++k)
    for (std::size_t m = 0; m < modes_; ++m) apart[m] += repeats_per_hour[k] * programs_[k]->worst[m];
  // No wire of a place has more damage than the sum of the largest damages there. So few places need the sum over their wires.
  std::vector<double> most(layout.mode.size(), 0.0);
  for (std::size_t p = 0; p < programs_.size(); ++p)
    for (std::size_t place = 0; place < most.size(); ++place) most[place] += rounds[p] * programs_[p]->largest[place];
  constexpr double rounding = 1 + 1e-12;  // of sums over programs
  for (const std::size_t place : largest_first(most))
    if (double& worst = share[layout.mode[place]]; most[place] * rounding > worst)
      worst = std::max(worst, at_place(static_cast<std::uint32_t>(place), rounds));
  for (std::size_t m = 0; m < modes_; ++m) share[m] = apart[m] > 0 ? share[m] / apart[m] : 1;
  return share;
}

RepeatDamage damage_of_lives(std::vector<std::vector<double>> log10_lives) {
  for (std::vector<double>& of_mode : log10_lives)
    for (double& life : of_mode) life = std::pow(10.0, -life);
  return log10_lives;
}

std::vector<double> repeat_factors(const std::string& job, double deviation_percent, const std::string& dresspack,
                                   std::size_t samples, std::vector<double> memory) {
  const double deviation = log_deviation(deviation_percent);
  if (!(deviation > 0)) return std::vector<double>(samples, 1.0);
  thread_local std::vector<double>
      factors;  // factors of the previous deviation: thousands of programs have the same one
  thread_local double of_deviation = 0;
  if (factors.size() != samples || of_deviation != deviation) {
    factors = standard_strata(samples), of_deviation = deviation;
    for (double& z : factors) z = std::exp(deviation * z);
  }
  memory = factors;
  return in_order_of("repeats of " + job + "/job " + dresspack, std::move(memory));
}

DutyDamage damage_under(const std::vector<EvaluatedProgram>& programs, const std::vector<Rate>& rates,
                        const std::vector<double>& share, const std::string& dresspack, std::size_t samples) {
  RepeatDamage damage;
  std::vector<double> factors;
  return damage_under(
      programs, rates, share,
      [&](const EvaluatedProgram& program) -> const RepeatDamage& {
        return damage = damage_of_lives(mode_lives(*program.modes, dresspack, samples));
      },
      [&](const EvaluatedProgram& program, double deviation_percent) -> const std::vector<double>& {
        return factors = repeat_factors(program.job, deviation_percent, dresspack, samples);
      });
}

DutyDamage damage_under(const std::vector<EvaluatedProgram>& programs, const std::vector<Rate>& rates,
                        const std::vector<double>& share,
                        const std::function<const RepeatDamage&(const EvaluatedProgram&)>& of_repeat,
                        const std::function<const std::vector<double>&(const EvaluatedProgram&, double)>& factors_of) {
  DutyDamage duty;
  duty.same_place = share;
  for (std::size_t k = 0; k < programs.size(); ++k) {
    const std::vector<double>& factors = factors_of(programs[k], rates[k].deviation_percent);
    RepeatDamage damage = of_repeat(programs[k]);
    for (std::size_t m = 0; m < damage.size(); ++m) {
      const double repeats = duty.same_place[m] * rates[k].repeats_per_hour;
      for (std::size_t s = 0; s < factors.size(); ++s) damage[m][s] *= repeats * factors[s];
    }
    duty.of_program.push_back(std::move(damage));
  }
  return duty;
}

std::vector<double> first_mode_damage(
    const std::vector<EvaluatedProgram>& programs, const std::vector<Rate>& rates, const std::vector<double>& share,
    const std::function<const RepeatDamage&(const EvaluatedProgram&)>& of_repeat,
    const std::function<const std::vector<double>&(const EvaluatedProgram&, double)>& factors_of) {
  thread_local RepeatDamage sums, largest;  // a plan of 500 duties needs them 32,000 times
  for (std::size_t k = 0; k < programs.size(); ++k) {
    const std::vector<double>& factors = factors_of(programs[k], rates[k].deviation_percent);
    const RepeatDamage& damage = of_repeat(programs[k]);
    if (k == 0)
      for (RepeatDamage* const list : {&sums, &largest}) {
        list->resize(damage.size());
        for (std::vector<double>& of_mode : *list) of_mode.assign(factors.size(), 0.0);
      }
    for (std::size_t m = 0; m < damage.size(); ++m) {
      const double repeats = share[m] * rates[k].repeats_per_hour;
      for (std::size_t s = 0; s < factors.size(); ++s) {
        const double of_program = damage[m][s] * (repeats * factors[s]);
        sums[m][s] += of_program;
        largest[m][s] = std::max(largest[m][s], of_program);
      }
    }
  }
  std::vector<double> worst(sums.front().size(), 0.0);
  for (std::size_t m = 0; m < sums.size(); ++m)
    for (std::size_t s = 0; s < worst.size(); ++s)
      worst[s] = std::max(worst[s], at_least_alone(sums[m][s], largest[m][s], share[m]));
  return worst;
}

std::vector<double> DutyDamage::of_first_mode() const {
  std::vector<double> damage(samples(), 0.0);
  for (std::size_t s = 0; s < damage.size(); ++s)
    for (std::size_t m = 0; m < modes(); ++m) damage[s] = std::max(damage[s], in_mode(m, s));
  return damage;
}

DutyLives lives_under(const DutyDamage& duty, const std::vector<PastDamage>& history) {
  DutyLives lives;
  const std::size_t programs = duty.of_program.size(), samples = duty.samples();
  const std::vector<double> damage = duty.of_first_mode();
  for (const double of_sample : damage) lives.log10_hours.push_back(log10_life(of_sample));
  lives.percentiles = percentiles_of(lives.log10_hours);
  lives.share.assign(programs, 0.0);
  double damaged = 0;
  for (std::size_t s = 0; s < samples; ++s) {
    if (!(damage[s] > 0)) continue;
    ++damaged;
    std::size_t first = 0;
    for (std::size_t m = 1; m < duty.modes(); ++m)
      if (duty.in_mode(m, s) > duty.in_mode(first, s)) first = m;
    double all = 0;
    for (std::size_t k = 0; k < programs; ++k) all += duty.of_program[k][first][s];
    for (std::size_t k = 0; k < programs; ++k) lives.share[k] += duty.of_program[k][first][s] / all;
  }
  for (double& share : lives.share) share = damaged > 0 ? share / damaged : 0;
  if (history.empty()) return lives;
  std::vector<double> remaining;
  for (std::size_t s = 0; s < samples; ++s) {
    double left = infinity;
    for (std::size_t m = 0; m < duty.modes(); ++m) {
      const double used =
          sum_of(history, [&](const PastDamage& past) { return past.hours * past.duty->in_mode(m, s); });
      const double rate = duty.in_mode(m, s);
      left = std::min(left, used >= 1 ? 0 : rate > 0 ? (1 - used) / rate : infinity);
    }
    if (left > 0) remaining.push_back(std::log10(left));
  }
  lives.survived = static_cast<double>(remaining.size()) / static_cast<double>(samples);
  if (!remaining.empty()) lives.remaining = percentiles_of(std::move(remaining));
  return lives;
}

LifePercentiles lives_with(const DutyDamage& duty, const std::vector<double>& times, const std::vector<double>& share) {
  std::vector<double> lives;
  for (std::size_t s = 0; s < duty.samples(); ++s) {
    double worst = 0;
    for (std::size_t m = 0; m < duty.modes(); ++m) {
      double sum = 0, largest = 0;
      for (std::size_t k = 0; k < times.size(); ++k) {
        const double of_program = times[k] * duty.of_program[k][m][s] * share[m] / duty.same_place[m];
        sum += of_program;
        largest = std::max(largest, of_program);
      }
      worst = std::max(worst, at_least_alone(sum, largest, share[m]));
    }
    lives.push_back(log10_life(worst));
  }
  return percentiles_of(std::move(lives));
}

}  // namespace dresslife::pipeline
