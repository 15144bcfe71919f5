#include "myoid/results/methods_text.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/counted.h"
#include "myoid/page/typeset.h"
#include "myoid/results/references.h"
#include "myoid/run/study_emg.h"
#include "myoid/study/study_model.h"

namespace myoid::results {
namespace {

using fit::EmgLag;
using fit::IdentificationResult;

/// Greatest joint motion of a maximal contraction that counts as isometric.
constexpr double kIsometricRange_deg = 15.0;

/// Writes sentences one after the other and collects the references that they cite.
class Writer {
 public:
  template <typename... Values>
  void say(fmt::format_string<Values...> sentence, Values&&... values) {
    if (!text_.paragraph.empty()) text_.paragraph += ' ';
    text_.paragraph += fmt::format(sentence, std::forward<Values>(values)...);
  }
  /// Returns " (Lu and O'Connor 1999)".
  std::string cite(std::string_view key) {
    if (std::ranges::find(text_.keys, key) == text_.keys.end()) text_.keys.emplace_back(key);
    return fmt::format(" ({})", reference(key).cited);
  }
  MethodsText take() { return std::move(text_); }

 private:
  MethodsText text_;
};

/// Returns "a, b and c".
std::string listed(const std::vector<std::string>& words) {
  if (words.size() < 2) return words.empty() ? "" : words.front();
  return fmt::format("{} and {}", fmt::join(words.begin(), words.end() - 1, ", "), words.back());
}

template <typename Predicate>
std::size_t count_trials(const run::StudyResult& result, const Predicate& is) {
  return static_cast<std::size_t>(std::ranges::count_if(result.trials, is));
}

std::string joints_of(const run::StudyResult& result) {
  std::vector<std::string> names;
  for (const std::string& name : study::study_coordinates(result.source.study.model))
    names.push_back(page::spelled(name));
  return listed(names);
}

void say_trials(const run::StudyResult& result, Writer& out) {
  std::vector<std::string> parts;
  const auto add = [&](study::Use use, std::string_view what) {
    const std::size_t n = count_trials(result, [&](const run::TrialResult& t) { return t.spec.use == use; });
    if (n > 0) parts.push_back(fmt::format("{} {}", n, what));
  };
  add(study::Use::calibration, "of movement");
  add(study::Use::isometric, "of isometric effort");
  add(study::Use::mvc, "of maximal voluntary contraction (MVC)");
  add(study::Use::passive, "of passive movement");
  add(study::Use::static_pose, "of a static posture");
  add(study::Use::validation, "held back for validation");
  out.say("Muscle parameters were identified from {}: {}.", counted(result.trials.size(), "trial"), listed(parts));
  if (result.start_s || result.end_s)
    out.say("The time from {} to {} of each trial was used.",
            result.start_s ? fmt::format("{:g} s", *result.start_s) : "its begin",
            result.end_s ? fmt::format("{:g} s", *result.end_s) : "its end");
  if (const int failed = run::failed_trials(result.trials); failed > 0)
    out.say("{} could not be computed and took no part.", counted(static_cast<std::size_t>(failed), "trial"));
}

void say_motion(const run::StudyResult& result, Writer& out) {
  const study::Study& study = result.source.study;
  if (study.model.is_none()) {
    out.say("Lengths and moment arms of the muscles were given, computed by another program.");
    return;
  }
  const bool given_model = study.model.file || !study.model.text.empty();
  const std::string model = fmt::format("the {} {}{}", given_model ? "musculoskeletal model" : "built-in model",
                                        result.source.model->name, given_model ? out.cite("delp2007") : "");
  const std::size_t fitted = count_trials(result, [](const run::TrialResult& t) { return t.motion.ik.has_value(); });
  const std::size_t given = count_trials(result, [](const run::TrialResult& t) { return t.input.motion.has_value(); });
  if (fitted > 0)
    out.say(
        "Joint angles of {} were found from marker positions by inverse kinematics, a weighted least-squares fit of "
        "the whole chain{} in every frame.",
        model, out.cite("lu1999"));
  if (given > 0)
    out.say("{} of {} were given{}.", fitted > 0 ? "Other joint angles" : "Joint angles", model,
            fitted > 0 ? fmt::format(" for {}", counted(given, "trial")) : "");
  const auto cutoff = study::motion_cutoff_hz(study);
  if (cutoff)
    out.say(
        "Angles were smoothed by quintic splines{} with a cut-off frequency of {:g} Hz (-3 dB), which also gave "
        "velocities and accelerations.",
        out.cite("woltring1986"), *cutoff);
  else
    out.say("Angles were not smoothed; quintic splines gave velocities and accelerations.");
}

void say_torque(const run::StudyResult& result, Writer& out) {
  const std::size_t given =
      count_trials(result, [](const run::TrialResult& t) { return t.spec.given.torques.has_value(); });
  if (given > 0)
    out.say("The torque of the muscles about {} was given for {}.", joints_of(result), counted(given, "trial"));
  if (result.source.study.model.is_none()) return;
  std::vector<std::string> from;
  const auto add = [&](const auto& is, std::string_view what) {
    if (count_trials(result, is) > 0) from.emplace_back(what);
  };
  add([](const run::TrialResult& t) { return t.has_motion(); }, "the motion");
  add([](const run::TrialResult& t) { return t.spec.external_torque.has_value(); },
      "measured torques of the dynamometer");
  add([](const run::TrialResult& t) { return t.spec.plates.has_value(); }, "forces of force plates");
  add([](const run::TrialResult& t) { return t.spec.load_cell.has_value(); }, "forces of a load cell");
  add([](const run::TrialResult& t) { return t.spec.external_loads.has_value(); }, "measured external forces");
  add([](const run::TrialResult& t) { return t.spec.held_mass_kg.value_or(0.0) > 0.0; }, "held masses");
  out.say("The torque of the muscles about {} was found by inverse dynamics{}.", joints_of(result),
          from.empty() ? "" : fmt::format(" from {}", listed(from)));
}

/// Returns true if the joint hardly moves in any maximal contraction; false if unknown.
bool isometric_mvc(const run::StudyResult& result) {
  bool any = false;
  for (const run::TrialResult& trial : result.trials) {
    if (trial.spec.use != study::Use::mvc) continue;
    if (!trial.has_motion()) return false;
    for (const std::string& name : study::study_coordinates(result.source.study.model)) {
      const auto column = trial.motion.joints.q.find(name);
      if (!column) return false;
      const auto angle = trial.motion.joints.q.values().col(*column);
      any = true;
      if ((angle.maxCoeff() - angle.minCoeff()) / kDegree > kIsometricRange_deg) return false;
    }
  }
  return any;
}

std::string cede_name(const run::StudyResult& result) {
  const auto& channels = result.emg.normalisation;
  const auto from_mvc =
      static_cast<std::size_t>(std::ranges::count_if(channels, [](const auto& n) { return n.from_mvc; }));
  if (from_mvc == 0) return "normalization to the peak EMG amplitude in the task";
  const std::string name =
      isometric_mvc(result) ? "normalization to a standardized isometric MVC" : "normalization to MVC";
  if (from_mvc == channels.size()) return name;
  std::vector<std::string> others;
  for (const auto& n : channels)
    if (!n.from_mvc) others.push_back(n.channel);
  return fmt::format("{}, and for {} to the peak EMG amplitude in the task", name, listed(others));
}

void say_emg(const run::StudyResult& result, Writer& out) {
  const recording::EmgChain chain = run::emg_chain(result, nullptr);
  if (chain.steps.empty()) return;
  for (const std::string& sentence : chain.methods) out.say("{}", sentence);
  if (result.emg.whitening.applied) out.say("Whitening lessens the noise of the envelope{}.", out.cite("clancy1994"));
  if (result.source.study.emg.kind == study::EmgKind::activation) {
    out.say("How the activations were normalized was not known to the program, as the CEDE consensus{} asks to report.",
            out.cite("besomi2020"));
    return;
  }
  out.say("In the terms of the CEDE consensus{} this was {}.", out.cite("besomi2020"), cede_name(result));
  const study::EmgSpec& emg = result.source.study.emg;
  if (emg.has_mvc && (emg.mvc_effort < 1.0 || emg.mvc_effort_sd > 0.0))
    out.say("Maximal contractions were taken to reach {:g} +- {:g} % of the muscles' full force.",
            100.0 * emg.mvc_effort, 100.0 * emg.mvc_effort_sd);
}

std::string delay_text(const run::StudyResult& result) {
  const auto& held = result.source.study.emg.delay_s;
  if (held) return fmt::format("a delay of {:g} ms", 1e3 * *held);
  return result.source.study.identify.delay_per_channel ? "a delay that was estimated for each channel"
                                                        : "a delay that was estimated";
}

std::string lag_text(const run::StudyResult& result, EmgLag lag) {
  switch (lag) {
    case EmgLag::delay:
      return fmt::format("Activation was the normalized envelope after {}.", delay_text(result));
    case EmgLag::shared:
      return fmt::format(
          "Activation was the normalized envelope after {}, which was split into a pure delay and two first-order lags "
          "of excitation and activation.",
          delay_text(result));
    case EmgLag::equation_1:
      return fmt::format(
          "Activation was the normalized envelope after {} and two first-order lags of excitation and activation.",
          delay_text(result));
  }
  return "";
}

void say_muscles(const run::StudyResult& result, Writer& out) {
  const bool of_model = study::takes_model_law(result.source.study);
  std::vector<std::string> names;
  for (const auto& muscle : result.fit_input.data.muscles) names.push_back(muscle.name);
  out.say(
      "{} {} a Hill-type law{}: a Gaussian force-length relation, a hyperbolic force-velocity relation for shortening "
      "and another one for lengthening, {}, and {}.",
      names.size() == 1 ? fmt::format("The muscle {}", listed(names)) : fmt::format("The muscles {}", listed(names)),
      names.size() == 1 ? "followed" : "each followed", out.cite("venture2006"),
      of_model ? "pennation and passive force of the model" : "without pennation and passive force",
      result.source.study.identify.elastic_tendon ? "a quasi-static elastic tendon" : "a rigid tendon");
  const IdentificationResult* torque = run::method_of(result.fit, fit::Method::torque);
  if (torque != nullptr) out.say("{}", lag_text(result, torque->lag));
}

void say_posterior(const study::IdentifySpec& spec, const IdentificationResult& torque, Writer& out) {
  if (torque.exact) {
    out.say(
        "The data were free of noise: all parameters were estimated from {} samples of the torque by plain least "
        "squares, without prior distributions.",
        torque.samples_used);
    return;
  }
  out.say(
      "All parameters were estimated from {} samples of the torque as the mean of their posterior density about its "
      "mode, with prior distributions from the literature, integrated over errors of moment arms, tendons, the scale "
      "of the torque, cross-talk and electrode drift. Repetitions of a movement repeat its errors: the samples count "
      "as {:.0f} independent ones (a coarsened posterior; Miller and Dunson, J. Am. Stat. Assoc. 114, 1113, 2019). 95 "
      "% intervals are {}.",
      torque.samples_used, torque.effective_samples,
      spec.posterior_draws > 0
          ? fmt::format("those of {} draws by Hamiltonian Monte Carlo", spec.posterior_draws)
          : "those of the posterior's marginal densities, which follow the density to two standard deviations about "
            "the mode and include the volume of the other parameters (a simplified Laplace approximation; Rue, Martino "
            "and Chopin, J. R. Stat. Soc. B 71, 319, 2009)");
}

void say_fit(const run::StudyResult& result, Writer& out) {
  const study::IdentifySpec& spec = result.source.study.identify;
  const IdentificationResult* torque = run::method_of(result.fit, fit::Method::torque);
  if (torque != nullptr) {
    say_posterior(spec, *torque, out);
    out.say(
        "Each parameter was classed as identified, weak, dominated by its prior, or not identifiable by this "
        "recording.");
  }
  if (run::method_of(result.fit, fit::Method::force) != nullptr)
    out.say("The parameters of each muscle were also fitted to its own force, as force sharing assigns it.");
  if (run::method_of(result.fit, fit::Method::paper) != nullptr)
    out.say(
        "{} the method as published{} was applied: each muscle alone, shortening and lengthening apart, by "
        "Gauss-Newton steps, halved until the criterion falls, or damped, on forces that minimize the sum of {} to the "
        "power "
        "{:g}{}.",
        torque != nullptr ? "For comparison" : "As the only method,", out.cite("venture2006"),
        result.source.study.sharing.objective == body::SharingObjective::activation ? "activations"
        : result.source.study.sharing.objective == body::SharingObjective::force    ? "muscle forces"
                                                                                    : "muscle stresses",
        result.source.study.sharing.exponent, out.cite("crowninshield1981"));
}

void say_validation(const run::StudyResult& result, Writer& out) {
  using fit::FoldKind;
  if (!result.folds.empty()) {
    const FoldKind kind = result.source.study.identify.folds;
    out.say("For validation each {} in turn was left out of the fit, and its torque predicted.",
            kind == FoldKind::trial       ? "trial"
            : kind == FoldKind::condition ? "condition"
                                          : "fifth of the trials");
  }
  if (result.source.study.phases.search && !result.fit_input.phases.empty()) {
    std::vector<std::string> kinds;
    for (const study::PhaseKind kind : result.source.study.phases.exclude)
      kinds.push_back(page::spelled(choice_name(kind)));
    if (!kinds.empty())
      out.say("Phases that an automatic search found to be {} were not fitted.", fmt::join(kinds, " or "));
  }
}

Reference program_reference(const MethodsText& text) {
  return {.key = "myoid",
          .cited = "Myoid",
          .kind = "misc",
          .authors = "{The Myoid contributors}",
          .title = "Myoid: identification of a person's muscle parameters from motion capture and EMG",
          .volume = text.version};
}

/// Returns "The Myoid contributors. Myoid: ... Version 0.1.0."
std::string printed_program(const MethodsText& text) {
  const Reference program = program_reference(text);
  return fmt::format("The Myoid contributors. {}. Version {}.", program.title, text.version);
}

}  // namespace

MethodsText methods_text(const run::StudyResult& result, const Provenance& provenance) {
  Writer out;
  say_trials(result, out);
  say_motion(result, out);
  say_torque(result, out);
  say_emg(result, out);
  say_muscles(result, out);
  say_fit(result, out);
  say_validation(result, out);
  out.say("All computations were made with Myoid {}.", provenance.version);
  MethodsText text = out.take();
  text.version = provenance.version;
  return text;
}

std::string methods_file(const MethodsText& text) {
  std::string file = page::typographic(text.paragraph) + "\n\nReferences\n\n";
  for (const std::string& key : text.keys) file += printed(reference(key)) + "\n";
  return file + printed_program(text) + "\n";
}

std::string methods_bibtex(const MethodsText& text) {
  std::string file;
  for (const std::string& key : text.keys) file += bibtex(reference(key)) + "\n";
  return file + bibtex(program_reference(text));
}

page::Section methods_section(const MethodsText& text) {
  page::Table table{.id = "references", .title = "References", .columns = {"key", "reference"}};
  for (const std::string& key : text.keys) table.rows.push_back({{key}, {printed(reference(key))}});
  table.rows.push_back({{"myoid"}, {printed_program(text)}});
  return {.id = "methods",
          .heading = "Methods, ready to paste",
          .paragraphs = {text.paragraph,
                         "The same text is in `methods.txt`; `methods.bib` has the references for BibTeX. State which "
                         "ethics approval, laboratory and instruments the data come from: the files do not say so."},
          .tables = {std::move(table)}};
}

}  // namespace myoid::results
