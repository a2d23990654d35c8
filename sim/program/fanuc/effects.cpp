#include "sim/program/fanuc/effects.h"

#include <algorithm>

#include "sim/program/fanuc/values.h"
#include "sim/program/interpreter/tokens.h"

namespace dresslife::sim {
namespace {

const std::string any_register = "r[]";

/// Returns the offset of the first comma outside brackets, parentheses and quotes; npos: none. Controllers accept a ')' too
/// many: IF (DI[1]=ON)),JMP LBL[1].
std::size_t top_comma(std::string_view text) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\'') quoted = !quoted;
    if (quoted) continue;
    if (text[i] == '[' || text[i] == '(') ++depth;
    if ((text[i] == ']' || text[i] == ')') && depth > 0) --depth;
    if (text[i] == ',' && depth == 0) return i;
  }
  return std::string_view::npos;
}

/// Returns the offset of the ')' that closes the '(' before `from`; text.size(): none.
std::size_t closing(std::string_view text, std::size_t from) {
  int depth = 1;
  for (std::size_t i = from; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')' && --depth == 0) return i;
  }
  return text.size();
}

std::optional<int> constant_index(FanucCursor& at) {
  if (!at.take_sign('[')) return {};
  FanucCursor group = at;
  if (const std::string word = group.word(); word.starts_with("gp") && group.take_sign(':')) at = group;
  const auto number = at.number();
  at.skip_blanks();
  const bool plain = number && !at.rest().empty() && std::string_view("]:,").find(at.rest()[0]) < 3;
  at.skip_to(']');
  return plain ? std::optional(whole_number(*number)) : std::nullopt;
}

}  // namespace

void FanucEffects::add(const FanucEffects& other) {
  moves |= other.moves;
  waits |= other.waits;
  leaves |= other.leaves;
  written.insert(other.written.begin(), other.written.end());
  unread.insert(other.unread.begin(), other.unread.end());
}

std::string fanuc_action(const std::string& statement) {
  FanucCursor at(statement);
  const bool again = at.take_sign('=');
  const std::string word = again ? "" : at.word();
  if (!again && word != "if" && word != "select" && word != "else") return statement;
  std::size_t comma = top_comma(statement);
  if (word == "if" && at.take_sign('(')) {  // IF (condition)action; the comma is optional
    const std::size_t close = closing(statement, at.offset());
    FanucCursor behind(statement);
    behind.move_to(std::min(close + 1, statement.size()));
    FanucCursor next = behind;
    const std::string first = next.word();
    if (!first.empty() && first != "and" && first != "or" && first != "div" && first != "mod") comma = close;
  }
  if (comma == std::string::npos) return "";
  const std::size_t begin = statement.find_first_not_of(" \t\r\n:", comma + 1);
  return begin == std::string::npos ? "" : statement.substr(begin);
}

std::string macro_name(const std::string& statement) {
  return "MACRO " + statement.substr(0, std::min<std::size_t>(statement.find_first_of("('="), 40));
}

FanucWord fanuc_word(const std::string& word) {
  static const pipeline::WordSet logic = pipeline::word_set(
      "do di ro ri go gi ao ai so si uo ui wo wi f m timer ualm message pause payload lock unlock skip tc_online "
      "monitor rsr sr str print remark lbl col rec prompt diag error_prog resume_prog return_path_dsbl maint_prog "
      "clear_resume_prog ps user $waittmout arc weld tool stopwatch log sensor_on sensor_off stop fault gun backup "
      "monit. monend pi dcs collision end_monitor vr cstop");
  static const pipeline::WordSet shaping = pipeline::word_set(
      "weave track touch search softfloat force multi stitch torq_limit linear_max_speed joint_max_speed tracking "
      "mpofs singularity pal_end vision voffset coord indev press_motn");
  if (word == "j" || word == "l" || word == "c" || word == "a" || word == "s") return FanucWord::motion;
  if (logic.contains(word) || word.starts_with("$")) return FanucWord::logic;
  return shaping.contains(word) ? FanucWord::shapes_motion : FanucWord::other;
}

FanucSetting fanuc_setting(const std::string& statement) {
  const std::string left = plain_fanuc_name(std::string_view(statement).substr(0, statement.find('=')));
  if (left == "$mcr.$genoverride") return {"override"};
  if (left == "$prgoverride") return {left};
  for (const auto& [list, name] : {std::pair("$mnuframe[1,", "uframe"), std::pair("$mnutool[1,", "utool")}) {
    if (!left.starts_with(list)) continue;
    FanucCursor at(std::string_view(left).substr(std::string_view(list).size()));
    const auto number = at.number();
    if (!number) return {fmt::format("{}[]", name)};
    FanucSetting setting{fmt::format("{}[{}]", name, *number), static_cast<int>(*number)};
    std::string_view field = std::string_view(left).substr(left.find(']') + 1);
    if (field.starts_with(".")) field.remove_prefix(1);
    if (field.starts_with("$")) field.remove_prefix(1);
    if (field.size() == 1) setting.component = static_cast<int>(std::string_view("xyzwpr").find(field[0])) + 1;
    return setting;
  }
  return {};
}

