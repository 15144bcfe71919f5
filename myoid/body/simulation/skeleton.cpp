#include "myoid/body/simulation/skeleton.h"

#include <cmath>

#include "myoid/body/dynamics/passive_forces.h"
#include "myoid/ground/core/error.h"

namespace myoid::body {

Skeleton::Skeleton(const SimulationModel& model) : model_(&model), dynamics_(model.body) {
  for (std::size_t i = 0; i < model.muscles.size(); ++i)
    units_.emplace_back(model.muscles[i].parameters, model.muscles[i].laws, model.millard[i]);
  const auto nq = static_cast<Eigen::Index>(coordinate_count());
  q_.setConstant(nq, std::nan(""));
  qdot_.setConstant(nq, std::nan(""));
  paths_.resize(units_.size());
  passive_.resize(coordinate_count());
  forces_.resize(coordinate_count());
}

void Skeleton::set(const double* q, const double* qdot) {
  const auto nq = static_cast<Eigen::Index>(coordinate_count());
  const Eigen::Map<const Eigen::VectorXd> here(q, nq);
  const Eigen::Map<const Eigen::VectorXd> speed(qdot, nq);
  if (here == q_ && speed == qdot_) return;
  q_ = here;
  qdot_ = speed;
  dynamics_.set(q_, qdot_);
  for (std::size_t i = 0; i < units_.size(); ++i) {
    const auto index = static_cast<std::size_t>(model_->muscles[i].index);
    body::compute_path(model_->body, model_->body.muscles[index].path, dynamics_.state(), workspace_, paths_[i]);
  }
  if (!model_->body.passive_forces.empty()) {
    others_.setZero(nq);
    wrenches_.clear();
    body::append_passive_forces(model_->body, dynamics_.state(), others_, wrenches_);
    for (const body::BodyWrench& wrench : wrenches_) dynamics_.add(wrench, others_);
  }
  for (std::size_t k = 0; k < coordinate_count(); ++k) {
    const auto c = static_cast<Eigen::Index>(k);
    passive_[k] = muscle::joint_passive(model_->joints[k], dynamics_.q()[c], dynamics_.qdot()[c]);
  }
}

void Skeleton::accelerate(const double* tau, const char* prescribed, double* qddot, double* device) {
  for (std::size_t k = 0; k < forces_.size(); ++k) forces_[k] = tau[k] + passive_[k].torque_nm + other(k);
  if (!dynamics_.accelerate(forces_.data(), prescribed, qddot, device)) {
    throw ModelError(
        "the mass matrix of the free coordinates is not positive: a coordinate moves bodies without mass or inertia; "
        "give them some, or lock the coordinate");
  }
}

double Skeleton::joint_elastic_energy_j() const {
  double sum = 0.0;
  for (const auto& joint : passive_) sum += joint.stored_energy_j;
  return sum;
}

}  // namespace myoid::body
