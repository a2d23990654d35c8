#include <algorithm>
#include <cmath>
#include <set>

#include "pipeline/base/constants.h"
#include "sim/program/fanuc/run.h"
#include "sim/program/interpreter/job_words.h"
#include "sim/program/interpreter/tokens.h"

namespace dresslife::sim {
namespace {

constexpr const char* some_pose = "X ... Y ... Z ... W ... P ... R ...";
constexpr const char* position_form =
    "X .. Y .. Z .. W .. P .. R .. in mm and deg, or J1 .. J2 .. J3 .. J4 .. J5 .. J6 ..";

bool nothing(const FanucPosition& offset) {
  return std::ranges::all_of(offset.values, [](double v) { return v == 0; });
}

}  // namespace

Frame frame_of_fanuc(const std::vector<double>& n) {  // W, P, R turn about the fixed axes x, y, z
  return {millimetre * Vector3(n[0], n[1], n[2]),
          rotation({0, 0, n[5] * degree}) * rotation({0, n[4] * degree, 0}) * rotation({n[3] * degree, 0, 0})};
}

std::vector<double> fanuc_values_of(const Frame& frame) {
  const Eigen::Matrix3d r = frame.orientation.toRotationMatrix();
  const double yaw = std::atan2(r(1, 0), r(0, 0)), c = std::cos(yaw), s = std::sin(yaw);
  // W (roll) is computed after R (yaw) is taken out, so that the sum of R and W is exact at P = +-90 deg.
  const double pitch = std::atan2(-r(2, 0), c * r(0, 0) + s * r(1, 0)),
               roll = std::atan2(s * r(0, 2) - c * r(1, 2), c * r(1, 1) - s * r(0, 1));
  const Vector3 p = frame.position / millimetre;
  return {p.x(), p.y(), p.z(), roll / degree, pitch / degree, yaw / degree};
}

// ---- positions -------------------------------------------------------------------------------------------

/// Reads P[3:name] or PR[4]. Takes nothing from another text.
FanucRun::WrittenPosition FanucRun::position(FanucCursor& at) {
  WrittenPosition read{at.take("PR"), {}, {}};
  if (!read.registered && !at.take("P")) return read;
  const auto index = values_.index(at);
  if (!index || !index->number) return read;
  read.number = whole_number(*index->number);
  const auto& list = routine().listing->positions;
  if (index->group != 1) return read;
  if (read.registered) values_.read_positions();
  if (read.registered)
    read.position = values_.position_register(*read.number);
  else if (const auto found = list.find(*read.number); found != list.end())
    read.position = found->second;
  return read;
}

/// Warns if a program that was not read may have written the PR[n] of the backup.
void FanucRun::doubt(int number) {
  if (values_.doubtful(number))
    note(fmt::format("PR[{}] is taken from the backup; a program that was not read may have written it since", number),
         true);
}

/// Reads the P[n] or PR[n] of a move. Reports a problem if its values are unknown.
std::optional<FanucPosition> FanucRun::target_position(FanucCursor& at) {
  at.skip_blanks();
  const std::size_t begin = at.offset();
  values_.forget_missing();
  const auto [registered, number, listed] = position(at);
  if (at.offset() == begin) {
    complain("moves to no P[n] or PR[n]", "palletizing and other positions are not read; list them as P[n]");
    return {};
  }
  if (!number) {
    if (values_.missing().empty())
      complain("moves to a position without a number", "teach it");
    else
      missing_value("moves to a position by");
    return {};
  }
  const std::string name = fmt::format("{}[{}]", registered ? "PR" : "P", *number);
  auto read = listed;
  const std::string own_name = fmt::format("{}:{}", routine().listing->name, name);
  if (!registered && (!read || (!read->known() && read->form != FanucPosition::Form::other_groups)))
    if (const auto given = values_.given_position(own_name)) read = given;
  if (registered) doubt(*number);
  if (read && read->known() && read->form == FanucPosition::Form::unknown) {
    complain(fmt::format("moves to {}, and its numbers can be a pose or joint angles", name),
             fmt::format("give {} or value: 'J1 ... J2 ...'", values_of_job({name}, some_pose)));
    return {};
  }
  if (read && (read->known() || read->form == FanucPosition::Form::other_groups)) return read;
  if (registered) {
    missing_position(*number, "moves to");
    return {};
  }
  missing(fmt::format("{} of {}", name, routine().listing->name),
          fmt::format("moves to {}, which is not {}", name, read ? "taught" : "listed"),
          fmt::format("{}, or give {}",
                      read ? "list the program again behind teaching it" : "list the program with its positions (/POS)",
                      values_of_job({own_name}, some_pose)),
          {{Question::Kind::value, own_name, position_form}});
  return {};
}

/// Asks for the values that make a position register unknown.
void FanucRun::missing_position(int number, const char* what) {
  const std::string name = fmt::format("PR[{}]", number);
  values_.forget_missing();
  values_.miss_position(number);
  const FanucCauses& causes = values_.causes();
  if (causes.size() != 1 || causes[0].name != name)
    return missing_value(fmt::format("{} {}, which depends on", what, name));
  missing(name, fmt::format("{} {}, which is known only while the robot runs", what, name),
          fmt::format("give posreg.va of the backup ({}), or {}", modules_of_job, values_of_job({name}, some_pose)),
          {{Question::Kind::value, name, position_form}});
}

/// Replaces a negative `number` by that of the active frame; it stays -1 if the user gives the active frame itself.
/// Returns false, with a question, if the active frame is unknown.
bool FanucRun::active(bool tool, int& number) {
  if (number >= 0) return true;
  values_.forget_missing();
  if (const FanucNumber known = values_.named(tool ? "utool_num" : "uframe_num")) {
    number = whole_number(*known);
    return true;
  }
  const std::string written = tool ? "UTOOL_NUM" : "UFRAME_NUM", list = tool ? "UTOOL" : "UFRAME";
  if (given_frame(tool, list)) return true;
  const bool by_number = !(tool ? around_.variables.tools : around_.variables.frames).empty();
  const Question by_its_number{Question::Kind::value, written, "a number"},
      frame{tool ? Question::Kind::tool : Question::Kind::work_object, list, ""};
  missing(written,
          fmt::format("moves in the active {}, and no line chooses it ({})", tool ? "tool" : "user frame", written),
          fmt::format("give it with {}, its frame in motion.{} with the name '{}', or sysframe.va of the backup",
                      values_of_job({written}, "1"), tool ? "tools" : "work_objects", list),
          {by_number ? by_its_number : frame});
  return false;
}

/// Returns the user's frame of this name; null: none.
const NamedFrame* FanucRun::given_frame(bool tool, const std::string& name) const {
  const auto& given = tool ? around_.tools : around_.work_objects;
  const auto found = std::ranges::find_if(given, [&](const NamedFrame& frame) { return same_word(frame.name, name); });
  return found == given.end() ? nullptr : &*found;
}

/// Warns if the active frame differs from the listed frame of a P[n]: a controller would stop at this move. If no frame
/// is active yet, `listed` becomes the active one.
void FanucRun::compare_active(bool tool, int listed) {
  const std::string name = tool ? "utool_num" : "uframe_num";
  if (!values_.has_named(name)) return values_.set_named(name, listed);
  const int number = whole_number(*values_.named(name));
  if (number == listed) return;
  note(fmt::format("{} {} {} and {} is active (the controller stops here; read as taught)", other_frame,
                   tool ? "tool" : "user frame", listed, number),
       true);
}

/// Returns UFRAME[n] or UTOOL[n]: the value that the program assigned, else that of the user, else that of the backup.
/// n = 0: the world or the flange. n < 0: the user's active frame. The causes of an unknown assigned value are questions.
std::optional<NamedFrame> FanucRun::frame(bool tool, int number) {
  const std::string list = tool ? "UTOOL" : "UFRAME";
  NamedFrame made{fmt::format("{}[{}]", list, number), {}, false};
  if (number == 0) return made;
  if (number < 0) return *given_frame(tool, list);  // the active frame, see active()
  auto own = frames_.find({tool, number});
  if (own == frames_.end()) own = frames_.find({tool, any_frame});
  if (own != frames_.end()) {
    if (own->second.frame) {
      made.frame = *own->second.frame;
      return made;
    }
    // The user's frame is not used here: it is the value before the assignment.
    if (!own->second.why.empty()) {
      values_.forget_missing();
      values_.miss(own->second.why);
      missing_value(fmt::format("uses {}, which depends on", made.name));
      return {};
    }
  }
  if (const NamedFrame* given = given_frame(tool, made.name)) return *given;
  const auto& backup = tool ? around_.variables.tools : around_.variables.frames;
  if (const auto found = backup.find(number); found != backup.end() && found->second.known() && own == frames_.end()) {
    made.frame = frame_of_fanuc(found->second.values);
    return made;
  }
  missing(made.name, fmt::format("uses {}, which lies in the controller", made.name),
          fmt::format("give it in motion.{} with the name '{}': [{{name: '{}', position_mm: [X, Y, Z], "
                      "wpr_deg: [W, P, R]}}], or sysframe.va of the backup",
                      tool ? "tools" : "work_objects", made.name, made.name),
          {{tool ? Question::Kind::tool : Question::Kind::work_object, made.name, ""}});
  return {};
}

/// Adds a frame to the program's tools or work objects, unless the list has it, and stores its index in the move.
void FanucRun::use(const NamedFrame& wanted, bool as_tool, Instruction& move) {
  NamedFrame frame = wanted;
  auto& list = as_tool ? program_.tools : program_.work_objects;
  int& index = as_tool ? move.tool : move.work_object;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].name.starts_with(wanted.name) && list[i].stationary == frame.stationary &&
        list[i].frame.position == frame.frame.position &&
        list[i].frame.orientation.coeffs() == frame.frame.orientation.coeffs())
      index = static_cast<int>(i);
  if (index >= 0) return;
  for (int variant = 2; std::ranges::any_of(list, [&](const NamedFrame& f) { return f.name == frame.name; }); ++variant)
    frame.name = fmt::format("{} ({})", wanted.name, variant);
  list.push_back(frame);
  index = static_cast<int>(list.size()) - 1;
  charge(static_cast<long>(list.size()));
}

