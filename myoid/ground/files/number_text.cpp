#include "myoid/ground/files/number_text.h"

#include <charconv>

namespace myoid::inline ground {

char* put_number(char* at, double value) { return std::to_chars(at, at + NumberText::kRoom, value).ptr; }

NumberText::NumberText(std::size_t count) {
  constexpr std::size_t kWorthKeeping = 100'000;
  if (count >= kWorthKeeping) kept_.resize(std::size_t{1} << kIndexBits);
}

char* NumberText::put_unasked(char* at, double value) {
  if (unasked_ > 0) --unasked_;
  return put_number(at, value);
}

char* NumberText::put_and_keep(char* at, double value, Kept& kept) {
  char* const end = put_number(at, value);
  const auto size = static_cast<std::size_t>(end - at);
  if (size > kept.text.size()) return end;
  kept.bits = std::bit_cast<std::uint64_t>(value);
  kept.size = static_cast<std::uint8_t>(size);
  std::memcpy(kept.text.data(), at, kept.text.size());
  return end;
}

void NumberText::judge() {
  constexpr int kEnough = kWindow / 4, kPause = 15 * kWindow;
  if (found_ < kEnough) unasked_ = kPause;
  asked_ = found_ = 0;
}

}  // namespace myoid::inline ground
