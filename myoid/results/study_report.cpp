#include "myoid/results/study_report.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/page/typeset.h"
#include "myoid/results/answer.h"
#include "myoid/results/methods_text.h"
#include "myoid/results/paper_tables.h"
#include "myoid/results/parameter_tables.h"
#include "myoid/results/phases_report.h"
#include "myoid/results/study_figures.h"
#include "myoid/results/torque_report.h"
#include "myoid/results/voluntary_report.h"
#include "myoid/run/design/design_report.h"
#include "myoid/run/effort_prior.h"
#include "myoid/run/quality_gates.h"
#include "myoid/run/recording_faults.h"
#include "myoid/run/study_emg.h"
#include "myoid/study/study_ids.h"
#include "myoid/study/study_model.h"

namespace myoid::results {
namespace {

using fit::IdentificationResult;
using fit::ParameterEstimate;
using fit::Verdict;
using page::Figure;
using page::Section;
using page::Table;

std::vector<std::string> assumptions(const run::StudyResult& result) {
  std::vector<std::string> list = result.source.study.subject.assumptions;
  if (std::string assumed = study::assumed_starts(result.source.study); !assumed.empty())
    list.push_back(std::move(assumed));
  list.push_back(
      result.source.study.identify.elastic_tendon
          ? "Tendons stretch by the strain that the model gives them, quasi-statically."
          : "The tendon is taken as rigid: fiber length = musculotendon length - tendon slack length. Optimal fiber "
            "length and tendon slack length then act only together; the slack length is held.");
  list.push_back(fmt::format("{}; the muscles are effective ones that stand for all heads lumped into them.",
                             study::takes_model_law(result.source.study)
                                 ? "Pennation and passive muscle force come from the model"
                                 : "Pennation and passive muscle force are neglected, as in the source paper"));
  const bool freed = std::ranges::any_of(result.fit.methods, [](const IdentificationResult& method) {
    return std::ranges::find(method.estimates, "max_shortening_speed", &ParameterEstimate::parameter) !=
           method.estimates.end();
  });
  list.push_back(freed ? "v_max is identified with the other numbers unless the study states it; where it is held, as "
                         "always in method paper, its error goes into V_sh."
                       : "v_max is held at its starting value; an error in it goes into V_sh.");
  list.push_back(
      "At low activation the optimal length is longer than at full activation (about 15 %); the l0 given here belongs "
      "to the activations of this recording.");
  for (const auto& muscle : result.source.study.muscles) {
    if (muscle.same_as)
      list.push_back(
          fmt::format("{} has no electrode: it is taken to act as {} does. Their strengths can hardly be told apart.",
                      muscle.name, *muscle.same_as));
    if (muscle.without_emg)
      list.push_back(fmt::format("{} has no EMG: its activation is an unknown signal (without_emg = \"{}\").",
                                 muscle.name, choice_name(*muscle.without_emg)));
  }
  if (!result.source.study.subject.mass_kg && result.source.study.model.is_arm())
    list.push_back("Body mass is not given: 73 kg is assumed for the built-in arm's inertia.");
  for (const recording::WhiteningFilter& filter : result.emg.whitening.filters) {
    if (filter.reason.empty())
      list.push_back(fmt::format(
          "EMG channel {}: statistical bandwidth {:.0f} Hz, {} {:.0f} Hz.", filter.channel, filter.bandwidth_before_hz,
          result.emg.whitening.applied ? "whitened" : "whitened it would be", filter.bandwidth_after_hz));
  }
  const recording::EmgChain chain = run::emg_chain(result, nullptr);
  if (!chain.steps.empty()) list.push_back(fmt::format("EMG: {}.", fmt::join(chain.steps, "; ")));
  const study::Study& study = result.source.study;
  list.push_back(run::meaning_of_strength(study, run::from_maximal_effort(study.emg)));
  if (result.fit_input.nuisances_held) list.emplace_back(run::kFewRows);
  for (const std::string& text : result.source.model->unsupported) list.push_back("Model: " + text + ".");
  return list;
}

/// Returns the answers to the questions of somebody who sees the page first.
std::vector<page::Answer> answers(const run::StudyResult& result, const std::vector<page::Gate>& gates) {
  std::vector<page::Answer> list{{"Which numbers may I trust?", fit_sentences(result, true), "numbers"},
                                 {"Which trial is bad, and why?", trials_sentence(result), "trials"}};
  if (auto next = next_sentence(result, gates); !next.empty()) list.push_back({"What to record next?", next, "next"});
  list.push_back(
      {"Stronger than last time?", "`myoid compare EARLIER THIS` compares the folders of both results.", ""});
  return list;
}

/// Returns ", 73 kg, male" of the facts that the study gives.
std::string facts_of(const study::SubjectSpec& subject) {
  std::string text = subject.mass_kg ? fmt::format(", {:g} kg", *subject.mass_kg) : "";
  if (subject.sex != study::Sex::unstated) text += fmt::format(", {}", choice_name(subject.sex));
  return text;
}

/// Returns "; recorded 2026-02-01; analysed 2026-03-01", as far as the days are known.
std::string days_of(const run::StudyResult& result) {
  std::string text;
  if (!result.recorded.empty()) text += "; recorded " + result.recorded.front();
  if (result.recorded.size() > 1) text += " to " + result.recorded.back();
  return result.analysed.empty() ? text : text + "; analysed " + result.analysed;
}

std::string subtitle(const run::StudyResult& result, const Provenance& provenance) {
  std::vector<std::string> joints;
  for (const std::string& name : study::study_coordinates(result.source.study.model))
    joints.push_back(page::spelled(name));
  return fmt::format("{} trial{}{}{}; joint coordinate{} {}; model {}; {} {}", result.trials.size(),
                     result.trials.size() == 1 ? "" : "s", facts_of(result.source.study.subject), days_of(result),
                     joints.size() > 1 ? "s" : "", fmt::join(joints, ", "), result.source.model->name,
                     provenance.program, provenance.version);
}

Section parameters_section(const run::StudyResult& result, const IdentificationResult& torque) {
  Section section{.id = "parameters", .heading = "Parameters"};
  section.paragraphs.push_back(
      fmt::format("{} samples, worth {:.0f} independent ones; torque noise {:.2f} N m; EMG noise {} of the torque of "
                  "each channel; EMG delay {:.0f} ms.",
                  torque.samples_used, torque.effective_samples, torque.torque_sd_nm,
                  torque.emg_cv < 0.005 ? std::string("too small to be told from it, below 1 %")
                                        : fmt::format("{:.0f} %", 100.0 * torque.emg_cv),
                  1000.0 * torque.delay_s));
  section.tables = estimate_tables(result, torque);
  for (std::size_t m = 0; m < result.fit_input.data.muscles.size(); ++m)
    section.figures.push_back(muscle_curves(result, torque, m));
  return section;
}

/// Shows the muscle forces of the trial with the most movement. The workbench shows all trials, and
/// the trials' folders hold the numbers.
Section forces_section(const run::StudyResult& result, const IdentificationResult& method) {
  Section forces{.id = "forces", .heading = "Muscle forces"};
  const auto& trials = result.fit_input.data.trials;
  const auto most = std::ranges::max_element(trials, {}, [](const fit::TrialData& d) {
    return std::lround(100.0 * (d.length_m.colwise().maxCoeff() - d.length_m.colwise().minCoeff()).maxCoeff());
  });
  if (most != trials.end()) forces.figures.push_back(force_figure(result, *most, method));
  return forces;
}

/// Returns the EMG of the first calibration trial that has EMG; empty if none has.
std::optional<Section> emg_section(const run::StudyResult& result) {
  const auto task = std::ranges::find_if(
      result.trials, [](const run::TrialResult& t) { return t.emg.stages && t.spec.use == study::Use::calibration; });
  if (task == result.trials.end()) return std::nullopt;
  page::Figure figure = emg_figure(*task, recording::header_lines(run::emg_chain(result, nullptr)));
  figure.id = "emg_" + study::trial_ids(result.source.study).of(task->spec.name);
  return Section{.id = "emg", .heading = "EMG", .figures = {std::move(figure)}};
}

Section trials_section(const run::StudyResult& result) {
  Section trials{.id = "trials", .heading = "Trials", .tables = {trials_table(result)}};
  std::vector<std::string>& notes = trials.paragraphs;
  for (const run::TrialResult& t : result.trials) {
    for (const std::string& note : sentences(t.remarks)) notes.push_back(fmt::format("{}: {}", t.spec.name, note));
  }
  if (notes.size() > 12) {
    notes.resize(12);
    notes.push_back("More remarks stand in run.json.");
  }
  return trials;
}

std::vector<page::ProvenanceRow> provenance_rows(const run::StudyResult& result, const Provenance& with_places) {
  const Provenance provenance = without_places(with_places, result.source.study.file.parent_path());
  std::vector<page::ProvenanceRow> rows{{"program", fmt::format("{} {}", provenance.program, provenance.version)},
                                        {"command", provenance.command}};
  for (const InputFile& file : provenance.inputs) rows.push_back({file.path, "sha256 " + file.sha256});
  for (const run::StageTime& t : result.times) rows.push_back({"time: " + t.stage, fmt::format("{:.2f} s", t.seconds)});
  rows.push_back({"options", provenance.options_json});
  return rows;
}

}  // namespace

page::Report study_report(const run::StudyResult& result, const Provenance& provenance) {
  const IdentificationResult* best = run::best_method(result.fit);
  std::vector<page::Gate> gates = run::quality_gates(result);
  page::Report report{.title = fmt::format("Muscle parameters of {}", result.source.study.subject.name),
                      .subtitle = subtitle(result, provenance),
                      .headline = best == nullptr ? "" : voluntary_headline(*best),
                      .answers = answers(result, gates),
                      .gates = std::move(gates),
                      .assumptions = assumptions(result),
                      .provenance = provenance_rows(result, provenance)};
  const IdentificationResult* torque = run::method_of(result.fit, fit::Method::torque);
  const IdentificationResult* force = run::method_of(result.fit, fit::Method::force);
  const IdentificationResult* paper = run::method_of(result.fit, fit::Method::paper);

  if (best != nullptr) report.forest = forest_rows(result, *best);

  std::vector<Section>& sections = report.sections;
  if (best != nullptr && !best->voluntary.empty()) sections.push_back(voluntary_section(result, *best));
  sections.push_back(run::recordings_section(result));
  if (torque != nullptr) sections.push_back(parameters_section(result, *torque));
  if (force != nullptr)
    sections.push_back(
        {.id = "force_method", .heading = "Muscle by muscle", .tables = estimate_tables(result, *force)});
  for (Section& section : validation_sections(result)) sections.push_back(std::move(section));
  if (result.next) sections.push_back(run::next_recording_section(*result.next));
  if (const auto* shown = torque != nullptr ? torque : paper) sections.push_back(forces_section(result, *shown));
  if (auto emg = emg_section(result)) sections.push_back(std::move(*emg));
  if (!result.fit.informed.empty()) sections.push_back(informed_section(result));
  if (!result.fit_input.phases.empty()) sections.push_back(phases_section(result));
  sections.push_back(trials_section(result));
  sections.push_back(methods_section(methods_text(result, provenance)));
  if (paper != nullptr) sections.push_back(paper_section(result.fit, run::shares_forces(result.source.study)));
  return report;
}

}  // namespace myoid::results
