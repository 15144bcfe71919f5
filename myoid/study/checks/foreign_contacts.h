#pragma once

#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/stretch.h"
#include "myoid/study/checks/contact_table.h"

namespace myoid::study {

/// Contacts that belong to another body, as the check found them.
struct ForeignContacts {
  std::vector<Remark> remarks;
  std::vector<Stretch> times;  ///< On the clock of the motion.
};

/// Tells whether each contact with the ground belongs to the body to which its force is applied. A contact is a time of
/// 50 ms or more in which a force on a body exceeds a twentieth of its largest value. Only forces of floor plates are
/// checked: they push up, within 60 degrees, and their center of pressure is at most 0.5 m above the lowest point of
/// the person; the force of a load cell in a hand is neither. For each contact, the distance of the center of pressure
/// from the body is compared frame by frame:
///
/// - a foreign foot: the center of pressure is more than 0.2 m from the body and half as far from
///   another body, or 0.3 m from the body while the force's other contacts are nearer than 0.2 m;
/// - a second foot: the center of pressure is more than 0.1 m from the body, while another foot
///   without a force of its own stands still at the same height within 0.4 m.
///
/// Gives one warning for each force, with the times, their share of the loaded time, the distances and the remedy. If
/// no other body is within 0.4 m at any of these times, it says so, and asks for the clock if the loads have their own.
[[nodiscard]] ForeignContacts foreign_contacts(const body::BodyModel& model,
                                               const std::string& trial,
                                               const ContactTable& table,
                                               bool own_clock = false);

}  // namespace myoid::study
