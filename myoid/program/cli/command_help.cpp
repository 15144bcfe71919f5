#include "myoid/program/cli/command_help.h"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "myoid/ground/core/wrapped_text.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/program/cli/context.h"

namespace myoid::program {
namespace {

constexpr const char* kRequired = "Required";

/// Returns the words a and b of "TEXT:{a,b}".
std::vector<std::string> words_of(const std::string& type) {
  const std::size_t begin = type.find('{');
  const std::size_t end = type.find('}', begin);
  std::vector<std::string> words;
  if (begin == std::string::npos || end == std::string::npos) return words;
  for (const std::string_view each : split(std::string_view(type).substr(begin + 1, end - begin - 1), ','))
    words.emplace_back(each);
  return words;
}

std::string value_of(const std::string& type, const std::vector<std::string>& words) {
  if (!words.empty()) return fmt::format("{{{}}}", fmt::join(words, ","));
  const std::string kind = type.substr(0, type.find(':'));
  return kind == "INT" || kind == "UINT" || kind == "FLOAT" ? "NUMBER" : kind.empty() ? "TEXT" : kind;
}

std::string names_of(const std::set<CLI::Option*>& options) {
  std::set<std::string> names;
  for (const CLI::Option* option : options) {
    const std::string name = option->get_name();
    names.insert(name.starts_with('-') ? name : in_capitals(name));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Returns the text with the range "1 to 50" of "INT:1 to 50", the default and the company that the option needs.
std::string with_facts(const std::string& text, const CLI::Option& option, const std::string& type) {
  std::vector<std::string> facts;
  const std::size_t range = type.find(':');
  if (range != std::string::npos && type.find('{') == std::string::npos) facts.push_back(type.substr(range + 1));
  std::string usual = option.get_default_str();
  std::erase_if(usual, [](char c) { return c == '[' || c == ']'; });
  if (!usual.empty())
    facts.push_back(fmt::format("default{} {}", usual.find(' ') == std::string::npos ? "" : ":", usual));
  if (!option.get_needs().empty()) facts.push_back("with " + names_of(option.get_needs()));
  if (!option.get_excludes().empty()) facts.push_back("not with " + names_of(option.get_excludes()));
  if (facts.empty()) return text;
  const std::string list = fmt::format("{}", fmt::join(facts, "; "));
  return text.ends_with(')') ? fmt::format("{}; {}", text, list) : fmt::format("{} ({})", text, list);
}

HelpOption help_of(const CLI::Option& option) {
  HelpOption help;
  const std::string type = option.get_type_name();
  help.says = with_facts(option.get_description(), option, type);
  help.required = option.get_required();
  help.group = help.required ? kRequired : option.get_group();
  help.several = option.get_items_expected_max() > 1;
  for (const std::string& name : option.get_snames()) help.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) help.names.push_back("--" + name);
  help.words = words_of(type);
  if (help.names.empty()) {
    help.value = in_capitals(option.get_name(true));
  } else if (option.get_items_expected_max() > 0) {
    help.value = value_of(type, help.words);
  }
  return help;
}

/// Describes a command without its options.
HelpCommand heading_of(const CLI::App& command) {
  constexpr std::string_view kExample = "Example: ";
  HelpCommand help;
  help.name = command.get_name();
  help.group = command.get_group();
  const std::string text = command.get_description();
  for (const std::string_view line : split(text, '\n')) {
    if (line.starts_with(kExample)) {
      help.examples.emplace_back(line.substr(kExample.size()));
    } else if (!help.examples.empty()) {
      help.examples.back() += fmt::format(" {}", trim(line));
    } else {
      help.says += fmt::format("{}{}", help.says.empty() ? "" : "\n", line);
    }
  }
  return help;
}

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

/// Puts names beside their text, which begins in this column, or one line below a long name.
std::string beside(const std::string& names, const std::string& text, std::size_t column, std::size_t width) {
  const std::string lines = wrapped(text, width, column);
  const std::string left = "  " + names;
  if (columns_of(left) + 2 > column) return left + "\n" + lines;
  return left + std::string(column - columns_of(left), ' ') + lines.substr(std::min(column, lines.size()));
}

std::string option_text(const HelpOption& option, std::size_t width) {
  std::string names = fmt::format("{}", fmt::join(option.names, ","));
  if (!option.value.empty()) names += (names.empty() ? "" : " ") + option.value;
  if (option.several) names += " ...";
  return beside(names, option.says, width < 70 ? 8 : 28, width);
}

std::string usage(const HelpCommand& command) {
  std::string line = fmt::format("Usage: myoid {} [OPTIONS]", command.name);
  for (const HelpOption& each : command.positionals) {
    const std::string name = each.value + (each.several ? "..." : "");
    line += each.required ? " " + name : " [" + name + "]";
  }
  return line + "\n";
}

}  // namespace

std::string in_capitals(std::string text) {
  for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  return text;
}

std::string HelpCommand::title() const {
  const std::string first = says.substr(0, says.find('\n'));
  std::string text = first.substr(0, first.find(". "));
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::vector<std::string> HelpCommand::groups() const {
  std::vector<std::string> names;
  for (const HelpOption& option : options) {
    if (std::ranges::find(names, option.group) == names.end()) names.push_back(option.group);
  }
  const auto rank = [](const std::string& heading) {
    return heading == kRequired ? 0 : heading == kCommonGroup ? 2 : 1;
  };
  std::ranges::stable_sort(names, {}, rank);
  return names;
}

HelpCommand help_of(const CLI::App& command) {
  HelpCommand help = heading_of(command);
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group() == kIdleGroup) continue;
    HelpOption each = help_of(*option);
    if (option->get_positional() && !each.names.empty()) {
      help.positionals.push_back({.value = in_capitals(option->get_name(true)),
                                  .says = fmt::format("In place of {}", each.names.front()),
                                  .required = true});
    }
    (each.names.empty() ? help.positionals : help.options).push_back(std::move(each));
  }
  return help;
}

std::vector<HelpCommand> help_of_commands(const CLI::App& app) {
  std::vector<HelpCommand> commands;
  for (const CLI::App* command : commands_of(app)) {
    const HelpCommand own = help_of(*command);
    commands.push_back(own);
    for (const std::string& name : command->get_aliases()) {
      HelpCommand& other = commands.emplace_back(own);
      other.name = name;
      other.stands_for = own.name;
      other.says = fmt::format("Another name of myoid {}. {}", own.name, own.says);
    }
  }
  return commands;
}

std::string shell_lines(const std::string& line, std::size_t width) {
  std::string text = columns_of(line) <= width ? line + "\n" : wrapped(line, width - 2, 0, 2);
  for (std::size_t at = text.find('\n'); at + 1 < text.size(); at = text.find('\n', at + 3)) text.insert(at, " \\");
  return text;
}

std::size_t help_width() {
  constexpr std::size_t kLeast = 40, kUsual = 100;
  if (const char* const columns = std::getenv("COLUMNS")) {
    if (const auto number = parse_number(columns); number && *number >= 1.0 && *number < 1e6)
      return std::max(kLeast, static_cast<std::size_t>(*number));
  }
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kUsual;
  return std::max<std::size_t>(kLeast, size.ws_col);
}

std::string command_text(const CLI::App& command, std::size_t width) {
  const HelpCommand help = help_of(command);
  std::string text = wrapped(help.says, width);
  for (const std::string& example : help.examples) text += shell_lines("Example: " + example, width);
  text += wrapped(usage(help), width, 0, 2);
  if (!help.positionals.empty()) text += "\nArguments:\n";
  for (const HelpOption& each : help.positionals) text += option_text(each, width);
  for (const std::string& group : help.groups()) {
    text += fmt::format("\n{}:\n", group);
    for (const HelpOption& each : help.options)
      if (each.group == group) text += option_text(each, width);
  }
  const std::string footer = command.get_footer();
  return fmt::format("{}{}{}", text, footer.empty() ? "" : "\n", footer.substr(0, footer.find_last_not_of('\n') + 1)) +
         (footer.empty() ? "" : "\n");
}

std::string program_text(const CLI::App& app, std::size_t width) {
  constexpr std::size_t kColumn = 16;
  std::string text = wrapped(app.get_description(), width) + "\nUsage: myoid COMMAND [OPTIONS]\n";
  std::string group;
  for (const CLI::App* each : commands_of(app)) {
    const HelpCommand command = heading_of(*each);
    if (command.group != group) text += fmt::format("\n{}:\n", command.group);
    group = command.group;
    text += beside(command.name, command.title(), kColumn, width);
  }
  text += "\nOptions:\n";
  for (const CLI::Option* option : app.get_options()) {
    const HelpOption help = help_of(*option);
    text += beside(fmt::format("{}", fmt::join(help.names, ",")), help.says, kColumn, width);
  }
  return text + "\n" +
         wrapped("myoid COMMAND --help, or myoid help COMMAND, shows a command's purpose, an example and its options.",
                 width) +
         "First steps:\n" + "  " + shell_lines("myoid demo", width - 2) + "  " +
         shell_lines("myoid init study --from RECORDINGS", width - 2);
}

}  // namespace myoid::program
