#include "myoid/study/intake/read_fascicles.h"

#include <cmath>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/study/study_model.h"

#include "tests/support/temporary_folder.h"

namespace myoid::study {
namespace {

/// A study of two muscles, and a file of lengths.
struct Fascicles {
  test::TemporaryFolder folder;
  Study study = parse_study(
      "[model]\nbuiltin = \"none\"\ncoordinate = \"ankle\"\n[emg]\nkind = \"activation\"\n"
      "[[muscle]]\nname = \"TA\"\nemg = \"TA\"\nstart = { max_isometric_force = 900, optimal_fiber_length = 0.08 }\n"
      "[[muscle]]\nname = \"SOL\"\nemg = \"SOL\"\nstart = { max_isometric_force = 900, optimal_fiber_length = 0.05 }\n"
      "[[trial]]\nname = \"t\"\nemg = \"e.sto\"\nlengths = \"l.sto\"\nmoment_arms = \"r.sto\"\ntorques = \"id.sto\"\n"
      "fascicles = \"us.csv\"\n",
      folder / "study.toml");
  std::vector<Remark> remarks;

  TimeSeries read(const std::string& text) {
    std::ofstream(folder / "us.csv") << text;
    return read_fascicles(study, load_model(study), folder / "us.csv", remarks);
  }
};

TEST(ReadFascicles, AStudyNamesTheFileAndTheUnitOfAColumnCounts) {
  Fascicles of;
  ASSERT_TRUE(of.study.trials[0].fascicles);
  EXPECT_EQ(of.study.trials[0].fascicles->filename(), "us.csv");
  const TimeSeries found = of.read("time [s],SOL [mm],other [V]\n0,50,1\n0.1,52,1\n");
  ASSERT_EQ(found.channel_count(), 1);
  EXPECT_EQ(found.channels()[0].name, "SOL");
  EXPECT_NEAR(found.values()(1, 0), 0.052, 1e-15);
}

TEST(ReadFascicles, RefusesNoMuscleNoLengthAndAnotherUnit) {
  Fascicles of;
  EXPECT_THROW((void)of.read("time [s],fascicle [mm]\n0,50\n0.1,52\n"), ReadError);
  EXPECT_THROW((void)of.read("time [s],TA [mm]\n0,\n0.1,\n"), ReadError);
  EXPECT_THROW((void)of.read("time [s],TA\n0,50\n0.1,52\n"), ReadError);         // m, in truth mm
  EXPECT_THROW((void)of.read("time [s],TA [deg]\n0,50\n0.1,52\n"), ReadError);   // a pennation angle
  EXPECT_THROW((void)of.read("time [s],TA [mm]\n0,5.0\n0.1,5.2\n"), ReadError);  // cm, of fibers of 8 cm
  EXPECT_THROW((void)of.read("time [s],TA [pixel]\n0,50\n0.1,52\n"), ReadError);
}

TEST(ReadFascicles, RefusesTimesThatTheTrialDoesNotHave) {
  Fascicles of;
  const TimeSeries found = of.read("time [s],TA [mm]\n100,50\n101,52\n");
  EXPECT_THROW(require_times_of_trial("us.csv", found, Eigen::Vector2d(0.0, 20.0)), ReadError);
  EXPECT_NO_THROW(require_times_of_trial("us.csv", found, Eigen::Vector2d(0.0, 100.0)));
}

TEST(ReadFascicles, LiesOnStraightLinesAndIsAbsentWhereNothingWasMeasured) {
  Fascicles of;
  const TimeSeries found = of.read("time [s],TA [cm]\n0.1,5\n0.2,6\n0.3,\n0.4,6\n0.5,7\n1.0,8\n1.1,9\n");
  Eigen::VectorXd time_s(9);
  time_s << 0.0, 0.1, 0.15, 0.2, 0.25, 0.45, 0.7, 1.1, 1.2;
  const Eigen::MatrixXd at = fascicles_at(found, of.study.muscles, time_s);
  const double absent = std::nan("");
  const std::vector<double> expected{absent, 0.05, 0.055, 0.06, absent, 0.065, absent, 0.09, absent};
  ASSERT_EQ(at.cols(), 2);
  for (Eigen::Index i = 0; i < time_s.size(); ++i) {
    EXPECT_TRUE(std::isnan(at(i, 1)));
    const double wanted = expected[static_cast<std::size_t>(i)];
    EXPECT_EQ(std::isnan(at(i, 0)), std::isnan(wanted)) << time_s[i];
    if (!std::isnan(wanted)) {
      EXPECT_NEAR(at(i, 0), wanted, 1e-12) << time_s[i];
    }
  }
}

}  // namespace
}  // namespace myoid::study
