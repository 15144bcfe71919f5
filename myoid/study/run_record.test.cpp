#include "myoid/study/run_record.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::study {
namespace {

constexpr const char* kRun = R"({"command": "myoid run s.toml", "study": "/there/s.toml",
  "start_s": 0.5, "end_s": null, "options": {},
  "inputs": [{"path": "walk.c3d", "sha256": "ab"}, {"path": "s.toml", "sha256": "cd"}],
  "trials": [{"name": "walk", "use": "calibration"}, {"name": "mvc", "use": "mvc"}]})";

TEST(RunRecord, HoldsWhatARunIsComputedAgainBy) {
  const test::TemporaryFolder folder;
  write_file(folder / "run.json", kRun);
  const RunRecord run = read_run_record(folder.path());
  EXPECT_EQ(run.study, "/there/s.toml");
  EXPECT_EQ(run.start_s, 0.5);
  EXPECT_FALSE(run.end_s);
  EXPECT_EQ(run.uses.at("mvc"), "mvc");
  // Found by its name, wherever it lies now; the study itself may grow.
  EXPECT_NO_THROW(refuse_changed({{"/elsewhere/walk.c3d", "ab"}}, run));
  EXPECT_THROW(refuse_changed({{"/elsewhere/walk.c3d", "ax"}}, run), ReadError);
  EXPECT_THROW(refuse_changed({{"/there/s.toml", "ce"}}, run), ReadError);
  EXPECT_NO_THROW(refuse_changed({{"/there/s.toml", "ce"}}, run, "/there/s.toml"));
  // Files of one name in several folders.
  RunRecord twins = run;
  twins.inputs = {{"1/l.sto", "ab"}, {"2/l.sto", "cd"}};
  EXPECT_NO_THROW(refuse_changed({{"/there/1/l.sto", "ab"}, {"/there/2/l.sto", "cd"}}, twins));
  EXPECT_THROW(refuse_changed({{"/there/1/l.sto", "ab"}, {"/there/2/l.sto", "ce"}}, twins), ReadError);
  EXPECT_THROW(refuse_changed({{"/there/1/l.sto", "cd"}, {"/there/2/l.sto", "ab"}}, twins), ReadError) << "exchanged";
  EXPECT_NO_THROW(refuse_changed({{"/there/3/l.sto", "cd"}}, twins));
  EXPECT_THROW(refuse_changed({{"/there/3/l.sto", "ce"}}, twins), ReadError);
}

TEST(RunRecord, AFileThatIsNoneIsRefused) {
  const test::TemporaryFolder folder;
  EXPECT_THROW((void)read_run_record(folder.path()), ReadError);
  for (const char* text : {"", "[", "{\"trials\": 3}", "{\"study\": 7}"}) {
    write_file(folder / "run.json", text);
    EXPECT_THROW((void)read_run_record(folder.path()), ReadError) << text;
  }
}

}  // namespace
}  // namespace myoid::study
