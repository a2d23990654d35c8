#include "pipeline/resolve/pieces.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <mutex>
#include <stdexcept>

#include "pipeline/base/plain_file.h"
#include "pipeline/job/job_forms.h"
#include "pipeline/resolve/check_job.h"
#include "pipeline/resolve/plausible_job.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// Returns the numbers of these pieces; the others are 0.
PieceNumbers only(const std::vector<Piece>& pieces, const PieceNumbers& numbers) {
  PieceNumbers some{};
  for (const Piece piece : pieces) some[index_of(piece)] = numbers[index_of(piece)];
  return some;
}

/// Returns the numbers for `simulation`: of all keys of the rest, it has only one.
PieceNumbers of_simulation(const SharedJob& job, const PieceNumbers& numbers) {
  PieceNumbers some = only({Piece::simulation}, numbers);
  some[index_of(Piece::rest)] = std::bit_cast<std::uint64_t>(job.with(Piece::rest).simulation.stiffness_factor);
  return some;
}

}  // namespace

std::optional<Piece> piece_of(std::string_view path) {
  const std::string_view section = path.substr(0, path.find('.'));
  if (section == "motion") return Piece::motion;
  if (section == "robot") return Piece::robot;
  if (section == "routing") return Piece::routing;
  if (path == "simulation" || section == "dresspacks") return std::nullopt;
  const auto is_learned = [&](const UncertainParameter& parameter) { return parameter.key == path; };
  return section == "simulation" && std::ranges::none_of(uncertain_parameters(), is_learned) ? Piece::simulation
                                                                                             : Piece::rest;
}

bool has_pieces(const Job& job) {
  const std::optional<Calibration>& learned = job.calibration;
  return forms_of(job).one && job.motion.needs_robot() && !job.robot.joints.empty() &&
         (!learned || (learned->typical && learned->own_spread == 1 && learned->residual_spread == 1));
}

std::optional<Job> job_from_pieces(const std::array<const Job*, piece_count>& pieces, const Node* routing) {
  const auto of = [&](Piece piece) -> const Job& { return *pieces[index_of(piece)]; };
  Job job = of(Piece::rest);
  Routing& own = job.dresspacks.front().routing;
  job.motion =
      Motion(of(Piece::motion).motion);  // a copy of its own, because an assignment keeps memory that it does not need
  job.robot = Robot(of(Piece::robot).robot);
  job.simulation = of(Piece::simulation).simulation;
  job.simulation.stiffness_factor = of(Piece::rest).simulation.stiffness_factor;
  own = routing ? Routing{} : of(Piece::routing).dresspacks.front().routing;
  try {
    if (routing) {
      read_fields(*routing, own);
      place_clamps(own, job.robot);
    }
    check_between_pieces(job.motion, job.robot, own, job);
    job.motion.left_out = plausibility_of_motion(job);
  } catch (const InputError&) {  // job_from() finds the same problem and places it in the whole document
    return std::nullopt;
  }
  return job;
}

struct SharedJob::State {
  std::shared_ptr<const Job> whole;  ///< null: not made yet
  Lenders lenders;
  PieceNumbers numbers;
  std::once_flag made;
};

SharedJob::SharedJob(std::shared_ptr<const Job> whole, const PieceNumbers& numbers) {
  if (!whole) return;
  state_ = std::make_shared<State>();
  state_->whole = std::move(whole), state_->numbers = numbers;
}

SharedJob::SharedJob(const Lenders& lenders, const PieceNumbers& numbers) : state_(std::make_shared<State>()) {
  state_->lenders = lenders, state_->numbers = numbers;
}

const Job* SharedJob::get() const {
  if (!state_) return nullptr;
  std::call_once(state_->made, [&] {
    if (state_->whole) return;
    std::array<const Job*, piece_count> pieces;
    std::ranges::transform(state_->lenders, pieces.begin(), [](const auto& lender) { return lender.get(); });
    std::optional<Job> job = job_from_pieces(pieces, nullptr);
    if (!job) throw std::logic_error("pieces of a job do not fit, and did before");
    state_->whole = std::make_shared<const Job>(*std::move(job));
  });
  return state_->whole.get();
}

SharedJob::operator std::shared_ptr<const Job>() const {
  get();
  return state_ ? state_->whole : nullptr;
}

const Job& SharedJob::with(Piece piece) const {
  const std::shared_ptr<const Job>& lender = state_->lenders[index_of(piece)];
  return lender ? *lender : *get();
}

PieceNumbers SharedJob::numbers() const { return state_ ? state_->numbers : PieceNumbers{}; }

