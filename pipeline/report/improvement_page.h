// The page of a search for longer lives: before and after side by side, changes, gain and its confidence, mounting
// tolerance, and the course of the search.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace dresslife::pipeline {

struct ImprovementStory {
  struct Change {
    std::string key, before, after;  ///< before: empty if a job does not have it, or jobs differ in it
  };
  struct Lives {
    std::string page;                  ///< of the job, relative to this page; empty: there is none
    std::string words;                 ///< of its limits: "all kept"
    std::string modes;                 ///< without a validated law, with their hours
    double p10 = 0, p50 = 0, p90 = 0;  ///< [h] of the worst job
  };
  struct TrialPoint {
    int trial = 0;
    bool ran = false, feasible = false;
    double hours = 0;
    std::string words;  ///< violated limits
  };
  struct Nudge {
    std::string what;  ///< "base clamp, z + 10 mm"
    bool ran = false;
    double share = 0;   ///< its life over that without the change
    std::string words;  ///< violated limits; empty: none
    std::string first_mode{};  ///< without a validated law, the first in the robot's life; empty: none
    double first_hours = 0;    ///< until 1 of 10 has failed by it
  };

  std::string name;
  std::vector<Change> changes;
  std::optional<Lives> before, after;
  std::string keep;                 ///< why the jobs should stay as they are; empty: the best is a gain
  std::string choice;               ///< lines: by what the best was chosen, and why another was not
  std::string gain;                 ///< sentences; empty: the jobs before do not run
  std::optional<double> longer_in;  ///< share of samples in which the wires live longer than before
  std::vector<Nudge> nudges;
  std::vector<TrialPoint> looks;
  std::vector<std::pair<double, double>> front;  ///< second objective, life [h]; with two objectives
  std::string second_title;                      ///< "free length [m]"
};

/// A whole page.
std::string improvement_page(const ImprovementStory& story);

}  // namespace dresslife::pipeline
