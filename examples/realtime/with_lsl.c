/* Joint torques of EMG envelopes from the Lab Streaming Layer: cc with_lsl.c -llsl -lmyoid
 *   with_lsl RESULTS ENVELOPES
 * ENVELOPES is the name of a stream of doubles: the envelope of each channel, then the angle of each joint [rad], then
 * the speed of each joint [rad/s]. The torques [N m] leave as the stream `torque`. */
#include <lsl_c.h>
#include <stdio.h>

#include "myoid.h"

enum { MOST = 256 };

int main(int argc, char** argv) {
  char error[1000];
  double in[3 * MOST], acting[MOST], torque[MOST], last = 0.0;
  lsl_streaminfo found;
  int32_t code = 0;
  if (argc != 3) return fprintf(stderr, "usage: with_lsl RESULTS ENVELOPES\n"), 2;
  myoid_model* model = myoid_open(argv[1], NULL, error, sizeof error);
  if (model == NULL) return fprintf(stderr, "%s\n", error), 3;
  const int channels = myoid_channel_count(model), joints = myoid_joint_count(model), all = channels + 2 * joints;
  if (channels > MOST || joints > MOST) return 1;
  myoid_workspace* workspace = myoid_workspace_new(model);
  if (lsl_resolve_byprop(&found, 1, "name", argv[2], 1, 60.0) < 1) return fprintf(stderr, "no such stream\n"), 3;
  if (lsl_get_channel_count(found) != all) return fprintf(stderr, "expected %d channels\n", all), 3;
  lsl_inlet inlet = lsl_create_inlet(found, 1, LSL_NO_PREFERENCE, 1);
  lsl_outlet outlet = lsl_create_outlet(
      lsl_create_streaminfo("torque", "Mocap", (uint32_t)joints, LSL_IRREGULAR_RATE, cft_double64, "myoid"), 0, 1);
  const myoid_output output = {sizeof output, torque, NULL, NULL, NULL, NULL, NULL};
  for (;;) {
    const double time = lsl_pull_sample_d(inlet, in, all, LSL_FOREVER, &code);
    if (code != 0) break;
    if (last > 0.0 && time > last && myoid_follow(model, workspace, in, time - last, acting) != MYOID_NOT_A_NUMBER &&
        myoid_evaluate(model, workspace, acting, in + channels, in + channels + joints, &output) != MYOID_OUT_OF_RANGE)
      lsl_push_sample_dt(outlet, torque, time);
    last = time;
  }
  myoid_workspace_free(workspace);
  myoid_close(model);
  return 0;
}
