/* One model in several threads, each with a workspace of its own: every thread has the numbers that one thread alone
 * has. usage: threads RESULTS */
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "myoid.h"

enum { THREADS = 4, SAMPLES = 2000, MOST = 64 };

typedef struct run {
  const char* folder;
  const myoid_model* model;
  double sum[3 * MOST]; /* of torques and of the ends of their bands by joint */
  int failed;
} run;

static void evaluate(run* r) {
  double envelope[MOST] = {0.0}, acting[MOST], angle[MOST], speed[MOST] = {0.0};
  double torque[MOST], low[MOST], high[MOST];
  myoid_output output = {sizeof output, torque, low, high, NULL, NULL, NULL};
  myoid_workspace* space = myoid_workspace_new(r->model);
  const int channels = myoid_channel_count(r->model), joints = myoid_joint_count(r->model);
  int i, k;
  if (space == NULL || channels > MOST || joints > MOST) {
    r->failed = 1;
    return;
  }
  for (i = 0; i < SAMPLES; ++i) {
    for (k = 0; k < channels; ++k) envelope[k] = 0.05 + 0.4 * ((i + 37 * k) % 100) / 100.0;
    for (k = 0; k < joints; ++k) angle[k] = 1.0 + 0.5 * (i % 200) / 200.0;
    r->failed |= myoid_follow(r->model, space, envelope, 0.001, acting) != MYOID_DONE;
    r->failed |= myoid_evaluate(r->model, space, acting, angle, speed, &output) != MYOID_DONE;
    for (k = 0; k < joints; ++k) {
      r->sum[3 * k] += torque[k];
      r->sum[3 * k + 1] += low[k];
      r->sum[3 * k + 2] += high[k];
    }
  }
  myoid_workspace_free(space);
}

static void* in_thread(void* given) {
  run* r = given;
  char error[200];
  myoid_model* own = myoid_open(r->folder, NULL, error, sizeof error); /* others open and evaluate meanwhile */
  evaluate(r);
  r->failed |= own == NULL || myoid_open("/no/such/folder", NULL, error, sizeof error) != NULL;
  myoid_close(own);
  return NULL;
}

int main(int argc, char** argv) {
  static run alone, runs[THREADS];
  pthread_t threads[THREADS];
  char error[1000] = "";
  int i, failures = 0;
  myoid_model* model = argc == 2 ? myoid_open(argv[1], NULL, error, sizeof error) : NULL;
  if (model == NULL) return fprintf(stderr, "usage: threads RESULTS. %s\n", error), 2;
  alone.folder = argv[1];
  alone.model = model;
  for (i = 0; i < THREADS; ++i) runs[i] = alone;
  evaluate(&alone);
  for (i = 0; i < THREADS; ++i) pthread_create(&threads[i], NULL, in_thread, &runs[i]);
  for (i = 0; i < THREADS; ++i) {
    pthread_join(threads[i], NULL);
    failures += runs[i].failed || memcmp(runs[i].sum, alone.sum, sizeof alone.sum) != 0;
  }
  myoid_close(model);
  if (alone.failed || failures > 0) return fprintf(stderr, "%d threads have other numbers\n", failures), 1;
  printf("%d threads, %d samples each: the numbers of one thread\n", THREADS, SAMPLES);
  return 0;
}
