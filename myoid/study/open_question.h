#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace myoid::study {

/// A question that `init` left in the text of a study: "# TODO: which side? [draft 3fa2c1]".
struct OpenQuestion {
  std::size_t line = 0;  ///< Counted from 1.
  std::string text;      ///< Without the mark of the draft.
};

/// Returns the comment that asks about `answer`, the line of the draft below it; empty: no line answers it.
[[nodiscard]] std::string question_line(std::string_view text, std::string_view answer = {});

/// Returns the questions that nobody answered: those whose line of the draft stands unchanged between the question and
/// the next table, and those that no line answers.
[[nodiscard]] std::vector<OpenQuestion> open_questions_in(std::string_view study);

}  // namespace myoid::study
