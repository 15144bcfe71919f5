#include "myoid/recording/plate_standing.h"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/file_format.h"

namespace myoid::recording {
namespace {

void stand_floor(Recording& recording, const std::vector<PlateLoad>& loads, const Vec3& up_L) {
  for (std::size_t k = 0; k < loads.size(); ++k) {
    PlateSetup& setup = recording.plates[k];
    setup.side.is_floor = is_floor(loads[k], up_L);
    if (!setup.side.is_floor) continue;
    const double side = loads[k].normal_L.dot(up_L) < 0.0 ? -1.0 : 1.0;
    setup.side.out_L = side * loads[k].normal_L;
    setup.side.turn = side * loads[k].along_n < 0.0 ? -1.0 : 1.0;
    if (side > 0.0)
      note(recording.repairs,
           "force plate {}: its corners are listed the other way round than the C3D guide "
           "has it, so that z of the plate points up; taken as they are",
           setup.number);
    if (setup.side.turn < 0.0)
      note(recording.repairs,
           "force plate {} pulls down with {:.0f} N: the file holds the force on the plate; "
           "turned round to act on the person",
           setup.number, std::abs(loads[k].along_n));
  }
}

/// Returns the sign on which the loaded plates of the floor agree; 0 if there are none or they differ.
double turn_of_floor(Recording& recording, const std::vector<PlateLoad>& loads) {
  double turn = 0.0;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const PlateSetup& setup = recording.plates[k];
    if (!setup.side.is_floor || !loads[k].loaded()) continue;
    if (turn != 0.0 && turn != setup.side.turn) {
      note(recording.repairs,
           "force plate {} has the opposite sign of the plates before it; each is taken to "
           "push the person up: is one of them pulled?",
           setup.number);
      return 0.0;
    }
    turn = setup.side.turn;
  }
  return turn;
}

/// Sets the side of walls and handles, which a person may also pull.
void stand_walls(Recording& recording, const std::vector<PlateLoad>& loads, const Vec3& up_L, double least_force_n) {
  const double floor = turn_of_floor(recording, loads);
  for (std::size_t k = 0; k < loads.size(); ++k) {
    PlateSetup& setup = recording.plates[k];
    if (setup.side.is_floor) continue;
    const double seen = markers_side(recording.markers, setup.p_GP_m, loads[k].normal_L);
    const double side = seen > 0.0 ? 1.0 : -1.0;
    setup.side.out_L = side * loads[k].normal_L;
    setup.side.turn = floor != 0.0 ? floor : side * loads[k].along_n < 0.0 ? -1.0 : 1.0;
    if (loads[k].largest_n < least_force_n) continue;
    note(recording.repairs,
         "force plate {} is a wall or a handle, {:.0f} degrees from horizontal: by {} the "
         "person is on its side of {}; its force {} the person, with {}",
         setup.number, std::acos(std::abs(loads[k].normal_L.dot(up_L))) / kDegree,
         seen != 0.0 ? "the markers" : "its corners", axis_name(setup.side.out_L),
         setup.side.turn * side * loads[k].along_n < 0.0 ? "pulls" : "pushes",
         floor != 0.0 ? "the sign of the floor's plates" : "a sign that no loaded plate of the floor confirms");
  }
}

/// Leaves out plates whose force never changes.
void leave_out_dead(Recording& recording, const std::vector<PlateLoad>& loads) {
  for (std::size_t k = 0; k < loads.size(); ++k) {
    if (!loads[k].constant_n) continue;
    recording.plates[k].side.turn = 0.0;
    note(recording.repairs,
         "force plate {} reads {:.0f} N in every sample: unplugged, or never set to zero; its force is left out",
         recording.plates[k].number, *loads[k].constant_n);
  }
}

/// Takes the stated upward axis, with a note where the file contradicts it.
LaboratoryUp as_told(Recording& recording, const std::vector<PlateLoad>& loads, const Vec3& stated_up_L) {
  try {
    const LaboratoryUp own = laboratory_up(recording, loads);
    if (own.up_L && *own.up_L != stated_up_L)
      note(recording.repairs, "up is taken as {}, as told; by the file it is {}: {}", axis_name(stated_up_L),
           axis_name(*own.up_L), own.because);
  } catch (const InvalidInput&) {
    // A stated axis overrides a file that contradicts itself.
  }
  return {stated_up_L, "as told"};
}

}  // namespace

LaboratoryUp stand_plates(Recording& recording, const std::optional<Vec3>& stated_up_L, double least_force_n) {
  std::vector<PlateLoad> loads;
  for (const PlateSetup& setup : recording.plates) loads.push_back(plate_load(recording, setup, least_force_n));
  LaboratoryUp up = stated_up_L ? as_told(recording, loads, *stated_up_L) : laboratory_up(recording, loads);
  if (up.up_L) {
    stand_floor(recording, loads, *up.up_L);
    stand_walls(recording, loads, *up.up_L, least_force_n);
  }
  leave_out_dead(recording, loads);
  for (PlateSetup& setup : recording.plates) turn_origin(setup, recording.repairs);
  return up;
}

LaboratoryUp read_laboratory_up(const std::filesystem::path& path) {
  if (format_of(path) != FileFormat::c3d) return {};
  Recording recording = read_recording(path);
  try {
    return stand_plates(recording, std::nullopt);
  } catch (const ReadError&) {
    throw;
  } catch (const InvalidInput& error) {
    throw ReadError(path, 0, error.what());
  }
}

}  // namespace myoid::recording
