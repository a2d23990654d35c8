#include "pipeline/report/life_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "pipeline/base/lists.h"
#include "pipeline/base/order.h"
#include "pipeline/files/motion_layout.h"
#include "pipeline/report/json.h"
#include "pipeline/report/known_history.h"
#include "pipeline/report/marked_place.h"
#include "pipeline/report/motion_data.h"
#include "pipeline/report/stored_job.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {
namespace {

constexpr std::uint32_t no_site = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t most_strains = 200'000;  // samples of complete histories, two bytes each
constexpr std::size_t most_turns = 30'000;     // turning points of other places, six bytes each
constexpr std::size_t most_life_samples = 20'000;
constexpr std::size_t most_closings = 300;  // per segment
constexpr double least_closing = 1e-4;      // share of a segment's damage: 0.01 %
constexpr int cycle_cells = 24;  // number of cells along range and along mean, each wide enough for a thumb on a phone

/// Reduces a long history to the two extremes of each of equal intervals, in the order of time; keeps a short one.
class Thinning {
 public:
  explicit Thinning(std::size_t samples) : samples_(samples), stretch_(1 + (samples - 1) / most_life_samples * 2) {}

  bool thins() const { return stretch_ > 1; }
  std::size_t length() const { return thins() ? 2 * ((samples_ + stretch_ - 1) / stretch_) : samples_; }

  std::vector<double> of(const std::vector<double>& history) const { return at(history, kept(history)); }
  /// Returns the samples of a history that are kept.
  std::vector<std::size_t> kept(const std::vector<double>& history) const {
    if (!thins()) return indices_of(samples_);
    std::vector<std::size_t> samples;
    for (std::size_t from = 0; from < samples_; from += stretch_) {
      const auto begin = history.begin() + static_cast<std::ptrdiff_t>(from),
                 end = history.begin() + static_cast<std::ptrdiff_t>(std::min(from + stretch_, samples_));
      const auto [low, high] = std::minmax_element(begin, end);
      samples.push_back(static_cast<std::size_t>(std::min(low, high) - history.begin()));
      samples.push_back(static_cast<std::size_t>(std::max(low, high) - history.begin()));
    }
    return samples;
  }
  static std::vector<double> at(const std::vector<double>& history, const std::vector<std::size_t>& samples) {
    return mapped(samples, [&](std::size_t sample) { return history[sample]; });
  }
  std::vector<float> times(const std::vector<double>& time) const {
    std::vector<float> thin;
    for (std::size_t k = 0; k < length(); ++k) {
      const std::size_t sample = thins() ? std::min(k / 2 * stretch_ + k % 2 * stretch_ / 2, samples_ - 1) : k;
      thin.push_back(static_cast<float>(time[sample] - time[0]));
    }
    return thin;
  }

 private:
  std::size_t samples_, stretch_;
};

class Data {
 public:
  Data(const FileReader& life, const FileReader* strain)
      : life_(life),
        strain_(strain),
        time_(life.read<double>("/time")),
        damage_(life.read<double>("/segment/damage")),
        worst_site_(life.read<std::uint32_t>("/segment/worst_site")),
        thinning_(time_.size()) {
    const double worst = life.number_attribute("worst_site");
    if (worst >= 0) worst_ = static_cast<std::uint32_t>(worst);
  }

  Json json() const {
    Json data = attributes();
    data.add("segments", segments()).add("strains", strains()).add("closings", closings());
    if (const auto of_worst = cycles()) data.add("cycles", *of_worst);
    if (const auto of_worst = loops()) data.add("loops", *of_worst);
    data.add("program", program_data(life_).add("damage", life_.read<double>("/program/damage")));
    return data.add("joints",
                    life_.has("/joint/name") ? life_.read<std::string>("/joint/name") : std::vector<std::string>{});
  }

 private:
  Json attributes() const {
    Json data{};
    for (const char* name :
         {"life_hours", "life_repeats", "damage_per_repeat", "repeat_seconds", "worst_time", "worst_segment_from_tool"})
      data.add(name, life_.number_attribute(name));
    return data.add("worst_component", life_.text_attribute("worst_component"))
        .add("worst_segment", worst_segment())
        .add("marked", marked());
  }

