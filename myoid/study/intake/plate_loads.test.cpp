#include "myoid/study/intake/plate_loads.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/recording/c3d/c3d_writer.h"
#include "myoid/recording/plate_standing.h"
#include "myoid/recording/recording.h"
#include "myoid/study/intake/trial_loads.h"
#include "myoid/study/read_study.h"
#include "myoid/study/trial_up.h"

#include "tests/support/temporary_folder.h"

namespace myoid::study {
namespace {

using recording::C3dFile;
using recording::C3dParameter;
using recording::C3dType;
using ::testing::HasSubstr;

// In the laboratory, whose z points up: force on the person, where it acts, and the free moment.
const Vec3 kForce_L(40.0, -25.0, 620.0);
const Vec3 kPoint_L(0.43, 1.18, 0.05);
constexpr double kFree_nm = 7.5;
// The plate: middle of its surface, and the axes of C3D (x from corner 2 to 1, z down).
const Vec3 kMiddle_L(0.4, 1.2, 0.05);
const Mat3 kR_LP = (Mat3() << 0, 1, 0, 1, 0, 0, 0, 0, -1).finished();
const Vec3 kOrigin_P(0.001, -0.002, -0.04);  // from the transducer to the surface

/// 2 s at 1000 Hz of a plate of type 2, loaded between 0.5 and 1.5 s; markers at 100 Hz near the center of pressure.
C3dFile recording_of(double sign, const std::vector<std::pair<std::string, Vec3>>& markers) {
  C3dFile file;
  file.point_rate_hz = 100.0;
  file.point_unit = "mm";
  file.analog_per_frame = 10;
  file.points.resize(201, static_cast<Eigen::Index>(4 * markers.size()));
  for (std::size_t m = 0; m < markers.size(); ++m) {
    file.point_labels.push_back(markers[m].first);
    for (Eigen::Index f = 0; f < 201; ++f) {
      for (Eigen::Index a = 0; a < 3; ++a)
        file.points(f, static_cast<Eigen::Index>(4 * m) + a) = static_cast<float>(1000.0 * markers[m].second[a]);
      file.points(f, static_cast<Eigen::Index>(4 * m) + 3) = 0.0F;
    }
  }
  const Vec3 force_P = kR_LP.transpose() * kForce_L;
  const Vec3 point_P = kR_LP.transpose() * (kPoint_L - kMiddle_L);
  const Vec3 free_P = kR_LP.transpose() * Vec3(0, 0, kFree_nm);
  const Vec3 moment_P = (kOrigin_P + point_P).cross(force_P) + free_P;
  file.analog.resize(2010, 6);
  for (Eigen::Index i = 0; i < 2010; ++i) {
    const double on = i >= 500 && i < 1500 ? sign : 0.0;
    for (Eigen::Index a = 0; a < 3; ++a) {
      file.analog(i, a) = static_cast<float>(on * force_P[a]);
      file.analog(i, 3 + a) = static_cast<float>(1000.0 * on * moment_P[a]);
    }
  }
  for (const char* name : {"Fx", "Fy", "Fz"}) file.channels.push_back({name, "N"});
  for (const char* name : {"Mx", "My", "Mz"}) file.channels.push_back({name, "Nmm"});
  std::vector<double> corners;
  for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
    const Vec3 corner = kMiddle_L + kR_LP * Vec3(0.3 * x, 0.2 * y, 0.0);
    for (const double v : corner) corners.push_back(1000.0 * v);
  }
  const auto numbers = [](const char* name, C3dType type, std::vector<std::uint8_t> dimensions,
                          std::vector<double> values) {
    C3dParameter p;
    p.name = name;
    p.type = type;
    p.dimensions = std::move(dimensions);
    p.numbers = std::move(values);
    return p;
  };
  recording::C3dGroup group{.id = 1, .name = "FORCE_PLATFORM"};
  group.parameters = {numbers("USED", C3dType::integer, {}, {1}), numbers("TYPE", C3dType::integer, {1}, {2}),
                      numbers("CORNERS", C3dType::real, {3, 4, 1}, corners),
                      numbers("ORIGIN", C3dType::real, {3, 1}, {1.0, -2.0, -40.0}),
                      numbers("CHANNEL", C3dType::integer, {6, 1}, {1, 2, 3, 4, 5, 6})};
  file.groups = {group};
  return file;
}

class PlateLoads : public ::testing::Test {
 protected:
  body::ExternalLoads loads(double sign,
                            const std::vector<std::string>& bodies,
                            const std::vector<std::pair<std::string, Vec3>>& markers = {},
                            std::optional<double> cutoff_hz = {}) {
    const test::TemporaryFolder folder;
    recording::write_c3d(folder / "f.c3d", recording_of(sign, markers));
    recording::Recording file = recording::read_recording(folder / "f.c3d");
    recording::stand_plates(file, std::nullopt);
    std::optional<MarkerSeries> seen;
    if (!markers.empty()) seen = rotated(file.markers, R);
    return plate_loads(file.force_plates(), R, arm, bodies, seen, 10.0, cutoff_hz);
  }

