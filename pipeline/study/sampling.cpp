#include "pipeline/study/sampling.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "pipeline/base/digest.h"
#include "pipeline/base/random.h"
#include "pipeline/base/statistics.h"
#include "pipeline/settings/fields.h"
#include "pipeline/settings/units.h"

namespace dresslife::pipeline {

namespace {

constexpr const char* ways = "write !normal {mean: M, deviation: S}, !uniform [LOW, HIGH] or !choice [A, B, ...]";

struct Bounds {
  std::vector<double> values;
};
void describe(Fields& f, Bounds& bounds) { f.numbers("uniform", bounds.values, Need::required, "low, high"); }

/// Returns a tree with one key, so that errors contain the name of the key.
Node under(const char* key, const Node& value) {
  Node root;
  root[key] = value;
  root.where = value.where;
  return root;
}

struct Sample {
  int jobs = 0, seed = 1;
  SamplingMethod method = SamplingMethod::latin_hypercube;
};

void describe(Fields& f, Sample& sample) {
  f.integer("jobs", sample.jobs, Need::required, between(1, most_jobs), "The number of samples.");
  f.integer("seed", sample.seed, Need::optional, between(0, 1e9), "The seed of the random numbers.");
  f.choice("method", sample.method,
           "The method of sampling. latin_hypercube: each nth of a distribution once. random: independent "
           "samples, so that more `jobs` keep the previous ones.");
}

}  // namespace

void describe(Fields& f, Distribution::Normal& normal) {
  f.number("mean", normal.mean, Need::required, any_number(), "");
  f.number("deviation", normal.deviation, Need::required, above(0), "standard deviation");
  f.maybe_number("at_least", normal.at_least, any_number(), "values below do not occur");
  f.maybe_number("at_most", normal.at_most, any_number(), "values above do not occur");
}

Distribution::Normal Distribution::normal_from(const std::string& path, const Node& written) {
  Normal normal;
  read_fields(under("normal", written), Describe([&](Fields& f) { f.group("normal", normal, Need::required, ""); }));
  const auto below = [&](double value) { return normal_share((value - normal.mean) / normal.deviation); };
  normal.share_below = normal.at_least ? below(*normal.at_least) : 0;
  normal.share_within = (normal.at_most ? below(*normal.at_most) : 1) - normal.share_below;
  constexpr double least_share = 1e-6;  // below this share the rounding of shares would dominate the quantiles
  if (!(normal.share_within >= least_share))
    throw InputError(written.where, fmt::format("between at_least and at_most of {} lies none of its !normal", path),
                     "let them enclose the mean or come near it");
  return normal;
}

Distribution Distribution::from(const std::string& path, const Node& written) {
  Distribution made;
  const bool tagged = written.is_map() && written.entries.size() == 1;
  const std::string kind = tagged ? written.entries.front().key : "";
  const auto refuse = [&](const std::string& what) { throw InputError(written.where, what, ways); };
  if (kind == "!normal") {
    if (!written.entries.front().value.is_map()) refuse(fmt::format("!normal of {} must be a map", path));
    made.normal_ = normal_from(path, written.entries.front().value);
  } else if (kind == "!uniform") {
    const Node& list = written.entries.front().value;
    Bounds bounds;
    read_fields(under("uniform", list), bounds);
    if (bounds.values.size() != 2 || !(bounds.values[0] < bounds.values[1]))
      refuse(fmt::format("!uniform of {} must be two rising numbers", path));
    made.low_ = bounds.values[0];
    made.high_ = bounds.values[1];
  } else if (kind == "!choice") {
    made.choices_ = written.entries.front().value.items;
    if (made.choices_.empty()) refuse(fmt::format("!choice of {} must be a list of values", path));
  } else {
    refuse(fmt::format("{} has no distribution", path));
  }
  return made;
}

Node Distribution::value_at(double u) const {
  if (!choices_.empty()) {
    const auto index = static_cast<std::size_t>(u * static_cast<double>(choices_.size()));
    return choices_[std::min(index, choices_.size() - 1)];
  }
  if (!normal_) return scalar(shortest_text(low_ + u * (high_ - low_)));
  const double share = normal_->share_below + u * normal_->share_within;
  const double value = normal_->mean + normal_->deviation * normal_quantile(share);
  return scalar(shortest_text(std::clamp(value, normal_->at_least.value_or(value), normal_->at_most.value_or(value))));
}

std::vector<double> unit_numbers(SamplingMethod method, std::uint64_t seed, const std::string& path,
                                 std::size_t count) {
  const std::string digest = xxh3(fmt::format("{} {}", seed, path));
  RandomNumbers numbers(std::stoull(digest.substr(0, 16), nullptr, 16));
  std::vector<double> drawn(count);
  for (double& u : drawn) u = numbers.uniform();
  if (method == SamplingMethod::random) return drawn;
  for (std::size_t k = 0; k < count; ++k) drawn[k] = (static_cast<double>(k) + drawn[k]) / static_cast<double>(count);
  for (std::size_t k = count; k > 1; --k)  // shuffle of Fisher and Yates
    std::swap(drawn[k - 1], drawn[static_cast<std::size_t>(numbers.uniform() * static_cast<double>(k))]);
  return drawn;
}

std::vector<Variant> sampled_variants(const Node& section) {
  if (!section.is_map())
    throw InputError(section.where, "sample must be a map",
                     "write 'sample: {jobs: N, keys: {KEY.PATH: !uniform [A, B]}}'");
  Node settings = section;
  std::erase_if(settings.entries, [](const Entry& entry) { return entry.key == "keys"; });
  Sample sample;
  read_fields(under("sample", settings), Describe([&](Fields& f) { f.group("sample", sample, Need::required, ""); }));
  const Node* keys = section.find("keys");
  if (!keys || !keys->is_map() || keys->entries.empty())
    throw InputError(keys ? keys->where : section.where, "sample.keys must be a map of keys to distributions", ways);
  std::vector<Variant> variants(static_cast<std::size_t>(sample.jobs));
  for (std::size_t k = 0; k < variants.size(); ++k) variants[k].name = fmt::format("draw_{}", k + 1);
  for (const Entry& key : keys->entries) {
    const Distribution distribution = Distribution::from(key.key, key.value);
    const std::vector<double> drawn =
        unit_numbers(sample.method, static_cast<std::uint64_t>(sample.seed), key.key, variants.size());
    for (std::size_t k = 0; k < variants.size(); ++k) {
      Node value = distribution.value_at(drawn[k]);
      place_at(value, key.where);
      variants[k].changes.push_back({key.key, std::move(value), key.where});
    }
  }
  return variants;
}

std::vector<KeyRow> sampling_keys() { return key_rows<Sample>("study.sample"); }

}  // namespace dresslife::pipeline
