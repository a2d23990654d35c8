#include "pipeline/resolve/document_kind.h"

#include <fmt/format.h>

namespace dresslife::pipeline {
namespace {

struct KeyOfKind {
  DocumentKind kind;
  std::string_view key;  ///< top-level key that only this kind has
  const char *name, *use;
};

constexpr KeyOfKind known[] = {
    {DocumentKind::study, "base", "study", "give it to dresslife run, improve or reprogram"},
    {DocumentKind::job, "routing", "job", "give it to dresslife run, check, preview or route"},
    {DocumentKind::job, "dresspack", "job", "give it to dresslife run, check, preview or route"},
    {DocumentKind::job, "dresspacks", "job", "give it to dresslife run, check or preview"},
    {DocumentKind::observations, "observations", "list of observations", "give it to dresslife calibrate or validate"},
    {DocumentKind::observations, "law_tests", "list of observations", "give it to dresslife validate"},
    {DocumentKind::duties, "duties", "file of duties", "give it to dresslife duty or plan --duties"},
    {DocumentKind::dresspack, "components", "dresspack",
     "name it in a job, after 'dresspack:', or give it to dresslife draw or rate"},
    {DocumentKind::dresspack, "diameter_mm", "dresspack", "name it in a job, after 'dresspack:'"},
    {DocumentKind::robot, "joints", "robot",
     "name it in a job, after 'robot:', or give it to dresslife route or new --robot"},
    {DocumentKind::motion, "steps", "motion",
     "name it in a job, after 'motion:', or give it to dresslife new --program"},
    {DocumentKind::material, "youngs_modulus_GPa", "material", "name it in a dresspack's component, after 'material:'"},
};

}  // namespace

DocumentKind kind_of_document(const Node& document) {
  for (const KeyOfKind& of : known)
    if (document.find(of.key)) return of.kind;
  return DocumentKind::unknown;
}

void refuse_other_kind(const Node& document, DocumentKind wanted) {
  const DocumentKind kind = kind_of_document(document);
  if (kind == wanted || kind == DocumentKind::unknown) return;
  const char* wanted_name = "";
  for (const KeyOfKind& of : known)
    if (of.kind == wanted) wanted_name = of.name;
  for (const KeyOfKind& of : known)
    if (of.kind == kind && document.find(of.key))
      throw InputError(document.where,
                       fmt::format("is a {} (it has the key '{}'), no {}", of.name, of.key, wanted_name), of.use);
}

}  // namespace dresslife::pipeline
