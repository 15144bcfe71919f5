#pragma once

#include <string>

#include "myoid/program/cli/context.h"
#include "myoid/program/commands/run.h"

namespace myoid::program {

/// Takes the folder for the results, computes the study and writes all results.
[[nodiscard]] program::RunResult compute_run(Context& context, program::RunOptions options);

/// Prints the answer, or the object with --json, and sets the exit code. Method `paper` is printed with `with_paper`.
void say_run(Context& context, const program::RunResult& result, const std::string& out, bool with_paper = false);

}  // namespace myoid::program
