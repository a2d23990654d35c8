// The page of a search for longer lives: before and after side by side, changes, gain and its confidence, mounting
// tolerance, and the course of the search.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace dresslife::pipeline {

struct ImprovementStory {
  struct Change {
    std::string key, before,
        after;  ///< before: empty if a job does not have the key, or if the jobs have different values
  };
  struct Lives {
    std::string page;                  ///< address of the job's page, relative to this page; empty: none
    std::string words;                 ///< state of the limits: "all kept"
    std::string modes;                 ///< modes without a validated law, with their hours
    double p10 = 0, p50 = 0, p90 = 0;  ///< lives of the worst job [h]
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
    double share = 0;          ///< life with this change over the life without it; 0 also if the latter is endless
    std::string words;         ///< violated limits; empty: none
    std::string first_mode{};  ///< first mode without a validated law within the robot's life; empty: none
    double first_hours = 0;    ///< hours until 1 of 10 has failed by first_mode
    bool estimated = false;    ///< whether both lives are estimates by runs without uncertain inputs
    double hours = 0;          ///< life of the wires with this change
  };

  std::string name;
  std::vector<Change> changes;
  std::optional<Lives> before, after;
  std::string keep;                 ///< reason to keep the jobs unchanged; empty: the best trial is a gain
  std::string choice;               ///< lines: criterion of the choice, and reasons against other trials
  std::string gain;                 ///< sentences about the gain; empty: the original jobs do not run
  std::optional<double> longer_in;  ///< share of samples in which the wires live longer than before
  std::vector<Nudge> nudges;
  std::vector<TrialPoint> points;
  std::vector<std::pair<double, double>> front;  ///< (second objective, life [h]); only with two objectives
  std::string second_title;                      ///< "free length [m]"
};

/// Returns the whole page.
std::string improvement_page(const ImprovementStory& story);

}  // namespace dresslife::pipeline
