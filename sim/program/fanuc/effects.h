// Finds the possible effects of Fanuc statements without running them, for branches with an unknown condition. A branch
// whose arms do not move the robot and do not jump out is not a question. The values that its arms may write are
// unknown afterwards.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "sim/program/fanuc/parser.h"

namespace dresslife::sim {

struct FanucEffects {
  bool moves = false;   ///< whether the robot moves
  bool waits = false;   ///< whether a timed wait occurs
  bool leaves = false;  ///< whether a jump may lead out of these statements
  /// What may be written: "r[5]", "pr[2]", "override", "$prgoverride", "uframe_num", "utool_num", "utool[2]".
  /// "uframe[]": a user frame of unknown number; "r[]": R[] or PR[] of unknown numbers.
  std::set<std::string> written;
  std::set<std::string> unread;  ///< programs and macros without a listing: "CALL GRIP"

  void add(const FanucEffects& other);
};

/// Effects of programs and macros. Keys are names in lower case. `macros` maps a macro to its program.
class FanucOutlook {
 public:
  FanucOutlook(const std::vector<FanucListing>& listings, const std::map<std::string, std::string>& macros);

  /// Returns the listing of a program; null: no listing was read for it.
  const FanucListing* program(const std::string& name) const;
  /// Returns the program that a statement calls as a macro; null: no macro, or no listing was read for it.
  const FanucListing* macro(const std::string& statement) const;

  /// Returns the effects of the statements from .. to - 1 of a listing. A jump to `to` itself is not `leaves`.
  FanucEffects effects(const FanucListing& listing, std::size_t from, std::size_t to);
  /// Returns whether a decision (an IF with its block, a SELECT with its cases) can jump out of the statements
  /// from .. to.
  bool leads_out(const FanucListing& listing, std::size_t decision, std::size_t from, std::size_t to) const;
  /// Returns the effects of one action: a statement, or the text after the condition of an IF.
  FanucEffects effects(const std::string& action);

 private:
  const FanucEffects& whole(const FanucListing& listing);

  const std::vector<FanucListing>& listings_;
  const std::map<std::string, std::string>& macros_;
  std::map<std::string, const FanucListing*> by_name_;
  std::map<const FanucListing*, FanucEffects> known_;
};

/// Returns the action after the comma of an IF, SELECT, = or ELSE; empty: no action. Returns other statements unchanged.
std::string fanuc_action(const std::string& statement);

/// Returns the name of the macro that a statement calls, at most 40 characters: "MACRO OPEN GUN".
std::string macro_name(const std::string& statement);

enum class FanucWord { motion, logic, shapes_motion, other };

/// An assignment to a system variable that has an effect on moves.
struct FanucSetting {
  std::string name;   ///< as in FanucEffects::written; empty: no such variable
  int number = 0;     ///< number of the frame
  int component = 0;  ///< component of the frame: 1 .. 6 for X, Y, Z, W, P, R; 0: the whole frame
};
/// Returns the variable that `statement` assigns. "$MNUTOOL[1,2].$Z=..." gives {"utool[2]", 2, 3};
/// "$MCR.$GENOVERRIDE=..." gives {"override"}.
FanucSetting fanuc_setting(const std::string& statement);

/// Classifies a statement by its first word (lower case). shapes_motion: weaving, tracking, touching, soft axes, whose
/// data lie in the controller. other: control flow, assignments, macros.
FanucWord fanuc_word(const std::string& word);

}  // namespace dresslife::sim
