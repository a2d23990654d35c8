#include "pipeline/advise/improve/set_text.h"

namespace dresslife::pipeline {

std::string set_text(const Node& value) {
  if (!value.is_map() && !value.is_list()) {
    const std::string alone = to_yaml(list_of({value}));  // quoted as it must be within brackets
    const std::size_t begin = alone.find('[') + 1;
    return alone.substr(begin, alone.rfind(']') - begin);
  }
  std::string text;
  for (const Node& item : value.items) text += (text.empty() ? "" : ", ") + set_text(item);
  for (const Entry& entry : value.entries)
    text += (text.empty() ? "" : ", ") + entry.key + ": " + set_text(entry.value);
  return value.is_map() ? "{" + text + "}" : "[" + text + "]";
}

}  // namespace dresslife::pipeline
