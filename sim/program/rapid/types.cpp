// RAPID's records, and the predefined speeds and zones of every controller.
#include "sim/program/rapid/types.h"

#include <map>

#include "pipeline/base/lists.h"
#include "pipeline/base/text.h"

namespace dresslife::sim {
namespace {

struct Written {
  const char* name;
  std::vector<std::pair<const char*, const char*>> fields;  // component, record type or ""
  int optional_from = 1'000'000;
};

/// Returns the record types. Each record comes after the records that it contains.
const std::vector<Written>& written_types() {
  static const std::vector<Written> types{
      {"pos", {{"x", ""}, {"y", ""}, {"z", ""}}},
      {"orient", {{"q1", ""}, {"q2", ""}, {"q3", ""}, {"q4", ""}}},
      {"pose", {{"trans", "pos"}, {"rot", "orient"}}},
      {"confdata", {{"cf1", ""}, {"cf4", ""}, {"cf6", ""}, {"cfx", ""}}},
      {"robjoint", {{"rax_1", ""}, {"rax_2", ""}, {"rax_3", ""}, {"rax_4", ""}, {"rax_5", ""}, {"rax_6", ""}}},
      {"extjoint", {{"eax_a", ""}, {"eax_b", ""}, {"eax_c", ""}, {"eax_d", ""}, {"eax_e", ""}, {"eax_f", ""}}},
      {"robtarget", {{"trans", "pos"}, {"rot", "orient"}, {"robconf", "confdata"}, {"extax", "extjoint"}}},
      {"jointtarget", {{"robax", "robjoint"}, {"extax", "extjoint"}}},
      {"loaddata", {{"mass", ""}, {"cog", "pos"}, {"aom", "orient"}, {"ix", ""}, {"iy", ""}, {"iz", ""}}},
      {"tooldata", {{"robhold", ""}, {"tframe", "pose"}, {"tload", "loaddata"}}},
      {"wobjdata", {{"robhold", ""}, {"ufprog", ""}, {"ufmec", ""}, {"uframe", "pose"}, {"oframe", "pose"}}},
      {"speeddata", {{"v_tcp", ""}, {"v_ori", ""}, {"v_leax", ""}, {"v_reax", ""}}},
      {"zonedata",
       {{"finep", ""},
        {"pzone_tcp", ""},
        {"pzone_ori", ""},
        {"pzone_eax", ""},
        {"zone_ori", ""},
        {"zone_leax", ""},
        {"zone_reax", ""}}},
  };
  return types;
}

Value numbers(const std::vector<double>& list, const RecordType* type) {
  return list_value(pipeline::mapped(list, number_value), type);
}

}  // namespace

void add_rapid_types(Code& code) {
  for (const Written& written : written_types()) {
    RecordType type;
    type.name = written.name;
    type.optional_from = written.optional_from;
    for (const auto& [field, inner] : written.fields) {
      type.fields.push_back(field);
      type.types.push_back(*inner ? code.record(inner) : nullptr);
    }
    code.records.push_back(std::move(type));
  }
}

std::optional<Value> rapid_speed(const Code& code, const std::string& name) {
  static const std::vector<int> speeds{5,   10,  20,  30,   40,   50,   60,   80,   100,  150,  200,  300, 400,
                                       500, 600, 800, 1000, 1500, 2000, 2500, 3000, 4000, 5000, 6000, 7000};
  for (int speed : speeds)
    if (name == fmt::format("v{}", speed)) return numbers({double(speed), 500, 5000, 1000}, code.record("speeddata"));
  return {};
}

std::optional<Value> rapid_zone(const Code& code, const std::string& name) {
  // Zone radius of the tool's path [mm]. The zone of the orientation is 1.5 times as large, except for z0 (data type zonedata).
  static const std::vector<int> zones{0, 1, 5, 10, 15, 20, 30, 40, 50, 60, 80, 100, 150, 200};
  const RecordType* type = code.record("zonedata");
  const auto zone = [&](bool stop, double r) {
    const double wide = r < 5 ? r : 1.5 * r;
    Value value = numbers({0, r, wide, wide, wide / 10, wide, wide / 10}, type);
    value.items[0] = truth_value(stop);
    return value;
  };
  if (name == "fine") return zone(true, 0);
  if (name == "z0") return zone(false, 0.3);
  for (int radius : zones)
    if (radius > 0 && name == fmt::format("z{}", radius)) return zone(false, radius);
  return {};
}

Value rapid_initial(const Code& code, const std::string& type_name, int depth) {
  if (type_name == "num" || type_name == "dnum" || type_name == "byte") return number_value(0);
  if (type_name == "bool") return truth_value(false);
  if (type_name == "string") return text_value("");
  const RecordType* type = code.record(type_name);
  if (!type || depth > 8) return {};
  std::vector<Value> items;
  for (const RecordType* inner : type->types)
    items.push_back(inner ? rapid_initial(code, inner->name, depth + 1) : number_value(0));
  return list_value(std::move(items), type);
}

bool is_harmless_in_rapid(const std::string& instruction) {
  static const pipeline::WordSet names = pipeline::word_set(
      "set reset setdo setgo setao pulsedo invertdo waitdi waitdo waitgi waitgo waitai waitao waituntil waitrob "
      "waitsynctask tpwrite tperase tpreadfk tpreadnum tpreaddnum tpshow uimsgbox uishow uimsgwrite errwrite errlog "
      "errraise bookerrno stop break retry trynext skipwarn open close write writebin writestrbin writerawbytes "
      "writeanybin readrawbytes readanybin readbin packrawbytes unpackrawbytes clearrawbytes packdnheader rewind "
      "clkstart clkstop clkreset trygint bitset bitclear isignaldi isignaldo isignalgi isignalai isleep iwatch "
      "idelete ienable idisable itimer ierror ipers connect triggio triggequip triggint triggcheckio triggspeed "
      "triggstopproc triggramp gripload motsup singarea cirpathmode dynamics resetaxis actunit deactunit confjoff "
      "pathresol softdeact tunereset tuneservo startmove stopmove stopmovereset startmoveretry clearpath storepath "
      "setsysdata unload checkprogref socketcreate socketconnect socketsend socketreceive socketclose socketbind "
      "socketlisten socketaccept rmqfindslot rmqsendmessage rmqempty getsysdata opendir closedir makedir removefile "
      "copyfile timex savecfgdata warmstart spystart spystop egmgetid egmreset egmactjoint egmactpose egmactmove "
      "egmsetupuc egmsetupai egmsetupao egmstop egmstreamstop toolchange setgun calib stcalib stclose stopen indgun "
      "gunopen gunclose");
  return names.contains(instruction);
}

const char* rapid_named_effect(const std::string& instruction) {
  static const std::map<std::string, const char*> effects{
      {unwritten_statement, "no statement is written in this place: the controller stops here"},
      {"raise", "an error that the program raises: the motion continues after it, handlers are not followed"},
      {"syncmoveon", "several robots or positioners move together from here on (MultiMove), only this one is read"},
      {"syncmoveoff", "the end of moves of several robots together (MultiMove), of which only this one is read"},
      {"syncmoveundo", "the end of moves of several robots together (MultiMove), of which only this one is read"},
      {"softact", "axes give way to what pushes them; they are taken to follow their targets"},
      {"worldacclim", "it limits accelerations, which are not held down here"},
      {"pathacclim", "it limits accelerations, which are not held down here"},
      {"restopath", "the robot goes back to a stored path"},
      {"egmrunjoint", "a sensor leads the robot"},
      {"egmrunpose", "a sensor leads the robot"},
      {"egmstreamstart", "a sensor leads the robot"},
      {"corrcon", "a sensor corrects the path"},
      {"corrwrite", "a sensor corrects the path"},
      {"waitwobj", "a conveyor moves the work object, but it is taken to stand still"},
      {"actwobj", "a conveyor moves the work object, but it is taken to stand still"},
      {"load", "it loads a module while the robot runs; give that in motion.modules"},
      {"startload", "it loads a module while the robot runs; give that in motion.modules"},
      {"waitload", "it loads a module while the robot runs; give that in motion.modules"},
      {"setalldataval", "it writes data whose names are not known offline"},
      {"indamove", "an external axis moves by itself"},
      {"indcmove", "an external axis moves by itself"},
      {"inddmove", "an external axis moves by itself"},
      {"indrmove", "an external axis moves by itself"},
      {"moveextj", "external axes move, the robot does not"},
      {"searchextj", "external axes move, the robot does not"},
      {"fcact", "forces lead the robot"},
      {"fcpress1lstart", "forces lead the robot"},
      {"fcpressl", "forces lead the robot"}};
  const auto found = effects.find(instruction);
  return found == effects.end() ? nullptr : found->second;
}

}  // namespace dresslife::sim
