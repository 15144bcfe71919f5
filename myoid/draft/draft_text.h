#pragma once

#include <string>
#include <vector>

namespace myoid {

/// The text of a study that is being drafted, and the questions in it.
struct DraftText {
  std::string toml;
  std::vector<std::string> questions;  ///< The remarks "TODO" of the text.

  void line(const std::string& text) { toml += text + '\n'; }
  void todo(const std::string& text) {
    line("# TODO: " + text);
    questions.push_back(text);
  }
};

/// Returns a text of TOML: quotes and backslashes escaped, control characters left out.
[[nodiscard]] std::string in_quotes(const std::string& text);
[[nodiscard]] std::string list_of(const std::vector<std::string>& names);

}  // namespace myoid
