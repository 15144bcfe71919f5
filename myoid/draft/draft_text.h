#pragma once

#include <string>
#include <vector>

namespace myoid {

/// The text of a study that is being drafted, and the questions in it.
struct DraftText {
  std::string toml;
  std::vector<std::string> questions;  ///< Each stands in the text as a remark "TODO".

  void line(const std::string& text) { toml += text + '\n'; }
  void todo(const std::string& text) {
    line("# TODO: " + text);
    questions.push_back(text);
  }
};

/// As TOML writes it: quotes and backslashes escaped, control characters left out.
[[nodiscard]] std::string in_quotes(const std::string& text);
[[nodiscard]] std::string list_of(const std::vector<std::string>& names);

}  // namespace myoid
