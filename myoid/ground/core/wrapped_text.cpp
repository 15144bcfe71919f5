#include "myoid/ground/core/wrapped_text.h"

#include <algorithm>

namespace myoid::inline ground {

std::size_t columns_of(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string wrapped(std::string_view text, std::size_t width, std::size_t indent, std::size_t hanging) {
  std::string result;
  while (!text.empty()) {
    const std::string_view given = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(given.size() + 1, text.size()));
    std::string margin(indent, ' '), line;
    for (std::size_t begin = 0; begin < given.size();) {
      const std::size_t end = std::min(given.find(' ', begin), given.size());
      const std::string word(given.substr(begin, end - begin));
      begin = end + 1;
      if (word.empty()) continue;
      if (!line.empty() && columns_of(line) + 1 + columns_of(word) > width) {
        result += line + '\n';
        line.clear();
        margin.assign(indent + hanging, ' ');
      }
      line += (line.empty() ? margin : " ") + word;
    }
    result += line + '\n';
  }
  return result;
}

}  // namespace myoid::inline ground