/// Returns user frame and tool of a Cartesian position and completes their numbers in `p`. Unknown ones are asked for in
/// one round.
std::optional<std::pair<NamedFrame, NamedFrame>> FanucRun::frames_of(FanucPosition& p) {
  if (p.frame >= 0) compare_active(false, p.frame);
  if (p.tool >= 0) compare_active(true, p.tool);
  const bool in_frame = active(false, p.frame), with_tool = active(true, p.tool);
  const auto object = in_frame ? frame(false, p.frame) : std::nullopt;
  const auto tool = with_tool ? frame(true, p.tool) : std::nullopt;
  if (!object || !tool) return {};
  return std::pair(*object, *tool);
}

/// Returns $OFFSET_CART (SYSTEM.VA of the backup, or --value). TRUE: an offset is a frame on the left of the position.
/// FALSE: the numbers of the offset are added to those of the position. A camera's offset is always a frame.
bool FanucRun::offsets_are_frames() const {
  const auto given = values_.given("$offset_cart");
  return given ? same_word(*given, "true") : around_.variables.offsets_are_frames;
}

/// Computes pose and frames of a move to a Cartesian position. P is the pose of UT in UF; a remote position gives its
/// inverse. flange = UF P UT^-1. With offsets: UF OFFSET P TOOL_OFFSET UT^-1. An OFFSET that is not a frame is added to the
/// numbers of P. In a remote move (RTCP) UF is the tool, fixed in the world, the robot carries UT, and the pose of the tool
/// in UT is P^-1. Source: FANUC, teach pendant instructions, motion options Offset,PR[x] and Tool_Offset,PR[x].
bool FanucRun::place(const FanucPosition& position, const Options& options, Instruction& move, Frame& pose) {
  FanucPosition p = position;
  const auto frames = frames_of(p);
  if (!frames) return false;
  const auto& [object, tool] = *frames;
  const auto counts = [](const auto& offset) { return offset && !nothing(*offset); };
  const bool as_frame = options.camera || offsets_are_frames();
  for (const auto* offset : {&options.offset, &options.tool_offset}) {
    if (!counts(*offset)) continue;
    const bool joints = (*offset)->form != FanucPosition::Form::pose;
    if (joints || (offset == &options.offset && p.remote && as_frame))
      return refuse(joints ? "is offset by joint angles from a pose" : "is offset on a remote tool by a frame",
                    "list the program with the position as the robot reached it");
  }
  if (counts(options.offset) && !as_frame)
    for (std::size_t i = 0; i < p.values.size() && i < options.offset->values.size(); ++i)
      p.values[i] += options.offset->values[i];
  pose = frame_of_fanuc(p.values);
  if (p.remote) pose = inverse(pose);
  if (counts(options.offset) && as_frame) pose = frame_of_fanuc(options.offset->values) * pose;
  if (counts(options.tool_offset)) pose = pose * frame_of_fanuc(options.tool_offset->values);
  if (options.remote && move.kind != Instruction::Kind::joint) {
    pose = inverse(pose);
    NamedFrame standing = object;
    standing.stationary = true;
    use(standing, true, move);
    use(tool, false, move);
    return true;
  }
  if (p.frame != 0) use(object, false, move);
  if (p.tool != 0) use(tool, true, move);
  return true;
}

