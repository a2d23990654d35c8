#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "sim/program/interpreter/parser.h"
#include "sim/program/krl/krl.h"

namespace dresslife::sim {
namespace {

using Kind = Statement::Kind;

constexpr const char* moves[] = {"ptp",  "lin",   "circ", "ptp_rel",  "lin_rel",  "circ_rel", "sptp",
                                 "slin", "scirc", "spl",  "sptp_rel", "slin_rel", "spl_rel",  "scirc_rel"};
constexpr const char* ends[] = {"end",  "endfct",  "enddat", "endif",     "endfor",    "endwhile", "endloop", "else",
                                "case", "default", "until",  "endswitch", "endspline", "def",      "deffct"};

/// First words of statements without effect on the motion.
constexpr const char* left_out_words[] = {"enum",       "ext",       "extfct", "extp",    "extfctp", "channel",
                                          "anin",       "anout",     "pulse",  "brake",   "resume",  "halt",
                                          "time_block", "const_vel", "asyptp", "asycont", "asystop", "asycancel"};
/// System variables that the controller changes: an assigned value is not kept.
constexpr const char* living_names[] = {"$timer", "$timer_flag", "$cycflag", "$in", "$anin", "$err"};

/// Words at which the controller's advance run waits until the robot reaches the line.
/// Source: KUKA's course on programming (HALT, WAIT, PULSE, ANIN, ANOUT, $IN, $OUT, $ANIN, $ANOUT, imported
/// variables) and the description of $AXIS_ACT; the same effect of the other robot positions is ESTIMATED.
/// Names declared by SIGNAL and IMPORT: advance.cpp.
const pipeline::WordSet present_words = pipeline::word_set(
    "wait halt pulse anin anout $in $out $anin $anout $digin1 $digin2 $digin3 $digin4 $digin5 $digin6 $pos_act "
    "$pos_act_mes $axis_act $axis_act_meas $axis_int $pos_int $axis_back $pos_back $axis_for $pos_for $axis_ret "
    "$pos_ret");

class KrlParser : StatementParser {
 public:
  KrlParser(Code& code, int file, const std::vector<Token>& tokens, Problems& problems)
      : StatementParser(code, file, tokens, problems, Grammar::krl) {}

  void run() {
    module_ = module_of_file();
    skip_line_ends();
    while (!at_.at_end() && !problems_.full()) {
      guarded([&] { member(); });
      skip_line_ends();
    }
  }

 private:
  int module_ = -1;
  bool shared_ = false;    ///< the file is a data list of the system; its names are visible to all modules
  bool global_ = false;    ///< the current declaration has GLOBAL
  bool constant_ = false;  ///< the current declaration has CONST
  bool first_ = true;      ///< no routine of this file was read; the first routine is visible to all modules
  int continued_ = 0;      ///< line of the last CONTINUE

  /// Returns the module of the file. A program and the data list of its name are one module. If several files have
  /// the name, those in the same folder belong together.
  int module_of_file() {
    const std::filesystem::path path = code_.files[file_].name();
    const std::string stem = lower_case(path.stem().string());
    const bool list = lower_case(path.extension().string()) == ".dat";
    int alike = -1, count = 0;
    for (int k = 0; k < static_cast<int>(code_.modules.size()); ++k) {
      const Module& other = code_.modules[k];
      const std::filesystem::path other_path = code_.files[other.place.file].name();
      if (other.name != stem || (lower_case(other_path.extension().string()) == ".dat") == list) continue;
      alike = k;
      ++count;
      if (other_path.parent_path() != path.parent_path()) continue;
      count = 1;
      break;
    }
    if (count != 1) {
      alike = static_cast<int>(code_.modules.size());
      code_.modules.push_back({stem, path.stem().string(), {file_, 1, 1}, false});
    } else {
      code_.modules[alike].whole = true;
    }
    return alike;
  }

  /// Whether a name of $krl.dat is already declared. $krl.dat is read last; declarations of the controller have priority.
  bool is_declared_already(const std::string& name) const {
    return code_.files[file_].name() == "$krl.dat" && std::ranges::any_of(code_.data, [&](const Datum& datum) {
             return datum.statement.kind == Kind::declare && !datum.local && datum.statement.name == name;
           });
  }

