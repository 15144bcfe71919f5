#include "myoid/study/checks/open_questions.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/study/open_question.h"

namespace myoid::study {

namespace {

/// Returns a question up to the end of its first sentence.
std::string first_sentence(const std::string& text) {
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    if (text[i + 1] != ' ') continue;
    if (text[i] == '?') return text.substr(0, i + 1);
    if (text[i] == '.' || text[i] == ';') return text.substr(0, i);
  }
  return text;
}

}  // namespace

std::optional<Remark> open_questions(std::string_view text, const std::filesystem::path& file) {
  std::vector<std::pair<std::string, std::vector<std::size_t>>> asked;  // a question and its lines
  const std::vector<OpenQuestion> open = open_questions_in(text);
  for (const OpenQuestion& question : open) {
    const std::string what = first_sentence(question.text);
    const auto same = std::ranges::find(asked, what, [](const auto& one) { return one.first; });
    if (same == asked.end())
      asked.push_back({what, {question.line}});
    else
      same->second.push_back(question.line);
  }
  if (asked.empty()) return std::nullopt;
  std::vector<std::string> questions;
  for (const auto& [what, at] : asked)
    questions.push_back(fmt::format("line{} {}: {}", at.size() == 1 ? "" : "s", fmt::join(at, ", "), what));
  return Remark{
      .code = RemarkCode::unanswered,
      .severity = Severity::warning,
      .where = file.filename().string(),
      .value = static_cast<double>(open.size()),
      .says = fmt::format("{} for an answer (TODO): {}",
                          open.size() == 1 ? "1 line still asks" : fmt::format("{} lines still ask", open.size()),
                          fmt::join(questions, "; ")),
      .remedy = "change the line below each, or delete the TODO where nothing is to change"};
}

}  // namespace myoid::study
