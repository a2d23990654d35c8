// Values of a running Fanuc program (registers, position registers, flags) and its expressions.
//
// A value is a number (ON and OFF are 1 and 0) or unknown. Inputs are unknown, and so are values that a program without
// a listing may have written. An unknown value is replaced by the user's value (--value NAME=VALUE). If the user gives
// none, missing() returns its name. Registers start with the values of the backup's variable files (backup.h), or with
// the user's values. Precedence in mixed logic: OR, AND, comparison, sum, product (closest).
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

/// Cause of an unknown value. name: the value that the user can give ("DI[3]", "CALL GRIP"; empty: none).
/// line: the undecided branch that it depends on ("cell.ls:12"; empty: none).
struct FanucCause {
  std::string name, line{};
  bool operator==(const FanucCause&) const = default;
};
using FanucCauses = std::vector<FanucCause>;

/// Adds the causes that `to` does not contain yet, up to 12 in total.
void add_causes(FanucCauses& to, const FanucCauses& more);

class FanucValues {
 public:
  FanucValues(const FanucVariables& backup, const std::map<std::string, std::string>& given, Problems& problems);

  /// Evaluate the text at the cursor and move the cursor behind it. Unknown values are added to causes().
  FanucNumber expression(FanucCursor& at, int depth = 0);
  FanucNumber value(FanucCursor& at, int depth = 0);
  std::optional<bool> condition(FanucCursor& at);

  /// Returns the name of the first unknown value that was read since the last forget_missing(): "DI[3]".
  std::string missing() const { return missing_.empty() ? "" : missing_[0].name; }
  const FanucCauses& causes() const { return missing_; }  ///< all unknown values since then
  void forget_missing() { missing_.clear(); }
  void miss(const FanucCauses& causes) { add_causes(missing_, causes); }
  /// Adds the causes of the unknown components of a position register to causes().
  void miss_position(int number);

  /// Reads an index in brackets: [GP1:5,3:name]. The cursor is before '['.
  struct Index {
    int group = 1;
    FanucNumber number, part;
  };
  std::optional<Index> index(FanucCursor& at, int depth = 0);

  /// Sets R[number]. std::nullopt: unknown, with causes() as its causes.
  void set_register(int number, FanucNumber value);
  void set_position(int number, const FanucPosition& position);
  /// Sets one component of a position register. The other components do not change.
  void set_component(int number, int part, FanucNumber value);
  FanucPosition position_register(int number) const;
  void set_named(const std::string& name, FanucNumber value);  ///< OVERRIDE, UFRAME_NUM, UTOOL_NUM, F[3]
  FanucNumber named(const std::string& name);                  ///< unknown: added to causes()
  bool has_named(const std::string& name) const;
  FanucNumber override_percent(
      const std::string& name) const;  ///< "override", "$prgoverride" [%]; 100 until the program assigns it
  /// Returns the user's value for a plain name (plain_fanuc_name()).
  std::optional<std::string> given(const std::string& name) const;
  /// Returns the plain names of the user's values that the program has not asked for.
  std::vector<std::string> unused() const;
  /// Returns the user's value for a name as a position.
  std::optional<FanucPosition> given_position(const std::string& name) const;

  void forget_register(int number, const FanucCauses& why);
  void forget_position(int number, const FanucCauses& why);
  /// Makes all registers unknown, and the position registers that the program has written. Position registers of the
  /// backup or the user stay known. Those of the backup are doubtful() afterwards.
  void forget_registers(const FanucCauses& why);
  /// Applies the user's value for "CALL NAME": "nothing", or the registers that the program sets: "R[5]=3 R[6]=0".
  /// Returns false if the user gives no value for `call`. Then all registers become unknown.
  bool take_effect(const std::string& call);
  bool doubtful(int position_register) const;

  /// A stored number with the causes of an unknown one.
  struct Stored {
    FanucNumber value;
    FanucCauses causes;
  };
  /// arguments: AR[1], AR[2] ... of a called program. enter() and leave() enclose its run.
  void enter(std::vector<Stored> arguments) { arguments_.push_back(std::move(arguments)); }
  void leave() { arguments_.pop_back(); }

  std::string state() const;  ///< text of all known values; equal texts mean equal values
  /// Evaluates the value of an assignment to R[number]. What it reads decides only if R[number] does.
  FanucNumber source(int number, FanucCursor& at);
  /// Returns the text of all known values that decided something since the program began: a branch, a move, a call.
  /// Registers that only count are left out: "R[1]=3 ".
  std::string deciding_state() const;
  /// Records that the values of position registers decide.
  void read_positions() { read_for(positions_key); }
  long charged() const { return charged_; }

 private:
  FanucNumber function(const std::string& word, FanucNumber of) const;
  FanucNumber operand(FanucCursor& at, int depth);
  FanucNumber unknown(const std::string& name);
  FanucNumber register_value(int number);
  FanucNumber level(FanucCursor& at, int lowest, int depth);
  void take(const std::string& name, const std::string& text, Problems& problems);
  void read_for(int read);
  const FanucCauses* position_causes(int number, int part) const;

  std::map<int, Stored> registers_;
  std::map<int, FanucPosition> positions_;
  std::map<std::string, FanucNumber> named_;  // no entry: never assigned
  std::map<std::string, std::string> given_;  // key: plain_fanuc_name()
  mutable std::set<std::string> used_;        // keys of given_
  std::vector<std::vector<Stored>> arguments_;
  std::set<int> taught_;  // position registers of the backup or the user that the program has not written
  bool doubt_ = false;
  FanucCauses missing_;
  static constexpr int whole_position = -1;
  std::map<int, std::map<int, FanucCauses>> position_causes_;  // PR number -> component, or whole_position
  FanucCauses forgotten_by_;                                   // causes of registers without an own entry
  std::set<int> written_;                                      // registers that the program has set
  static constexpr int program_key = -1, positions_key = -2;   // readers that are no register
  int reader_ = program_key;
  std::map<int, std::set<int>> reads_;  // register that is assigned, or the program -> registers that it has read
  long charged_ = 0;                    // number of operands and operators evaluated
};

/// Returns a name in lower case without comments and blanks: "R[ 5 :speed]" -> "r[5]".
std::string plain_fanuc_name(std::string_view written);

}  // namespace dresslife::sim