  void need_line_end() {
    if (!line_done()) at_.fail(fmt::format("has {} behind the end of the statement", at_.seen()), "correct the line");
    skip_line_ends();
  }

  template <class Read>
  void guarded(const Read& read) {
    const Place before = at_.place();
    if (attempt(read)) return;
    const Place now = at_.place();
    if (now.line == before.line || now.column > 1) skip_line();
    skip_line_ends();
    const Place after = at_.place();
    if (after.line == before.line && after.column == before.column) at_.next();
  }

  void member() {
    if (at_.at_sign("&")) return skip_line();  // attributes of the file: &ACCESS, &REL
    const bool global = at_.at_word("global") && (at_.at_word("def", 1) || at_.at_word("deffct", 1));
    if (global) at_.next();
    if (at_.at_word("def") || at_.at_word("deffct")) return routine(global);
    if (at_.at_word("defdat")) shared_ = at_.peek(1).text.starts_with("$");
    if (at_.at_word("defdat") || at_.at_word("enddat")) return skip_line();
    std::vector<Statement> statements;
    statement(statements);
    for (Statement& s : statements)
      if (s.kind == Kind::declare || s.kind == Kind::assign) {
        const bool local = s.kind == Kind::declare && !shared_ && !global_;
        code_.data.push_back({std::move(s), module_, local});
      }
  }

  void routine(bool global) {
    Routine routine;
    const bool function = at_.at_word("deffct");
    at_.next();
    if (function) at_.word("a type");
    if (at_.at_sign("[")) skip_index();
    routine.place = at_.place();
    routine.written = std::string(at_.peek().text);
    routine.name = at_.word("the routine's name");
    routine.module = module_;
    routine.local = !global && !first_;
    first_ = false;
    parameters(routine);
    const char* end = function ? "endfct" : "end";
    // An error in its blocks is a problem of this routine: the parser continues with the rest of the file.
    const bool whole = attempt([&] {
      need_line_end();
      read_body({end}, routine.body);
      at_.need_word(end);
    });
    if (!whole) skip_to_end_of_routine(end);
    routine.last_line = at_.place().line;
    at_.take_word(end);
    code_.routines.push_back(std::move(routine));
  }

  void skip_to_end_of_routine(const char* end) {
    const auto next_begins = [&] { return at_.at_word("def") || at_.at_word("deffct") || at_.at_word("global"); };
    while (!at_.at_end() && !next_begins() && !(at_.at_word(end) && at_.peek(1).kind == Token::Kind::line_end))
      at_.next();
  }

  /// Reads parameters: (a :IN, b[] :OUT, c). All parameters without :IN are returned to the caller.
  void parameters(Routine& routine) {
    if (!at_.take_sign("(")) return;
    while (!at_.take_sign(")")) {
      if (at_.take_sign(",") || at_.take_sign(":")) continue;
      if (line_done()) at_.fail("ends in a list of parameters", "close it");
      const std::string name = at_.word("a parameter");
      if (at_.at_sign("[")) skip_index();
      if ((name == "in" || name == "out") && !routine.parameters.empty())
        routine.parameters.back().given_back = name == "out";
      else
        routine.parameters.push_back({name, false, true});
    }
  }

  void skip_index() {
    while (!at_.take_sign("]")) {
      if (line_done()) at_.fail("ends in an index", "close it with ]");
      at_.next();
    }
  }

  std::vector<Statement> body(const std::vector<const char*>& until) {
    std::vector<Statement> statements;
    read_body(until, statements);
    return statements;
  }

  void read_body(const std::vector<const char*>& until, std::vector<Statement>& into) {
    skip_line_ends();
    into = block(
        until,
        [&] {
          return at_any({std::begin(ends), std::end(ends)});
        },
        [&](std::vector<Statement>& statements) {
          guarded([&] { statement(statements); });
          skip_line_ends();
        });
  }

