#include "myoid/study/trial_videos.h"

#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/study/read_study.h"

namespace myoid::study {
namespace {

/// Returns the trials with a movement.
std::vector<TrialSpec*> movements(Study& study) {
  std::vector<TrialSpec*> found;
  for (TrialSpec& trial : study.trials)
    if (trial.use != Use::mvc) found.push_back(&trial);
  return found;
}

std::string names_of(const std::vector<TrialSpec*>& trials) {
  std::vector<std::string> names;
  names.reserve(trials.size());
  for (const TrialSpec* trial : trials) names.push_back(trial->name);
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Returns the trial that --video names, and its file. Text before '=' is a trial's name if the study has such a trial.
TrialSpec& trial_of(Study& study, const std::string& asked, std::string& file) {
  const std::size_t equals = asked.find('=');
  for (TrialSpec& trial : study.trials) {
    if (equals == std::string::npos || asked.compare(0, equals, trial.name) != 0) continue;
    file = asked.substr(equals + 1);
    return trial;
  }
  file = asked;
  const std::vector<TrialSpec*> moving = movements(study);
  std::error_code ignored;
  if (equals != std::string::npos && !std::filesystem::exists(asked, ignored))
    throw InvalidInput(
        fmt::format("--video '{}': there is no trial '{}'{}", asked, asked.substr(0, equals),
                    not_among(asked.substr(0, equals), moving, [](const TrialSpec* t) { return t->name; })));
  if (moving.size() != 1)
    throw InvalidInput(fmt::format("--video '{}': the study has {} movements; write TRIAL=FILE with one of {}", asked,
                                   moving.size(), names_of(moving)));
  return *moving.front();
}

}  // namespace

void set_videos(Study& study, const VideoChoice& choice) {
  if (choice.offset_s && choice.files.empty())
    throw InvalidInput("--video-offset says when a film begins; name the film with --video");
  std::set<std::string> named;
  for (const std::string& asked : choice.files) {
    std::string file;
    TrialSpec& trial = trial_of(study, asked, file);
    if (file.empty()) throw InvalidInput(fmt::format("--video '{}': the file is missing; write TRIAL=FILE", asked));
    if (!named.insert(trial.name).second)
      throw InvalidInput(fmt::format("--video '{}': trial '{}' has a film already; give one", asked, trial.name));
    trial.video = file;
    trial.video_offset_s = choice.offset_s.value_or(0.0);
  }
}

void require_videos(const Study& study) {
  for (const TrialSpec& trial : study.trials) {
    std::error_code ignored;
    if (!trial.video || std::filesystem::is_regular_file(*trial.video, ignored)) continue;
    throw ReadError(*trial.video, 0,
                    fmt::format("the video of trial '{}' is no file; in study.toml its path counts from the folder of "
                                "the study, after --video from here",
                                trial.name));
  }
}

Study read_filmed_study(const std::filesystem::path& file, const VideoChoice& choice) {
  Study study = read_study(file);
  set_videos(study, choice);
  require_videos(study);
  return study;
}

}  // namespace myoid::study