  /// Returns the place that the page marks and shows first; segment -1: none.
  Json marked() const {
    const std::optional<MarkedPlace> place = marked_place(life_);
    if (!place) return Json{{"segment", -1}};
    return Json{{"segment", place->segment},
                {"time", place->time},
                {"words", place->fails_first ? "fails first" : "the worst wire"}};
  }

  /// Returns the index in the file; -1: none.
  int worst_segment() const {
    if (!worst_) return -1;
    std::vector<std::int32_t> of;
    life_.read_rows("/site/segment", *worst_, 1, of);
    return of.front();
  }

  Json segments() const {
    std::vector<std::string> wires;
    for (const std::uint32_t site : worst_site_) {
      std::vector<std::string> path{""};
      if (site != no_site) life_.read_rows("/site/component", site, 1, path);
      wires.push_back(path.front());
    }
    Json data{{"length", life_.read<double>("/segment/length")},
              {"damage", damage_},
              {"wire", wires},
              {"dresspack", of_dresspack()}};
    if (life_.has("/hose/damage")) data.add("hose_damage", life_.read<double>("/hose/damage"));
    return strain_ ? data.add(extremes()) : data;
  }

  std::vector<double> of_dresspack() const {
    const std::vector<std::size_t> of = dresspack_of_segments(life_);
    return {of.begin(), of.end()};
  }

  /// Returns the extremes over all samples: largest curvature and its time, least and largest twist.
  Json extremes() const {
    const std::size_t segments = damage_.size();
    std::vector<double> curvature(segments, 0.0), when(segments, 0.0), least(segments, INFINITY),
        most(segments, -INFINITY);
    const auto pairs = strain_->read<double>("/deformation/curvature"),
               twist = strain_->read<double>("/deformation/twist");
    for (std::size_t k = 0; k < time_.size(); ++k)
      for (std::size_t s = 0; s < segments; ++s) {
        const std::size_t at = k * segments + s;
        const double here = std::hypot(pairs[2 * at], pairs[2 * at + 1]);
        if (here > curvature[s]) {
          curvature[s] = here;
          when[s] = time_[k];
        }
        least[s] = std::min(least[s], twist[at]);
        most[s] = std::max(most[s], twist[at]);
      }
    return {{"largest_curvature", curvature},
            {"largest_curvature_time", when},
            {"least_twist", least},
            {"largest_twist", most}};
  }

  /// A wire with a complete history in strain.h5.
  struct ProbedWire {
    std::size_t row;  ///< row in /probe/strain
    std::uint32_t site;
    double damage;
  };

  /// Returns, (segment), the most damaged of its probed wires.
  std::map<std::size_t, ProbedWire> probes() const {
    std::map<std::size_t, ProbedWire> of;
    if (!strain_) return of;
    const auto sites = strain_->read<std::uint32_t>("/probe/site");
    std::vector<std::int32_t> segment;
    std::vector<double> damage;
    for (std::size_t k = 0; k < sites.size(); ++k) {
      life_.read_rows("/site/segment", sites[k], 1, segment);
      life_.read_rows("/damage", sites[k], 1, damage);
      const ProbedWire probe{k, sites[k], damage.front()};
      const auto [known, first] = of.emplace(static_cast<std::size_t>(segment.front()), probe);
      if (!first && probe.damage > known->second.damage) known->second = probe;
    }
    return of;
  }

  /// Returns one history, at its own times or at the common times. sampled: whether it is complete; else only turning points.
  /// site: the site of the wire; by default the segment's worst site.
  Json strain_row(std::size_t segment, bool sampled, const std::vector<double>& strain,
                  const std::vector<float>& own_times = {}, const ProbedWire* of = nullptr) const {
    const bool other = of && of->site != worst_site_[segment];
    std::vector<std::string> path{""};
    if (other) life_.read_rows("/site/component", of->site, 1, path);
    Json row{{"segment", segment}, {"sampled", sampled}};
    if (other) row.add("wire", path.front()).add("damage", of->damage);
    if (!own_times.empty()) row.add("time", base64_of(own_times));
    return row.add("numbers", packed(strain));
  }

