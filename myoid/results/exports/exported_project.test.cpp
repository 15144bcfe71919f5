#include "myoid/results/exports/exported_project.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/fit/measurement/envelope.h"
#include "myoid/opensim/projects/read_project.h"
#include "myoid/results/exports/export_files.h"
#include "myoid/results/exports/identified_osim.h"
#include "myoid/results/exports/law_differences.h"
#include "myoid/run/run_study.h"

#include "tests/support/exact_recording.h"
#include "tests/support/temporary_folder.h"

namespace myoid::results {
namespace {

using opensim::MuscleQuantity;
using opensim::Project;
using opensim::ProjectMuscle;

/// The exact virtual recording, run once.
struct ExactRun {
  test::TemporaryFolder folder;
  run::StudyResult result;

  ExactRun() {
    study::Study study = test::exact_recording(folder / "recording");
    study.identify.methods = {fit::Method::torque};
    study.identify.next_movements = 0;
    result = run::run_study(study);
  }
  static const ExactRun& get() {
    static const ExactRun run;
    return run;
  }
  [[nodiscard]] fit::MuscleValues values(std::size_t m) const { return result.fit.methods.front().values.muscles[m]; }
};

/// Returns the run with changed numbers of the fit.
template <typename Change>
run::StudyResult changed(const Change& change) {
  run::StudyResult result = ExactRun::get().result;
  change(result.fit.methods.front());
  return result;
}

void expect_near(double found, double expected, const std::string& where) {
  EXPECT_NEAR(found, expected, 1e-9 * std::abs(expected)) << where;
}

/// Expects the numbers, curves, joints and, in CEINMS-RT, channels of a project; the start where it was read.
void expect_same(const Project& read, const Project& written) {
  EXPECT_EQ(read.dialect, written.dialect);
  EXPECT_TRUE(read.is_calibrated);
  ASSERT_EQ(read.muscles.size(), written.muscles.size());
  for (std::size_t m = 0; m < read.muscles.size(); ++m) {
    const ProjectMuscle &found = read.muscles[m], &expected = written.muscles[m];
    EXPECT_EQ(found.name, expected.name);
    ASSERT_EQ(found.numbers.size(), expected.numbers.size()) << found.name;
    for (const auto& [quantity, number] : expected.numbers) {
      const std::string where = found.name + " " + std::string(choice_name(quantity));
      ASSERT_TRUE(found.numbers.contains(quantity)) << where;
      expect_near(found.numbers.at(quantity).value, number.value, where);
      if (found.numbers.at(quantity).start) expect_near(*found.numbers.at(quantity).start, *number.start, where);
    }
  }
  ASSERT_EQ(read.curves.size(), written.curves.size());
  for (std::size_t c = 0; c < read.curves.size(); ++c) {
    EXPECT_EQ(read.curves[c].name, written.curves[c].name);
    EXPECT_EQ(read.curves[c].x, written.curves[c].x);
    EXPECT_EQ(read.curves[c].y, written.curves[c].y);
  }
  EXPECT_EQ(read.common.delay_s, written.common.delay_s);
  EXPECT_EQ(read.common.percentage_change, written.common.percentage_change);
  EXPECT_EQ(read.common.damping, written.common.damping);
}

const ProjectMuscle& muscle_of(const ExportedProject& exported, std::size_t m) { return exported.project->muscles[m]; }

TEST(ExportedProject, IsReadBackEqualFromEachProgramsFile) {
  const ExactRun& run = ExactRun::get();
  // Each muscle has its own numbers of every kind.
  const run::StudyResult result = changed([](fit::IdentificationResult& fit) {
    fit.lag = fit::EmgLag::equation_1;
    for (std::size_t m = 0; m < fit.values.muscles.size(); ++m) {
      fit::MuscleValues& values = fit.values.muscles[m];
      const auto k = static_cast<double>(m);
      values[fit::kPennation] = 0.1 * k;
      values[fit::kTendonStrain] = 0.04 + 0.003 * k;
      values[fit::kShare] = 1.0 + 0.1 * k;
      values[fit::kLengthActivation] = 0.1;
      values[fit::kPassiveForce] = 0.2 + 0.1 * k;
      fit.values.channels[m][fit::kDelay] = 0.02 + 0.01 * k;
      fit.values.channels[m][fit::kExponent] = 1.0 - 0.05 * k;
    }
  });
  std::vector<ExportedProject> exported;
  for (const ExportFormat format : {ExportFormat::ceinms, ExportFormat::ceinms_rt, ExportFormat::osimx})
    exported.push_back(exported_project(result, format));
  const auto out = run.folder / "recording/results";
  write_exports(exported, out);
  const Project ceinms = opensim::read_project(out / "ceinms_calibrated.xml").value();
  expect_same(ceinms, *exported[0].project);
  EXPECT_EQ(ceinms.start.filename(), "ceinms_uncalibrated.xml");
  EXPECT_TRUE(std::filesystem::equivalent(ceinms.model, *result.source.study.model.file));
  EXPECT_EQ(ceinms.curves.size(), 4U);
  EXPECT_THAT(ceinms.remarks, testing::IsEmpty());
  const Project rt = opensim::read_project(out / "ceinms_rt_calibrated.xml").value();
  expect_same(rt, *exported[1].project);
  for (std::size_t m = 0; m < rt.muscles.size(); ++m) {
    ASSERT_EQ(rt.muscles[m].inputs.size(), 1U);
    EXPECT_EQ(rt.muscles[m].inputs[0].channel, result.fit_input.data.muscles[m].emg_channel);
    EXPECT_EQ(rt.muscles[m].inputs[0].weight, 1.0);
  }
  const Project osimx = opensim::read_project(out / "nmsm.osimx").value();
  expect_same(osimx, *exported[2].project);
  EXPECT_TRUE(std::filesystem::equivalent(osimx.model, *result.source.study.model.file));
  for (const Project* each : {&ceinms, &rt}) {
    ASSERT_EQ(each->dofs.size(), 1U);
    EXPECT_EQ(each->dofs[0].name, "elbow_flexion");
    EXPECT_EQ(each->dofs[0].muscles.size(), 4U);
  }
}

TEST(ExportedProject, HoldsTheFitsNumbersInTheUnitsOfThePrograms) {
  const ExactRun& run = ExactRun::get();
  const ExportedProject ceinms = exported_project(run.result, ExportFormat::ceinms);
  const ExportedProject osimx = exported_project(run.result, ExportFormat::osimx);
  for (std::size_t m = 0; m < 4; ++m) {
    const fit::MuscleValues values = run.values(m);
    const auto number = [&](const ExportedProject& of, MuscleQuantity quantity) {
      return muscle_of(of, m).numbers.at(quantity).value;
    };
    const std::string& name = muscle_of(ceinms, m).name;
    const double gain = run.result.fit.methods.front().values.channels[m][fit::kGain];
    expect_near(
        number(ceinms, MuscleQuantity::max_isometric_force) * number(ceinms, MuscleQuantity::strength_coefficient),
        values[fit::kMaxForce] * gain, name);
    expect_near(number(ceinms, MuscleQuantity::optimal_fiber_length), values[fit::kFiberLength], name);
    expect_near(number(ceinms, MuscleQuantity::max_contraction_velocity) * values[fit::kFiberLength],
                values[fit::kSpeed], name);
    expect_near(number(osimx, MuscleQuantity::max_isometric_force), values[fit::kMaxForce], name);
    expect_near(number(osimx, MuscleQuantity::tendon_slack_length), values[fit::kSlack], name);
  }
}

double interpolated(const opensim::ProjectCurve& curve, double x) {
  const auto after = std::upper_bound(curve.x.begin(), curve.x.end(), x);
  if (after == curve.x.begin()) return curve.y.front();
  if (after == curve.x.end()) return curve.y.back();
  const auto k = static_cast<std::size_t>(after - curve.x.begin());
  const double share = (x - curve.x[k - 1]) / (curve.x[k] - curve.x[k - 1]);
  return curve.y[k - 1] + share * (curve.y[k] - curve.y[k - 1]);
}

/// Computes the forces of a muscle from the subject that CEINMS would read, with a stiff tendon, no pennation and no
/// recursion: strength F_max (a f_l f_v + f_p), and compares them with ours.
double greatest_difference(const run::StudyResult& result, const Project& subject, std::size_t m, double speed) {
  const fit::StudyData& data = result.fit_input.data;
  const fit::IdentificationResult& fit = result.fit.methods.front();
  const auto number = [&](MuscleQuantity quantity) { return subject.muscles[m].numbers.at(quantity).value; };
  const double l0 = number(MuscleQuantity::optimal_fiber_length), shape = number(MuscleQuantity::shape_factor);
  const double force = number(MuscleQuantity::max_isometric_force) * number(MuscleQuantity::strength_coefficient);
  const double delay_s = fit.values.channels[m][fit::kDelay];
  double greatest = 0.0;
  for (const fit::TrialData& trial : data.trials) {
    const Eigen::Index column = trial.activation.index(data.muscles[m].emg_channel);
    const fit::Envelope envelope(trial.activation.time_s(), trial.activation.values().col(column));
    const auto own = fit::activation(envelope, trial.time_s, fit.values.channels[m], fit.lag);
    for (Eigen::Index k = 0; k < trial.time_s.size(); ++k) {
      const auto muscle = static_cast<Eigen::Index>(m);
      const double u = envelope.at(trial.time_s[k] - delay_s).value;
      const double a = (std::exp(shape * u) - 1.0) / (std::exp(shape) - 1.0);
      const double l = trial.length_m(k, muscle) - number(MuscleQuantity::tendon_slack_length);
      const double shift = 1.0 + *subject.common.percentage_change * (1.0 - a);
      const double theirs = force * (a * interpolated(subject.curves[0], l / (l0 * shift)) *
                                         interpolated(subject.curves[2], trial.velocity_mps(k, muscle) / (l0 * speed)) +
                                     interpolated(subject.curves[1], l / l0));
      const double ours = fit::tension_n(own[static_cast<std::size_t>(k)].value, trial.length_m(k, muscle),
                                         trial.velocity_mps(k, muscle), fit.values.muscles[m]);
      greatest = std::max(greatest, std::abs(theirs - ours) / fit.values.muscles[m][fit::kMaxForce]);
    }
  }
  return greatest;
}

/// Muscles with an own width, curvature and exponent each, a rigid tendon and no shift of the optimal length.
run::StudyResult unlike_muscles() {
  return changed([](fit::IdentificationResult& fit) {
    for (std::size_t m = 0; m < fit.values.muscles.size(); ++m) {
      fit::MuscleValues& values = fit.values.muscles[m];
      values[fit::kWidth] *= 1.0 + 0.1 * static_cast<double>(m);
      values[fit::kCurvature] *= 1.0 - 0.1 * static_cast<double>(m);
      values[fit::kTendonStrain] = values[fit::kPennation] = values[fit::kLengthActivation] = 0.0;
      fit.values.channels[m][fit::kExponent] = 1.0 - 0.1 * static_cast<double>(m);
    }
  });
}

// Tables of 0.02 optimal fiber lengths have an error below 0.02^2 / 8 times the curvature, 2 / 0.45^2: 5e-4.
TEST(ExportedProject, TellsTheGreatestDifferenceThatTheFilesLawMakes) {
  const run::StudyResult result = unlike_muscles();
  for (const ExportFormat format : {ExportFormat::ceinms, ExportFormat::ceinms_rt}) {
    const ExportedProject exported = exported_project(result, format);
    ASSERT_EQ(exported.differences.size(), 4U);
    for (std::size_t m = 0; m < 4; ++m) {
      const auto& numbers = exported.project->muscles[m].numbers;
      const double speed =
          format == ExportFormat::ceinms ? numbers.at(MuscleQuantity::max_contraction_velocity).value : 10.0;
      const double expected = greatest_difference(result, *exported.project, m, speed);
      EXPECT_NEAR(exported.differences[m].of_max_force, expected, 2e-3) << exported.differences[m].muscle;
      EXPECT_GT(expected, 0.005);
    }
    const auto warning = std::ranges::find(exported.remarks, Severity::warning, &Remark::severity);
    ASSERT_NE(warning, exported.remarks.end());
    double greatest = 0.0;
    for (const LawDifference& each : exported.differences) greatest = std::max(greatest, each.of_max_force);
    EXPECT_EQ(warning->value, greatest);
    EXPECT_EQ(warning->about, choice_name(format));
  }
}

TEST(ExportedProject, HasNoDifferenceWhereAllMusclesShareTheLaw) {
  const run::StudyResult alike = changed([](fit::IdentificationResult& fit) {
    for (fit::MuscleValues& values : fit.values.muscles) {
      values[fit::kWidth] = 0.45 * values[fit::kFiberLength];
      for (const int field : {fit::kCurvature, fit::kProduct, fit::kPlateau})
        values[static_cast<std::size_t>(field)] = fit.values.muscles.front()[static_cast<std::size_t>(field)];
      values[fit::kTendonStrain] = 0.0;
    }
  });
  const ExportedProject exported = exported_project(alike, ExportFormat::ceinms);
  // The shape factor of -1e-5 bends a line by 1e-5 / 8.
  for (const LawDifference& each : exported.differences) EXPECT_LT(each.of_max_force, 1e-5) << each.muscle;
  EXPECT_EQ(std::ranges::count(exported.remarks, Severity::warning, &Remark::severity), 0);
  EXPECT_EQ(exported.project->tendon, "stiff");
  EXPECT_EQ(exported.project->curves.size(), 3U);
}

TEST(ExportedProject, ChangesEachHeadOfAMuscleInItsProportion) {
  run::StudyResult result = ExactRun::get().result;
  result.source.study.muscles[0].osim = {"BIC", "BRA"};
  const auto head = [&](const char* name) {
    const body::BodyModel& model = *result.source.model;
    return model.muscles[static_cast<std::size_t>(model.muscle_index(name))].properties;
  };
  const muscle::HillParameters<double>& start = result.fit_input.data.muscles[0].start;
  const fit::MuscleValues values = ExactRun::get().values(0);
  const ExportedProject exported = exported_project(result, ExportFormat::osimx);
  ASSERT_EQ(exported.project->muscles.size(), 5U);
  for (const char* name : {"BIC", "BRA"}) {
    const auto& numbers = exported.project->find(name)->numbers;
    expect_near(numbers.at(MuscleQuantity::optimal_fiber_length).value,
                head(name).optimal_fiber_length_m * values[fit::kFiberLength] / start.optimal_fiber_length_m, name);
    expect_near(numbers.at(MuscleQuantity::max_isometric_force).value,
                head(name).max_isometric_force_n * values[fit::kMaxForce] / start.max_isometric_force_n, name);
  }
  EXPECT_EQ(exported.differences.size(), 4U);
}

TEST(ExportedProject, HasNamesWithoutBlanks) {
  run::StudyResult result = ExactRun::get().result;
  result.source.study.model.file.reset();
  result.source.study.model.builtin = "none";
  result.source.study.muscles[0].name = result.fit_input.data.muscles[0].name = "BIC (long)";
  const ExportedProject exported = exported_project(result, ExportFormat::ceinms);
  EXPECT_EQ(muscle_of(exported, 0).name, "BIC_long");
  EXPECT_EQ(exported.project->dofs[0].muscles[0], muscle_of(exported, 0).name);
  EXPECT_TRUE(exported.project->model.empty());
}

TEST(IdentifiedModel, IsThereOnlyIfSomethingWasIdentified) {
  const ExactRun& run = ExactRun::get();
  const auto out = run.folder / "some";
  run::StudyResult none = run.result;
  for (auto& method : none.fit.methods) {
    for (auto& e : method.estimates) e.verdict = fit::Verdict::weak;
  }
  run::StudyResult one = none;
  for (auto& e : one.fit.methods[0].estimates) {
    if (e.muscle == "BIC" && e.parameter == "optimal_fiber_length") e.verdict = fit::Verdict::identified;
  }
  write_identified_model(one, out);
  EXPECT_TRUE(std::filesystem::exists(out / (one.source.study.model.file->stem().string() + "_identified.osim")));
  write_identified_model(none, run.folder / "none");
  EXPECT_FALSE(std::filesystem::exists(run.folder / "none"));
}

TEST(ExportedProject, IsEmptyOfMethodPaperAlone) {
  run::StudyResult result = ExactRun::get().result;
  result.fit.methods.front().method = fit::Method::paper;
  const ExportedProject exported = exported_project(result, ExportFormat::osimx);
  EXPECT_FALSE(exported.project);
  ASSERT_EQ(exported.remarks.size(), 1U);
  EXPECT_EQ(exported.remarks[0].code, RemarkCode::refused);
  const test::TemporaryFolder folder;
  write_exports({exported}, folder.path());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace myoid::results
