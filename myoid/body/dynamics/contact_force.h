#pragma once

#include <vector>

#include "myoid/body/model/kinematic_tree.h"

namespace myoid::body {

/// Appends the forces of a contact on both bodies at the posture and speeds of `state`. With the
/// depth x of the overlap, the effective radius R and modulus k (k^(3/2) in series as springs in
/// Hertz's law) and the speed v of approach
///   f_H = 4/3 k x sqrt(R k x),  f = f_H (1 + 3/2 c v), never below zero,
/// along the normal, and against sliding at speed s, with v_t the transition velocity,
///   f (min(s/v_t, 1) (mu_d + 2 (mu_s - mu_d)/(1 + (s/v_t)^2)) + mu_v s).
/// Smooth: x and the signs by hyperbolic tangents (Serrancoli et al. 2019), acting at any distance.
/// Simbody's version of the law of Hunt and Crossley (1975).
void append_contact(const body::Contact& contact,
                    const body::BodyState& state,
                    std::vector<body::BodyWrench>& wrenches);

}  // namespace myoid::body
