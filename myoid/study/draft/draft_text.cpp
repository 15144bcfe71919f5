#include "myoid/study/draft/draft_text.h"

#include <algorithm>

#include "myoid/ground/core/names.h"
#include "myoid/ground/files/quoted_text.h"

namespace myoid::study {

std::string in_remark(const std::string& text) {
  std::string flat = text;
  std::ranges::replace(flat, '\n', ' ');
  return visible_text(flat);
}

std::string list_of(const std::vector<std::string>& names) { return "[" + name_list(names, toml_text) + "]"; }

}  // namespace myoid::study
