#include "pipeline/resolve/data_sheet.h"

#include <fmt/format.h>
#include <cmath>
#include <limits>
#include <map>

#include "pipeline/base/constants.h"
#include "pipeline/base/text.h"
#include "pipeline/cable/overlap.h"
#include "pipeline/job/dresspack.h"
#include "pipeline/settings/fields.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife;
using namespace dresslife::pipeline;

namespace {

constexpr double straight = std::numeric_limits<double>::infinity();

int count_of(const std::vector<CoreRing>& rings) {
  int count = 0;
  for (const CoreRing& ring : rings) count += ring.count;
  return count;
}

std::string sheet_text(const std::string& keys) {
  return "name: hose\nsource: test\ncomponents:\n  - name: cable\n    helix_radius_mm: 0\n    data_sheet: {" + keys +
         "}\n";
}

struct Cables {
  std::vector<Component> components;
};
void describe(Fields& f, Cables& cables) { f.list("components", cables.components, Need::required, ""); }

Component cable_of(const std::string& keys) {
  Node dresspack = parse_yaml(sheet_text(keys), "pack.yaml");
  expand_data_sheets(dresspack);
  Cables cables;
  std::erase_if(dresspack.entries, [](const Entry& entry) { return entry.key != "components"; });
  read_fields(dresspack, cables);
  return cables.components.front();
}

std::string refusal_of(const std::string& keys) {
  return message_of([&] { cable_of(keys); });
}

double wire_area(const Component& part) {
  if (part.components.empty()) return part.count * pi * part.radius * part.radius;
  double area = 0;
  for (const Component& inner : part.components) area += wire_area(inner);
  return part.count * area;
}

const std::string seven =
    "cores: 7, cross_section_mm2: 0.5, wire_diameter_mm: 0.1, outer_diameter_mm: 8.2, "
    "jacket_thickness_mm: 1.1, lay_length_mm: 60";

}  // namespace

TEST_CASE("cores are packed as narrowly as the standard for their bundles says") {
  // IEC 60502-1, table A.2: width of n cores / width of one. Where a ring is not full the table is too wide on purpose, by up to
  // 10 % (nine cores: 4, but eight around one need 3.61). It is rounded up to two digits.
  const std::map<int, double> standard{{2, 2},     {3, 2.16}, {4, 2.42}, {5, 2.7},   {6, 3},     {7, 3.35},  {8, 3.66},
                                       {9, 4},     {10, 4},   {11, 4},   {12, 4.16}, {13, 4.41}, {14, 4.41}, {15, 4.7},
                                       {16, 4.7},  {17, 5},   {18, 5},   {19, 5},    {20, 5.33}, {21, 5.33}, {22, 5.67},
                                       {23, 5.67}, {24, 6},   {25, 6},   {26, 6},    {27, 6.15}};
  for (const auto& [count, width] : standard) {
    const auto rings = packed(count, 1, straight, Fillers::allowed, {});
    CAPTURE(count);
    CHECK(count_of(rings) == count);
    CHECK(width_of(rings, 1) < width + 0.005);
    CHECK(width_of(rings, 1) > 0.895 * width);
  }
  // Full rings have closed forms: one, three, four, five in the middle, and rings around them.
  CHECK(width_of(packed(19, 1, straight, Fillers::allowed, {}), 1) == Approx(5));
  CHECK(width_of(packed(12, 1, straight, Fillers::allowed, {}), 1) == Approx(3 + 2 / std::sqrt(3.0)));
  CHECK(width_of(packed(14, 1, straight, Fillers::allowed, {}), 1) == Approx(3 + std::sqrt(2.0)));
}

