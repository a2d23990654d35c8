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
// latin_hypercube: of n jobs one has its u in each nth of (0, 1), in an order of its own for every key
// (McKay, Beckman and Conover, Technometrics 21 (1979) 239): means over the jobs scatter less for the same n.
// Every key has its own stream of numbers, from the seed and its path: another key does not change the others' values,
// and with `random` further jobs do not change the previous ones.
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
  /// From `!normal {mean, deviation, at_least, at_most}`, `!uniform [LOW, HIGH]` or `!choice [A, B, ...]`.
  /// path: of the key that it is for. Errors: InputError for anything else.
  static Distribution from(const std::string& path, const Node& written);

  /// The quantile. Precondition: 0 < u < 1.
  Node value_at(double u) const;

 private:
  struct Normal {
    double mean = 0, deviation = 0;
    std::optional<double> at_least, at_most;
    double share_below = 0, share_within = 1;  ///< of the whole distribution: below at_least, between the two
  };
  friend void describe(Fields& f, Normal& normal);
  static Normal normal_from(const std::string& path, const Node& written);

  std::optional<Normal> normal_;
  double low_ = 0, high_ = 0;  ///< of a uniform one
  std::vector<Node> choices_;  ///< with equal probability
};

enum class SamplingMethod { latin_hypercube, random };
constexpr std::string_view word(SamplingMethod value) {
  return word_at({"latin_hypercube", "random"}, value);
}

/// `count` numbers in the open interval (0, 1) for the key at a path.
std::vector<double> unit_numbers(SamplingMethod method, std::uint64_t seed, const std::string& path,
                                 std::size_t count);

/// The section `sample` of a study as variants draw_1, draw_2, ... Errors: InputError.
std::vector<Variant> sampled_variants(const Node& section);

/// Its keys beside its `keys`.
std::vector<KeyRow> sampling_keys();

}  // namespace dresslife::pipeline
