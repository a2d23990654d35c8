#include "pipeline/job/inspection.h"

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

void describe(Fields& f, Inspection& inspection) {
  f.number(
      "interval_weeks", inspection.interval_weeks, Need::optional, between(0, 1000),
      "The weeks between two visual checks of the dresspack. 0: none. Default: what a maker asks for on the upper arm "
      "(ABB, DressPack of the IRB 5710, product manual, section 4.2.1).");
  f.number(
      "found_percent", inspection.found_percent, Need::optional, between(0, 100),
      "The share of visible damage that one check finds. Checks are taken as independent. Default: inspectors in industry miss "
      "20 to 30 % (Drury and Fox 1975).");
  f.number(
      "visible_depth_percent", inspection.visible_depth_percent, Need::optional, between(0, 100),
      "The worn share of the thickness of the hose's wall or sleeve at which a check can see abrasion. ESTIMATE. Broken wires "
      "and cracks of the wall are not visible before they count as failures.");
}

}  // namespace dresslife::pipeline
