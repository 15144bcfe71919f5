#include "myoid/draft/draft_text.h"

#include "myoid/core/names.h"

namespace myoid {

std::string in_quotes(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) >= 0x20U) out += c;
  }
  return out + '"';
}

std::string list_of(const std::vector<std::string>& names) { return "[" + name_list(names, in_quotes) + "]"; }

}  // namespace myoid
