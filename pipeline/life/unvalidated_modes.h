// Failure modes whose law was not compared with a published test. Their lives are shown beside those of the wires and are not
// included in the planner's hours. The life of a maker's rating is a lower bound: it is the end of the maker's promise.
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

  std::string mode;       ///< one of the names above
  std::string dresspack;  ///< name of the dresspack, if there are several; empty: the only one
  /// Hours until 10, 50, 90 % of such dresspacks have failed [h]; infinite: never. In old files, the wall has the median only.
  std::array<double, 3> hours{unknown, unknown, unknown};
  double first_share = unknown;   ///< share of the samples in which this mode fails before any validated mode
  double together_p10 = unknown;  ///< the planner's hours if this mode was included [h]
  int segment_from_tool = 0;      ///< segment of its worst place, 1 is nearest to the tool; 0: unknown
  double position_from_tool = 0;  ///< [m]
  std::string place;  ///< the body that rubs: "link_4"; of the wall, its place: "hose 5"; of a rating, its cable
  double time = 0;    ///< time of the largest load [s]
  std::string step;   ///< program line at that time; empty: none
  double bends_at_limit = 0;  ///< of the wall, by its law: bends from straight to its bend radius limit; 0: unknown
  std::string note;           ///< further sentences; empty: none

  double found_share =
      unknown;  ///< share of the failures before the replacement that visual checks find in time; unknown: none fails
  double unseen_share =
      unknown;  ///< share of all dresspacks that fail before their replacement without a check finding it
  double visible_from = unknown;  ///< share of its life after which a visual check can find it; unknown: never
  double margin = 0;              ///< for a kink: tightest bend radius / kink radius of the tube; 0: another mode
  /// Returns the hours until 10 % have failed by this mode; in old files, the median for the wall.
  double early_hours() const { return std::isnan(hours[0]) ? hours[1] : hours[0]; }
  bool operator==(const UnvalidatedMode&) const = default;
};

/// Bends that a corrugated hose of polyamide 11, 70 mm wide, endured without damage: the only published test that was found
/// (REIKU, internal flexibility test; its radius is not published and is assumed to be the limit).
constexpr double published_wall_bends = 16e6;
/// Returns false for a wall whose law contradicts this test and whose life is below 1e5 h, which is longer than any robot works.
/// Then no number of this life is shown. Returns true for all other modes.
bool is_credible(const UnvalidatedMode& mode);

/// Returns the text for an attribute: one line per mode, with the values in the order above between tabs.
std::string unvalidated_text(const std::vector<UnvalidatedMode>& modes);
/// Reads a text of unvalidated_text(). Errors: std::invalid_argument for a wrong line.
std::vector<UnvalidatedMode> unvalidated_from(const std::string& text);

}  // namespace dresslife::pipeline
