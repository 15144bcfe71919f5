#include "myoid/cli/mat_option.h"

#include "myoid/mat/results_mat.h"

namespace myoid::cli {

MatOption::MatOption(CLI::App& command) {
  command.add_option("--mat", *file_, "Also write parameters, series, remarks and draws as one MATLAB file (.mat)");
}

void MatOption::prepare(const Context& context, const std::vector<std::string>& inputs) const {
  if (file_->empty()) return;
  check_mat_file(*file_);
  context.prepare_file(*file_, inputs);
}

void MatOption::write(const std::filesystem::path& folder) const {
  if (!file_->empty()) write_results_mat(folder, *file_);
}

}  // namespace myoid::cli
