#pragma once

#include <string>
#include <vector>

namespace myoid::study {

/// Returns a text as one line of a remark.
[[nodiscard]] std::string in_remark(const std::string& text);

/// The text of a study that is being drafted, and the questions in it.
struct DraftText {
  std::string toml;
  std::vector<std::string> questions;  ///< The remarks "TODO" of the text.

  void line(const std::string& text) { toml += text + '\n'; }
  void todo(const std::string& text) {
    line("# TODO: " + in_remark(text));
    questions.push_back(text);
  }
};

/// Returns a list of texts of TOML.
[[nodiscard]] std::string list_of(const std::vector<std::string>& names);

}  // namespace myoid::study
