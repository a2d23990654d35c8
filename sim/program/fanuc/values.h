// What a Fanuc program knows while it runs: registers, position registers, flags, and expressions of them.
//
// A value is a number (ON and OFF are 1 and 0) or unknown: inputs are, and whatever a program that was not
// read may have written. Where a value is unknown, the one that the user gave counts (--value NAME=VALUE),
// else missing() names it. At the start, registers have the values of the backup's variable files
// (backup.h); a value that the user gave replaces them. Mixed logic in parentheses: AND binds closer
// than OR, arithmetic closer than a comparison.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sim/program/fanuc/backup.h"
#include "sim/program/fanuc/parser.h"

namespace dresslife::sim {

using FanucNumber = std::optional<double>;

/// Why something is unknown: the name that would make it known ("DI[3]", "CALL GRIP"; empty: there is none), and the line of
/// an undecided branch that it depends on ("cell.ls:12"; empty: of none).
struct FanucCause {
  std::string name, line{};
  bool operator==(const FanucCause&) const = default;
};
using FanucCauses = std::vector<FanucCause>;

/// Adds those that are not there yet.
void add_causes(FanucCauses& to, const FanucCauses& more);

class FanucValues {
 public:
  FanucValues(const FanucVariables& backup, const std::map<std::string, std::string>& given,
              Problems& problems);

  /// Each advances the cursor behind what it reads.
  FanucNumber expression(FanucCursor& at, int depth = 0);
  FanucNumber value(FanucCursor& at, int depth = 0);
  std::optional<bool> condition(FanucCursor& at);

  /// Name of the first value that turned out unknown since the last forget_missing(), as the language writes it:
  /// "DI[3]".
  std::string missing() const { return missing_.empty() ? "" : missing_[0].name; }
  const FanucCauses& causes() const { return missing_; }  ///< of all of them
  void forget_missing() { missing_.clear(); }
  void miss(const FanucCauses& causes) { add_causes(missing_, causes); }
  /// Adds what makes a position register unknown, or unknown in parts.
  void miss_position(int number);

  /// [GP1:5,3:name]: what stands in brackets; the cursor is before them.
  struct Index {
    int group = 1;
    FanucNumber number, part;
  };
  std::optional<Index> index(FanucCursor& at, int depth = 0);

  /// An unknown value is so because of causes().
  void set_register(int number, FanucNumber value);
  void set_position(int number, const FanucPosition& position);
  /// One component of a position register; what is unknown of it stays so.
  void set_component(int number, int part, FanucNumber value);
  FanucPosition position_register(int number) const;
  void set_named(const std::string& name, FanucNumber value);  ///< OVERRIDE, UFRAME_NUM, UTOOL_NUM, F[3]
  FanucNumber named(const std::string& name);                  ///< with missing()
  bool has_named(const std::string& name) const;
  FanucNumber override_percent(
      const std::string& name) const;  ///< "override", "$prgoverride": 100 until assigned
  std::optional<std::string> given(const std::string& name) const;
  /// What the user gives under a name, as a position.
  std::optional<FanucPosition> given_position(const std::string& name) const;

  void forget_register(int number, const FanucCauses& why);
  void forget_position(int number, const FanucCauses& why);
  /// All of them, and the position registers but for those of the backup that the program did not write: they
  /// are doubtful from then on.
  void forget_registers(const FanucCauses& why);
  /// What the user gives for "CALL NAME": "nothing", or the registers that it sets: "R[5]=3 R[6]=0". False: nothing is given.
  bool take_effect(const std::string& call);
  bool doubtful(int position_register) const;

  /// AR[1], AR[2] ... of the program that is called, from begin to end of its run.
  struct Argument {
    FanucNumber value;
    FanucCauses causes;  ///< of an unknown one
  };
  void enter(std::vector<Argument> arguments) { arguments_.push_back(std::move(arguments)); }
  void leave() { arguments_.pop_back(); }

  std::string state() const;  ///< all values: equal texts, equal values
  long charged() const { return charged_; }

 private:
  FanucNumber function(const std::string& word, FanucNumber of) const;
  FanucNumber operand(FanucCursor& at, int depth);
  FanucNumber unknown(const std::string& name);
  FanucNumber register_value(int number);
  FanucNumber level(FanucCursor& at, int lowest, int depth);
  void take(const std::string& name, const std::string& text, Problems& problems);

  std::map<int, double> registers_;
  std::map<int, FanucPosition> positions_;
  std::map<std::string, FanucNumber> named_;  // absent: never assigned
  std::map<std::string, std::string> given_;  // by their names in lower case, without comments and blanks
  std::vector<std::vector<Argument>> arguments_;
  std::set<int> taught_;  // position registers of the backup or the user that the program has not written
  bool doubt_ = false;
  FanucCauses missing_;
  std::map<int, FanucCauses> register_causes_, position_causes_;  // of unknown ones
  std::map<int, std::map<int, FanucCauses>> component_causes_;    // of position registers
  FanucCauses forgotten_by_;                                      // of those without another cause
  std::set<int> written_;                                         // registers that the program has set
  long charged_ = 0;                                              // operators read
};

/// "R[ 5 :speed]" -> "r[5]".
std::string plain_fanuc_name(std::string_view written);

}  // namespace dresslife::sim