  /// Force and moment about the body's origin must be those of the load, turned to y up.
  void expect_the_load(const body::ExternalLoads& given, double time_s, double tolerance) {
    body::BodyState state = body::make_state(arm);
    body::compute_poses(arm, arm.default_q(), state);
    std::vector<body::BodyWrench> wrenches;
    given.append_wrenches(state, time_s, wrenches);
    ASSERT_EQ(wrenches.size(), 1U);
    EXPECT_EQ(wrenches[0].body, hand);
    const Vec3 origin = state.X_GB[static_cast<std::size_t>(hand)].p;
    const Vec3 force = R * kForce_L;
    const Vec3 moment = (R * kPoint_L - origin).cross(force) + Vec3(0.0, kFree_nm, 0.0);
    EXPECT_LT((wrenches[0].f_G - force).norm(), tolerance);
    EXPECT_LT((wrenches[0].m_G - moment).norm(), tolerance);
  }

  const Mat3 R = rotation_to_y_up('z');
  body::BodyModel arm = body::parse_osim(body::arm4_osim(), "arm4.osim");
  body::BodyIndex hand = *arm.find_body("forearm_hand");
};

TEST_F(PlateLoads, AreTheForceThePointAndTheFreeMomentOnTheBody) {
  // Channels are 32-bit: 6e-8 of 620 N and of some 30 N m, a few of them.
  expect_the_load(loads(1.0, {"forearm_hand"}), 1.0, 1e-3);
}

TEST_F(PlateLoads, OfAPlateThatHoldsTheForceOnItselfAreTurnedRound) {
  expect_the_load(loads(-1.0, {"forearm_hand"}), 1.0, 1e-3);
}

TEST_F(PlateLoads, AreNothingWhereNobodyStands) {
  const body::ExternalLoads given = loads(1.0, {"forearm_hand"});
  body::BodyState state = body::make_state(arm);
  body::compute_poses(arm, arm.default_q(), state);
  std::vector<body::BodyWrench> wrenches;
  given.append_wrenches(state, 0.25, wrenches);
  EXPECT_LT(wrenches[0].f_G.norm(), 1e-9);
  EXPECT_LT(wrenches[0].m_G.norm(), 1e-9);
}

TEST_F(PlateLoads, KeepTheirMiddleUnderALowPass) {
  // Half a second from both steps, 20 Hz have settled to exp(-2 pi 20 0.5 / sqrt 2), nothing.
  expect_the_load(loads(1.0, {"forearm_hand"}, {}, 20.0), 1.0, 1e-3);
}

TEST_F(PlateLoads, GoToTheBodyWhoseMarkerIsNearest) {
  const body::Marker* on_hand = nullptr;
  const body::Marker* elsewhere = nullptr;
  for (const body::Marker& m : arm.markers) {
    if (m.body == hand) on_hand = &m;
    if (m.body != hand) elsewhere = &m;
  }
  ASSERT_TRUE(on_hand != nullptr && elsewhere != nullptr);
  const Vec3 near = kPoint_L + Vec3(0.02, 0.0, 0.03);
  const Vec3 far = kPoint_L + Vec3(0.0, 0.1, 0.2);
  const auto given = loads(1.0, {}, {{elsewhere->name, far}, {on_hand->name, near}});
  expect_the_load(given, 1.0, 1e-3);
  EXPECT_THAT(given.notes.back().says, HasSubstr("from 0.5 to 1.5 s is given to 'forearm_hand'"));
  EXPECT_THROW((void)loads(1.0, {}, {{on_hand->name, kPoint_L + Vec3(0.5, 0, 0)}}), InvalidInput);
}

TEST_F(PlateLoads, RefuseABodyThatIsNotThere) {
  EXPECT_THROW((void)loads(1.0, {"forearm_hnad"}), InvalidInput);
  EXPECT_THROW((void)loads(1.0, {"forearm_hand", "forearm_hand"}), InvalidInput);
  EXPECT_THROW((void)loads(1.0, {}), InvalidInput);
}

TEST_F(PlateLoads, ComeFromTheFileThatTheTrialNames) {
  const test::TemporaryFolder folder;
  recording::write_c3d(folder / "walk.c3d", recording_of(1.0, {}));
  for (const std::string markers : {"[markers]\nup = \"z\"\n", ""}) {
    const Study study = parse_study(markers +
                                        "[motion]\nsmoothing = \"none\"\n[[muscle]]\nname = \"BIC\"\nemg = \"b\"\n"
                                        "[[trial]]\nname = \"t\"\nmotion = \"m.mot\"\nemg = \"e.sto\"\n"
                                        "force_plates = { file = \"walk.c3d\", bodies = [\"forearm_hand\"] }\n",
                                    folder / "study.toml");
    std::vector<Remark> remarks;
    int files = 0;
    const auto given = read_trial_loads(
        study, study.trials[0], arm, std::nullopt, [&](const auto&) { ++files; }, remarks);
    ASSERT_TRUE(given);
    expect_the_load(*given, 1.0, 1e-3);
    EXPECT_EQ(files, 1);
  }
}

TEST_F(PlateLoads, UpOfAFileIsAsToldElseAsTheFileSaysElseY) {
  const test::TemporaryFolder folder;
  recording::write_c3d(folder / "walk.c3d", recording_of(1.0, {}));
  EXPECT_EQ(*trial_up('x', folder / "walk.c3d", arm).up_L, Vec3::UnitX());
  EXPECT_EQ(*trial_up(kUpOfTheFile, folder / "walk.c3d", arm).up_L, Vec3::UnitZ());
  EXPECT_EQ(*trial_up(kUpOfTheFile, folder / "walk.trc", arm).up_L, Vec3::UnitY());
  EXPECT_THAT(up_note(trial_up(kUpOfTheFile, folder / "walk.c3d", arm), arm), HasSubstr("from z up"));
}

}  // namespace
}  // namespace myoid::study
