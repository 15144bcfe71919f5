#include "myoid/recording/number_text.h"

#include <charconv>
#include <cstring>

namespace myoid::recording {
namespace {

constexpr std::size_t kWorthKeeping = 100'000;
/// Of a thousand numbers so many must have been there; else the next numbers are not looked up.
constexpr int kWindow = 1000, kEnough = 250, kPause = 15'000;

}  // namespace

char* put_number(char* at, double value) {
  return std::to_chars(at, at + NumberText::kRoom, value).ptr;
}

NumberText::NumberText(std::size_t count)
    : kept_(count < kWorthKeeping ? 0 : std::size_t{1} << kIndexBits) {}

char* NumberText::put(char* at, double value) {
  if (unasked_ > 0 || kept_.empty()) {
    unasked_ = unasked_ > 0 ? unasked_ - 1 : 0;
    return put_number(at, value);
  }
  if (asked_ == kWindow) {
    if (found_ < kEnough) unasked_ = kPause;
    asked_ = found_ = 0;
  }
  ++asked_;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  Kept& kept = kept_[index_of(bits)];
  if (kept.bits != bits) {
    char* const end = put_number(at, value);
    const auto size = static_cast<std::size_t>(end - at);
    if (size > kept.text.size()) return end;
    kept.bits = bits;
    kept.size = static_cast<std::uint8_t>(size);
    std::memcpy(kept.text.data(), at, kept.text.size());
    return end;
  }
  ++found_;
  std::memcpy(at, kept.text.data(), kept.text.size());
  return at + kept.size;
}

}  // namespace myoid::recording
