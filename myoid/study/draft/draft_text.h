#pragma once

#include <string>
#include <vector>

#include "myoid/study/open_question.h"

namespace myoid::study {

/// Returns a text as one line of a remark.
[[nodiscard]] std::string in_remark(const std::string& text);

/// The text of a study that is being drafted, and the questions in it.
struct DraftText {
  std::string toml;
  std::vector<std::string> questions;  ///< The remarks "TODO" of the text.

  void line(const std::string& text) { toml += text + '\n'; }
  /// Asks a question. A change of `answer`, a line that follows in the same table, answers it.
  void todo(const std::string& text, const std::string& answer = {}) {
    line(question_line(in_remark(text), answer));
    questions.push_back(text);
  }
  /// Asks a question above the line that answers it.
  void ask(const std::string& text, const std::string& answer) {
    todo(text, answer);
    line(answer);
  }
};

/// Returns a list of texts of TOML.
[[nodiscard]] std::string list_of(const std::vector<std::string>& names);

}  // namespace myoid::study
