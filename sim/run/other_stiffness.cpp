#include "sim/run/other_stiffness.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "pipeline/base/warning_words.h"
#include "pipeline/job/uncertainty.h"
#include "sim/run/simulate.h"

namespace dresslife::sim {
namespace {

using pipeline::Uncertain;
using pipeline::Warning;

/// A recorded motion, kept until its simulation has reached the end.
struct RecordedMotion {
  std::vector<double> position, orientation, clamp_position, clamp_orientation;

  void add(const Sample& sample) {
    for (const Vector3& place : sample.state.position) put(position, place);
    for (const Quaternion& turn : sample.state.orientation) put(orientation, turn);
    for (const Frame& clamp : sample.clamps)
      put(clamp_position, clamp.position), put(clamp_orientation, clamp.orientation);
  }
  void write(pipeline::FileWriter& file, const std::string& group) const {
    file.append(group + "/segment/position", std::span<const double>(position));
    file.append(group + "/segment/orientation", std::span<const double>(orientation));
    file.append(group + "/clamp/position", std::span<const double>(clamp_position));
    file.append(group + "/clamp/orientation", std::span<const double>(clamp_orientation));
  }

 private:
  static void put(std::vector<double>& row, const Vector3& v) {
    row.insert(row.end(), {v.x(), v.y(), v.z()});
  }
  static void put(std::vector<double>& row, const Quaternion& q) {
    row.insert(row.end(), {q.w(), q.x(), q.y(), q.z()});
  }
};

pipeline::Setup setup_with(const pipeline::Job& job, double factor, double time_step) {
  pipeline::Setup setup = job;
  pipeline::SimulationSettings& settings = setup.simulation;
  settings.stiffness_factor *= factor;
  settings.choose_time_step = false;
  settings.time_step = time_step;
  settings.most_repeats = std::min(settings.most_repeats, 2);  // the first repeat is the lead-in
  return setup;
}

double factor_of(double z) { return pipeline::uncertain_parameters()[index_of(Uncertain::hose_stiffness)].value(z); }

/// Returns WHAT of a message "WHERE: error: WHAT; REMEDY": place and remedy are those of the changed job, which the user does not see.
std::string problem_in(const std::string& message) {
  const std::string mark = ": error: ";
  const std::size_t at = message.find(mark), begin = at == std::string::npos ? 0 : at + mark.size();
  return message.substr(begin, message.find("; ", begin) - begin);
}

/// Returns the warning of a refused simulation at the stiffness z. recorded: z of half the change, 0 if that is refused, too.
Warning refused(const std::string& side, double z, double recorded, const std::string& problem) {
  // 5 % of hoses lie beyond z, and 20 % beyond half of it: see pipeline::other_stiffness()
  const std::string lives =
      recorded == 0
          ? "Its lives there are those of a straight line through the other stiffness"
          : fmt::format(
                "5 to 20 % of hoses are too {} for this program, but their lives are those of a straight line "
                "through 1 and {:.2g} times the stiffness",
                side == "softer" ? "soft" : "stiff", factor_of(recorded));
  return pipeline::warning_of(
      pipeline::WarningKind::slack, "",
      fmt::format("with {:.2g} times the hose's bending stiffness the simulation is refused ({}). {}",
                  factor_of(z), problem, lives),
      "the routing leaves this hose no room for another stiffness",
      "more free length; or measure the hose, and give bending_stiffness_Nm2 and a smaller uncertainty.hose_stiffness");
}

}  // namespace

std::vector<Warning> write_other_stiffnesses(const pipeline::Job& job, double time_step,
                                             pipeline::FileWriter& file) {
  const double reach = pipeline::other_stiffness(job.uncertainty);
  std::vector<Warning> warnings;
  if (reach == 0) return warnings;
  for (const auto& [name, side] : {std::pair("softer", -reach), std::pair("stiffer", reach)}) {
    std::string problem;
    double recorded = 0;
    for (const double z : {side, side / 2}) {  // a smaller change if the routing does not allow the larger one
      try {
        const Simulation simulation(setup_with(job, factor_of(z), time_step));
        RecordedMotion places;
        simulation.run({.take = [&](const Sample& sample) { places.add(sample); },
                        .begin = [&](int) { places = {}; },
                        .wanted = Wanted::places});
        places.write(file, std::string("/") + name);
        file.attribute(std::string(name) + "_z", z);
        recorded = z;
        break;
      } catch (const pipeline::InputError& refusal) {
        if (problem.empty()) problem = problem_in(refusal.what());
      }
    }
    if (!problem.empty()) warnings.push_back(refused(name, side, recorded, problem));
  }
  return warnings;
}

}  // namespace dresslife::sim
