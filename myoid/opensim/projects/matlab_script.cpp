#include "myoid/opensim/projects/matlab_script.h"

#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

#include "myoid/ground/files/text_file.h"

namespace myoid::opensim {
namespace {

constexpr std::size_t kMostNested = 50, kMostValues = 10'000, kMostCharacters = 100'000;

bool is_name_start(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_name_part(char c) { return is_name_start(c) || std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// A statement of a script without comments and continuations.
struct Statement {
  std::string text;
  std::size_t line = 0;
};

/// Splits a script at the ends of lines, semicolons and commas outside of brackets and texts.
class StatementSplitter {
 public:
  explicit StatementSplitter(std::string_view script) : script_(script) {}

  std::vector<Statement> run() {
    while (at_ < script_.size()) step();
    end();
    return std::move(statements_);
  }

 private:
  [[nodiscard]] std::string_view rest() const { return script_.substr(at_); }

  void step() {
    const char c = script_[at_];
    if (c == '%') return skip_comment();
    if (rest().starts_with("...")) return skip_continuation();
    if (c == '"' || (c == '\'' && !is_transpose())) return take_text(c);
    if (c == '(' || c == '[' || c == '{') ++depth_;
    if ((c == ')' || c == ']' || c == '}') && depth_ > 0) --depth_;
    if (c == '\n') {
      // A line that ends within brackets ends a row; a bracket that never closes ends with its statement's lines.
      if (depth_ > 0)
        take(';');
      else
        end();
      ++line_;
    } else if ((c == ';' || c == ',') && depth_ == 0) {
      end();
    } else {
      take(c);
    }
    ++at_;
  }

  /// A quote behind a value turns it, and begins no text.
  [[nodiscard]] bool is_transpose() const {
    if (current_.text.empty()) return false;
    const char last = current_.text.back();
    return is_name_part(last) || last == ')' || last == ']' || last == '}' || last == '\'' || last == '.';
  }

  void take(char c) {
    if (current_.text.empty()) current_.line = line_;
    current_.text += c;
  }

  void take_text(char quote) {
    take(quote);
    for (++at_; at_ < script_.size() && script_[at_] != '\n'; ++at_) {
      take(script_[at_]);
      if (script_[at_] != quote) continue;
      ++at_;
      if (at_ >= script_.size() || script_[at_] != quote) return;
      take(quote);
    }
  }

  void skip_line() {
    while (at_ < script_.size() && script_[at_] != '\n') ++at_;
  }

  void skip_continuation() {
    skip_line();
    if (at_ < script_.size()) ++at_;
    ++line_;
    take(' ');
  }

  /// A line of "%{" alone begins a block, which a line of "%}" ends.
  void skip_comment() {
    const bool is_block = line_alone() == "%{";
    skip_line();
    if (!is_block) return;
    for (int open = 1; open > 0 && at_ < script_.size();) {
      ++at_;
      ++line_;
      const std::string_view alone = line_alone();
      if (alone == "%{") ++open;
      if (alone == "%}") --open;
      skip_line();
    }
  }

  /// Returns the line in which the reader is, without blanks.
  [[nodiscard]] std::string_view line_alone() const {
    const std::size_t before = at_ == 0 ? std::string_view::npos : script_.rfind('\n', at_ - 1);
    const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
    return trim(script_.substr(begin, script_.find('\n', at_) - begin));
  }

  void end() {
    if (!trim(current_.text).empty()) statements_.push_back(std::move(current_));
    current_ = {};
    depth_ = 0;
  }

  std::string_view script_;
  std::size_t at_ = 0, line_ = 1;
  int depth_ = 0;
  Statement current_;
  std::vector<Statement> statements_;
};

/// Reads the value of one statement.
class ValueReader {
 public:
  ValueReader(std::string_view text, const std::map<std::string, MatlabValue>& known) : text_(text), known_(known) {}

  std::optional<MatlabValue> run() {
    std::optional<MatlabValue> value = read_value();
    skip_blanks();
    if (!value || at_ < text_.size()) return std::nullopt;
    return value;
  }

 private:
  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }
  [[nodiscard]] char next() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  std::optional<MatlabValue> read_value() {
    if (nested_ >= kMostNested) return std::nullopt;
    ++nested_;
    std::optional<MatlabValue> value = read_one();
    --nested_;
    return value;
  }

  std::optional<MatlabValue> read_one() {
    skip_blanks();
    const char c = next();
    std::optional<MatlabValue> value;
    if (c == '\'' || c == '"')
      value = MatlabValue{.texts = {{read_text(c)}}};
    else if (c == '[' || c == '{')
      value = read_list(c == '[' ? ']' : '}');
    else if (is_name_start(c))
      value = read_named();
    else
      value = read_number();
    if (next() == '\'') ++at_;  // a turned list has the same entries
    return value;
  }

  std::string read_text(char quote) {
    std::string text;
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == quote) {
        ++at_;
        if (next() != quote) break;
      }
      text += text_[at_];
    }
    return text;
  }

