#include "myoid/study/checks/open_questions.h"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/files/text_file.h"

namespace myoid::study {

std::optional<Remark> open_questions(std::string_view text, const std::filesystem::path& file) {
  constexpr std::string_view kMark = "# TODO: ";
  constexpr std::size_t kMost = 60;  // bytes of a question
  std::vector<std::string> asked;
  const auto lines = split_lines(text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto at = lines[i].find(kMark);
    if (at == std::string_view::npos) continue;
    std::string what(trim(lines[i].substr(at + kMark.size())));
    if (what.size() > kMost) what = what.substr(0, what.rfind(' ', kMost)) + " ...";
    asked.push_back(fmt::format("line {}: {}", i + 1, what));
  }
  if (asked.empty()) return std::nullopt;
  return Remark{
      .code = RemarkCode::unanswered,
      .severity = Severity::warning,
      .where = file.filename().string(),
      .value = static_cast<double>(asked.size()),
      .says = fmt::format("{} line{} still ask{} for an answer (TODO), or for being deleted: {}", asked.size(),
                          asked.size() == 1 ? "" : "s", asked.size() == 1 ? "s" : "", fmt::join(asked, "; "))};
}

}  // namespace myoid::study