// ---- speeds and options ----------------------------------------------------------------------------------

std::optional<double> FanucRun::override_share() {
  double share = 1;
  for (const auto& [name, written] : {std::pair("override", "OVERRIDE"), std::pair("$prgoverride", "$PRGOVERRIDE")}) {
    const auto percent = values_.override_percent(name);
    if (!percent || !(*percent > 0) || *percent > 100) {
      missing(written, fmt::format("moves under an {} that is known only while the robot runs", written),
              "give it with " + values_of_job({written}, "100"),
              {{Question::Kind::value, written, "a number in %", "100"}});
      return {};
    }
    share *= *percent / 100;
  }
  return share;
}

bool FanucRun::read_speed(FanucCursor& at, Instruction& move) {
  values_.forget_missing();
  if (at.take("max_speed")) return true;
  std::string text(at.rest());
  const bool weld = at.take("WELD_SPEED");
  if (weld) {  // a value of the controller's weld schedule
    const auto given = values_.given("weld_speed");
    if (!given) {
      missing("WELD_SPEED", "moves with WELD_SPEED, which lies in the controller's weld schedule",
              "give it with " + values_of_job({"WELD_SPEED"}, "8mm/sec"),
              {{Question::Kind::value, "WELD_SPEED", "a speed with its unit: 8mm/sec"}});
      return false;
    }
    text = *given;
  }
  FanucCursor written(text);
  const FanucNumber speed = weld ? written.number() : values_.value(written);
  const auto wrong_value = [&](const char* what) {  // the cause is the user's value, not the line
    return refuse(fmt::format("moves with WELD_SPEED, whose value '{}' in motion.values {}", text, what),
                  "write it with its unit: 8mm/sec");
  };
  if (weld && !speed) return wrong_value("is no number");
  const auto share = override_share();
  if (!share) return false;
  if (!speed) {
    missing_value("has a speed by");
    return false;
  }
  if (weld && !(*speed > 0)) return wrong_value("is not above 0");
  if (!(*speed > 0)) return refuse("has no speed above 0", "write one");
  const bool axes = move.kind == Instruction::Kind::joint;
  const auto of_other_moves = [&](const char* unit) {
    note(fmt::format("{:g}{}: {}: J takes %, deg/sec or sec, the others mm/sec, cm/min, inch/min, deg/sec or sec",
                     *speed, unit, other_speed),
         true);
  };
  for (const char* unit : {"mm/sec", "cm/min", "inch/min"})
    if (axes && FanucCursor(written).take(unit)) of_other_moves(unit);
  if (written.take_sign('%')) {
    if (!axes) of_other_moves("%");
    if (*speed > 100) note(fmt::format("{:g}%: {}", *speed, above_all_speed), true);
    move.speed.axis_percent = std::min(*speed, 100.0) * *share;
  } else if (written.take("mm/sec"))
    move.speed.tool = *speed * millimetre * *share;
  else if (written.take("cm/min"))
    move.speed.tool = *speed * 0.01 / 60 * *share;
  else if (written.take("inch/min"))
    move.speed.tool = *speed * 0.0254 / 60 * *share;
  else if (written.take("deg/sec"))
    move.speed.orientation = *speed * degree * *share;
  else if (written.take("msec"))
    move.speed.duration = *speed * 1e-3 / *share;
  else if (written.take("sec"))
    move.speed.duration = *speed / *share;
  else if (weld)
    return wrong_value("has no known unit");
  else
    return refuse("has a speed without a known unit", "write %, mm/sec, cm/min, inch/min, deg/sec or sec");
  if (!weld) at.move_to(at.offset() + written.offset());
  return true;
}

