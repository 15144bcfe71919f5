#include "myoid/study/open_question.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/ground/core/provenance.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::study {
namespace {

constexpr std::string_view kAsks = "# TODO: ";
constexpr std::string_view kDraft = " [draft ";

/// Returns six digits that stand for a line.
std::string mark_of(std::string_view line) { return sha256(trim(line)).substr(0, 6); }

/// Returns true if one of the lines up to the next table is that of the draft.
bool as_drafted(const std::vector<std::string_view>& lines, std::size_t from, std::string_view mark) {
  for (std::size_t i = from; i < lines.size() && !trim(lines[i]).starts_with('['); ++i)
    if (mark_of(lines[i]) == mark) return true;
  return false;
}

}  // namespace

std::string question_line(std::string_view text, std::string_view answer) {
  return fmt::format("{}{}{}", kAsks, text, answer.empty() ? "" : fmt::format("{}{}]", kDraft, mark_of(answer)));
}

std::vector<OpenQuestion> open_questions_in(std::string_view study) {
  const std::vector<std::string_view> lines = split_lines(study);
  std::vector<OpenQuestion> open;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::size_t at = lines[i].find(kAsks);
    if (at == std::string_view::npos) continue;
    std::string_view text = trim(lines[i].substr(at + kAsks.size()));
    if (const std::size_t draft = text.rfind(kDraft); draft != std::string_view::npos && text.ends_with(']')) {
      const std::string_view mark = text.substr(draft + kDraft.size(), text.size() - draft - kDraft.size() - 1);
      text = text.substr(0, draft);
      if (!as_drafted(lines, i + 1, mark)) continue;
    }
    open.push_back({i + 1, std::string(text)});
  }
  return open;
}

}  // namespace myoid::study
