#include "strain/loose/loose_cables.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

namespace dresslife::strain {
namespace {

constexpr int feeding_rounds = 100;  // 1 % of slack in 2 m grows by 0.2 mm in each round
constexpr int most_rounds = 200;     // then at most so many rounds until all cables rest: 8 s at 25 Hz
// Cables that do not come to rest at a sample, because they snap far, get the time of so many samples in which the hose stands still.
// Eight suffice in all of 24 cases with bends and twists of up to 8 1/m (rms) from sample to sample (strain/measurements.md).
constexpr int most_pauses = 8;
constexpr double settled = 1e-7;  // change of strain in a round: 0.1 N of a cable of 1 MN
// Relative change of curvature that the rest of a lead-in may still cause in cables that stop. It changes a life by 9 % (exponent
// 1/0.112 of copper), an eighth of the least stated error, a factor of two.
constexpr double same_cycle = 1e-2;

}  // namespace

double winding_radius(const LooseCable& cable) {
  return std::min(cable.play, cable.ring == no_ring ? cable.farthest : std::hypot(cable.place[0], cable.place[1]));
}

std::size_t elements_of_waves(const std::vector<LooseCable>& cables, double length) {
  constexpr double least = 104, missed = 0.0025;
  double piece = length / least;
  for (const LooseCable& cable : cables)
    if (const double room = winding_radius(cable); room > 0)
      piece = std::min(piece, std::sqrt(12 * missed) / (std::sqrt(2 * cable.slack) / room + std::abs(cable.lay_rate)));
  return static_cast<std::size_t>(std::ceil(length / piece));
}

LooseCables::LooseCables(const std::vector<LooseCable>& cables, const LooseSettings& settings)
    : settings_(settings),
      hose_(settings.length, settings.elements),
      lines_(cables, hose_, settings.rest_curvature,
             settings.presses ? CableLines::Use::presses : CableLines::Use::rests),
      bench_(hose_),
      frames_(cables.size(), &hose_.turn),
      states_(cables.size()) {
  assert(settings.elements >= 4 && settings.length > 0);
  std::map<int, std::vector<std::size_t>> members;  // (ring)
  for (std::size_t k = 0; k < cables.size(); ++k)
    if (cables[k].ring != no_ring) members[cables[k].ring].push_back(k);
  in_ring_.resize(cables.size());
  rings_.reserve(members.size());
  for (const auto& [number, of_ring] : members) {
    std::vector<LooseCable> lying;
    for (const std::size_t k : of_ring) lying.push_back(cables[k]);
    Ring& ring = rings_.emplace_back(lying, hose_, settings.rest_curvature);
    of_ring_.push_back(of_ring);
    std::vector<double>& radii = radii_.emplace_back(cables.size(), 0.0);
    for (const std::size_t k : of_ring) radii[k] = std::hypot(cables[k].place[0], cables[k].place[1]);
    for (std::size_t place = 0; place < of_ring.size(); ++place) {
      frames_[of_ring[place]] = &ring.frame();
      in_ring_[of_ring[place]] = {&ring, place};
    }
  }
}

bool LooseCables::same_cables(const LooseCables& other) const {
  if (!(settings_ == other.settings_) || cables() != other.cables()) return false;
  for (std::size_t k = 0; k < cables(); ++k)
    if (!(cable(k) == other.cable(k))) return false;
  return true;
}

void LooseCables::wind(std::uint64_t seed) {
  wound_ = true;
  for (Ring& ring : rings_) {
    double radius = 0, slack = 0, members = 0;
    for (std::size_t k = 0; k < cables(); ++k) {
      if (in_ring_[k].first != &ring) continue;
      radius += std::hypot(cable(k).place[0], cable(k).place[1]);
      slack += cable(k).slack;
      ++members;
    }
    ring.wind(random_winding(nodes(), length(), radius / members, slack / members, seed++));
  }
}

void LooseCables::wind(const std::vector<double>& turn) {
  wound_ = true;
  for (Ring& ring : rings_) ring.wind(turn);
}

void LooseCables::go_on_from(const LooseCables& other) {
  assert(cables() == other.cables() && rings_.size() == other.rings_.size() && nodes() == other.nodes());
  for (std::size_t k = 0; k < rings_.size(); ++k) rings_[k].go_on_from(other.rings_[k]);
  lines_.go_on_from(other.lines_);
  started_ = other.started_;
}

void LooseCables::feed_in(double share) {
  for (Ring& ring : rings_) ring.feed_in(share);
  lines_.feed_in(share);
}

namespace {

/// Returns the difference of two curvatures (node) of each cable over the first: root mean squares over cables and nodes. at: (cable).
double relative_difference(std::size_t cables, const auto& one_at, const auto& other_at) {
  double difference = 0, bent = 0;
  for (std::size_t k = 0; k < cables; ++k) {
    const std::vector<double>&one = one_at(k), &other = other_at(k);
    for (std::size_t i = 0; i < one.size(); ++i) {
      difference += std::pow(one[i] - other[i], 2);
      bent += std::pow(one[i], 2);
    }
  }
  return bent > 0 ? std::sqrt(difference / bent) : 0;
}

}  // namespace

double LooseCables::apart(const LooseCables& other) const {
  const auto of = [](const LooseCables& all) {
    return [&all](std::size_t k) -> const std::vector<double>& { return all.states_[k].curvature; };
  };
  return relative_difference(cables(), of(*this), of(other));
}

void LooseCables::end_repeat(double further) {
  in_cycle_ = !begun_.empty() && changed() * further < same_cycle;
  begin_repeat();
}

void LooseCables::begin_repeat() {
  restless_ = 0;
  begun_.clear();
  for (const CableState& state : states_) begun_.push_back(state.curvature);
}

double LooseCables::changed() const {
  if (begun_.empty()) return 0;
  return relative_difference(
      cables(), [this](std::size_t k) -> const std::vector<double>& { return states_[k].curvature; },
      [this](std::size_t k) -> const std::vector<double>& { return begun_[k]; });
}

ChangedPlace LooseCables::most_changed() const {
  ChangedPlace most;
  double most_sum = 0;
  for (std::size_t k = 0; k < cables(); ++k) {
    const std::vector<double>&end = states_[k].curvature, &begin = begun_[k];
    double sum = 0, largest = 0;
    std::size_t node = 0;
    for (std::size_t i = 0; i < end.size(); ++i) {
      const double change = std::abs(end[i] - begin[i]);
      sum += change * change;
      if (change > largest) largest = change, node = i;
    }
    if (sum <= most_sum) continue;
    most_sum = sum;
    most = {k, length() * static_cast<double>(node / 2) / static_cast<double>(nodes() - 1)};
  }
  return most;
}

void LooseCables::shorten(std::size_t cable, double share) {
  lines_.shorten(cable, share);
  if (const auto& [ring, number] = in_ring_[cable]; ring) ring->shorten(number, share);
}

void LooseCables::advance(std::span<const HoseNode> hose, double step) {
  LooseCables* const alone = this;
  advance({&alone, 1}, hose, step);
}

void LooseCables::advance(std::span<LooseCables* const> all, std::span<const HoseNode> hose, double step, bool seen) {
  HoseLine& first = all.front()->hose_;
  first.take(hose, all.front()->settings_.rest_curvature);
  for (LooseCables* const of : all) {
    assert(of->settings_ == all.front()->settings_ && of->started_ == all.front()->started_);
    if (of != all.front()) of->hose_ = first;
    if (!of->started_) of->settle(step);
  }
  relax(all, step, seen);
  for (LooseCables* of : all) {
    for (int k = 0; k < most_pauses && !of->rests_; ++k) relax({&of, 1}, step, seen);
    of->restless_ += !of->rests_;
  }
}

/// Moves the cables from their places to their rests at the first sample. A cable with excess length has many rests. The one
/// found is that of an excess length fed in step by step. A wound ring starts with all of it.
void LooseCables::settle(double step) {
  double before = without_limit;
  for (int round = wound_ ? feeding_rounds : 0; round < feeding_rounds + (wound_ ? 1 : most_rounds); ++round) {
    const double share = std::min(1.0, static_cast<double>(round) / feeding_rounds);
    feed_in(share);
    LooseCables* const alone = this;
    relax({&alone, 1}, step, true);
    started_ = false;  // no velocity is carried over from round to round
    double sum = 0;
    for (const CableState& state : states_) sum += std::abs(state.strain);
    if (round > feeding_rounds && std::abs(sum - before) < settled * static_cast<double>(cables())) break;
    before = sum;
  }
}

void LooseCables::relax(std::span<LooseCables* const> all, double step, bool seen) {
  std::vector<CableLines*> lines;
  for (LooseCables* const of : all) {
    of->begin(step);
    lines.push_back(&of->lines_);
  }
  const bool started = all.front()->started_;
  const int most = started ? CableLines::most_iterations : CableLines::most_iterations_at_start;
  all.front()->bench_.relax(lines, most);
  for (LooseCables* const of : all) of->end(step, most, seen);
}

void LooseCables::begin(double step) {
  rests_ = true;
  for (std::size_t ring = 0; ring < rings_.size(); ++ring) {
    rings_[ring].take_friction(lines_, of_ring_[ring]);
    rests_ &= rings_[ring].advance(hose_, step, started_);
    lines_.carry(radii_[ring], rings_[ring].last_turn());
  }
  lines_.begin(hose_, frames_, step, started_, started_);
}

void LooseCables::end(double step, int most, bool seen) {
  for (const std::int32_t took : lines_.iterations()) {
    iterations_ += static_cast<std::size_t>(took);
    rests_ &= took < most;
  }
  lines_.end(hose_, started_ ? step : 0, states_, seen);
  started_ = true;
}

double LooseCables::mesh_error() const {
  double largest = 0;
  for (std::size_t k = 0; k < cables(); ++k)
    if (lines_.bent(k) > 0) largest = std::max(largest, std::sqrt(lines_.missed(k) / lines_.bent(k)));
  return largest;
}

}  // namespace dresslife::strain
