#include "myoid/cli/help_files.h"

#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/cli/context.h"
#include "myoid/core/provenance.h"
#include "myoid/files/atomic_file.h"
#include "myoid/files/text_file.h"

namespace myoid::cli {
namespace {

/// An option as the help files show it.
struct HelpOption {
  std::vector<std::string> names;  ///< "-h", "--help"; empty for a positional argument.
  std::string value;               ///< "FILE", "{a,b}", the positional's name; empty for a flag.
  std::vector<std::string> words;  ///< The words that the value may be; empty: any.
  std::string says;
  bool required = false;
  bool several = false;
};

struct HelpCommand {
  std::string name;
  std::string says;     ///< First paragraph.
  std::string example;  ///< Lines behind "Example:", with a line end each.
  std::vector<HelpOption> options, positionals;

  /// Returns the first sentence without its point.
  [[nodiscard]] std::string title() const {
    const std::string first = says.substr(0, says.find('\n'));
    const std::size_t end = first.find(". ");
    std::string text = first.substr(0, end);
    if (text.ends_with('.')) text.pop_back();
    return text;
  }
};

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// Returns the words a and b of "value in {a->0,b->1} OR {0,1}" and "{a,b}".
std::vector<std::string> words_of(const std::string& type) {
  const std::size_t begin = type.find('{');
  const std::size_t end = type.find('}', begin);
  std::vector<std::string> words;
  if (begin == std::string::npos || end == std::string::npos) return words;
  for (const std::string_view each : recording::split(std::string_view(type).substr(begin + 1, end - begin - 1), ','))
    words.emplace_back(each.substr(0, each.find("->")));
  return words;
}

std::string value_of(const std::string& type, const std::vector<std::string>& words) {
  if (!words.empty()) return fmt::format("{{{}}}", fmt::join(words, ","));
  const std::string kind = type.substr(0, type.find_first_of(":( "));
  const bool number = kind.starts_with("INT") || kind.starts_with("UINT") || kind == "FLOAT" ||
                      kind.starts_with("POSITIVE") || kind.starts_with("NONNEGATIVE");
  return number ? "NUMBER" : kind.empty() ? "TEXT" : kind;
}

HelpOption help_of(const CLI::Option& option) {
  HelpOption help;
  const std::string type = option.get_type_name();
  help.says = option.get_description();
  help.required = option.get_required();
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

HelpCommand help_of(const CLI::App& command) {
  HelpCommand help;
  help.name = command.get_name();
  const std::string text = command.get_description();
  const std::size_t example = text.find("Example: ");
  help.says = text.substr(0, example == std::string::npos ? example : example - 1);
  if (example != std::string::npos) {
    const std::string_view lines = std::string_view(text).substr(example + 9);
    for (const std::string_view line : recording::split(lines, '\n'))
      help.example += fmt::format("{}\n", help.example.empty() ? line : recording::trim(line));
  }
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group() == kIdleGroup) continue;
    HelpOption each = help_of(*option);
    (each.names.empty() ? help.positionals : help.options).push_back(std::move(each));
  }
  return help;
}

std::string roff(std::string text) {
  text = replaced(std::move(text), "\\", "\\e");
  text = replaced(std::move(text), "-", "\\-");
  std::string lines;
  for (const std::string_view line : recording::split(text, '\n')) {
    if (line.starts_with('.') || line.starts_with('\'')) lines += "\\&";
    lines += line;
    lines += '\n';
  }
  return lines;
}

std::string roff_word(const std::string& text) {
  std::string line = roff(text);
  line.pop_back();
  return line;
}

std::string roff_head(const std::string& name) {
  return fmt::format(".TH {} 1 \"\" \"myoid {}\" \"User Commands\"\n", roff_word(in_capitals(name)), version());
}

constexpr const char* kExitCodes = R"(.SH EXIT STATUS
.TP
.B 0
Done.
.TP
.B 1
Internal error.
.TP
.B 2
Wrong command line.
.TP
.B 3
Bad input: nothing was computed.
.TP
.B 4
Computed, but a quality gate failed.
.TP
.B 5
Some trials or persons of several failed.
.TP
.B 130
Interrupted.
)";

