#include "pipeline/life/first_failure.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>

#include "pipeline/base/constants.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/order.h"
#include "pipeline/base/random.h"
#include "pipeline/base/statistics.h"

namespace dresslife::pipeline {
namespace {

constexpr std::size_t cause_count = uncertain_count + 1;  // the last: scatter of wires
constexpr std::size_t of_wires = uncertain_count, of_residual = uncertain_count + 1;

// ---- samples ----------------------------------------------------------------------------------------------

/// FNV-1a. It must never change, because all seeds depend on it.
std::uint64_t seed_of(const std::string& name) {
  std::uint64_t seed = 0xcbf29ce484222325;
  for (const char letter : name) seed = (seed ^ static_cast<unsigned char>(letter)) * 0x100000001b3;
  return seed;
}

/// Returns the name of the parameters that only this dresspack of a job has.
std::string own_name(const LifeResponse& response, const std::string& job) {
  return "job " + job + (response.dresspack.empty() ? "" : "/" + response.dresspack);
}

std::string stream_of(const LifeResponse& response, std::size_t parameter, const std::string& job) {
  const UncertainParameter& of = uncertain_parameters()[parameter];
  const std::string name = std::string(of.name) + "/";
  switch (of.shared) {
    case SharedBy::construction:
      return name + "construction " + response.construction;
    case SharedBy::material:
      return name + "material " + response.material;
    case SharedBy::everything:
      return name + "everything";
    case SharedBy::installation:
      break;
  }
  return name + own_name(response, job);
}

/// Returns the weights W, (row, column), with W C = numbers for a covariance C. Precondition: each row of `numbers` is a
/// combination of rows of C. A column that depends on preceding ones has weight 0. (Eigen's pseudo-inverse takes nine seconds to
/// compile.)
Eigen::MatrixXd divided(const Eigen::MatrixXd& numbers, const Eigen::MatrixXd& covariance) {
  const Eigen::MatrixXd factor = triangular_factor(covariance, indices_of(static_cast<std::size_t>(covariance.rows())));
  const Eigen::Index n = factor.rows();
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(numbers.rows(), n);
  for (Eigen::Index row = 0; row < numbers.rows(); ++row) {
    auto w = weights.row(row);
    for (Eigen::Index k = 0; k < n; ++k)
      if (factor(k, k) > 0) w(k) = (numbers(row, k) - factor.row(k).head(k).dot(w.head(k))) / factor(k, k);
    for (Eigen::Index k = n - 1; k >= 0; --k)
      if (factor(k, k) > 0) w(k) = (w(k) - factor.col(k).tail(n - 1 - k).dot(w.tail(n - 1 - k))) / factor(k, k);
  }
  return weights;
}

/// The samples for one mode's lives.
struct Samples {
  std::vector<ParameterPoint> z;
  std::vector<double> u;
  std::vector<double> residual;  ///< [decades]; empty: lives do not depend on the place of the cables
};

using StrainPoint = std::array<double, strain_parameters>;

/// Returns z of a point without friction inside. Points with an equal result have the same motion of the cables.
StrainPoint place_of(StrainPoint point) {
  point[index_of(Uncertain::friction_inside)] = 0;
  return point;
}

/// Returns whether the worst wire has other lives at other places of the cables, with equal friction inside.
bool depends_on_place(const LifeResponse& response) {
  const auto of_point = static_cast<std::ptrdiff_t>(response.strength.size() * response.slope.size());
  const auto lives = [&](std::size_t k) {
    return response.worst_life.begin() + static_cast<std::ptrdiff_t>(k) * of_point;
  };
  // Equal strains give lives that differ by rounding: a response as text has six digits, at lives of up to 1e25.
  const auto alike = [](double one, double other) { return std::abs(one - other) < 1e-3; };
  std::map<double, std::size_t> own;  // point at the job's own place, by friction
  for (std::size_t k = 0; k < response.points.size(); ++k)
    if (response.inside[k] == Inside::as_is && place_of(response.points[k]) == StrainPoint{})
      own[response.points[k][index_of(Uncertain::friction_inside)]] = k;
  for (std::size_t k = 0; k < response.points.size(); ++k) {
    if (response.inside[k] != Inside::as_is) continue;
    const auto found = own.find(response.points[k][index_of(Uncertain::friction_inside)]);
    if (found != own.end() && !std::equal(lives(k), lives(k) + of_point, lives(found->second), alike)) return true;
  }
  return false;
}

std::set<StrainPoint> places_of(const FailureModes& modes) {
  std::set<StrainPoint> places;
  for (const LifeResponse& mode : modes)
    for (const StrainPoint& point : mode.points) places.insert(place_of(point));
  return places;
}

/// Returns `count` row numbers from 0 to `rows` - 1, each equally often as far as possible, increasing.
std::vector<double> even_rows(Eigen::Index rows, std::size_t count) {
  std::vector<double> even(count);
  for (std::size_t s = 0; s < count; ++s) even[s] = std::floor((double(s) + 0.5) / double(count) * double(rows));
  return even;
}

bool are_equal(const std::shared_ptr<const StandardSamples>& one, const std::shared_ptr<const StandardSamples>& other) {
  return one == other || (one && other && one->parameters == other->parameters && one->numbers == other->numbers);
}

/// has_residual: depends_on_place(response). again: returns another, independent set of samples.
/// moved_as: name in place of `job` for the parameter `motion`.
Samples samples_of(const LifeResponse& response, bool has_residual, const std::string& job, const std::string& moved_as,
                   std::size_t count, bool again) {
  const auto normals = [&](const std::string& name) { return standard_normals(again ? name + " again" : name, count); };
  const std::vector<std::size_t> order = sampling_order();
  const Eigen::MatrixXd factor = triangular_factor(response.knowledge.covariance, order);
  const StandardSamples* const posterior = response.knowledge.samples.get();
  const std::vector<double> rows =
      posterior ? in_order_of(again ? "posterior again" : "posterior", even_rows(posterior->numbers.rows(), count))
                : std::vector<double>{};
  const auto numbers_of = [&](std::size_t parameter) {
    if (posterior)
      if (const auto found = std::ranges::find(posterior->parameters, parameter); found != posterior->parameters.end())
        return mapped(rows, [&, column = found - posterior->parameters.begin()](double row) {
          return posterior->numbers(static_cast<Eigen::Index>(row), column);
        });
    return normals(stream_of(response, parameter, parameter == index_of(Uncertain::motion) ? moved_as : job));
  };
  Samples samples{std::vector<ParameterPoint>(count), normals("scatter of wires/" + own_name(response, job)), {}};
  if (has_residual) {
    samples.residual = normals("residual/" + own_name(response, job));
    for (double& decades : samples.residual) decades *= residual_decades * response.residual_spread;
  }
  if (response.scatter_shared < 1) {  // modes of one dresspack share a part of their scatter
    const std::vector<double> own = normals("scatter of wires/" + own_name(response, job) + "/" + response.mode);
    const double common = std::sqrt(response.scatter_shared), alone = std::sqrt(1 - response.scatter_shared);
    for (std::size_t s = 0; s < count; ++s) samples.u[s] = common * samples.u[s] + alone * own[s];
  }
  for (std::size_t s = 0; s < count; ++s)
    for (std::size_t p = 0; p < uncertain_count; ++p)
      samples.z[s][p] = response.knowledge.mean(static_cast<Eigen::Index>(p));
  for (std::size_t column = 0; column < uncertain_count; ++column) {
    if (factor.col(static_cast<Eigen::Index>(column)).isZero(0)) continue;
    const std::vector<double> numbers = numbers_of(order[column]);
    for (std::size_t row = column; row < uncertain_count; ++row) {
      const double weight = factor(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
      if (weight == 0) continue;
      for (std::size_t s = 0; s < count; ++s) samples.z[s][order[row]] += weight * numbers[s];
    }
  }
  return samples;
}

Samples samples_of(const LifeResponse& response, const std::string& job, std::size_t count, bool again = false) {
  return samples_of(response, depends_on_place(response), job, job, count, again);
}

/// Returns whether two modes have equal samples, if both have a residual or none has.
bool share_samples(const LifeResponse& one, const LifeResponse& other) {
  return one.construction == other.construction && one.material == other.material && one.dresspack == other.dresspack &&
         one.scatter_shared == other.scatter_shared && one.residual_spread == other.residual_spread &&
         (one.scatter_shared == 1 || one.mode == other.mode) && one.knowledge.mean == other.knowledge.mean &&
         one.knowledge.covariance == other.knowledge.covariance &&
         are_equal(one.knowledge.samples, other.knowledge.samples);
}

std::vector<Samples> samples_of(const FailureModes& modes, const std::string& job, std::size_t count,
                                bool again = false) {
  return mapped(modes, [&](const LifeResponse& mode) { return samples_of(mode, job, count, again); });
}

std::vector<LifeSurface> surfaces_of(const FailureModes& modes) {
  return mapped(modes, [](const LifeResponse& mode) { return LifeSurface(mode); });
}

/// Returns the life of the first failing mode, (sample). first: number of samples in which each mode is the first, (mode).
std::vector<double> lives_of(const std::vector<LifeSurface>& surfaces, const std::vector<Samples>& samples,
                             Inside inside, std::vector<double>* first = nullptr) {
  std::vector<double> lives(samples.front().u.size(), infinity);
  if (first) first->assign(surfaces.size(), 0);
  for (std::size_t s = 0; s < lives.size(); ++s) {
    std::size_t mode = 0;
    for (std::size_t m = 0; m < surfaces.size(); ++m) {
      double life = surfaces[m].log10_life(samples[m].z[s], samples[m].u[s], inside);
      if (!samples[m].residual.empty()) life += samples[m].residual[s];
      if (life < lives[s]) lives[s] = life, mode = m;
    }
    if (first && std::isfinite(lives[s])) ++(*first)[mode];
  }
  return lives;
}

// ---- shares of the uncertainty ----------------------------------------------------------------------------

/// Returns whether a cause is uncertain and affects any mode.
bool is_active(const FailureModes& modes, const std::vector<LifeSurface>& surfaces, std::size_t cause) {
  if (cause == of_wires)
    return std::ranges::any_of(modes, [](const LifeResponse& mode) {
      return std::ranges::any_of(mode.planned, [](const auto& lives) { return lives[0] != lives[2]; });
    });
  const auto at = static_cast<Eigen::Index>(cause);
  if (!(modes.front().knowledge.covariance(at, at) > 0)) return false;
  return std::ranges::any_of(surfaces, [&](const LifeSurface& surface) { return surface.depends_on(cause); });
}

/// Samples that have the causes in `kept` in common with `one`, and otherwise the distribution under this condition: z' + C(rest,
/// kept) C(kept, kept)^+ (z - z')(kept), with z' from an independent set (Matheron).
class Mixed {
 public:
  Mixed(const std::vector<Samples>& one, const std::vector<Samples>& other, const Eigen::MatrixXd& covariance)
      : one_(one), other_(other), covariance_(covariance) {
    Eigen::MatrixXd beside = covariance;
    beside.diagonal().setZero();
    independent_ = beside.isZero(0);
  }

  std::vector<Samples> keeping(const std::vector<std::size_t>& kept) const {
    std::vector<Samples> mixed = other_;
    std::vector<std::size_t> parameters;
    for (const std::size_t cause : kept) {
      if (cause != of_wires) parameters.push_back(cause);
      for (std::size_t m = 0; m < mixed.size(); ++m)
        for (std::size_t s = 0; s < mixed[m].u.size(); ++s)
          cause == of_wires ? mixed[m].u[s] = one_[m].u[s] : mixed[m].z[s][cause] = one_[m].z[s][cause];
    }
    if (!independent_ && !parameters.empty()) move_rest(parameters, mixed);
    return mixed;
  }

 private:
  void move_rest(const std::vector<std::size_t>& kept, std::vector<Samples>& mixed) const {
    const auto count = static_cast<Eigen::Index>(kept.size());
    Eigen::MatrixXd inner(count, count), outer(Eigen::Index(uncertain_count), count);
    for (Eigen::Index a = 0; a < count; ++a) {
      const auto of = static_cast<Eigen::Index>(kept[std::size_t(a)]);
      outer.col(a) = covariance_.col(of);
      for (Eigen::Index b = 0; b < count; ++b)
        inner(b, a) = covariance_(static_cast<Eigen::Index>(kept[std::size_t(b)]), of);
    }
    const Eigen::MatrixXd weights = divided(outer, inner);
    Eigen::VectorXd apart(count);
    for (std::size_t m = 0; m < mixed.size(); ++m)
      for (std::size_t s = 0; s < mixed[m].u.size(); ++s) {
        for (Eigen::Index a = 0; a < count; ++a) {
          const std::size_t p = kept[std::size_t(a)];
          apart(a) = one_[m].z[s][p] - other_[m].z[s][p];
        }
        for (std::size_t p = 0; p < uncertain_count; ++p)
          if (std::ranges::find(kept, p) == kept.end())
            mixed[m].z[s][p] += weights.row(static_cast<Eigen::Index>(p)) * apart;
      }
  }

  const std::vector<Samples>&one_, &other_;
  const Eigen::MatrixXd& covariance_;
  bool independent_ = true;
};

/// Limits lives to `endless`, because a variance must be finite.
std::vector<double> capped(std::vector<double> lives) {
  for (double& life : lives) life = std::min(life, LifeResponse::endless);
  return lives;
}

double covariance_of(const std::vector<double>& a, const std::vector<double>& b) {
  const double count = double(a.size());
  const double mean =
      (std::accumulate(a.begin(), a.end(), 0.0) + std::accumulate(b.begin(), b.end(), 0.0)) / (2 * count);
  double sum = 0;
  for (std::size_t s = 0; s < a.size(); ++s) sum += (a[s] - mean) * (b[s] - mean);
  return sum / count;
}

/// Returns the variance [decades^2] of the factor `motion`, if it multiplies all lives and is independent of the other causes; else 0.
double apart_by_motion(const FailureModes& modes) {
  const auto at = static_cast<Eigen::Index>(index_of(Uncertain::motion));
  const Eigen::MatrixXd& covariance = modes.front().knowledge.covariance;
  if (covariance.row(at).squaredNorm() != covariance(at, at) * covariance(at, at)) return 0;
  // each dresspack on the robot has its own value
  for (const LifeResponse& mode : modes)
    if (mode.dresspack != modes.front().dresspack) return 0;
  return covariance(at, at) * std::pow(std::log10(uncertain_parameters()[index_of(Uncertain::motion)].step), 2);
}

// The residual and, with one dresspack, the factor `motion` add to log10 of all lives and are independent of the other causes. So
// their Shapley effects are the variances that they add (for several dresspacks on one robot approximately), and the other causes
// need no sets with them.
CauseShares shares_of(const FailureModes& modes, const std::vector<LifeSurface>& surfaces, const std::string& job) {
  constexpr std::size_t of_motion = index_of(Uncertain::motion);
  const double by_residual = std::pow(residual_of(modes), 2), by_motion = apart_by_motion(modes),
               apart = by_residual + by_motion;
  std::vector<std::size_t> causes;
  for (std::size_t cause = 0; cause < cause_count; ++cause)
    if (is_active(modes, surfaces, cause) && !(cause == of_motion && by_motion > 0)) causes.push_back(cause);
  CauseShares share{};
  // A quarter of a million lives take about 0.05 s. With 4000 samples, 1 to 2 % of the variance is random.
  constexpr std::size_t lives_in_all = 250'000, most_samples = 4000, fewest_samples = 500;
  const std::size_t sets = std::size_t{1} << causes.size();
  const std::size_t count = std::clamp(lives_in_all / sets, fewest_samples, most_samples);
  std::vector<Samples> one = samples_of(modes, job, count), other = samples_of(modes, job, count, true);
  const std::vector<double> whole = capped(lives_of(surfaces, one, Inside::as_is));
  for (auto* samples : {&one, &other})
    for (Samples& of_mode : *samples) {
      of_mode.residual.clear();
      if (by_motion > 0)
        for (ParameterPoint& z : of_mode.z) z[of_motion] = 0;
    }
  const Mixed mixture(one, other, modes.front().knowledge.covariance);
  const std::vector<double> lives = capped(lives_of(surfaces, one, Inside::as_is));
  std::vector<double> explained(sets, 0.0);  // V(S), index: set of causes as bits
  for (std::size_t set = 1; set < sets; ++set) {
    std::vector<std::size_t> kept;
    for (std::size_t c = 0; c < causes.size(); ++c)
      if (set >> c & 1) kept.push_back(causes[c]);
    const bool all = set + 1 == sets;
    explained[set] =
        covariance_of(lives, all ? lives : capped(lives_of(surfaces, mixture.keeping(kept), Inside::as_is)));
  }
  const double variance = apart > 0 ? std::max(covariance_of(whole, whole), explained.back()) : explained.back();
  if (!(variance > 0)) return share;
  if (apart > 0) {
    const double added = 1 - explained.back() / variance;
    share[of_residual] = added * by_residual / apart, share[of_motion] = added * by_motion / apart;
  }
  const double d = double(causes.size());
  for (std::size_t set = 0; set < sets; ++set) {
    const double size = double(__builtin_popcountll(set));
    const double weight = std::exp(std::lgamma(size + 1) + std::lgamma(d - size) - std::lgamma(d + 1));
    for (std::size_t c = 0; c < causes.size(); ++c)
      if (!(set >> c & 1))
        share[causes[c]] += weight * (explained[set | std::size_t{1} << c] - explained[set]) / variance;
  }
  return share;
}

// ---- the test that narrows most ---------------------------------------------------------------------------

/// Returns the knowledge after a test of one parameter, if the result is its present median.
ParameterKnowledge tested(const ParameterKnowledge& known, std::size_t parameter) {
  const UncertainParameter& of = uncertain_parameters()[parameter];
  const auto at = static_cast<Eigen::Index>(parameter);
  const double error = of.test_deviation / of.deviation();  // of z
  ParameterKnowledge after = known;
  const Eigen::VectorXd column = known.covariance.col(at);
  after.covariance -= column * column.transpose() / (known.covariance(at, at) + error * error);
  return after;
}

double decades(const LifePercentiles& lives) {
  const double most = LifeResponse::endless;
  return std::min(std::log10(lives[2]), most) - std::min(std::log10(lives[0]), most);
}

void find_best_test(const FailureModes& modes, const std::vector<LifeSurface>& surfaces, const std::string& job,
                    std::size_t count, FirstFailures& summary) {
  constexpr double worth_while = 0.95;  // of the decades between 10 and 90 %
  double narrowest = worth_while * decades(summary.percentiles);
  for (std::size_t p = 0; p < uncertain_count; ++p) {
    if (!is_active(modes, surfaces, p)) continue;
    FailureModes after = modes;
    for (LifeResponse& mode : after) mode.knowledge = tested(mode.knowledge, p);
    const LifePercentiles lives = percentiles_of(lives_of(surfaces, samples_of(after, job, count), Inside::as_is));
    if (!(decades(lives) < narrowest)) continue;
    narrowest = decades(lives);
    summary.best_test = p;
    summary.after_test = lives;
  }
}

// ---- errors of percentiles --------------------------------------------------------------------------------

constexpr std::size_t of_friction = index_of(Uncertain::friction_inside), of_slack = index_of(Uncertain::slack),
                      of_stiffness = index_of(Uncertain::hose_stiffness);

/// Returns the response without the points for which `drops` returns true.
template <class Drops>
LifeResponse without_points(const LifeResponse& response, const Drops& drops) {
  LifeResponse left = response;
  left.points.clear(), left.inside.clear(), left.worst_life.clear();
  const std::size_t of_point = response.strength.size() * response.slope.size();
  for (std::size_t k = 0; k < response.points.size(); ++k) {
    if (drops(response.points[k])) continue;
    left.points.push_back(response.points[k]), left.inside.push_back(response.inside[k]);
    const auto begin = response.worst_life.begin() + static_cast<std::ptrdiff_t>(k * of_point);
    left.worst_life.insert(left.worst_life.end(), begin, begin + static_cast<std::ptrdiff_t>(of_point));
  }
  return left;
}

LifeResponse without_strength(const LifeResponse& response, double z) {
  LifeResponse left = response;
  const auto found = std::ranges::find(response.strength, z);
  if (found == response.strength.end()) return left;
  const auto node = static_cast<std::size_t>(found - response.strength.begin());
  left.strength.erase(left.strength.begin() + static_cast<std::ptrdiff_t>(node));
  left.worst_life.clear();
  const std::size_t slopes = response.slope.size();
  for (std::size_t k = 0; k < response.worst_life.size(); ++k)
    if (k / slopes % response.strength.size() != node) left.worst_life.push_back(response.worst_life[k]);
  return left;
}

/// Returns the different nodes, increasing.
std::vector<double> once(std::vector<double> nodes) {
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// Returns the nodes between the outermost ones, without 0.
std::vector<double> inner(std::vector<double> nodes) {
  nodes = once(std::move(nodes));
  if (nodes.size() < 3) return {};
  nodes.pop_back(), nodes.erase(nodes.begin());
  std::erase(nodes, 0.0);
  return nodes;
}

std::vector<double> nodes_of(const FailureModes& modes, std::size_t parameter) {
  std::vector<double> nodes;
  for (const LifeResponse& mode : modes)
    for (const auto& point : mode.points) nodes.push_back(point[parameter]);
  return nodes;
}

/// Returns the response with longer lives at the points of one place. Those of the job's own place are in `planned`, too.
LifeResponse with_longer_lives(LifeResponse response, const StrainPoint& place, double decades) {
  const std::size_t of_point = response.strength.size() * response.slope.size();
  for (std::size_t k = 0; k < response.worst_life.size(); ++k)
    if (place_of(response.points[k / of_point]) == place) response.worst_life[k] += decades;
  if (place == StrainPoint{})
    for (auto& lives : response.planned)
      for (double& life : lives) life += decades;
  return response;
}

/// Returns the modes with a coarser response, once for each item of error_factors() that needs one.
std::vector<FailureModes> coarser(const FailureModes& modes) {
  std::vector<FailureModes> all;
  const auto add = [&](const auto& change) {
    FailureModes changed;
    for (const LifeResponse& mode : modes) changed.push_back(change(mode));
    all.push_back(std::move(changed));
  };
  for (const std::size_t p : {of_friction, of_slack})
    for (const double z : inner(nodes_of(modes, p)))
      add([&](const LifeResponse& mode) {
        return without_points(mode, [&](const auto& point) { return point[p] == z; });
      });
  for (const double z : inner(modes.front().strength))
    add([&](const LifeResponse& mode) { return without_strength(mode, z); });
  bool others = false;
  for (std::size_t p = 0; p < strain_parameters; ++p) {
    if (p == of_friction || p == of_slack) continue;
    std::vector<double> nodes = once(nodes_of(modes, p));
    std::erase(nodes, 0.0);
    others |= !nodes.empty();
  }
  if (others)
    add([](const LifeResponse& mode) {
      return without_points(mode, [](const auto& point) {
        return point[of_friction] != 0 && (point[of_slack] != 0 || point[of_stiffness] != 0);
      });
    });
  if (const double residual = residual_of(modes); residual > 0)
    for (const StrainPoint& place : places_of(modes))
      add([&](const LifeResponse& mode) { return with_longer_lives(mode, place, residual); });
  return all;
}

/// Returns the standard errors of percentiles, as factors, from the number of samples and from the interpolation and
/// extrapolation of the response between computed lives. The square of log10 of a factor is the sum of the squares of these
/// changes of log10 of the percentile:
///     samples     half the way between the lives at the ranks n s -+ sqrt(n s (1 - s)), s the share (order statistics
///                 of independent samples; a Latin hypercube is better)
///     nodes       without one node of friction, slack or strength, each in turn. The error of a linear interpolation grows with
///                 the square of the distance of nodes, so this is three times the error there. It counts in full,
///                 because other intervals are as wide as the one without the node
///     places      computed lives have the error residual_of(), too: lives at each place of the cables are longer by this, each
///                 in turn
///     together()  together() of friction with slack and with stiffness instead of their computed combinations; counts if other
///                 parameters are combined in this way. Slack and stiffness, whose combinations change lives most, stay together
/// Not included: errors beyond the outermost nodes of friction, slack and stiffness (strain/measurements.md, response and full
/// evaluations).
/// log10_lives: of these samples.
LifePercentiles error_factors(const FailureModes& modes, const std::vector<Samples>& samples,
                              const std::vector<double>& log10_lives) {
  const std::size_t count = log10_lives.size();
  const LifePercentiles percentiles = percentiles_of(log10_lives);
  std::vector<double> sorted = log10_lives;
  std::ranges::sort(sorted);
  constexpr std::array<double, 3> shares{0.1, 0.5, 0.9};
  LifePercentiles squares{};
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double rank = shares[i] * double(count) - 0.5, reach = std::sqrt(double(count) * shares[i] * (1 - shares[i]));
    squares[i] = std::pow((number_at(sorted, rank + reach) - number_at(sorted, rank - reach)) / 2, 2);
  }
  const auto add = [&](const LifePercentiles& other) {
    for (std::size_t i = 0; i < shares.size(); ++i)
      squares[i] += std::pow(std::min(std::log10(other[i]), LifeResponse::endless) - std::log10(percentiles[i]), 2);
  };
  for (const FailureModes& changed : coarser(modes))
    add(percentiles_of(lives_of(surfaces_of(changed), samples, Inside::as_is)));
  LifePercentiles factors{};
  for (std::size_t i = 0; i < shares.size(); ++i)
    factors[i] = std::isfinite(percentiles[i]) ? std::pow(10.0, std::sqrt(squares[i])) : std::nan("");
  return factors;
}

}  // namespace

double residual_of(const FailureModes& modes) {
  return std::ranges::any_of(modes, depends_on_place) ? residual_decades * modes.front().residual_spread : 0;
}

namespace {

constexpr std::string_view samples_word = "samples";

std::string text_of(const StandardSamples& samples) {
  std::string text;
  for (std::size_t k = 0; k < samples.parameters.size(); ++k) {
    text += fmt::format("{} {}", samples_word, uncertain_parameters()[samples.parameters[k]].name);
    for (const double number : samples.numbers.col(static_cast<Eigen::Index>(k)))
      text += fmt::format(" {:.3f}", number);
    text += '\n';
  }
  return text;
}

/// Errors: std::invalid_argument for any text that text_of() does not return.
StandardSamples samples_from_text(const std::string& text) {
  StandardSamples samples;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word, name;
    words >> word >> name;
    std::vector<double> numbers{std::istream_iterator<double>(words), {}};
    const auto column = static_cast<Eigen::Index>(samples.parameters.size());
    const auto rows = static_cast<Eigen::Index>(numbers.size());
    samples.parameters.push_back(index_of(name));
    if (word != samples_word || samples.parameters.back() == uncertain_count || !words.eof() || rows == 0 ||
        (column > 0 && rows != samples.numbers.rows()))
      throw std::invalid_argument("samples of a posterior of other lengths or names");
    samples.numbers.conservativeResize(rows, column + 1);
    samples.numbers.col(column) = Eigen::Map<const Eigen::VectorXd>(numbers.data(), rows);
  }
  return samples;
}

}  // namespace

std::string modes_text(const FailureModes& modes) {
  const auto& samples = modes.front().knowledge.samples;
  assert(
      std::ranges::all_of(modes, [&](const LifeResponse& mode) { return are_equal(mode.knowledge.samples, samples); }));
  return (samples ? text_of(*samples) : "") + joined(mapped(modes, &LifeResponse::text), "");
}

FailureModes modes_from_text(const std::string& text) {
  FailureModes modes;
  const std::size_t first = text.starts_with(samples_word) ? text.find("\nmode ") : std::string::npos;
  std::size_t begin = first == std::string::npos ? 0 : first + 1;
  const auto samples =
      begin > 0 ? std::make_shared<const StandardSamples>(samples_from_text(text.substr(0, begin))) : nullptr;
  while (begin < text.size() || modes.empty()) {
    const std::size_t next = text.find("\nmode ", begin);
    const std::size_t end = next == std::string::npos ? text.size() : next + 1;
    modes.push_back(LifeResponse::from_text(text.substr(begin, end - begin)));
    modes.back().knowledge.samples = samples;
    begin = end;
  }
  return modes;
}

LifePercentiles percentiles_of(std::vector<double> lives) {
  std::ranges::sort(lives);
  constexpr std::array<double, 3> shares{0.1, 0.5, 0.9};
  LifePercentiles percentiles{};
  for (std::size_t i = 0; i < shares.size(); ++i)
    percentiles[i] = std::pow(10.0, number_at(lives, shares[i] * double(lives.size()) - 0.5));
  return percentiles;
}

std::vector<double> first_failures(const FailureModes& modes, const std::string& job, std::size_t samples,
                                   Inside inside) {
  return lives_of(surfaces_of(modes), samples_of(modes, job, samples), inside);
}

std::vector<double> compared_failures(const FailureModes& modes, const std::string& job, const std::string& moved_as,
                                      std::size_t samples) {
  const auto samples_for = [&](const LifeResponse& mode) {
    return samples_of(mode, depends_on_place(mode), job, moved_as, samples, false);
  };
  return lives_of(surfaces_of(modes), mapped(modes, samples_for), Inside::as_is);
}

std::vector<std::vector<double>> mode_lives(const FailureModes& modes, const std::string& job, std::size_t samples) {
  return mapped(modes, [&](const LifeResponse& mode) { return first_failures({mode}, job, samples); });
}

PreparedModes::PreparedModes(const FailureModes& of) : modes(of), surfaces(surfaces_of(of)) {
  for (const LifeResponse& mode : modes) has_residual.push_back(depends_on_place(mode));
}

struct ModeLives::Known {
  LifeResponse mode;  ///< with the fields that share_samples() compares
  bool has_residual;
  Samples samples;
  std::vector<LifeSurface::Factors> factors;  ///< (sample)
};

ModeLives::ModeLives(std::string job, std::size_t samples) : job_(std::move(job)), samples_(samples) {}
ModeLives::~ModeLives() = default;

const ModeLives::Known& ModeLives::samples_for(const LifeResponse& mode, bool has_residual) {
  for (const auto& one : known_)
    if (one->has_residual == has_residual && share_samples(one->mode, mode)) return *one;
  constexpr std::size_t most = 32;  // of 4,000 samples: 18 MB
  if (known_.size() == most) known_.erase(known_.begin());
  Known& made = *known_.emplace_back(std::make_unique<Known>());
  made.mode.mode = mode.mode, made.mode.dresspack = mode.dresspack, made.mode.construction = mode.construction;
  made.mode.material = mode.material, made.mode.knowledge = mode.knowledge,
  made.mode.scatter_shared = mode.scatter_shared, made.mode.residual_spread = mode.residual_spread;
  made.has_residual = has_residual;
  made.samples = samples_of(mode, has_residual, job_, job_, samples_, false);
  for (const ParameterPoint& z : made.samples.z) made.factors.push_back(LifeSurface::factors_at(z));
  return made;
}

std::vector<std::vector<double>> ModeLives::of(const PreparedModes& prepared, std::vector<std::vector<double>> lives) {
  lives.resize(prepared.modes.size());
  for (std::size_t m = 0; m < prepared.modes.size(); ++m) {
    const auto& [mode, has_residual, samples, factors] = samples_for(prepared.modes[m], prepared.has_residual[m]);
    std::vector<double>& of_mode = lives[m];
    of_mode.resize(samples_);
    for (std::size_t s = 0; s < samples_; ++s) {
      of_mode[s] = prepared.surfaces[m].log10_life(samples.z[s], samples.u[s], factors[s]);
      if (has_residual) of_mode[s] += samples.residual[s];
    }
  }
  return lives;
}

std::vector<double> shared_samples(const LifeResponse& mode, std::size_t parameter, std::size_t count) {
  assert(uncertain_parameters()[parameter].shared != SharedBy::installation);
  return mapped(samples_of(mode, "", count).z, [&](const ParameterPoint& point) { return point[parameter]; });
}

const std::vector<double>& standard_strata(std::size_t samples) {
  thread_local std::vector<double> strata;
  if (strata.size() != samples) {
    strata.assign(samples, 0.0);
    for (std::size_t s = 0; s < samples / 2; ++s) {
      strata[s] = normal_quantile((double(s) + 0.5) / double(samples));
      strata[samples - 1 - s] = -strata[s];
    }
  }
  return strata;
}

std::vector<double> in_order_of(const std::string& name, std::vector<double> values) {
  // Computes remainders by multiplication, because the plan of a large plant needs 1e8 of them and a division takes three times
  // as long. floor(x floor((2^64 - 1)/k) / 2^64) is the quotient, or smaller by one.
  __extension__ using Wide = unsigned __int128;
  thread_local std::vector<std::uint64_t> inverse;  // (k)
  for (std::uint64_t k = inverse.size(); k <= values.size(); ++k)
    inverse.push_back(~std::uint64_t{0} / std::max<std::uint64_t>(k, 1));
  std::uint64_t state = seed_of(name);
  for (std::size_t k = values.size(); k > 1; --k, state += mix_step) {
    const std::uint64_t number = mixed(state);
    std::uint64_t place = number - static_cast<std::uint64_t>(Wide{number} * inverse[k] >> 64) * k;
    if (place >= k) place -= k;
    std::swap(values[k - 1], values[place]);
  }
  return values;
}

std::vector<double> standard_normals(const std::string& name, std::size_t samples) {
  return in_order_of(name, standard_strata(samples));
}

FirstFailures summary_of(const FailureModes& modes, const std::string& job, std::size_t count) {
  const std::vector<LifeSurface> surfaces = surfaces_of(modes);
  const std::vector<Samples> samples = samples_of(modes, job, count);
  FirstFailures summary;
  summary.log10_life = lives_of(surfaces, samples, Inside::as_is, &summary.first);
  const double failed = std::accumulate(summary.first.begin(), summary.first.end(), 0.0);
  for (double& share : summary.first) share = failed > 0 ? share / failed : 0;
  summary.percentiles = percentiles_of(summary.log10_life);
  summary.glued = percentiles_of(lives_of(surfaces, samples, Inside::glued));
  summary.free = percentiles_of(lives_of(surfaces, samples, Inside::free));
  summary.error_factor = error_factors(modes, samples, summary.log10_life);
  find_best_test(modes, surfaces, job, count, summary);
  summary.share = shares_of(modes, surfaces, job);  // last, because standard_strata() keeps one number of samples
  return summary;
}

double share_outliving(const std::vector<double>& one, const std::vector<double>& other) {
  assert(one.size() == other.size() && !one.empty());
  double count = 0;
  for (std::size_t s = 0; s < one.size(); ++s) count += one[s] > other[s] ? 1 : one[s] == other[s] ? 0.5 : 0;
  return count / double(one.size());
}

// The integers are rounded by largest remainders.
std::string share_words(const CauseShares& estimate) {
  CauseShares share{};
  std::ranges::transform(estimate, share.begin(), [](double of) { return std::max(0.0, of); });
  const double all = std::accumulate(share.begin(), share.end(), 0.0);
  if (all == 0) return "";
  std::vector<std::pair<std::string, double>> parts;
  double other = 0;
  for (std::size_t p = 0; p < share.size(); ++p) {
    share[p] /= all;
    if (share[p] >= 0.01)
      parts.emplace_back(p == of_wires      ? "scatter of wires"
                         : p == of_residual ? "numerical error"
                                            : uncertain_parameters()[p].name,
                         100 * share[p]);
    else
      other += 100 * share[p];
  }
  std::ranges::stable_sort(parts, [](const auto& a, const auto& b) { return a.second > b.second; });
  parts.emplace_back("other", other);
  int missing = 100;
  for (const auto& [name, percent] : parts) missing -= static_cast<int>(std::floor(percent));
  const std::vector<std::size_t> order =
      largest_first(parts.size(), [&](std::size_t k) { return parts[k].second - std::floor(parts[k].second); });
  std::vector<int> whole(parts.size());
  for (std::size_t k = 0; k < parts.size(); ++k) whole[k] = static_cast<int>(std::floor(parts[k].second));
  for (std::size_t k = 0; k < order.size() && missing > 0; ++k, --missing) ++whole[order[k]];
  std::string words;
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (whole[k] != 0) words += fmt::format("{}{} {} %", words.empty() ? "" : "; ", parts[k].first, whole[k]);
  return words;
}

std::size_t largest_share(const CauseShares& share) {
  return static_cast<std::size_t>(std::max_element(share.begin(), share.begin() + of_residual) - share.begin());
}

}  // namespace dresslife::pipeline
