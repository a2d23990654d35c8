// Reads the backup of a Fanuc controller: variable files (.va) with the values of registers, position registers, frames
// and macros, and the choice of the listing to run.
//
//   file         variable                       line                  content
//   numreg.va    [*NUMREG*]$NUMREG              [5] = 3  'name'       R[5]
//   posreg.va    [*POSREG*]$POSREG              [1,7] = 'name' ...    PR[7] of group 1
//   sysframe.va  [*SYSTEM*]$MNUFRAME            [1,2] = ...           UFRAME[2] of group 1
//                [*SYSTEM*]$MNUTOOL             [1,2] = ...           UTOOL[2] of group 1
//                [*SYSTEM*]$MNUFRAMENUM         [1] = 2               UFRAME_NUM
//                [*SYSTEM*]$MNUTOOLNUM          [1] = 2               UTOOL_NUM
//   sysmacro.va  [*SYSTEM*]$MACROTABLE          $MACRO_NAME, $PROG_NAME   macros
//   system.va    [*SYSTEM*]$OFFSET_CART         ... = FALSE           whether offsets are frames
//
// framevar.va is read like sysframe.va. fanuc_backup() makes a Backup of a folder. The values are those at the time of
// the backup. Other variables are not read. Source: backups.
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
  std::map<int, FanucPosition> position_registers;  ///< group 1; their frame and tool are -1
  std::map<int, FanucPosition> frames, tools;       ///< UFRAME[n], UTOOL[n] of group 1
  std::optional<int> frame_number, tool_number;
  std::map<std::string, std::string> macros;  ///< macro name -> program name, both in lower case
  bool offsets_are_frames = false;            ///< $OFFSET_CART; FALSE by default on controllers
};

/// Adds the known variables of a variable file to `into`. Other variables are ignored.
void read_fanuc_variables(const SourceFile& file, FanucVariables& into);

/// Returns the files that `listing` needs from its folder: the variable files above, and the listings that it calls,
/// directly or indirectly. The case of names is ignored. `listing` itself is not included.
std::vector<std::filesystem::path> fanuc_files_beside(const std::filesystem::path& listing);

/// The files of a backup folder.
struct FanucFolder {
  std::vector<std::filesystem::path> listings;   ///< readable programs, in the order of their names
  std::vector<std::filesystem::path> variables;  ///< the .va files above
  CallGraph calls;                               ///< of the listings
};

/// Returns the files of `folder`. Empty listings: not a Fanuc backup. Logs (.ls files without /PROG) are left out.
FanucFolder fanuc_folder(const std::filesystem::path& folder);

/// Returns the Fanuc programs among `files` of `folder`. routine: the requested program; empty: no request.
/// Errors: throws InputError, with the choices if there are several programs.
Backup fanuc_backup(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files,
                    const std::string& routine);

}  // namespace dresslife::sim
