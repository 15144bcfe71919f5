#include "myoid/program/commands/report.h"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"

#include "tests/support/written_trial.h"

namespace myoid::program {
namespace {

/// Thrown by the listener of the first remark, so that nothing is computed.
struct Heard {
  std::string says;
};

/// A run of the built-in arm on disk, of which only run.json is left.
struct FinishedRun {
  test_trials::WrittenTrial trial{0.01, 5.0};
  std::vector<std::string> stages;  ///< That ended.

  FinishedRun() {
    std::string study = "[emg]\nkind = \"envelope\"\n";
    for (const char* muscle : {"BIC", "BRA", "BRD", "TRI"})
      study += fmt::format("[[muscle]]\nname = \"{0}\"\nemg = \"{0}\"\n", muscle);
    write_file(trial.folder / "study.toml", study + "[[trial]]\nname = \"t\"\nmotion = \"m.mot\"\nemg = \"e.sto\"\n");
  }
  void record(const std::string& hash) const {
    write_file(trial.folder / "run.json",
               fmt::format(R"({{"study": "{}", "seconds": {{"motion": 200, "fit": 40}}, "inputs": [{}]}})",
                           (trial.folder / "study.toml").string(),
                           hash.empty() ? "" : fmt::format(R"({{"path": "m.mot", "sha256": "{}"}})", hash)));
  }
  /// Returns the first remark of `report`.
  std::string heard() {
    ReportOptions options;
    options.folder = trial.folder.path().string();
    options.call.listener = [](const Remark& remark) { throw Heard{remark.says}; };
    options.call.stage_ended = [this](std::string_view work, double) { stages.emplace_back(work); };
    try {
      (void)report(options);
    } catch (const Heard& remark) {
      return remark.says;
    }
    return "";
  }
};

TEST(Report, SaysBeforeItComputesThatItComputesAgainAndHowLongByTheRun) {
  FinishedRun run;
  run.record("");
  EXPECT_NE(run.heard().find("about 240 s"), std::string::npos);
  EXPECT_EQ(run.stages.size(), 1U);  // the reading
  // Kept inverse kinematics is not computed again.
  std::filesystem::create_directory(run.trial.folder / kStageFolder);
  EXPECT_NE(run.heard().find("about 40 s"), std::string::npos);
}

TEST(Report, RefusesAChangedRecordingBeforeItComputes) {
  FinishedRun run;
  run.record("0123");
  EXPECT_THROW((void)run.heard(), ReadError);
  EXPECT_EQ(run.stages.size(), 1U);
}

}  // namespace
}  // namespace myoid::program
