// The command `muscle` as a user runs it.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
#include "tests/support/data_folder.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace {

using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::read_rows;
using myoid::test::read_text;
using myoid::test::Row;
using myoid::test::TemporaryFolder;
using myoid::test::write_text;
using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

const std::string kSoleus = myoid::test::source_dir() / "examples/rat_soleus/muscle.toml";

/// Half a second of a sine, in millimeters about the middle.
std::string displacement() {
  std::string text = "time,displacement\n";
  for (int k = 0; k <= 100; ++k) {
    text += std::to_string(0.005 * k) + "," + std::to_string(std::sin(0.1 * k)) + "\n";
  }
  return text;
}

TEST(MuscleCommand, WritesTheForceUnderAnImposedLength) {
  const TemporaryFolder folder;
  write_text(folder / "d.csv", displacement());
  const std::vector<std::string> command{"muscle",  "--muscle", kSoleus,         "--length", folder / "d.csv",
                                         "--scale", "0.001",    "--offset",      "0.0321",   "--excitation",
                                         "1",       "--out",    folder / "f.sto"};
  const Finished done = myoid(command);
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("rat soleus: 101 samples"), HasSubstr("f.sto")));
  EXPECT_THAT(read_text(folder / "f.sto"), AllOf(HasSubstr("tendon_force"), HasSubstr("activation")));
  // Not twice, and what it wrote it can compare with.
  EXPECT_EQ(myoid(command).exit_code, 3);
}

TEST(MuscleCommand, ComparesWithAMeasuredForce) {
  const TemporaryFolder folder;
  write_text(folder / "d.csv", displacement());
  write_text(folder / "f.csv", "time,force\n0.1,1.0\n0.2,1.1\n0.3,1.0\n");
  const Finished done =
      myoid({"muscle", "--muscle", kSoleus, "--length", folder / "d.csv", "--scale", "0.001", "--offset", "0.0321",
             "--activation", "1", "--measured", folder / "f.csv", "--isometric-force", "1.17", "--json"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("\"samples\": 3"), HasSubstr("mean_absolute_error")));
}

TEST(MuscleCommand, ExchangedFilesOfLengthAndForceAreNoticed) {
  const TemporaryFolder folder;
  std::string length = "time,length\n", force = "time,force\n";
  for (int k = 0; k <= 100; ++k) {
    length += std::to_string(0.005 * k) + "," + std::to_string(0.0321 + 0.001 * std::sin(0.1 * k)) + "\n";
    force += std::to_string(0.005 * k) + "," + std::to_string(0.6 + 0.5 * std::sin(0.1 * k)) + "\n";
  }
  write_text(folder / "l.csv", length);
  write_text(folder / "f.csv", force);
  const auto run = [&](const char* lengths, const char* measured) {
    return myoid({"muscle", "--muscle", kSoleus, "--length", folder / lengths, "--activation", "1", "--measured",
                  folder / measured});
  };
  EXPECT_EQ(run("l.csv", "f.csv").err, "");
  const Finished exchanged = run("f.csv", "l.csv");
  EXPECT_EQ(exchanged.exit_code, 3);
  EXPECT_THAT(exchanged.err, HasSubstr("not the file of forces"));
  // Lengths given as forces: 3 % of the maximum throughout.
  EXPECT_THAT(run("l.csv", "l.csv").err, HasSubstr("exchanged"));
}

TEST(MuscleCommand, ForcesInMillinewtonsOrInAnotherOrderAreNoFit) {
  const TemporaryFolder folder;
  write_text(folder / "d.csv", displacement());
  const auto force_at = [&](const std::string& scale, const std::string& name) {
    const Finished done = myoid({"muscle", "--muscle", kSoleus, "--length", folder / "d.csv", "--scale", scale,
                                 "--offset", "0.0321", "--activation", "1", "--out", folder / (name + ".sto")});
    ASSERT_EQ(done.exit_code, 0) << done.err;
  };
  force_at("0.0002", "small");
  force_at("0.001", "large");
  const auto column = [&](const std::string& name, double scale) {
    std::istringstream file(read_text(folder / (name + ".sto")));
    std::string line, text = "time,force\n", cell;
    std::ptrdiff_t at = -1;
    while (std::getline(file, line)) {
      std::vector<std::string> cells;
      for (std::istringstream row(line); row >> cell;) cells.push_back(cell);
      if (at >= 0) {
        text += cells[0] + "," + std::to_string(scale * std::stod(cells[static_cast<std::size_t>(at)])) + "\n";
      } else if (!cells.empty() && cells[0] == "time") {
        at = std::find(cells.begin(), cells.end(), "tendon_force") - cells.begin();
      }
    }
    write_text(folder / (name + (scale > 1.0 ? "_mn.csv" : "_n.csv")), text);
  };
  column("small", 1.0);
  column("large", 1.0);
  column("large", 1000.0);
  const auto fit = [&](const std::string& first, const std::string& second) {
    return myoid({"muscle", "--muscle", kSoleus, "--length", folder / "d.csv", folder / "d.csv", "--scale", "0.0002",
                  "0.001", "--offset", "0.0321", "--activation", "1", "--measured", folder / first, folder / second,
                  "--fit", "max_isometric_force"});
  };
  const Finished good = fit("small_n.csv", "large_n.csv");
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_EQ(good.err, "");
  EXPECT_THAT(fit("large_n.csv", "small_n.csv").err, HasSubstr("fit each other's length much better than their own"));
  const Finished millinewtons = fit("small_n.csv", "large_mn.csv");
  EXPECT_EQ(millinewtons.exit_code, 3);
  EXPECT_THAT(millinewtons.err, AllOf(HasSubstr("large_mn.csv"), HasSubstr("are they in mN?")));
}

