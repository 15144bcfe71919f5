#include "myoid/program/commands/study_days.h"

#include <chrono>
#include <set>
#include <string>

#include "myoid/ground/core/day_text.h"
#include "myoid/recording/recorded_day.h"

namespace myoid::program {

void add_days(run::StudyResult& result) {
  using namespace std::chrono;
  result.analysed = day_text(year_month_day(floor<days>(system_clock::now())));
  std::set<std::string> recorded;
  for (const run::TrialResult& trial : result.trials) {
    for (const auto& file : {trial.spec.markers, trial.spec.motion, trial.spec.emg})
      if (file) recorded.insert(recording::recorded_day(*file));
  }
  recorded.erase("");
  result.recorded.assign(recorded.begin(), recorded.end());
}

}  // namespace myoid::program
