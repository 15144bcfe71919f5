#include "myoid/fit/posterior/unseen.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "myoid/fit/posterior/torque_signals.h"

#include "tests/support/elbow_study.h"
#include "tests/support/fascicle_study.h"
#include "tests/support/leg_study.h"

namespace myoid::fit {
namespace {

StudyData two_trials() { return test::elbow_study({.trials = 2, .seconds = 6.0}).data; }

/// A study, its runs, and where they are evaluated: at the start.
struct AtStart {
  explicit AtStart(StudyData of, EstimatorOptions with = {})
      : data(std::move(of)), options(std::move(with)), map(data, options), runs(trial_runs(data, options, map)) {}

  /// The torque of all runs, one after the other; `change` gets each run and the model's numbers.
  template <typename Change>
  Eigen::VectorXd torque(const Change& change) const {
    Eigen::VectorXd all(0);
    for (const TrialRun& run : runs) {
      TrialRun changed = run;
      ModelValues values = map.values(map.start());
      change(changed, values);
      const Eigen::VectorXd one = RunEvaluation(changed, map, EmgLag::delay, values, nullptr).signals().all();
      all.conservativeResize(all.size() + one.size());
      all.tail(one.size()) = one;
    }
    return all;
  }

  Unseen unseen() const { return unseen(recorded(runs, map.held().muscles)); }
  Unseen unseen(const Recorded& of_session) const { return unseen(of_session, map.start(), {}); }
  Unseen unseen(const Recorded& of_session, const Eigen::VectorXd& z, const std::vector<Stepped>& steps) const {
    const ModelValues values = map.values(z);
    std::vector<RunEvaluation> at;
    at.reserve(runs.size());
    for (const TrialRun& run : runs) at.emplace_back(run, map, EmgLag::delay, values, nullptr);
    return unseen_quantities(data, options, map, of_session, runs, values, at, steps);
  }

  /// The column of S of this name, all runs one after the other.
  Eigen::VectorXd column(const std::string& name) const {
    const Unseen all = unseen();
    const auto found = std::find_if(all.quantities.begin(), all.quantities.end(),
                                    [&](const UnseenQuantity& q) { return q.name == name; });
    EXPECT_NE(found, all.quantities.end()) << name;
    Eigen::VectorXd joined(0);
    for (const Eigen::MatrixXd& columns : all.columns) {
      joined.conservativeResize(joined.size() + columns.rows());
      joined.tail(columns.rows()) = columns.col(found - all.quantities.begin());
    }
    return joined;
  }

