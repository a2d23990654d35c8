// A job from the pieces of other jobs. Jobs of a study mostly combine a few robots, motions, routings and dresspacks. A job from known
// pieces takes a small part of the time of a whole reading.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/echo_text.h"

namespace dresslife::pipeline {

/// The keys of one piece do not affect another piece, except that a routing depends on its robot. rest: all other keys, and
/// simulation.stiffness_factor, which a calibration sets.
enum class Piece : std::size_t { motion, robot, routing, simulation, rest };
inline constexpr std::size_t piece_count = 5;
constexpr std::size_t index_of(Piece piece) { return static_cast<std::size_t>(piece); }

/// (Piece) number of the piece. Two jobs with one number have the same piece, in the whole program. 0: not known.
using PieceNumbers = std::array<std::size_t, piece_count>;

/// Returns the piece of a key; std::nullopt: the key belongs to several pieces.
std::optional<Piece> piece_of(std::string_view path);

/// Returns whether a job can be divided into pieces: a robot moves one dresspack, and no calibration depends on the motion.
bool has_pieces(const Job& job);

/// A job, or the jobs from whose pieces it is made when it is used for the first time. Like a shared pointer: copies have one job.
/// Ten thousand jobs of a study need the memory of the few jobs that lend pieces.
class SharedJob {
 public:
  using Lenders = std::array<std::shared_ptr<const Job>, piece_count>;  ///< (Piece)

  SharedJob(std::nullptr_t = nullptr) {}
  SharedJob(std::shared_ptr<const Job> whole, const PieceNumbers& numbers = {});
  /// Precondition: pieces_fit().
  SharedJob(const Lenders& lenders, const PieceNumbers& numbers);

  const Job* get() const;
  const Job& operator*() const { return *get(); }
  const Job* operator->() const { return get(); }
  operator std::shared_ptr<const Job>() const;
  explicit operator bool() const { return state_ != nullptr; }
  bool operator==(const SharedJob&) const = default;

  /// Returns a job with this piece, without making the whole job. Precondition: it is not null.
  const Job& with(Piece piece) const;
  PieceNumbers numbers() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

/// Returns whether the pieces of these jobs make a valid job. Preconditions: those of job_from_pieces().
bool pieces_fit(const SharedJob::Lenders& lenders);

/// Returns the job from the pieces of these jobs, (Piece). routing: a tree with only the key `routing`, which replaces that piece; null:
/// none. std::nullopt: the pieces do not fit to each other; then job_from() reads the whole job and reports why. Precondition:
/// job_from() returned the jobs, they have pieces, and their other pieces come from the same base.
std::optional<Job> job_from_pieces(const std::array<const Job*, piece_count>& pieces, const Node* routing);

/// Texts of jobs, kept by the numbers of their pieces. The functions return what those of job_text.h return. Precondition: no
/// job is null.
class PieceTexts {
 public:
  /// around: folder that contains the folders of the jobs, for stored_job_text().
  explicit PieceTexts(std::filesystem::path around = {}) : around_(std::move(around)) {}

  std::string part_text(const SharedJob& job, JobPart part);
  /// name: of the job's folder.
  std::string stored_job_text(const SharedJob& job, const std::string& name);
  std::vector<std::filesystem::path> files_beside(const SharedJob& job);

 private:
  struct Section;
  using Sections = std::vector<Section>;
  static const Sections of_sim, of_job, whole;

  /// Returns the text from its kept sections and those that `make` returns, without the groups with these keys.
  /// std::nullopt: the job has no pieces, or `make` returned nothing, because other jobs have another text.
  std::optional<std::string> text_of(const SharedJob& job, const Sections& sections, std::size_t text,
                                     const std::function<std::optional<EchoSections>(const EchoKeys&)>& make);

  /// (index of the section in a text, numbers of the pieces on which it depends)
  std::map<std::pair<std::size_t, PieceNumbers>, std::string> sections_;
  std::size_t kept_ = 0;  ///< bytes in `sections_`
  std::map<PieceNumbers, std::vector<std::filesystem::path>> files_;
  std::filesystem::path around_;
};

}  // namespace dresslife::pipeline
