#include "myoid/program/cli/help_files.h"

#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/provenance.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/program/cli/command_help.h"

namespace myoid::program {
namespace {

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::string roff(std::string text) {
  text = replaced(std::move(text), "\\", "\\e");
  text = replaced(std::move(text), "-", "\\-");
  std::string lines;
  for (const std::string_view line : split(text, '\n')) {
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
  if (!command.examples.empty()) text += ".SH EXAMPLE\n.nf\n";
  for (const std::string& example : command.examples) text += roff_word(shell_lines(example, 80));
  if (!command.examples.empty()) text += ".fi\n";
  if (!command.positionals.empty()) text += ".SH ARGUMENTS\n";
  for (const HelpOption& each : command.positionals) text += option_roff(each);
  text += ".SH OPTIONS\n";
  for (const std::string& group : command.groups()) {
    text += fmt::format(".SS {}\n", roff_word(group));
    for (const HelpOption& each : command.options)
      if (each.group == group) text += option_roff(each);
  }
  return text + kExitCodes + ".SH SEE ALSO\n.BR myoid (1)\n";
}

std::string program_page(const CLI::App& app, const std::vector<HelpCommand>& commands) {
  std::string text = roff_head("myoid") +
                     ".SH NAME\nmyoid \\- muscle parameters of a person from motion capture and EMG\n.SH SYNOPSIS\n.B "
                     "myoid\n\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n"
                     ".SH DESCRIPTION\n" +
                     roff(app.get_description()) + ".SH COMMANDS\n";
  std::string also, group;
  for (const HelpCommand& command : commands) {
    if (!command.stands_for.empty()) continue;
    if (command.group != group) text += fmt::format(".SS {}\n", roff_word(command.group));
    group = command.group;
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
    if (command.stands_for.empty()) all.push_back(command.name);
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
    mapfile -t COMPREPLY < <(compgen -W "{0} help --help --version" -- "$current")
    return
  fi
  case "${{COMP_WORDS[1]}} ${{COMP_WORDS[COMP_CWORD-1]}}" in
    "help help") words="{0}" ;;
{1}  esac
  case "$words$current" in -*) case "${{COMP_WORDS[1]}}" in
{2}  esac ;; esac
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
    if (command.stands_for.empty()) all += fmt::format("    '{}:{}'\n", command.name, quoted(command.title(), true));
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
      "  case $command in\n    help) _describe command commands ;;\n{}  esac\n}}\n_myoid \"$@\"\n",
      all, cases);
}

std::string fish_completion(const std::vector<HelpCommand>& commands) {
  std::string text = "# fish completion of myoid\n";
  for (const HelpCommand& command : commands) {
    if (command.stands_for.empty()) {
      text += fmt::format("complete -c myoid -n '__fish_seen_subcommand_from help' -f -a {}\n", command.name);
      text += fmt::format("complete -c myoid -n __fish_use_subcommand -f -a {} -d '{}'\n", command.name,
                          quoted(command.title(), false));
    }
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

void write_help_files(const CLI::App& app, const std::filesystem::path& folder) {
  const std::vector<HelpCommand> commands = help_of_commands(app);
  write_file(folder / "man1/myoid.1", program_page(app, commands));
  for (const HelpCommand& command : commands)
    write_file(folder / "man1" / fmt::format("myoid-{}.1", command.name), command_page(command));
  write_file(folder / "bash/myoid", bash_completion(commands));
  write_file(folder / "zsh/_myoid", zsh_completion(commands));
  write_file(folder / "fish/myoid.fish", fish_completion(commands));
}

}  // namespace myoid::program
