#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>

namespace myoid::results {

struct MatStruct;

/// Texts of a cell array: n x 1, or 1 x n.
struct MatTexts {
  std::vector<std::string> texts;
  bool row = false;
};

/// A value of a MATLAB file: numbers, a column of logical values, a text (UTF-8), a cell array of
/// texts, or a 1 x n array of structs, all with the same fields.
using MatValue = std::variant<Eigen::MatrixXd, std::vector<bool>, std::string, MatTexts, std::vector<MatStruct>>;

/// Fields in order. A name has letters, digits and underscores, and begins with a letter.
struct MatStruct {
  std::vector<std::pair<std::string, MatValue>> fields;
};

/// Throws InvalidInput with the remedy where no MATLAB file can be written: the program was built
/// without libmatio, or the system has no such library.
void require_matio();

/// Writes variables in MATLAB's format (version 5, compressed), completely or not at all. The same variables give the
/// same bytes. Throws InvalidInput as `require_matio` and `write_file` do.
void write_mat_file(const std::filesystem::path& path, const MatStruct& variables);

}  // namespace myoid::results
