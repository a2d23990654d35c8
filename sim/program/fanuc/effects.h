// Possible effects of Fanuc statements, found without running them, for undecided branches. A branch
// whose arms neither move the robot nor lead elsewhere is no question: what they may write is unknown from
// then on.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "sim/program/fanuc/parser.h"

namespace dresslife::sim {

struct FanucEffects {
  bool moves = false;         ///< the robot
  bool waits = false;         ///< for a time
  bool leaves = false;        ///< a jump may lead out of these statements
  bool any_register = false;  ///< writes registers and position registers that are not known before
  std::set<int> registers, positions;
  std::set<std::string>
      named;  ///< "override", "$prgoverride", "uframe_num", "utool_num", "uframe[2]", "uframe[]": any

  void add(const FanucEffects& other);
};

/// Programs by their names (lower case) and macros by theirs, which name programs.
class FanucOutlook {
 public:
  FanucOutlook(const std::vector<FanucListing>& listings, const std::map<std::string, std::string>& macros);

  /// Null: not among those read.
  const FanucListing* program(const std::string& name) const;
  /// The program that a statement calls as a macro; null: none, or one that is not read.
  const FanucListing* macro(const std::string& statement) const;

  /// Of the statements from .. to - 1 of a listing. Jumps to `to` itself do not leave.
  FanucEffects effects(const FanucListing& listing, std::size_t from, std::size_t to);
  /// Whether a decision (an IF with its block, a SELECT with its cases) can jump out of the statements from
  /// .. to.
  bool leads_out(const FanucListing& listing, std::size_t decision, std::size_t from, std::size_t to) const;
  /// Of one action: a statement, or what follows the condition of an IF.
  FanucEffects effects(const std::string& action);

 private:
  const FanucEffects& whole(const FanucListing& listing);

  const std::vector<FanucListing>& listings_;
  const std::map<std::string, std::string>& macros_;
  std::map<std::string, const FanucListing*> by_name_;
  std::map<const FanucListing*, FanucEffects> known_;
};

/// What an IF, SELECT, = or ELSE does behind its comma; other statements whole.
std::string fanuc_action(const std::string& statement);

enum class FanucWord { motion, logic, shapes_motion, other };

/// A system variable that moves depend on, which a statement assigns.
struct FanucSetting {
  std::string name;   ///< as in FanucEffects::named; empty: there is none
  int number = 0;     ///< of a frame
  int component = 0;  ///< of a frame: 1 .. 6 for X, Y, Z, W, P, R; 0: the whole frame
};
/// "$MNUTOOL[1,2].$Z=..." is {"utool[2]", 2, 3}, "$MCR.$GENOVERRIDE=..." is {"override"}.
FanucSetting fanuc_setting(const std::string& statement);

/// By the first word of a statement (lower case). shapes_motion: weaving, tracking, touching, soft axes: what
/// it does lies in the controller. other: control flow, assignments, macros.
FanucWord fanuc_word(const std::string& word);

}  // namespace dresslife::sim
