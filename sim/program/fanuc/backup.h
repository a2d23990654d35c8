// Files beside the listings in a backup of a Fanuc controller: the values of its registers, position
// registers, frames and macros as variable files (.va), and the listing that runs.
//
//   file         variable                       line                  is
//   numreg.va    [*NUMREG*]$NUMREG              [5] = 3  'name'       R[5]
//   posreg.va    [*POSREG*]$POSREG              [1,7] = 'name' ...    PR[7] of group 1
//   sysframe.va  [*SYSTEM*]$MNUFRAME            [1,2] = ...           UFRAME[2] of group 1
//                [*SYSTEM*]$MNUTOOL             [1,2] = ...           UTOOL[2] of group 1
//                [*SYSTEM*]$MNUFRAMENUM         [1] = 2               UFRAME_NUM
//                [*SYSTEM*]$MNUTOOLNUM          [1] = 2               UTOOL_NUM
//   sysmacro.va  [*SYSTEM*]$MACROTABLE          $MACRO_NAME, $PROG_NAME   macros
//   system.va    [*SYSTEM*]$OFFSET_CART         ... = FALSE           how offsets count
//
// A folder becomes a Backup by fanuc_backup(). The values are those of the moment at which the
// backup was made. Other variables are not read. Source: backups.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/program/fanuc/parser.h"
#include "sim/program/interpreter/program_folder.h"

namespace dresslife::sim {

struct FanucVariables {
  std::map<int, double> registers;
  std::map<int, FanucPosition> position_registers;  ///< of group 1; frame and tool -1
  std::map<int, FanucPosition> frames, tools;       ///< of group 1
  std::optional<int> frame_number, tool_number;
  std::map<std::string, std::string> macros;  ///< its name in lower case -> its program's
  bool offsets_are_frames = false;            ///< $OFFSET_CART; FALSE as controllers are delivered
};

/// Adds what a variable file holds; a file that holds none of these adds nothing.
void read_fanuc_variables(const SourceFile& file, FanucVariables& into);

/// The files that a listing needs of those beside it: the variable files above, and the listings that it
/// calls, directly or through others, whatever the case of their names. Without the listing itself.
std::vector<std::filesystem::path> fanuc_files_beside(const std::filesystem::path& listing);

/// A backup as a folder.
struct FanucFolder {
  std::vector<std::filesystem::path> listings;   ///< programs that can be read, in the order of their names
  std::vector<std::filesystem::path> variables;  ///< the .va files above
  /// Programs that move the robot, themselves or through others, and that none of the others calls. One: it
  /// is the program of the folder; more: the user chooses (--routine).
  std::vector<std::string> mains;
};

/// Empty listings: no Fanuc backup. Logs that end in .ls but are no programs are left out.
FanucFolder fanuc_folder(const std::filesystem::path& folder);

/// The programs of this language among `files` of `folder`. routine: the requested one; empty: none. Errors: InputError that names the
/// choices if there are several programs.
Backup fanuc_backup(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files,
                 const std::string& routine);

}  // namespace dresslife::sim
