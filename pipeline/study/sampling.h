// Samples of keys with known distributions.
//
//   sample:
//     jobs: 200
//     seed: 7
//     method: latin_hypercube                    or random
//     keys:
//       routing.free_length_m: !normal {mean: 1.4, deviation: 0.05, at_least: 1.3}
//       dresspack.bending_stiffness_Nm2: !uniform [4, 6]
//       motion: !choice [easy, hard]
//
// A value is the quantile of its distribution at a number u between 0 and 1. random: u is uniform.
// latin_hypercube: for n jobs each interval of length 1/n in (0, 1) contains the u of one job, in a separate order for every key
// (McKay, Beckman and Conover, Technometrics 21 (1979) 239). Means over the jobs scatter less for the same n.
// Every key has its own stream of numbers, from the seed and its path: a further key does not change the values of the others,
// and with `random` further jobs do not change the previous jobs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/words.h"
#include "pipeline/study/variant.h"

namespace dresslife::pipeline {

struct KeyRow;  // pipeline/settings/fields.h

class Fields;

class Distribution {
 public:
  /// Reads `!normal {mean, deviation, at_least, at_most}`, `!uniform [LOW, HIGH]` or `!choice [A, B, ...]`.
  /// path: path of the sampled key. Errors: InputError for other values.
  static Distribution from(const std::string& path, const Node& written);

  /// Returns the quantile at u. Precondition: 0 < u < 1.
  Node value_at(double u) const;

 private:
  struct Normal {
    double mean = 0, deviation = 0;
    std::optional<double> at_least, at_most;
    /// shares of the untruncated distribution: below at_least, and between both limits
    double share_below = 0, share_within = 1;
  };
  friend void describe(Fields& f, Normal& normal);
  static Normal normal_from(const std::string& path, const Node& written);

  std::optional<Normal> normal_;
  double low_ = 0, high_ = 0;  ///< limits of a uniform distribution
  std::vector<Node> choices_;  ///< values of equal probability
};

enum class SamplingMethod { latin_hypercube, random };
constexpr std::string_view word(SamplingMethod value) { return word_at({"latin_hypercube", "random"}, value); }

/// Returns `count` numbers in the open interval (0, 1) for the key at a path.
std::vector<double> unit_numbers(SamplingMethod method, std::uint64_t seed, const std::string& path, std::size_t count);

/// Returns the section `sample` of a study as variants draw_1, draw_2, ... Errors: InputError.
std::vector<Variant> sampled_variants(const Node& section);

/// Returns the keys of `sample` except the content of `keys`.
std::vector<KeyRow> sampling_keys();

}  // namespace dresslife::pipeline
