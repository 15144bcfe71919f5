#include "myoid/draft/draft_text.h"

#include <algorithm>

#include "myoid/core/names.h"
#include "myoid/files/quoted_text.h"

namespace myoid {

std::string in_remark(const std::string& text) {
  std::string flat = text;
  std::ranges::replace(flat, '\n', ' ');
  return recording::visible_text(flat);
}

std::string list_of(const std::vector<std::string>& names) {
  return "[" + name_list(names, recording::toml_text) + "]";
}

}  // namespace myoid
