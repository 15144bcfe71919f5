#pragma once

#include <filesystem>

#include <CLI/CLI.hpp>

namespace myoid::program {

/// The word on the command line that writes the help files. Packages call it; no help shows it.
inline constexpr const char* kHelpFilesWord = "help-files";

/// Writes the manual pages and completions of the program, made of the declared commands and their options:
///
///   man1/myoid.1, man1/myoid-COMMAND.1
///   bash/myoid, zsh/_myoid, fish/myoid.fish
///
/// The files hold no date: the same program writes the same bytes.
void write_help_files(const CLI::App& app, const std::filesystem::path& folder);

}  // namespace myoid::program
