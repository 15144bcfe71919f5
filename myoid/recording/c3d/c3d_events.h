#pragma once

#include <cstddef>
#include <span>

#include "myoid/ground/files/byte_source.h"
#include "myoid/recording/c3d/c3d_bytes.h"
#include "myoid/recording/c3d/c3d_file.h"

namespace myoid::recording {

/// Reads the events of a C3D file into `file.events`, each once, from every place that holds some:
///
/// | place | time |
/// | --- | --- |
/// | group `EVENT` | 60 minutes + seconds, two numbers an event |
/// | group `EVENTS` of KINARM | the second of two numbers [s]; the first is not used |
/// | new event section (header words 148 and 149, key 90), more than 255 events of KINARM | [s] |
/// | header (word 150), where no other place holds an event | [s] |
///
/// Two events are the same if their labels agree and their times differ by less than 0.1 ms. Times
/// that are no numbers are left out, with a note in `file.repairs`. `head` is the header's block.
/// Sources: the C3D user guide; the MATLAB reader that BKIN publishes for Dexterit-E (2012).
void read_c3d_events(C3dFile& file, ByteSource& source, std::span<const std::byte> head, const C3dBytes& number);

}  // namespace myoid::recording
