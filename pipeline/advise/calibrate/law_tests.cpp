#include "pipeline/advise/calibrate/law_tests.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/statistics.h"
#include "pipeline/cable/cable_bending.h"
#include "pipeline/cable/kink.h"
#include "pipeline/job/uncertainty.h"
#include "pipeline/resolve/catalogue.h"
#include "pipeline/resolve/document_kind.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

void describe(Fields& f, TubeTest& test) {
  f.number("outer_mm", test.outer, Need::required, above(0), "The outer diameter of the tube.");
  f.number("bore_mm", test.bore, Need::required, above(0), "The inner diameter of the tube.");
  f.maybe_number("kinks_at_mm", test.kinks_at, above(0), "The radius of the tube's axis at which it kinked.");
  f.maybe_number("oval_at_mm", test.oval_at, above(0),
                 "The radius of the axis at which the diameter had changed by oval_share.");
  f.maybe_number("allowed_at_mm", test.allowed_at, above(0), "The least radius of the axis that the maker allows.");
  f.number("oval_share", test.oval_share, Need::optional, between(0.001, 0.2),
           "The change of the diameter over the diameter.");
}

void describe(Fields& f, WearTest& test) {
  f.text("material", test.material, Need::required, "A material of config/materials with wear rates.");
  f.choice("against", test.against, "What rubs.");
  f.number("force_N", test.force, Need::required, above(0), "The normal force.");
  f.number("way_m", test.way, Need::required, above(0), "The way.");
  f.maybe_number("worn_mm3", test.worn, above(0), "The volume that was worn off.");
  f.maybe_number("worn_by_rougher_mm3", test.worn_more, above(0),
                 "The volume that something rougher than `against` wore off. The law must say less.");
}

void describe(Fields& f, BendingTest& test) {
  f.number("curvature_1_per_m", test.curvature, Need::required, above(0), "The curvature to which the cable was bent.");
  f.number("moment_mNm", test.moment, Need::required, above(0), "The moment that bent it.");
}

void describe(Fields& f, LawTest& test) {
  f.place(test.where);
  f.text("name", test.name, Need::required, "A short name.");
  f.text("what", test.what, Need::required, "What was done to what, in words.");
  f.text("source", test.source, Need::required, "The source of the test.");
  f.boolean("sets_constant", test.sets_constant, Need::optional, "Whether a constant of the law comes from this test.");
  f.maybe_group("tube", test.tube, "A tube that was bent.");
  f.maybe_group("wear", test.wear, "A surface that was rubbed.");
  f.maybe_group("bending", test.bending, "A cable that was bent.");
}

namespace {

constexpr const char* key = "law_tests";

void check(const LawTest& test) {
  if (test.tube.has_value() + test.wear.has_value() + test.bending.has_value() != 1)
    throw InputError(test.where, fmt::format("'{}' must have one of tube, wear and bending", test.name), "give one");
  const int radii =
      test.tube ? test.tube->kinks_at.has_value() + test.tube->oval_at.has_value() + test.tube->allowed_at.has_value()
                : 1;
  const int volumes = test.wear ? test.wear->worn.has_value() + test.wear->worn_more.has_value() : 1;
  if (radii != 1)
    throw InputError(test.where, fmt::format("'{}' must have one of kinks_at_mm, oval_at_mm, allowed_at_mm", test.name),
                     "give one");
  if (volumes != 1)
    throw InputError(test.where, fmt::format("'{}' must have one of worn_mm3, worn_by_rougher_mm3", test.name),
                     "give one");
  if (test.tube && test.tube->bore >= test.tube->outer)
    throw InputError(test.where,
                     fmt::format("'{}' has bore_mm {:.4g} (outer_mm is {:.4g})", test.name, 1e3 * test.tube->bore,
                                 1e3 * test.tube->outer),
                     "the bore is the inner diameter");
}

LawPrediction lognormal(double median, double log10_spread) {
  const double factor = std::pow(10.0, log10_spread * normal_quantile(0.9));
  return {median / factor, median, median * factor};
}

LawPrediction predicted(const TubeTest& test) {
  const Tube tube{test.outer, test.bore};
  const KinkRadius kinks = kink_radius(tube);
  if (!test.oval_at) return lognormal(kinks.median, kinks.log10_spread);
  return lognormal(std::sqrt(tube.ovality(1) / test.oval_share), kinks.log10_spread);
}

LawPrediction predicted(const WearTest& test, const Where& where) {
  Material material;
  const Node entry = catalogue_entry("materials", test.material, where, where);
  read_fields(entry, material);
  const WearRate* const rate = find_in(material.wear, &WearRate::against, test.against);
  if (!rate)
    throw InputError(where, fmt::format("material '{}' has no wear rate against {}", test.material, word(test.against)),
                     "give a pair that the material lists under wear");
  return lognormal(rate->rate * test.force * test.way, std::log10(rate->factor));
}

/// Only the friction is uncertain without a measurement; polymer and wires have the values of the construction.
LawPrediction predicted(const BendingTest& test) {
  const auto moment = [&](double share) {
    const UncertainParameter& friction = uncertain_parameters()[index_of(Uncertain::friction_inside)];
    return bending_moments(test.cable, test.cable.components.front(), friction.value(normal_quantile(share)),
                           {test.curvature})
        .front();
  };
  return {moment(0.1), moment(0.5), moment(0.9)};
}

/// Removes the cable from a row of the document and returns it, resolved as in a job.
Dresspack take_cable(Node& row) {
  Node* const bending = row.is_map() ? row.find("bending") : nullptr;
  const Node* const cable = bending && bending->is_map() ? bending->find("cable") : nullptr;
  if (!bending) return {};
  if (!cable) throw InputError(bending->where, "bending has no cable", "give it as in the key dresspack of a job");
  Node job;
  job.where = cable->where;
  job["dresspack"]["cable"] = *cable;
  std::erase_if(bending->entries, [](const Entry& entry) { return entry.key == "cable"; });
  resolve_job(job);
  Dresspack dresspack;
  read_fields(*job.find("dresspack"), dresspack);
  check_dresspack(dresspack, {Slip::friction});
  if (!has_wires(dresspack))
    throw InputError(dresspack.where, "bending.cable has no wires", "give its data_sheet, or components with wires");
  return dresspack;
}

struct Observed {
  double value = 0;
  bool bounds_above = true, bounds_below = true;  ///< the law must not exceed the value, must not be below it
  double unit = 1;
  const char* words = "";
};

Observed observed_in(const LawTest& test) {
  if (test.wear) {
    const bool bound = test.wear->worn_more.has_value();
    return {bound ? *test.wear->worn_more : *test.wear->worn, true, !bound, 1e9,
            bound ? "mm3 by something rougher" : "mm3"};
  }
  if (test.bending) return {test.bending->moment, true, true, 1e3, "mN m"};
  if (test.tube->kinks_at) return {*test.tube->kinks_at, true, true, 1e3, "mm, kinked"};
  if (test.tube->oval_at) return {*test.tube->oval_at, true, true, 1e3, "mm, oval"};
  return {*test.tube->allowed_at, true, false, 1e3, "mm, allowed by its maker"};
}

}  // namespace

