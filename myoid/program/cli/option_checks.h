#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

/// Checks of options, in the program's own words: what was found and what is expected.
namespace myoid::program {

[[nodiscard]] CLI::Validator between(double lower, double upper);

/// Returns the reason to refuse a text for a number of this type of CLI11 ("INT", "UINT", "FLOAT"); empty: it is one,
/// or the type is another.
[[nodiscard]] std::string refused_number(const std::string& text, const std::string& type);

}  // namespace myoid::program