  void statement(std::vector<Statement>& into) {
    Statement s = statement_here();
    global_ = constant_ = false;
    s.continued = continued_ > 0 && s.place.line <= continued_ + 1;  // CONTINUE applies only to the next line
    const bool waits = !s.continued && waits_for_robot();
    if (waits) into.push_back(stop_of_advance(s.place));
    if (at_.at_word("global") || at_.at_word("decl") || at_.at_word("const")) {
      while (at_.at_word("global") || at_.at_word("decl") || at_.at_word("const")) {
        global_ |= at_.at_word("global");
        constant_ |= at_.at_word("const");
        at_.next();
      }
      if (at_.at_word("enum")) return skip_line();
      if (!at_.at_word("struc") && !at_.at_word("signal") && !at_.at_word("interrupt")) return declaration(into);
    }
    if (at_.take_word("struc")) return structure();
    if (at_.at_word("signal") || at_.at_word("import")) return signal(into);
    if (at_.at_word("interrupt")) return interrupt(s, into);
    if (at_.at_word("trigger")) return trigger(s, into);
    if (at_any({std::begin(left_out_words), std::end(left_out_words)}) ||
        at_any({std::begin(living_names), std::end(living_names)}))
      return left_out(s, into);
    if (at_.peek().kind != Token::Kind::word)
      at_.fail(fmt::format("has {} where a statement is expected", at_.seen()), "correct the line");
    if (at_.take_word("if"))
      if_statement(s);
    else if (at_.take_word("for"))
      for_statement(s);
    else if (at_.take_word("while")) {
      loop(s, Kind::while_loop, "endwhile", true);
      if (waits) s.branches[0].body.push_back(stop_of_advance(s.place));  // before each pass
    } else if (at_.take_word("loop"))
      loop(s, Kind::endless, "endloop", false);
    else if (at_.take_word("repeat"))
      repeat_statement(s);
    else if (at_.take_word("switch"))
      switch_statement(s);
    else if (at_.take_word("spline") || at_.take_word("ptp_spline"))
      return spline(into);
    else if (at_.take_word("return"))
      return_statement(s);
    else if (at_.take_word("exit"))
      s.kind = Kind::leave_loop;
    else if (at_.take_word("continue")) {
      continued_ = s.place.line;
      return;
    } else if (at_.at_word("wait"))
      wait_statement(s);
    else if (at_.take_word("goto"))
      s = labelled(Kind::jump);
    else if (is_move())
      move(s);
    else if (at_.peek(1).kind == Token::Kind::word && !line_done())
      return declaration_or_unknown(s, into);
    else if (at_.at_sign(":", 1)) {
      s = labelled(Kind::label);
      at_.next();
    } else
      assignment_or_call(s);
    need_line_end();
    into.push_back(std::move(s));
  }

  /// Whether the line contains one of present_words. Declarations, TRIGGER and INTERRUPT lines do not count.
  bool waits_for_robot() const {
    if (at_any({"trigger", "interrupt", "global", "decl", "const", "signal", "ext", "extfct"})) return false;
    for (int ahead = 0; at_.peek(ahead).kind != Token::Kind::line_end && at_.peek(ahead).kind != Token::Kind::end;
         ++ahead)
      if (at_.peek(ahead).kind == Token::Kind::word && present_words.contains(lower_case(at_.peek(ahead).text)))
        return true;
    return false;
  }

  bool is_move() const { return at_any({std::begin(moves), std::end(moves)}); }

  void left_out(Statement& s, std::vector<Statement>& into) {
    s.name = lower_case(at_.peek().text);
    skip_line();
    into.push_back(std::move(s));
  }

  /// Reads a declaration without DECL: INT A, B[3] = 2. Another line that begins with two words is skipped.
  void declaration_or_unknown(Statement& s, std::vector<Statement>& into) {
    const std::size_t begin = at_.mark(), known = into.size();
    try {
      return declaration(into);
    } catch (const SyntaxError&) {
      at_.back_to(begin);
      into.resize(known);
    }
    left_out(s, into);
  }