/// Reads the number of an option. Asks for it if it is unknown.
FanucNumber FanucRun::needed(FanucCursor& at, const char* what) {
  FanucCursor next = at;
  if (!next.number() && !next.take("R") && !next.take("AR") && !next.take_sign('(')) {
    complain(fmt::format("{} without a number", what), "write the number behind the word: CNT50, CR10, ACC80");
    return {};
  }
  values_.forget_missing();
  const FanucNumber number = values_.value(at);
  if (!number) missing_value(what);
  return number;
}

/// Reads ",PR[n]" behind Offset or Tool_Offset; without it, uses the PR[n] of OFFSET CONDITION or TOOL_OFFSET CONDITION.
void FanucRun::offset_by(FanucCursor& at, std::optional<FanucPosition>& into, const std::string& condition) {
  FanucCursor next = at;
  next.take_sign(',');
  const bool own = next.take("PR");
  FanucCursor written(own ? at.rest() : std::string_view(condition));
  written.take_sign(',');
  values_.forget_missing();
  const auto [registered, number, known] = position(written);
  into = known;
  if (own) at.move_to(at.offset() + written.offset());
  if (!own && !written.at_end())
    complain("is offset in a frame of its own", "list the program with the position as the robot reached it");
  if (into && into->known()) {
    if (into->form == FanucPosition::Form::unknown) into->form = FanucPosition::Form::pose;
    if (registered) doubt(*number);
    return;
  }
  into.reset();
  if (registered && number)
    missing_position(*number, "is offset by");
  else
    missing_value("is offset by");
}

