#pragma once
/* The C interface of Myoid for real-time use and for other languages.
 *
 * An identified person predicts joint torques and muscle forces from EMG envelopes, joint angles
 * and speeds. myoid_open reads the folder of a finished `myoid run`; after it and
 * myoid_workspace_new nothing is allocated. A model does not change: several threads may use one
 * model, each with a workspace of its own. No function throws or prints. NULL in place of a model,
 * workspace or array is an error and never read: counts are then -1, names NULL, numbers NaN.
 *
 * Units: N m, N, rad, rad/s, s. An envelope is 0..1, as activation.sto holds it. A run by the posterior makes its
 * forces from the drive behind the envelope (drive.sto), which needs the samples that follow: fed with drive.sto,
 * myoid_follow and myoid_evaluate give the forces of identified_forces.sto. A live program has envelopes, which are
 * noisier, and so are its forces.
 */
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct myoid_model myoid_model;
typedef struct myoid_workspace myoid_workspace;

/* The end of myoid_follow and myoid_evaluate. */
enum {
  MYOID_DONE = 0,
  MYOID_NOT_A_NUMBER = 1,     /* an input is not finite, or an envelope is below 0; all results are NaN */
  MYOID_OUT_OF_RANGE = 2,     /* an angle lies outside the model's range; all results are NaN */
  MYOID_MISSING_ARGUMENT = 3, /* a pointer is NULL, or the size of myoid_output is not set; nothing is written */
  MYOID_IMPLAUSIBLE = 4       /* the results stand, but an envelope is above 1 or a speed above MYOID_FASTEST_RADPS */
};
/* No joint but a pitcher's shoulder turns faster. */
#define MYOID_FASTEST_RADPS 100.0

/* The version of the library, "0.1.0". */
const char* myoid_version(void);

/* Reads an identified person from the folder of a run. `study`: the study file, if it is no longer
 * where it was; else NULL. Returns NULL on an error, with a sentence in `error` (of `size` bytes;
 * may be NULL). */
myoid_model* myoid_open(const char* results, const char* study, char* error, size_t size);

/* The same by the second reading, given geometry and sensors: values and bands as if the study's moment arms, tendons
 * and sensors were exact, for use with the same model, electrodes and dynamometer. parameters.json holds the covariance
 * of the person's reading; here each unknown's standard deviation is scaled by the ratio of the widths of its two
 * intervals. Of exact data both readings are the same. */
myoid_model* myoid_open_given(const char* results, const char* study, char* error, size_t size);

void myoid_close(myoid_model* model);

/* EMG channels, joints and muscles; the names live as long as the model. -1 or NULL without a model or an element
 * of that index. */
int myoid_channel_count(const myoid_model* model);
int myoid_joint_count(const myoid_model* model);
int myoid_muscle_count(const myoid_model* model);
const char* myoid_channel_name(const myoid_model* model, int channel);
const char* myoid_joint_name(const myoid_model* model, int joint);
const char* myoid_muscle_name(const myoid_model* model, int muscle);

/* The delay of a channel [s]: give myoid_evaluate the envelope of so long ago. Where the fit split
 * the delay into a pure one and lags, this is the pure one. */
double myoid_delay_s(const myoid_model* model, int channel);
/* The greatest error of the muscles' lengths by polynomials [m]. */
double myoid_length_error_m(const myoid_model* model);

/* Space for evaluations of one thread. NULL where memory is missing. */
myoid_workspace* myoid_workspace_new(const myoid_model* model);
void myoid_workspace_free(myoid_workspace* workspace);

/* Places for results; any may be NULL. `_low` and `_high` are the ends of the 95 % band: of a
 * force, by the uncertainty of the parameters; of a torque, also by what the fit left unexplained.
 * Bands that nobody asks for are not computed. `size` is
 * sizeof(myoid_output): a later version of the library reads no further than the caller's. */
typedef struct myoid_output {
  size_t size;
  double* torque_nm; /* by joint */
  double* torque_low_nm;
  double* torque_high_nm;
  double* force_n; /* by muscle, along the tendon */
  double* force_low_n;
  double* force_high_n;
} myoid_output;

/* Passes the next sample of each channel's envelope, `step_s` after the one before, through the
 * lags of excitation and activation, which the workspace remembers; `acting` receives what
 * myoid_evaluate takes. Without lags in the fit it receives the sample itself. The first sample is
 * taken as held for long. Returns MYOID_DONE, MYOID_IMPLAUSIBLE or an error; after MYOID_NOT_A_NUMBER, which a step
 * that is not above 0 gives too, the workspace is as before and `acting` is NaN. */
int myoid_follow(
    const myoid_model* model, myoid_workspace* workspace, const double* envelope, double step_s, double* acting);

/* Evaluates at the envelope of each channel, the angle and the speed of each joint. Returns one
 * of the values above. */
int myoid_evaluate(const myoid_model* model,
                   myoid_workspace* workspace,
                   const double* envelope,
                   const double* angle_rad,
                   const double* speed_radps,
                   const myoid_output* output);

#ifdef __cplusplus
}
#endif
