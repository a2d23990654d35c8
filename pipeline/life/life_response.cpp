#include "pipeline/life/life_response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "pipeline/base/random.h"
#include "pipeline/base/statistics.h"

namespace dresslife::pipeline {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double farthest = 3.5;  // deviations: nothing is told of what lies beyond
constexpr std::size_t friction = index_of(Uncertain::friction_inside), slack = index_of(Uncertain::slack);

/// Where z lies among rising nodes: between `below` and the next, at `share` of the way, which lies outside
/// [0, 1] beyond the ends.
struct Place {
  std::size_t below = 0;
  double share = 0;
};
Place place_among(const std::vector<double>& nodes, double z) {
  if (nodes.size() < 2) return {};
  std::size_t below = 0;
  while (below + 2 < nodes.size() && z > nodes[below + 1]) ++below;
  return {below, (z - nodes[below]) / (nodes[below + 1] - nodes[below])};
}

/// Straight between values at nodes.
template <class ValueAt>
double between(const Place& place, const ValueAt& value_at) {
  const double first = value_at(place.below);
  return place.share == 0 ? first : first + place.share * (value_at(place.below + 1) - first);
}

/// Nodes of one axis of the strain side, all else 0.
std::vector<double> nodes_of(const LifeResponse& response, std::size_t parameter) {
  std::vector<double> nodes;
  for (const auto& point : response.points) {
    const bool alone = std::all_of(point.begin(), point.end(),
                                   [&](const double& z) { return z == 0 || &z == &point[parameter]; });
    if (alone) nodes.push_back(point[parameter]);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

// ---- the response -----------------------------------------------------------------------------------------

namespace {

/// What change() looks up again and again.
class Surface {
 public:
  explicit Surface(const LifeResponse& response) : response_(response) {
    for (std::size_t p = 0; p < strain_parameters; ++p) nodes_[p] = nodes_of(response, p);
    for (std::size_t k = 0; k < response.points.size(); ++k) index_[response.points[k]] = k;
    for (std::size_t f = 0; f < nodes_[friction].size(); ++f)
      for (std::size_t s = 0; s < nodes_[slack].size(); ++s) {
        std::array<double, strain_parameters> at{};
        at[friction] = nodes_[friction][f], at[slack] = nodes_[slack][s];
        const auto found = index_.find(at);
        if (found == index_.end()) crossed_ = false;
        grid_.push_back(found == index_.end() ? 0 : found->second);
      }
    for (std::size_t p = 0; p < strain_parameters; ++p)
      for (const double z : nodes_[p]) {
        std::array<double, strain_parameters> at{};
        at[p] = z;
        alone_[p].push_back(index_.at(at));
      }
    at_zero_ = worst(0, place_among(response.strength, 0), place_among(response.slope, 0));
  }

  double change(const ParameterPoint& far) const {
    ParameterPoint z = far;
    for (double& one : z) one = std::clamp(one, -farthest, farthest);
    const Place strength = place_among(response_.strength, z[index_of(Uncertain::strength)]);
    const Place slope = place_among(response_.slope, z[index_of(Uncertain::slope)]);
    const double here = worst(0, strength, slope);
    double sum = here - at_zero_;
    for (std::size_t p = 0; p < strain_parameters; ++p) {
      if (nodes_[p].size() < 2 || (crossed_ && (p == friction || p == slack))) continue;
      sum += between(place_among(nodes_[p], z[p]),
                     [&](std::size_t k) { return worst(alone_[p][k], strength, slope); }) -
             here;
    }
    if (crossed_) {
      const Place of_friction = place_among(nodes_[friction], z[friction]),
                  of_slack = place_among(nodes_[slack], z[slack]);
      sum += between(of_friction,
                     [&](std::size_t f) {
                       return between(of_slack, [&](std::size_t s) {
                         return worst(grid_[f * nodes_[slack].size() + s], strength, slope);
                       });
                     }) -
             here;
    }
    const UncertainParameter& model = uncertain_parameters()[index_of(Uncertain::model)];
    return sum + std::log10(model.value(far[index_of(Uncertain::model)]));
  }

 private:
  double worst(std::size_t point, const Place& strength, const Place& slope) const {
    const std::size_t slopes = response_.slope.size();
    const double* const of_point = response_.worst_life.data() + point * response_.strength.size() * slopes;
    return between(strength, [&](std::size_t s) {
      return between(slope, [&](std::size_t t) { return of_point[s * slopes + t]; });
    });
  }

  const LifeResponse& response_;
  std::array<std::vector<double>, strain_parameters> nodes_;
  std::array<std::vector<std::size_t>, strain_parameters> alone_;  // (parameter, node) point
  std::map<std::array<double, strain_parameters>, std::size_t> index_;
  std::vector<std::size_t> grid_;  // (friction node, slack node) point
  bool crossed_ = true;
  double at_zero_ = 0;
};

constexpr double tenth = 1.2815515655446004;  // deviations from the median to 10 and 90 %

double planned(const LifeResponse& response, const Place& scatter, double u) {
  const auto at = [&](std::size_t share) {
    return between(scatter, [&](std::size_t k) { return response.planned[k][share]; });
  };
  const double median = at(1);
  return u < 0 ? median + u / tenth * (median - at(0)) : median + u / tenth * (at(2) - median);
}

double life_on(const Surface& surface, const LifeResponse& response, const ParameterPoint& z, double u) {
  const Place scatter = place_among(response.scatter, z[index_of(Uncertain::scatter)]);
  const double life = planned(response, scatter, u) + surface.change(z);
  return life < LifeResponse::endless ? life : infinity;
}

}  // namespace

double LifeResponse::change(const ParameterPoint& z) const { return Surface(*this).change(z); }

double LifeResponse::log10_life(const ParameterPoint& z, double u) const {
  return life_on(Surface(*this), *this, z, u);
}

// ---- as text ----------------------------------------------------------------------------------------------

namespace {

template <class Numbers>
std::string line(const char* name, const Numbers& numbers) {
  std::string text = name;
  for (const double number : numbers) text += fmt::format(" {:.6g}", number);
  return text + "\n";
}

std::vector<double> numbers_after(std::istringstream& line) {
  std::vector<double> numbers;
  for (std::string word; line >> word;) {
    std::size_t used = 0;
    const double number = std::stod(word, &used);
    if (used != word.size() || !std::isfinite(number)) throw std::invalid_argument("not a number");
    numbers.push_back(number);
  }
  return numbers;
}

void check(const LifeResponse& response) {
  const auto holds_zero = [](const std::vector<double>& nodes) {
    return std::find(nodes.begin(), nodes.end(), 0.0) != nodes.end() &&
           std::adjacent_find(nodes.begin(), nodes.end(), std::greater_equal<>()) == nodes.end();
  };
  const bool whole =
      !response.points.empty() && response.points[0] == std::array<double, strain_parameters>{} &&
      holds_zero(response.strength) && holds_zero(response.slope) && holds_zero(response.scatter) &&
      response.worst_life.size() ==
          response.points.size() * response.strength.size() * response.slope.size() &&
      response.planned.size() == response.scatter.size() &&
      response.knowledge.mean.size() == Eigen::Index(uncertain_count) &&
      response.knowledge.covariance.size() == Eigen::Index(uncertain_count * uncertain_count);
  if (!whole) throw std::invalid_argument("lists of other lengths");
}

}  // namespace

std::string LifeResponse::text() const {
  std::string text = "construction " + construction + "\nmaterial " + material + "\n";
  text += line("mean", std::span(knowledge.mean.data(), uncertain_count));
  for (Eigen::Index row = 0; row < knowledge.covariance.rows(); ++row)
    text += line("covariance", std::vector<double>(knowledge.covariance.row(row).begin(),
                                                   knowledge.covariance.row(row).end()));
  for (const auto& point : points) text += line("point", point);
  text += line("strength", strength) + line("slope", slope) + line("scatter", scatter);
  for (const auto& lives : planned) text += line("planned", lives);
  return text + line("worst_life", worst_life);
}

LifeResponse LifeResponse::from_text(const std::string& text) {
  LifeResponse response;
  response.points.clear(), response.worst_life.clear();
  response.knowledge.mean = Eigen::VectorXd::Zero(0);
  std::vector<double> covariance;
  std::istringstream lines(text);
  for (std::string one; std::getline(lines, one);) {
    std::istringstream words(one);
    std::string name;
    words >> name;
    if (name == "construction" || name == "material") {
      (name == "material" ? response.material : response.construction) =
          one.substr(std::min(one.size(), name.size() + 1));
      continue;
    }
    const std::vector<double> numbers = numbers_after(words);
    const auto fixed = [&](auto& array) {
      if (numbers.size() != array.size()) throw std::invalid_argument("a list of another length");
      std::copy(numbers.begin(), numbers.end(), array.begin());
    };
    if (name == "mean")
      response.knowledge.mean =
          Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
    else if (name == "covariance")
      covariance.insert(covariance.end(), numbers.begin(), numbers.end());
    else if (name == "point")
      fixed(response.points.emplace_back());
    else if (name == "planned")
      fixed(response.planned.emplace_back());
    else if (name == "strength")
      response.strength = numbers;
    else if (name == "slope")
      response.slope = numbers;
    else if (name == "scatter")
      response.scatter = numbers;
    else if (name == "worst_life")
      response.worst_life = numbers;
  }
  if (covariance.size() == uncertain_count * uncertain_count)
    response.knowledge.covariance =
        Eigen::Map<const Eigen::MatrixXd>(covariance.data(), uncertain_count, uncertain_count);
  check(response);
  return response;
}

// ---- draws ------------------------------------------------------------------------------------------------

namespace {

/// In the middles of equal shares of the normal distribution, rising.
const std::vector<double>& normal_strata(std::size_t draws) {
  thread_local std::vector<double> strata;
  if (strata.size() != draws) {
    strata.clear();
    for (std::size_t d = 0; d < draws; ++d)
      strata.push_back(normal_quantile((double(d) + 0.5) / double(draws)));
  }
  return strata;
}

/// FNV-1a: fixed for ever.
std::uint64_t seed_of(const std::string& name) {
  std::uint64_t seed = 0xcbf29ce484222325;
  for (const char letter : name) seed = (seed ^ static_cast<unsigned char>(letter)) * 0x100000001b3;
  return seed;
}

/// (draw) standard normal, every stratum once, in an order that the name decides.
std::vector<double> normals_of(const std::string& name, std::size_t draws) {
  std::vector<double> values = normal_strata(draws);
  std::uint64_t state = seed_of(name);
  for (std::size_t k = draws; k > 1; --k, state += mix_step)
    std::swap(values[k - 1], values[mixed(state) % k]);
  return values;
}

std::string stream_of(const LifeResponse& response, std::size_t parameter, const std::string& job) {
  const UncertainParameter& of = uncertain_parameters()[parameter];
  std::string shared;
  switch (of.shared) {
    case SharedBy::construction:
      shared = "construction " + response.construction;
      break;
    case SharedBy::material:
      shared = "material " + response.material;
      break;
    case SharedBy::everything:
      shared = "everything";
      break;
    case SharedBy::installation:
      shared = "job " + job;
      break;
  }
  return std::string(of.name) + "/" + shared;
}

/// Lower triangle L with L L^T = covariance; a parameter that is known has a row of zeros. What jobs share
/// comes before what each has for itself, so that nothing shared hangs on a job's own numbers. order: (row)
/// parameter.
Eigen::MatrixXd factor_of(const Eigen::MatrixXd& covariance, const std::vector<std::size_t>& order) {
  const auto n = static_cast<Eigen::Index>(order.size());
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(n, n);
  const auto of = [&](Eigen::Index a, Eigen::Index b) {
    return covariance(static_cast<Eigen::Index>(order[std::size_t(a)]),
                      static_cast<Eigen::Index>(order[std::size_t(b)]));
  };
  for (Eigen::Index column = 0; column < n; ++column) {
    const double left = of(column, column) - factor.row(column).head(column).squaredNorm();
    if (!(left > 1e-12)) continue;
    factor(column, column) = std::sqrt(left);
    for (Eigen::Index row = column + 1; row < n; ++row)
      factor(row, column) =
          (of(row, column) - factor.row(row).head(column).dot(factor.row(column).head(column))) /
          factor(column, column);
  }
  return factor;
}

/// All that a job's lives are drawn from.
struct Draws {
  std::vector<ParameterPoint> z;
  std::vector<double> u;
};

Draws draws_of(const LifeResponse& response, const std::string& job, std::size_t count) {
  std::vector<std::size_t> order(uncertain_count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_partition(order.begin(), order.end(), [](std::size_t p) {
    return uncertain_parameters()[p].shared != SharedBy::installation;
  });
  const Eigen::MatrixXd factor = factor_of(response.knowledge.covariance, order);
  Draws draws{std::vector<ParameterPoint>(count), normals_of("scatter of wires/job " + job, count)};
  for (std::size_t d = 0; d < count; ++d)
    for (std::size_t p = 0; p < uncertain_count; ++p)
      draws.z[d][p] = response.knowledge.mean(static_cast<Eigen::Index>(p));
  for (std::size_t column = 0; column < uncertain_count; ++column) {
    if (factor.col(static_cast<Eigen::Index>(column)).isZero(0)) continue;
    const std::vector<double> normal = normals_of(stream_of(response, order[column], job), count);
    for (std::size_t row = column; row < uncertain_count; ++row) {
      const double weight = factor(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
      if (weight == 0) continue;
      for (std::size_t d = 0; d < count; ++d) draws.z[d][order[row]] += weight * normal[d];
    }
  }
  return draws;
}

std::vector<double> lives_of(const LifeResponse& response, const Draws& draws) {
  const Surface surface(response);
  std::vector<double> lives(draws.u.size());
  for (std::size_t d = 0; d < lives.size(); ++d)
    lives[d] = life_on(surface, response, draws.z[d], draws.u[d]);
  return lives;
}

/// Share of the variance of `lives` that lies between groups of draws with equal places in the order of
/// `cause`: the first-order share (Sobol' 1993), less what `size` draws a group leave by chance. 0 where
/// nothing varies.
double first_order(const std::vector<double>& cause, const std::vector<double>& lives) {
  constexpr std::size_t groups = 25;
  std::vector<std::size_t> order(lives.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return cause[a] != cause[b] ? cause[a] < cause[b] : a < b; });
  if (cause[order.front()] == cause[order.back()]) return 0;
  const std::size_t size = lives.size() / groups;
  double mean = 0, square = 0, between_groups = 0;
  for (const double life : lives) mean += life / double(lives.size());
  for (const double life : lives) square += (life - mean) * (life - mean) / double(lives.size());
  if (!(square > 0)) return 0;
  for (std::size_t g = 0; g < groups; ++g) {
    double sum = 0;
    for (std::size_t k = 0; k < size; ++k) sum += lives[order[g * size + k]];
    between_groups += std::pow(sum / double(size) - mean, 2) / double(groups);
  }
  const double chance = 1 / double(size);
  return std::clamp((between_groups / square - chance) / (1 - chance), 0.0, 1.0);
}

}  // namespace

std::vector<double> draw_lives(const LifeResponse& response, const std::string& job, std::size_t draws) {
  return lives_of(response, draws_of(response, job, draws));
}

DrawnLives drawn_lives(const LifeResponse& response, const std::string& job, std::size_t count) {
  const Draws draws = draws_of(response, job, count);
  DrawnLives drawn{lives_of(response, draws), {}, {}};
  std::vector<double> sorted = drawn.log10_life;
  std::sort(sorted.begin(), sorted.end());
  const std::array<double, 3> shares{0.1, 0.5, 0.9};
  for (std::size_t i = 0; i < shares.size(); ++i)
    drawn.percentiles[i] = std::pow(10.0, number_at(sorted, shares[i] * double(count) - 0.5));
  std::vector<double> finite = drawn.log10_life, cause(count);
  for (double& life : finite) life = std::min(life, LifeResponse::endless);
  for (std::size_t p = 0; p < uncertain_count; ++p) {
    for (std::size_t d = 0; d < count; ++d) cause[d] = draws.z[d][p];
    drawn.share[p] = first_order(cause, finite);
  }
  drawn.share[uncertain_count] = first_order(draws.u, finite);
  return drawn;
}

double share_outliving(const std::vector<double>& one, const std::vector<double>& other) {
  assert(one.size() == other.size() && !one.empty());
  double count = 0;
  for (std::size_t d = 0; d < one.size(); ++d) count += one[d] > other[d] ? 1 : one[d] == other[d] ? 0.5 : 0;
  return count / double(one.size());
}

std::string share_words(const std::array<double, uncertain_count + 1>& share) {
  std::vector<std::size_t> order(share.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return share[a] > share[b]; });
  std::string words;
  for (const std::size_t p : order) {
    if (share[p] < 0.01) break;
    words += fmt::format("{}{} {:.0f} %", words.empty() ? "" : "; ",
                         p == uncertain_count ? "scatter of wires" : uncertain_parameters()[p].name,
                         100 * share[p]);
  }
  return words;
}

std::size_t largest_share(const std::array<double, uncertain_count + 1>& share) {
  return static_cast<std::size_t>(std::max_element(share.begin(), share.end()) - share.begin());
}

}  // namespace dresslife::pipeline
