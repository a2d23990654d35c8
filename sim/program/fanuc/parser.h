// Parser of a Fanuc listing: its statements, joined over continued lines, and its positions.
//
// A statement is "  12:  text ;". A line without a number before ':' continues the statement of the previous line. A
// line with a number begins a new statement, even if the previous statement has no ';'. "------ ;" closes the lines
// that a move runs at its end (P-SPS) and is ignored. German words are translated to English (words.h).
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "sim/program/interpreter/program.h"

namespace dresslife::sim {

struct FanucStatement {
  std::string text;       ///< English text without number and ';'
  int line = 0;           ///< first line of the statement
  int column = 0;         ///< first column of the text
  std::size_t other = 0;  ///< IF ... THEN: index of its ELSE, or of its ENDIF if it has no ELSE
  std::size_t end = 0;    ///< index; IF ... THEN, ELSE: of the ENDIF; FOR: of the ENDFOR; ENDFOR: of the FOR
};

/// A P[n] or PR[n]. A value that is not taught or not known is NaN.
struct FanucPosition {
  enum class Form { unknown, pose, joints, other_groups };
  Form form = Form::unknown;   ///< other_groups: the position has no values of the robot's group
  std::vector<double> values;  ///< X Y Z [mm], W P R [deg], or the joint angles of the listing [deg]
  ArmConfiguration configuration;
  bool remote = false;                ///< RX, RY ...: pose of the remote tool UF in the frame UT
  std::vector<double> external_axes;  ///< E1 ..., then the axes of groups 2 and up
  int frame = 0, tool = 0;            ///< numbers of UF and UT; -1: the active frame (F)

  bool known() const;  ///< whether `values` is not empty and all values and external axes are finite
};

struct FanucListing {
  std::string name;  ///< word after /PROG, in lower case
  int file = 0;
  std::vector<FanucStatement> statements;
  std::map<int, FanucPosition> positions;
  std::map<int, std::size_t> labels;  ///< LBL[n] -> index of the statement
  std::set<std::size_t> doubled;      ///< indices of labels that a later line has, too
};

FanucListing parse_fanuc(const SourceFile& source, int file, Program& program, Problems& problems);

/// Parses the text of a CONFIG without its quotes: "N U T, 0, 0, 0". Returns std::nullopt for another form.
std::optional<ArmConfiguration> fanuc_configuration(std::string_view text);

/// Returns the number without its fraction, clamped to 0 .. 1,000,000. For indices, counts and lines.
int whole_number(double number);

/// A cursor over one statement or one position.
class FanucCursor {
 public:
  explicit FanucCursor(std::string_view text) : text_(text) {}

  void skip_blanks();
  bool at_end();
  bool take(std::string_view word);  ///< ignores case and leading blanks; false within a longer word
  bool take_sign(char sign);
  bool take_signs(std::string_view signs);  ///< "<>"
  void skip_to(char sign);                  ///< moves behind the next `sign`, or to the end of the text
  std::optional<double> number();           ///< a number with an optional sign
  std::string word();                       ///< letters, digits, _ and $; lower case
  std::string_view name();                  ///< a program's name: letters, digits, _, - and $, case unchanged
  std::string_view rest();
  std::string_view from(std::size_t begin) const { return text_.substr(begin, at_ - begin); }
  std::size_t offset() const { return at_; }
  void move_to(std::size_t offset) { at_ = offset; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace dresslife::sim