/// Reads the offset of a camera: ",VR[n]". Only the user can give its value.
void FanucRun::offset_by_camera(FanucCursor& at, std::optional<FanucPosition>& into) {
  at.take_sign(',');
  const auto index = at.take("VR") ? values_.index(at) : std::nullopt;
  const std::string name = fmt::format("VR[{}]", index && index->number ? whole_number(*index->number) : 1);
  into = values_.given_position(name);
  if (!into)
    missing(name, fmt::format("is offset by what a camera finds ({})", name),
            "give it with " + values_of_job({name}, some_pose), {{Question::Kind::value, name, position_form}});
}

/// Returns whether the condition of SKIP CONDITION becomes true before a move ends. If it does, Skip continues with the
/// next line and SkipJump at its label. If it does not, Skip continues at its label and SkipJump with the next line.
bool FanucRun::skip_condition_comes(bool jumps) {
  values_.forget_missing();
  FanucCursor at(skip_condition_);
  std::optional<bool> comes = assumed(where().line);
  if (!comes && !skip_condition_.empty()) comes = values_.condition(at);
  if (!comes && jumps) {
    comes = ask("jumps or not (SkipJump) by SKIP CONDITION, which depends on", 2, then_or_else) == 0;
  } else if (!comes) {
    note(fmt::format(
             "SKIP: the condition comes at the end of the move, and the program continues with the next line ({}: it "
             "does not come)",
             assume_of_job(line_name(), "else")),
         true);
    return true;
  }
  note(fmt::format("SKIP: the move goes to its end, and its condition {}", *comes ? "comes there" : "does not come"),
       true);
  return *comes;
}

