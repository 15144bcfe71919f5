#include "myoid/ground/files/result_names.h"

#include "myoid/ground/files/folder_lock.h"
#include "myoid/ground/files/result_record.h"

namespace myoid::inline ground {

const std::vector<std::string_view>& run_result_names() {
  static const std::vector<std::string_view> names{
      // the report
      "figures", "tables", "report.html", "report.json", "methods.txt", "methods.bib", "run.json",
      // numbers
      "parameters.csv", "parameters.json", "fold_parameters.csv", "posterior.csv", "voluntary_torque.csv",
      "solvers.csv", "predictions.csv", "predictions.json",
      // for other programs
      "ceinms_calibrated.xml", "ceinms_uncalibrated.xml", "ceinms_rt_calibrated.xml", "ceinms_rt_uncalibrated.xml",
      "nmsm.osimx"};
  return names;
}

const std::vector<std::string_view>& result_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all = run_result_names();
    // of `identify` and a person of a cohort, and beside the results
    all.insert(all.end(),
               {"study.toml", "outcome.json", ".stages", FolderLock::kFile, kRecordFile, "kept-1", "kept-2", "kept-3"});
    return all;
  }();
  return names;
}

}  // namespace myoid::inline ground
