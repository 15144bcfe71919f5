#include "myoid/cli/video_options.h"

namespace myoid::cli {

void add_video_options(CLI::App& command, VideoChoice& video) {
  command
      .add_option("--video", video.files, "Film that the report shows beside the model, [TRIAL=]FILE; may be repeated")
      ->allow_extra_args(false);
  command.add_option("--video-offset", video.offset_s, "When these films begin, in seconds of the motion (default 0)");
}

}  // namespace myoid::cli
