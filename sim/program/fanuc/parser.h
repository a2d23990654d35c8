// The parts of a Fanuc listing: its statements, joined over continued lines, and its positions.
//
// A statement is "  12:  text ;". A line without number and ':' in front goes on with the one before; one
// with a number begins a new statement even where the ';' before it is missing. "------ ;" ends the lines
// that a move runs at its end (P-SPS) and says nothing. German words are read as the English ones
// (words.h).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/program/interpreter/program.h"

namespace dresslife::sim {

struct FanucStatement {
  std::string text;       ///< in English, without number and ';', comments included
  int line = 0;           ///< where it begins
  int column = 0;         ///< of its text
  std::size_t other = 0;  ///< IF ... THEN: index of its ELSE, else of its ENDIF
  std::size_t end = 0;    ///< IF ... THEN, ELSE: of the ENDIF; FOR: of the ENDFOR; ENDFOR: of the FOR
};

/// A P[n] or PR[n]. What is not taught or not known is NaN.
struct FanucPosition {
  enum class Form { unknown, pose, joints, other_groups };
  Form form = Form::unknown;   ///< other_groups: the robot has no part in it
  std::vector<double> values;  ///< X Y Z [mm], W P R [deg], or the joint angles as listed [deg]
  ArmConfiguration configuration;
  bool remote = false;                ///< RX, RY ...: of the remote tool, which is UF, in the frame UT
  std::vector<double> external_axes;  ///< E1 ..., then those of the groups 2 and up
  int frame = 0, tool = 0;            ///< UF, UT; -1: those that are active (F)
  int line = 0;

  bool known() const;  ///< every value
};

struct FanucListing {
  std::string name;  ///< after /PROG, in lower case
  int file = 0;
  std::vector<FanucStatement> statements;
  std::map<int, FanucPosition> positions;
  std::map<int, std::size_t> labels;  ///< LBL[n] -> index of the statement
};

FanucListing parse_fanuc(const SourceFile& source, int file, Program& program, Problems& problems);

/// 'N U T, 0, 0, 0' without the quotes; absent: like none that is read.
std::optional<ArmConfiguration> fanuc_configuration(std::string_view text);

/// The number without its fraction, 0 .. 1,000,000: an index, a count, a line.
int whole_number(double number);

/// A cursor over one statement or one position.
class FanucCursor {
 public:
  explicit FanucCursor(std::string_view text) : text_(text) {}

  void skip_blanks();
  bool at_end();
  bool take(std::string_view word);  ///< ignoring case and blanks before it; not within a longer word
  bool take_sign(char sign);
  bool take_signs(std::string_view signs);  ///< "<>"
  void skip_to(char sign);         ///< behind the next one, or to the end
  std::optional<double> number();  ///< with sign
  std::string word();              ///< letters, digits, _ and $; lower case
  std::string_view name();         ///< of a program: letters, digits, _, - and $, as written
  std::string_view rest();
  std::string_view from(std::size_t begin) const { return text_.substr(begin, at_ - begin); }
  std::size_t offset() const { return at_; }
  void move_to(std::size_t offset) { at_ = offset; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace dresslife::sim
