#include "myoid/recording/c3d/c3d_header.h"

#include <cmath>

namespace myoid::recording {

bool is_c3d_rate(double rate_hz) { return std::isfinite(rate_hz) && rate_hz > 1e-3 && rate_hz < 1e7; }

C3dHeader read_c3d_header(std::span<const std::byte> head, const C3dBytes& number) {
  const auto word = [&](std::size_t n) { return number.u16(&head[2 * (n - 1)]); };
  C3dHeader header;
  header.points = word(2);
  header.analog_total = word(3);
  header.first_frame = word(4);
  header.last_frame = word(5);
  header.scale = number.real(&head[12]);
  header.data_block = word(9);
  header.analog_per_frame = word(10);
  header.rate_hz = number.real(&head[20]);
  return header;
}

std::optional<C3dProcessor> guess_processor(std::span<const std::byte> head, std::uint64_t file_size) {
  for (const C3dProcessor p : {C3dProcessor::intel, C3dProcessor::sgi, C3dProcessor::dec}) {
    const C3dHeader h = read_c3d_header(head, {p});
    const double scale = std::abs(static_cast<double>(h.scale));
    if (is_c3d_rate(static_cast<double>(h.rate_hz)) && h.rate_hz >= 1.0F && scale > 1e-6 && scale < 1e4 &&
        h.data_block >= 2 && (h.data_block - 1) * kC3dBlock < file_size && h.points + h.analog_total > 0 &&
        h.points < 10000)
      return p;
  }
  return std::nullopt;
}

}  // namespace myoid::recording