bool pieces_fit(const SharedJob::Lenders& lenders) {
  const auto of = [&](Piece piece) -> const Job& { return *lenders[index_of(piece)]; };
  try {
    check_between_pieces(of(Piece::motion).motion, of(Piece::robot).robot,
                         of(Piece::routing).dresspacks.front().routing, of(Piece::rest));
  } catch (const InputError&) {  // job_from() finds the same problem and places it in the whole document
    return false;
  }
  return true;
}

/// A top-level key of a text, and the pieces on which its value depends; without pieces: of_simulation(). An empty key: all keys.
struct PieceTexts::Section {
  std::string_view key;
  std::vector<Piece> pieces;

  PieceNumbers numbers(const SharedJob& job, const PieceNumbers& all) const {
    return pieces.empty() ? of_simulation(job, all) : only(pieces, all);
  }
};

// In the order of the texts.
const PieceTexts::Sections PieceTexts::of_sim{{"motion", {Piece::motion}},
                                              {"robot", {Piece::robot}},
                                              {"dresspack", {Piece::rest}},
                                              {"routing", {Piece::routing}},
                                              {"cell", {Piece::rest}},
                                              {"simulation", {}},
                                              {"bend_radius_by_rule_mm", {Piece::rest}},
                                              {"other_stiffness", {Piece::rest}}};
const PieceTexts::Sections PieceTexts::of_job{
    {"motion", {Piece::motion}},    {"robot", {Piece::robot}},     {"dresspack", {Piece::rest}},
    {"routing", {Piece::routing}},  {"cell", {Piece::rest}},       {"simulation", {}},
    {"strain", {Piece::rest}},      {"fatigue", {Piece::rest}},    {"inspection", {Piece::rest}},
    {"uncertainty", {Piece::rest}}, {"calibration", {Piece::rest}}};
const PieceTexts::Sections PieceTexts::whole{{"", {Piece::rest}}};

std::optional<std::string> PieceTexts::text_of(
    const SharedJob& job, const Sections& sections, std::size_t text,
    const std::function<std::optional<EchoSections>(const EchoKeys&)>& make) {
  constexpr std::size_t most_kept = 32 << 20;  // bytes; a robot with a long program has 0.1 MB
  const PieceNumbers numbers = job.numbers();
  if (numbers == PieceNumbers{}) return std::nullopt;
  if (kept_ > most_kept) sections_.clear(), kept_ = 0;
  const auto place = [&](std::size_t k) { return std::pair(text + k, sections[k].numbers(job, numbers)); };
  EchoKeys known;
  for (std::size_t k = 0; k < sections.size(); ++k)
    if (sections_.contains(place(k))) known.emplace(sections[k].key);
  std::optional<EchoSections> made{std::in_place};
  if (known.size() < sections.size()) made = make(known);
  if (!made) return std::nullopt;
  std::string joined;
  for (std::size_t k = 0; k < sections.size(); ++k) {
    const auto [kept, is_new] = sections_.try_emplace(place(k));
    for (const auto& [key, words] : *made)
      if (is_new && (sections[k].key.empty() || sections[k].key == key)) kept->second += words;
    if (is_new) kept_ += kept->second.size();
    joined += kept->second;
  }
  return joined;
}

std::string PieceTexts::part_text(const SharedJob& job, JobPart part) {
  const std::optional<std::string> text =
      text_of(job, part == JobPart::sim ? of_sim : whole, 100 * static_cast<std::size_t>(part),
              [&](const EchoKeys& known) { return part_sections(*job, part, known); });
  return text ? *text : pipeline::part_text(*job, part);
}

std::string PieceTexts::stored_job_text(const SharedJob& job, const std::string& name) {
  const fs::path folder = around_ / name;
  const auto make = [&](const EchoKeys& known) -> std::optional<EchoSections> {
    bool same_for_others = true;  // the text is the same in every folder beside this one
    const auto seen = [&](const fs::path& file) {
      fs::path from_folder = as_seen_from(folder, file);
      same_for_others = same_for_others && from_folder.native().starts_with("../../");
      return from_folder.string();
    };
    EchoSections made = echo_sections(Describe([copy = *job](Fields& f) mutable { describe(f, copy); }), seen, known);
    return same_for_others ? std::optional(std::move(made)) : std::nullopt;
  };
  std::optional<std::string> text;
  if (kind_of_name(folder) != FileKind::link) text = text_of(job, of_job, 1000, make);
  return text ? *text : pipeline::stored_job_text(*job, folder);
}

std::vector<fs::path> PieceTexts::files_beside(const SharedJob& job) {
  const PieceNumbers numbers = job.numbers();
  if (numbers == PieceNumbers{}) return pipeline::files_beside(*job);
  const auto [known, is_new] = files_.try_emplace(only({Piece::motion, Piece::robot, Piece::rest}, numbers));
  if (is_new) known->second = pipeline::files_beside(*job);
  return known->second;
}

}  // namespace dresslife::pipeline