  /// Reads STRUC name INT a, b[3], FRAME c.
  void structure() {
    RecordType type;
    type.name = at_.word("the structure's name");
    std::string kind;
    do {
      if (at_.peek(1).kind == Token::Kind::word) kind = at_.word("a type");
      if (kind.empty()) at_.fail("has a component without a type", "write its type before it");
      type.fields.push_back(at_.word("a component"));
      type.types.push_back(nullptr);
      type.field_types.push_back(kind);
      type.sizes.push_back(0);
      if (!at_.take_sign("[")) continue;
      if (at_.peek().kind == Token::Kind::number)
        type.sizes.back() = static_cast<int>(std::clamp(at_.next().number, 0.0, 1e6));
      skip_index();
    } while (at_.take_sign(","));
    need_line_end();
    code_.records.push_back(std::move(type));
  }

  /// Reads INTERRUPT DECL n WHEN condition DO call (the call becomes a branch), INTERRUPT ON n, INTERRUPT OFF n.
  void interrupt(Statement& s, std::vector<Statement>& into) {
    at_.next();
    const bool off = at_.at_word("off") || at_.at_word("disable");
    s.name = at_.at_word("decl") ? "interrupt_decl" : off ? "interrupt_off" : "interrupt_on";
    at_.next();
    if (!line_done()) s.arguments.push_back(at_.expression());
    if (s.name == "interrupt_decl") what_happens(s);
    skip_line();
    into.push_back(std::move(s));
  }

  /// Reads TRIGGER WHEN ... DO call or assignment.
  void trigger(Statement& s, std::vector<Statement>& into) {
    s.name = lower_case(at_.next().text);
    what_happens(s);
    skip_line();
    into.push_back(std::move(s));
  }

  /// Reads the call or assignment after DO as a separate branch.
  void what_happens(Statement& s) {
    while (!line_done() && !at_.at_word("do")) at_.next();
    at_.need_word("do");
    Statement inner = statement_at(at_.place(), Kind::instruction);
    assignment_or_call(inner);
    s.branches.push_back({{}, {std::move(inner)}, {}});
  }

  /// Reads SIGNAL name $IN[1] TO $IN[8] or IMPORT type name IS file: a variable that others write.
  void signal(std::vector<Statement>& into) {
    const std::string kind = at_.word("a type");
    if (kind == "import") at_.word("a type");
    const Place place = at_.place();
    into.push_back(declaration_at(place, at_.word("a name"), kind));
    skip_line();
  }

  const int sums = precedence_of("+");  ///< lowest precedence in a declaration and in FOR, where = is no comparison

  void declaration(std::vector<Statement>& into) {
    const std::string type = at_.word("a type");
    do {
      const Place place = at_.place();
      Statement s = declaration_at(place, at_.word("a name"), type);
      s.constant = constant_;
      if (at_.take_sign("[")) {
        while (!at_.take_sign("]")) {
          if (at_.take_sign(",")) continue;
          s.arguments.push_back(at_.expression());
        }
      }
      if (at_.take_sign("=")) s.arguments[0] = at_.expression(sums);
      if (!is_declared_already(s.name)) into.push_back(std::move(s));
    } while (at_.take_sign(","));
    need_line_end();
  }

  void if_statement(Statement& s) {
    condition(s);
    at_.need_word("then");
    arms(s, "endif", "", [&](bool otherwise) { return otherwise ? body({"endif"}) : body({"endif", "else"}); });
  }

  void for_statement(Statement& s) {
    s.kind = Kind::count;
    s.keeps_counter = true;
    s.name = at_.word("the loop's variable");
    at_.need_sign("=");
    s.arguments.push_back(at_.expression(sums));
    at_.need_word("to");
    s.arguments.push_back(at_.expression(sums));
    s.arguments.push_back(at_.take_word("step") ? at_.expression(sums)
                                                : number_at({}, 1));  // KRL counts up without STEP
    close_loop(s, body({"endfor"}), "endfor");
  }

  void loop(Statement& s, Kind kind, const char* end, bool condition) {
    s.kind = kind;
    if (condition) s.arguments.push_back(at_.expression());
    close_loop(s, body({end}), end);
  }

  void repeat_statement(Statement& s) {
    s.kind = Kind::until_loop;
    close_loop(s, body({"until"}), "until");
    if (waits_for_robot()) s.branches[0].body.push_back(stop_of_advance(at_.place()));
    s.arguments.push_back(at_.expression());
  }

