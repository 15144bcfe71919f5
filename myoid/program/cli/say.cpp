#include "myoid/program/cli/say.h"

#include "myoid/ground/files/quoted_text.h"

namespace myoid::program {

void say_text(std::FILE* stream, std::string_view text) { fmt::print(stream, "{}", terminal_text(text)); }

void say_whole(std::string_view text) { fmt::print("{}", visible_text(text)); }

std::string in_column(std::string_view name) {
  constexpr std::size_t kMost = 40;
  return elided(visible_text(name), kMost);
}

}  // namespace myoid::program