  std::optional<MatlabValue> read_number() {
    const std::size_t begin = at_;
    if (next() == '-' || next() == '+') ++at_;
    while (std::isalnum(static_cast<unsigned char>(next())) != 0 || next() == '.' ||
           ((next() == '-' || next() == '+') && (text_[at_ - 1] == 'e' || text_[at_ - 1] == 'E')))
      ++at_;
    const std::optional<double> number = parse_number(text_.substr(begin, at_ - begin));
    if (!number || !std::isfinite(*number)) return std::nullopt;
    return MatlabValue{.numbers = {{*number}}};
  }

  std::optional<MatlabValue> read_named() {
    const std::size_t begin = at_;
    while (is_name_part(next()) || next() == '.') ++at_;
    const std::string name(text_.substr(begin, at_ - begin));
    if (name == "pwd") return MatlabValue{.texts = {{"."}}};
    if (name == "fullfile" && next() == '(') return read_path();
    const auto found = known_.find(name);
    if (found == known_.end() || found->second.is_computed || next() == '(' || next() == '{') return std::nullopt;
    return found->second;
  }

  std::optional<MatlabValue> read_path() {
    ++at_;
    std::string path;
    for (;;) {
      const std::optional<MatlabValue> part = read_value();
      if (!part || part->texts.size() != 1 || part->texts[0].size() != 1) return std::nullopt;
      if (!path.empty() && path.back() != '/' && path.back() != '\\') path += '/';
      path += part->texts[0][0];
      skip_blanks();
      const char c = next();
      ++at_;
      if (c == ')') return MatlabValue{.texts = {{path}}};
      if (c != ',') return std::nullopt;
    }
  }

  /// Texts in square brackets are one text; lists in a list are taken in entry by entry.
  std::optional<MatlabValue> read_list(char close) {
    ++at_;
    MatlabValue list;
    bool is_new_row = true;
    for (;;) {
      skip_blanks();
      const char c = next();
      if (c == '\0') return std::nullopt;
      ++at_;
      if (c == close) break;
      if (c == ',') continue;
      if (c == ';') {
        is_new_row = true;
        continue;
      }
      --at_;
      const std::size_t before = at_;
      const std::optional<MatlabValue> entry = read_value();
      if (!entry || at_ == before) return std::nullopt;
      append(list.texts, entry->texts, is_new_row);
      append(list.numbers, entry->numbers, is_new_row);
      is_new_row = false;
    }
    if (!list.texts.empty() && !list.numbers.empty()) return std::nullopt;  // which belongs to which is not known
    if (close == ']' && !list.texts.empty()) join(list);
    if (is_too_large(list)) return std::nullopt;
    return list;
  }

  template <typename Entry>
  static void append(std::vector<std::vector<Entry>>& rows,
                     const std::vector<std::vector<Entry>>& entry,
                     bool is_new_row) {
    for (std::size_t r = 0; r < entry.size(); ++r) {
      if (rows.empty() || (r == 0 && is_new_row) || r > 0) rows.emplace_back();
      rows.back().insert(rows.back().end(), entry[r].begin(), entry[r].end());
    }
  }

  /// A list that is made of itself again and again doubles each time.
  static bool is_too_large(const MatlabValue& list) {
    std::size_t entries = 0, characters = 0;
    for (const std::vector<double>& row : list.numbers) entries += row.size();
    for (const std::vector<std::string>& row : list.texts) {
      entries += row.size();
      for (const std::string& text : row) characters += text.size();
    }
    return entries > kMostValues || characters > kMostCharacters;
  }

  static void join(MatlabValue& list) {
    for (std::vector<std::string>& row : list.texts) {
      std::string text;
      for (const std::string& part : row) text += part;
      row = {text};
    }
  }

  std::string_view text_;
  const std::map<std::string, MatlabValue>& known_;
  std::size_t at_ = 0, nested_ = 0;
};

}  // namespace

std::vector<std::string> MatlabValue::all_texts() const {
  std::vector<std::string> all;
  for (const std::vector<std::string>& row : texts) all.insert(all.end(), row.begin(), row.end());
  return all;
}

std::map<std::string, MatlabValue> matlab_assignments(std::string_view script) {
  std::map<std::string, MatlabValue> found;
  for (const Statement& statement : StatementSplitter(script).run()) {
    const std::string_view text = trim(statement.text);
    std::size_t end = 0;
    if (text.empty() || !is_name_start(text[0])) continue;
    while (end < text.size() && (is_name_part(text[end]) || text[end] == '.')) ++end;
    const std::string name(text.substr(0, end));
    std::size_t sign = end;
    const bool is_part = end < text.size() && (text[end] == '(' || text[end] == '{');
    if (is_part) sign = text.find('=', end);
    while (sign < text.size() && is_blank(text[sign])) ++sign;
    if (sign >= text.size() || text[sign] != '=' || text.substr(sign).starts_with("==")) continue;
    std::optional<MatlabValue> value;
    if (!is_part) value = ValueReader(trim(text.substr(sign + 1)), found).run();
    if (!value) value = MatlabValue{.is_computed = true};
    value->line = statement.line;
    found.insert_or_assign(name, std::move(*value));
  }
  return found;
}

}  // namespace myoid::opensim