/// Reads one option behind the speed. Returns false if the cursor is not at a known option.
bool FanucRun::read_option(FanucCursor& at, Instruction& move, Options& options) {
  const auto set = [&](FanucNumber number, double low, double high, double& into, double unit) {
    if (number)
      into = std::clamp(*number, low, high) * unit;
    else
      options.failed = true;
  };
  if (at.take("FINE"))
    move.zone = {};
  else if (at.take("CNT")) {
    const FanucNumber share = needed(at, "goes over into the next move by CNT");
    if (share && *share > 100) note(fmt::format("CNT{:g}: {}", *share, above_all_speed), true);
    set(share, 0, 100, move.zone.percent, 1);
  } else if (at.take("CD") || at.take("CR"))
    set(needed(at, "goes over into the next move by a distance"), 0, 1e6, move.zone.distance, millimetre);
  else if (at.take("ACC")) {
    constexpr double least = 1, most = 150;
    const FanucNumber percent = needed(at, "accelerates by ACC");
    if (percent && (*percent < least || *percent > most))
      note(fmt::format("ACC{:g}: {}", *percent, beyond_range_words(least, most)), true);
    set(percent, least, most, move.acceleration_percent, 1);
  } else if (at.take("TOOL_OFFSET")) {
    offset_by(at, options.tool_offset, tool_offset_condition_);
    options.failed |= !options.tool_offset;
  } else if (at.take("OFFSET")) {
    offset_by(at, options.offset, offset_condition_);
    options.failed |= !options.offset;
  } else if (at.take("VOFFSET")) {
    offset_by_camera(at, options.offset);
    options.camera = true;
    options.failed |= !options.offset;
  } else if (at.take("INC")) {
    complain("is an incremental move", "write the target itself");
    options.failed = true;
  } else if (at.take("RTCP")) {
    options.remote = true;
  } else if (const bool jumps = at.take("SKIPJUMP"); jumps || at.take("SKIP")) {
    options.skips = true;
    const bool comes = skip_condition_comes(jumps);
    FanucCursor next = at;
    next.take_sign(',');
    if (next.take("LBL") && comes == jumps) options.jumps = std::string(next.rest());
  } else if (at.take("COORD")) {
    options.coordinated = true;
  } else if (at.take("WJNT") || at.take("MROT")) {
    note("Wjnt, MROT: the tool turns otherwise on its way than read here", true);
  } else if (at.take("CALL")) {
    options.calls = std::string(at.rest());
    at.name();
    if (at.take_sign('(')) at.skip_to(')');
  } else if (at.take("PSPD") || at.take("EV") || at.take("IND")) {
    note("PSPD, EV: changes the speed of the move", true);
  } else {
    return false;
  }
  return true;
}

bool FanucRun::read_options(FanucCursor& at, Instruction& move, Options& options) {
  while (!at.at_end()) {
    charge();
    if (at.take_sign(',') || at.take_sign(':') || read_option(at, move, options)) continue;
    if (at.rest().starts_with("[")) {  // brackets of a skipped word: SPOT[SD=1], DO[3:on]
      at.skip_to(']');
    } else if (const std::size_t begin = at.offset(); at.word().empty()) {
      at.move_to(at.offset() + 1);
    } else {
      unread_option(at.from(begin));
    }
  }
  return !options.failed;
}

