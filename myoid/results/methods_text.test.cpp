#include "myoid/results/methods_text.h"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/results/references.h"

namespace myoid::results {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// A study of two movements and a maximal contraction with raw EMG, as far as the text reads it.
run::StudyResult small_study() {
  run::StudyResult result;
  study::Study& study = result.source.study;
  study.model.coordinate = "elbow_flexion";
  study.emg.chain.lowpass_hz = 4.0;
  study.motion.smoothing = study::Smoothing::cutoff;
  study.motion.cutoff_hz = 5.0;
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(101, 0.0, 1.0);
  for (const study::Use use : {study::Use::calibration, study::Use::calibration, study::Use::mvc}) {
    run::TrialResult trial;
    trial.spec.use = use;
    trial.emg.activation = TimeSeries(t, {{"BIC", Unit::dimensionless}}, Eigen::VectorXd(0.1 * t));
    trial.motion.joints.q =
        TimeSeries(t, {{"elbow_flexion", Unit::radian}}, Eigen::VectorXd((use == study::Use::mvc ? 0.0 : 1.5) * t));
    trial.motion.ik.emplace();
    result.trials.push_back(std::move(trial));
  }
  result.emg.normalisation.resize(2);
  result.emg.normalisation[1].channel = "TRI";
  for (recording::ChannelNormalisation& channel : result.emg.normalisation) channel.from_mvc = true;
  result.fit_input.data.muscles.resize(2);
  result.fit_input.data.muscles[0].name = "BIC";
  result.fit_input.data.muscles[1].name = "TRI";
  result.fit.methods.resize(1);
  result.fit.methods[0].method = fit::Method::torque;
  result.fit.methods[0].samples_used = 321;
  return result;
}

MethodsText methods_of(const run::StudyResult& result) {
  Provenance provenance;
  provenance.version = "9.8.7";
  return methods_text(result, provenance);
}

std::string text_of(const run::StudyResult& result) { return methods_of(result).paragraph; }

TEST(MethodsText, NamesTrialsFiltersEstimatorAndVersion) {
  EXPECT_THAT(text_of(small_study()),
              AllOf(HasSubstr("from 3 trials: 2 of movement and 1 of maximal voluntary"),
                    HasSubstr("cut-off frequency of 5 Hz (-3 dB)"),
                    HasSubstr("low-pass filtered (zero-lag fourth-order Butterworth filter, cut-off "
                              "frequency 4 Hz)"),
                    HasSubstr("inverse kinematics"), HasSubstr("The muscles BIC and TRI each"),
                    HasSubstr("a quasi-static elastic tendon"), HasSubstr("from 321 samples"), HasSubstr("posterior"),
                    HasSubstr("Myoid 9.8.7.")));
}

TEST(MethodsText, ChangesWithTheStudy) {
  const std::string before = text_of(small_study());
  const auto changed = [&](const auto& change) {
    run::StudyResult result = small_study();
    change(result);
    const std::string text = text_of(result);
    EXPECT_NE(text, before);
    return text;
  };
  EXPECT_THAT(changed([](run::StudyResult& r) { r.source.study.emg.chain.lowpass_hz = 3.0; }),
              AllOf(HasSubstr("cut-off frequency 3 Hz"), Not(HasSubstr("frequency 4 Hz"))));
  EXPECT_THAT(changed([](run::StudyResult& r) { r.source.study.motion.cutoff_hz = 8.0; }),
              HasSubstr("cut-off frequency of 8 Hz"));
  EXPECT_THAT(changed([](run::StudyResult& r) { r.source.study.motion.smoothing = study::Smoothing::none; }),
              HasSubstr("Angles were not smoothed"));
  EXPECT_THAT(changed([](run::StudyResult& r) { r.source.study.identify.elastic_tendon = false; }),
              HasSubstr("a rigid tendon"));
  EXPECT_THAT(changed([](run::StudyResult& r) { r.source.study.emg.delay_s = 0.05; }), HasSubstr("a delay of 50 ms"));
  EXPECT_THAT(changed([](run::StudyResult& r) { r.source.study.identify.posterior_draws = 500; }),
              HasSubstr("500 draws by Hamiltonian Monte Carlo"));
  EXPECT_THAT(changed([](run::StudyResult& r) { r.fit.methods[0].exact = true; }), HasSubstr("plain least squares"));
  EXPECT_THAT(changed([](run::StudyResult& r) { r.trials[1].spec.use = study::Use::validation; }),
              HasSubstr("1 of movement, 1 of maximal voluntary contraction (MVC) and 1 held back"));
  EXPECT_THAT(changed([](run::StudyResult& r) {
                r.fit.methods.emplace_back();
                r.fit.methods[1].method = fit::Method::paper;
              }),
              HasSubstr("For comparison the method as published (Venture et al. 2006)"));
}

TEST(MethodsText, NamesTheNormalizationAsTheConsensusDoes) {
  run::StudyResult result = small_study();
  EXPECT_THAT(text_of(result), AllOf(HasSubstr("CEDE consensus (Besomi et al. 2020)"),
                                     HasSubstr("normalization to a standardized isometric MVC.")));
  // A maximal contraction in which the joint moves is none of a standardized isometric kind.
  result.trials[2].motion.joints.q = result.trials[0].motion.joints.q;
  EXPECT_THAT(text_of(result), HasSubstr("this was normalization to MVC."));
  result.emg.normalisation[1].from_mvc = false;
  EXPECT_THAT(text_of(result), HasSubstr("normalization to MVC, and for TRI to the peak EMG"));
  result.emg.normalisation[0].from_mvc = false;
  EXPECT_THAT(text_of(result), HasSubstr("was normalization to the peak EMG amplitude in the task"));
  result.source.study.emg.kind = study::EmgKind::activation;
  EXPECT_THAT(text_of(result), HasSubstr("was not known to the program"));
}

TEST(MethodsText, EveryCitationIsInBothFiles) {
  const MethodsText text = methods_of(small_study());
  const std::string file = methods_file(text);
  const std::string bib = methods_bibtex(text);
  EXPECT_FALSE(text.keys.empty());
  for (const Reference& r : all_references()) {
    const bool cited = text.paragraph.find(r.cited) != std::string::npos;
    EXPECT_EQ(cited, bib.find(bibtex(r)) != std::string::npos) << r.key;
    EXPECT_EQ(cited, file.find(printed(r)) != std::string::npos) << r.key;
  }
  EXPECT_THAT(bib, AllOf(HasSubstr("@misc{myoid,"), HasSubstr("version = {9.8.7}")));
  EXPECT_EQ(std::count(bib.begin(), bib.end(), '{'), std::count(bib.begin(), bib.end(), '}'));
}

TEST(References, HaveKeysOfTheirOwnAndTheFieldsOfTheirKind) {
  std::set<std::string_view> keys;
  for (const Reference& r : all_references()) {
    EXPECT_TRUE(keys.insert(r.key).second) << r.key;
    EXPECT_FALSE(r.authors.empty() || r.title.empty() || r.container.empty()) << r.key;
    EXPECT_TRUE(r.key.ends_with(r.year) && r.cited.ends_with(r.year)) << r.key;
    EXPECT_EQ(r.kind == "article", r.doi.starts_with("10.")) << r.key;
  }
  EXPECT_EQ(printed(reference("lu1999")),
            "Lu, T. W.; O'Connor, J. J. (1999) Bone position estimation from skin marker "
            "co-ordinates using global optimisation with joint constraints. Journal of "
            "Biomechanics 32(2): 129-134. doi:10.1016/S0021-9290(98)00158-4");
}

}  // namespace
}  // namespace myoid::results
