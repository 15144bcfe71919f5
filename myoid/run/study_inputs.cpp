#include "myoid/run/study_inputs.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/parallel.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/recording/tables/csv_reader.h"
#include "myoid/study/checks/open_questions.h"
#include "myoid/study/checks/study_plausibility.h"
#include "myoid/study/intake/emg_offset.h"
#include "myoid/study/intake/read_trial.h"
#include "myoid/study/study_model.h"

namespace myoid::run {
namespace {

std::vector<TrueValue> read_truth(const std::filesystem::path& path) {
  const recording::CsvTable table = recording::read_csv_table(path);
  const auto column = [&](std::string_view name) {
    const auto it = std::ranges::find(table.names, name);
    if (it == table.names.end()) throw ReadError(path, 1, fmt::format("no column '{}'", name));
    return static_cast<std::size_t>(it - table.names.begin());
  };
  const std::size_t muscle = column("muscle");
  const std::size_t parameter = column("parameter");
  const std::size_t value = column("value");
  std::vector<TrueValue> truth;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const auto number = parse_number(table.rows[r][value]);
    if (!number)
      throw ReadError(path, table.lines[r], fmt::format("expected a number, found '{}'", table.rows[r][value]));
    truth.push_back({table.rows[r][muscle], table.rows[r][parameter], *number});
  }
  return truth;
}

StudySource read_source(const study::Study& study) {
  StudySource source{.study = study,
                     .model_text = study::model_text(study),
                     .model = {},
                     .truth = {},
                     .norms = {},
                     .files = {},
                     .unanswered = {}};
  source.model = std::make_shared<const body::BodyModel>(study::load_model(study, source.model_text));
  return source;
}

}  // namespace

StudyInputs read_inputs(const study::Study& study) {
  StudyInputs inputs{read_source(study), {}};
  StudySource& source = inputs.source;
  const std::string text = read_text_file(study.file);
  source.unanswered = study::open_questions(text, study.file);
  source.files.push_back({study.file.string(), sha256(text)});
  if (study.model.file) source.files.push_back({study.model.file->string(), sha256(source.model_text)});
  if (study.truth) source.truth = read_truth(*study.truth);
  for (const study::NormSpec& norm : study.norms) {
    source.norms.push_back(study::read_norm(norm, study));
    source.files.push_back({norm.file.string(), sha256(read_text_file(norm.file))});
  }
  std::vector<std::vector<study::TrialPart>> parts(study.trials.size());
  parallel_each(study.trials.size(), [&](std::size_t i) {
    try {
      parts[i] = study::read_trial_parts(study, study.trials[i], *source.model);
    } catch (const InvalidInput& error) {
      throw InvalidInput(fmt::format("{} (trial '{}')", error.what(), study.trials[i].name));
    }
  });
  source.study.trials.clear();
  for (std::vector<study::TrialPart>& of_one : parts) {
    for (study::TrialPart& part : of_one) {
      source.study.trials.push_back(std::move(part.spec));
      inputs.trials.push_back(std::move(part.input));
    }
  }
  for (Remark& remark : study::take_off_emg_offsets(source.study, inputs.trials)) {
    const auto at = std::ranges::find(source.study.trials, remark.where, &study::TrialSpec::name);
    inputs.trials[static_cast<std::size_t>(at - source.study.trials.begin())].remarks.push_back(std::move(remark));
  }
  study::require_plausible(source.study, *source.model, inputs.trials);
  for (const study::TrialInput& trial : inputs.trials) {
    for (const InputFile& file : trial.files) {
      const bool known = std::ranges::any_of(source.files, [&](const InputFile& f) { return f.path == file.path; });
      if (!known) source.files.push_back(file);
    }
  }
  return inputs;
}

StudyInputs in_memory(const study::Study& study, std::vector<study::TrialInput> trials) {
  if (trials.size() != study.trials.size())
    throw InvalidInput(fmt::format("{} inputs are given for {} trials", trials.size(), study.trials.size()));
  return {read_source(study), std::move(trials)};
}

}  // namespace myoid::run
