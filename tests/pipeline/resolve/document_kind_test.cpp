#include "pipeline/resolve/document_kind.h"

#include "tests/catch.h"

using namespace dresslife::pipeline;

TEST_CASE("documents: one of another kind is refused with its name and use, its own and an unknown one are not") {
  const struct {
    const char* text;
    DocumentKind kind;
    const char* name;
  } documents[]{{"base: x", DocumentKind::study, "study"},
                {"routing: {}", DocumentKind::job, "job"},
                {"dresspack: x", DocumentKind::job, "job"},
                {"observations: []", DocumentKind::observations, "list of observations"},
                {"components: []", DocumentKind::dresspack, "dresspack"},
                {"joints: []", DocumentKind::robot, "robot"},
                {"steps: []", DocumentKind::motion, "motion"},
                {"youngs_modulus_GPa: 1", DocumentKind::material, "material"}};
  for (const auto& given : documents) {
    const Node document = parse_yaml(given.text, "file.yaml");
    CHECK(kind_of_document(document) == given.kind);
    for (const auto& wanted : documents) {
      CAPTURE(given.text, wanted.text);
      if (wanted.kind == given.kind)
        CHECK_NOTHROW(refuse_other_kind(document, wanted.kind));
      else
        CHECK_THROWS_WITH(refuse_other_kind(document, wanted.kind),
                          Catch::Contains(std::string("is a ") + given.name + " (it has the key") &&
                              Catch::Contains(std::string("no ") + wanted.name));
    }
  }
  CHECK_NOTHROW(refuse_other_kind(parse_yaml("name: x", "file.yaml"), DocumentKind::job));
}