TEST_CASE("no two parts of a bundle overlap, whatever their number and lay") {
  for (const double lay_length : {straight, 60.0, 40.0})
    for (int count = 1; count <= 90; ++count)
      for (const Fillers fillers : {Fillers::none, Fillers::allowed}) {
        CAPTURE(count, lay_length);
        const auto rings = packed(count, 1, lay_length, fillers, {});
        CHECK(count_of(rings) == count);
        double inner = -1;
        for (const CoreRing& ring : rings) {
          CHECK(ring.radius >= inner + 1 - 1e-9);
          if (ring.count > 1) CHECK(neighbour_distance(ring.radius, ring.lay_angle, ring.count) >= 1 - 1e-8);
          if (!std::isinf(lay_length)) CHECK(std::tan(ring.lay_angle) == Approx(2 * pi * ring.radius / lay_length));
          inner = ring.radius;
        }
        // Wires leave no gap in their middle that another wire would fit into.
        if (fillers == Fillers::none && std::isinf(lay_length)) CHECK(rings.front().radius < 1);
      }
}

TEST_CASE("a data sheet's numbers come back from the layers it stands for") {
  const Component cable = cable_of(seven);
  CHECK(cable.radius == Approx(4.1e-3));
  REQUIRE(cable.components.size() == 2);  // one in the middle, six around it
  const Component &outer = cable.components[0], &middle = cable.components[1];
  CHECK(outer.count == 6);
  CHECK(middle.count == 1);
  CHECK(middle.helix_radius == 0);
  CHECK(outer.hand == Hand::left);
  CHECK(std::tan(outer.lay_angle) == Approx(2 * pi * outer.helix_radius / 60e-3));
  CHECK(outer.helix_radius + outer.radius == Approx(3e-3));  // 8.2 / 2 - 1.1 mm
  // Stranding tables give 64 wires of 0.1 mm for 0.5 mm2. The metal area agrees with the sheet to within one wire.
  CHECK(wire_area(cable) == Approx(7 * 64 * pi / 4 * 0.01e-6));
  for (const Component& wires : outer.components) {
    CHECK(wires.hand == Hand::right);
    CHECK(wires.material == "copper_halved");
    CHECK(wires.helix_radius + wires.radius <= outer.radius);
  }
}

TEST_CASE("pairs are twisted before they are laid") {
  const Component cable = cable_of(
      "cores: 4, cores_per_group: 2, cross_section_mm2: 0.25, wire_diameter_mm: 0.1, outer_diameter_mm: 8, "
      "core_diameter_mm: 1.2, group_lay_length_mm: 25");
  REQUIRE(cable.components.size() == 1);
  const Component& pair = cable.components.front();
  CHECK(pair.name == "pair");
  CHECK(pair.count == 4);
  CHECK(pair.radius == Approx(1.2e-3));
  REQUIRE(pair.components.size() == 1);
  CHECK(pair.components[0].name == "core");
  CHECK(pair.components[0].count == 2);
  CHECK(std::tan(pair.components[0].lay_angle) == Approx(2 * pi * 0.6e-3 / 25e-3));
  CHECK(wire_area(cable) == Approx(8 * 0.25e-6).epsilon(0.02));  // 32 wires of 0.1 mm have 0.2513 mm2
}

