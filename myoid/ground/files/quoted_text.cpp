#include "myoid/ground/files/quoted_text.h"

#include <fmt/format.h>

#include "myoid/ground/files/utf8.h"

namespace myoid::inline ground {
namespace {

/// The longest path that Linux takes, in bytes.
constexpr std::size_t kLongestPath = 4096;
constexpr std::size_t kLongestLine = 4 * kLongestPath;
/// Characters of a word that is longer than any path.
constexpr std::size_t kKept = 60;

bool ends_word(char c) { return c == ' ' || c == '\t' || c == '\n'; }

/// Returns the text between double quotes, '"' and '\' behind a backslash, control characters as \uXXXX.
std::string in_double_quotes(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      result += c;
    }
  }
  return result + '"';
}

/// Returns a word in single quotes of a shell; `in_place` replaces single characters.
template <typename InPlace>
std::string in_single_quotes(std::string_view word, const InPlace& in_place) {
  std::string quoted = "'";
  for (const char c : word) quoted += in_place(c);
  return quoted + "'";
}

}  // namespace

std::string toml_text(std::string_view text) { return in_double_quotes(text); }

std::string toml_number(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string shell_word(std::string_view word) {
  // Letters, digits and marks that no shell reads as its own stay as they are.
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._/-+:@%,";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string_view::npos) return std::string(word);
  return in_single_quotes(word, [](char c) { return c == '\'' ? std::string("'\\''") : std::string(1, c); });
}

std::string parallel_word(std::string_view word) {
  // '{' alone in quotes: GNU parallel finds no brace with its end.
  return shell_word(in_single_quotes(word, [](char c) {
    return c == '\'' ? std::string("'\\''") : c == '{' ? std::string("{''") : std::string(1, c);
  }));
}

std::string python_text(std::string_view text) { return in_double_quotes(text); }

std::string escape_xml(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const CodePoint point = code_point_at(text, i);
    switch (point.value) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        if (!point.valid || (is_control(point.value) && point.value != '\n' && point.value != '\t'))
          result += '?';
        else
          result += text.substr(i, point.bytes);
    }
    i += point.bytes;
  }
  return result;
}

std::string url_path(std::string_view path) {
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  std::string result;
  for (const char c : path) {
    if (kPlain.find(c) != std::string_view::npos)
      result += c;
    else
      result += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return result;
}

std::string csv_quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

std::string csv_cell(std::string_view text) {
  const bool plain = text.find_first_of(",;\t\"\n\r") == std::string_view::npos && !text.starts_with('#') &&
                     !text.starts_with(' ') && !text.ends_with(' ');
  return plain ? std::string(text) : csv_quoted(text);
}

std::string visible_text(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const CodePoint point = code_point_at(text, i);
    if (!point.valid)
      result += "\xEF\xBF\xBD";
    else if (is_control(point.value) && point.value != '\n' && point.value != '\t')
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(point.value));
    else
      result += text.substr(i, point.bytes);
    i += point.bytes;
  }
  return result;
}

std::string terminal_text(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = std::min(text.find('\n', i), text.size());
    const std::string_view line = text.substr(i, end - i);
    if (line.size() <= kLongestPath) {
      result += line;
    } else {
      std::string cut;
      for (std::size_t at = 0; at < line.size();) {
        std::size_t stop = at;
        while (stop < line.size() && !ends_word(line[stop])) ++stop;
        const std::string_view word = line.substr(at, stop - at);
        cut += word.size() > kLongestPath ? elided(word, kKept) : std::string(word);
        if (stop < line.size()) cut += line[stop];
        at = stop + 1;
      }
      result += cut.size() > kLongestLine ? elided(cut, kLongestLine) : cut;
    }
    if (end < text.size()) result += '\n';
    i = end + 1;
  }
  return visible_text(result);
}

std::string elided(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  std::size_t count = 0, cut = 0;
  for (std::size_t i = 0; i < text.size(); ++count) {
    if (count + 1 == most) cut = i;
    if (count == most) return std::string(text.substr(0, cut)) + "\u2026";
    i += code_point_at(text, i).bytes;
  }
  return std::string(text);
}

std::string with_short_words(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t stop = at;
    while (stop < text.size() && !ends_word(text[stop])) ++stop;
    result += elided(text.substr(at, stop - at), most);
    if (stop < text.size()) result += text[stop];
    at = stop + 1;
  }
  return result;
}

}  // namespace myoid::inline ground