std::string option_roff(const HelpOption& option) {
  std::string names;
  for (const std::string& name : option.names)
    names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", roff_word(name));
  if (!option.value.empty()) names += fmt::format("{}\\fI{}\\fR", names.empty() ? "" : " ", roff_word(option.value));
  if (option.several) names += " ...";
  if (option.required && !option.names.empty()) names += " (required)";
  return fmt::format(".TP\n{}\n{}", names, roff(option.says));
}

std::string command_page(const HelpCommand& command) {
  std::string synopsis = fmt::format(".B myoid {}\n[\\fIOPTIONS\\fR]", roff_word(command.name));
  for (const HelpOption& each : command.positionals)
    synopsis += fmt::format(" \\fI{}\\fR{}", roff_word(each.value), each.several ? " ..." : "");
  std::string text = roff_head("myoid-" + command.name) +
                     fmt::format(".SH NAME\nmyoid\\-{} \\- {}\n", roff_word(command.name), roff_word(command.title())) +
                     fmt::format(".SH SYNOPSIS\n{}\n.SH DESCRIPTION\n{}", synopsis, roff(command.says));
  if (!command.example.empty()) text += fmt::format(".SH EXAMPLE\n.nf\n{}.fi\n", roff_word(command.example));
  text += ".SH OPTIONS\n";
  for (const HelpOption& each : command.positionals) text += option_roff(each);
  for (const HelpOption& each : command.options) text += option_roff(each);
  return text + kExitCodes + ".SH SEE ALSO\n.BR myoid (1)\n";
}

std::string program_page(const CLI::App& app, const std::vector<HelpCommand>& commands) {
  std::string text = roff_head("myoid") +
                     ".SH NAME\nmyoid \\- muscle parameters of a person from motion capture and EMG\n.SH SYNOPSIS\n.B "
                     "myoid\n\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n"
                     ".SH DESCRIPTION\n" +
                     roff(app.get_description()) + ".SH COMMANDS\n";
  std::string also;
  for (const HelpCommand& command : commands) {
    text += fmt::format(".TP\n.B {}\n{}.\n", roff_word(command.name), roff_word(command.title()));
    also += fmt::format("{}.BR myoid\\-{} (1)", also.empty() ? "" : ",\n", roff_word(command.name));
  }
  text +=
      ".SH OPTIONS\n.TP\n\\fB\\-h\\fR, \\fB\\-\\-help\\fR\nPrint the help and exit.\n.TP\n"
      "\\fB\\-V\\fR, \\fB\\-\\-version\\fR\nPrint the version and exit.\n";
  return text + kExitCodes + ".SH SEE ALSO\n" + also + "\n";
}

std::vector<std::string> names_of(const std::vector<HelpOption>& options) {
  std::vector<std::string> names;
  for (const HelpOption& option : options) names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

std::string bash_completion(const std::vector<HelpCommand>& commands) {
  std::vector<std::string> all;
  std::string values, options;
  for (const HelpCommand& command : commands) {
    all.push_back(command.name);
    options += fmt::format("    {}) words=\"{}\" ;;\n", command.name, fmt::join(names_of(command.options), " "));
    for (const HelpOption& option : command.options) {
      for (const std::string& name : option.names) {
        if (!option.words.empty())
          values += fmt::format("    \"{} {}\") words=\"{}\" ;;\n", command.name, name, fmt::join(option.words, " "));
      }
    }
  }
  return fmt::format(
      R"sh(# bash completion of myoid
_myoid() {{
  local current="${{COMP_WORDS[COMP_CWORD]}}" words=""
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W "{} --help --version" -- "$current")
    return
  fi
  case "${{COMP_WORDS[1]}} ${{COMP_WORDS[COMP_CWORD-1]}}" in
{}  esac
  case "$words$current" in -*) case "${{COMP_WORDS[1]}}" in
{}  esac ;; esac
  if [ -n "$words" ]; then mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current"); fi
}}
complete -o default -F _myoid myoid
)sh",
      fmt::join(all, " "), values, options);
}

