// Data of one job's life file, and its charts. Each chart is inline SVG in the classes of report.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dresslife::pipeline {

/// One cycle of the worst wire.
struct WorstCycle {
  double range = 0, count = 0, damage = 0;
};

/// The part of a life file that charts need; the sizes do not depend on the number of wires.
struct LifeSummary {
  std::vector<double> time;            ///< (sample) [s]
  std::vector<double> strain;          ///< (sample) strain of the worst wire, see known_history.h
  std::string strain_of;               ///< name of that wire
  std::vector<double> damage_rate;     ///< (sample) damage rate of the worst segment; empty: no wire was evaluated
  std::vector<std::int32_t> step;      ///< (sample) program line, -1: none
  std::vector<std::string> step_text;  ///< (line)
  std::vector<double> step_damage;     ///< (line) damage of the worst wire per repeat, by the line that closes a cycle
  std::vector<double> step_opened;     ///< (line) the same damage by the line that opens the cycle; empty: not known
  std::vector<std::string> dresspack;  ///< names of the dresspacks; {""}: only one
  std::vector<double> dresspack_damage;   ///< (dresspack) damage of its worst wire per repeat; empty: not known
  std::vector<double> segment_length;     ///< (segment of the worst dresspack) length, from the base [m]
  std::vector<double> segment_damage;     ///< (segment of the worst dresspack) damage of its worst wire per repeat
  std::vector<std::string> layer;         ///< (layer) path of a layer of wires
  std::vector<double> layer_damage;       ///< (layer) damage of its worst wire per repeat
  std::vector<WorstCycle> cycles;         ///< cycles of the worst wire
  std::vector<std::string> cause;         ///< names of the joints, then `carrying`; empty: not known
  std::vector<double> cause_damage;       ///< (cause) damage of the worst wire
  std::vector<double> line_cause_damage;  ///< (line, cause) damage of its cycles that close in the line
  double explained = 0;                   ///< share of the variance of its strain that the joints explain
  std::vector<std::string> clamps;        ///< clamps of the worst dresspack; empty: not known
  std::vector<double> clamp_damage;       ///< (clamp) damage of the segments near the clamp
  std::string job, history;
};

/// Reads a life file. strain_file: file of the same job, for a complete history; may be missing. Errors: InputError when a file
/// cannot be read.
LifeSummary read_life(const std::filesystem::path& life_file, const std::filesystem::path& strain_file = {});

/// A stretch of time in which one program line runs.
struct ProgramRun {
  std::int32_t step;
  double begin, end;  ///< [s]
  double damage = 0;  ///< damage of the worst segment by cycles that close in this stretch
};
std::vector<ProgramRun> program_runs(const LifeSummary& life);

/// The number of runs of a line, and its run in which most damage is completed.
struct LineRuns {
  std::size_t times = 0;
  const ProgramRun* costliest = nullptr;
};
LineRuns runs_of(std::size_t line, const std::vector<ProgramRun>& runs);

/// Returns a chart of the strain of the worst wire over time, the program below it, and the sum of the damage. The most damaging
/// program lines are named above.
std::string strain_chart(const LifeSummary& life);

/// Returns a chart of damage per repeat along the worst dresspack, base to tool; worst_from_tool is marked, 0: none.
std::string segment_chart(const LifeSummary& life, int worst_from_tool);

/// Returns the share of the length on which the damage is at least 0.8 of the largest. Near 1 the worst segment has no meaning.
double nearly_worst_share(const LifeSummary& life);

/// Returns a chart of number and damage of the worst wire's cycles per repeat over their strain range.
std::string cycle_chart(const LifeSummary& life);

}  // namespace dresslife::pipeline