/// Notes a word behind the speed that read_option() does not know, unless the word belongs to a call at a time or a
/// distance from the point (TB .10sec,DO[3]=ON), to Skip (PR[5]=LPOS), or to a process (SPOT[..], Arc Start[..]).
void FanucRun::unread_option(std::string_view written) {
  static const pipeline::WordSet silent = pipeline::word_set(
      "tb ta db da time before after ta_ref sec msec mm p sps point_logic pulse on off lbl r pr ar lpos jpos start "
      "end spot ss se seal");
  static const std::set<std::string> at_corners{"pth", "rt_ld", "ap_ld", "rt_ldr", "ap_ldr", "break"};
  static const std::vector<std::string> known{"FINE", "CNT",      "ACC",  "Offset", "Tool_Offset", "VOFFSET", "INC",
                                              "RTCP", "COORD",    "Skip", "Wjnt",   "MROT",        "PSPD",    "PTH",
                                              "CALL", "SkipJump", "SPOT", "RT_LD",  "AP_LD",       "BREAK"};
  std::string word = lower_case(written);
  while (!word.empty() && word.back() >= '0' && word.back() <= '9') word.pop_back();
  const bool number = written[0] >= '0' && written[0] <= '9';  // of TB, DB and the like
  if (number || silent.contains(word) || fanuc_word(word) == FanucWord::logic) return;
  if (at_corners.contains(word)) return note("PTH, RT_LD, AP_LD, BREAK: change the path at corners, not read");
  if (word == "fplin" || fanuc_word(word) == FanucWord::shapes_motion)
    return note(word + ": changes how the robot moves; what it does lies in the controller", true);
  note(unread_reason(std::string(written.substr(0, word.size())), "the options of a move", known), true);
}

// ---- moves -----------------------------------------------------------------------------------------------

void FanucRun::emit(Instruction instruction) {
  if (program_.instructions.size() >= ImportLimits::instructions) {
    complain(fmt::format("would be move {} (no more are allowed)", ImportLimits::instructions + 1),
             "simulate a shorter part");
    throw Stop{};
  }
  instruction.where = where();
  instruction.routine = routine().listing->name;
  instruction.text = around_.files[routine().listing->file].line(statement().line);
  program_.instructions.push_back(std::move(instruction));
}

/// Stores the target as the position of the robot (LPOS, JPOS) after the move.
void FanucRun::remember(const Instruction& move, const FanucPosition& target) {
  last_ = target;
  if (target.form == FanucPosition::Form::pose)
    last_->values = fanuc_values_of(last_->remote ? inverse(move.target.pose) : move.target.pose);
  if (target.frame < 0 || target.tool < 0) {
    last_->frame = whole_number(values_.named("uframe_num").value_or(0));
    last_->tool = whole_number(values_.named("utool_num").value_or(0));
  }
}

/// Sets the target of a move to joint angles [rad], with q3 = J3 + J2. Returns false, with a problem, on error.
bool FanucRun::place_joints(const FanucPosition& position, const Options& options, Instruction& move) {
  std::vector<double> angles = position.values;
  const bool in_space = options.offset && options.offset->form != FanucPosition::Form::joints;
  if ((options.tool_offset && !nothing(*options.tool_offset)) || (in_space && !nothing(*options.offset)))
    return refuse("is offset in space from joint angles", "teach the position in Cartesian form");
  if (options.offset && !in_space)
    for (std::size_t i = 0; i < angles.size() && i < options.offset->values.size(); ++i)
      angles[i] += options.offset->values[i];
  for (double angle : angles) move.target.joints.push_back(angle * degree);
  if (angles.size() >= 3) move.target.joints[2] += move.target.joints[1];
  if (move.kind == Instruction::Kind::joint) return true;
  int number = position.tool;  // a linear move needs the tool, because its origin follows the line
  if (!active(true, number)) return false;
  const auto tool = frame(true, number);
  if (tool && number != 0) use(*tool, true, move);
  return tool.has_value();
}