  StudyData data;
  EstimatorOptions options;
  ParameterMap map;
  std::vector<TrialRun> runs;
};

/// Compares a column with the difference of the torque that `change(by, run, values)` makes.
template <typename Change>
void expect_derivative(const AtStart& at, const std::string& name, double step, const Change& change) {
  const auto moved = [&](double by) {
    return at.torque([&](TrialRun& run, ModelValues& values) { change(by, run, values); });
  };
  const Eigen::VectorXd difference = (moved(step) - moved(-step)) / (2.0 * step);
  const Eigen::VectorXd column = at.column(name);
  ASSERT_GT(difference.norm(), 0.0);
  // The program's derivatives by length and rate may be secants.
  EXPECT_LT((column - difference).norm(), 0.02 * difference.norm()) << name;
}

/// Shortest and longest recorded length, widened to half an optimal fiber length.
std::pair<double, double> recorded_range(const AtStart& at, Eigen::Index k) {
  double low = 1e9, high = -1e9;
  for (const TrialRun& run : at.runs) {
    low = std::min(low, run.length_m.col(k).minCoeff());
    high = std::max(high, run.length_m.col(k).maxCoeff());
  }
  const double l0 = at.data.muscles[static_cast<std::size_t>(k)].start.optimal_fiber_length_m;
  const double more = std::max(0.0, 0.5 * l0 - (high - low));
  return {low - 0.5 * more, high + 0.5 * more};
}

TEST(Unseen, AMomentArmMovesLengthAndRateToo) {
  const AtStart at(two_trials());
  for (const Eigen::Index k : {0, 3}) {
    const auto [low, high] = recorded_range(at, k);
    const double middle = 0.5 * (low + high);
    expect_derivative(at, at.data.muscles[static_cast<std::size_t>(k)].name + ".moment_arm", 1e-4,
                      [&](double by, TrialRun& run, ModelValues&) {
                        run.arm_m.col(k) *= 1.0 + by;
                        run.velocity_mps.col(k) *= 1.0 + by;
                        run.length_m.col(k).array() += by * (run.length_m.col(k).array() - middle);
                      });
  }
}

TEST(Unseen, AFasciclesLengthFollowsTheMusclesLengthAndTheStretchOfItsTendon) {
  test::ElbowStudy elbow = test::elbow_study({.trials = 1, .seconds = 6.0, .with_priors = true});
  // Rigid tendons, whose strain is unseen, and elastic ones.
  StudyData rigid = elbow.data;
  rigid.trials[0].fascicle_m = rigid.trials[0].length_m;
  const AtStart elastic(test::fascicle_study(std::move(elbow), 2).data), stiff(std::move(rigid));
  const auto expect_fibers = [](const AtStart& at, const std::string& name, double step, const auto& change) {
    const Eigen::Index rows = at.runs[0].all_rows() - at.runs[0].row_count();
    const auto moved = [&](double by) {
      return at.torque([&](TrialRun& run, ModelValues& values) { change(by, run, values); }).tail(rows).eval();
    };
    const Eigen::VectorXd difference = (moved(step) - moved(-step)) / (2.0 * step);
    ASSERT_GT(difference.norm(), 0.0);
    EXPECT_LT((at.column(name).tail(rows) - difference).norm(), 0.02 * difference.norm()) << name;
  };
  for (const AtStart* at : {&elastic, &stiff}) {
    const auto [low, high] = recorded_range(*at, 0);
    expect_fibers(*at, "BIC.moment_arm", 1e-4, [&](double by, TrialRun& run, ModelValues&) {
      run.velocity_mps.col(0) *= 1.0 + by;
      run.length_m.col(0).array() += by * (run.length_m.col(0).array() - 0.5 * (low + high));
    });
    EXPECT_EQ(at->column("torque_scale").tail(at->runs[0].all_rows() - at->runs[0].row_count()).norm(), 0.0);
  }
  // The strain of a rigid tendon has one side only.
  const auto strained = [](double by) {
    return [by](TrialRun&, ModelValues& values) { values.muscles[0][kTendonStrain] = by; };
  };
  const Eigen::Index rows = stiff.runs[0].all_rows() - stiff.runs[0].row_count();
  const Eigen::VectorXd shorter = (stiff.torque(strained(1e-5)) - stiff.torque(strained(0.0))).tail(rows) / 1e-5;
  EXPECT_LT((stiff.column("BIC.tendon_strain").tail(rows) - shorter).norm(), 0.02 * shorter.norm());
}

TEST(Unseen, AMomentArmAtOneOfTwoJointsMovesTheLengthThatThisJointMakes) {
  const AtStart at(test::leg_study({.seconds = 6.0, .bent = false}).data);
  for (const std::size_t joint : {0U, 1U}) {
    const auto range = recorded(at.runs, at.map.held().muscles).by_joint[joint][1];
    const double middle = 0.5 * (range.shortest_m + range.longest_m);
    const std::string name = at.map.joints()[joint];
    const JointParts parts(at.runs);
    const auto part = [&](const Eigen::MatrixXd& all) {
      return Eigen::ArrayXd(parts.of(all, 1, static_cast<int>(joint)).array());
    };
    expect_derivative(at, "GAS.moment_arm_of_" + name, 1e-4, [&](double by, TrialRun& run, ModelValues&) {
      const Eigen::ArrayXd moved = part(run.length_m) - middle;
      const Eigen::ArrayXd rate = part(run.velocity_mps);
      const Eigen::Index n = run.time_s.size();
      run.arm_m.col(1).segment(run.first_row(joint), n) *= 1.0 + by;
      run.length_m.col(1).array() += by * moved;
      run.velocity_mps.col(1).array() += by * rate;
    });
    expect_derivative(at, "GAS.moment_arm_slope_of_" + name, 1e-4, [&](double by, TrialRun& run, ModelValues&) {
      const Eigen::ArrayXd x = range.place(part(run.length_m));
      const Eigen::ArrayXd rate = part(run.velocity_mps);
      const Eigen::Index n = run.time_s.size();
      run.arm_m.col(1).segment(run.first_row(joint), n).array() *= 1.0 + by * x;
      run.length_m.col(1).array() += by * 0.25 * range.span_m() * (x.square() - 1.0 / 3.0);
      run.velocity_mps.col(1).array() += by * x * rate;
    });
  }
}

TEST(Unseen, OfSeveralJointsEachMuscleHasAnArmWhereItCrossesAndEachJointItsOwnErrors) {
  const AtStart at(test::leg_study({.seconds = 6.0}).data);
  std::vector<std::string> arms, joints;
  for (const UnseenQuantity& q : at.unseen().quantities) {
    if (q.name.find(".moment_arm_of_") != std::string::npos) arms.push_back(q.name);
    if (q.name.find("e.error_") != std::string::npos) joints.push_back(q.name);
  }
  EXPECT_EQ(arms,
            (std::vector<std::string>{"SOL.moment_arm_of_ankle", "GAS.moment_arm_of_ankle", "GAS.moment_arm_of_knee",
                                      "TA.moment_arm_of_ankle", "VAS.moment_arm_of_knee", "HAM.moment_arm_of_knee"}));
  EXPECT_EQ(joints, (std::vector<std::string>{"ankle.error_constant", "ankle.error_slope", "knee.error_constant",
                                              "knee.error_slope"}));
  // The knee's constant is one of the knee: of the size of its torque, and 0 at the ankle.
  const Eigen::VectorXd constant = at.column("knee.error_constant");
  const Eigen::Index n = at.runs[0].time_s.size();
  EXPECT_EQ(constant.head(n).norm(), 0.0);
  EXPECT_EQ(constant[n], recorded(at.runs, at.map.held().muscles).joint_torque_nm[1]);
}

TEST(Unseen, ASlopeOfTheMomentArmIsTheIntegralOfItsLength) {
  const AtStart at(two_trials());
  for (const Eigen::Index k : {0, 3}) {
    const auto [low, high] = recorded_range(at, k);
    expect_derivative(at, at.data.muscles[static_cast<std::size_t>(k)].name + ".moment_arm_slope", 1e-4,
                      [&, low = low, high = high](double by, TrialRun& run, ModelValues&) {
                        const Eigen::ArrayXd x = 2.0 * (run.length_m.col(k).array() - low) / (high - low) - 1.0;
                        run.arm_m.col(k).array() *= 1.0 + by * x;
                        run.velocity_mps.col(k).array() *= 1.0 + by * x;
                        // d/dl of the change is x: dl' = (1 + by x) dl.
                        run.length_m.col(k).array() += by * 0.25 * (high - low) * (x.square() - 1.0 / 3.0);
                      });
  }
}

TEST(Unseen, ATendonThatStretchesIsTheLawsWithASmallStrain) {
  const AtStart at(two_trials());
  // An elastic tendon has a positive strain only: the forward difference.
  const double strain = 2e-4;
  const Eigen::VectorXd rigid = at.torque([](TrialRun&, ModelValues&) {});
  const Eigen::VectorXd elastic =
      at.torque([&](TrialRun&, ModelValues& values) { values.muscles[1][kTendonStrain] = strain; });
  const Eigen::VectorXd difference = (elastic - rigid) / strain;
  const Eigen::VectorXd column = at.column("BRA.tendon_strain");
  EXPECT_LT((column - difference).norm(), 0.02 * difference.norm());
}

TEST(Unseen, AGainDriftsWithThePlaceInTheSession) {
  const AtStart at(two_trials());
  expect_derivative(at, "BRD.gain_drift", 1e-4, [](double by, TrialRun& run, ModelValues& values) {
    values.channels[2][kGain] *= 1.0 + by * run.session;
  });
  EXPECT_NEAR(at.runs[0].session, 0.25, 1e-9);
  EXPECT_NEAR(at.runs[1].session, 0.75, 1e-9);
}

TEST(Unseen, AnActivationRisesEarlierAndFallsLater) {
  const AtStart at(two_trials());
  expect_derivative(at, "BIC.rise_and_fall", 1e-4, [](double by, TrialRun& run, ModelValues&) {
    const Envelope& u = run.envelopes[0];
    Eigen::VectorXd samples = u.samples();
    for (Eigen::Index i = 0; i < samples.size(); ++i) samples[i] += by * std::abs(u.at(u.time_s()[i]).slope);
    run.envelopes[0] = Envelope(u.time_s(), samples);
  });
}

TEST(Unseen, CrosstalkAddsTheSquareOfAnotherEnvelope) {
  const AtStart at(two_trials());
  const double x = at.options.unseen.crosstalk;
  const Eigen::VectorXd recorded_nm = at.torque([](TrialRun&, ModelValues&) {});
  const Eigen::VectorXd own_nm = at.torque([&](TrialRun& run, ModelValues&) {
    const Eigen::ArrayXd square =
        run.envelopes[0].samples().array().square() - (x * run.envelopes[3].samples().array()).square();
    run.envelopes[0] = Envelope(run.envelopes[0].time_s(), square.max(0.0).sqrt().matrix());
  });
  const Eigen::VectorXd difference = (recorded_nm - own_nm) / x, column = at.column("BIC.crosstalk_of_TRI");
  ASSERT_GT(difference.norm(), 0.0);
  EXPECT_LT((column - difference).norm(), 0.05 * difference.norm());
}

TEST(Unseen, TheSessionBeginsAtAFittedMaximalContraction) {
  StudyData data = test::elbow_study({.trials = 4, .seconds = 6.0}).data;
  data.trials[1].reference = true;
  const AtStart at(std::move(data));
  for (std::size_t i = 0; i < at.runs.size(); ++i)
    EXPECT_NEAR(at.runs[i].session, 0.25 * (static_cast<double>(i) - 1.0), 1e-9);
}

TEST(Unseen, ATorqueScaleIsTheWholeTorque) {
  const AtStart at(two_trials());
  EXPECT_EQ(at.column("torque_scale"), at.torque([](TrialRun&, ModelValues&) {}));
}

TEST(Unseen, ADynamometersScaleIsOfItsPartOfTheTorqueAlone) {
  StudyData data = two_trials();
  data.trials[1].dynamics_nm = data.trials[1].time_s.array().sin().matrix();
  const AtStart at(std::move(data));
  const Eigen::VectorXd all = at.torque([](TrialRun&, ModelValues&) {});
  const Eigen::Index first = at.runs[0].row_count(), n = at.runs[1].row_count();
  ASSERT_EQ(all.size(), first + n);
  const Eigen::VectorXd of_dynamics = at.column("torque_scale"), of_device = at.column("dynamometer_scale");
  EXPECT_EQ(of_dynamics.head(first), all.head(first));
  EXPECT_EQ(of_device.head(first).norm(), 0.0);
  const Eigen::VectorXd weight = at.runs[1].time_s.array().sin().matrix();
  EXPECT_LT((of_dynamics.tail(n) - weight).norm(), 1e-12);
  EXPECT_LT((of_device.tail(n) + weight - all.tail(n)).norm(), 1e-9);
}

TEST(Unseen, TheModelsErrorsAreTheMusclesTorqueTimesTheirShapes) {
  const AtStart at(two_trials());
  const auto alone = [&](double strength) {
    return at.torque([&](TrialRun&, ModelValues& values) { values.muscles[3][kMaxForce] *= strength; });
  };
  const Eigen::VectorXd torque = alone(1.0) - alone(0.0);
  EXPECT_LT((at.column("TRI.error_strength") - torque).norm(), 1e-9 * torque.norm());
}

TEST(Unseen, BeyondTheRecordedLengthsTheHigherPolynomialsStayAtTheirEnds) {
  const AtStart at(two_trials());
  // Of a session that had only the middle third of these lengths.
  Recorded session = recorded(at.runs, at.map.held().muscles);
  Recorded::Range& range = session.muscles[0];
  const double third = range.span_m() / 3.0;
  range.shortest_m += third;
  range.longest_m -= third;
  const Unseen unseen = at.unseen(session);
  const auto column = [&](const std::string& name) -> Eigen::VectorXd {
    for (std::size_t i = 0; i < unseen.quantities.size(); ++i) {
      if (unseen.quantities[i].name == "BIC.error_" + name) return unseen.columns[0].col(static_cast<Eigen::Index>(i));
    }
    ADD_FAILURE() << name;
    return Eigen::VectorXd::Zero(unseen.columns[0].rows());
  };
  const Eigen::VectorXd torque = column("strength"), first = column("length_1"), second = column("length_2"),
                        third_one = column("length_3");
  double farthest = 0.0;
  for (Eigen::Index i = 0; i < torque.size(); ++i) {
    if (std::abs(torque[i]) < 1e-3) continue;
    const double x = first[i] / torque[i], inside = std::clamp(x, -1.0, 1.0);
    farthest = std::max(farthest, std::abs(x));
    EXPECT_NEAR(second[i] / torque[i], 1.5 * inside * inside - 0.5, 1e-9);
    EXPECT_NEAR(third_one[i] / torque[i], inside * (2.5 * inside * inside - 1.5), 1e-9);
  }
  EXPECT_GT(farthest, 1.5);
}

TEST(Unseen, ALagIsThatOfOneMuscleAgainstTheMuscles) {
  // Earlier by 150 ms: the sign is that of ln a. Of a common delay the mean of the muscles is taken.
  const AtStart common(two_trials());
  expect_derivative(common, "TRI.error_lag", 1e-3, [](double by, TrialRun&, ModelValues& values) {
    for (std::size_t c = 0; c < 4; ++c) values.channels[c][kDelay] -= 0.15 * by * ((c == 3 ? 1.0 : 0.0) - 0.25);
  });
  EstimatorOptions held;
  held.delay_s = 0.06;
  const AtStart alone(two_trials(), held);
  expect_derivative(alone, "TRI.error_lag", 1e-3,
                    [](double by, TrialRun&, ModelValues& values) { values.channels[3][kDelay] -= 0.15 * by; });
}

TEST(Unseen, ASizeIsLearnedOfEachKindThatResidualsCanTell) {
  const std::map<std::string, NoiseField> sizes{{".error_", kModelErrorSize},
                                                {".moment_arm_slope", kArmSlopeSize},
                                                {".crosstalk_of_", kCrosstalkSize},
                                                {".gain_drift", kGainDriftSize},
                                                {".rise_and_fall", kRiseAndFallSize}};
  for (const UnseenQuantity& q : AtStart(two_trials()).unseen().quantities) {
    const auto of = std::find_if(sizes.begin(), sizes.end(),
                                 [&](const auto& kind) { return q.name.find(kind.first) != std::string::npos; });
    EXPECT_EQ(q.size, of == sizes.end() ? std::nullopt : std::optional(of->second)) << q.name;
    EXPECT_TRUE(q.size != kModelErrorSize || q.source == Source::model) << q.name;
    EXPECT_GT(q.weight, 0.0) << q.name;
  }
}

/// A column of S or of its slopes, all runs one after the other.
Eigen::VectorXd joined(const std::vector<Eigen::MatrixXd>& runs, Eigen::Index column) {
  Eigen::VectorXd all(0);
  for (const Eigen::MatrixXd& run : runs) {
    all.conservativeResize(all.size() + run.rows());
    all.tail(run.rows()) = run.col(column);
  }
  return all;
}

TEST(Unseen, ColumnsTurnWithTheNumbersOfTheirMuscleAndKeepTheirSize) {
  const AtStart at(test::elbow_study({.trials = 2, .seconds = 6.0, .with_priors = true}).data);
  const Recorded session = recorded(at.runs, at.map.held().muscles);
  const Eigen::VectorXd z = at.map.start();
  const Unseen all = at.unseen(session, z, steps_from(z, at.map, EmgLag::delay, at.runs));
  EXPECT_TRUE(at.unseen().slopes.empty());
  std::size_t turning = 0;
  for (std::size_t j = 0; j < at.map.free().size(); ++j) {
    const Unknown& of = at.map.free()[j];
    const double h = 1e-5 * (of.bounds.upper - of.bounds.lower);
    const Eigen::VectorXd off = h * Eigen::VectorXd::Unit(z.size(), static_cast<Eigen::Index>(j));
    const Unseen above = at.unseen(session, z + off, {}), below = at.unseen(session, z - off, {});
    for (std::size_t i = 0; i < all.quantities.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      const auto slope = std::find_if(all.slopes.begin(), all.slopes.end(), [&](const auto& s) {
        return s.quantity == column && s.unknown == static_cast<Eigen::Index>(j);
      });
      const std::string& name = all.quantities[i].name;
      // The torque of all muscles keeps its shape. The lags have their mean taken away.
      if (of.field->scope != Scope::muscle || of.field->field == kMaxForce || name == "torque_scale") {
        EXPECT_EQ(slope, all.slopes.end()) << of.label << " " << name;
        continue;
      }
      if (name.find("error_lag") != std::string::npos) continue;
      const Eigen::VectorXd c = joined(all.columns, column);
      Eigen::VectorXd turned = (joined(above.columns, column) - joined(below.columns, column)) / (2.0 * h);
      if (slope == all.slopes.end()) {
        EXPECT_LT(turned.norm(), 1e-9) << of.label << " " << name;
        continue;
      }
      turned -= c * c.dot(turned) / c.squaredNorm();
      const Eigen::VectorXd found = joined(all.by_slope, slope - all.slopes.begin());
      EXPECT_LT((found - turned).norm(), 1e-3 * (turned.norm() + c.norm())) << of.label << " " << name;
      EXPECT_LT(std::abs(found.dot(c)), 1e-9 * (1.0 + found.norm() * c.norm()));
      turning += found.norm() > 0.1 * c.norm();
    }
  }
  EXPECT_GT(turning, 20U);
}

}  // namespace
}  // namespace myoid::fit
