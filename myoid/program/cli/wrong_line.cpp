#include "myoid/program/cli/wrong_line.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/counted.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/program/cli/command_help.h"
#include "myoid/program/cli/context.h"

namespace myoid::program {
namespace {

/// Returns "myoid run --help".
std::string help_call(const CLI::App& command) {
  return command.get_parent() == nullptr ? "myoid --help" : fmt::format("myoid {} --help", command.get_name());
}

std::string shown(const CLI::Option& option) {
  const std::string name = option.get_name();
  return option.nonpositional() ? name : in_capitals(name);
}

bool has_option(const CLI::App& command, const std::string& word) {
  return word.size() > 1 && word.starts_with('-') && command.get_option_no_throw(word) != nullptr;
}

/// Returns a sentence on the first word that looks like an option and is none.
std::string unknown_option(const CLI::App& command) {
  const std::vector<std::string> left = command.remaining();
  const auto unknown = std::ranges::find_if(
      left, [](const std::string& word) { return word.size() > 1 && word.starts_with('-') && word != "--"; });
  if (unknown == left.end()) return "";
  const std::string word = unknown->substr(0, unknown->find('='));
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group() == kIdleGroup) continue;
    names.insert(names.end(), option->get_lnames().begin(), option->get_lnames().end());
  }
  const auto near = meant(std::string_view(word).substr(std::min(word.find_first_not_of('-'), word.size())), names);
  if (near) return fmt::format("unknown option '{}'; did you mean --{}?", word, *near);
  return fmt::format("unknown option '{}'; {} lists them", word, help_call(command));
}

/// Returns a sentence on an option that has more or fewer values than it takes.
std::string wrong_count(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const std::size_t given = option->results().size();
    const auto most = static_cast<std::size_t>(std::max(option->get_items_expected_max(), 1));
    const auto least = static_cast<std::size_t>(std::max(option->get_items_expected_min(), 1));
    if (given == 0 || option->get_multi_option_policy() != CLI::MultiOptionPolicy::Throw) continue;
    const std::string list = fmt::format("{}", fmt::join(option->results(), ", "));
    if (most == 1 && given > 1)
      return fmt::format("{} is given {} times ({}); it takes one value", shown(*option), given, list);
    if (given < least || given > most)
      return fmt::format("{} takes {}{}; found {}: {}", shown(*option), most > least ? "at least " : "",
                         counted(least, "value"), given, list);
  }
  return "";
}

/// Returns the reason for which a check or a conversion refused a value, behind the option's name.
std::string refused_value(const CLI::App& command, const CLI::ParseError& error) {
  const std::string what = error.what();
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->results().empty()) continue;
    if (dynamic_cast<const CLI::ValidationError*>(&error) != nullptr && what.starts_with(name + ": "))
      return shown(*option) + what.substr(name.size());
    if (dynamic_cast<const CLI::ConversionError*>(&error) == nullptr || what.find(name) == std::string::npos) continue;
    const std::string found = fmt::format("{}", fmt::join(option->results(), ", "));
    return option->get_items_expected_max() == 0 ? fmt::format("{} takes no value; found '{}'", name, found)
                                                 : fmt::format("{}: '{}' is none of its values", shown(*option), found);
  }
  return "";
}

std::string missing_options(const CLI::App& command) {
  std::vector<std::string> missing;
  for (const CLI::Option* option : command.get_options())
    if (option->get_required() && option->count() == 0) missing.push_back(shown(*option));
  if (missing.empty()) return "";
  return fmt::format("{} needs {}; {} explains {}", command.get_name(), fmt::join(missing, " and "), help_call(command),
                     missing.size() > 1 ? "them" : "it");
}

/// Returns a sentence on a word that no argument takes.
std::string word_too_many(const CLI::App& command) {
  const std::vector<std::string> left = command.remaining();
  if (left.empty()) return "";
  std::vector<std::string> taken;
  for (const CLI::Option* option : command.get_options())
    if (!option->nonpositional()) taken.push_back(shown(*option));
  return fmt::format("'{}' is one word too many; {} takes {}", left.front(), command.get_name(),
                     taken.empty() ? "options only" : fmt::format("{}", fmt::join(taken, " and ")));
}

/// Returns a sentence on options that are given without, or together with, another.
std::string wrong_company(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0) continue;
    for (const CLI::Option* needed : option->get_needs())
      if (needed->count() == 0) return fmt::format("{} has a use only with {}", shown(*option), shown(*needed));
    for (const CLI::Option* other : option->get_excludes())
      if (other->count() > 0) return fmt::format("{} and {} exclude each other", shown(*option), shown(*other));
  }
  return "";
}

}  // namespace

std::optional<std::string> meant(std::string_view word, const std::vector<std::string>& names) {
  const auto begins = [&](const std::string& name) { return !word.empty() && name.starts_with(word); };
  if (std::ranges::count_if(names, begins) == 1) return *std::ranges::find_if(names, begins);
  return word.size() < 3 ? std::nullopt : nearest_word(word, names);
}

std::string missing_value(const CLI::App& command, const std::vector<std::string>& words) {
  for (std::size_t i = 0; i < words.size() && words[i] != "--"; ++i) {
    if (!has_option(command, words[i])) continue;
    const auto values = static_cast<std::size_t>(command.get_option(words[i])->get_items_expected_min());
    if (values == 0) continue;
    if (i + 1 == words.size()) return fmt::format("{} needs a value; it is the last word", words[i]);
    if (has_option(command, words[i + 1]))
      return fmt::format("{0} needs a value, and behind it stands the option {1}; a value of this name goes as {0}={1}",
                         words[i], words[i + 1]);
    ++i;
  }
  return "";
}

std::string wrong_line(const CLI::App& command, const CLI::ParseError& error) {
  for (const std::string& sentence : {unknown_option(command), wrong_count(command), refused_value(command, error),
                                      missing_options(command), word_too_many(command), wrong_company(command)})
    if (!sentence.empty()) return sentence;
  return error.what();
}

}  // namespace myoid::program
