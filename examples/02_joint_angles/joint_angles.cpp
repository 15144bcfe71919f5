// Problem: markers moved with a held mass. How did the elbow move, and which torque did that take?
//
//   joint_angles MODEL MARKERS HELD_KG OUT.mot      OUT.mot: the joint angles, for the second step
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "myoid/ground/core/units.h"
#include "myoid/program/steps/id.h"
#include "myoid/program/steps/ik.h"

namespace {

// Inverse kinematics: the posture of each frame whose model markers lie nearest to the measured.
void find_angles(const char* model, const char* markers, const char* motion) {
  const myoid::program::IkResult ik = myoid::program::ik({.model = model, .markers = markers});
  myoid::program::write_ik(ik, motion);
  const Eigen::VectorXd elbow_deg = ik.solved.q.column("elbow_flexion") / myoid::kDegree;
  std::printf("frames not converged: %d\n", ik.solved.frames_not_converged);
  std::printf("least flexion: %.4f deg\n", elbow_deg.minCoeff());
  std::printf("greatest flexion: %.4f deg\n", elbow_deg.maxCoeff());
}

// Inverse dynamics: the torque that this motion takes. Two differentiations amplify noise, so the angles are smoothed.
void find_torque(const char* model, const char* motion, double held_mass_kg) {
  const myoid::program::IdResult id =
      myoid::program::id({.model = model,
                          .motion = motion,
                          .cutoff_hz = 6.0,
                          .held = {.mass_kg = held_mass_kg, .body = "forearm_hand", .at_m = {0.0, -0.337, 0.0}}});
  const Eigen::VectorXd elbow_nm = id.forces.column("elbow_flexion_moment");
  std::printf("mean torque: %.4f N m\n", elbow_nm.mean());
  std::printf("greatest torque: %.4f N m\n", elbow_nm.maxCoeff());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) return std::fputs("joint_angles MODEL MARKERS HELD_KG OUT.mot\n", stderr), 2;
  try {
    find_angles(argv[1], argv[2], argv[4]);
    find_torque(argv[1], argv[4], std::atof(argv[3]));
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 3;
  }
}
