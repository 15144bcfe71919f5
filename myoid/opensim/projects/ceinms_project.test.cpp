#include "myoid/opensim/projects/ceinms_project.h"

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/opensim/projects/ceinms_subject.h"
#include "myoid/opensim/projects/read_project.h"

#include "tests/support/temporary_folder.h"

namespace myoid::opensim {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Quantity = MuscleQuantity;

/// One <mtu> per line, so that faults have lines of their own.
std::string mtu(
    const std::string& name, double fiber_m, double slack_m, double strength, const std::string& more = "") {
  return "<mtu><name>" + name + "</name><c1>-0.5</c1><c2>-0.5</c2><shapeFactor>0.1</shapeFactor><optimalFibreLength>" +
         std::to_string(fiber_m) + "</optimalFibreLength><pennationAngle unit=\"deg\">30</pennationAngle>" +
         "<tendonSlackLength>" + std::to_string(slack_m) +
         "</tendonSlackLength><maxIsometricForce>1000</maxIsometricForce>" + "<strengthCoefficient>" +
         std::to_string(strength) + "</strengthCoefficient>" + more + "</mtu>\n";
}

std::string subject(const std::string& mtus, const std::string& info = "<uncalibrated/>") {
  return "<?xml "
         "version=\"1.0\"?>\n<subject>\n<mtuDefault><emDelay>0.015</emDelay><percentageChange>0.15</percentageChange>"
         "<damping>0.1</damping><curve><name>activeForceLength</name><xPoints>0 1 2</xPoints><yPoints>0 1 0</yPoints>"
         "</curve></mtuDefault>\n<mtuSet>\n" +
         mtus +
         "</mtuSet>\n<dofSet><dof><name>knee_angle_r</name><mtuNameSet>vaslat_r semiten_r</mtuNameSet></dof>"
         "<dof><name>hip_flexion_r</name><mtuNameSet>semiten_r "
         "iliacus_r</mtuNameSet></dof></dofSet>\n<calibrationInfo>" +
         info + "</calibrationInfo>\n<opensimModelFile>c:\\lab\\models\\scaled.osim</opensimModelFile>\n</subject>\n";
}

std::string before() {
  return subject(mtu("vaslat_r", 0.1, 0.2, 1.0) + mtu("semiten_r", 0.2, 0.25, 1.0) + mtu("iliacus_r", 0.1, 0.1, 1.0));
}

/// The slack of vaslat_r lies on its upper bound of 105 %, the strength of the knee's muscles on the lower of 0.5.
std::string after() {
  return subject(mtu("vaslat_r", 0.1, 0.21, 0.5, "<activationScale>0.9</activationScale>") +
                     mtu("semiten_r", 0.2, 0.255, 0.5) + mtu("iliacus_r", 0.1, 0.1, 1.0),
                 "<calibrated><startSubjectFile>.\\uncalibrated.xml</startSubjectFile>"
                 "<calibrationSequence>walk</calibrationSequence></calibrated>");
}

std::string table(double begin_s, double step_s, int rows) {
  std::string text = "x\nversion=1\nnRows=" + std::to_string(rows) + "\nnColumns=2\ninDegrees=no\nendheader\ntime\ta\n";
  for (int k = 0; k < rows; ++k) text += std::to_string(begin_s + step_s * k) + "\t0.5\n";
  return text;
}

/// A project of version 0.21 with a step of the knee: EMG at 1 kHz, lengths at 100 Hz, torques from the start of the
/// stretch used on.
void write_project(const test::TemporaryFolder& folder) {
  fs::create_directories(folder / "trials");
  write_file(folder / "setup.xml",
             "<?xml version=\"1.0\"?>\n<!-- made by hand -->\n<ceinmsCalibration>\n"
             "<subjectFile>.\\uncalibrated.xml</subjectFile>\n"
             "<excitationGeneratorFile>.\\excitation.xml</excitationGeneratorFile>\n"
             "<calibrationFile>calibration.xml</calibrationFile>\n"
             "<outputSubjectFile>.\\calibrated.xml</outputSubjectFile>\n</ceinmsCalibration>\n");
  write_file(folder / "uncalibrated.xml", before());
  write_file(folder / "calibrated.xml", after());
  write_file(folder / "scaled.osim", "<OpenSimDocument/>");
  write_file(folder / "excitation.xml",
             "<excitationGenerator><inputSignals type=\"EMG\">hams quads</inputSignals><mapping>"
             "<excitation id=\"semiten_r\"><input weight=\"0.75\">hams</input></excitation>"
             "<excitation id=\"vaslat_r\"/><excitation id=\"iliacus_r\"/></mapping></excitationGenerator>");
  write_file(
      folder / "calibration.xml",
      "<calibration><NMSmodel><type><openLoop/></type><tendon><equilibriumElastic/></tendon><activation>"
      "<exponential/></activation></NMSmodel><calibrationSteps><step><dofs>knee_angle_r</dofs><objectiveFunction>"
      "<torqueErrorNormalised/></objectiveFunction><parameterSet>"
      "<parameter><name>tendonSlackLength</name><single/><relativeToSubjectValue><range>0.95 1.05</range>"
      "</relativeToSubjectValue></parameter>"
      "<parameter><name>strengthCoefficient</name><global/><absolute><range>0.5 2.5</range></absolute></parameter>"
      "</parameterSet></step></calibrationSteps><trialSet>.\\trials\\walk.xml</trialSet></calibration>");
  const std::string files =
      "<muscleTendonLengthFile>lengths.sto</muscleTendonLengthFile><excitationsFile>.\\emg.mot</excitationsFile>"
      "<momentArmsFiles><momentArmsFile dofName=\"knee_angle_r\">arms.sto</momentArmsFile></momentArmsFiles>"
      "<externalTorquesFile>id.sto</externalTorquesFile>";
  write_file(folder / "trials/walk.xml", "<inputData>" + files + "<startStopTime>0.2 0.65</startStopTime></inputData>");
  write_file(folder / "trials/other.xml", "<inputData>" + files + "</inputData>");
  write_file(folder / "trials/emg.mot", table(0.0, 0.001, 1001));
  write_file(folder / "trials/lengths.sto", table(0.0, 0.01, 101));
  write_file(folder / "trials/arms.sto", table(0.0, 0.01, 101));
  write_file(folder / "trials/id.sto", table(0.2, 0.01, 46));
}

const ProjectNumber& number(const Project& project, const std::string& muscle, Quantity quantity) {
  return project.find(muscle)->numbers.at(quantity);
}

TEST(CeinmsProject, IsReadWithItsBoundsFromAFolder) {
  const test::TemporaryFolder folder;
  write_project(folder);
  const Project project = read_project(folder.path()).value();
  EXPECT_EQ(project.dialect, Dialect::ceinms);
  EXPECT_EQ(project.version, "0.21");
  EXPECT_TRUE(project.is_calibrated);
  EXPECT_EQ(project.tendon, "equilibriumElastic");
  EXPECT_EQ(project.activation, "exponential");
  EXPECT_EQ(project.common.delay_s, 0.015);
  ASSERT_EQ(project.curves.size(), 1U);
  EXPECT_THAT(project.curves[0].x, ElementsAre(0.0, 1.0, 2.0));
  // c:\lab\models\scaled.osim stands for the file of that name beside the subject.
  EXPECT_EQ(project.model.filename(), "scaled.osim");
  const ProjectNumber& slack = number(project, "vaslat_r", Quantity::tendon_slack_length);
  EXPECT_EQ(slack.start, 0.2);
  EXPECT_NEAR(slack.bounds->lower, 0.19, 1e-15);
  EXPECT_NEAR(slack.bounds->upper, 0.21, 1e-15);
  EXPECT_TRUE(slack.is_on_bound());
  EXPECT_FALSE(number(project, "semiten_r", Quantity::tendon_slack_length).is_on_bound());
  EXPECT_FALSE(number(project, "iliacus_r", Quantity::tendon_slack_length).unknown);
  // Two slacks, and one strength for both muscles of the knee.
  EXPECT_EQ(unknowns(project, Quantity::tendon_slack_length).all, 2U);
  EXPECT_EQ(unknowns(project, Quantity::tendon_slack_length).on_bound, 1U);
  EXPECT_EQ(unknowns(project, Quantity::strength_coefficient).all, 1U);
  EXPECT_EQ(unknowns(project, Quantity::strength_coefficient).on_bound, 1U);
  EXPECT_EQ(unknowns(project, Quantity::optimal_fiber_length).all, 0U);
  EXPECT_EQ(number(project, "vaslat_r", Quantity::activation_scale).value, 0.9);
}

TEST(CeinmsProject, NamesMusclesWithoutInputAndTheKneeWithoutExtensor) {
  const test::TemporaryFolder folder;
  write_project(folder);
  const Project project = read_project(folder.path()).value();
  EXPECT_THAT(muscles_without_emg(project), ElementsAre("vaslat_r", "iliacus_r"));
  EXPECT_THAT(knees_without_extensor(project), ElementsAre("knee_angle_r"));
  EXPECT_EQ(project.find("semiten_r")->inputs.at(0).channel, "hams");
  EXPECT_EQ(project.find("semiten_r")->inputs.at(0).weight, 0.75);
  write_file(folder / "excitation.xml",
             "<excitationGenerator><inputSignals>q</inputSignals><mapping><excitation id=\"vaslat_r\">"
             "<input weight=\"1\">q</input></excitation></mapping></excitationGenerator>");
  EXPECT_THAT(knees_without_extensor(read_project(folder.path()).value()), IsEmpty());
}

TEST(CeinmsProject, ReadsTheOperationsOfAnEmgGenerator) {
  const test::TemporaryFolder folder;
  write_project(folder);
  const auto write = [&](const std::string& last) {
    write_file(
        folder / "excitation.xml",
        "<emgGenerator><experimental><emg id=\"hams\"/><emg id=\"quads\"/></experimental><mapping>"
        "<emg id=\"semiten_r\" operation=\"assign\">\n hams\n</emg><emg id=\"vaslat_r\" operation=\"mean\">quads "
        "hams</emg>" +
            last + "</mapping><output>semiten_r vaslat_r</output></emgGenerator>");
  };
  write("<emg id=\"iliacus_r\" operation=\"nil\"/>");
  const Project project = read_project(folder.path()).value();
  EXPECT_THAT(muscles_without_emg(project), ElementsAre("iliacus_r"));
  EXPECT_EQ(project.find("semiten_r")->inputs.at(0).channel, "hams");
  EXPECT_EQ(project.find("semiten_r")->inputs.at(0).weight, 1.0);
  ASSERT_EQ(project.find("vaslat_r")->inputs.size(), 2U);
  EXPECT_EQ(project.find("vaslat_r")->inputs[1].channel, "hams");
  EXPECT_EQ(project.find("vaslat_r")->inputs[1].weight, 0.5);
  write("<emg id=\"iliacus_r\" operation=\"max\">hams quads</emg>");
  EXPECT_THROW((void)read_project(folder.path()), ReadError);
}

TEST(CeinmsProject, KeepsTheClocksOfATrialApart) {
  const test::TemporaryFolder folder;
  write_project(folder);
  const Project project = read_project(folder / "setup.xml").value();
  ASSERT_EQ(project.trials.size(), 2U);
  const ProjectTrial& walk = project.trials[0];
  EXPECT_EQ(walk.name, "walk");
  EXPECT_TRUE(walk.is_calibrating);
  EXPECT_FALSE(project.trials[1].is_calibrating);
  EXPECT_EQ(walk.used->begin_s, 0.2);
  EXPECT_EQ(walk.used->end_s, 0.65);
  for (const TrialFile& file : walk.files) {
    ASSERT_TRUE(file.time) << file.path;
    EXPECT_NEAR(file.rate_hz, file.role == TrialRole::emg ? 1000.0 : 100.0, 1e-6);
    if (file.role == TrialRole::torques) {
      EXPECT_EQ(file.time->begin_s, 0.2);
    }
    if (file.role == TrialRole::moment_arms) {
      EXPECT_EQ(file.dof, "knee_angle_r");
    }
  }
}

TEST(CeinmsProject, OfVersion09HasNoStretchAndAListOfTrials) {
  const test::TemporaryFolder folder;
  write_project(folder);
  write_file(folder / "setup.xml",
             "<ceinmsCalibration><subjectFile>uncalibrated.xml</subjectFile><emgGeneratorFile>excitation.xml"
             "</emgGeneratorFile><calibrationFile>calibration.xml</calibrationFile><outputSubjectFile>none.xml"
             "</outputSubjectFile></ceinmsCalibration>");
  write_file(folder / "calibration.xml",
             "<calibration><trialSet>trials/other.xml trials/walk.xml trials/lost.xml</trialSet></calibration>");
  const Project project = read_project(folder.path()).value();
  EXPECT_EQ(project.version, "0.9");
  EXPECT_FALSE(project.is_calibrated);
  ASSERT_EQ(project.trials.size(), 2U);
  EXPECT_EQ(project.trials[0].name, "other");
  EXPECT_FALSE(project.trials[0].used);
  EXPECT_TRUE(project.trials[0].is_calibrating && project.trials[1].is_calibrating);
  EXPECT_THAT(project.remarks, testing::Contains(testing::Field(&Remark::code, RemarkCode::refused)));
  EXPECT_TRUE(project.has_mapping);
}

TEST(CeinmsProject, HasTheWeightsOfItsHybridRuns) {
  const test::TemporaryFolder folder;
  write_project(folder);
  const auto execution = [](const char* alpha) {
    return std::string("<execution><NMSmodel><type><hybrid><alpha>") + alpha +
           "</alpha><beta>2</beta><gamma>35.5</gamma><dofSet>knee_angle_r</dofSet><synthMTUs>iliacus_r</synthMTUs>"
           "<adjustMTUs>semiten_r</adjustMTUs></hybrid></type></NMSmodel></execution>";
  };
  EXPECT_FALSE(read_project(folder.path())->hybrid);
  write_file(folder / "run_a.xml", execution("1"));
  Project project = read_project(folder.path()).value();
  EXPECT_EQ(project.hybrid, (HybridWeights{1.0, 2.0, 35.5}));
  EXPECT_THAT(project.synthesized, ElementsAre("iliacus_r"));
  EXPECT_THAT(project.remarks, IsEmpty());
  write_file(folder / "run_b.xml", execution("3"));
  project = read_project(folder.path()).value();
  EXPECT_EQ(project.hybrid->torque, 1.0);
  ASSERT_EQ(project.remarks.size(), 1U);
  EXPECT_EQ(project.remarks[0].where, "run_b.xml");
  write_file(folder / "run_b.xml", execution("much"));
  EXPECT_THROW((void)read_project(folder.path()), ReadError);
}

TEST(CeinmsProject, TellsTablesThatAreCutOrUnreadable) {
  const test::TemporaryFolder folder;
  write_project(folder);
  const auto about = [&](const Project& project, const char* role) {
    std::vector<RemarkCode> codes;
    for (const Remark& remark : project.remarks)
      if (remark.about == role && remark.severity == Severity::warning) codes.push_back(remark.code);
    return codes;
  };
  // The header promises 1001 rows.
  const std::string whole = table(0.0, 0.001, 1001);
  write_file(folder / "trials/emg.mot", whole.substr(0, whole.find("0.500000\t")));
  write_file(folder / "trials/id.sto", "nothing of a table\n");
  const Project project = read_project(folder.path()).value();
  // Both trials use both files.
  EXPECT_THAT(about(project, "emg"), ElementsAre(RemarkCode::reading, RemarkCode::reading));
  EXPECT_THAT(about(project, "torques"), ElementsAre(RemarkCode::refused, RemarkCode::refused));
  EXPECT_THAT(about(project, "lengths"), IsEmpty());
}

TEST(CeinmsSubject, HasPennationInRadiansWhateverItsUnit) {
  const test::TemporaryFolder folder;
  const fs::path path = folder / "s.xml";
  write_file(path, before());
  EXPECT_NEAR(read_ceinms_subject(path).muscles[0].numbers.at(Quantity::pennation_angle).value, std::numbers::pi / 6.0,
              1e-15);
  std::string text = before();
  text.replace(text.find(" unit=\"deg\""), 11, "");  // of the first muscle alone: 30 rad
  write_file(path, text);
  const CeinmsSubject subject = read_ceinms_subject(path);
  EXPECT_EQ(subject.muscles[0].numbers.at(Quantity::pennation_angle).value, 30.0);
  ASSERT_EQ(subject.remarks.size(), 1U);
  EXPECT_EQ(subject.remarks[0].code, RemarkCode::unit_doubtful);
  EXPECT_EQ(subject.remarks[0].about, "pennation_angle_rad");
}

TEST(CeinmsSubject, AloneTellsWhatChangedFromItsStart) {
  const test::TemporaryFolder folder;
  write_project(folder);
  for (const char* name : {"setup.xml", "calibration.xml", "excitation.xml"}) fs::remove(folder / name);
  fs::remove_all(folder / "trials");
  const Project project = read_project(folder / "calibrated.xml").value();
  EXPECT_EQ(project.start.filename(), "uncalibrated.xml");
  EXPECT_EQ(unknowns(project, Quantity::tendon_slack_length).all, 2U);
  EXPECT_EQ(unknowns(project, Quantity::strength_coefficient).all, 1U);
  EXPECT_EQ(unknowns(project, Quantity::tendon_slack_length).on_bound, 0U);  // no file tells the bounds
  EXPECT_THAT(muscles_without_emg(project), IsEmpty());                      // nor the channels
}

/// Returns the line that the reader names for a subject in which `found` stands instead of `expected`.
std::size_t refused_line(const std::string& expected, const std::string& found) {
  const test::TemporaryFolder folder;
  std::string text = before();
  const auto at = text.find(expected);
  text.replace(at, expected.size(), found);
  write_file(folder / "s.xml", text);
  try {
    (void)read_ceinms_subject(folder / "s.xml");
  } catch (const ReadError& error) {
    return error.line();
  }
  return 0;
}

TEST(CeinmsSubject, RefusesDamagedNumbersWithTheirLine) {
  EXPECT_EQ(refused_line("0.200000</tendonSlackLength>", "nan</tendonSlackLength>"), 5U);
  EXPECT_EQ(refused_line("0.200000</tendonSlackLength>", "-0.2</tendonSlackLength>"), 5U);
  EXPECT_EQ(refused_line("0.200000</tendonSlackLength>", "inf</tendonSlackLength>"), 5U);
  EXPECT_EQ(refused_line("0.200000</tendonSlackLength>", "0.2 0.3</tendonSlackLength>"), 5U);
  EXPECT_EQ(refused_line("<tendonSlackLength>0.250000</tendonSlackLength>", ""), 6U);
  EXPECT_EQ(refused_line("<name>semiten_r</name>", "<name>vaslat_r</name>"), 6U);
  EXPECT_EQ(refused_line("<name>semiten_r</name>", ""), 6U);
  EXPECT_EQ(refused_line("<xPoints>0 1 2</xPoints>", "<xPoints>0 2 1</xPoints>"), 3U);
  EXPECT_EQ(refused_line("<xPoints>0 1 2</xPoints>", "<xPoints>0 1</xPoints>"), 3U);
  EXPECT_EQ(refused_line("unit=\"deg\"", "unit=\"turn\""), 5U);
  EXPECT_GT(refused_line("</mtuSet>", ""), 0U);
}

TEST(CeinmsSubject, NamesUnknownElementsOnceAndMillimetersAsDoubtful) {
  const test::TemporaryFolder folder;
  write_file(folder / "s.xml", subject(mtu("a", 100.0, 0.2, 1.0, "<colour>red</colour>") +
                                       mtu("b", 0.1, 0.2, 1.0, "<colour>red</colour>")));
  const CeinmsSubject read = read_ceinms_subject(folder / "s.xml");
  int colours = 0, lengths = 0;
  for (const Remark& remark : read.remarks) {
    colours += remark.about == "colour" ? 1 : 0;
    lengths += remark.about == "optimal_fiber_length_m" && remark.code == RemarkCode::unit_doubtful ? 1 : 0;
  }
  EXPECT_EQ(colours, 1);
  EXPECT_EQ(lengths, 1);
}

TEST(CeinmsProject, RefusesACutSetUpAndAMissingSubjectAndAReversedRange) {
  const test::TemporaryFolder folder;
  write_project(folder);
  write_file(folder / "calibration.xml",
             "<calibration><calibrationSteps><step>\n<dofs>knee_angle_r</dofs><parameterSet>\n"
             "<parameter><name>c1</name><absolute><range>1 0</range></absolute></parameter>"
             "</parameterSet></step></calibrationSteps></calibration>");
  EXPECT_THROW((void)read_project(folder.path()), ReadError);
  write_file(folder / "calibration.xml", "<calibration><calibrationSteps>");
  EXPECT_THROW((void)read_project(folder.path()), ReadError);
  fs::remove(folder / "uncalibrated.xml");
  EXPECT_THROW((void)read_project(folder.path()), ReadError);
  write_file(folder / "setup.xml", "<ceinmsCalibration><subjectFile>calibrated.xml");
  EXPECT_THROW((void)read_project(folder.path()), ReadError);
}

}  // namespace
}  // namespace myoid::opensim