  /// Returns the turning points of a segment's worst wire: times after the first sample [s], strains.
  std::pair<std::vector<float>, std::vector<double>> turning_points(std::size_t segment) const {
    std::vector<std::uint64_t> range;
    std::vector<double> strain;
    std::vector<std::uint32_t> sample;
    strain_->read_rows("/reversal/offset", worst_site_[segment], 2, range);
    strain_->read_rows("/reversal/strain", range[0], range[1] - range[0], strain);
    strain_->read_rows("/reversal/sample", range[0], range[1] - range[0], sample);
    const auto since_begin = [&](std::uint32_t at) {
      return static_cast<float>(time_.at(std::min<std::size_t>(at, time_.size() - 1)) - time_[0]);
    };
    return {mapped(sample, since_begin), strain};
  }

  /// Returns the history of one wire per segment: of the most damaged wire with a complete history; else the turning points of
  /// the worst wire. For the job's worst wire the turning points are added.
  Json strains() const {
    const auto probed = probes();
    const int worst = worst_segment();
    std::vector<Json> rows;
    std::size_t kept = 0;
    const bool worst_known = worst_ && strain_ && known_whole(*strain_, *worst_);
    std::size_t turns = 0;
    for (const std::size_t segment : largest_first(damage_)) {
      const bool worst_one = static_cast<int>(segment) == worst;
      if (worst_site_[segment] == no_site || (!strain_ && !worst_one)) continue;
      const auto probe = probed.find(segment);
      const bool room = kept + thinning_.length() <= most_strains || worst_one;
      if (worst_one && (worst_known || probe == probed.end())) {
        rows.push_back(strain_row(segment, worst_known, thinning_.of(life_.read<double>("/worst/strain"))));
      } else if (room && probe != probed.end()) {
        std::vector<double> history;
        strain_->read_rows("/probe/strain", probe->second.row, 1, history);
        rows.push_back(strain_row(segment, true, thinning_.of(history), {}, &probe->second));
      } else {
        const auto [times, strain] = turning_points(segment);
        if (!strain.empty() && (turns += strain.size()) <= most_turns)
          rows.push_back(strain_row(segment, false, strain, times));
        continue;
      }
      kept += thinning_.length();
    }
    Json data{{"thinned", thinning_.thins()}, {"time", base64_of(thinning_.times(time_))}, {"rows", rows}};
    if (const auto of_worst = worst_turns(worst, worst_known)) data.add("turns", *of_worst);
    return data;
  }

  /// Returns the turning points of the job's worst wire if its complete history is not known.
  std::optional<Json> worst_turns(int worst, bool known) const {
    if (worst < 0 || known || !strain_) return {};
    const auto [times, strain] = turning_points(static_cast<std::size_t>(worst));
    if (strain.empty()) return {};
    return Json{{"time", base64_of(times)}, {"strain", packed(strain)}};
  }

  /// Returns the closings of cycles: per segment the sum of the damage, then times and damages of the largest closings.
  Json closings() const {
    std::vector<Json> rows;
    std::vector<double> rate;
    for (std::size_t segment = 0; segment < damage_.size(); ++segment) {
      if (!(damage_[segment] > 0)) continue;
      life_.read_rows("/damage_rate", segment, 1, rate);
      std::vector<std::size_t> at;
      for (std::size_t k = 0; k < rate.size(); ++k)
        if (rate[k] > least_closing * damage_[segment]) at.push_back(k);
      if (at.size() > most_closings) {
        std::nth_element(at.begin(), at.begin() + most_closings, at.end(),
                         [&](auto a, auto b) { return rate[a] > rate[b]; });
        at.resize(most_closings);
        std::ranges::sort(at);
      }
      std::vector<float> pairs;
      for (const std::size_t k : at) {
        pairs.push_back(static_cast<float>(time_[k] - time_[0]));
        pairs.push_back(static_cast<float>(rate[k] / damage_[segment]));
      }
      rows.push_back({{"segment", segment}, {"pairs", base64_of(pairs)}});
    }
    return rows;
  }

