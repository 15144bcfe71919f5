#include "myoid/ground/files/result_names.h"

#include "myoid/ground/files/folder_lock.h"
#include "myoid/ground/files/result_record.h"

namespace myoid::inline ground {

const std::vector<std::string_view>& result_names() {
  static const std::vector<std::string_view> names{
      // run, identify, predict
      "figures", "tables", "report.html", "report.json", "parameters.csv", "parameters.json", "fold_parameters.csv",
      "posterior.csv", "voluntary_torque.csv", "methods.txt", "methods.bib", "run.json", "solvers.csv",
      "predictions.csv", "predictions.json", "ceinms_calibrated.xml", "ceinms_uncalibrated.xml",
      "ceinms_rt_calibrated.xml", "ceinms_rt_uncalibrated.xml", "nmsm.osimx",
      // a person of a cohort
      "study.toml", "outcome.json",
      // beside the results
      ".stages", FolderLock::kFile, kRecordFile, "kept-1", "kept-2", "kept-3"};
  return names;
}

}  // namespace myoid::inline ground
