// Failure modes whose law has not been compared with a published test: their lives stand beside those of the
// wires and are not in the planner's hours. Of a maker's rating the life is a lower bound: by then the promise ends.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace dresslife::pipeline {

struct UnvalidatedMode {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  static constexpr const char* wall = "hose's wall";
  static constexpr const char* abrasion = "abrasion";
  static constexpr const char* jacket = "jacket wear";
  static constexpr const char* rating = "maker's rating";
  static constexpr const char* corkscrew = "corkscrew";
  static constexpr const char* kink = "kink";

  std::string mode;       ///< one of the above
  std::string dresspack;  ///< in which, among several; empty: the only one
  /// By then it has failed in 10, 50, 90 % of such dresspacks [h]; infinite: never. Of the wall in old files only the median.
  std::array<double, 3> hours{unknown, unknown, unknown};
  double first_share = unknown;   ///< of the samples in which it fails before any validated mode
  double together_p10 = unknown;  ///< the planner's hours if this mode counted, too [h]
  int segment_from_tool = 0;      ///< of its worst place, 1 is nearest to the tool; 0: not known
  double position_from_tool = 0;  ///< [m]
  std::string place;              ///< what rubs: "link_4"; of the wall the place around it: "hose 5"; a cable
  double time = 0;                ///< when it is loaded most [s]
  std::string step;               ///< program line that runs then; empty: none
  double bends_at_limit = 0;      ///< of the wall by its law: bends of a straight hose to its bend radius limit; 0: not known
  std::string note;                ///< further sentences; empty: none

  double found_share = unknown;   ///< of what fails within the robot's life, visual checks find this before; unknown: nothing fails
  double unseen_share = unknown;  ///< of all dresspacks: they fail within the robot's life, and no check has found it
  double visible_from = unknown;  ///< share of its life after which a visual check can see it; unknown: never
  double margin = 0;  ///< of a kink: radius of the tightest bend over that at which the tube kinks; 0: another mode
  /// By then 1 of 10 has failed by this mode; of the wall in old files half.
  double early_hours() const { return std::isnan(hours[0]) ? hours[1] : hours[0]; }
  bool operator==(const UnvalidatedMode&) const = default;
};

/// Bends that a corrugated hose of polyamide 11, 70 mm wide, endured without damage: the only published test that was found
/// (REIKU, internal flexibility test; its radius is not published and counts as the limit).
constexpr double published_wall_bends = 16e6;
/// False for a wall whose law contradicts this test and whose life is below 1e5 h, longer than any robot works. No number of
/// this life is shown. True for all other modes.
bool is_credible(const UnvalidatedMode& mode);

/// For an attribute: a line each, with tabs between the values in the order above.
std::string unvalidated_text(const std::vector<UnvalidatedMode>& modes);
/// And back. Errors: std::invalid_argument for a line that is none.
std::vector<UnvalidatedMode> unvalidated_from(const std::string& text);

}  // namespace dresslife::pipeline