  void switch_statement(Statement& s) {
    s.kind = Kind::choose;
    s.arguments.push_back(at_.expression());
    skip_line_ends();
    cases(s, "endswitch", [&] { return body({"endswitch", "case", "default"}); });
  }

  /// Reads the moves of a spline block. Each gets the mark "in_spline" and the settings of the block's WITH.
  void spline(std::vector<Statement>& into) {
    Branch settings;
    if (at_.take_word("with")) with(settings.body);
    skip_line_ends();
    std::vector<Statement> inside = body({"endspline"});
    at_.need_word("endspline");
    std::string end_zone;
    if (at_.peek().kind == Token::Kind::word) end_zone = at_.word("an approximation");
    skip_line();
    Statement* last = nullptr;
    for (Statement& s : inside) {
      if (s.kind != Kind::instruction || s.arguments.empty()) continue;
      s.text += " in_spline";
      if (!settings.body.empty()) s.branches.insert(s.branches.begin(), settings);
      last = &s;
    }
    if (last) last->text += " last " + end_zone;
    for (Statement& s : inside) into.push_back(std::move(s));
  }

  /// Reads WITH $VEL.CP = 0.5, $APO.CDIS = 10: assignments before the move.
  void with(std::vector<Statement>& into) {
    do {
      Statement& s = into.emplace_back(statement_at(at_.place(), Kind::assign));
      s.arguments.push_back(at_.reference());
      at_.need_sign("=");
      s.arguments.push_back(at_.expression());
    } while (at_.take_sign(","));
  }

  void return_statement(Statement& s) {
    s.kind = Kind::give_back;
    if (!line_done()) s.arguments.push_back(at_.expression());
  }

  void wait_statement(Statement& s) {
    at_.next();
    s.name = "wait";
    if (at_.take_word("sec")) {
      s.name = "wait_sec";
      s.arguments.push_back(at_.expression());
    } else {
      skip_line();
    }
  }

  /// Reads PTP target [C_PTP [C_DIS]], CIRC via, target [, CA angle] [C_DIS], SLIN target [WITH ...] [C_DIS].
  void move(Statement& s) {
    s.name = at_.word("a move");
    s.text = s.name;
    s.arguments.push_back(at_.expression());
    while (!line_done()) {
      if (at_.take_sign(",")) {
        if (at_.take_word("ca")) {
          Expression angle = at_.expression();
          angle.option = "ca";
          s.arguments.push_back(std::move(angle));
        } else {
          s.arguments.push_back(at_.expression());
        }
      } else if (at_.take_word("with")) {
        Branch settings;  // for this move only
        with(settings.body);
        s.branches.push_back(std::move(settings));
      } else {
        const bool apart = at_.at_word("#") && at_.peek(1).kind == Token::Kind::word;  // # TOOL
        if (apart) at_.next();
        const std::string word = at_.word("an approximation (C_PTP, C_DIS, ...)");
        s.text += (apart ? " #" : " ") + word;
      }
    }
  }

