#pragma once

#include <string>

#include "myoid/cli/context.h"
#include "myoid/commands/run.h"

namespace myoid::cli {

/// Takes the folder for the results, computes the study and writes all results.
[[nodiscard]] commands::RunResult compute_run(Context& context, commands::RunOptions options, const std::string& out);

/// Prints the answer, or the object with --json, and sets the exit code. Method `paper` is printed with `with_paper`.
void say_run(Context& context, const commands::RunResult& result, const std::string& out, bool with_paper = false);

}  // namespace myoid::cli
