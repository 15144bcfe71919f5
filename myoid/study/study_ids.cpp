#include "myoid/study/study_ids.h"

#include <vector>

#include "myoid/ground/files/result_names.h"

namespace myoid::study {
namespace {

/// Longer stems of model files give way to an id: file systems take 255 bytes.
constexpr std::size_t kMostInStem = 200;

}  // namespace

NameIds trial_ids(const Study& study) {
  std::vector<std::string> names;
  for (const TrialSpec& trial : study.trials) names.push_back(trial.name);
  std::vector<std::string_view> reserved = result_names();
  const std::string model = identified_model_name(study);
  reserved.emplace_back(model);
  return NameIds(names, IdFor::file, reserved);
}

std::string identified_model_name(const Study& study) {
  std::string stem = study.model.file ? study.model.file->stem().string() : "arm4";
  if (stem.size() > kMostInStem) stem = ids_of({stem}).front();
  return stem + "_identified.osim";
}

void must_be_name(SettingVisitor& v, std::string_view key, const std::string& name) {
  const std::string reason = name_refusal(name);
  v.must(reason.empty(), key, reason);
}

}  // namespace myoid::study