  void assignment_or_call(Statement& s) {
    Expression target = at_.reference();
    if (at_.take_sign("=")) {
      s.kind = Kind::assign;
      s.arguments.push_back(std::move(target));
      s.arguments.push_back(at_.expression());
      return;
    }
    call(s, std::move(target));
  }
};

}  // namespace

void add_krl_types(Code& code) {
  // Structures and system variables of every controller, for positions and settings.
  code.files.emplace_back("$krl.dat",
                          "DEFDAT $KRL\n"
                          "STRUC FRAME REAL X,Y,Z,A,B,C\n"
                          "STRUC POS REAL X,Y,Z,A,B,C,INT S,T\n"
                          "STRUC E3POS REAL X,Y,Z,A,B,C,INT S,T,REAL E1,E2,E3\n"
                          "STRUC E6POS REAL X,Y,Z,A,B,C,INT S,T,REAL E1,E2,E3,E4,E5,E6\n"
                          "STRUC AXIS REAL A1,A2,A3,A4,A5,A6\n"
                          "STRUC E3AXIS REAL A1,A2,A3,A4,A5,A6,E1,E2,E3\n"
                          "STRUC E6AXIS REAL A1,A2,A3,A4,A5,A6,E1,E2,E3,E4,E5,E6\n"
                          "STRUC CP REAL CP,ORI1,ORI2\n"
                          "STRUC CONT REAL CPTP,CDIS,CORI,CVEL\n"
                          "STRUC INERTIA REAL X,Y,Z\n"
                          "STRUC LOAD REAL M,FRAME CM,INERTIA J\n"
                          "STRUC FDAT INT TOOL_NO,BASE_NO,IPO_MODE IPO_FRAME,CHAR POINT2[24]\n"
                          "STRUC PDAT REAL VEL,ACC,APO_DIST,APO_MODE_T APO_MODE,REAL GEAR_JERK\n"
                          "STRUC LDAT REAL VEL,ACC,APO_DIST,APO_FAC,AXIS_VEL,AXIS_ACC,ORI_TYPE ORI_TYP,CIRC_TYPE "
                          "CIRC_TYP,REAL JERK_FAC\n"
                          "STRUC JERK_STRUC REAL CP,ORI\n"
                          "CP $VEL,$ACC\n"
                          "CONT $APO\n"
                          "REAL $VEL_AXIS[12],$ACC_AXIS[12],$GEAR_JERK[12]\n"
                          "JERK_STRUC $JERK\n"
                          "FRAME $TOOL,$BASE,$ROBROOT\n"
                          "LOAD $LOAD\n"
                          "IPO_MODE $IPO_MODE\n"
                          "ORI_TYPE $ORI_TYPE\n"
                          "CIRC_TYPE $CIRC_TYPE\n"
                          "INT $ACT_TOOL,$ACT_BASE,$OV_PRO,$ADVANCE\n"
                          "FDAT FDAT_ACT\n"
                          "PDAT PDAT_ACT\n"
                          "LDAT LDAT_ACT\n"
                          "ENDDAT\n");
}

namespace {

/// Records the variables that a submit program writes. It runs cyclically in parallel to the robot program, so they may
/// have any value at any time. Its own declarations and system variables ($...) are excluded; the system variables are
/// settings of moves, or no program reads them.
void note_what_is_submitted(Code& code, int file, const std::vector<Token>& tokens) {
  static const pipeline::WordSet declaring = pipeline::word_set("decl int bool real char global signal ext extfct");
  const std::string name = std::filesystem::path(code.files[file].name()).filename().string();
  std::set<std::string> own, written;
  for (std::size_t begin = 0, end = 0; begin < tokens.size(); begin = end + 1) {
    end = begin;
    while (end < tokens.size() && tokens[end].kind != Token::Kind::line_end) ++end;
    const std::string first = begin < end ? lower_case(tokens[begin].text) : "";
    if (declaring.contains(first))
      for (std::size_t i = begin + 1; i < end; ++i) own.insert(lower_case(tokens[i].text));
    std::size_t at = begin + 1;  // after the target's index and components
    while (at < end && tokens[at].text != "=" && tokens[at].text != "(") ++at;
    const bool assigns = at < end && tokens[at].text == "=" && tokens[begin].kind == Token::Kind::word;
    const bool part = assigns && (at == begin + 1 || tokens[begin + 1].text == "[" || tokens[begin + 1].text == ".");
    if (part && !first.starts_with("$")) written.insert(first);
  }
  for (const std::string& target : written)
    if (!own.contains(target)) code.written_beside.emplace(target, "the submit program " + name);
}

}  // namespace

void parse_krl(Code& code, int file, Problems& problems) {
  const std::filesystem::path path = code.files[file].name();
  const std::string stem = lower_case(path.stem().string());
  if (stem == "bas" || stem == "p00") return;  // basics.cpp implements them
  const std::vector<Token> tokens = tokens_of(code.files[file], {';', "$#", true, true}, problems);
  if (file > 0 && lower_case(path.extension().string()) == ".sub") return note_what_is_submitted(code, file, tokens);
  KrlParser(code, file, tokens, problems).run();
}

}  // namespace dresslife::sim