FanucOutlook::FanucOutlook(const std::vector<FanucListing>& listings, const std::map<std::string, std::string>& macros)
    : listings_(listings), macros_(macros) {
  for (const FanucListing& listing : listings_) by_name_.try_emplace(listing.name, &listing);
}

const FanucListing* FanucOutlook::program(const std::string& name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : found->second;
}

const FanucListing* FanucOutlook::macro(const std::string& statement) const {
  std::string name = lower_case(statement.substr(0, statement.find('(')));
  while (!name.empty() && name.back() == ' ') name.pop_back();
  const auto found = macros_.find(name);
  return found == macros_.end() ? nullptr : program(found->second);
}

const FanucEffects& FanucOutlook::whole(const FanucListing& listing) {
  if (const auto found = known_.find(&listing); found != known_.end()) return found->second;
  FanucEffects& made = known_[&listing];
  made.moves = true;  // assumption for recursive calls, replaced below
  made.written = {any_register};
  FanucEffects read = effects(listing, 0, listing.statements.size());
  read.leaves = false;
  return known_[&listing] = read;
}

FanucEffects FanucOutlook::effects(const std::string& action) {
  FanucEffects made;
  FanucCursor at(action);
  const std::string word = at.word();
  if (word == "if" || word == "select" || word == "else" || word.empty()) {
    const std::string behind = fanuc_action(action);
    return behind == action ? made : effects(behind);
  }
  const std::string text = lower_case(action);
  if (fanuc_word(word) == FanucWord::motion && (at.take("P") || at.take("PR"))) {
    made.moves = true;
    if (text.find("lpos") != std::string::npos) made.written.insert(any_register);
  } else if (word == "wait") {
    const auto time = at.number();
    made.waits = time.value_or(0) > 0;
  } else if (word == "spot") {
    made.waits = true;
  } else if (word == "r" || word == "pr" || word == "uframe" || word == "utool") {
    const auto index = constant_index(at);
    made.written.insert(index ? fmt::format("{}[{}]", word, *index) : word.ends_with("r") ? any_register : word + "[]");
  } else if (word == "for") {
    at.word();
    if (const auto index = constant_index(at)) made.written.insert(fmt::format("r[{}]", *index));
  } else if (word == "override" || word == "uframe_num" || word == "utool_num") {
    made.written.insert(word);
  } else if (const FanucSetting setting = fanuc_setting(action); !setting.name.empty()) {
    made.written.insert(setting.name);
  } else if (word == "call") {
    const std::string name(at.name());
    if (const FanucListing* called = program(lower_case(name)))
      made.add(whole(*called));
    else
      made.written.insert(any_register), made.unread.insert("CALL " + name);
  } else if (const FanucListing* called = macro(action)) {
    made.add(whole(*called));
  } else if (fanuc_word(word) == FanucWord::other && word != "run" && word != "jmp" && word != "end" &&
             word != "endif" && word != "endfor" && word != "abort") {
    made.written.insert(any_register);  // a macro without a listing
    made.unread.insert(macro_name(action));
  }
  return made;
}

namespace {

/// Returns whether a statement can leave from .. to: by a jump, by ABORT, or by END if `to` is not the listing's end.
bool jumps_out(const FanucListing& listing, const std::string& text, std::size_t from, std::size_t to) {
  const std::string action = fanuc_action(text);
  FanucCursor at(action);
  const std::string word = at.word();
  if (word == "abort") return true;
  if (word == "end") return to < listing.statements.size();
  if (word != "jmp" || !at.take("LBL")) return false;
  const auto label = constant_index(at);
  const auto target = label ? listing.labels.find(*label) : listing.labels.end();
  return target == listing.labels.end() || target->second < from || target->second > to;
}

}  // namespace

bool FanucOutlook::leads_out(const FanucListing& listing, std::size_t decision, std::size_t from,
                             std::size_t to) const {
  const auto& statements = listing.statements;
  std::size_t end = decision + 1;
  if (lower_case(statements[decision].text).ends_with("then")) end = statements[decision].end;
  if (lower_case(statements[decision].text).starts_with("select"))
    while (end < statements.size() &&
           (statements[end].text.starts_with("=") || statements[end].text.starts_with("ELSE")))
      ++end;
  for (std::size_t i = decision; i < std::min(end, statements.size()); ++i)
    if (jumps_out(listing, statements[i].text, from, to)) return true;
  return false;
}

FanucEffects FanucOutlook::effects(const FanucListing& listing, std::size_t from, std::size_t to) {
  FanucEffects made;
  for (std::size_t i = from; i < std::min(to, listing.statements.size()); ++i) {
    made.add(effects(listing.statements[i].text));
    made.leaves |= jumps_out(listing, listing.statements[i].text, from, to);
  }
  return made;
}

}  // namespace dresslife::sim
