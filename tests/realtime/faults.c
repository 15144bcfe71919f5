/* NULL, missing sizes and values that cannot be, in every function of the C interface: usage faults RESULTS */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "myoid.h"

static int failures = 0;
#define EXPECT(condition) \
  if (!(condition)) ++failures, fprintf(stderr, "%d: %s\n", __LINE__, #condition)

int main(int argc, char** argv) {
  char error[1000] = "";
  double envelope[16] = {0.3, 0.1, 0.05}, acting[16], angle[16] = {1.2}, speed[16] = {0.5}, torque[16] = {7.0};
  myoid_output output = {sizeof output, torque, NULL, NULL, NULL, NULL, NULL};
  if (argc != 2) return 2;

  EXPECT(myoid_open(NULL, NULL, error, sizeof error) == NULL && strlen(error) > 0);
  EXPECT(myoid_open(NULL, NULL, NULL, 0) == NULL);
  EXPECT(myoid_open_given(NULL, NULL, error, sizeof error) == NULL && strlen(error) > 0);
  EXPECT(myoid_open_given("/no/such/folder", NULL, NULL, 100) == NULL);
  EXPECT(myoid_open("/no/such/folder", NULL, NULL, 100) == NULL);
  EXPECT(myoid_channel_count(NULL) == -1 && myoid_joint_count(NULL) == -1 && myoid_muscle_count(NULL) == -1);
  EXPECT(myoid_channel_name(NULL, 0) == NULL && myoid_joint_name(NULL, 0) == NULL);
  EXPECT(myoid_muscle_name(NULL, 0) == NULL && isnan(myoid_delay_s(NULL, 0)) && isnan(myoid_length_error_m(NULL)));
  EXPECT(myoid_workspace_new(NULL) == NULL);
  EXPECT(myoid_follow(NULL, NULL, envelope, 0.001, acting) == MYOID_MISSING_ARGUMENT);
  EXPECT(myoid_evaluate(NULL, NULL, envelope, angle, speed, &output) == MYOID_MISSING_ARGUMENT);
  myoid_workspace_free(NULL);
  myoid_close(NULL);

  myoid_model* model = myoid_open(argv[1], NULL, error, sizeof error);
  if (model == NULL) return fprintf(stderr, "%s\n", error), 1;
  myoid_workspace* space = myoid_workspace_new(model);
  EXPECT(myoid_channel_name(model, -1) == NULL && myoid_channel_name(model, 1000) == NULL);
  EXPECT(isnan(myoid_delay_s(model, 1000)));
  EXPECT(myoid_follow(model, space, NULL, 0.001, acting) == MYOID_MISSING_ARGUMENT);
  EXPECT(myoid_follow(model, space, envelope, 0.001, NULL) == MYOID_MISSING_ARGUMENT);
  EXPECT(myoid_follow(model, NULL, envelope, 0.001, acting) == MYOID_MISSING_ARGUMENT);
  EXPECT(myoid_follow(model, space, envelope, 0.0, acting) == MYOID_NOT_A_NUMBER && isnan(acting[0]));
  EXPECT(myoid_follow(model, space, envelope, NAN, acting) == MYOID_NOT_A_NUMBER);
  EXPECT(myoid_follow(model, space, envelope, 0.001, acting) == MYOID_DONE && acting[0] > 0.0);
  EXPECT(myoid_evaluate(model, NULL, acting, angle, speed, &output) == MYOID_MISSING_ARGUMENT);
  EXPECT(myoid_evaluate(model, space, NULL, angle, speed, &output) == MYOID_MISSING_ARGUMENT);
  EXPECT(myoid_evaluate(model, space, acting, NULL, speed, &output) == MYOID_MISSING_ARGUMENT);
  EXPECT(myoid_evaluate(model, space, acting, angle, NULL, &output) == MYOID_MISSING_ARGUMENT);
  EXPECT(myoid_evaluate(model, space, acting, angle, speed, NULL) == MYOID_MISSING_ARGUMENT);
  output.size = 0;
  EXPECT(myoid_evaluate(model, space, acting, angle, speed, &output) == MYOID_MISSING_ARGUMENT && torque[0] == 7.0);
  output.size = sizeof output;
  EXPECT(myoid_evaluate(model, space, acting, angle, speed, &output) == MYOID_DONE && isfinite(torque[0]));
  envelope[0] = 1.5;
  EXPECT(myoid_evaluate(model, space, envelope, angle, speed, &output) == MYOID_IMPLAUSIBLE && isfinite(torque[0]));
  envelope[0] = -0.5;
  EXPECT(myoid_evaluate(model, space, envelope, angle, speed, &output) == MYOID_NOT_A_NUMBER && isnan(torque[0]));
  envelope[0] = 0.5;
  speed[0] = 1e4;
  EXPECT(myoid_evaluate(model, space, envelope, angle, speed, &output) == MYOID_IMPLAUSIBLE);
  speed[0] = 0.5;
  angle[0] = 50.0;
  EXPECT(myoid_evaluate(model, space, envelope, angle, speed, &output) == MYOID_OUT_OF_RANGE && isnan(torque[0]));
  myoid_workspace_free(space);
  myoid_close(model);
  return failures == 0 ? 0 : 1;
}
