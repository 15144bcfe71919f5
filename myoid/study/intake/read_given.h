#pragma once

#include "myoid/body/model/body_model.h"
#include "myoid/study/intake/trial_clock.h"
#include "myoid/study/intake/trial_input.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Reads the stages that the files of a trial give into `input.given`: lengths and their rates within the times of the
/// trial, of other files all samples. Velocities that no file gives are the rates of the quintic spline through the
/// lengths. Without a motion the lengths become a motion without columns. `remember` receives every file. Throws
/// ReadError for a missing column, another unit, a value that is no number, and fewer than two lengths.
void read_given_stages(const Study& study,
                       const TrialSpec& trial,
                       const body::BodyModel& model,
                       const Remember& remember,
                       TrialInput& input);

/// Keeps the lengths' samples that all files of the trial cover, up to half a sample at the ends, because nothing is
/// extrapolated; a warning or note names a file that leaves out more than 0.1 s. Excludes the times in which a file has
/// no samples from the trial, and warns of them and of files at another rate. Does nothing without lengths. Throws
/// ReadError for files whose times do not overlap.
void join_given_clocks(TrialSpec& trial, TrialInput& input);

}  // namespace myoid::study
