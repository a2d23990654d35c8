// The parts of a Fanuc listing: its statements, joined over continued lines, and its positions.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/program/program.h"

namespace dresslife::sim {

struct FanucStatement {
  std::string_view text;  ///< without number, comment's "!" lines included, without ';'
  int line = 0;           ///< where it begins
  int column = 0;         ///< of its text
};

struct FanucPosition {
  std::vector<double> joints;  ///< as listed [deg]; empty: a pose
  double pose[6] = {};         ///< X Y Z [mm], W P R [deg]
  ArmConfiguration configuration;
  std::vector<double> external_axes;
  int frame = 0, tool = 0;  ///< UF, UT; -1: not given (F)
  int line = 0;
};

struct FanucListing {
  std::string name;  ///< after /PROG, in lower case
  int file = 0;
  std::vector<FanucStatement> statements;
  std::map<int, FanucPosition> positions;
};

/// Views in the result point into the source.
FanucListing parse_fanuc(const SourceFile& source, int file, Problems& problems);

/// A cursor over one statement or one position.
class FanucCursor {
 public:
  explicit FanucCursor(std::string_view text) : text_(text) {}

  void skip_blanks();
  bool at_end();
  bool take(std::string_view word);  ///< ignoring case and blanks before it; not within a longer word
  bool take_sign(char sign);
  std::optional<double> number();  ///< with sign
  std::string word();              ///< letters, digits, _ and $; lower case
  std::string_view rest();
  std::size_t offset() const { return at_; }
  void move_to(std::size_t offset) { at_ = offset; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace dresslife::sim