TEST(MuscleCommand, AStandardErrorHoldsWhatLeavingOutOneRecordingOfARatsSoleusShows) {
  const fs::path data = myoid::test::data_folder() / "rat-soleus";
  MYOID_REQUIRE_DATA(data);
  const TemporaryFolder folder;
  const auto table = [&](const std::string& name) {
    std::istringstream file(read_text(data / (name + ".dat")));
    std::string line, text = "time,value\n";
    while (std::getline(file, line) && !line.starts_with("endheader")) {
    }
    std::getline(file, line);
    double time_s = 0.0, value = 0.0;
    while (file >> time_s >> value) text += fmt::format("{},{}\n", time_s, value);
    write_text(folder / (name + ".csv"), text);
    return folder / (name + ".csv");
  };
  const std::string d = table("displacement");
  const Finished done = myoid({"muscle",
                               "--muscle",
                               kSoleus,
                               "--excitation",
                               "1",
                               "--isometric-force",
                               "1.17",
                               "--offset",
                               "0.032106",
                               "--length",
                               d,
                               d,
                               d,
                               d,
                               "--scale",
                               "5e-5",
                               "1e-4",
                               "5e-4",
                               "1e-3",
                               "--measured",
                               table("force_trial1"),
                               table("force_trial2"),
                               table("force_trial4"),
                               table("force_trial5"),
                               "--fit",
                               "max_isometric_force,max_shortening_speed,tendon_strain",
                               "--out",
                               folder / "fit.csv"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  // The jackknife anew, from what the file says of the fits without a recording.
  std::map<std::string, std::vector<double>> without;
  std::map<std::string, double> std_error, all;
  for (const Row& row : read_rows(folder / "fit.csv")) {
    const double value = std::stod(row.at("estimate"));
    if (!row.at("left_out").empty()) {
      without[row.at("parameter")].push_back(value);
      continue;
    }
    all[row.at("parameter")] = value;
    std_error[row.at("parameter")] = std::stod(row.at("std_error"));
  }
  ASSERT_EQ(all.size(), 3U);
  for (const auto& [parameter, values] : without) {
    ASSERT_EQ(values.size(), 4U);
    double mean = 0.0, squares = 0.0;
    for (const double x : values) mean += x / 4.0;
    for (const double x : values) squares += (x - mean) * (x - mean);
    EXPECT_GE(std_error[parameter], (1.0 - 1e-9) * std::sqrt(0.75 * squares)) << parameter;
    for (const double x : values) EXPECT_LT(std::abs(x - all[parameter]), 2.0 * std_error[parameter]) << parameter;
  }
  EXPECT_THAT(done.err, AllOf(HasSubstr("max_shortening_speed is"), HasSubstr("force_trial5.csv"),
                              HasSubstr("hangs on that recording")));
}

TEST(MuscleCommand, SaysWhatItCannotUse) {
  const TemporaryFolder folder;
  write_text(folder / "d.csv", displacement());
  const auto run = [&](std::vector<std::string> more) {
    std::vector<std::string> command{"muscle", "--muscle", kSoleus, "--length", folder / "d.csv"};
    command.insert(command.end(), more.begin(), more.end());
    return myoid(command);
  };
  // Millimeters taken for meters are negative here and there.
  Finished done = run({"--activation", "1"});
  EXPECT_EQ(done.exit_code, 3);
  EXPECT_THAT(done.err, HasSubstr("--scale"));
  done = run({"--offset", "40", "--activation", "1"});
  EXPECT_EQ(done.exit_code, 3);
  EXPECT_THAT(done.err, HasSubstr("expected meters"));
  done = run({"--scale", "0.001", "--offset", "0.0321"});
  EXPECT_EQ(done.exit_code, 3);
  EXPECT_THAT(done.err, HasSubstr("--activation or --excitation"));
  done = run({"--scale", "0.001", "--offset", "0.0321", "--activation", "1.5"});
  EXPECT_EQ(done.exit_code, 3);
  EXPECT_THAT(done.err, HasSubstr("1.5"));
  done = run({"--scale", "0.001", "--offset", "0.0321", "--activation", "1", "--column", "length"});
  EXPECT_EQ(done.exit_code, 3);
  EXPECT_THAT(done.err, HasSubstr("displacement"));
}

}  // namespace
