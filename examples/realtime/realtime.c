/* Torques and muscle forces while a person moves, by the C interface.
 *
 *   realtime [--given] RESULTS STEP <samples   a line of numbers for each line of numbers, STEP seconds apart
 *   realtime [--given] RESULTS --time N        how long an evaluation takes
 *
 * --given takes the reading given geometry and sensors in place of the person's.
 * A sample is the envelope of each channel, then angle [rad] and speed [rad/s] of each joint. The answer is
 * torque, lower and upper end of the 95 % band of each joint [N m], then the same of each muscle's force [N].
 */
#define _POSIX_C_SOURCE 199309L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "myoid.h"

enum { MOST = 256 };

static int by_value(const void* a, const void* b) {
  const double x = *(const double*)a, y = *(const double*)b;
  return (x > y) - (x < y);
}

static double now_us(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return 1e6 * (double)t.tv_sec + 1e-3 * (double)t.tv_nsec;
}

int main(int argc, char** argv) {
  char error[1000];
  double envelope[MOST] = {0}, acting[MOST] = {0}, angle[MOST] = {0}, speed[MOST] = {0};
  double torque[3][MOST], force[3][MOST];
  const myoid_output output = {sizeof output, torque[0], torque[1], torque[2], force[0], force[1], force[2]};
  const int given = argc > 1 && strcmp(argv[1], "--given") == 0;
  if (given) --argc, ++argv;
  if (argc < 3) return fprintf(stderr, "usage: realtime RESULTS STEP, or realtime RESULTS --time N\n"), 2;

  myoid_model* model = (given ? myoid_open_given : myoid_open)(argv[1], NULL, error, sizeof error);
  if (model == NULL) return fprintf(stderr, "error: %s\n", error), 3;
  myoid_workspace* workspace = myoid_workspace_new(model);
  const int channels = myoid_channel_count(model), joints = myoid_joint_count(model);
  const int muscles = myoid_muscle_count(model);
  if (workspace == NULL || channels > MOST || joints > MOST || muscles > MOST) return 1;

  if (argc == 4 && strcmp(argv[2], "--time") == 0) {
    const int count = atoi(argv[3]);
    double* took_us = malloc((size_t)count * sizeof *took_us);
    if (took_us == NULL) return 1;
    for (int i = 0; i < count; ++i) {
      for (int c = 0; c < channels; ++c) envelope[c] = 0.001 * (i % 900 + c);
      for (int j = 0; j < joints; ++j) angle[j] = 0.5 + 0.001 * (i % 1000), speed[j] = 0.002 * (i % 500);
      const double begin_us = now_us();
      if (myoid_evaluate(model, workspace, envelope, angle, speed, &output) != MYOID_DONE) return 4;
      took_us[i] = now_us() - begin_us;
    }
    qsort(took_us, (size_t)count, sizeof *took_us, by_value);
    printf("%d evaluations: median %.2f us, 99.9 %% %.2f us, worst %.2f us\n", count, took_us[count / 2],
           took_us[(size_t)(0.999 * count)], took_us[count - 1]);
    free(took_us);
  } else {
    for (;;) {
      int read = 0;
      for (int c = 0; c < channels; ++c) read += scanf("%lf", &envelope[c]) == 1;
      for (int j = 0; j < joints; ++j) read += scanf("%lf", &angle[j]) == 1;
      for (int j = 0; j < joints; ++j) read += scanf("%lf", &speed[j]) == 1;
      if (read != channels + 2 * joints) break;
      myoid_follow(model, workspace, envelope, atof(argv[2]), acting);
      (void)myoid_evaluate(model, workspace, acting, angle, speed, &output);
      for (int j = 0; j < joints; ++j) printf("%.9g %.9g %.9g ", torque[0][j], torque[1][j], torque[2][j]);
      for (int m = 0; m < muscles; ++m) printf("%.9g %.9g %.9g ", force[0][m], force[1][m], force[2][m]);
      printf("\n");
    }
  }
  myoid_workspace_free(workspace);
  myoid_close(model);
  return 0;
}
