#pragma once

#include "myoid/cli/context.h"
#include "myoid/study/study.h"

namespace myoid::cli {

/// Adds --video and --video-offset: films that the report shows beside the model.
void add_video_options(CLI::App& command, VideoChoice& video);

}  // namespace myoid::cli
