#include "strain/varied_pulls.h"

#include <algorithm>
#include <cmath>

namespace dresslife::strain {
namespace {

std::size_t largest(const std::vector<double>& values) {
  return static_cast<std::size_t>(
      std::ranges::max_element(values, [](double a, double b) { return std::abs(a) < std::abs(b); }) - values.begin());
}

}  // namespace

VariedPulls varied_pulls(const std::vector<std::unique_ptr<Evaluation>>& spans, const Shortening& shortening) {
  VariedPulls all;
  for (const auto& evaluation : spans) {
    if (!evaluation->any_cables()) continue;
    const CablePaths& cables = evaluation->cables();
    const bool whole = evaluation->samples() != shortening.samples();
    const auto in_motion = [&](std::size_t sample) {
      return static_cast<std::uint32_t>(whole ? sample : shortening.in_motion(sample));
    };
    std::vector<pipeline::PulledCable> pulled;
    for (std::size_t k = 0; k < cables.cables(); ++k) pulled.push_back(cables.pulled(k));
    const pipeline::CablePulls pulls = pipeline::pulls_of(pulled, evaluation->samples());
    const auto first = static_cast<std::uint32_t>(all.tension.size());
    const double begin = evaluation->arcs().front() - evaluation->lengths().front() / 2;
    for (std::size_t k = 0; k < pulls.tension.size(); ++k) {
      const std::size_t at = largest(pulls.tension[k]);
      const double place = cables.place_of_force(k, at);
      all.tension.push_back(pulls.tension[k][at]);
      all.sample.push_back(in_motion(at));
      all.place.push_back(place < 0 ? place : begin + place);
    }
    const std::size_t bent = largest(pulls.moment);
    std::size_t bender = 0;
    for (std::size_t k = 1; k < pulls.tension.size(); ++k)
      if (std::abs(pulls.tension[k][bent]) > std::abs(pulls.tension[bender][bent])) bender = k;
    const std::vector<double>& of_hose = cables.hose_moment();
    all.moment.insert(all.moment.end(), {pulls.moment[bent], of_hose[largest(of_hose)]});
    all.moment_place.insert(all.moment_place.end(), {in_motion(bent), first + static_cast<std::uint32_t>(bender)});
    all.moment_tension.push_back(pulls.tension[bender][bent]);
  }
  return all;
}

}  // namespace dresslife::strain