  /// Returns the worst site's cycles by range and mean. Each cell with cycles has its place, their number, their damage, and the
  /// time at which the most damaging one closes.
  std::optional<Json> cycles() const {
    if (!worst_) return {};
    struct Cell {
      double count = 0, damage = 0, most = -1, time = 0;
    };
    const auto site = life_.read<std::uint32_t>("/cycles/site"), end = life_.read<std::uint32_t>("/cycles/end");
    const auto range = life_.read<double>("/cycles/range"), mean = life_.read<double>("/cycles/mean"),
               count = life_.read<double>("/cycles/count"), damage = life_.read<double>("/cycles/damage");
    double high = 0, low_mean = INFINITY, high_mean = -INFINITY;
    for (std::size_t k = 0; k < site.size(); ++k) {
      if (site[k] != *worst_) continue;
      high = std::max(high, range[k]);
      low_mean = std::min(low_mean, mean[k]);
      high_mean = std::max(high_mean, mean[k]);
    }
    if (!(high > 0)) return {};
    const auto place = [](double value, double low, double width) {
      return width > 0 ? std::min(cycle_cells - 1, static_cast<int>((value - low) / width * cycle_cells)) : 0;
    };
    std::map<std::pair<int, int>, Cell> cells;
    for (std::size_t k = 0; k < site.size(); ++k) {
      if (site[k] != *worst_) continue;
      Cell& cell = cells[{place(mean[k], low_mean, high_mean - low_mean), place(range[k], 0, high)}];
      cell.count += count[k];
      cell.damage += damage[k];
      if (damage[k] <= cell.most) continue;
      cell.most = damage[k];
      cell.time = time_.at(std::min<std::size_t>(end[k], time_.size() - 1));
    }
    std::vector<std::vector<double>> rows;
    for (const auto& [at, cell] : cells)
      rows.push_back({double(at.first), double(at.second), cell.count, cell.damage, cell.time});
    return Json{
        {"cells", cycle_cells}, {"range", high}, {"low_mean", low_mean}, {"high_mean", high_mean}, {"rows", rows}};
  }

  /// Returns stress over strain of the worst site.
  std::optional<Json> loops() const {
    if (!worst_ || !life_.has("/worst/stress")) return {};
    const auto strain = life_.read<double>("/worst/strain"), stress = life_.read<double>("/worst/stress");
    const std::vector<std::size_t> kept = thinning_.kept(strain);
    const auto times = mapped(kept, [&](std::size_t sample) { return static_cast<float>(time_[sample] - time_[0]); });
    return Json{{"rule", stress_rule()},
                {"time", base64_of(times)},
                {"strain", packed(Thinning::at(strain, kept))},
                {"stress", packed(Thinning::at(stress, kept))}};
  }

  /// Returns the name of the stress law.
  std::string stress_rule() const {
    const Node job = stored_job(life_);
    const Node* fatigue = job.find("fatigue");
    const Node* stress = fatigue ? fatigue->find("stress") : nullptr;
    return !stress ? "stress as fatigue.stress has it"
           : stress->text == "elastic"
               ? "E times strain (fatigue.stress: elastic), shifted by the part of its mean stress that relaxes"
               : "by the cyclic curve of its metal and Masing's rule (fatigue.stress: cyclic; E times strain where a strain-life "
                 "table is given), shifted by the part of its mean stress that relaxes. Where it is one line, the "
                 "metal hardly yields";
  }

  static Json packed(const std::vector<double>& values) {
    const auto [low, high] = std::ranges::minmax_element(values);
    const Steps steps(*low, *high);
    return {{"low", steps.low},
            {"step", steps.step},
            {"numbers", base64_of(mapped(values, [&](double value) { return steps.of(value); }))}};
  }

  const FileReader& life_;
  const FileReader* strain_;
  std::vector<double> time_, damage_;
  std::vector<std::uint32_t> worst_site_;
  Thinning thinning_;
  std::optional<std::uint32_t> worst_;
};

}  // namespace

Json life_data(const FileReader& life, const FileReader* strain) { return Data(life, strain).json(); }

}  // namespace dresslife::pipeline
