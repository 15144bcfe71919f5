#include "myoid/study/checks/open_questions.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/files/text_file.h"

namespace myoid::study {

std::optional<Remark> open_questions(std::string_view text, const std::filesystem::path& file) {
  constexpr std::string_view kMark = "# TODO: ";
  constexpr std::size_t kMost = 60;                                     // bytes of a question
  std::vector<std::pair<std::string, std::vector<std::size_t>>> asked;  // a question and its lines
  std::size_t count = 0;
  const auto lines = split_lines(text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto at = lines[i].find(kMark);
    if (at == std::string_view::npos) continue;
    std::string what(trim(lines[i].substr(at + kMark.size())));
    if (what.size() > kMost) what = what.substr(0, what.rfind(' ', kMost)) + " ...";
    ++count;
    const auto same = std::ranges::find(asked, what, [](const auto& one) { return one.first; });
    if (same == asked.end())
      asked.push_back({what, {i + 1}});
    else
      same->second.push_back(i + 1);
  }
  if (asked.empty()) return std::nullopt;
  std::vector<std::string> questions;
  for (const auto& [what, at] : asked)
    questions.push_back(fmt::format("line{} {}: {}", at.size() == 1 ? "" : "s", fmt::join(at, ", "), what));
  return Remark{.code = RemarkCode::unanswered,
                .severity = Severity::warning,
                .where = file.filename().string(),
                .value = static_cast<double>(count),
                .says = fmt::format("{} line{} still ask{} for an answer (TODO), or for being deleted: {}", count,
                                    count == 1 ? "" : "s", count == 1 ? "s" : "", fmt::join(questions, "; "))};
}

}  // namespace myoid::study
