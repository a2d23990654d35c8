// Failure modes of a dresspack, and how the life of each mode depends on uncertain parameters
// (pipeline/life/first_failure.h).
//
// A mode is: the first conductor of the cables of one name has lost its share of wires at one place. A job with signal cables
// and power cables has two modes, and each dresspack has its own. The hose's wall is not a mode, because its law has not been
// compared with a test.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fatigue/conductors.h"
#include "fatigue/response.h"
#include "pipeline/life/first_failure.h"

namespace dresslife::fatigue {

/// The modes of a job, in the order of its components.
class ModeList {
 public:
  ModeList(const pipeline::Job& job, const TextColumn& component);

  std::size_t size() const { return name_.size(); }
  const std::string& name(std::size_t mode) const { return name_[mode]; }  ///< "wires of signal cable"
  std::size_t dresspack(std::size_t mode) const { return dresspack_[mode]; }
  /// Returns the mode of a wire's path; no_site: none.
  std::size_t of(const std::string& wire) const;
  /// Returns the mode of each path of a column, (component).
  std::vector<std::size_t> of(const TextColumn& component) const;

 private:
  const pipeline::Job& job_;
  std::vector<std::vector<std::string>> layers_;  ///< (dresspack) names of layers
  std::vector<std::string> name_;
  std::vector<std::size_t> dresspack_;
};

/// Input for the lives of modes.
struct ModeInputs {
  const pipeline::Job& job;
  const SiteSet& sites;
  const TextColumn& component;
  const SiteDamage& damage;
  const Conductors& conductors;
  const std::vector<PlacesOfConductor>& places;
  std::size_t segments, threads;
  std::function<std::vector<float>(std::size_t site)> strains_of;     ///< empty: its planes were not evaluated
  std::function<std::vector<float>(std::size_t site)> equivalent_of;  ///< see put_planes(); null: without planes
  std::vector<std::size_t> starts;    ///< (rest) number of starts of loose cables, see read_rests()
  std::vector<VariedStrains> varied;  ///< empty: only the scatter of wires is uncertain
  std::vector<double> taut;           ///< see read_taut_stiffnesses()
  /// (mode) life of the worst wire [repeats] if everything inside the cables is glued, and if it slips freely.
  std::vector<double> glued, free;
  Percentiles planned;  ///< of all modes together, over the scatter of wires [repeats]
};

/// Most decades from the first wire's life to the conductor's. In a bend the wires within 18 deg of the worst have 0.95 of its
/// strain and twice its life; they are the tenth whose loss is the failure. A larger distance, up to no damage, occurs at the
/// medians of the parameters, where hardly any wire is damaged, and for a large share of wires, whose lives without load sharing
/// mean nothing. W(z) is known for the worst wire only, and is added to the distance.
constexpr double most_after_first_wire = 1;
/// Returns the lives with their median at most that far above first_wire, the median life of the worst wire [repeats]. No life becomes
/// shorter than that far below it.
Percentiles near_first_wire(Percentiles lives, double first_wire);

/// Returns what is known of the uncertain parameters: the prior, or the posterior of the job's calibration. z counts from the job's
/// own values.
pipeline::ParameterKnowledge knowledge_of_job(const pipeline::Job& job);

/// Returns at least one mode. Without job.uncertainty only the scatter of wires is uncertain.
pipeline::FailureModes failure_modes(const ModeList& modes, const ModeInputs& inputs);

}  // namespace dresslife::fatigue