TEST_CASE("a sheet's line is what its keys are") {
  const auto expanded = [](const std::string& sheet) {
    Node dresspack = parse_yaml("components: [{name: cable, helix_radius_mm: 0}]\n", "pack.yaml");
    dresspack["components"].items[0]["data_sheet"] = parse_yaml(sheet, "sheet");
    expand_data_sheets(dresspack);
    return to_yaml(dresspack);
  };
  CHECK(expanded("7 x 0.5 mm2, class 6, wire 0.1 mm, lay length 60 mm, outer diameter 8.2 mm, jacket PUR 1.1 mm") ==
        expanded("{" + seven + ", jacket_material: polyurethane}"));
  CHECK(expanded("7 x 0.5 mm2, class 6, wire 0.1 mm, lay length 60 mm, outer diameter 8.2 mm, jacket PE 1.1 mm") ==
        expanded("{" + seven + "}"));
  CHECK(
      expanded(
          "4x2x0.25mm², Wire 0.1 mm, pair lay 25 mm, wire lay length 12 mm, core 1.2 mm, OD 9 mm, jacket 0.9 mm TPU") ==
      expanded(
          "{cores: 4, cores_per_group: 2, cross_section_mm2: 0.25, wire_diameter_mm: 0.1, group_lay_length_mm: 25, "
          "wire_lay_length_mm: 12, core_diameter_mm: 1.2, outer_diameter_mm: 9, jacket_thickness_mm: 0.9, "
          "jacket_material: polyurethane}"));
  const auto refusal = [&](const std::string& sheet) { return message_of([&] { expanded(sheet); }); };
  CHECK_THAT(refusal("7 x 0.5 mm2, wire 0.1 mm, outer diameter 8.2 mm, jacket PURR 1.1 mm"),
             Catch::Contains("material 'purr' of a data sheet is not known") && Catch::Contains("the thickness alone"));
  CHECK_THAT(refusal("7 x 0.5 mm2, wire 0.1 mm, outer diameter 8.2 mm, jacket PURR"),
             Catch::Contains("material 'purr'"));
  CHECK_THAT(refusal("7 x 0.5 mm2, wire 0.1 mm, outer diameter 8.2 mm, jacket 1.1 mm PURR"),
             Catch::Contains("material 'purr'"));
  CHECK(refusal("7 x 0.5 mm2, wire 0.1 mm, outer diameter 8.2 mm, jacket thickness 1.1 mm") == "");
  CHECK_THAT(refusal("7 x 0.5 mm2, weight ... kg/km"), Catch::Contains("kg/km' of a data sheet is not understood"));
  CHECK_THAT(refusal("4 x AWG " + std::string(400, '2')), Catch::Contains("write 'CORES x N mm2'"));
  CHECK_THAT(refusal(std::string(60'000, 'a')), Catch::Contains("data_sheet has 60000 bytes (at most 2000)"));
  // Six cores around one of 1.8 mm are 5.4 mm wide, and a little more by their lay. The jacket has the rest.
  const Node rest = parse_yaml(expanded("7 x 0.5 mm2, core diameter 1.8 mm, OD 8.2 mm, jacket PUR"), "pack.yaml");
  const Node* const sheath = rest.find("components")->items[0].find("jacket");
  REQUIRE(sheath);
  CHECK(std::stod(sheath->find("thickness_mm")->text) == Approx((8.2 - 5.4) / 2).margin(0.05));
  CHECK_THAT(
      refusal("7 x 0.5 mm2, sausage, wire 0.1 mm"),
      Catch::Contains("'sausage' of a data sheet is not understood") && Catch::Contains("dresslife manual data_sheet"));
  // A jacket's material without its thickness, and words without effect.
  const std::string by_rules =
      expanded("{cores: 7, cross_section_mm2: 0.5, outer_diameter_mm: 8.2, jacket_material: polyurethane}");
  for (const char* jacket : {"jacket PUR", "PUR jacket", "outer sheath PUR", "PUR"})
    CHECK(expanded(std::string("7 x 0.5 mm2, OD 8.2 mm, ") + jacket) == by_rules);
  Node shop = parse_yaml(
      "components:\n  - {name: lead, helix_radius_mm: 0, data_sheet: '7 x 0.5 mm2, shielded, highly flexible, OD 8.2 mm, jacket PUR, "
      "UL 20276, 300 V, drag chain, halogen-free, copper braid 85 %, -40 to 80 C, jacket rubber'}\n",
      "pack.yaml");
  expand_data_sheets(shop);
  CHECK_THAT(
      shop.find("estimates")->text,
      Catch::EndsWith(
          ", without effect: highly flexible, ul 20276, 300 v, drag chain, halogen-free, -40 to 80 c, jacket rubber, shielded, "
          "copper braid 85 %: the shield's wires are not evaluated, and its thickness counts as that of the jacket"));
  // A shield without a comma.
  const auto estimates_of = [](const std::string& sheet) {
    Node pack =
        parse_yaml("components:\n  - {name: lead, helix_radius_mm: 0, data_sheet: '" + sheet + "'}\n", "pack.yaml");
    expand_data_sheets(pack);
    return pack.find("estimates")->text;
  };
  for (const char* words :
       {"shielded", "screened", "(C)", "with copper braid", "tinned copper braided", "overall foil screen"}) {
    const std::string beside = estimates_of(std::string("4x2x0.25 mm2 ") + words + ", jacket PUR");
    CHECK_THAT(beside, Catch::Contains(lower_case(words) + ": the shield's wires are not evaluated"));
    CHECK(beside == estimates_of(std::string("4x2x0.25 mm2, ") + words + ", jacket PUR"));
  }
  CHECK_THAT(estimates_of("4x2x0.25 mm2 unshielded"), Catch::EndsWith("without effect: unshielded"));
  // The examples of the manual.
  const std::string syntax = sheet_syntax();
  int examples = 0;
  for (std::size_t at = 0; (at = syntax.find("data_sheet: ", at)) != std::string::npos; ++examples) {
    at += std::string_view("data_sheet: ").size();
    CHECK_NOTHROW(expanded(syntax.substr(at, syntax.find('\n', at) - at)));
  }
  CHECK(examples == 2);
  // Words that belong to other keys.
  CHECK_THAT(refusal("7 x 0.5 mm2, min. bending radius 82 mm"),
             Catch::Contains("give the dresspack least_bend_radius_mm: 82 "));
  CHECK_THAT(refusal("7 x 0.5 mm2, bend radius 10 x d"),
             Catch::Contains("give the dresspack least_bend_radius_mm in mm"));
  CHECK_THAT(refusal("7 x 0.5 mm2, weight 65 kg/km"), Catch::Contains("give mass_kg_per_m: 0.065 beside data_sheet"));
  CHECK_THAT(refusal("7 x 0.5 mm2, 5 million cycles"), Catch::Contains("as ratings beside data_sheet"));
  // The conductor's diameter given as the wire's.
  CHECK_THAT(refusal("4 x 0.25 mm2, wire 0.5 mm, OD 5 mm, jacket 0.8 mm"),
             Catch::Contains("0.25 mm2 are 1 wire of 0.5 mm (flexible conductors have 7 and more)") &&
                 Catch::Contains("wire_diameter_mm: 0.1"));
  CHECK_THAT(refusal("7 x 0.5 mm2, wire 0.1 mm, wires 0.1 mm"),
             Catch::Contains("gives wire_diameter_mm a second time"));
  CHECK_THAT(refusal("7 x 0.5 mm2, wire 0.1 mm, jacket 1 mm"),
             Catch::Contains("data_sheet has no outer_diameter_mm; give it, or conductor_class"));
  CHECK_THAT(refusal("7 x 0.5 mm2, wire 1.2.3 mm, jacket 1 mm"), Catch::Contains("sheet:1:1: error: "));
  // All words that are not understood are reported at once.
  CHECK_THAT(refusal("7 x 0.5, sausage, wire 0.1 mm"),
             Catch::Contains("write '7 x 0.5 mm2'") && Catch::Contains("'sausage' of a data sheet is not understood"));
}

TEST_CASE("a data sheet whose cores have no insulation is refused") {
  // 7 x 0.5 mm2 of class 6 is a conductor of 0.95 mm.
  const Component cable = cable_of("cores: 1, cross_section_mm2: 0.5, conductor_class: 6, core_diameter_mm: 1.4");
  const double conductor =
      2e3 * (cable.components[0].components[0].helix_radius + cable.components[0].components[0].radius);
  CHECK_THAT(refusal_of(fmt::format("cores: 7, cross_section_mm2: 0.5, conductor_class: 6, core_diameter_mm: {:.4f}",
                                    conductor + 0.004)),
             Catch::Contains("leaves 0.002") && Catch::Contains(" mm of insulation around its conductor"));
}

TEST_CASE("a data sheet's line may have decimal commas") {
  const auto line_of = [](const std::string& text) { return parse_yaml("'" + text + "'", "sheet"); };
  CHECK(to_yaml(sheet_from_line(line_of("4 x 2 x 0,25 mm2,class 6,wire 0,1 mm, OD 9,5 mm,jacket PUR 1,1 mm"))) ==
        to_yaml(sheet_from_line(line_of("4 x 2 x 0.25 mm2, class 6, wire 0.1 mm, OD 9.5 mm, jacket PUR 1.1 mm"))));
  CHECK(to_yaml(sheet_from_line(line_of("class 6,12 x 0,25 mm2"))) ==
        to_yaml(sheet_from_line(line_of("class 6, 12 x 0.25 mm2"))));
  CHECK_THAT(message_of([&] { sheet_from_line(line_of("12 x 0,25")); }), Catch::Contains("write '12 x 0.25 mm2'"));
  CHECK(to_yaml(sheet_from_line(line_of("4x2,5 mm2, class 6"))) ==
        to_yaml(sheet_from_line(line_of("4 x 2.5 mm2, class 6"))));
}

TEST_CASE("a data sheet's line takes the sections of shops, and proposes what others mean") {
  const auto text = [](const std::string& line) {
    return to_yaml(sheet_from_line(parse_yaml("'" + line + "'", "sheet")));
  };
  for (const char* four : {"4G2.5", "4G2,5", "4 G 2.5 mm2", "4x2.5qmm", "4 X 2,5 mm²"}) {
    CAPTURE(four);
    CHECK(text(four) == text("4 x 2.5 mm2"));
  }
  CHECK(text("4x(2x0.25) mm2") == text("4 x 2 x 0.25 mm2"));
  CHECK(text("12 x 0,75 mm² geschirmt, Klasse 6, Außendurchmesser 12,5 mm, Mantel PUR 1,1 mm, Schlaglänge 60 mm") ==
        text("12 x 0.75 mm2 shielded, class 6, outer diameter 12.5 mm, jacket PUR 1.1 mm, lay length 60 mm"));
  CHECK(text("18G1.0 class 6") == text("18 x 1.0 mm2, class 6"));
  CHECK(text("4 x 2 x 0.25 mm2 shielded class 5") == text("4 x 2 x 0.25 mm2, shielded, class 5"));
  CHECK(text("2 x 1 mm2, ungeschirmt") == text("2 x 1 mm2, unshielded"));
  const auto refused = [&](const std::string& line) { return message_of([&] { text(line); }); };
  CHECK_THAT(refused("2.5 x 4 mm2"), Catch::Contains("write '4 x 2.5 mm2': the number of cores comes first"));
  CHECK_THAT(refused("5 x 1 mm2, 14.5 mm"), Catch::Contains("write 'outer diameter 14.5 mm'"));
  CHECK_THAT(refused("4 x 2.5 mm"), Catch::Contains("write '4 x 2.5 mm2'"));
  CHECK_THAT(refused("4x2x0.25 shielded"), Catch::Contains("write '4x2 x 0.25 mm2'"));
  CHECK_THAT(refused("4x2.5 + 2x(2x0.5) mm2"),
             Catch::Contains("a data sheet has one kind of cores: write '4x2.5 mm2' alone"));
  CHECK_THAT(refused("hybrid servo cable 4x1.5 mm2 + 2x0.75 mm2"),
             Catch::Contains("write '4x1.5 mm2' alone (the other cores have no life then)"));
  CHECK_THAT(refused("5 x 1 mm2, Ø 14.5 mm"), Catch::Contains("write 'outer diameter 14.5 mm'"));
  CHECK_THAT(refused("32 x 0.1 mm"), Catch::Contains("or 'wire 0.1 mm' if those are the wires of a core"));
  for (const char* pairs : {"4x2xAWG26/7", "4 x (2 x AWG 26/7) shielded", "4x2x26AWG/7"})
    CHECK_THAT(refused(pairs), Catch::Contains("write '4 x 2 x 0.129 mm2, wire 0.153 mm' for AWG 26 of 7 wires"));
  CHECK_THAT(refused("4x2xAWG26"), Catch::Contains("write '4 x 2 x 0.129 mm2' for AWG 26"));
  for (const char* gauge : {"AWG26", "26 AWG", "26AWG"})
    CHECK_THAT(refused(gauge), Catch::Contains("write 'CORES x 0.129 mm2' for AWG 26, with the number of cores"));
  CHECK_THAT(refused("3 x AWG 1/0"), Catch::Contains("write 'CORES x N mm2' with the number of cores"));
  CHECK_THAT(refused("4G AWG 14"), Catch::Contains("write '4 x 2.08 mm2' for AWG 14"));
  CHECK_THAT(refused("4 x 2.5 mm2, wire 0.1"),
             Catch::Contains("'wire 0.1' of a data sheet is not understood; write 'wire 0.1 mm'"));
}

TEST_CASE("a conductor's class stands in for what a sheet leaves out, and the source says so") {
  struct Strand {
    int conductor_class;
    double section;
    int wires;
    double wire;  // [mm]
  };
  // Strands in makers' lists by IEC 60228 (and VDE 0812 below 0.5 mm2).
  const Strand strands[] = {{5, 0.5, 16, 0.20},  {5, 0.75, 24, 0.20}, {5, 1, 32, 0.20},    {5, 1.5, 30, 0.25},
                            {5, 2.5, 50, 0.25},  {5, 4, 56, 0.30},    {5, 6, 84, 0.30},    {5, 10, 80, 0.40},
                            {5, 16, 128, 0.40},  {5, 25, 200, 0.40},  {6, 0.14, 18, 0.10}, {6, 0.5, 28, 0.15},
                            {6, 0.75, 42, 0.15}, {6, 1, 56, 0.15},    {6, 1.5, 84, 0.15},  {6, 2.5, 140, 0.15},
                            {6, 4, 224, 0.15},   {6, 6, 192, 0.20},   {6, 10, 320, 0.20}};
  for (const Strand& strand : strands) {
    CAPTURE(strand.conductor_class, strand.section);
    const Component cable = cable_of(
        fmt::format("cores: 3, cross_section_mm2: {}, conductor_class: {}", strand.section, strand.conductor_class));
    const Component& wires = cable.components[0].components[0];
    CHECK(wires.radius == Approx(strand.wire / 2e3));
    int count = 0;
    for (const Component& layer : cable.components[0].components) count += layer.count;
    CHECK(count == Approx(strand.wires).epsilon(0.03).margin(1));  // makers round to suit their machines
  }
  // From the inside outward: H05VV5-F 3 x 1.5 has cores of 3.1 mm (1.7 and 2 x 0.7) and is about 8.2 .. 9.3 mm wide.
  const Component control = cable_of("cores: 3, cross_section_mm2: 1.5, conductor_class: 5");
  CHECK(2e3 * control.components[0].radius == Approx(3.1).epsilon(0.05));
  CHECK(2e3 * control.radius == Approx(8.8).epsilon(0.07));
  // From the outside inward: the jacket of the shipped control cable is 1.1 mm.
  const Component known = cable_of("cores: 7, cross_section_mm2: 0.5, conductor_class: 6, outer_diameter_mm: 8.2");
  CHECK(1e3 * (known.radius - known.components[0].helix_radius - known.components[0].radius) ==
        Approx(1.2).epsilon(0.05));

  Node dresspack = parse_yaml(
      "name: p\nsource: mine\ncomponents:\n  - {name: lead, helix_radius_mm: 0, data_sheet: '7 x 0.5 mm2, class 6'}\n"
      "  - {name: other, helix_radius_mm: 9, data_sheet: {" +
          seven + "}}\n",
      "pack.yaml");
  expand_data_sheets(dresspack);
  const std::string& source = dresspack.find("source")->text;
  CHECK_THAT(source, Catch::StartsWith("mine ESTIMATE by rules: lead wire 0.15 mm, core ") &&
                         Catch::Contains("jacket ") && Catch::Contains("outer diameter ") && !Catch::Contains("other"));
  CHECK_THAT(refusal_of("cores: 3, cross_section_mm2: 0.5, conductor_class: 2, outer_diameter_mm: 8"),
             Catch::Contains("classes 1 to 4 of IEC 60228 are for cables that lie still"));
  CHECK_THAT(refusal_of("cores: 3, cross_section_mm2: 0.5, conductor_class: 7"),
             Catch::Contains("conductor_class is 7"));
  CHECK_THAT(refusal_of("cores: 1, cross_section_mm2: 400, conductor_class: 6"),
             Catch::Contains("no conductor of class 6 so large"));
  CHECK_THAT(
      refusal_of("cores: 3, cross_section_mm2: 0.5, conductor_class: 6, wire_diameter_mm: 0.2, outer_diameter_mm: 8"),
      Catch::Contains("class 6 has wires of 0.16 mm at most at 0.5 mm2"));
  // Without class and wire diameter, class 6 is assumed, and the source states this.
  const Component assumed = cable_of("cores: 3, cross_section_mm2: 0.5, outer_diameter_mm: 8, jacket_thickness_mm: 1");
  CHECK(assumed.components[0].components[0].radius == Approx(0.15 / 2e3));
  Node pack = parse_yaml(
      "name: p\nsource: mine\ncomponents:\n  - {name: lead, helix_radius_mm: 0, data_sheet: '12 x 0.25 mm2'}\n",
      "pack.yaml");
  expand_data_sheets(pack);
  CHECK_THAT(pack.find("source")->text, Catch::Contains("ESTIMATE by rules: lead conductor class 6, wire "));
  CHECK_THAT(pack.find("estimates")->text, Catch::StartsWith("data_sheet of lead: conductor_class 6") &&
                                               Catch::Contains(", wire_diameter_mm 0.1, ") &&
                                               Catch::Contains("wire_lay_length_mm ") &&
                                               Catch::EndsWith("material copper_halved"));
  // A complete sheet contains no estimates.
  Node full = parse_yaml(
      "components:\n  - {name: lead, helix_radius_mm: 0, data_sheet: {cores: 7, cross_section_mm2: 0.5, wire_diameter_mm: 0.1, "
      "lay_length_mm: 60, wire_lay_length_mm: 15, outer_diameter_mm: 8.2, jacket_thickness_mm: 1.1, material: copper}}\n",
      "pack.yaml");
  expand_data_sheets(full);
  CHECK_FALSE(full.find("estimates"));
}

TEST_CASE("sheets that cannot be are refused with what does not fit") {
  const auto with = [](std::string keys, const std::string& from, const std::string& to) {
    return keys.replace(keys.find(from), from.size(), to);
  };
  CHECK_THAT(refusal_of(with(seven, "0.5,", "5,")),
             Catch::Contains("pack.yaml:6:") && Catch::Contains("637 wires of 0.1 mm are a conductor"));
  CHECK_THAT(refusal_of(with(seven, "diameter_mm: 0.1", "diameter_mm: 2")),
             Catch::Contains("are 0.1592 wires (1 .. 5000)"));
  CHECK_THAT(refusal_of(with(seven, "thickness_mm: 1.1", "thickness_mm: 4.1")), Catch::Contains("leaves no room"));
  CHECK_THAT(refusal_of(with(seven, "jacket_thickness_mm: 1.1, ", "")), Catch::Contains("neither core_diameter_mm"));
  CHECK_THAT(refusal_of(seven + ", core_diameter_mm: 2.5"), Catch::Contains("the cores make a bundle 7.6"));
  CHECK_THAT(refusal_of(with(seven, "lay_length_mm: 60", "lay_length_mm: 2")), Catch::Contains("give a longer lay"));
  CHECK_THAT(refusal_of(with(seven, "cores: 7", "cores: 0")), Catch::Contains("cores is 0"));
  CHECK_THAT(refusal_of(with(seven, "lay_length_mm: 60", "lay: 60")), Catch::Contains("lay"));
  CHECK_THAT(refusal_of(seven + "}\n    radius_mm: 4\n    phase_deg: 0 #"),
             Catch::Contains("both data_sheet and radius_mm"));
}