/// Returns the first sentence of an option's help.
std::string brief(const std::string& says) {
  const std::string line = says.substr(0, says.find('\n'));
  return line.substr(0, line.find(". "));
}

/// Returns a text inside single quotes of a shell, for zsh with its own marks escaped.
std::string quoted(std::string text, bool zsh) {
  if (zsh) {
    for (const char* mark : {"\\", "[", "]", ":"}) text = replaced(std::move(text), mark, std::string("\\") + mark);
    return replaced(std::move(text), "'", "'\\''");
  }
  return replaced(replaced(std::move(text), "\\", "\\\\"), "'", "\\'");
}

std::string zsh_completion(const std::vector<HelpCommand>& commands) {
  std::string all, cases;
  for (const HelpCommand& command : commands) {
    all += fmt::format("    '{}:{}'\n", command.name, quoted(command.title(), true));
    cases += fmt::format("    {})\n      _arguments", command.name);
    for (const HelpOption& option : command.options) {
      for (const std::string& name : option.names) {
        const std::string value = !option.words.empty()  ? fmt::format(":word:({})", fmt::join(option.words, " "))
                                  : option.value.empty() ? ""
                                                         : ":value:_files";
        cases += fmt::format(" \\\n        '*{}[{}]{}'", name, quoted(brief(option.says), true), value);
      }
    }
    cases += " \\\n        '*:file:_files' ;;\n";
  }
  return fmt::format(
      "#compdef myoid\n_myoid() {{\n  local -a commands\n  commands=(\n{}  )\n"
      "  if (( CURRENT == 2 )); then\n    _describe command commands\n    return\n  fi\n"
      "  local command=$words[2]\n  shift words\n  (( CURRENT-- ))\n"
      "  case $command in\n{}  esac\n}}\n_myoid \"$@\"\n",
      all, cases);
}

std::string fish_completion(const std::vector<HelpCommand>& commands) {
  std::string text = "# fish completion of myoid\n";
  for (const HelpCommand& command : commands) {
    text += fmt::format("complete -c myoid -n __fish_use_subcommand -f -a {} -d '{}'\n", command.name,
                        quoted(command.title(), false));
    for (const HelpOption& option : command.options) {
      for (const std::string& name : option.names) {
        const bool is_long = name.starts_with("--");
        const std::string value = !option.words.empty()  ? fmt::format(" -x -a '{}'", fmt::join(option.words, " "))
                                  : option.value.empty() ? ""
                                                         : " -r";
        text +=
            fmt::format("complete -c myoid -n '__fish_seen_subcommand_from {}' {} {}{} -d '{}'\n", command.name,
                        is_long ? "-l" : "-s", name.substr(is_long ? 2 : 1), value, quoted(brief(option.says), false));
      }
    }
  }
  return text;
}

}  // namespace

std::string in_capitals(std::string text) {
  for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  return text;
}

void write_help_files(const CLI::App& app, const std::filesystem::path& folder) {
  std::vector<HelpCommand> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    commands.push_back(help_of(*command));
  recording::write_file(folder / "man1/myoid.1", program_page(app, commands));
  for (const HelpCommand& command : commands)
    recording::write_file(folder / "man1" / fmt::format("myoid-{}.1", command.name), command_page(command));
  recording::write_file(folder / "bash/myoid", bash_completion(commands));
  recording::write_file(folder / "zsh/_myoid", zsh_completion(commands));
  recording::write_file(folder / "fish/myoid.fish", fish_completion(commands));
}

}  // namespace myoid::cli