/// Sets the intermediate point of an arc. Returns false, with a problem, if its form, frames or offsets do not fit the end.
bool FanucRun::place_via(const FanucPosition& via, const FanucPosition& target, const Options& own,
                         const Options& options, Instruction& move) {
  if (via.form != FanucPosition::Form::pose || target.form != FanucPosition::Form::pose)
    return refuse("is an arc through joint angles", "teach its points in Cartesian form");
  if (via.frame != target.frame || via.tool != target.tool)
    return refuse("is an arc through points of two frames", "teach both in one");
  const auto one_sided = [](const auto& end, const auto& middle) { return end && !nothing(*end) && !middle; };
  if (one_sided(options.offset, own.offset) || one_sided(options.tool_offset, own.tool_offset))
    return refuse("is an arc of which only the end is offset", "write the offset at both of its points");
  return place(via, own, move, move.via);
}

void FanucRun::move(FanucCursor& at, Instruction::Kind kind) {
  Instruction move;
  move.kind = kind;
  Options options, via_options;
  std::optional<FanucPosition> via;
  if (kind == Instruction::Kind::circular) {  // C P[1] : P[2] 100mm/sec ...
    via = target_position(at);
    if (!via) return;
    const std::size_t colon = std::min({at.rest().find(':'), at.rest().find('\n'), at.rest().size()});
    FanucCursor own(at.rest().substr(0, colon));
    if (!read_options(own, move, via_options)) return;
    at.move_to(at.offset() + colon);
    at.take_sign(':');
  }
  const std::size_t begin = at.offset();
  const auto target = target_position(at);
  if (!target && at.offset() == begin) return;
  if (target && target->form == FanucPosition::Form::other_groups) return note("moves other groups than the robot");
  const bool fast = read_speed(at, move), set = read_options(at, move, options);
  if (!target || !fast || !set) {  // asks for unknown frames in the same round
    FanucPosition there;
    there.frame = there.tool = -1;
    if (target) there = *target;
    // A listing gives the frames of a P[n] with its numbers. A missing P[n] is one question, not three.
    const bool listed = FanucCursor(statement().text.substr(begin)).take("P");
    if (target ? target->form == FanucPosition::Form::pose : !listed) frames_of(there);
    return;
  }
  via_options.remote = options.remote;
  if (via && !place_via(*via, *target, via_options, options, move)) return;
  const bool joints = target->form == FanucPosition::Form::joints;
  move.target.configuration = target->configuration;
  if (joints ? !place_joints(*target, options, move) : !place(*target, options, move, move.target.pose)) return;
  move.target.external_axes = target->external_axes;
  const bool stood = last_ && last_->external_axes == target->external_axes;
  if (options.coordinated && !program_.instructions.empty() && !stood)
    note("COORD: the tool follows a positioner that turns; read as if it did not move", true);
  emit(move);
  remember(move, *target);
  if (options.offset || options.tool_offset) last_->form = joints ? FanucPosition::Form::unknown : last_->form;
  if (options.skips) stopped_on_the_way();
  if (!options.calls.empty()) call_statement(options.calls, false);
  if (!options.jumps.empty()) {
    FanucCursor label(options.jumps);
    const auto number = values_.index(label);
    const auto& labels = routine().listing->labels;
    const auto found = number && number->number ? labels.find(whole_number(*number->number)) : labels.end();
    if (found == labels.end()) return complain("jumps to a label that is not there", "correct the label");
    jump_to(found->second, false);
  }
  if (lower_case(statement().text).find("spot[") != std::string::npos) emit(dwell_of(around_.options.spot_time));
}

/// Makes the position of the robot unknown after a skipped move, and the register that stores it
/// (Skip,LBL[1],PR[5]=LPOS).
void FanucRun::stopped_on_the_way() {
  last_.reset();
  const std::string& text = statement().text;
  const std::size_t lpos = std::min(text.find("=LPOS"), text.find("=JPOS"));
  if (lpos == std::string::npos) return;
  FanucCursor written(std::string_view(text).substr(std::min(text.rfind("PR", lpos) + 2, text.size())));
  const auto index = values_.index(written);
  if (index && index->number)
    values_.forget_position(whole_number(*index->number), {});
  else
    values_.forget_registers({});
}

}  // namespace dresslife::sim
