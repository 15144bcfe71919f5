#include "myoid/cli/say.h"

#include "myoid/files/quoted_text.h"

namespace myoid::cli {

void say_text(std::FILE* stream, std::string_view text) { fmt::print(stream, "{}", recording::terminal_text(text)); }

void say_whole(std::string_view text) { fmt::print("{}", recording::visible_text(text)); }

std::string in_column(std::string_view name) {
  constexpr std::size_t kMost = 40;
  return recording::elided(recording::visible_text(name), kMost);
}

}  // namespace myoid::cli
