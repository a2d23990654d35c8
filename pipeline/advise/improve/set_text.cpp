#include "pipeline/advise/improve/set_text.h"

#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"

namespace dresslife::pipeline {

std::string set_text(const Node& value) {
  if (!value.is_map() && !value.is_list()) {
    const std::string alone = to_yaml(list_of({value}));  // quoted as it must be within brackets
    const std::size_t begin = alone.find('[') + 1;
    return alone.substr(begin, alone.rfind(']') - begin);
  }
  if (value.is_list()) return "[" + joined(mapped(value.items, set_text), ", ") + "]";
  const auto pair = [](const Entry& entry) { return entry.key + ": " + set_text(entry.value); };
  return "{" + joined(mapped(value.entries, pair), ", ") + "}";
}

}  // namespace dresslife::pipeline
