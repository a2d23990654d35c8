// What can fail in a dresspack, and how the life of each mode depends on what is uncertain
// (pipeline/life/first_failure.h).
//
// A mode is: the first conductor of the cables of one name that has lost its share of wires at one place. A
// job with signal cables and power cables has two, and each dresspack has its own. The hose's wall is no
// mode: its law has not been compared with a test.
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
  /// Of a wire's path; no_site: it is of no mode.
  std::size_t of(const std::string& wire) const;
  /// (component) the same for a whole column.
  std::vector<std::size_t> of(const TextColumn& component) const;

 private:
  const pipeline::Job& job_;
  std::vector<std::vector<std::string>> layers_;  ///< (dresspack) names of layers
  std::vector<std::string> name_;
  std::vector<std::size_t> dresspack_;
};

/// What the lives of modes follow from.
struct ModeInputs {
  const pipeline::Job& job;
  const SiteSet& sites;
  const TextColumn& component;
  const SiteDamage& damage;
  const Conductors& conductors;
  const std::vector<PlacesOfConductor>& places;
  std::size_t segments, threads;
  std::function<std::vector<float>(std::size_t site)> strains_of;
  std::vector<std::size_t> starts;    ///< (rest) of loose cables, see read_rests()
  std::vector<VariedStrains> varied;  ///< empty: nothing is uncertain but the scatter of wires
  /// (mode) lives of the worst wire [repeats] if everything inside the cables is glued, and if it slips freely.
  std::vector<double> glued, free;
  Percentiles planned;  ///< of all modes together, over the scatter of wires [repeats]
};

/// At least one. Without job.uncertainty only the scatter of wires is uncertain.
pipeline::FailureModes failure_modes(const ModeList& modes, const ModeInputs& inputs);

}  // namespace dresslife::fatigue