bool holds_law_tests(const std::filesystem::path& file) {
  const Node document = read_yaml(file);
  return document.is_map() && document.find(key);
}

std::vector<LawTest> read_law_tests(const std::filesystem::path& file) {
  Node document = read_yaml(file);
  struct {
    std::vector<LawTest> tests;
  } all;
  std::vector<Dresspack> cables;
  if (Node* const rows = document.is_map() ? document.find(key) : nullptr)
    for (Node& row : rows->items) cables.push_back(take_cable(row));
  read_fields(document, [&](Fields& f) { f.list(key, all.tests, Need::required, "Published tests of laws."); });
  if (all.tests.empty())
    throw InputError(document.where, "holds no law_tests",
                     "write a list of rows with name, what, source, and tube, wear or bending");
  for (std::size_t k = 0; k < all.tests.size(); ++k) {
    check(all.tests[k]);
    if (all.tests[k].bending) all.tests[k].bending->cable = std::move(cables[k]);
  }
  return all.tests;
}

LawPrediction predicted(const LawTest& test) {
  if (test.bending) return predicted(*test.bending);
  return test.tube ? predicted(*test.tube) : predicted(*test.wear, test.where);
}

std::string verdict_of(const LawTest& test, const LawPrediction& prediction) {
  const Observed observed = observed_in(test);
  std::string verdict = "agrees";
  if (observed.bounds_above && prediction.low > observed.value)
    verdict = fmt::format("MISS: too large by {}", readable(prediction.low / observed.value, 2));
  else if (observed.bounds_below && prediction.high < observed.value)
    verdict = fmt::format("MISS: too small by {}", readable(observed.value / prediction.high, 2));
  else if (!observed.bounds_below && prediction.median > observed.value)
    verdict = "open";
  return test.sets_constant ? verdict + " (sets a constant)" : verdict;
}

std::string law_table(const std::vector<LawTest>& tests) {
  std::string text = "| test | what | observed | predicted, median | 10 .. 90 % | |\n|---|---|---|---|---|---|\n";
  int misses = 0, agreements = 0, own = 0;
  for (const LawTest& test : tests) {
    const LawPrediction prediction = predicted(test);
    const Observed observed = observed_in(test);
    const std::string verdict = verdict_of(test, prediction);
    own += test.sets_constant;
    if (!test.sets_constant) misses += verdict.starts_with("MISS"), agreements += verdict.starts_with("agrees");
    const auto shown = [&](double value) { return readable(observed.unit * value, 2); };
    text += fmt::format("| {} | {} | {} {} | {} | {} .. {} | {} |\n", test.name, test.what,
                        readable(observed.unit * observed.value, 3), observed.words, shown(prediction.median),
                        shown(prediction.low), shown(prediction.high), verdict);
  }
  const int independent = static_cast<int>(tests.size()) - own;
  return text +
         fmt::format("\nOf {} tests that set no constant {} agree and {} miss.\n", independent, agreements, misses);
}

}  // namespace dresslife::pipeline
