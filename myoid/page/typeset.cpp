#include "myoid/page/typeset.h"

#include <algorithm>

#include "myoid/page/svg_plot.h"

namespace myoid::page {
namespace {

bool digit(char c) { return c >= '0' && c <= '9'; }

bool part_of_word(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || digit(c) || c == '_'; }

}  // namespace

std::string typographic(std::string_view text) {
  constexpr std::string_view kDegrees = " deg";
  std::string result;
  result.reserve(text.size() + 8);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view rest = text.substr(i);
    const bool word_starts = i == 0 || !part_of_word(text[i - 1]);
    if (word_starts && rest.starts_with("R2") && (rest.size() == 2 || !part_of_word(rest[2]))) {
      result += "R²";
      ++i;
    } else if (rest.starts_with("+-")) {
      result += "±";
      ++i;
    } else if (i > 0 && digit(text[i - 1]) && rest.starts_with(kDegrees) &&
               (rest.size() == kDegrees.size() || !part_of_word(rest[kDegrees.size()]))) {
      result += "°";
      i += kDegrees.size() - 1;
    } else {
      result += text[i];
    }
  }
  return result;
}

std::string typeset(std::string_view whole) {
  constexpr std::size_t kMostInWord = 300, kMostInText = 4000;
  const std::string shown = elided(with_short_words(whole, kMostInWord), kMostInText);
  const auto set = [](std::string_view part) { return escape_xml(typographic(part)); };
  std::string_view text = shown;
  std::string result;
  while (true) {
    const std::size_t open = text.find('`');
    const std::size_t close = open == std::string_view::npos ? open : text.find('`', open + 1);
    if (close == std::string_view::npos) return result + set(text);
    result += set(text.substr(0, open));
    result += "<code>" + escape_xml(text.substr(open + 1, close - open - 1)) + "</code>";
    text.remove_prefix(close + 1);
  }
}

std::string spelled(std::string_view name) {
  constexpr std::string_view kEmg = "emg";
  std::string words(name);
  std::ranges::replace(words, '_', ' ');
  if (words.starts_with(kEmg) && (words.size() == kEmg.size() || words[kEmg.size()] == ' ')) words.replace(0, 3, "EMG");
  return words;
}

}  // namespace myoid::page
