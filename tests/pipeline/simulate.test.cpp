// The program `simulate`: what it writes, what it refuses, how it is stopped.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
#include "tests/support/temporary_folder.h"

namespace {

using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::read_text;
using myoid::test::TemporaryFolder;
using myoid::test::write_text;
using testing::AllOf;
using testing::HasSubstr;

std::string excitations(const std::string& names, const std::string& row) {
  return "controls\nversion=1\nnRows=2\nnColumns=5\ninDegrees=no\nendheader\ntime\t" + names + "\n0\t" + row +
         "\n0.5\t" + row + "\n";
}

TEST(Simulate, WritesAMotionThatInverseDynamicsTakes) {
  const TemporaryFolder folder;
  const Finished run = myoid({"simulate", "--excite", "BIC=0.1@0.1+0.2", "--end", "0.5", "--energy", "--figures",
                              "--json", "--out", folder / "sim"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("\"finished\": true"), HasSubstr("worst_relative_gap")));
  EXPECT_EQ(run.out, read_text(folder / "sim/simulation.json"));
  EXPECT_THAT(read_text(folder / "sim/figures/movement.svg"), HasSubstr("<svg"));
  const Finished id =
      myoid({"id", "--model", "arm4", "--motion", folder / "sim/motion.mot", "--out", folder / "id.sto"});
  EXPECT_EQ(id.exit_code, 0) << id.err;
}

/// A column of a storage file.
std::vector<double> column(const std::string& path, const std::string& name) {
  std::istringstream text(read_text(path));
  std::string line;
  while (std::getline(text, line) && line != "endheader") {
  }
  std::getline(text, line);
  std::istringstream head(line);
  std::size_t at = 0;
  for (std::string label; head >> label && label != name;) ++at;
  std::vector<double> result;
  while (std::getline(text, line)) {
    std::istringstream row(line);
    double value = 0.0;
    for (std::size_t k = 0; k <= at; ++k) row >> value;
    result.push_back(value);
  }
  return result;
}

TEST(Simulate, ItsTorqueIsThatOfInverseDynamicsOfItsMotion) {
  const TemporaryFolder folder;
  for (const char* tendon : {"rigid", "equilibrium", "mass"}) {
    const std::string out = folder / tendon;
    const Finished run = myoid({"simulate", "--excite", "all=0.03", "--excite", "BIC=0.2@0.1+0.2", "--tendon", tendon,
                                "--held-mass", "1", "--initial", "elbow_flexion=50", "--end", "0.6", "--out", out});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Finished id =
        myoid({"id", "--model", "arm4", "--motion", out + "/motion.mot", "--speeds", out + "/speeds.sto",
               "--accelerations", out + "/accelerations.sto", "--held-mass", "1", "--out", out + "/id.sto"});
    ASSERT_EQ(id.exit_code, 0) << id.err;
    const std::vector<double> required = column(out + "/id.sto", "elbow_flexion_moment");
    const std::vector<double> given = column(out + "/torques.sto", "elbow_flexion_moment");
    ASSERT_EQ(required.size(), given.size());
    ASSERT_EQ(required.size(), 121u);
    double greatest = 0.0;
    for (std::size_t k = 0; k < given.size(); ++k) {
      EXPECT_NEAR(required[k], given[k], 1e-8) << tendon << ' ' << k;
      greatest = std::max(greatest, std::abs(given[k]));
    }
    EXPECT_GT(greatest, 1.0);
  }
  // Speeds of another clock are not those of this motion.
  const std::string other = folder / "other";
  ASSERT_EQ(myoid({"simulate", "--end", "0.1", "--out", other}).exit_code, 0);
  const Finished id = myoid({"id", "--model", "arm4", "--motion", folder / "mass/motion.mot", "--speeds",
                             other + "/speeds.sto", "--out", folder / "id.sto"});
  EXPECT_EQ(id.exit_code, 3);
  EXPECT_THAT(id.err, AllOf(HasSubstr("speeds.sto"), HasSubstr("121")));
}

TEST(Simulate, WritesDerivativesByParameters) {
  const TemporaryFolder folder;
  const Finished run = myoid({"simulate", "--excite", "BIC=0.2", "--end", "0.2", "--sensitivity", "BIC.*",
                              "--sensitivity", "forearm_hand.mass", "--out", folder / "s"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string angle = folder / "s/sensitivities/elbow_flexion.sto";
  EXPECT_GT(column(angle, "BIC.max_isometric_force").back(), 0.0);  // stronger: more flexed
  EXPECT_LT(column(angle, "arm_inertia").back(), 0.0);              // heavier: less
  const Finished wrong = myoid({"simulate", "--sensitivity", "BIC.color", "--out", folder / "w"});
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_THAT(wrong.err, HasSubstr("BIC.optimal_fiber_length"));
}

TEST(Simulate, TakesExcitationsFromAFileUntilItsEnd) {
  const TemporaryFolder folder;
  write_text(folder / "u.sto", excitations("TRI\tBIC\tBRA\tBRD", "0.05\t0.1\t0.1\t0.1"));
  const Finished run = myoid({"simulate", "--excitations", folder / "u.sto", "--tendon", "rigid", "--initial",
                              "elbow_flexion=60", "--out", folder / "sim"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(read_text(folder / "sim/motion.mot"), HasSubstr("nRows=101"));  // 0.5 s at 200 Hz
  EXPECT_THAT(read_text(folder / "sim/simulation.json"), HasSubstr("sha256"));
}

TEST(Simulate, DrawsThePapersFigures) {
  const TemporaryFolder folder;
  ASSERT_EQ(myoid({"simulate", "--paper-figures", "--out", folder / "f"}).exit_code, 0);
  for (const char* name : {"figure2", "figure4"}) {
    EXPECT_THAT(read_text(folder / (std::string("f/figures/") + name + ".svg")), HasSubstr("<svg"));
    EXPECT_THAT(read_text(folder / (std::string("f/figures/") + name + ".csv")), HasSubstr("panel"));
  }
}

TEST(Simulate, RefusesExcitationsThatCannotBeUsedAndNamesTheirFile) {
  const TemporaryFolder folder;
  const auto answer = [&](const std::string& text) {
    write_text(folder / "u.sto", text);
    const Finished run = myoid({"simulate", "--excitations", folder / "u.sto", "--out", folder / "sim"});
    EXPECT_EQ(run.exit_code, 3);
    EXPECT_THAT(run.err, HasSubstr("u.sto"));
    EXPECT_FALSE(std::filesystem::exists(folder / "sim/motion.mot"));
    return run.err;
  };
  EXPECT_THAT(answer(excitations("TRI\tBIC\tBRA\tBRD", "0.05\t1.2\t0.1\t0.1")),
              AllOf(HasSubstr("BIC"), HasSubstr("1.2")));
  EXPECT_THAT(answer(excitations("TRI\tBIC\tBRA\tXYZ", "0.05\t0.2\t0.1\t0.1")), HasSubstr("BRD"));
  EXPECT_THAT(answer(excitations("TRI\tBIC\tBRA\tBRD", "0.05\tnan\t0.1\t0.1")), HasSubstr("BIC"));
  EXPECT_THAT(answer("no storage file\n"), HasSubstr("endheader"));
}

TEST(Simulate, RefusesACommandLineThatMeansNothing) {
  const TemporaryFolder folder;
  const std::string out = folder / "sim";
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--excite", "BIC"},
                                               {"--excite", "XYZ=0.1"},
                                               {"--excite", "BIC=0.1@x"},
                                               {"--excite", "BIC=1.5"},
                                               {"--initial", "knee=10"},
                                               {"--initial", "elbow_flexion"},
                                               {"--lock", "knee"},
                                               {"--end", "-1"},
                                               {"--model", "missing.osim"}}) {
    std::vector<std::string> arguments{"simulate", "--out", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Finished run = myoid(arguments);
    EXPECT_EQ(run.exit_code, 3) << testing::PrintToString(more) << run.err;
    EXPECT_THAT(run.err, HasSubstr("error: "));
  }
  // Wrong whatever the files hold.
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--rate", "0"}, {"--tolerance", "0"}, {"--held-mass", "-2"}, {"--tendon", "soft"}})
    EXPECT_EQ(myoid({"simulate", "--out", out, more[0], more[1]}).exit_code, 2) << more[0];
  EXPECT_EQ(myoid({"simulate"}).exit_code, 2);
}

TEST(Simulate, EndsOnCtrlCWithoutFiles) {
  const TemporaryFolder folder;
  // Half an hour of waving: minutes of work.
  std::string text =
      "controls\nversion=1\nnRows=36000\nnColumns=5\ninDegrees=no\nendheader\n"
      "time\tTRI\tBIC\tBRA\tBRD\n";
  for (int k = 0; k < 36000; ++k) {
    const std::string flex = k % 20 < 10 ? "0.2" : "0.02";
    text += std::to_string(0.05 * k) + "\t0.05\t" + flex + "\t" + flex + "\t" + flex + "\n";
  }
  write_text(folder / "u.sto", text);
  const Finished run = myoid({"simulate", "--excitations", folder / "u.sto", "--tendon", "mass", "--tolerance", "1e-10",
                              "--rate", "10", "--out", folder / "sim"},
                             1.0);
  EXPECT_EQ(run.exit_code, 130) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "sim/motion.mot"));
}

}  // namespace
