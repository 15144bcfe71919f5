#include "myoid/ground/files/result_names.h"

#include "myoid/ground/files/folder_lock.h"
#include "myoid/ground/files/result_record.h"

namespace myoid::inline ground {

const std::vector<std::string_view>& run_result_names() {
  static const std::vector<std::string_view> names{"figures",
                                                   "tables",
                                                   "report.html",
                                                   "report.json",
                                                   "parameters.csv",
                                                   "parameters.json",
                                                   "posterior.csv",
                                                   "fold_parameters.csv",
                                                   "run.json",
                                                   "voluntary_torque.csv",
                                                   "methods.txt",
                                                   "methods.bib",
                                                   "predictions.csv",
                                                   "predictions.json",
                                                   "solvers.csv",
                                                   "ceinms_calibrated.xml",
                                                   "nmsm.osimx",
                                                   "ceinms_uncalibrated.xml",
                                                   "ceinms_rt_calibrated.xml",
                                                   "ceinms_rt_uncalibrated.xml"};
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
